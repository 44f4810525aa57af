#!/usr/bin/env python3
"""Measure how long the files of a plant take, compared with python-canopen's writer of the same DCF files.

    plant.py [--odgen FILE] [--runs 5] [--machines 200 1667] [--no-peer]

A machine has three positions with two devices each. Times are processor seconds of the whole process, the least of the
runs: other work on the machine makes them longer, and never shorter. `different` plants give every machine a value of
its own, so that no two nodes are alike.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
DEVICES = ROOT / "od-spec" / "devices"
HEAD = """\
od-plant: 1
title: Test farm
devices: {pmm: pitch-control-system.od.yaml, pmc: pitch-control-system.od.yaml}
types:
  T:
    bit-rate: 500
    positions: {A: {pmm: 1, pmc: 11}, B: {pmm: 2, pmc: 12}, C: {pmm: 3, pmc: 13}}
    parameters: {pmc: {EFC target position: 90.00 °}}
sites:
  North:
    type: T
    machines:
      1..MACHINES: {}
"""
PEER = """\
import sys
import canopen
from pathlib import Path

source, target, count = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
ods = [canopen.import_od(str(path)) for path in sorted(source.glob("*.dcf"))]
for number in range(count):
    canopen.export_od(ods[number % len(ods)], str(target / f"{number}.dcf"), "dcf")
"""


def run(command: list[str], folder: Path) -> tuple[float, float, int]:
    """Processor and wall seconds of a process, and the memory that it had at most, in kB."""
    began = time.perf_counter()
    child = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        raise SystemExit(f"{command[0]} failed: {status}")
    return usage.ru_utime + usage.ru_stime, time.perf_counter() - began, usage.ru_maxrss


def plant(machines: int, different: bool) -> str:
    text = HEAD.replace("MACHINES", str(machines))
    if different:
        lines = (
            f"      {number}: {{parameters: {{pmc: {{EFC target position: {8000 + number % 1000}, 0x6065: {number}}}, pmm: {{0x1017: {number % 900 + 1}}}}}}}\n"
            for number in range(1, machines + 1)
        )
        text += "".join(lines)
    return text


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", type=Path, default=ROOT / "target" / "release" / "odgen")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--machines", type=int, nargs="*", default=[200, 1667])
    parser.add_argument("--no-peer", action="store_true")
    arguments = parser.parse_args()
    odgen = str(arguments.odgen.resolve())
    print("| plant | nodes | | CPU s | wall s | CPU per node | memory |\n|---|---:|---|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory(dir=ROOT / "target") as name:
        folder = Path(name)
        for path in DEVICES.glob("pitch-control-system*.yaml"):
            shutil.copy(path, folder)
        ratios = []
        for machines in arguments.machines:
            for different in (False, True):
                (folder / "plant.yaml").write_text(plant(machines, different), encoding="utf-8")
                command = [odgen, "plant", "build", "plant.yaml", "--out", "out"]
                made, again = [], []
                for _ in range(arguments.runs):
                    shutil.rmtree(folder / "out", ignore_errors=True)
                    made.append(run(command, folder))
                    again.append(run(command, folder))
                nodes = machines * 6
                for what, runs in (("all new", made), ("nothing changed", again)):
                    cpu, wall, memory = (min(column) for column in zip(*runs, strict=True))
                    kind = "different" if different else "alike"
                    print(f"| {kind} | {nodes} | {what} | {cpu:.2f} | {wall:.2f} | {cpu / nodes * 1e3:.2f} ms | {memory / 1024:.0f} MB |")
                if not arguments.no_peer and machines == arguments.machines[0]:
                    count = 60
                    peer = folder / "peer"
                    peer.mkdir(exist_ok=True)
                    base = min(run([sys.executable, "-c", PEER, "out/North/1", "peer", "0"], folder)[0] for _ in range(arguments.runs))
                    full = min(run([sys.executable, "-c", PEER, "out/North/1", "peer", str(count)], folder)[0] for _ in range(arguments.runs))
                    each = (full - base) / count
                    ours = min(cpu for cpu, _, _ in made) / nodes
                    ratios.append(f"python-canopen writes such a DCF in {each * 1e3:.1f} ms of processor time: {each / ours:.0f} times as long ({'different' if different else 'alike'}).")
        print("\n" + "\n".join(ratios))


if __name__ == "__main__":
    main()
