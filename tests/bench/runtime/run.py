#!/usr/bin/env python3
"""Measure generated dictionaries at run time: ours compared with those of two other projects.

    run.py [--models pmc pmm 150 gappy150 2000 gappy2000] [--contenders ours zencan canopen-rs] [--canopen-rs-2000] [--quick]

Prints Markdown; what cargo and criterion print goes to standard error. `scaled.py` shows what the
models are. 10,000 objects (`10000`, `gappy10000`) have to be asked for: zencan needs about five minutes
and 8 GB to compile them, and `gappy10000` is ours alone, because zencan has objects of its own at 5500h.
canopen-rs is measured with 150 only unless `--canopen-rs-2000` says that waiting for it is all right
(`Cargo.toml` says why). The exit code is 1 when something could not be built or run; nothing is judged.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODELS = ("pmc", "pmm", "150", "gappy150", "2000", "gappy2000", "10000", "gappy10000")
CONTENDERS = ("ours", "zencan", "canopen-rs")
OPERATIONS = (
    "read u16",
    "write u16",
    "read record",
    "write record",
    "read array element",
    "find",
    "find, missing sub-index",
    "typed read",
    "PDO pack",
    "PDO pack, default mapping",
    "PDO unpack",
    "SDO read",
    "SDO write",
)
FLOOR = "floor"


@dataclass(frozen=True, order=True)
class Place:
    """A line of the table, and a column."""

    operation: str
    model: str
    contender: str


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS[:-2]))
    parser.add_argument("--contenders", nargs="+", choices=CONTENDERS, default=list(CONTENDERS))
    parser.add_argument("--canopen-rs-2000", action="store_true", help="compile that, too: five minutes and more")
    parser.add_argument("--quick", action="store_true", help="less exact, but a tenth of the time")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="bench-runtime-") as folder:
        features = [*options.contenders, *(f"size{name}" if name.isdigit() else name for name in options.models)]
        if options.canopen_rs_2000:
            features.append("canopen-rs-2000")
        if not bench(features, options.quick, Path(folder)):
            return 1
        print(report(options.models, options.contenders, measured(Path(folder))))
    return 0


def bench(features: list[str], quick: bool, results: Path) -> bool:
    """All contenders in one program and one run. An empty directory for the results keeps older ones out."""
    command = [os.environ.get("CARGO", "cargo"), "bench", "--no-default-features", "--features", ",".join(features)]
    command += ["--", "--noplot", *(["--quick"] if quick else [])]
    environment = {**os.environ, "CRITERION_HOME": str(results)}
    return subprocess.run(command, check=False, cwd=HERE, stdout=sys.stderr, env=environment).returncode == 0


def measured(results: Path) -> dict[Place, float]:
    """Nanoseconds of one operation, the fastest of criterion's samples: what else the machine does only makes them slower."""
    found = {}
    for file in results.rglob("new/benchmark.json"):
        benchmark = json.loads(file.read_text(encoding="utf-8"))
        samples = json.loads(file.with_name("sample.json").read_text(encoding="utf-8"))
        fastest = min(time / count for time, count in zip(samples["times"], samples["iters"], strict=True))
        contender, model = benchmark["function_id"].split("/")
        place = Place(benchmark["group_id"], model, contender)
        found[place] = fastest / benchmark["throughput"]["Elements"]
    return found


def report(models: list[str], contenders: list[str], times: dict[Place, float]) -> str:
    peers = [name for name in contenders if name != "ours"]
    ratios = [f"{name} / ours" for name in peers] if "ours" in contenders else []
    rustc = subprocess.run(["rustc", "--version"], check=False, cwd=HERE, text=True, stdout=subprocess.PIPE).stdout
    lines = [
        f"{rustc.strip()}, {platform.system()} {platform.machine()}, {os.cpu_count()} cores; ns for one operation",
        "",
        "| " + " | ".join(["operation", "model", *contenders, *ratios]) + " |",
        "|---" + "|--:" * (1 + len(contenders) + len(ratios)) + "|",
    ]
    for operation in OPERATIONS:
        for model in sorted(models, key=MODELS.index):
            cells = [times.get(Place(operation, model, name)) for name in contenders]
            if not any(cells):
                continue
            own = times.get(Place(operation, model, "ours"))
            row = [operation, model, *(f"{cell:.1f}" if cell else "" for cell in cells)]
            if ratios:
                others = (times.get(Place(operation, model, name)) for name in peers)
                row += [f"{other / own:.1f}" if own and other else "" for other in others]
            lines.append("| " + " | ".join(row) + " |")
    if block := times.get(Place("SDO block download of 100 kB", "domain", "ours")):
        lines += ["", f"100 kB into a DOMAIN in blocks take {block / 1e6:.2f} ms: {100 / block * 1e6:.0f} MB/s."]
    if floor := times.get(Place("empty loop", "0", FLOOR)):
        lines += ["", f"The loop itself takes {floor:.1f} ns of each figure."]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
