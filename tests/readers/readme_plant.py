"""Do what the README's chapters about commissioning say, from an empty folder, and put every DCF through lely's dcfchk.

    readme_plant.py --odgen FILE [--readme FILE]

The files and the commands are the README's own: what is between its marks. A command that fails, or says anything on
standard error, is a complaint; so is what dcfchk says of a DCF.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from compare import Job
from lely_dcfchk import dcfchk

ROOT = Path(__file__).resolve().parent.parent.parent
FILES = {"spec": "valve.od.yaml", "parameters": "valve-5.yaml", "plant": "plant.yaml"}
"""What is between marks of the README, and the name that its text gives it."""
COMMANDS = ("node-commands", "plant-commands")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", required=True, type=Path)
    parser.add_argument("--readme", type=Path, default=ROOT / "README.md")
    arguments = parser.parse_args()
    odgen = arguments.odgen.resolve()
    readme = arguments.readme.read_text(encoding="utf-8")
    complaints = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name, "valves")
        folder.mkdir()
        programs = Path(name, "bin")
        programs.mkdir()
        programs.joinpath("odgen").symlink_to(odgen)
        for mark, file in FILES.items():
            if f"`{file}`" not in readme:
                complaints.append(f"README.md does not call anything `{file}`")
            (folder / file).write_text(fenced(between(readme, mark)), encoding="utf-8")
        commands = [line for mark in COMMANDS for line in lines(between(readme, mark))]
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
    print(f"{len(commands)} commands of the README, {len(dcfs)} DCF files: {len(complaints)} complaints")
    return 1 if complaints or len(commands) < 8 else 0


def between(readme: str, mark: str) -> str:
    found = re.search(rf"<!-- {mark} -->\n(.*?)<!-- /{mark} -->", readme, re.DOTALL)
    assert found, f"README.md has no {mark}"
    return found.group(1)


def fenced(block: str) -> str:
    found = re.search(r"```yaml\n(.*?)```", block, re.DOTALL)
    assert found, block
    return found.group(1)


def lines(block: str) -> list[str]:
    """The commands, as a person copies them: the remark after each is one for the shell, too."""
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
