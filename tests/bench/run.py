#!/usr/bin/env python3
"""Measure how long odgen takes, and what other people's tools take on the EDS files that it makes.

    run.py [--odgen FILE] [--runs 20] [--budget 10] [--sizes 150 1500 10000] [--cache target/bench] [--no-peers]

Prints Markdown. All commands are run in turn, one run of each per round, so that a busy moment of
the machine hits all of them. A time is that of the whole process, from starting it to its end.
Nothing is judged: the exit code is 0 when everything could be run, 1 when a command failed, 3 when
a peer could not be installed.
"""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import synthetic

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PITCH = ROOT / "od-spec" / "devices" / "pitch-control-system.od.yaml"
NODE = "5"  # dcfchk and python-canopen want a node-ID for the formulas in the file
LEAST_RUNS = 3
DCF2C = "lely dcf2c (C), EDS to C"
EXE = ".exe" if sys.platform == "win32" else ""
FORMS = {"md": "Markdown", "html": "HTML"}
VISIBLE_STRING = "DataType=0x0009"

# Whole process, median of 5, on the EDS files of another study with about as many entries. Used
# only where dcf2c itself is not at hand.
DCF2C_ELSEWHERE = {150: 0.016, 1500: 0.124, 10000: 0.372}
PITCH_GOAL = DCF2C_ELSEWHERE[150]
LARGE, LARGE_GOAL = 10000, 0.4
DOCUMENTS_GOAL = 250  # MB that documents of `LARGE` objects may take, in each format


class Failed(Exception):
    """Why something could not be run or installed."""


@dataclass
class Measured:
    """A command and its times. `size` is the number of objects that it works on, 0 for none."""

    name: str
    command: list[str]
    size: int = 0
    fresh: Path | None = None  # removed before each run
    peer: bool = False
    environment: dict[str, str] = field(default_factory=dict)
    seconds: list[float] = field(default_factory=list)
    wanted: int = 0
    kilobytes: int | None = None

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    def run(self, prefix: tuple[str, ...] = ()) -> float:
        if self.fresh:
            shutil.rmtree(self.fresh, ignore_errors=True)
        environment = {**os.environ, **self.environment}
        start = time.perf_counter()
        done = subprocess.run(
            [*prefix, *self.command],
            check=False,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=environment,
        )
        seconds = time.perf_counter() - start
        if done.returncode != 0:
            raise Failed(f"{self.name} ended with {done.returncode}: {done.stderr.decode(errors='replace').strip()[-400:]}")
        return seconds


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path, help="the program; without it, it is built with cargo")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--budget", type=float, default=10, help="seconds for one command; slow ones run less often, but 3 times")
    parser.add_argument("--sizes", type=int, nargs="+", default=[150, 1500, LARGE])
    parser.add_argument("--cache", type=Path, default=ROOT / "target" / "bench", help="where the peers are installed")
    parser.add_argument("--no-peers", action="store_true")
    options = parser.parse_args()
    try:
        odgen = (options.odgen or built()).resolve()
        with tempfile.TemporaryDirectory(prefix="odgen-bench-") as folder:
            work = Path(folder)
            measured = [*floors(), *own(odgen, work, options.sizes)]
            found, missing = ([], []) if options.no_peers else peers(options.cache.resolve(), work, options.sizes)
            measured += found
            measure(measured, options.runs, options.budget)
            print(report(odgen, measured, missing))
    except Failed as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 3 if missing else 0


def built() -> Path:
    output([os.environ.get("CARGO", "cargo"), "build", "--release", "--quiet", "-p", "odgen"], ROOT)
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / f"odgen{EXE}"


def output(command: list[str], folder: Path | None = None) -> str:
    """What a command prints, messages included."""
    try:
        done = subprocess.run(
            command, check=False, cwd=folder, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror}") from error
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} ended with {done.returncode}: {done.stdout.strip()[-400:]}")
    return done.stdout.strip()


def floors() -> Iterator[Measured]:
    """What starting a process costs at all."""
    if true := shutil.which("true"):
        yield Measured("floor: `true`", [true])
    yield Measured("floor: `python -c pass`", [sys.executable, "-c", "pass"])


