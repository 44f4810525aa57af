#!/usr/bin/env python3
"""Compare what odgen makes of XDD and XDC files of others with what Python's XML parser finds in them.

    xdd_foreign.py --odgen target/debug/odgen FILE...

Of each file, every object and sub-object must arrive under its name, with the type, access, mapping and default that it or its
parameter states. Files without a fault in them agree; what odgen says otherwise, it has to say with a message at that line
of the file, and such entries are counted. Exit code 0: all agrees; 1: a difference without a message.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path
from typing import Any, Iterator

TYPES = {
    "BOOL": "boolean", "SINT": "integer8", "INT": "integer16", "DINT": "integer32", "LINT": "integer64", "USINT": "unsigned8",
    "UINT": "unsigned16", "UDINT": "unsigned32", "ULINT": "unsigned64", "REAL": "real32", "LREAL": "real64",
    "STRING": "visible-string", "WSTRING": "unicode-string", "BYTE": "unsigned8", "CHAR": "unsigned8", "WORD": "unsigned16",
    "DWORD": "unsigned32", "LWORD": "unsigned64",
}
CODES = {
    1: "boolean", 2: "integer8", 3: "integer16", 4: "integer32", 5: "unsigned8", 6: "unsigned16", 7: "unsigned32", 8: "real32",
    9: "visible-string", 10: "octet-string", 11: "unicode-string", 12: "time-of-day", 13: "time-difference", 15: "domain",
    16: "integer24", 17: "real64", 18: "integer40", 19: "integer48", 20: "integer56", 21: "integer64", 22: "unsigned24",
    24: "unsigned40", 25: "unsigned48", 26: "unsigned56", 27: "unsigned64",
}
ACCESS = {"const": "const", "read": "ro", "write": "wo", "readWrite": "rw", "readWriteInput": "rwr", "readWriteOutput": "rww"}


def local(element: ET.Element) -> str:
    return element.tag.rsplit("}", 1)[-1]


def child(element: ET.Element | None, name: str) -> ET.Element | None:
    return next((one for one in element if local(one) == name), None) if element is not None else None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("files", type=Path, nargs="+")
    arguments = parser.parse_args()
    faults = 0
    for path in arguments.files:
        call = [str(arguments.odgen), "dump", str(path), "--format", "json"]
        model = json.loads(subprocess.run(call, capture_output=True, text=True, check=True).stdout)
        check = [str(arguments.odgen), "check", str(path), "--all", "--notes", "--format", "short"]
        said = subprocess.run(check, capture_output=True, text=True, check=False).stderr
        counts, problems = compare(ET.parse(path).getroot(), model["devices"][0], said)
        print(f"{path.name}: {', '.join(f'{number} {what}' for what, number in counts.items())}", end="")
        print("".join(f"\n  FAIL {problem}" for problem in problems[:20]))
        faults += len(problems)
    return 1 if faults else 0


def compare(root: ET.Element, device: dict[str, Any], said: str) -> tuple[Counter[str], list[str]]:
    parameters = {one.get("uniqueID"): one for one in root.iter() if local(one) == "parameter"}
    types = {one.get("uniqueID"): one for one in root.iter() if local(one) in ("enum", "derived", "array", "struct")}
    objects = {one["index"][2:]: one for one in device["objects"]}
    counts: Counter[str] = Counter()
    problems: list[str] = []

    def that(where: str, what: str, found: Any, expected: Any) -> None:
        if found == expected:
            counts["facts"] += 1
        elif f"{where}:" in said or f"{where} " in said or not is_plain(expected) and "[EDS511]" in said:
            counts["facts reported to be different"] += 1
        else:
            problems.append(f"{where} {what}: found {found!r}, expected {expected!r}")

    for node in (one for one in root.iter() if local(one) == "CANopenObject"):
        index = (node.get("index") or "").upper()
        found = objects.get(index)
        if is_disabled(node, parameters):
            counts["objects that are switched off"] += 1
            if found is not None:
                problems.append(f"{index} is switched off, and there all the same")
            continue
        counts["objects"] += 1
        if found is None:
            problems.append(f"{index} has not arrived")
            continue
        that(f"{index}h", "name", found["name"], node.get("name"))
        entries = {entry["sub"]: entry for entry in found["entries"]}
        subs = [one for one in node if local(one) == "CANopenSubObject"]
        for sub in subs:
            counts["sub-objects"] += 1
            number = int(sub.get("subIndex", ""), 16)
            where = f"{index}h.{number}" if number else f"{index}h"
            if number not in entries:
                problems.append(f"{where} has not arrived")
                continue
            that(where, "name", entries[number]["name"], sub.get("name"))
            for what, value, expected in stated(sub, parameters, types, entries[number]):
                that(where, what, value, expected)
        if not subs and node.get("objectType") in ("2", "7"):
            for what, value, expected in stated(node, parameters, types, entries[0]):
                that(f"{index}h", what, value, expected)
    return counts, problems


def is_disabled(node: ET.Element, parameters: dict[str | None, ET.Element]) -> bool:
    """Whether CANopenEditor has switched an object off."""
    parameter = parameters.get(node.get("uniqueIDRef"))
    properties = [one for of in (node, parameter) if of is not None for one in of if local(one) == "property"]
    stated = {one.get("name"): one.get("value") for one in properties}
    return stated.get("CO_disabled", node.get("disabled")) == "true"


def is_plain(value: Any) -> bool:
    """Whether a text is one that a VISIBLE_STRING has; another one is left out, with a message at its line."""
    return not isinstance(value, str) or value.isascii() and value.isprintable()


def stated(
    node: ET.Element, parameters: dict[str, ET.Element], types: dict[str, ET.Element], entry: dict[str, Any]
) -> Iterator[tuple[str, Any, Any]]:
    """What the file says of an entry, compared with what the dump does."""
    parameter = parameters.get(node.get("uniqueIDRef", ""))
    default = node.get("defaultValue")
    of_parameter = child(parameter, "defaultValue")
    if not default and of_parameter is not None:
        default = of_parameter.get("value")
    data_type = CODES.get(int(node.get("dataType", "0"), 16)) or type_of(parameter, types)
    yield "type", entry["type"], data_type or "domain"
    access = node.get("accessType") or (ACCESS.get(parameter.get("access", "read")) if parameter is not None else None)
    mapping = node.get("PDOmapping")
    if access == "rw" and mapping in ("TPDO", "RPDO"):
        access = "rwr" if mapping == "TPDO" else "rww"
    yield "access", entry["eds"]["access"], access
    if entry["type"] != "domain":
        yield "mapping", entry["pdo"] != "none", mapping not in (None, "no")
    if default and entry["type"].startswith(("integer", "unsigned")) and "$" not in default:
        raw, bits = int(default, 0), int(entry["type"].lstrip("integruds"))
        if entry["type"].startswith("integer") and default.startswith("0x") and raw >= 1 << bits - 1:
            raw -= 1 << bits
        yield "default", int(entry["default"]["raw"]) if entry["default"] else None, raw
    elif entry["type"] == "visible-string":
        yield "default", (entry["default"] or {}).get("text") or None, (default or "").strip() or None


def type_of(parameter: ET.Element | None, types: dict[str, ET.Element]) -> str | None:
    for one in parameter if parameter is not None else ():
        if local(one) in TYPES:
            return TYPES[local(one)]
        if local(one) == "BITSTRING":
            return "octet-string" if child(parameter, "defaultValue") is not None else "domain"
        if local(one) == "dataTypeIDRef":
            return type_of(types.get(one.get("uniqueIDRef", "")), types)
    return None


if __name__ == "__main__":
    sys.exit(main())
