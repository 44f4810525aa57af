"""Say of each file named on standard input, in a line of JSON, why a reader refuses it; null if it accepts it.

accepts.py python-canopen|dcfchk|eds-utils SECONDS
"""

from __future__ import annotations

import contextlib
import io
import json
import logging
import signal
import sys
import warnings
from collections.abc import Callable

NODE = 5


class OutOfTime(Exception):
    """The reader takes longer than it may."""


def python_canopen() -> Callable[[str], None]:
    import canopen

    def read(file: str) -> None:
        canopen.import_od(file, node_id=NODE)

    return read


def dcfchk() -> Callable[[str], None]:
    from dcf import cli

    def read(file: str) -> None:
        sys.argv = ["dcfchk", "-n", str(NODE), file]
        told = io.StringIO()
        with warnings.catch_warnings(record=True) as caught, contextlib.redirect_stderr(told):
            warnings.simplefilter("always")
            try:
                cli.main()
            except SystemExit as end:
                if end.code:
                    raise ValueError(str(caught[0].message) if caught else told.getvalue()) from end

    return read


def eds_utils() -> Callable[[str], None]:
    from eds_utils.core.file_io.read_eds import read_eds

    def read(file: str) -> None:
        read_eds(file)

    return read


READERS = {"python-canopen": python_canopen, "dcfchk": dcfchk, "eds-utils": eds_utils}


def stop(*_: object) -> None:
    raise OutOfTime("no answer in time")


def reason(read: Callable[[str], None], file: str, seconds: int) -> str | None:
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        read(file)
        return None
    except Exception as error:  # whatever it raises, it has not read the file
        lines = str(error).strip().splitlines()
        return f"{type(error).__name__}: {lines[0] if lines else ''}"
    finally:
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_REAL, 0)


def main() -> None:
    logging.disable(logging.CRITICAL)
    read = READERS[sys.argv[1]]()
    for line in sys.stdin:
        with contextlib.redirect_stdout(io.StringIO()):
            said = reason(read, line.rstrip("\n"), int(sys.argv[2]))
        print(json.dumps(said), flush=True)


if __name__ == "__main__":
    main()
