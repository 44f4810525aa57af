"""Do what the README's chapter about the turbine says, and compare every screen with what it shows.

    readme_turbine.py --odgen FILE [--readme FILE] [--mend]

The commands, the program for python-canopen and the screens are the README's own: what stands between its marks. Only the port is another
one, that nothing else on this machine listens to. With `--mend` the README gets the screens of this run, to be read before they are kept.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from readme_plant import ROOT, between

PORT = 3333
"""The port that the README has."""


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", required=True, type=Path)
    parser.add_argument("--readme", type=Path, default=ROOT / "README.md")
    parser.add_argument("--mend", action="store_true")
    arguments = parser.parse_args()
    began = time.monotonic()
    readme = arguments.readme.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        screens = Desk(Path(name), arguments.odgen.resolve(), readme).screens()
    complaints, commands = [], 0
    for mark, screen in screens.items():
        shown = between(readme, mark)
        commands += shown.count("    $ ")
        if shown != screen:
            complaints.append(f"{mark}: README.md shows\n{shown}but it is\n{screen}")
            readme = readme.replace(f"<!-- {mark} -->\n{shown}", f"<!-- {mark} -->\n{screen}")
    if arguments.mend:
        arguments.readme.write_text(readme, encoding="utf-8")
    for complaint in complaints:
        print(complaint)
    print(f"a turbine on the desk: {commands} commands of the README, {len(complaints)} screens differ, {time.monotonic() - began:.1f} s")
    print(f"{len(screens) - len(complaints)} passed, {len(complaints)} failed")
    return 1 if complaints or commands < 7 else 0


class Desk:
    """A folder that looks as the repository does, and programs of the names that the README uses."""

    def __init__(self, folder: Path, odgen: Path, readme: str) -> None:
        self.readme = readme
        self.folder = folder / "repository"
        self.folder.mkdir()
        for part in ("od-spec", "generated"):
            (self.folder / part).symlink_to(ROOT / part)
        self.port = free_port()
        programs = folder / "bin"
        programs.mkdir()
        at = f"tcp:127.0.0.1:{self.port}"
        program(programs / "odgen", f'exec {shlex.quote(str(odgen))} "$@" --slcan {at}')
        program(programs / "python3", f'exec {shlex.quote(sys.executable)} "$@"')
        path = f"{programs}{os.pathsep}{os.environ.get('PATH', '')}"
        self.environment = {**os.environ, "PATH": path, "PYTHONUNBUFFERED": "1"}
        script = re.search(r"```python\n(.*?)```", between(readme, "turbine-python"), re.DOTALL)
        assert script and "`blade_b.py`" in readme
        self.folder.joinpath("blade_b.py").write_text(script[1].replace(str(PORT), str(self.port)), encoding="utf-8")

    def screens(self) -> dict[str, str]:
        """What a person sees, by the mark of the README."""
        (command,) = self.commands("turbine-serve")
        serving = subprocess.Popen(
            ["sh", "-c", f"exec {command}"], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, text=True
        )
        assert serving.stdout
        try:
            line = serving.stdout.readline()
            screens = {"turbine-serve": self.screen(command, line)}
            for mark in ("turbine-keep", "turbine-master"):
                screens[mark] = "".join(self.screen(one, self.said(one)) for one in self.commands(mark))
        finally:
            serving.kill()
            serving.wait(timeout=10)
        return screens

    def commands(self, mark: str) -> list[str]:
        lines = between(self.readme, mark).splitlines()
        return [line.removeprefix("    $ ") for line in lines if line.startswith("    $ ")]

    def said(self, command: str) -> str:
        """What a command says on either channel."""
        done = subprocess.run(
            ["sh", "-c", command],
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            timeout=120,
        )
        return done.stdout

    def screen(self, command: str, said: str) -> str:
        lines = [f"$ {command}", *said.replace(str(self.port), str(PORT)).splitlines()]
        return "".join(f"    {line}\n" if line else "\n" for line in lines)


def program(path: Path, text: str) -> None:
    path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    path.chmod(0o755)


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


if __name__ == "__main__":
    sys.exit(main())
