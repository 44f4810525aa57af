#!/usr/bin/env python3
"""Measure how long it takes to read the parameters of nodes, compared with python-canopen and a bare socket.

    reading.py [--odgen FILE] [--python FILE] [--runs 5] [--page FILE]

Prints Markdown, or writes it into a page between its markers. All nodes are virtual: `odgen serve` at a port of this machine, so that the
wires take no time and what is left is the programs. Nothing is judged: the exit code is 1 when something could not be run.
"""

from __future__ import annotations

import argparse
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(HERE.parent))

import synthetic  # noqa: E402

DEVICES = ROOT / "od-spec" / "devices"
PITCH = DEVICES / "pitch-control-system.od.yaml"
TURBINE = {1: "pmm", 2: "pmm", 3: "pmm", 11: "pmc", 12: "pmc", 13: "pmc"}
NODE = 5
OBJECTS = 3840  # of a synthetic specification with about 10,000 entries
LENGTHS = [4, 8, 14, 21, 28, 42, 64, 128, 1024, 16384, 65535]
REPEATED = {length: 400 if length < 1000 else 20 for length in LENGTHS}


class Failed(Exception):
    """Why something could not be run."""


class Served:
    """`odgen serve` at a free port."""

    def __init__(self, odgen: str, *arguments: str) -> None:
        command = [odgen, "serve", *arguments, "--slcan", "tcp:127.0.0.1:0"]
        pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere, text=True)
        assert self.process.stdout
        self.address = f"127.0.0.1:{self.process.stdout.readline().rsplit(':', 1)[1].strip()}"

    def __enter__(self) -> Served:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()


