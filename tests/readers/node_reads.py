#!/usr/bin/env python3
"""Read virtual nodes with a second client that others wrote: node-canopen, in JavaScript, against `odgen serve`.

    node_reads.py --odgen target/debug/odgen --modules target/readers/npm/node_modules --eds-dir generated/eds \\
        --dump generated/fullmo-drive.json --spec od-spec/devices/fullmo-drive.od.yaml

The client finds the entries in the EDS by its own reader. What it gets is compared with the dump by access_rules.py. Exit code 1 when
anything differs, 3 where there is no node-canopen.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import canopen

from access_rules import default_of, entries_of, expected_of_reading, shown
from patience import PATIENCE
from sdo_client import NODE
from virtual_node import Served


def read_all(options: argparse.Namespace, served: Served, eds: Path) -> dict[tuple[int, int], bytes | int]:
    script = Path(__file__).with_name("node_canopen_reads.js")
    command = ["node", str(script), str(options.modules), str(eds), str(NODE), "127.0.0.1", str(served.port)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=10 * PATIENCE)
    if done.returncode or done.stderr:
        raise SystemExit(f"node-canopen: exit code {done.returncode}: {done.stderr}")
    found: dict[tuple[int, int], bytes | int] = {}
    for line in done.stdout.splitlines():
        one = json.loads(line)
        found[one["index"], one["sub"]] = bytes.fromhex(one["data"]) if "data" in one else one.get("abort", one["said"])
    return found


def check_device(options: argparse.Namespace, device: dict, types: list[dict]) -> tuple[int, list[str]]:
    eds = options.eds_dir / f"{device['key']}.eds"
    entries = entries_of(device, types, canopen.import_od(str(eds), NODE))
    served = Served(options.odgen, options.spec, device["key"])
    try:
        found = read_all(options, served, eds)
    finally:
        served.end()
    failures = [f"{index:04X}h.{sub}: of no entry" for index, sub in set(found) - {(one.index, one.sub) for one in entries}]
    for entry in entries:
        has = found.get((entry.index, entry.sub))
        expected = expected_of_reading(entry, NODE)
        if expected is None:
            expected = default_of(entry, NODE)
        if expected is None and entry.target is not None:
            target = found.get((entry.target.index, entry.target.sub))
            expected = shown(entry, target) if isinstance(target, bytes) else b"a target"
        if expected is None:
            # It is not stated which value: it has the length of its type.
            expected = has if isinstance(has, bytes) and len(has) == entry.size else bytes(entry.size)
        if has != expected:
            failures.append(f"{entry.name}: found {has!r}, expected {expected!r}")
    return len(entries), failures


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("--modules", type=Path, required=True)
    parser.add_argument("--spec", type=Path, required=True)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, required=True)
    options = parser.parse_args()
    if not shutil.which("node") or not options.modules.joinpath("canopen").is_dir():
        print("node-canopen reads no virtual node: it is not installed")
        return 3
    dump = json.loads(options.dump.read_text(encoding="utf-8"))
    failed = 0
    for device in dump["devices"]:
        began = time.monotonic()
        count, failures = check_device(options, device, dump["types"])
        for failure in failures[:20]:
            print(f"  WRONG {failure}")
        print(f"node-canopen reads {device['key']}: {count} entries, {len(failures)} wrong, {time.monotonic() - began:.1f} s")
        failed += bool(failures) or count < 200
    print(f"{len(dump['devices']) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
