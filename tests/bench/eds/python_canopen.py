"""Read an EDS with python-canopen, for reading.py: a line `python-canopen SECONDS` for each time.

    python_canopen.py FILE RUNS
"""

import io
import sys
import time
from pathlib import Path

from canopen.objectdictionary.eds import import_eds

NODE_ID = 5


def main() -> None:
    file, runs = sys.argv[1:]
    data = Path(file).read_bytes()
    for _ in range(int(runs)):
        start = time.perf_counter()
        dictionary = import_eds(io.StringIO(data.decode("ascii"), newline=None), NODE_ID)
        seconds = time.perf_counter() - start
        if not len(dictionary):
            sys.exit("nothing was read")
        print(f"python-canopen {seconds:.9f}", flush=True)


if __name__ == "__main__":
    main()
