#!/usr/bin/env python3
"""Count the instructions that odgen takes: the same in every run, whatever else the machine does.

    instructions.py [--odgen FILE ...] [--growth] [--numbers 300 600 1200] [--only TEXT]

Needs valgrind (its tool callgrind counts). Several programs are counted side by side, such as one from before a change. With
--growth it takes specifications that hold something many times (`cargo run -p od-tests --bin patterns`), at three sizes, and
the exit code is 1 where the work grows faster than the size.
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

import synthetic

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PITCH = ROOT / "od-spec" / "devices" / "pitch-control-system.od.yaml"
COLLECTED = re.compile(r"Collected : (\d+)")
# Sorted maps cost a little more for each of many; a square would be 4.
MOST = 2.3
# Below, the growth says nothing: it is lost in what every run does.
LEAST = 3_000_000


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path, nargs="+", help="the programs; without it, one is built with cargo")
    parser.add_argument("--growth", action="store_true", help="how the work grows, instead of how much it is")
    parser.add_argument("--numbers", type=int, nargs=3, default=[300, 600, 1200])
    parser.add_argument("--only", default="", help="patterns with this in their names")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        print("error: valgrind is missing", file=sys.stderr)
        return 1
    programs = [path.resolve() for path in options.odgen or [built()]]
    with tempfile.TemporaryDirectory(prefix="odgen-instructions-") as folder:
        work = Path(folder)
        return growth(programs[0], work, options) if options.growth else amounts(programs, work)


def built() -> Path:
    subprocess.run([os.environ.get("CARGO", "cargo"), "build", "--release", "--quiet", "-p", "odgen"], cwd=ROOT, check=True)
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "odgen"


def count(command: list[str]) -> int:
    """The instructions of a process. That a check finds something is no failure."""
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command],
        check=False,
        text=True,
        errors="replace",
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    found = COLLECTED.search(done.stderr)
    if not found:
        raise SystemExit(f"error: {' '.join(command)} was not counted: {done.stderr[-400:]}")
    return int(found[1])


def amounts(programs: list[Path], work: Path) -> int:
    specs = {"pitch system": PITCH}
    for size in (150, 2000, 10000):
        path = work / f"synthetic-{size}.od.yaml"
        path.write_text(synthetic.specification(size), encoding="utf-8")
        specs[f"{size} objects"] = path
    print("| command | " + " | ".join(f"{path} M" if len(programs) > 1 else "M instructions" for path in programs) + " |")
    print("|---|" + "--:|" * len(programs))
    for name, spec in specs.items():
        for words in ("check", "build", "docs"):
            row = []
            for program in programs:
                out = work / "out"
                shutil.rmtree(out, ignore_errors=True)
                command = [str(program), words, str(spec)] + ([] if words == "check" else ["--out", str(out)])
                row.append(f"{count(command) / 1e6:.0f}")
            print(f"| odgen {words}, {name} | " + " | ".join(row) + " |", flush=True)
    return 0


def growth(program: Path, work: Path, options: argparse.Namespace) -> int:
    cargo = os.environ.get("CARGO", "cargo")
    command = [cargo, "run", "--quiet", "-p", "od-tests", "--bin", "patterns", "--", str(work)]
    subprocess.run([*command, *map(str, options.numbers)], cwd=ROOT, check=True)
    names = sorted({path.name.split(".")[0] for path in work.glob("*.od.yaml")})
    faster = 0
    print("| pattern | " + " | ".join(f"{n}, M" for n in options.numbers) + " | growth |\n|---|--:|--:|--:|--:|")
    for name in (name for name in names if options.only in name):
        one, two, four = (count([str(program), "check", str(work / f"{name}.{n}.od.yaml")]) for n in options.numbers)
        # What every run does is in all three.
        ratio = (four - two) / max(two - one, 1)
        is_faster = ratio > MOST and four - two > LEAST
        faster += is_faster
        shown = " | ".join(f"{number / 1e6:.1f}" for number in (one, two, four))
        print(f"| {name} | {shown} | {ratio:.2f}{' **faster than the size**' if is_faster else ''} |", flush=True)
    return 1 if faster else 0


if __name__ == "__main__":
    sys.exit(main())
