#!/usr/bin/env python3
"""Answer the question of `odgen node write` at a terminal: only `y` and `yes` change the node.

    confirmed.py --odgen target/debug/odgen

Exit code 1 when an answer does something else.
"""

from __future__ import annotations

import argparse
import os
import pty
import subprocess
import sys
from pathlib import Path

SPEC = Path("tests/readme/valve.od.yaml")
# What is typed, the exit code, and what the node has afterwards.
ANSWERS = [("n\n", 1, "2.5"), ("\n", 1, "2.5"), ("\x04", 1, "2.5"), ("y\n", 0, "6.0"), ("yes\n", 0, "6.0")]


def at_terminal(command: list[str], typed: str) -> tuple[int, str]:
    """Runs a command at a terminal and types an answer to its question."""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(command[0], command)
    shown = b""
    while b"[y/N] " not in shown:
        shown += os.read(terminal, 1000)
    os.write(terminal, typed.encode())
    try:
        while more := os.read(terminal, 1000):
            shown += more
    except OSError:
        pass  # The terminal ends with the command.
    _, status = os.waitpid(child, 0)
    os.close(terminal)
    return os.waitstatus_to_exitcode(status), shown.decode()


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--odgen", required=True, type=Path)
    odgen = str(arguments.parse_args().odgen.resolve())
    problems = []
    for typed, code, expected in ANSWERS:
        serve = [odgen, "serve", str(SPEC), "--node", "5", "--slcan", "tcp:127.0.0.1:0"]
        with subprocess.Popen(serve, stdout=subprocess.PIPE, text=True) as served:
            assert served.stdout
            place = ["--slcan", served.stdout.readline().split()[-1]]
            of_node = [str(SPEC), "--node", "5"]
            ended, shown = at_terminal([odgen, "node", "write", *of_node, "set pressure=6.0 bar", *place], typed)
            read = subprocess.run([odgen, "node", "read", *of_node, "set pressure", *place], capture_output=True, text=True, check=False)
            served.kill()
        if ended != code or f"= {expected} bar" not in read.stdout or "2.5 bar → 6.0 bar" not in shown:
            problems.append(f"{typed!r}: exit code {ended}, the node has {read.stdout!r}; shown was\n{shown}")
    print("\n".join(problems))
    print(f"questions at a terminal: {len(ANSWERS)} answers, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
