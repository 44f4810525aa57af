"""What an EDS or DCF file must say, derived from the model dump and the CiA rules alone.

The result is one plain dictionary per EDS section ("3000", "3000sub1", "DeviceInfo"), with the keys of
CiA 306 and values in one normal form: integers, floats for REAL, text for strings, hex digits for
octets, None for "not written". Every reader's result is brought into the same form.
"""

from __future__ import annotations

import json
import re
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

Value = Union[int, float, str, None]
Facts = dict[str, dict[str, Any]]

DATA_TYPES = {
    "boolean": 0x01, "integer8": 0x02, "integer16": 0x03, "integer32": 0x04,
    "unsigned8": 0x05, "unsigned16": 0x06, "unsigned32": 0x07, "real32": 0x08,
    "visible-string": 0x09, "octet-string": 0x0A, "unicode-string": 0x0B,
    "time-of-day": 0x0C, "time-difference": 0x0D, "domain": 0x0F,
    "integer24": 0x10, "real64": 0x11, "integer40": 0x12, "integer48": 0x13,
    "integer56": 0x14, "integer64": 0x15, "unsigned24": 0x16, "unsigned40": 0x18,
    "unsigned48": 0x19, "unsigned56": 0x1A, "unsigned64": 0x1B,
}
STRINGS = {0x09, 0x0B}
OCTETS = {0x0A, 0x0F}
TIMES = {0x0C, 0x0D}
REALS = {0x08, 0x11}
OBJECT_TYPES = {"domain": 2, "var": 7, "array": 8, "record": 9}
IDENTITY = {1: "VendorNumber", 2: "ProductNumber", 3: "RevisionNumber"}


@dataclass(frozen=True)
class IfWritten:
    """A value that a file may leave out, but may not contradict."""

    value: Value
    absent: tuple[Value, ...] = (None,)  # how the reader shows that it was left out


def load_device(dump: Path, key: str) -> dict[str, Any]:
    devices = json.loads(dump.read_text(encoding="utf-8"))["devices"]
    for device in devices:
        if device["key"] == key:
            return device
    raise SystemExit(f"{dump}: no device {key!r}, only {[d['key'] for d in devices]}")


def expected_facts(device: dict[str, Any], node: int, dcf: bool) -> Facts:
    """All sections; `$NODEID` is replaced by `node`."""
    facts: Facts = {"DeviceInfo": dict(device_info(device))}
    if dcf:
        facts["DeviceComissioning"] = {"NodeID": node}
    for obj in device["objects"]:
        add_object(facts, obj, node, dcf)
    return facts


def device_info(device: dict[str, Any]) -> dict[str, int]:
    """The [DeviceInfo] keys that CiA 306 ties to the dictionary: identity and PDO counts."""
    info = {"NrOfRXPDO": 0, "NrOfTXPDO": 0}
    for obj in device["objects"]:
        index = int(obj["index"], 16)
        info["NrOfRXPDO"] += 0x1400 <= index <= 0x15FF
        info["NrOfTXPDO"] += 0x1800 <= index <= 0x19FF
        if index == 0x1018:
            for entry in obj["entries"]:
                default = entry["default"]
                if entry["sub"] in IDENTITY and default is not None:
                    info[IDENTITY[entry["sub"]]] = default["raw"]
    return info


def add_object(facts: Facts, obj: dict[str, Any], node: int, dcf: bool) -> None:
    index = int(obj["index"], 16)
    head: dict[str, Any] = {"ParameterName": name_of(obj), "ObjectType": OBJECT_TYPES[obj["kind"]]}
    facts[f"{index:04X}"] = head
    if obj["kind"] in ("var", "domain"):
        head.update(entry_facts(obj["entries"][0], node, dcf))
        return
    for entry in obj["entries"]:
        section = {"ParameterName": name_of(entry)}
        section.update(entry_facts(entry, node, dcf))
        facts[f"{index:04X}sub{entry['sub']:X}"] = section


def entry_facts(entry: dict[str, Any], node: int, dcf: bool) -> dict[str, Any]:
    data_type = DATA_TYPES[entry["type"].lower()]
    model = default_value(entry["default"], data_type, node)
    written = entry.get("eds", {}).get("default", "written") == "written"
    facts = {
        "DataType": data_type,
        "AccessType": access_of(entry),
        "PDOMapping": int(entry["pdo"] != "none"),
        "DefaultValue": model if written else None,
        "LowLimit": number(entry["low"], data_type),
        "HighLimit": number(entry["high"], data_type),
        "ObjFlags": entry.get("eds", {}).get("flags", 0),
    }
    if dcf:
        facts["ParameterValue"] = parameter_value(entry, model, data_type, node)
    return facts


def parameter_value(entry: dict[str, Any], model: Value, data_type: int, node: int) -> Any:
    """`dcf` in the dump is a configured value and must be in the DCF; else only the default may be."""
    if entry.get("dcf") is not None:
        return default_value(entry["dcf"], data_type, node)
    return IfWritten(model)


def access_of(entry: dict[str, Any]) -> str:
    if entry.get("locked"):
        return "ro"  # a master may not write it
    directions = {("rw", "receive"): "rww", ("rw", "transmit"): "rwr"}
    return directions.get((entry["access"], entry["pdo"]), entry["access"])


def name_of(item: dict[str, Any]) -> str:
    return item.get("eds-name") or item["name"]


def default_value(default: dict[str, Any] | None, data_type: int, node: int) -> Value:
    if default is None:
        return None
    if data_type in STRINGS | OCTETS | TIMES:
        return text_value(default["text"], data_type)
    if default.get("formula"):
        return evaluate(default["formula"], node)
    return number(default["raw"], data_type)


def text_value(text: str | None, data_type: int) -> str | None:
    """Text as an EDS can carry it: trimmed, and empty is the same as not there."""
    if text is None or not text.strip():
        return None
    return text.replace(" ", "").upper() if data_type in OCTETS else text.strip()


def real_value(text: str, data_type: int) -> float:
    """CiA 306 does not say how REAL is written: some tools take decimals, some the IEEE 754 bits in hex."""
    if not text.lower().startswith("0x"):
        return float(text)
    bits, number_format = (">I", ">f") if data_type == 0x08 else (">Q", ">d")
    return float(struct.unpack(number_format, struct.pack(bits, int(text, 16)))[0])


def evaluate(formula: str, node: int) -> int:
    match = re.fullmatch(r"(\$NODEID)(?:\+(.+))?", formula.strip(), re.IGNORECASE)
    if match is None:
        return int(formula, 0)
    return node + (int(match.group(2), 0) if match.group(2) else 0)


def number(raw: Value, data_type: int) -> Value:
    if raw is None:
        return None
    return float(raw) if data_type in REALS else int(raw)
