#!/usr/bin/env python3
"""Count the instructions that odgen takes: the same in every run, whatever else the machine does.

    instructions.py [--odgen FILE ...] [--readme] [--growth] [--numbers 300 600 1200] [--only TEXT]
    instructions.py --odgen FILE --held-to tests/bench/instructions.tsv [--write]

Needs valgrind (its tool callgrind counts). Several programs are counted side by side, such as one from before a change; with
--readme, the table goes into the README.md of its folder. With --growth it makes every output of specifications that hold
something many times (`cargo run -p od-tests --bin patterns`), at three sizes, and the exit code is 1 where the work grows faster
than the size; that takes an hour. With
--held-to it runs eight commands on small files, and the exit code is 1 where one takes 5 % more than the table says; --write
writes the table.
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
MARKED = re.compile("(<!-- instructions -->)\n.*?(<!-- /instructions -->)", re.DOTALL)
# Sorted maps cost a little more for each of many; a square would be 4.
MOST = 2.3
# Eight commands on a small device, each with the files that the ones before it made.
COMMANDS = {
    "check": ["check", "{spec}"],
    "build": ["build", "{spec}", "--out", "{out}"],
    "DCF": ["dcf", "{spec}", "--node", "5", "--out", "{out}-dcf"],
    "dump": ["dump", "{spec}"],
    "format": ["fmt", "--check", "{spec}"],
    "documents": ["docs", "{spec}", "--out", "{out}-docs"],
    "check of an EDS": ["check", "{eds}"],
    "check of mistakes": ["check", "{wrong}"],
}
# How the work for each of these grows.
OUTPUTS = {
    "messages": ["check", "{spec}"],
    "EDS and JSON": ["build", "{spec}", "--out", "{out}"],
    "XDD": ["build", "{spec}", "--xdd", "--out", "{out}"],
    "Rust": ["build", "{spec}", "--rust", "--out", "{out}"],
    "C": ["build", "{spec}", "--c", "plain", "--out", "{out}"],
    "C for CANopenNode": ["build", "{spec}", "--c", "canopennode", "--out", "{out}"],
    "Structured Text": ["st", "{spec}", "--out", "{out}"],
    "DBC": ["dbc", "{spec}", "--node", "1", "--out", "{out}.dbc"],
    "Markdown": ["docs", "{spec}", "--format", "md", "--out", "{out}"],
    "HTML": ["docs", "{spec}", "--format", "html", "--out", "{out}"],
    "paper": ["docs", "{spec}", "--format", "print", "--out", "{out}"],
    "layout": ["fmt", "--check", "{spec}"],
    "difference": ["diff", "{spec}", "{spec}"],
}
# So many times as many instructions as the table says are too many.
MOST_OF_TABLE = 1.05
# Below, the growth says nothing: it is lost in what every run does.
LEAST = 3_000_000


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path, nargs="+", help="the programs; without it, one is built with cargo")
    parser.add_argument("--growth", action="store_true", help="how the work grows, instead of how much it is")
    parser.add_argument("--numbers", type=int, nargs=3, default=[300, 600, 1200])
    parser.add_argument("--only", default="", help="patterns with this in their names")
    parser.add_argument("--readme", action="store_true", help="write the table into README.md")
    parser.add_argument("--held-to", type=Path, metavar="TABLE", help="compare eight commands with a table")
    parser.add_argument("--write", action="store_true", help="write the table instead")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        print("error: valgrind is missing", file=sys.stderr)
        return 1
    programs = [path.resolve() for path in options.odgen or [built()]]
    with tempfile.TemporaryDirectory(prefix="odgen-instructions-") as folder:
        work = Path(folder)
        if options.held_to:
            return held(programs[0], work, options)
        if options.growth:
            return growth(programs[0], work, options)
        rows = amounts(programs, work)
        if options.readme:
            readme = HERE / "README.md"
            text = readme.read_text(encoding="utf-8")
            readme.write_text(MARKED.sub(lambda found: "\n".join([found[1], *rows, found[2]]), text), encoding="utf-8")
        return 0


def held(program: Path, work: Path, options: argparse.Namespace) -> int:
    spec = work / "lamp.od.yaml"
    spec.write_text(synthetic.specification(10), encoding="utf-8")
    wrong = work / "wrong.od.yaml"
    wrong.write_text(spec.read_text(encoding="utf-8").replace("access: rw", "acces: rw"), encoding="utf-8")
    out = work / "out"
    table = {}
    if not options.write:
        rows = options.held_to.read_text(encoding="utf-8").splitlines()
        table = {name: int(number) for name, number in (row.split("\t") for row in rows if not row.startswith("#"))}
    failures, counted = 0, {}
    for name, words in COMMANDS.items():
        eds = next(iter(sorted(out.rglob("*.eds"))), out)
        places = {"spec": spec, "wrong": wrong, "eds": eds, "out": out}
        counted[name] = count([str(program), *(word.format(**places) for word in words)])
        if name not in table:
            continue
        ratio = counted[name] / table[name]
        is_more = ratio > MOST_OF_TABLE
        failures += is_more
        print(f"{name}: {counted[name] / 1e6:.1f} M, {ratio:.3f} of the table{'  TOO MANY' if is_more else ''}", flush=True)
    if options.write:
        rows = [f"{name}\t{number}" for name, number in counted.items()]
        head = "# Instructions of `cargo xtask test instructions`, in the profile `dev` without incremental compilation."
        options.held_to.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    elif failures:
        print("Find out why (callgrind_annotate), or write the table with --write and say in the commit what the work is for.")
    return 1 if failures or (not options.write and set(table) != set(counted)) else 0


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


def amounts(programs: list[Path], work: Path) -> list[str]:
    specs = {"pitch system": PITCH}
    for size in (150, 2000, 10000):
        path = work / f"synthetic-{size}.od.yaml"
        path.write_text(synthetic.specification(size), encoding="utf-8")
        specs[f"{size} objects"] = path
    columns = [f"{path} M" if len(programs) > 1 else "M instructions" for path in programs]
    rows = [f"| command | {' | '.join(columns)} |", "|---|" + "--:|" * len(programs)]
    print("\n".join(rows))
    for name, spec in specs.items():
        for words in ("check", "build", "docs"):
            row = []
            for program in programs:
                out = work / "out"
                shutil.rmtree(out, ignore_errors=True)
                command = [str(program), words, str(spec)] + ([] if words == "check" else ["--out", str(out)])
                row.append(f"{count(command) / 1e6:.0f}")
            rows.append(f"| odgen {words}, {name} | {' | '.join(row)} |")
            print(rows[-1], flush=True)
    return rows


def growth(program: Path, work: Path, options: argparse.Namespace) -> int:
    cargo = os.environ.get("CARGO", "cargo")
    command = [cargo, "run", "--quiet", "-p", "od-tests", "--bin", "patterns", "--", str(work)]
    subprocess.run([*command, *map(str, options.numbers)], cwd=ROOT, check=True)
    names = sorted({path.name.split(".")[0] for path in work.glob("*.od.yaml")})
    faster = 0
    print("| pattern | output | " + " | ".join(f"{n}, M" for n in options.numbers) + " | growth |\n|---|---|--:|--:|--:|--:|")
    for name in (name for name in names if options.only in name):
        # What is wrong has no output but its messages.
        outputs = OUTPUTS if name.startswith("right") else {"messages": OUTPUTS["messages"]}
        for output, words in outputs.items():
            one, two, four = (count_output(program, words, work / f"{name}.{n}.od.yaml", work) for n in options.numbers)
            # What every run does is in all three.
            ratio = (four - two) / max(two - one, 1)
            is_faster = ratio > MOST and four - two > LEAST
            faster += is_faster
            shown = " | ".join(f"{number / 1e6:.1f}" for number in (one, two, four))
            fault = " **faster than the size**" if is_faster else ""
            print(f"| {name} | {output} | {shown} | {ratio:.2f}{fault} |", flush=True)
    return 1 if faster else 0


def count_output(program: Path, words: list[str], spec: Path, work: Path) -> int:
    """The instructions of one output, which is made anew."""
    out = work / "out"
    shutil.rmtree(out, ignore_errors=True)
    return count([str(program), *(word.format(spec=spec, out=out) for word in words)])


if __name__ == "__main__":
    sys.exit(main())