def run(*command: str) -> tuple[str, float]:
    """What a program prints, and how long it takes."""
    start = time.perf_counter()
    done = subprocess.run(command, check=False, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    seconds = time.perf_counter() - start
    if done.returncode:
        raise Failed(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout, seconds


class Bench:
    def __init__(self, odgen: str, python: str, runs: int, folder: Path) -> None:
        self.odgen, self.python, self.runs, self.folder = odgen, python, runs, folder

    def eds(self, spec: Path) -> Path:
        """The folder of the EDS files of a specification."""
        out = self.folder / f"built-{spec.stem}"
        run(self.odgen, "build", str(spec), "--out", str(out))
        return out / "eds"

    def peer(self, what: str, served: Served, files: dict[int, Path]) -> dict[tuple[str, int], list[float]]:
        """Seconds by the name and the number of a measurement."""
        nodes = [f"{node}={file}" for node, file in files.items()]
        lines, _ = run(self.python, str(HERE / "canopen_reads.py"), what, served.address, str(self.runs), *nodes)
        times: dict[tuple[str, int], list[float]] = {}
        for name, count, seconds in map(str.split, lines.splitlines()):
            times.setdefault((name, int(count)), []).append(float(seconds))
        return times

    def node(self, served: Served, *arguments: str) -> tuple[str, float]:
        return run(self.odgen, "node", *arguments, "--slcan", f"tcp:{served.address}")

    def backup(self, name: str, served: Served, files: dict[int, Path], of_node: list[str], one: list[str]) -> list[str]:
        """A row: odgen, python-canopen and a bare socket read the parameters."""
        whole, before, count = [], [], 0
        for number in range(self.runs):
            out = self.folder / f"{name}-{number}"
            said, seconds = self.node(served, "backup", *of_node, "--out", str(out))
            whole.append(seconds)
            before.append(self.node(served, "read", *one)[1])
            count = sum(map(int, re.findall(r" (\d+) values? of ", said)))
        peers = self.peer("entries", served, files)
        per_entry = {who: statistics.median(seconds) / number for (who, number), seconds in peers.items()}
        own = (statistics.median(whole) - statistics.median(before)) / count
        python, bare = per_entry["python-canopen"], per_entry["bare"]
        return [
            name,
            f"{count:,}",
            f"{statistics.median(whole):.2f}",
            f"{statistics.median(before):.2f}",
            *(f"{1e6 * seconds:.0f}" for seconds in (own, python, bare)),
            f"{python / own:.1f}",
            f"{own / bare:.1f}",
        ]

    def lengths(self) -> list[list[str]]:
        """Rows: an entry of so many bytes, by python-canopen in segments and in blocks, and by odgen."""
        spec = self.folder / "lengths.od.yaml"
        spec.write_text(of_lengths(), encoding="utf-8")
        device = self.eds(spec) / "lengths.eds"
        rows = []
        with Served(self.odgen, str(spec), "--node", str(NODE)) as served:
            peers = self.peer("lengths", served, {NODE: device})
            for number, length in enumerate(LENGTHS):
                entry = [f"{0x2000 + number:04X}"]
                one = [self.node(served, "read", str(spec), "--node", str(NODE), *entry)[1] for _ in range(self.runs)]
                many = [
                    self.node(served, "read", str(spec), "--node", str(NODE), *entry * (1 + REPEATED[length]))[1]
                    for _ in range(self.runs)
                ]
                own = (statistics.median(many) - statistics.median(one)) / REPEATED[length]
                segments, blocks = (statistics.median(peers[name, length]) for name in ("segments", "blocks"))
                rows.append([f"{length:,}", *(f"{1000 * seconds:.2f}" for seconds in (segments, blocks, own))])
        return rows


def of_lengths() -> str:
    objects = (
        f"  0x{0x2000 + number:04X}: {{name: text {length}, type: visible-string, access: rw, capacity: {length}, default: {'x' * length}, eds: {{default: withheld}}}}"
        for number, length in enumerate(LENGTHS)
    )
    head = "od-spec: 1\ntitle: Lengths\nuses: [cia301]\ndevices:\n  lengths: {name: Lengths, bit-rates: [500], features: [heartbeat producer]}\nobjects:\n"
    return head + "\n".join(objects) + "\n"


def table(head: list[str], rows: list[list[str]]) -> list[str]:
    return [f"| {' | '.join(cells)} |" for cells in [head, ["---", *("--:" for _ in head[1:])], *rows]]


def report(bench: Bench) -> str:
    pitch = bench.eds(PITCH)
    rows = []
    plant = str(DEVICES / "turbine.yaml")
    with Served(bench.odgen, plant) as served:
        files = {node: pitch / f"{key}.eds" for node, key in TURBINE.items()}
        rows.append(bench.backup("turbine with six nodes", served, files, [plant], [plant, "--node", "1", "1000"]))
    large = bench.folder / "large.od.yaml"
    large.write_text(synthetic.specification(OBJECTS), encoding="utf-8", newline="\n")
    files = {NODE: bench.eds(large) / "controller.eds"}
    node = [str(large), "--node", str(NODE)]
    with Served(bench.odgen, *node) as served:
        rows.append(bench.backup("node with 10,000 entries", served, files, node, [*node, "1000"]))
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    head = ["what", "values", "backup, s", "one entry, s", "odgen, µs", "python-canopen, µs", "bare socket, µs", "python-canopen / odgen", "odgen / bare socket"]
    lines = [f"{machine}; medians of {bench.runs} runs.", "", *table(head, rows), ""]
    lines += table(["bytes", "python-canopen in segments, ms", "python-canopen in blocks, ms", "odgen, ms"], bench.lengths())
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", default=str(ROOT / "target" / "release" / "odgen"))
    parser.add_argument("--python", default=sys.executable, help="a Python that has python-canopen")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--page", type=Path, help="a page with the markers <!-- measured --> and <!-- /measured -->")
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory(prefix="odgen-bench-") as folder:
            measured = report(Bench(str(Path(options.odgen).resolve()), options.python, options.runs, Path(folder)))
    except Failed as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    if options.page is None:
        print(measured)
        return 0
    page = options.page.read_text(encoding="utf-8")
    between = re.compile(r"(?<=<!-- measured -->\n).*?(?=<!-- /measured -->)", re.DOTALL)
    options.page.write_text(between.sub(lambda _: f"\n{measured}\n\n", page), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