def own(odgen: Path, work: Path, sizes: list[int]) -> Iterator[Measured]:
    program, pitch = str(odgen), str(PITCH)
    yield Measured("floor: `odgen --version`", [program, "--version"])
    yield Measured("odgen check, pitch system", [program, "check", pitch])
    new, same = work / "pitch-new", work / "pitch-same"
    yield Measured("odgen build, pitch system", [program, "build", pitch, "--out", str(new)], fresh=new)
    yield Measured("the same, nothing to change", [program, "build", pitch, "--out", str(same)])
    for size in sizes:
        spec = work / f"synthetic-{size}.od.yaml"
        spec.write_text(synthetic.specification(size), encoding="utf-8", newline="\n")
        messages = output([program, "check", str(spec)])
        if "nothing found" not in messages:
            raise Failed(f"the synthetic specification is not clean: {messages[:400]}")
        out, dcf = work / f"new-{size}", work / f"dcf-{size}"
        yield Measured("odgen check", [program, "check", str(spec)], size)
        yield Measured("odgen build", [program, "build", str(spec), "--out", str(out)], size, fresh=out)
        rust = work / f"rust-{size}"
        yield Measured("odgen build --rust", [program, "build", str(spec), "--rust", "--out", str(rust)], size, fresh=rust)
        one_file = ["--device", "controller", "--node", NODE, "--out", str(dcf / "controller.dcf")]
        yield Measured("odgen dcf", [program, "dcf", str(spec), *one_file], size, fresh=dcf)
        for form in ("md", "html"):
            docs = work / f"docs-{form}-{size}"
            yield Measured(f"odgen docs, {FORMS[form]}", [program, "docs", str(spec), "--format", form, "--out", str(docs)], size, fresh=docs)
        # what the peers read: made once and kept
        output([program, "build", str(spec), "--out", str(work / f"eds-{size}")])


def peers(cache: Path, work: Path, sizes: list[int]) -> tuple[list[Measured], list[str]]:
    found: list[Measured] = []
    missing: list[str] = []
    for install in (lely_c, python_tools, rust_crate):
        try:
            tools = install(cache)
        except Failed as error:
            missing.append(str(error))
            continue
        for size in sizes:
            eds = work / f"eds-{size}" / "eds" / "controller.eds"
            for name, command, environment in tools:
                places = {"eds": eds, "plain": without_texts(eds), "out": eds.with_suffix(".c"), "md": eds.with_suffix(".md")}
                words = [word.format(**places) for word in command]
                found.append(Measured(name, words, size, peer=True, environment=environment))
    return found, missing


Tool = tuple[str, list[str], dict[str, str]]


def lely_c(_: Path) -> list[Tool]:
    """Cannot be installed from here (see README.md): measured where it is installed."""
    program = shutil.which("dcf2c")
    return [(DCF2C, [program, "-o", "{out}", "{eds}", "device"], {})] if program else []


