#!/usr/bin/env python3
"""Answer the question of `odgen node write` and `restore` at a terminal: only `y` and `yes` change nodes.

    confirmed.py --odgen target/debug/odgen

A machine is asked for once. Exit code 1 when an answer does something else.
"""

from __future__ import annotations

import argparse
import os
import pty
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

SPEC = Path("tests/book/valve.od.yaml").resolve()
INTERRUPTED = 130
# What is typed, the exit code, and what the nodes have afterwards. Ctrl-C ends the command before anything is sent.
ANSWERS = [
    ("n\n", 1, "2.5"),
    ("\n", 1, "2.5"),
    ("\x04", 1, "2.5"),
    ("\x03", INTERRUPTED, "2.5"),
    ("y\n", 0, "6.0"),
    ("yes\n", 0, "6.0"),
]
PLANT = f"""\
od-plant: 1
title: Two valves
devices: {{valve: {SPEC}}}
types: {{pair: {{bit-rate: 125, positions: {{left: {{valve: 5}}, right: {{valve: 6}}}}}}}}
sites: {{Here: {{type: pair, machines: {{1: {{}}}}}}}}
"""
VALUES = "od-parameters: 1\nparameters: {set pressure: 6.0 bar}\n"


def at_terminal(command: list[str], typed: str) -> tuple[int, str]:
    """Runs a command at a terminal and types an answer to its question."""
    child, terminal = pty.fork()
    if child == 0:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # A shell that runs this in the background has it ignored.
        os.execv(command[0], command)
    shown = b""
    while b"[y/N] " not in shown:
        shown += os.read(terminal, 1000)
    os.write(terminal, typed.encode())
    try:
        while more := os.read(terminal, 1000):
            shown += more
            if shown.count(b"[y/N] ") > 1:
                os.kill(child, signal.SIGKILL)  # It asks again, and waits.
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
    with tempfile.TemporaryDirectory() as folder:
        plant = Path(folder, "plant.yaml")
        plant.write_text(PLANT, encoding="utf-8")
        kept = Path(folder, "kept")
        kept.mkdir()
        for name in ("left", "right"):
            Path(kept, f"{name}-valve.yaml").write_text(VALUES, encoding="utf-8")
        commands = [["write", str(SPEC), "--node", "5", "set pressure=6.0 bar"], ["restore", str(plant), str(kept)]]
        for command, nodes in zip(commands, (["5"], ["5", "6"])):
            for typed, code, expected in ANSWERS:
                serve = [odgen, "serve", str(plant), "--slcan", "tcp:127.0.0.1:0"]
                with subprocess.Popen(serve, stdout=subprocess.PIPE, text=True) as served:
                    assert served.stdout
                    place = ["--slcan", served.stdout.readline().split()[-1]]
                    ended, shown = at_terminal([odgen, "node", *command, *place], typed)
                    has = [held(odgen, node, place) for node in nodes]
                    served.kill()
                is_shown = shown.count("2.5 bar → 6.0 bar") == len(nodes) and shown.count("[y/N]") == 1
                is_shown &= (code == 0) != ("nothing was sent" in shown)
                if ended != code or not all(f"= {expected} bar" in one for one in has) or not is_shown:
                    problems.append(f"{command[0]} {typed!r}: exit code {ended}, nodes have {has}; shown was\n{shown}")
    print("\n".join(problems))
    print(f"questions at a terminal: {2 * len(ANSWERS)} answers, {len(problems)} problems")
    return 1 if problems else 0


def held(odgen: str, node: str, place: list[str]) -> str:
    """What a node has, as the command says it."""
    command = [odgen, "node", "read", str(SPEC), "--node", node, "set pressure", *place]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


if __name__ == "__main__":
    sys.exit(main())
