#!/usr/bin/env python3
"""Make firmware in C of generated EDS files, as the README says, and look at what comes out.

    eds2c.py --eds-dir generated/eds --dump generated/*.json

Runs eds2c of eds-utils on KEY.eds of every device in the dumps, which gives OD.h and OD.c for CANopenNode, and
compares objects, types and defaults with the dump. Run by the Python that `run.py` has installed the readers for.
Exit code 0: all agrees; 1: a difference.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

from eds_utils.eds2c import eds2c

# CANopenNode keeps values in groups, and eds2c defines variables for objects that are in one.
GROUP = ";StorageLocation=RAM"
KINDS = {"var": "ODT_VAR", "array": "ODT_ARR", "record": "ODT_REC"}
TYPES = {"boolean": "bool_t", "real32": "float32_t", "real64": "float64_t"} | {
    f"{name}{bits}": f"{c}{bits}_t" for name, c in (("integer", "int"), ("unsigned", "uint")) for bits in (8, 16, 32, 64)
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, nargs="+", required=True)
    arguments = parser.parse_args()
    faults = 0
    for dump in arguments.dump:
        for device in json.loads(dump.read_text(encoding="utf-8"))["devices"]:
            header, code = made_of(arguments.eds_dir / f"{device['key']}.eds")
            problems = list(compare(device, header, code))
            print(f"eds2c {version('eds-utils')}: {device['key']}: {len(device['objects'])} objects", end="")
            print(", all there" if not problems else "".join(f"\n  {problem}" for problem in problems))
            faults += len(problems)
    return 1 if faults else 0


def made_of(eds: Path) -> tuple[str, str]:
    """OD.h and OD.c of an EDS."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, eds.name)
        text = eds.read_bytes().decode("ascii")
        copy.write_bytes(re.sub(r"(?m)^(?=ParameterName=)", f"{GROUP}\r\n", text).encode("ascii"))
        eds2c([str(copy), "-o", folder])
        return tuple(Path(folder, name).read_text(encoding="utf-8") for name in ("OD.h", "OD.c"))  # type: ignore[return-value]


def compare(device: dict[str, Any], header: str, code: str):
    rows = {
        int(index, 16): (int(count, 16), kind)
        for index, count, kind in re.findall(r"\{(0x[0-9A-F]{4}), (0x[0-9A-F]{2}), (ODT_\w+),", code)
    }
    expected = {int(one["index"], 16): (len(one["entries"]), KINDS[one["kind"]]) for one in device["objects"]}
    for index in sorted(rows.keys() | expected.keys()):
        if rows.get(index) != expected.get(index):
            yield f"{index:04X}: {rows.get(index)}, expected {expected.get(index)}"
    if f"OD_CNT_TPDO {len([i for i in expected if 0x1800 <= i < 0x1A00])}" not in header:
        yield "OD_CNT_TPDO is another"
    compared = 0
    for one in device["objects"]:
        entry, index = one["entries"][0], int(one["index"], 16)
        if one["kind"] != "var" or entry["type"] not in TYPES:
            continue
        found = re.search(rf"(?m)^ +(\w+) x{index:04X}_(\w+);", header)
        if found is None or found[1] != TYPES[entry["type"]]:
            yield f"{index:04X}: {found and found[1]}, expected {TYPES[entry['type']]}"
            continue
        value = re.search(rf"(?m)^ +\.x{index:04X}_{found[2]} = ([^,]+),", code)
        if value is None or number(value[1]) != default(entry):
            yield f"{index:04X}: default {value and value[1]}, expected {default(entry)}"
        compared += 1
    if compared < 20:
        yield f"only {compared} defaults were there to compare"


def number(text: str) -> float:
    return float(text) if "." in text else int(text, 0)


def default(entry: dict[str, Any]) -> float:
    """An EDS without a default is one with 0 to eds2c, and the node-ID of a formula is left to the firmware."""
    value = entry["default"]
    return 0 if value is None or entry["eds"]["default"] != "written" else value["raw"]


if __name__ == "__main__":
    sys.exit(main())
