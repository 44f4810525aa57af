#!/usr/bin/env python3
"""Which of five readers accept which EDS and DCF files, and why not.

    verdicts.py FOLDER [--out CACHE]

Prints, for every .eds and .dcf file of FOLDER, what each reader says: null where it accepts the file, else the
first line of its reason. A file is refused

* by python-canopen, when `canopen.import_od(file, node_id=5)` raises;
* by dcfchk, when `dcfchk -n 5 FILE` ends with another code than 0: its lint found a fault, or its reader raised.
  What it only warns of, such as a vendor-ID that differs from the identity object's, is no refusal;
* by eds-utils, when `read_eds(file)` raises; what it lists as corrected by itself is no refusal;
* by node-canopen, when `Eds.fromFile(file)` throws;
* by canopen-host, when `Eds::from_file` is an error.

A reader that needs more than LIMIT seconds for a file, or whose process dies of it, refuses it as well.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from run import HERE, ROOT, Reader, installed

LIMIT = 20
Verdicts = dict[str, dict[str, "str | None"]]


def files_in(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.suffix.lower() in (".eds", ".dcf"))


def batch(reader: Reader) -> list[str]:
    """The command that reads file names, a line each, and answers each with a line of JSON."""
    if reader.name == "node-canopen":
        return ["node", str(HERE / "accepts.js"), reader.options[-1]]
    if reader.name == "canopen-host":
        return [reader.options[-1], "--accepts"]
    return [reader.command[0], str(HERE / "accepts.py"), reader.name, str(LIMIT)]


def said_by(reader: Reader, files: list[Path]) -> dict[str, str | None]:
    """What a reader says of each file: one process for all, and another for the rest where it dies."""
    said: dict[str, str | None] = {}
    # the readers open files in the encoding of the locale
    environment = {**os.environ, "PYTHONUTF8": "1", "PYTHONWARNINGS": "ignore"}
    rest = files
    while rest:
        names = "".join(f"{file}\n" for file in rest)
        seconds = LIMIT + len(rest)
        try:
            done = subprocess.run(
                batch(reader), input=names, capture_output=True, text=True, encoding="utf-8", env=environment,
                timeout=seconds, check=False,
            )
            answers, end = done.stdout, f"the process ended with code {done.returncode}"
        except subprocess.TimeoutExpired as stopped:
            answers, end = (stopped.stdout or b"").decode(), "no answer in time"
        answered = [json.loads(line) for line in answers.splitlines()]
        said |= {file.name: reason for file, reason in zip(rest, answered)}
        rest = rest[len(answered):]
        if rest:
            said[rest[0].name] = end
            rest = rest[1:]
    return said


def verdicts(files: Iterable[Path], readers: list[Reader]) -> Verdicts:
    """What the readers say of files: by file, then by reader."""
    ordered = list(files)
    by_reader = {reader.name: said_by(reader, ordered) for reader in readers}
    return {
        file.name: {name: said[file.name] for name, said in by_reader.items()} for file in ordered
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "readers", help="cache of the tools")
    args = parser.parse_args()
    readers, missing = installed(args.out.resolve())
    for name, reason in missing.items():
        print(f"{name} was not asked: {reason}", file=sys.stderr)
    json.dump(verdicts(files_in(args.folder), readers), sys.stdout, indent=1)
    return 3 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
