#!/usr/bin/env python3
"""Try the firmware that `odgen new --firmware` writes: build it as its user does, run it in QEMU, be its master.

    starter.py [--odgen target/debug/odgen] [--sample]

The project in plain C is built by its Makefile and started by the line of its `make run`, that in Rust by the runner of its
.cargo/config.toml; both answer `odgen node`: entries are read, one is written, and what cannot be stored is refused. The main
program for CANopenNode is compiled with the flags and sources of its sources.mk, against the headers of the tests, which declare
what it takes from the stack. With --sample, the project in Rust is left out.

Exit codes as those of run.py.
"""

from __future__ import annotations

import argparse
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import run
from demo import running

DEVICE, NODE = "my-fan", "5"
SPECIFICATION = f"{DEVICE}.od.yaml"
UART = "tcp:127.0.0.1:3333,server=on,wait=off,nodelay=on"  # of the projects; the test has one of its own
STACK = run.ROOT / "tests" / "c" / "canopennode"
TARGET = run.ROOT / "target" / "starter"  # what is built of Rust is kept
PATIENCE = "60000"  # ms for an answer

INSTALL_MAKE = "make is not there; install\n  apt-get install make   (Debian)"

# A command of `odgen node`, its exit code, and what it prints, in order.
DIALOGUE: list[tuple[list[str], int, list[str]]] = [
    (["read", "1000", "1018.1"], 0, [r"1000h Device type = .*\[00 00 00 00\]", r"1018h\.1 .*Vendor-ID = .*\[00 00 00 00\]"]),
    (["read", "target temperature", "mode"], 0, [r"2003h target temperature = 20\.0 °C", r"2001h mode = off"]),
    (["write", "--yes", "target temperature=22.5 °C"], 0, [r"20\.0 °C → 22\.5 °C", r"22\.5 °C .*written"]),
    (["read", "target temperature"], 0, [r"2003h target temperature = 22\.5 °C"]),
    # More than the node takes, and what it has no memory for.
    (["write", "--yes", "--force", "target temperature=70.0 °C"], 1, [r"0609 0031h"]),
    (["store", "--yes"], 1, [r"0800 0020h"]),
    (["load-defaults", "--yes"], 1, [r"0800 0020h"]),
    (["read", "target temperature"], 0, [r"2003h target temperature = 22\.5 °C"]),
]


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path, default=run.ROOT / "target" / "debug" / "odgen")
    parser.add_argument("--sample", action="store_true", help="without the project in Rust, which compiles od-gen once more")
    options = parser.parse_args()
    odgen = options.odgen.resolve()
    failures = []
    try:
        for tool, missing in [(run.QEMU, run.INSTALL_QEMU), ("make", INSTALL_MAKE)]:
            if not shutil.which(tool):
                raise run.Missing(missing)
        tried = {"c": in_c, "canopennode": with_stack} | ({} if options.sample else {"rust": in_rust})
        for firmware, part in tried.items():
            begin = time.monotonic()
            with tempfile.TemporaryDirectory() as folder:
                glue = ["--glue", str(run.ROOT)] if firmware == "rust" else []
                printed([str(odgen), "new", DEVICE, "--firmware", firmware, *glue], Path(folder))
                failure = part(odgen, Path(folder, DEVICE))
            print(f"{firmware}: {failure or 'as expected'}, {time.monotonic() - begin:.1f} s", flush=True)
            failures += [firmware] if failure else []
    except (run.Failed, run.Missing) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3 if isinstance(error, run.Missing) else 1
    print(f"{len(tried) - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


def printed(command: list[str], folder: Path, environment: dict[str, str] | None = None) -> str:
    """What a command prints that has to end well."""
    done = subprocess.run(
        command, check=False, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8"
    )
    if done.returncode != 0:
        raise run.Failed(f"{shlex.join(command)} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def in_c(odgen: Path, project: Path) -> str:
    make = ["make", f"ODGEN={odgen}"]
    warnings = [line for line in printed([*make, "-j2"], project).splitlines() if ": warning: " in line]
    started = printed([*make, "--dry-run", "run"], project).splitlines()
    lacking = subprocess.run(
        [*make, "--always-make", "LINKER=", "COMPILER=true"], check=False, cwd=project, text=True, capture_output=True
    )
    if "arm-none-eabi-gcc" not in started[-1] and "no linker for a Cortex-M" not in lacking.stderr:
        return f"says nothing of a linker that is missing:\n{lacking.stderr}"
    return "\n".join(warnings) or answers(odgen, project, shlex.split(started[-1]))


def in_rust(odgen: Path, project: Path) -> str:
    toolchain = run.find_toolchain()
    environment = {**toolchain.environment, "CARGO_TARGET_DIR": str(TARGET)}
    printed([toolchain.cargo, "build", "--release", *toolchain.flags], project, environment)
    config = (project / ".cargo" / "config.toml").read_text(encoding="utf-8")
    (runner,) = re.findall(r'^runner = "(.*)"$', config, re.MULTILINE)
    program = TARGET / run.TARGET / "release" / DEVICE
    return answers(odgen, project, [*shlex.split(runner), str(program)])


def answers(odgen: Path, project: Path, command: list[str]) -> str:
    """What is wrong with the answers of the node that a command starts."""
    at = command.index("-serial")
    if command[at + 1] != UART:
        return f"its UART is {command[at + 1]}, not {UART}"
    program = project / command[-1]
    with running([*command[:at], *command[at + 2 : -1], str(program)]) as board:
        for arguments, code, expected in DIALOGUE:
            verb, *rest = arguments
            link = ["--node", NODE, "--slcan", f"tcp:{board.address}", "--timeout", PATIENCE]
            whole = [str(odgen), "node", verb, SPECIFICATION, *link, *rest]
            done = subprocess.run(whole, check=False, cwd=project, text=True, capture_output=True, encoding="utf-8")
            said = done.stdout + done.stderr
            if done.returncode != code or not re.search(".*".join(expected), said, re.DOTALL):
                return f"`odgen node {shlex.join(arguments)}` ended with {done.returncode}, expected {code}, {expected}:\n{said}"
    return ""


def with_stack(odgen: Path, project: Path) -> str:
    lists = "include sources.mk\nlists:\n\t@echo $(CANOPEN_FLAGS)\n\t@echo $(CANOPEN_SOURCES)\n"
    (project / "Makefile").write_text(lists, encoding="utf-8")
    make = ["make", f"ODGEN={odgen}", f"CANOPENNODE={STACK}"]
    printed([*make, "dictionary"], project)
    flags, sources = (shlex.split(line) for line in printed([*make, "lists"], project).splitlines())
    ours = [source for source in sources if not source.startswith(str(STACK))]
    for source in ours:
        printed(["clang", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *flags, source], project)
    expected = ["main.c", *(f"generated/c/my_fan/OD{ending}.c" for ending in ("", "_extension", "_rules"))]
    return "" if ours == expected else f"it compiles {ours}, expected {expected}"


if __name__ == "__main__":
    sys.exit(main())
