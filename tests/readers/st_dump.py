"""What the JSON dump says of a device, for those who compare Structured Text with it."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import Any

from st_machine import BITS, SIGNED, UNSIGNED, WHOLE

EXACT = 1 << 53
MOST_STEPS = 1 << 50
CODES = {
    "boolean": 0x01, "integer8": 0x02, "integer16": 0x03, "integer32": 0x04, "unsigned8": 0x05, "unsigned16": 0x06, "unsigned32": 0x07,
    "real32": 0x08, "visible-string": 0x09, "octet-string": 0x0A, "unicode-string": 0x0B, "time-of-day": 0x0C, "time-difference": 0x0D,
    "domain": 0x0F, "integer24": 0x10, "real64": 0x11, "integer40": 0x12, "integer48": 0x13, "integer56": 0x14, "integer64": 0x15,
    "unsigned24": 0x16, "unsigned40": 0x18, "unsigned48": 0x19, "unsigned56": 0x1A, "unsigned64": 0x1B,
}


class Check:
    def __init__(self) -> None:
        self.done = 0
        self.wrong: list[str] = []

    def that(self, is_right: bool, what: str) -> None:
        self.done += 1
        if not is_right:
            self.wrong.append(what)


def letters(name: str) -> str:
    for old, new in [("ä", "ae"), ("ö", "oe"), ("ü", "ue"), ("ß", "ss"), ("µ", "u"), ("°", "deg"), ("²", "2")]:
        name = name.lower().replace(old, new)
    return "".join(c for c in name if c.isascii() and c.isalnum())


def width(data_type: str) -> int | None:
    """Bits of a value."""
    if data_type == "boolean":
        return 1
    if data_type.startswith("time"):
        return 48
    found = re.fullmatch(r"(?:integer|unsigned|real)(\d+)", data_type)
    return int(found[1]) if found else None


def up(bits: int, names: dict[str, int]) -> str:
    return next(name for name, has in names.items() if has >= bits)


def elementary(data_type: str, is_bits: bool = False) -> str | None:
    """The type of the language."""
    bits = width(data_type)
    if bits is None:
        return None
    if is_bits or data_type.startswith("time"):
        return up(bits, BITS)
    if data_type == "boolean":
        return "BOOL"
    if data_type.startswith("real"):
        return "REAL" if bits == 32 else "LREAL"
    return up(bits, SIGNED if data_type.startswith("integer") else UNSIGNED)


class Device:
    """What the dump says of a device."""

    def __init__(self, dump: dict, device: dict) -> None:
        self.key: str = device["key"]
        self.dump = dump
        self.units = {unit["name"]: unit for unit in dump["units"]}
        self.types = {named["name"]: named for named in dump["types"]}
        self.entries = {}
        for one in device["objects"]:
            for entry in one["entries"]:
                self.entries[(int(one["index"], 16), entry["sub"])] = (one, entry)
        self.pdos: list[dict] = device["pdos"]
        self.machines = [one for one in dump["state-machines"] if self.key in (one.get("on") or [self.key])]
        self.errors = [one for one in dump["errors"] if self.key in (one.get("on") or [self.key])]
        used = {entry["named-type"] for _, entry in self.entries.values() if "named-type" in entry}
        self.used_types = [self.types[name] for name in sorted(used)]

    def name(self, at: tuple[int, int]) -> str:
        one, entry = self.entries[at]
        return one["name"] if one["kind"] in ("var", "domain") else f"{one['name']} {entry['name']}"

    def is_bits(self, entry: dict) -> bool:
        return "bits" in self.types.get(entry.get("named-type", ""), {})

    def of(self, text: str) -> tuple[int, int]:
        index, _, sub = text.partition(".")
        return int(index, 16), int(sub or 0)


def pattern_of(bits: str) -> tuple[int, int, int, int]:
    """Mask and value of a pattern, and the bits that have to rise and to fall."""
    mask = value = rising = falling = 0
    for bit in bits.replace(" ", "").replace("_", ""):
        mask, value, rising, falling = mask << 1, value << 1, rising << 1, falling << 1
        mask |= bit not in "xX"
        value |= bit in "1↑r+^"
        rising |= bit in "↑r+^"
        falling |= bit in "↓f-"
    return mask, value, rising, falling


class Quantity:
    """What the dump says of an entry with a unit."""

    def __init__(self, device: Device, entry: dict) -> None:
        unit = device.units[entry["unit"]]
        self.scale, self.offset = Fraction(*unit["scale"]), Fraction(*unit.get("offset", [0, 1]))
        self.of_type = elementary(entry["type"])
        bits = width(entry["type"])
        is_signed = entry["type"].startswith("integer")
        self.least, self.most = (-(1 << bits - 1), (1 << bits - 1) - 1) if is_signed else (0, (1 << bits) - 1)
        low, high = (entry.get(beside, entry[key]) for key, beside in [("low", "min"), ("high", "max")])
        self.low = max(self.least if low is None else low, -MOST_STEPS if bits > 32 else self.least)
        self.high = min(self.most if high is None else high, MOST_STEPS if bits > 32 else self.most)
        self.special = {one["value"] for one in entry.get("special", [])}

    def value(self, raw: int) -> Fraction:
        return raw * self.scale + self.offset


def away_of(exact: Fraction) -> int:
    return math.floor(exact + Fraction(1, 2)) if exact >= 0 else math.ceil(exact - Fraction(1, 2))


class Field:
    """A part of a PDO, by the dump and the mapping."""

    def __init__(self, device: Device, parameter: int, first: int) -> None:
        self.at, self.bits, self.first = (parameter >> 16, parameter >> 8 & 0xFF), parameter & 0xFF, first
        self.entry = device.entries[self.at][1] if self.at in device.entries else None
        self.is_whole = self.entry is not None and width(self.entry["type"]) == self.bits
        of_type = elementary(self.entry["type"], device.is_bits(self.entry)) if self.is_whole else None
        self.of_type = of_type or up(self.bits, UNSIGNED)

    def raw(self, frame: int) -> Any:
        number = frame >> self.first & (1 << self.bits) - 1
        if self.of_type == "BOOL":
            return bool(number)
        return number - (1 << self.bits) if self.of_type in SIGNED and number >> self.bits - 1 else number


def fields_of(device: Device, mapping: list[int]) -> list[Field]:
    fields, first = [], 0
    for parameter in mapping:
        if parameter >> 16 >= 0x20:
            fields.append(Field(device, parameter, first))
        first += parameter & 0xFF
    return fields


def mapping_of(device: Device, pdo: dict) -> list[int]:
    mapping = []
    for mapped in pdo["map"]:
        index, sub = device.of(mapped.get("entry", "0x0005"))
        mapping.append(index << 16 | sub << 8 | mapped["bits"])
    return mapping


def is_allowed(device: Device, field: Field, raw: Any) -> bool:
    """Whether a raw value without a unit is one that the device takes."""
    if not field.is_whole or field.of_type not in WHOLE or field.of_type in BITS:
        return True
    entry = field.entry
    special = {one["value"] for one in entry.get("special", [])}
    values = device.types.get(entry.get("named-type", ""), {}).get("values")
    low, high = (entry.get(beside, entry[key]) for key, beside in [("low", "min"), ("high", "max")])
    is_inside = (low is None or raw >= low) and (high is None or raw <= high)
    if values is not None:
        return raw in special or is_inside and raw in {one["value"] for one in values if one["supported"]}
    return raw in special or is_inside
