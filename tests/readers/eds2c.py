#!/usr/bin/env python3
"""Make firmware in C of generated EDS files, as the book shows, and look at what comes out.

    eds2c.py --eds-dir generated/eds --dump generated/*.json --odgen target/debug/odgen

Runs eds2c of eds-utils on KEY.eds of every device in the dumps, which gives OD.h and OD.c for CANopenNode, and
compares objects, types and defaults with the dump. Then odgen makes the same two files of the same EDS; both are
compiled with the header of the tests, and what each holds is compared entry by entry: kind and number of entries of an
object, attributes, length and bytes of an entry. Run by the Python that `run.py` has installed the readers for.
Exit code 0: all agrees; 1: a difference.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from eds_utils.eds2c import eds2c

# CANopenNode keeps values in groups, and eds2c defines variables for objects that are in one.
GROUP = ";StorageLocation=RAM"
KINDS = {"var": "ODT_VAR", "array": "ODT_ARR", "record": "ODT_REC"}
TYPES = {"boolean": "bool_t", "real32": "float32_t", "real64": "float64_t"} | {
    f"{name}{bits}": f"{c}{bits}_t" for name, c in (("integer", "int"), ("unsigned", "uint")) for bits in (8, 16, 32, 64)
}


HEADER = Path("tests/c/canopennode")
TPDO, RPDO = 0x04, 0x08


class Fact(NamedTuple):
    """A line of list_entries.c: an object has no `sub`."""

    index: int
    sub: int | None
    rest: tuple[str, ...]

    @property
    def attributes(self) -> int:
        return int(self.rest[0], 16)

    @property
    def data(self) -> tuple[str, ...]:
        return self.rest[2:]


class Around(NamedTuple):
    """What else is known of the object of a fact."""

    highest: int
    is_split: bool


def is_number_of_entries(theirs: Fact, ours: Fact, around: Around) -> bool:
    return theirs.sub == 0 and theirs.rest[:2] == ours.rest[:2] and theirs.data == (f"{around.highest:02X}",)


def is_mapped_both_ways(theirs: Fact, ours: Fact, _: Around) -> bool:
    one_way = ours.attributes & (TPDO | RPDO) in (TPDO, RPDO)
    return theirs.sub is not None and one_way and theirs.attributes == ours.attributes | TPDO | RPDO and theirs.rest[1:] == ours.rest[1:]


def is_history(theirs: Fact, _: Fact, __: Around) -> bool:
    return theirs.index == 0x1003


def is_element_that_differs(theirs: Fact, ours: Fact, around: Around) -> bool:
    return around.is_split and (theirs.sub is None or theirs.rest[1:] == ours.rest[1:])


# What eds2c takes otherwise, each with the reason why odgen does not.
DIFFERENCES = {
    "sub-index 0 is the number of entries to eds2c, whatever value the EDS gives it: that of a mapping is how many are mapped": is_number_of_entries,
    "an entry that can be mapped is mapped both ways by eds2c: `rww` is for RPDOs alone, `rwr` for TPDOs": is_mapped_both_ways,
    "1003h has memory in the dictionary of eds2c, and a count that cannot be written: the stack has the history itself": is_history,
    "elements of an ARRAY get the attributes of the first one from eds2c: where they differ, odgen makes a RECORD": is_element_that_differs,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, nargs="+", required=True)
    parser.add_argument("--odgen", type=Path, required=True)
    arguments = parser.parse_args()
    faults = 0
    used: Counter[str] = Counter()
    for dump in arguments.dump:
        for device in json.loads(dump.read_text(encoding="utf-8"))["devices"]:
            header, code = made_of(arguments.eds_dir / f"{device['key']}.eds")
            problems = list(compare(device, header, code))
            print(f"eds2c {version('eds-utils')}: {device['key']}: {len(device['objects'])} objects", end="")
            print(", all there" if not problems else "".join(f"\n  {problem}" for problem in problems))
            faults += len(problems)
            faults += compare_entries(device["key"], arguments.eds_dir / f"{device['key']}.eds", arguments.odgen, used)
    for reason in DIFFERENCES:
        print(f"  {used[reason]:>4}  {reason}")
        # A reason that nothing needs is not a reason.
        faults += used[reason] == 0
    return 1 if faults else 0


def compare_entries(key: str, eds: Path, odgen: Path, used: Counter[str]) -> int:
    """What both dictionaries hold, made of the EDS without its comments: odgen reads in them what the format has no key for."""
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder, eds.name)
        text = eds.read_bytes().decode("ascii")
        plain.write_bytes(re.sub(r"(?m)^;.*\r?\n", "", text).encode("ascii"))
        theirs, ours = Path(folder, "theirs"), Path(folder, "ours")
        theirs.mkdir()
        for name, made in zip(("OD.h", "OD.c"), made_of(plain)):
            (theirs / name).write_text(made, encoding="utf-8")
        command = [odgen, "build", plain, "--c", "canopennode", "--out", ours]
        subprocess.run([str(part) for part in command], check=True, capture_output=True)
        try:
            their_facts, our_facts = facts(theirs), facts(ours / "c" / key)
        except FileNotFoundError as missing:
            print(f"no compiler: {missing}")
            sys.exit(3)
    problems = [f"{fact}: not in both" for fact in their_facts.keys() ^ our_facts.keys()]
    split = {index for (index, sub), fact in our_facts.items() if sub is None and fact.rest[0] == "3" and their_facts[index, sub].rest[0] == "2"}
    equal = 0
    for place in sorted(their_facts.keys() & our_facts.keys(), key=lambda place: (place[0], place[1] or -1)):
        one, other = their_facts[place], our_facts[place]
        if one == other:
            equal += 1
            continue
        around = Around(int(our_facts[place[0], None].rest[1]) - 1, place[0] in split)
        reason = next((reason for reason, explains in DIFFERENCES.items() if explains(one, other, around)), None)
        if reason is None:
            problems.append(f"{place[0]:04X}h.{place[1]}: {one.rest}, odgen has {other.rest}")
        else:
            used[reason] += 1
    print(f"odgen and eds2c: {key}: {equal} of {len(our_facts)} facts equal", end="")
    print(", the others explained" if not problems else "".join(f"\n  {problem}" for problem in problems))
    return len(problems) + (equal < 200)


def facts(folder: Path) -> dict[tuple[int, int | None], Fact]:
    """What the dictionary of a directory holds, compiled with the header of the tests."""
    compiler = shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        raise FileNotFoundError("neither gcc nor clang")
    program = folder / "list_entries"
    sources = [folder / "OD.c", HEADER / "interface.c", HEADER / "list_entries.c"]
    flags = ["-std=c99", "-w", "-DCO_VERSION_MAJOR=4", f"-I{HEADER}", f"-I{folder}"]
    subprocess.run([compiler, *flags, *map(str, sources), "-o", str(program)], check=True)
    listed = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in listed.splitlines():
        what, index, *rest = line.split()
        sub = int(rest.pop(0)) if what == "entry" else None
        found[int(index, 16), sub] = Fact(int(index, 16), sub, tuple(rest))
    return found


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
