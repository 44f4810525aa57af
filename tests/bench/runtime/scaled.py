#!/usr/bin/env python3
"""Write the scaled model, for measurements at run time: the same objects in three languages.

    scaled.py MODEL --format od|toml|eds|rs [--out FILE]

`od` is a specification of this project, `toml` the device configuration of zencan-build, `eds` an
electronic data sheet, which canopen-host turns into Rust, `rs` what the bench has to know of the model.
MODEL says at which indices the objects are: `150` has 150 that follow each other, `full150` the same and the
objects of all services, `gappy150` has every second index free, `pmc` and `pmm` have the indices of these two devices of a real system above 1FFFh.
The same model always gives the same bytes.
Of every ten objects six are scalars (u16, i16, u32, i32, u8, i32), two are records of four members,
one is an array u16[8] and one a string of 16 characters: 2.6 entries and 6.7 bytes per object,
without sub-indices 0. Nothing has limits, because neither peer has any. TPDO 1 maps setpoint and
position of the channel in the middle, RPDO 1 its setpoint and speed.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

FIRST_AREA, FIRST_AREA_SIZE = 0x2000, 0x3FF0
SECOND_AREA, SECOND_AREA_SIZE = 0x6000, 0x4000
BLOCK = 10
LEAST_OBJECTS, MOST_OBJECTS = BLOCK, FIRST_AREA_SIZE + SECOND_AREA_SIZE
DEVICES = Path(__file__).resolve().parents[3] / "generated" / "pitch-control-system.json"
ARRAY_LENGTH = 8
STRING_CAPACITY = 16
VENDOR, PRODUCT, REVISION = 0x123, 0x150, 0x0001_0000


@dataclass(frozen=True)
class Type:
    """A data type: its name here, in zencan's configuration, its number in an EDS, its size in bytes."""

    od: str
    zencan: str
    eds: int
    size: int


U8 = Type("unsigned8", "uint8", 0x0005, 1)
U16 = Type("unsigned16", "uint16", 0x0006, 2)
U32 = Type("unsigned32", "uint32", 0x0007, 4)
I16 = Type("integer16", "int16", 0x0003, 2)
I32 = Type("integer32", "int32", 0x0004, 4)
STRING = Type("visible-string", f"VisibleString({STRING_CAPACITY})", 0x0009, STRING_CAPACITY)


@dataclass(frozen=True)
class Entry:
    """What follows an index and a sub-index."""

    name: str
    type: Type
    access: str = "rw"
    pdo: str = "none"
    default: int | str | None = None


@dataclass(frozen=True)
class Object:
    """An object. A VAR has one entry, an ARRAY one that represents all its elements."""

    index: int
    name: str
    kind: str
    entries: tuple[Entry, ...]


def indices_of(model: str) -> list[int]:
    """The indices of a model's objects; ValueError where there is no such model."""
    if model in ("pmc", "pmm"):
        devices = json.loads(DEVICES.read_text(encoding="utf-8"))["devices"]
        (device,) = (device for device in devices if device["key"] == model)
        indices = (int(one["index"], 16) for one in device["objects"])
        return [index for index in indices if index >= FIRST_AREA]
    if not (number := re.fullmatch(r"(gappy|full)?(\d+)", model)):
        raise ValueError(f"there is no model {model}")
    count, most = int(number[2]), MOST_OBJECTS // 2 if number[1] == "gappy" else MOST_OBJECTS
    if not LEAST_OBJECTS <= count <= most:
        raise ValueError(f"the model has {LEAST_OBJECTS} to {most} objects, not {count}")
    if number[1] == "gappy":
        return [FIRST_AREA + 2 * number for number in range(count)]
    return [index_of(number) for number in range(count)]


def objects(count: int) -> Iterator[Object]:
    """Those of the model without gaps."""
    return objects_at([index_of(number) for number in range(count)])


def objects_at(indices: list[int]) -> Iterator[Object]:
    for number, index in enumerate(indices):
        channel = number // BLOCK + 1
        name, entries = shape(number % BLOCK, channel)
        full = f"channel {channel} {name}"
        kind = {"controller": "record", "supervision": "record", "samples": "array"}.get(name, "var")
        yield Object(index, full, kind, entries)


def index_of(number: int) -> int:
    if number < FIRST_AREA_SIZE:
        return FIRST_AREA + number
    return SECOND_AREA + number - FIRST_AREA_SIZE


def shape(number: int, channel: int) -> tuple[str, tuple[Entry, ...]]:
    if number == 0:
        return "setpoint", (Entry("", U16, pdo="both", default=50 + channel % 100),)
    if number == 1:
        return "temperature", (Entry("", I16, "ro", "transmit"),)
    if number == 2:
        return "output mask", (Entry("", U32, default=channel * 0x9E3779B1 & 0xFFFFFFFF),)
    if number == 3:
        return "speed", (Entry("", I32, pdo="receive", default=-(channel % 50)),)
    if number == 4:
        return "mode", (Entry("", U8, default=1),)
    if number == 5:
        return "position", (Entry("", I32, "ro", "transmit"),)
    if number == 6:
        return "controller", (
            Entry("gain", U16, default=1000 + channel % 500),
            Entry("offset", I16),
            Entry("time", U32),
            Entry("filter", U8),
        )
    if number == 7:
        return "supervision", (
            Entry("limit", U16),
            Entry("hysteresis", I16, default=-5),
            Entry("delay", U32),
            Entry("reaction", U8),
        )
    if number == 8:
        return "samples", (Entry("sample", U16, "ro", "transmit"),)
    return "label", (Entry("", STRING, default=f"CH-{channel:05}"),)


