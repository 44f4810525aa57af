#!/usr/bin/env python3
"""Frames of the generated Rust, read by a DBC from `odgen dbc` with tools that others wrote: cantools and canmatrix.

    dbc.py --odgen target/debug/odgen --frames target/debug/pdo-frames od-spec/devices/pitch-control-system.od.yaml ...

Every entry of a device that can be mapped is mapped into some PDO, by a DCF; the DBC is made of that DCF. Each frame that
`pdo-frames` has packed is decoded by cantools, and each signal compared with the bytes of its entry and with what the JSON dump says of
unit, scale, names of values and bits; the decoded values, encoded again, are the frame. canmatrix finds the same messages and
signals. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import random
import struct
import subprocess
import sys
import tempfile
from collections import defaultdict
from fractions import Fraction
from pathlib import Path

import cantools
import canmatrix.formats

NODE = 5
COMMUNICATION = {"transmit": 0x1800, "receive": 0x1400}
# Identifiers of the first four PDOs of a node.
COB_ID = {"transmit": 0x180, "receive": 0x200}
LIMIT = 40  # differences that are shown


class Check:
    def __init__(self) -> None:
        self.done = 0
        self.wrong: list[str] = []

    def that(self, is_right: bool, what: str) -> None:
        self.done += 1
        if not is_right:
            self.wrong.append(what)


class Device:
    """What the dump says of a device."""

    def __init__(self, dump: dict, device: dict) -> None:
        self.key: str = device["key"]
        self.units = {unit["name"]: unit for unit in dump["units"]}
        self.types = {named["name"]: named for named in dump["types"]}
        self.entries = {}
        for one in device["objects"]:
            for entry in one["entries"]:
                self.entries[(int(one["index"], 16), entry["sub"])] = (one, entry)
        self.pdos: list[dict] = device["pdos"]
        numbers: dict[str, list[int]] = defaultdict(list)
        for pdo in device["pdos"]:
            if pdo["mapping"] == "variable":
                numbers[pdo["direction"]].append(pdo["number"])
        self.numbers = {direction: sorted(of)[:4] for direction, of in numbers.items()}


def run(*command: object) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def letters(name: str) -> str:
    """A name without what a signal cannot have in its own."""
    for old, new in [("ä", "ae"), ("ö", "oe"), ("ü", "ue"), ("ß", "ss"), ("µ", "u")]:
        name = name.lower().replace(old, new)
    return "".join(c for c in name if c.isascii() and c.isalnum())


def raw_of(data_type: str, data: bytes) -> int | float:
    if data_type.startswith("real"):
        return struct.unpack("<f" if len(data) == 4 else "<d", data)[0]
    return int.from_bytes(data, "little", signed=data_type.startswith("integer"))


def in_ascii(symbol: str | None) -> str | None:
    """The symbol of a unit as a DCF has it, and as it is read from there: degrees come back."""
    return symbol and symbol.replace("²", "2").replace("µ", "u")


def in_windows_1252(text: str | None) -> str | None:
    """A text as the format can have it: in a code page, and without quotation marks."""
    return text and text.replace("Ω", "Ohm").replace('"', "'")


def is_near(told: float, exact: Fraction) -> bool:
    """Tools reckon in 64 bits."""
    return abs(Fraction(told) - exact) <= abs(exact) * Fraction(1, 2**50)


def check_message(
    check: Check, where: str, device: Device, message: object, mapping: list[int], frame: bytes, values: list[bytes], of_dcf: bool
) -> None:
    raw = message.decode(frame, decode_choices=False, scaling=False)
    physical = message.decode(frame, decode_choices=False)
    named = message.decode(frame)
    signals = {(signal.start, signal.length): signal for signal in message.signals}
    first = 0
    for parameter, value in zip(mapping, values):
        bits = parameter & 0xFF
        one, entry = device.entries[(parameter >> 16, parameter >> 8 & 0xFF)]
        name = one["name"] if one["kind"] == "var" else f"{one['name']} {entry['name']}"
        here = f"{where} {parameter >> 16:04X}h.{parameter >> 8 & 0xFF}"
        kind = device.types.get(entry.get("named-type", ""), {})
        number = int.from_bytes(value, "little")
        fields = [field for field in kind.get("bits", []) if field["usage"] == "used"]
        if fields:
            for field in fields:
                length = field["last"] - field["first"] + 1
                signal = signals.pop((first + field["first"], length), None)
                check.that(signal is not None, f"{here}: no signal for bits {field['first']} to {field['last']}")
                if signal is None:
                    continue
                expected = number >> field["first"] & (1 << length) - 1
                check.that(raw[signal.name] == expected, f"{here}: {signal.name} is {raw[signal.name]}, not {expected}")
                if field["name"]:
                    check.that(letters(name + field["name"]) in letters(signal.name), f"{here}: {signal.name} for {name}: {field['name']}")
                # A DCF does not have the names of a field's values.
                names = {} if of_dcf else {one["value"]: one["name"] for one in field.get("values", [])}
                check.that(str(named[signal.name]) == names.get(expected, str(expected)), f"{here}: {named[signal.name]} is not the name of {expected}")
        else:
            signal = signals.pop((first, bits), None)
            check.that(signal is not None, f"{here}: no signal of {bits} bits at {first}")
            if signal is not None:
                expected = raw_of(entry["type"], value)
                is_same = raw[signal.name] == expected or expected != expected and raw[signal.name] != raw[signal.name]
                check.that(is_same, f"{here}: {signal.name} is {raw[signal.name]}, not {expected}")
                unit = device.units.get(entry.get("unit", ""), {"symbol": None, "scale": [1, 1]})
                symbol = in_ascii(unit["symbol"]) if of_dcf else in_windows_1252(unit["symbol"])
                check.that(signal.unit == symbol, f"{here}: unit {signal.unit}, not {symbol}")
                if isinstance(expected, int):
                    exact = expected * Fraction(*unit["scale"]) + Fraction(*unit.get("offset", [0, 1]))
                    check.that(is_near(physical[signal.name], exact), f"{here}: {physical[signal.name]}, not {exact}")
                    names = {one["value"]: in_windows_1252(one["name"]) for one in kind.get("values", [])}
                    for special in entry.get("special", []):
                        names.setdefault(special["value"], special["name"])
                    told = named[signal.name]
                    check.that((str(told) == names[expected]) if expected in names else told == physical[signal.name], f"{here}: {expected} is called {told}")
                check.that(letters(name) in letters(signal.name), f"{here}: {signal.name} for {name}")
        first += bits
    check.that(not signals, f"{where}: signals of nothing: {[signal.name for signal in signals.values()]}")
    # Back again: bits without a meaning are 0, and a number of 64 bits with a scale is one that a double holds.
    if all(signal.length < 50 or signal.conversion.scale == 1 for signal in message.signals):
        mask = sum(((1 << signal.length) - 1) << signal.start for signal in message.signals)
        if not any(value != value for value in physical.values()):
            again = message.encode(physical, strict=False)
            expected = int.from_bytes(frame, "little") & mask
            check.that(int.from_bytes(again, "little") == expected, f"{where}: {frame.hex()} came back as {again.hex()}")


def check_device(check: Check, odgen: Path, frames: Path, spec: Path, device: Device) -> int:
    by_mapping: dict[tuple[str, tuple[int, ...]], list[tuple[bytes, list[bytes]]]] = defaultdict(list)
    for line in run(frames, device.key).splitlines():
        direction, mapping, frame, values = line.split(" ")
        parameters = tuple(int(one, 16) for one in mapping.split(","))
        by_mapping[(direction, parameters)].append((bytes.fromhex(frame), [bytes.fromhex(one) for one in values.split(",")]))
    waiting = {direction: [mapping for of, mapping in by_mapping if of == direction] for direction in COMMUNICATION}
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        while any(waiting.values()):
            settings, placed = [], []
            for direction, numbers in device.numbers.items():
                for number in numbers:
                    if not waiting[direction]:
                        continue
                    mapping = waiting[direction].pop(0)
                    index = COMMUNICATION[direction] + number - 1
                    cob_id = COB_ID[direction] + 0x100 * (number - 1) + NODE
                    settings += [f"{index:04X}.1=0x{cob_id:X}", f"{index + 0x200:04X}.0={len(mapping)}"]
                    settings += [f"{index + 0x200:04X}.{sub}=0x{one:08X}" for sub, one in enumerate(mapping, 1)]
                    placed.append((direction, mapping, cob_id))
            dcf, dbc = Path(folder, "node.dcf"), Path(folder, "node.dbc")
            sets = [part for setting in settings for part in ("--set", setting)]
            run(odgen, "dcf", spec, "--device", device.key, "--node", NODE, "--out", dcf, "--force", *sets)
            run(odgen, "dbc", dcf, "--out", dbc, "--force")
            database = cantools.database.load_file(str(dbc), strict=True)
            other = canmatrix.formats.loadp_flat(str(dbc))
            check_other(check, device.key, database, other)
            count += sum(len(message.signals) for message in database.messages)
            for direction, mapping, cob_id in placed:
                message = database.get_message_by_frame_id(cob_id)
                for frame, values in by_mapping[(direction, mapping)]:
                    check_message(check, f"{device.key} {cob_id:03X}h", device, message, list(mapping), frame, values, of_dcf=True)
    return count


def check_spec(check: Check, odgen: Path, spec: Path, device: Device) -> int:
    """The PDOs of a specification as they are, with frames of any bits."""
    with tempfile.TemporaryDirectory() as folder:
        dbc = Path(folder, "node.dbc")
        run(odgen, "dbc", spec, "--node", f"{NODE}={device.key}", "--out", dbc)
        database = cantools.database.load_file(str(dbc), strict=True)
        check_other(check, device.key, database, canmatrix.formats.loadp_flat(str(dbc)))
    chance = random.Random(5)
    there = sum(bool(pdo["valid"] and pdo["map"]) for pdo in device.pdos)
    pdos = [message for message in database.messages if "PDO" in message.name]
    check.that(len(pdos) == there, f"{device.key}: {len(pdos)} PDOs, not {there}")
    for pdo in device.pdos:
        cob_id = (pdo["cob-id"]["raw"] + ("formula" in pdo["cob-id"]) * NODE) & 0x1FFFFFFF
        if not pdo["valid"] or not pdo["map"]:
            continue
        messages = [message for message in database.messages if message.frame_id == cob_id]
        check.that(bool(messages), f"{device.key}: no message {cob_id:03X}h")
        if not messages:
            continue
        cycle = pdo["event-timer"] if pdo["direction"] == "transmit" else None
        check.that(messages[0].cycle_time == (cycle or None), f"{device.key} {cob_id:03X}h: every {messages[0].cycle_time} ms")
        mapping = []
        for mapped in pdo["map"]:
            index, _, sub = mapped.get("entry", "0x0005").partition(".")
            mapping.append(int(index, 16) << 16 | int(sub or 0) << 8 | mapped["bits"])
        if any(parameter >> 16 < 0x20 for parameter in mapping):
            continue
        for _ in range(200):
            number, values, first = chance.getrandbits(64), [], 0
            for parameter in mapping:
                bits = parameter & 0xFF
                values.append((number >> first & (1 << bits) - 1).to_bytes((bits + 7) // 8, "little"))
                first += bits
            frame = (number & (1 << first) - 1).to_bytes(8, "little")[: (first + 7) // 8]
            check_message(check, f"{device.key} {cob_id:03X}h", device, messages[0], mapping, frame, values, of_dcf=False)
    return sum(len(message.signals) for message in database.messages)


def check_other(check: Check, where: str, database: object, other: object) -> None:
    """canmatrix in addition to cantools."""
    check.that(len(database.messages) == len(other.frames), f"{where}: {len(database.messages)} messages, canmatrix has {len(other.frames)}")
    for message in database.messages:
        frame = other.frame_by_name(message.name)
        check.that(frame is not None and frame.size == message.length, f"{where}: {message.name}: canmatrix has {frame}")
        for signal in message.signals:
            seen = frame and frame.signal_by_name(signal.name)
            facts = seen and (seen.start_bit, seen.size, float(seen.factor), float(seen.offset), seen.unit or None, seen.is_signed or seen.is_float)
            ours = (signal.start, signal.length, float(signal.conversion.scale), float(signal.conversion.offset), signal.unit, signal.is_signed)
            check.that(facts == ours, f"{where}: {signal.name}: {ours}, canmatrix has {facts}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--frames", type=Path, required=True, help="pdo-frames of the tests")
    parser.add_argument("--as-it-is", type=Path, action="append", default=[], help="a specification whose own PDOs are tried, with any bits")
    parser.add_argument("specs", type=Path, nargs="*")
    arguments = parser.parse_args()
    is_right = True
    for spec in [*arguments.specs, *arguments.as_it_is]:
        dump = json.loads(run(arguments.odgen, "dump", spec))
        for one in dump["devices"]:
            device, check = Device(dump, one), Check()
            if spec in arguments.specs:
                signals = check_device(check, arguments.odgen, arguments.frames, spec, device)
            else:
                signals = check_spec(check, arguments.odgen, spec, device)
            for difference in check.wrong[:LIMIT]:
                print(f"  {difference}")
            print(f"{device.key}: {signals} signals, {check.done} checks, {len(check.wrong)} wrong")
            is_right &= not check.wrong and check.done > 1000
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
