"""Do what the book's guide to nodes and plants shows, from an empty folder, and put every DCF through lely's dcfchk.

    book_plant.py --odgen FILE

The files and the commands are those of the page: what is between its marks. A command that fails, or prints anything on
standard error, is a complaint; so is what dcfchk prints about a DCF.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from compare import Job
from lely_dcfchk import dcfchk

ROOT = Path(__file__).resolve().parent.parent.parent
BOOK = ROOT / "docs" / "book"
FILES = {"parameters": "valve-5.yaml", "plant": "plant.yaml"}
"""What is between marks of the page, and the name that its text gives it."""
COMMANDS = ("node-commands", "plant-commands")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", required=True, type=Path)
    arguments = parser.parse_args()
    odgen = arguments.odgen.resolve()
    page = (BOOK / "guides" / "plant.md").read_text(encoding="utf-8")
    complaints = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name, "valves")
        folder.mkdir()
        programs = Path(name, "bin")
        programs.mkdir()
        programs.joinpath("odgen").symlink_to(odgen)
        shutil.copy(ROOT / "tests" / "book" / "valve.od.yaml", folder)
        for file in ("valve.od.yaml", *FILES.values()):
            if f"`{file}`" not in page:
                complaints.append(f"the page does not call anything `{file}`")
        for mark, file in FILES.items():
            (folder / file).write_text(between(page, mark), encoding="utf-8")
        commands = [line for mark in COMMANDS for line in lines(between(page, mark))]
        for command in commands:
            complaints += run(command, folder, programs)
        dcfs = sorted(folder.rglob("*.dcf"))
        # One of a single node, and two of each of two hundred presses.
        if len(dcfs) != 401:
            complaints.append(f"{len(dcfs)} DCF files, and not 401")
        for path in dcfs:
            complaints += [f"{path.relative_to(folder)}: {said}" for said in dcfchk(Job(path, node_of(path), None))]
    for complaint in complaints:
        print(complaint)
    print(f"{len(commands)} commands of the book, {len(dcfs)} DCF files: {len(complaints)} complaints")
    return 1 if complaints or len(commands) < 8 else 0


def between(page: str, mark: str) -> str:
    """The block of code between the marks."""
    found = re.search(rf"<!-- {mark} -->\n```\w+\n(.*?)```\n<!-- /{mark} -->", page, re.DOTALL)
    assert found, f"there is no {mark}"
    return found.group(1)


def lines(block: str) -> list[str]:
    """The commands, as a user copies them: the remark after each is one for the shell, too."""
    return [line.strip() for line in block.splitlines() if line.strip()]


def run(command: str, folder: Path, programs: Path) -> list[str]:
    environment = {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ.get('PATH', '')}"}
    done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, check=False)
    said = done.stderr.strip()
    return [f"{command}: exit code {done.returncode}: {said}"] if done.returncode or said else []


def node_of(path: Path) -> int:
    """The node-ID that the file states."""
    found = re.search(r"(?m)^NodeID=(\d+|0x[0-9A-Fa-f]+)\r?$", path.read_text(encoding="ascii"))
    return int(found.group(1), 0) if found else 1


if __name__ == "__main__":
    sys.exit(main())