def od(model: str, indices: list[int]) -> Iterator[str]:
    yield f"""\
# The scaled model: written by tests/bench/runtime/scaled.py {model}
od-spec: 1
title: Scaled model of {len(indices)} objects
vendor: {{name: Example Works, number: 0x{VENDOR:X}}}
uses: [cia301]
devices:
  controller: {{name: Scaled model, product: 0x{PRODUCT:X}, product-revision: 0x{REVISION:X}, bit-rates: [125, 500], {services(model)}}}
objects:
"""
    for one in objects_at(indices):
        head = f"  0x{one.index:04X}: {{name: {one.name}, "
        first = one.entries[0]
        if one.kind == "var":
            yield f"{head}{od_entry(first)}}}\n"
        elif one.kind == "array":
            entry = od_entry(first)
            yield f'{head}array: {{count: {ARRAY_LENGTH}, name: "{first.name} {{n}}", {entry}}}}}\n'
        else:
            yield f"{head}record: {{\n"
            for sub, entry in enumerate(one.entries, 1):
                yield f"    {sub}: {{name: {entry.name}, {od_entry(entry)}}},\n"
            yield "  }}\n"
    yield f"""\
pdos:
  controller:
    receive: {{1: {{map: [{places(receive(indices))}]}}}}
    transmit: {{1: {{no-rtr: yes, map: [{places(transmit(indices))}]}}}}
"""


def services(model: str) -> str:
    if not model.startswith("full"):
        return "features: [heartbeat producer]"
    features = ["heartbeat producer", "heartbeat consumer", "node guarding", "emergency", "emergency inhibit time"]
    features += ["error history", "error behaviour", "sync producer", "sync counter", "sync window", "emergency consumer"]
    return f"lss: yes, features: [{', '.join(features)}]"


def od_entry(entry: Entry) -> str:
    keys = [f"type: {entry.type.od}", f"access: {entry.access}"]
    if entry.type is STRING:
        keys.append(f"capacity: {STRING_CAPACITY}")
    if entry.pdo != "none":
        keys.append(f"pdo: {entry.pdo}")
    if entry.default is not None:
        keys.append(f"default: {entry.default}")
    return ", ".join(keys)


Mapped = tuple[tuple[int, int, Type], ...]


def middle(indices: list[int]) -> int:
    """Where a search from the start has to go half the way."""
    return len(indices) // 2 // BLOCK * BLOCK


def receive(indices: list[int]) -> Mapped:
    return ((indices[middle(indices)], 0, U16), (indices[middle(indices) + 3], 0, I32))


def transmit(indices: list[int]) -> Mapped:
    return ((indices[middle(indices)], 0, U16), (indices[middle(indices) + 5], 0, I32))


def places(mapped: Mapped) -> str:
    return ", ".join(f"0x{index:04X}" for index, _, _ in mapped)


def toml(model: str, indices: list[int]) -> Iterator[str]:
    # 5000h is an object of the model where there are many: zencan's own must not take its place
    yield f"""\
# The scaled model: written by tests/bench/runtime/scaled.py {model}
device_name = "Scaled model"
autostart = "unsupported"
support_storage = false

[identity]
vendor_id = {VENDOR}
product_code = {PRODUCT}
revision_number = {REVISION}

[pdos]
num_rpdo = 1
num_tpdo = 1
"""
    for direction, cob_id, mapped in (("rpdo", 0x200, receive(indices)), ("tpdo", 0x180, transmit(indices))):
        yield f"\n[pdos.{direction}.0]\nenabled = true\ncob_id = 0x{cob_id:X}\nadd_node_id = true\ntransmission_type = 254\n"
        yield "mappings = [\n"
        for index, sub, kind in mapped:
            yield f"    {{ index = 0x{index:04X}, sub = {sub}, size = {8 * kind.size} }},\n"
        yield "]\n"
    for one in objects_at(indices):
        yield f'\n[[objects]]\nindex = 0x{one.index:04X}\nparameter_name = "{one.name}"\nobject_type = "{one.kind}"\n'
        first = one.entries[0]
        if one.kind == "record":
            for sub, entry in enumerate(one.entries, 1):
                yield f'[[objects.subs]]\nsub_index = {sub}\nparameter_name = "{entry.name}"\n'
                yield toml_entry(entry)
        elif one.kind == "array":
            yield f"array_size = {ARRAY_LENGTH}\n{toml_entry(first)}"
        else:
            yield toml_entry(first)


