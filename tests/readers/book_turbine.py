"""Do what the book's chapter about the turbine shows, and compare every screen with it.

    book_turbine.py --odgen FILE [--mend]

The commands, the program for python-canopen and the screens are those of the page: what is between its marks. Only the port is another
one, that `odgen serve` finds free, and the program has more patience with a busy machine. With `--mend` the page gets the screens of this run, to be read before they are kept.
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from patience import PATIENCE
from book_plant import BOOK, ROOT, between

PORT = 3333
"""The port that the page has."""
PAGE = BOOK / "guides" / "operator.md"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", required=True, type=Path)
    parser.add_argument("--mend", action="store_true")
    arguments = parser.parse_args()
    began = time.monotonic()
    page = PAGE.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        screens = Desk(Path(name), arguments.odgen.resolve(), page).screens()
    complaints, commands = [], 0
    for mark, screen in screens.items():
        shown = between(page, mark)
        commands += sum(line.startswith("$ ") for line in shown.splitlines())
        if shown != screen:
            complaints.append(f"{mark}: the page shows\n{shown}but it is\n{screen}")
            page = page.replace(f"<!-- {mark} -->\n```text\n{shown}", f"<!-- {mark} -->\n```text\n{screen}")
    if arguments.mend:
        PAGE.write_text(page, encoding="utf-8")
    for complaint in complaints:
        print(complaint)
    print(f"a turbine on the desk: {commands} commands of the book, {len(complaints)} screens differ, {time.monotonic() - began:.1f} s")
    print(f"{len(screens) - len(complaints)} passed, {len(complaints)} failed")
    return 1 if complaints or commands < 7 else 0


class Desk:
    """A folder that looks as the repository does, and programs of the names that the page uses."""

    def __init__(self, folder: Path, odgen: Path, page: str) -> None:
        self.page = page
        self.folder = folder / "repository"
        self.folder.mkdir()
        for part in ("od-spec", "generated"):
            (self.folder / part).symlink_to(ROOT / part)
        self.odgen = odgen
        self.programs = folder / "bin"
        self.programs.mkdir()
        self.take_port(0)
        program(self.programs / "python3", f'exec {shlex.quote(sys.executable)} "$@"')
        path = f"{self.programs}{os.pathsep}{os.environ.get('PATH', '')}"
        modules = str(Path(__file__).parent)
        self.environment = {**os.environ, "PATH": path, "PYTHONUNBUFFERED": "1", "PYTHONPATH": modules}

    def take_port(self, port: int) -> None:
        """Lets the programs use a port, 0 one that is free."""
        self.port = port
        program(self.programs / "odgen", f'exec {shlex.quote(str(self.odgen))} "$@" --slcan tcp:127.0.0.1:{port}')
        assert "`blade_b.py`" in self.page
        script = between(self.page, "turbine-python")
        text = f"import patience\n{script.replace(str(PORT), str(port))}"
        self.folder.joinpath("blade_b.py").write_text(text, encoding="utf-8")

    def screens(self) -> dict[str, str]:
        """What a user sees, by the mark of the page."""
        (command,) = self.commands("turbine-serve")
        serving = subprocess.Popen(
            ["sh", "-c", f"exec {command}"], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, text=True
        )
        assert serving.stdout
        try:
            line = serving.stdout.readline()
            self.take_port(int(line.rsplit(":", 1)[1]))
            screens = {"turbine-serve": self.screen(command, line)}
            for mark in ("turbine-keep", "turbine-master"):
                screens[mark] = "".join(self.screen(one, self.said(one)) for one in self.commands(mark))
        finally:
            serving.kill()
            serving.wait(timeout=PATIENCE)
        return screens

    def commands(self, mark: str) -> list[str]:
        lines = between(self.page, mark).splitlines()
        return [line.removeprefix("$ ") for line in lines if line.startswith("$ ")]

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
            timeout=10 * PATIENCE,
        )
        return done.stdout

    def screen(self, command: str, said: str) -> str:
        return f"$ {command}\n{said.replace(str(self.port), str(PORT))}"


def program(path: Path, text: str) -> None:
    path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    path.chmod(0o755)


if __name__ == "__main__":
    sys.exit(main())