def python_tools(cache: Path) -> list[Tool]:
    folder, requirements = cache / "venv", HERE / "requirements.txt"
    programs = folder / ("Scripts" if sys.platform == "win32" else "bin")
    stamp, state = folder / "stamp", f"{sys.version}\n{requirements.read_text(encoding='utf-8')}"
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != state:
        shutil.rmtree(folder, ignore_errors=True)
        output([sys.executable, "-m", "venv", str(folder)])
        pip = [str(programs / f"python{EXE}"), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        output([*pip, "-r", str(requirements)])
        stamp.write_text(state, encoding="utf-8")
    strict = {"PYTHONWARNINGS": "error::UserWarning"}  # without it, dcfchk reports some faults and ends with 0
    read = "import canopen, sys; canopen.import_od(sys.argv[1], int(sys.argv[2]))"
    return [
        ("lely dcfchk (Python), checks the EDS", [str(programs / f"dcfchk{EXE}"), "-n", NODE, "{eds}"], strict),
        ("lely dcf2dev (Python), EDS to C", [str(programs / f"dcf2dev{EXE}"), "-o", "{out}", "{plain}", "device"], {}),
        ("eds-utils eds2md (Python), EDS to Markdown", [str(programs / f"eds2md{EXE}"), "-o", "{md}", "{eds}"], {}),
        ("python-canopen, reads the EDS", [str(programs / f"python{EXE}"), "-c", read, "{eds}", NODE], {}),
    ]


def rust_crate(cache: Path) -> list[Tool]:
    target = cache / "peer"
    cargo = os.environ.get("CARGO", "cargo")
    output([cargo, "build", "--release", "--quiet", "--locked", "--target-dir", str(target)], HERE / "peer")
    return [("canopen-host (Rust), reads the EDS", [str(target / "release" / f"parse-eds{EXE}"), "{eds}"], {})]


def without_texts(eds: Path) -> Path:
    """A copy without the defaults of strings: dcf2dev wants them in quotes, which CiA 306 does not have."""
    plain = eds.with_name("plain.eds")
    if not plain.exists():
        sections = eds.read_text(encoding="ascii").split("\n\n")
        for number, section in enumerate(sections):
            if VISIBLE_STRING in section:
                kept = (line for line in section.split("\n") if not line.startswith("DefaultValue="))
                sections[number] = "\n".join(kept)
        plain.write_text("\n\n".join(sections), encoding="ascii")
    return plain


def measure(measured: list[Measured], runs: int, budget: float) -> None:
    gnu_time = shutil.which("time") if sys.platform == "linux" else None
    for one in measured:
        first = one.run()  # also warms up
        one.wanted = max(LEAST_RUNS, min(runs, int(budget / first)))
        one.kilobytes = peak(one, gnu_time)
        print(f"{one.name} {one.size or ''}: {first:.3f} s, {one.wanted} runs to come", file=sys.stderr)
    for number in range(runs):
        for one in measured[number % len(measured) :] + measured[: number % len(measured)]:
            if len(one.seconds) < one.wanted:
                one.seconds.append(one.run())


def peak(one: Measured, gnu_time: str | None) -> int | None:
    """Largest resident set, in a run of its own. A child of this script would start with the script's own size."""
    if not gnu_time:
        return None
    with tempfile.NamedTemporaryFile("r") as file:
        one.run((gnu_time, "-f", "%M", "-o", file.name))
        return int(file.read().split()[-1])


def report(odgen: Path, measured: list[Measured], missing: list[str]) -> str:
    builds = {one.size: one for one in measured if one.name == "odgen build"}
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    lines = [
        f"{output([str(odgen), '--version'])}, Python {platform.python_version()}, {machine}",
        "",
        "| command | objects | runs | median ms | min ms | peak MB | time / odgen build |",
        "|---|--:|--:|--:|--:|--:|--:|",
    ]
    for one in sorted(measured, key=lambda one: (one.size, one.peer)):
        ratio = f"{one.median / builds[one.size].median:.1f}" if one.peer else ""
        memory = f"{one.kilobytes / 1024:.0f}" if one.kilobytes else ""
        times = f"{1000 * one.median:.1f} | {1000 * min(one.seconds):.1f}"
        lines.append(f"| {one.name} | {one.size or ''} | {len(one.seconds)} | {times} | {memory} | {ratio} |")
    lines += (f"\nNot measured: {reason}." for reason in missing)
    lines += documents(measured)
    lines += goals(measured, builds)
    return "\n".join(lines)


def documents(measured: list[Measured]) -> Iterator[str]:
    """How large the documents are, and the time of a peer as a ratio."""
    yield ""
    for one in measured:
        if one.fresh and one.name.startswith("odgen docs"):
            sizes = {file.name: file.stat().st_size for file in one.fresh.rglob("*") if file.is_file()}
            name, largest = max(sizes.items(), key=lambda item: item[1])
            yield f"{one.name}, {one.size} objects: {sum(sizes.values()) / 1e6:.2f} MB in {len(sizes)} files, {name} {largest / 1e6:.2f} MB."
        if one.name.startswith("eds-utils"):
            md = next(other.median for other in measured if other.name == "odgen docs, Markdown" and other.size == one.size)
            written = Path(one.command[2]).stat().st_size
            yield f"eds2md, {one.size} objects: {one.median / md:.1f} times odgen docs, Markdown; {written / 1e6:.2f} MB."


def goals(measured: list[Measured], builds: dict[int, Measured]) -> Iterator[str]:
    pitch = next(one for one in measured if one.name == "odgen build, pitch system").median
    dcf2c = next((one.median for one in measured if one.name == DCF2C and one.size == 150), None)
    bar, source = (dcf2c, "in this run") if dcf2c else (PITCH_GOAL, "measured elsewhere on another EDS, not in this run")
    yield ""
    yield (
        f"Goal: the pitch system in less time than dcf2c takes for 150 objects ({1000 * bar:.0f} ms, {source}): "
        f"{1000 * pitch:.1f} ms, {'met' if pitch < bar else 'not met'}."
    )
    if LARGE in builds:
        one_file = next(one.median for one in measured if one.name == "odgen dcf" and one.size == LARGE)
        for seconds, files in ((builds[LARGE].median, "EDS and JSON dump"), (one_file, "one file in EDS form, no JSON")):
            yield (
                f"Goal: {LARGE} objects in less than {1000 * LARGE_GOAL:.0f} ms: {1000 * seconds:.0f} ms ({files}), "
                f"{'met' if seconds < LARGE_GOAL else 'not met'}."
            )
    for one in measured:
        if one.size == LARGE and one.name.startswith("odgen docs") and one.kilobytes:
            megabytes = one.kilobytes / 1024
            met = "met" if megabytes < DOCUMENTS_GOAL else "not met"
            yield f"Goal: {one.name}, {LARGE} objects in less than {DOCUMENTS_GOAL} MB: {megabytes:.0f} MB, {met}."
    if not dcf2c:
        for size, seconds in DCF2C_ELSEWHERE.items():
            if size in builds:
                ratio = seconds / builds[size].median
                yield f"dcf2c took {1000 * seconds:.0f} ms for {size} objects elsewhere: {ratio:.2f} of odgen build here."


if __name__ == "__main__":
    sys.exit(main())