def toml_entry(entry: Entry) -> str:
    pdo = {"none": "none", "both": "both", "receive": "rpdo", "transmit": "tpdo"}[entry.pdo]
    lines = [f'data_type = "{entry.type.zencan}"', f'access_type = "{entry.access}"', f'pdo_mapping = "{pdo}"']
    if entry.default is not None:
        lines.append(f"default_value = {written(entry.default)}")
    return "\n".join(lines) + "\n"


def written(value: int | str) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value)


def eds(model: str, indices: list[int]) -> Iterator[str]:
    standard = [
        Object(0x1000, "Device type", "var", (Entry("", U32, "ro", default=0),)),
        Object(0x1001, "Error register", "var", (Entry("", U8, "ro", default=0),)),
        Object(0x1017, "Producer heartbeat time", "var", (Entry("", U16, default=0),)),
        Object(
            0x1018,
            "Identity",
            "record",
            (
                Entry("Vendor-ID", U32, "ro", default=VENDOR),
                Entry("Product code", U32, "ro", default=PRODUCT),
                Entry("Revision number", U32, "ro", default=REVISION),
                Entry("Serial number", U32, "ro"),
            ),
        ),
    ]
    for base, cob_id, mapped in ((0x1400, "0x200", receive(indices)), (0x1800, "0x40000180", transmit(indices))):
        communication = (
            Entry("COB-ID", U32, default=f"$NODEID+{cob_id}"),
            Entry("Transmission type", U8, default=255),
        )
        values = [index << 16 | sub << 8 | 8 * kind.size for index, sub, kind in mapped] + [0] * (8 - len(mapped))
        mapping = tuple(Entry(f"Mapped entry {n}", U32, default=value) for n, value in enumerate(values, 1))
        standard += [
            Object(base, "PDO communication parameter", "record", communication),
            Object(base + 0x200, "PDO mapping parameter", "record", mapping),
        ]
    yield f"""\
; The scaled model: written by tests/bench/runtime/scaled.py {model}
[FileInfo]
FileName=controller.eds
FileVersion=1
FileRevision=0
EDSVersion=4.0

[DeviceInfo]
VendorName=Example Works
VendorNumber=0x{VENDOR:X}
ProductName=Scaled model
ProductNumber=0x{PRODUCT:X}
RevisionNumber=0x{REVISION:X}
"""
    mapped_subs = {0x1600: len(receive(indices)), 0x1A00: len(transmit(indices))}
    for one in (*sorted(standard, key=lambda one: one.index), *objects_at(indices)):
        if one.kind == "var":
            yield f"\n[{one.index:04X}]\nParameterName={one.name}\nObjectType=0x7\n{eds_entry(one.entries[0])}"
            continue
        first = one.entries[0]
        if one.kind == "array":
            subs = [Entry(f"{first.name} {n}", first.type, first.access, first.pdo) for n in range(1, ARRAY_LENGTH + 1)]
        else:
            subs = list(one.entries)
        kind = 8 if one.kind == "array" else 9
        yield f"\n[{one.index:04X}]\nParameterName={one.name}\nObjectType=0x{kind:X}\nSubNumber={len(subs) + 1}\n"
        highest = Entry("Highest sub-index", U8, "ro", default=len(subs))
        if one.index in mapped_subs:
            highest = Entry("Mapped entries", U8, "rw", default=mapped_subs[one.index])
        for sub, entry in enumerate((highest, *subs)):
            yield f"\n[{one.index:04X}sub{sub:X}]\nParameterName={entry.name}\nObjectType=0x7\n{eds_entry(entry)}"


def eds_entry(entry: Entry) -> str:
    access = entry.access
    if access == "rw":
        access = {"none": "rw", "both": "rw", "receive": "rww", "transmit": "rwr"}[entry.pdo]
    lines = [f"DataType=0x{entry.type.eds:04X}", f"AccessType={access}"]
    if entry.default is not None:
        lines.append(f"DefaultValue={entry.default}")
    lines.append(f"PDOMapping={int(entry.pdo != 'none')}")
    return "\n".join(lines) + "\n"


def rs(model: str, indices: list[int]) -> Iterator[str]:
    """A value of the bench's `Model`."""
    mapped = [index for index, _, _ in (*transmit(indices), receive(indices)[1])]
    lists = {"setpoints": 0, "records": 6, "arrays": 8}
    fields = [f"{name}: &[{numbers(indices[first::BLOCK])}]" for name, first in lists.items()]
    fields += [f"position: 0x{indices[5]:04X}", f"mapped: [{numbers(mapped)}]"]
    yield f'Model {{ name: "{model}", {", ".join(fields)} }}\n'


def numbers(indices: list[int]) -> str:
    return ", ".join(f"0x{index:04X}" for index in indices)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("model", help="150, gappy150, pmc, …")
    parser.add_argument("--format", choices=["od", "toml", "eds", "rs"], required=True)
    parser.add_argument("--out", type=Path, help="file to write; standard output without it")
    options = parser.parse_args()
    try:
        indices = indices_of(options.model)
    except ValueError as error:
        parser.error(str(error))
    text = "".join({"od": od, "toml": toml, "eds": eds, "rs": rs}[options.format](options.model, indices))
    if options.out:
        options.out.write_text(text, encoding="utf-8", newline="\n")
    else:
        sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # type: ignore[union-attr]
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
