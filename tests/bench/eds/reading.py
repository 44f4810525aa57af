#!/usr/bin/env python3
"""Measure how long it takes to read, check, convert and import an EDS, compared with other readers.

    reading.py [--sizes 150 1500 10000] [--wide 10000 60000] [--passes 3] [--rounds 7] [--budget 2] [--cache target/bench]
               [--program FILE] [--python FILE]

Prints Markdown. The times are taken inside the processes, from the bytes of a file in memory to the result; what it takes to
start a program, or to read the disk, is not among them. In each pass every program gets every file in turn. Nothing is judged:
the exit code is 0 when everything could be run, 1 when something failed, 3 when a reader could not be installed.
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import run as whole_processes  # noqa: E402
import synthetic  # noqa: E402
import wide  # noqa: E402
from run import EXE, ROOT, Failed, output  # noqa: E402

# A reader of lines compared with the readers of others; the steps that take far longer have rounds of their own.
SLOW = ["model", "check", "convert", "import"]
OWN = ["parse", *SLOW]
RUST = ["rust-ini", "canopen-host", "canopen_rust"]
PYTHON = "python-canopen"
GOAL_SIZE, GOAL_SECONDS = 10000, 0.005


@dataclass
class File:
    """A file, and what was measured with it."""

    name: str
    path: Path
    bytes: int = 0
    entries: int = 0
    seconds: dict[str, list[float]] = field(default_factory=dict)
    kilobytes: dict[str, int] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        data = self.path.read_bytes()
        self.bytes, self.entries = len(data), data.count(b"\nDataType=")

    def least(self, step: str) -> float | None:
        return min(self.seconds[step]) if step in self.seconds else None


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--sizes", type=int, nargs="*", default=[150, 1500, GOAL_SIZE], help="objects of a synthetic specification")
    parser.add_argument("--wide", type=int, nargs="*", default=[10000, 60000], help="members of wide records, multiples of 250")
    parser.add_argument("--passes", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=7, help="of each pass")
    parser.add_argument("--budget", type=float, default=2, help="seconds for one program, file and pass; but one round is run")
    parser.add_argument("--cache", type=Path, default=ROOT / "target" / "bench", help="where programs are built and installed")
    parser.add_argument("--program", type=Path, help="the program in `peer`; without it, it is built with cargo")
    parser.add_argument("--python", type=Path, help="a Python that has python-canopen; without it, one is installed")
    options = parser.parse_args()
    missing: list[str] = []
    try:
        program = (options.program or built(options.cache.resolve())).resolve()
        try:
            python = options.python or installed(options.cache.resolve())
        except Failed as error:
            python = None
            missing.append(str(error))
        with tempfile.TemporaryDirectory(prefix="odgen-bench-") as folder:
            files = list(made(program, Path(folder), options.sizes, options.wide))
            for file in files:
                look(program, file)
            for _ in range(options.passes):
                for file in files:
                    measure(program, python, file, options.rounds, options.budget)
        print(report(files, missing))
    except Failed as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 3 if missing else 0


def built(cache: Path) -> Path:
    target = cache / "eds"
    cargo = os.environ.get("CARGO", "cargo")
    output([cargo, "build", "--release", "--quiet", "--locked", "--target-dir", str(target)], HERE / "peer")
    return target / "release" / f"read-eds{EXE}"


def installed(cache: Path) -> Path:
    whole_processes.python_tools(cache)
    return cache / "venv" / ("Scripts" if sys.platform == "win32" else "bin") / f"python{EXE}"


def made(program: Path, folder: Path, sizes: list[int], wides: list[int]) -> Iterable[File]:
    for size in sizes:
        spec, eds = folder / f"{size}.od.yaml", folder / f"{size}.eds"
        spec.write_text(synthetic.specification(size), encoding="utf-8", newline="\n")
        output([str(program), "make", str(spec), str(eds)])
        yield File(f"{size:,} objects", eds)
        plain = folder / f"{size}-plain.eds"
        lines = eds.read_bytes().splitlines(keepends=True)
        plain.write_bytes(b"".join(line for line in lines if not line.startswith(b";")))
        yield File(f"{size:,} objects, no comments", plain)
    for entries in wides:
        eds = folder / f"wide-{entries}.eds"
        eds.write_bytes(wide.eds(entries, eds.name).encode("ascii"))
        yield File(f"{entries:,} members of records", eds)


def look(program: Path, file: File) -> None:
    """What each step needs of memory, each in a process of its own; and who cannot read the file."""
    for step in [*OWN, *RUST]:
        try:
            kilobytes = output([str(program), "once", str(file.path), step])
        except Failed as error:
            if step in OWN:
                raise
            file.refused[step] = str(error).rsplit(": ", 1)[-1]
            continue
        if kilobytes:
            file.kilobytes[step] = int(kilobytes)


def measure(program: Path, python: Path | None, file: File, rounds: int, budget: float) -> None:
    quick = [step for step in ["parse", *RUST] if step not in file.refused]
    for steps in (quick, SLOW):
        repeat(lambda count, steps=steps: [str(program), "time", str(file.path), str(count), *steps], file, rounds, budget)
    if python:
        script = str(HERE / "python_canopen.py")
        repeat(lambda count: [str(python), script, str(file.path), str(count)], file, rounds, budget)


def repeat(command: Callable[[int], list[str]], file: File, rounds: int, budget: float) -> None:
    """One round, and as many more as there is time for."""
    first = take(command(1), file)
    more = min(rounds - 1, int(budget / first) - 1)
    if more > 0:
        take(command(more), file)
    print(f"{file.name}: {first:.3f} s a round, {max(more, 0) + 1} rounds", file=sys.stderr)


def take(command: list[str], file: File) -> float:
    """Keeps the times that a program prints; their sum."""
    total = 0.0
    for line in output(command).splitlines():
        step, seconds = line.split()
        file.seconds.setdefault(step, []).append(float(seconds))
        total += float(seconds)
    return total


def report(files: list[File], missing: list[str]) -> str:
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    steps = [*OWN, *RUST, PYTHON]
    lines = [machine, "", "Minimum in ms, and the median in brackets:", ""]
    lines += table(["file", "MB", "entries", *steps], (
        [file.name, f"{file.bytes / 1e6:.2f}", f"{file.entries:,}", *(times(file, step) for step in steps)] for file in files
    ))
    lines += ["", "How many times the minimum of `parse`, and after the bar of `model`, the readers of others take:", ""]
    others = [*RUST, PYTHON]
    lines += table(["file", *others], ([file.name, *(ratios(file, step) for step in others)] for file in files))
    lines += ["", "Peak memory of a process that does one step, in MB, and as a multiple of the file:", ""]
    measured = [*OWN, *RUST]
    lines += table(["file", *measured], ([file.name, *(memory(file, step) for step in measured)] for file in files))
    lines += ["", "Nanoseconds for a byte, of the minimum; where they stay the same, the time grows with the size:", ""]
    lines += table(["file", *steps], ([file.name, *(per_byte(file, step) for step in steps)] for file in files))
    lines += [""] + [f"{step} does not read {file.name}: {reason}." for file in files for step, reason in file.refused.items()]
    lines += (f"Not measured: {reason}." for reason in missing)
    for file in files:
        if file.name.startswith(f"{GOAL_SIZE:,} objects"):
            least = min(file.seconds["parse"])
            met = "met" if least < GOAL_SECONDS else "not met"
            lines.append(f"Goal: parse of {file.name} ({file.bytes / 1e6:.2f} MB) in less than {1000 * GOAL_SECONDS:.0f} ms: {1000 * least:.2f} ms, {met}.")
    return "\n".join(lines)


def table(head: list[str], rows: Iterable[list[str]]) -> list[str]:
    lines = [head, ["---", *("--:" for _ in head[1:])], *rows]
    return [f"| {' | '.join(cells)} |" for cells in lines]


def times(file: File, step: str) -> str:
    if step not in file.seconds:
        return "–"
    return f"{1000 * min(file.seconds[step]):.2f} ({1000 * statistics.median(file.seconds[step]):.2f})"


def ratios(file: File, step: str) -> str:
    least = file.least(step)
    return "–" if least is None else f"{least / min(file.seconds['parse']):.1f} / {least / min(file.seconds['model']):.2f}"


def memory(file: File, step: str) -> str:
    kilobytes = file.kilobytes.get(step)
    return "–" if kilobytes is None else f"{kilobytes / 1024:.0f} ({kilobytes * 1024 / file.bytes:.1f})"


def per_byte(file: File, step: str) -> str:
    least = file.least(step)
    return "–" if least is None else f"{1e9 * least / file.bytes:.1f}"


if __name__ == "__main__":
    sys.exit(main())
