"""What a node answers to an access, worked out from the dump of its device and from CiA 301: the expectations of access_table.py.

Nothing here is read from a node but the values that conditions ask for. What a type holds comes from python-canopen's reading of the EDS.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass

from canopen.objectdictionary import DOMAIN, INTEGER_TYPES, SIGNED_TYPES, ODVariable
from canopen.objectdictionary.datatypes import BOOLEAN, FLOAT_TYPES, OCTET_STRING, UNICODE_STRING, VISIBLE_STRING

WRITE_ONLY, READ_ONLY, NO_OBJECT, NO_SUB_INDEX = 0x06010001, 0x06010002, 0x06020000, 0x06090011
TOO_LONG, TOO_SHORT, WRONG_VALUE, TOO_HIGH, TOO_LOW = 0x06070012, 0x06070013, 0x06090030, 0x06090031, 0x06090032
STATE, NOT_STORED, NO_DATA, IN_USE = 0x08000022, 0x08000020, 0x08000024, 0x06010000
NOT_MAPPABLE, PDO_LENGTH, INCOMPATIBLE = 0x06040041, 0x06040042, 0x06040043
STRINGS = (VISIBLE_STRING, OCTET_STRING, UNICODE_STRING)

Read = Callable[[int, int], bytes | int]
"""Bytes of an entry, or the code with which reading it was refused."""


@dataclass
class Entry:
    """An entry as the dump and the EDS have it."""

    index: int
    sub: int
    facts: dict
    variable: ODVariable
    values: set[int] | None
    """The values of an enum that the device supports."""
    target: Entry | None = None
    """What it is a view of."""

    @property
    def name(self) -> str:
        return f"{self.index:04X}h.{self.sub}"

    @property
    def size(self) -> int:
        return len(self.variable) // 8

    @property
    def is_integer(self) -> bool:
        return self.variable.data_type in INTEGER_TYPES

    @property
    def is_real(self) -> bool:
        return self.variable.data_type in FLOAT_TYPES

    @property
    def is_text(self) -> bool:
        return self.variable.data_type in STRINGS

    @property
    def is_domain(self) -> bool:
        return self.variable.data_type == DOMAIN

    @property
    def has_numbers(self) -> bool:
        return self.is_integer or self.is_real

    @property
    def ends(self) -> tuple[float, float]:
        """The ends of its type."""
        if self.is_real:
            largest = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0] if self.size == 4 else struct.unpack("<d", b"\xff" * 6 + b"\xef\x7f")[0]
            return -largest, largest
        bits = 8 * self.size
        return (-(1 << bits - 1), (1 << bits - 1) - 1) if self.variable.data_type in SIGNED_TYPES else (0, (1 << bits) - 1)

    @property
    def limits(self) -> tuple[float | None, float | None]:
        """The limits of its values, special ones apart."""
        facts = self.facts
        low = facts.get("min", facts["low"])
        high = facts.get("max", facts["high"])
        special = self.special
        # A limit that a special value made is not one of the others.
        low = None if "min" not in facts and low in special else low
        high = None if "max" not in facts and high in special else high
        return low, high

    @property
    def special(self) -> list[int]:
        return [one["value"] for one in self.facts.get("special", [])]

    def encode(self, value: float) -> bytes:
        """The bytes of a number, whatever its limits."""
        return self.variable.STRUCT_TYPES[self.variable.data_type].pack(value)

    def number(self, data: bytes) -> float:
        return self.variable.decode_raw(data)

    def beside(self, value: float, step: int) -> float | None:
        """The next number of the type; none beyond its end."""
        if self.is_integer:
            low, high = self.ends
            return value + step if low <= value + step <= high else None
        code, bits = ("<f", "<i") if self.size == 4 else ("<d", "<q")
        (ordered,) = struct.unpack(bits, struct.pack(code, value))
        if value == 0:
            return struct.unpack(code, struct.pack(bits, 1))[0] * step
        ordered += step if value > 0 else -step
        return struct.unpack(code, struct.pack(bits, ordered))[0]


def entries_of(device: dict, types: list[dict], dictionary) -> list[Entry]:
    enums = {
        named["name"]: {int(one["value"]) for one in named["values"] if one.get("supported", True)}
        for named in types
        if "values" in named
    }
    entries: dict[tuple[int, int], Entry] = {}
    for one in device["objects"]:
        index = int(one["index"], 16)
        known = dictionary[index]
        for facts in one["entries"]:
            variable = known if isinstance(known, ODVariable) else known[facts["sub"]]
            entries[index, facts["sub"]] = Entry(index, facts["sub"], facts, variable, enums.get(facts.get("named-type")))
    for entry in entries.values():
        if alias := entry.facts.get("alias"):
            index, _, sub = alias["of"].partition(".")
            entry.target = entries[int(index, 16), int(sub or 0)]
    return list(entries.values())


def default_of(entry: Entry, node: int) -> bytes | None:
    """The bytes that a node has after a factory reset, where the dump says so."""
    default = entry.facts["default"]
    if entry.target is not None or not default:
        return None
    if entry.is_text:
        text = default["text"]
        if entry.variable.data_type == OCTET_STRING:
            return bytes.fromhex(text)
        return text.encode("utf-16-le" if entry.variable.data_type == UNICODE_STRING else "ascii")
    if not entry.has_numbers or "raw" not in default:
        return None
    raw = default["raw"] + (node if "formula" in default else 0)
    return entry.encode(raw)


def shown(entry: Entry, target: bytes) -> bytes | None:
    """What a view shows of its target's bytes; none where it refuses."""
    assert entry.target is not None
    alias = entry.facts["alias"]
    numerator, denominator = alias["factor"]
    exact = int(entry.target.number(target)) * numerator
    rounded = {"down": exact // denominator, "up": -(-exact // denominator)}[alias["rounding"]]
    low, high = entry.ends
    if low <= rounded <= high:
        return entry.encode(rounded)
    return entry.encode(min(max(rounded, low), high)) if alias["outside"] == "saturate" else None


def expected_of_reading(entry: Entry, node: int) -> int | None:
    """The abort code of reading an entry after a factory reset."""
    if not entry.variable.readable or entry.facts["access"] == "wo":
        return WRITE_ONLY
    if entry.index == 0x1003 and entry.sub > 0 or entry.is_domain:
        return NO_DATA
    return None


def expected_of_writing(entry: Entry, data: bytes, read: Read) -> int | None:
    """The abort code of writing bytes: first access and lock, then the length, the value, the rules of CiA 301, and the condition."""
    if entry.facts["access"] in ("ro", "const"):
        return READ_ONLY
    if entry.facts["locked"]:
        return STATE
    if entry.is_domain:
        return None
    if entry.is_text:
        return TOO_LONG if len(data) > entry.facts["capacity"] else None
    if len(data) != entry.size:
        return TOO_LONG if len(data) > entry.size else TOO_SHORT
    for one in (entry, entry.target):
        if one is not None and (code := of_value(one, entry.number(data))) is not None:
            return code
    if entry.index < 0x2000 and (code := of_standard(entry, int.from_bytes(data, "little"), read)) is not None:
        return code
    for one in (entry, entry.target):
        if one is not None and "writable-when" in one.facts and not holds(one.facts["writable-when"], read):
            return STATE
    return None


def of_value(entry: Entry, value: float) -> int | None:
    if entry.variable.data_type == BOOLEAN and value not in (0, 1):
        return WRONG_VALUE
    if value in entry.special:
        return None
    if entry.values is not None:
        return None if value in entry.values else WRONG_VALUE
    low, high = entry.limits
    if high is not None and value > high:
        return TOO_HIGH
    return TOO_LOW if low is not None and value < low else None


def holds(condition: str, read: Read) -> bool:
    """A condition of a write, with what the node has: `bit(0x6040, 3) == 0 and 0x6061 == 6`."""

    def value(text: str) -> int:
        if found := re.fullmatch(r"bit\((\S+), (\d+)\)", text):
            return value(found[1]) >> int(found[2]) & 1
        if found := re.fullmatch(r"0x([0-9A-F]{4})(?:\.(\d+))?", text):
            data = read(int(found[1], 16), int(found[2] or 0))
            assert isinstance(data, bytes), f"{text} cannot be read"
            return int.from_bytes(data, "little")
        return int(text, 0)

    def one(text: str) -> bool:
        found = re.fullmatch(r"(.+) (==|!=) (.+)", text)
        assert found, f"a condition of another kind: {condition}"
        return (value(found[1]) == value(found[3])) == (found[2] == "==")

    return all(one(part) for part in condition.split(" and "))


def of_standard(entry: Entry, new: int, read: Read) -> int | None:
    """The rules of single objects of CiA 301."""
    index, sub = entry.index, entry.sub

    def number(index: int, sub: int) -> int:
        data = read(index, sub)
        return int.from_bytes(data, "little") if isinstance(data, bytes) else 0

    if index == 0x1003 and sub == 0:
        return WRONG_VALUE if new != 0 else None
    if is_command(entry):
        return NOT_STORED if new.to_bytes(4, "little") != SIGNATURES[index] else None
    if index in (0x1005, 0x1012):
        return of_produced(number(index, 0), new)
    if index == 0x1014 or 0x1200 <= index < 0x1280 and sub in (1, 2):
        return of_cob_id(number(index, sub), new)
    if index == 0x1016 and sub > 0:
        return of_consumer(sub, new, number)
    if index == 0x1019:
        if new == 1 or new > 240:
            return WRONG_VALUE
        return STATE if number(0x1006, 0) else None
    if index == 0x1029 and sub > 0:
        return WRONG_VALUE if 3 <= new <= 127 else None
    if 0x1400 <= index < 0x1600 or 0x1800 <= index < 0x1A00:
        return of_pdo(index, sub, new, number)
    if 0x1600 <= index < 0x1800 or 0x1A00 <= index < 0x1C00:
        return of_mapping(index, sub, new, number)
    return None


Number = Callable[[int, int], int]
SIGNATURES = {0x1010: b"save", 0x1011: b"load"}
FRAME, EXTENDED, OFF = 0x3FFFFFFF, 0x3FFFF800, 1 << 31


def is_command(entry: Entry) -> bool:
    """What is written there is done, and kept nowhere."""
    return entry.index in SIGNATURES and entry.sub > 0


def is_restricted(cob_id: int) -> bool:
    """An identifier of 29 bits, or one that CiA 301 keeps for something."""
    kept = ((0, 0x7F), (0x101, 0x180), (0x581, 0x5FF), (0x601, 0x67F), (0x6E0, 0x6E0), (0x701, 0x77F), (0x780, 0x7FF))
    return bool(cob_id & EXTENDED) or any(first <= cob_id & 0x7FF <= last for first, last in kept)


def of_cob_id(old: int, new: int) -> int | None:
    """A COB-ID that bit 31 switches off: what is on does not change, except for being switched off."""
    if new & OFF:
        return WRONG_VALUE if new & EXTENDED else None
    if not old & OFF:
        return WRONG_VALUE if (old ^ new) & FRAME else None
    return WRONG_VALUE if is_restricted(new) else None


def of_produced(old: int, new: int) -> int | None:
    """1005h and 1012h: bit 30 makes the device send it, and then it keeps its identifier."""
    if old & new & 1 << 30 and (old ^ new) & FRAME:
        return WRONG_VALUE
    return WRONG_VALUE if is_restricted(new) else None


def of_consumer(sub: int, new: int, number: Number) -> int | None:
    node, time = new >> 16, new & 0xFFFF
    if node > 127:
        return WRONG_VALUE
    if not node or not time:
        return None
    others = [number(0x1016, other) for other in range(1, number(0x1016, 0) + 1) if other != sub]
    return INCOMPATIBLE if any(other >> 16 == node and other & 0xFFFF for other in others) else None


def of_pdo(index: int, sub: int, new: int, number: Number) -> int | None:
    """Communication parameters: some of them change only while the PDO is off."""
    cob_id = number(index, 1)
    receives = index < 0x1800
    if sub == 1:
        return WRONG_VALUE if receives and new & 1 << 30 else of_cob_id(cob_id, new)
    if sub == 2:
        return WRONG_VALUE if 241 <= new <= (253 if receives else 251) else None
    if sub == 6 and new > 240:
        return WRONG_VALUE
    if sub in (3, 6):
        return WRONG_VALUE if not cob_id & OFF and new != number(index, sub) else None
    return None


def of_mapping(index: int, sub: int, new: int, number: Number) -> int | None:
    """The mapping changes while the PDO is off, its entries while none of them counts."""
    if not number(index - 0x200, 1) & OFF or sub > 0 and number(index, 0) > 0:
        return IN_USE
    if sub == 0:
        return PDO_LENGTH if new > 64 else None
    if new in (0, number(index, sub)):
        return None
    return NO_OBJECT if new >> 16 == 0xFFFF else NOT_MAPPABLE
