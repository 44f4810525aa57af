#!/usr/bin/env python3
"""Structured Text from `odgen st`, read by blark, a parser that others wrote, compared with the JSON dump, and evaluated.

    st.py --odgen target/debug/odgen --frames target/debug/pdo-frames od-spec/devices/pitch-control-system.od.yaml ...

Every file is parsed without a remark, in every language. Each constant and each value of an enum is one of the dump, and none of those is missing.
Functions and function blocks run in a controller of our own over blark's tree (st_machine.py): conversions at the limits, at special
values, between steps and anywhere, with every way in which tools round, against the exact fractions; bits, states and commands against
masks and patterns; PDOs against the mapping, and against frames that the generated Rust has packed. In the end faults are planted
into files, and each has to be found. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from pathlib import Path
from typing import Any, Iterable

from blark import transform as tree
from blark.parse import parse_source_code
from blark.util import find_and_clean_comments

from st_machine import BITS, ROUNDINGS, SIGNED, UNSIGNED, WHOLE, Controller, Fault, least_and_most, text_of

NODE = 5
LIMIT = 40  # differences that are shown
EXACT = 1 << 53
LONGEST = 120
CODES = {
    "boolean": 0x01, "integer8": 0x02, "integer16": 0x03, "integer32": 0x04, "unsigned8": 0x05, "unsigned16": 0x06, "unsigned32": 0x07,
    "real32": 0x08, "visible-string": 0x09, "octet-string": 0x0A, "unicode-string": 0x0B, "time-of-day": 0x0C, "time-difference": 0x0D,
    "domain": 0x0F, "integer24": 0x10, "real64": 0x11, "integer40": 0x12, "integer48": 0x13, "integer56": 0x14, "integer64": 0x15,
    "unsigned24": 0x16, "unsigned40": 0x18, "unsigned48": 0x19, "unsigned56": 0x1A, "unsigned64": 0x1B,
}
# Where an item of a file ends; a list of constants is one.
END = re.compile(r"(?<=^END_FUNCTION\n)|(?<=^END_FUNCTION_BLOCK\n)|(?<=^END_TYPE\n)", re.MULTILINE)


class Check:
    def __init__(self) -> None:
        self.done = 0
        self.wrong: list[str] = []

    def that(self, is_right: bool, what: str) -> None:
        self.done += 1
        if not is_right:
            self.wrong.append(what)


def run(*command: object) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


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


def parse(text: str) -> tuple[str | None, list[Any]]:
    """What blark says of a text, and the items in it."""
    result = parse_source_code(text)
    if result.exception is not None:
        return str(result.exception), []
    return None, result.transform().items


def items_of(text: str) -> list[str]:
    """The items of a file, with the comments above them."""
    items = [item for item in END.split(text) if item.strip()]
    assert "".join(END.split(text)) == text
    # What is behind the last item of a file of nothing is its head.
    return [item for item in items if re.search(r"^[A-Z]", item, re.MULTILINE)]


def constants_of(items: Iterable[Any]) -> tuple[list[str], dict[str, tuple[str, Any]]]:
    """Names in their order, and type and value of each constant."""
    names, found = [], {}
    controller = Controller([])
    for block in items:
        assert isinstance(block, tree.GlobalVariableDeclarations) and text_of(block.attrs).strip().upper().endswith("CONSTANT"), block
        for declaration in block.items:
            for variable in declaration.spec.variables:
                name = text_of(variable)
                init = declaration.init
                of_type = text_of(init.spec.type)
                names.append(name)
                found[name.upper()] = (of_type, controller.literal(init.value))
    return names, found


class Files:
    """What one run of `odgen st` made of a device, parsed."""

    def __init__(self, check: Check, where: str, texts: dict[str, str], pool: ProcessPoolExecutor | None) -> None:
        names = [name for name, text in texts.items() for _ in items_of(text)]
        parts = [item for text in texts.values() for item in items_of(text)]
        parsed = list(pool.map(parse, parts, chunksize=4) if pool else map(parse, parts))
        by_file: dict[str, list[Any]] = {name: [] for name in texts}
        for name, part, (wrong, items) in zip(names, parts, parsed):
            check.that(wrong is None, f"{where} {name}: blark refuses {wrong}\n{part[:400]}")
            by_file[name] += items
        self.constant_names, self.constants = [], {}
        code = []
        for name, items in by_file.items():
            if name.endswith("-constants.st"):
                self.constant_names, self.constants = constants_of(items)
            else:
                code += items
        self.controller = Controller(code)
        self.names = self.constant_names + self.controller.names


def check_names(check: Check, where: str, files: Files, texts: dict[str, str]) -> None:
    check.that(len({name.upper() for name in files.names}) == len(files.names), f"{where}: a name is given twice")
    scopes = [[member.name for member in members] for members in files.controller.structures.values()]
    scopes += [list(values) for _, values in files.controller.enums.values()]
    for code in files.controller.codes.values():
        scopes.append([one.name for one in code.inputs + code.in_outs + code.outputs + code.others])
    for scope in scopes:
        check.that(len({name.upper() for name in scope}) == len(scope), f"{where}: a name is given twice in {scope}")
    for name in files.names + [name for scope in scopes for name in scope]:
        check.that(len(name) <= LONGEST and "__" not in name and not name.endswith("_") and re.fullmatch(r"[A-Za-z]\w*", name) is not None, f"{where}: the name {name}")
    for name, text in texts.items():
        check.that(find_and_clean_comments(text)[1].isascii() or strip_comments(text).isascii(), f"{where}: {name} has letters outside ASCII in code")


def strip_comments(text: str) -> str:
    return re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)


class Constants:
    """The constants of a file, each of which has to be asked for."""

    def __init__(self, check: Check, where: str, files: Files) -> None:
        self.check, self.where = check, where
        self.all = files.constants
        self.left = dict(files.constants)

    def take(self, name: str, of_type: str, value: Any, what: str) -> None:
        """A constant of this name, type and value is there."""
        found = self.left.pop(name.upper(), None)
        self.check.that(found == (of_type, value), f"{self.where}: {what}: {name} is {found}, not {(of_type, value)}")

    def find(self, words: str, number: str, of_type: str, value: Any, what: str) -> None:
        """A constant is there whose name has these words; with a number behind it, where two would be one."""
        wanted = letters(words)
        for name, found in self.left.items():
            have = letters(name)
            if found == (of_type, value) and (have == wanted or re.fullmatch(re.escape(wanted) + re.escape(letters(number)) + r"\d*", have)):
                del self.left[name]
                self.check.done += 1
                return
        same = {name: found for name, found in self.left.items() if letters(name).startswith(wanted[:20])}
        self.check.that(False, f"{self.where}: {what}: no {words!r} of {value!r} as {of_type}; there are {dict(list(same.items())[:5])}")


def check_entries(check: Check, device: Device, constants: Constants, node: int | None) -> dict[tuple[int, int], str]:
    """The constants of entries. What the names of each entry begin with."""
    bases: dict[tuple[int, int], str] = {}
    for name, (of_type, index) in constants.all.items():
        sub = constants.all.get(name.removesuffix("_INDEX") + "_SUB")
        if name.endswith("_INDEX") and sub and of_type == "UINT" and (index, sub[1]) in device.entries:
            base = name.removesuffix("_INDEX")
            check.that((index, sub[1]) not in bases, f"{device.key}: {index:04X}h.{sub[1]} is there twice")
            bases[(index, sub[1])] = base
    for at, (one, entry) in device.entries.items():
        what = f"{at[0]:04X}h.{at[1]}"
        base = bases.get(at)
        check.that(base is not None, f"{device.key}: {what} has no index and sub-index")
        if base is None:
            continue
        whole = letters(f"{device.key} {device.name(at)}")
        cut = re.sub(rf"{at[0]:04x}{at[1]}$", "", letters(base))
        check.that(whole == letters(base) or cut != "" and whole.startswith(cut) or cut in ("x", "n" + whole), f"{device.key}: {base} for {what} {device.name(at)}")
        is_bits = device.is_bits(entry)
        of_type, bits = elementary(entry["type"], is_bits), width(entry["type"])
        constants.take(f"{base}_INDEX", "UINT", at[0], what)
        constants.take(f"{base}_SUB", "USINT", at[1], what)
        constants.take(f"{base}_DATATYPE", "UINT", CODES[entry["type"]], what)
        if bits is not None:
            constants.take(f"{base}_LENGTH", "UDINT", (bits + 7) // 8, what)
        elif "capacity" in entry:
            constants.take(f"{base}_LENGTH", "UDINT", entry["capacity"], what)

        def raw(value: Any) -> Any:
            if of_type == "BOOL":
                return bool(value)
            if of_type in ("REAL", "LREAL"):
                return float(value)
            return value % (1 << WHOLE[of_type]) if of_type in BITS else value

        default = entry["default"]
        if default is not None and "raw" in default and of_type is not None and ("formula" not in default or node is not None):
            shift = node if "formula" in default else 0
            if isinstance(default["raw"], (int, float)):
                constants.take(f"{base}_DEFAULT", of_type, raw(default["raw"] + shift), what)
        elif default is not None and entry["type"] == "visible-string" and default["text"] and default["text"] != '""':
            text = default["text"]
            if len(text) <= 80 and text.isascii() and text.isprintable():
                quoted = text.replace("$", "$$").replace("'", "$'")
                constants.take(f"{base}_DEFAULT", f"STRING[{len(text)}]", f"'{quoted}'", what)
        for key, beside, behind in [("low", "min", "LOW"), ("high", "max", "HIGH")]:
            limit = entry.get(beside, entry[key])
            if limit is not None and of_type is not None:
                constants.take(f"{base}_{behind}", of_type, raw(limit), what)
        for special in entry.get("special", []):
            number = f"{at[0]:04X}_{at[1]}_{abs(special['value'])}"
            constants.find(f"{base} {special['name']}", number, of_type, raw(special["value"]), f"{what}: {special['name']}")
    return bases


def check_types(check: Check, device: Device, files: Files, constants: Constants) -> None:
    """Values of enums and masks of bits, as constants; enums as types."""
    for named in device.used_types:
        begin = f"{device.key} {named['name']}"
        if "values" in named:
            of_type = elementary(named["base"])
            for value in named["values"]:
                sign = "m" if value["value"] < 0 else ""
                constants.find(f"{begin} {value['name']}", f"{sign}{abs(value['value'])}", of_type, value["value"], f"{named['name']}: {value['name']}")
            check_enum(check, device, files, begin, of_type, [(one["name"], one["value"]) for one in named["values"]])
            continue
        word = elementary(named["base"], is_bits=True)
        for field in named["bits"]:
            if field["usage"] != "used":
                continue
            first, last = field["first"], field["last"]
            number, mask = f"b{first}", ((1 << last - first + 1) - 1) << first
            names = [field["name"]] if field["name"] else []
            names += [f"{one['mode']} {one['name']}" for one in field.get("modes", [])]
            for name in names:
                what = f"{named['name']}: {name}"
                constants.find(f"{begin} {name} mask", number, word, mask, what)
                if first < last:
                    constants.find(f"{begin} {name} shift", number, "USINT", first, what)
                of_type = "USINT" if first == last else up(last - first + 1, UNSIGNED)
                for value in field.get("values", []):
                    constants.find(f"{begin} {name} {value['name']}", f"{number}_{value['value']}", of_type, value["value"], what)
            if field.get("values"):
                name = field["name"] or (f"bit {first}" if first == last else f"bits {first} {last}")
                values = [(one["name"], one["value"]) for one in field["values"]]
                check_enum(check, device, files, f"{begin} {name}", up(last - first + 1, UNSIGNED), values)


def check_enum(check: Check, device: Device, files: Files, words: str, base: str, values: list[tuple[str, int]]) -> None:
    found = [(name, of_type, members) for name, (of_type, members) in files.controller.enums.items() if letters(name) in (letters(words), letters(words) + "enum")]
    check.that(len(found) == 1, f"{device.key}: {len(found)} enums {words}")
    for name, of_type, members in found:
        check.that(of_type == base, f"{device.key}: the enum {name} is {of_type}, not {base}")
        check.that(sorted(members.values()) == sorted(value for _, value in values), f"{device.key}: the enum {name} has {members}")
        for member, value in members.items():
            wanted = {letters(one) for one, of in values if of == value}
            have = re.sub(rf"m?{abs(value)}$", "", letters(member)) if letters(member) not in wanted else letters(member)
            check.that(have in wanted or have.removeprefix("n") in wanted, f"{device.key}: {name}.{member} is {value}, not {wanted}")


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


def check_machines(check: Check, device: Device, files: Files, constants: Constants) -> None:
    chance = random.Random(7)
    for machine in device.machines:
        begin = f"{device.key} {machine['name']}"
        status, command = (device.of(machine[key]) for key in ("status", "command"))
        if status not in device.entries or command not in device.entries:
            continue
        words = [up(width(device.entries[at][1]["type"]), BITS) for at in (status, command)]
        constants.find(f"{begin} state none", "0", "INT", 0, begin)
        patterns = []
        for number, state in enumerate(machine["states"], 1):
            mask, value, _, _ = pattern_of(state["pattern"])
            patterns.append((mask, value))
            what = f"{begin}: {state['name']}"
            constants.find(f"{begin} state {state['name']}", str(number), "INT", number, what)
            constants.find(f"{begin} state {state['name']} mask", str(number), words[0], mask, what)
            constants.find(f"{begin} state {state['name']} value", str(number), words[0], value, what)
        function = "_".join(re.findall("[a-z0-9]+", begin.lower()))
        for word in [*range(0x200), *(chance.getrandbits(BITS[words[0]]) for _ in range(500)), *(value for _, value in patterns)]:
            expected = next((number for number, (mask, value) in enumerate(patterns, 1) if word & mask == value), 0)
            told, _ = files.controller.call(f"{function}_state", raw=word)
            check.that(told == expected, f"{begin}: {word:04X}h shows the state {told}, not {expected}")
        for number, one in enumerate(machine["commands"], 1):
            mask, value, rising, falling = pattern_of(one["pattern"])
            what = f"{begin}: {one['name']}"
            constants.find(f"{begin} command {one['name']}", str(number), "INT", number, what)
            for behind, bits in [("mask", mask), ("value", value), ("rising", rising), ("falling", falling)]:
                if bits or behind in ("mask", "value"):
                    constants.find(f"{begin} command {one['name']} {behind}", str(number), words[1], bits, what)
            if one.get("send") is not None:
                send = one["send"] if isinstance(one["send"], int) else int(one["send"], 16)
                constants.find(f"{begin} command {one['name']} send", str(number), words[1], send, what)
                check.that(send & mask == value, f"{what}: {send:04X}h does not give it")
            for _ in range(50):
                word = chance.getrandbits(BITS[words[1]])
                told, _ = files.controller.call(f"{function}_command", raw=word, command=number)
                check.that(told == word & ~mask | value, f"{what}: {word:04X}h becomes {told:04X}h")
        if machine["commands"]:
            told, _ = files.controller.call(f"{function}_command", raw=0x5A5A, command=len(machine["commands"]) + 1)
            check.that(told == 0x5A5A, f"{begin}: a command that there is not")
        for key, kind in [("states", "states"), ("commands", "commands")]:
            if machine[key]:
                values = [("none", 0)] + [(one["name"], number) for number, one in enumerate(machine[key], 1)]
                check_enum(check, device, files, f"{begin} {kind}", "INT", values)


def check_services(device: Device, constants: Constants, node: int | None) -> None:
    """Errors and PDOs as constants."""
    for error in device.errors:
        constants.find(f"{device.key} error {error['name']}", error["code"][2:], "UINT", int(error["code"], 16), f"error {error['code']}")
    for pdo in device.pdos:
        name = f"{device.key} {pdo['direction'][0].upper()}PDO{pdo['number']}"
        cob_id = pdo["cob-id"]
        if cob_id is not None:
            is_open = "formula" in cob_id and node is None
            shift = node if "formula" in cob_id and node is not None else 0
            constants.find(f"{name} can id {'base' if is_open else ''}", "pdo", "UDINT", cob_id["raw"] + shift & 0x1FFFFFFF, name)
        constants.find(f"{name} length", "pdo", "USINT", (sum(one["bits"] for one in pdo["map"]) + 7) // 8, name)
        for key, of_type in [("transmission", "USINT"), ("event-timer", "UINT"), ("inhibit-time", "UINT")]:
            if pdo[key] is not None:
                constants.find(f"{name} {key}", "pdo", of_type, pdo[key], name)


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
        self.low = max(self.least if low is None else low, -EXACT if bits > 32 else self.least)
        self.high = min(self.most if high is None else high, EXACT if bits > 32 else self.most)
        self.special = {one["value"] for one in entry.get("special", [])}

    def value(self, raw: int) -> Fraction:
        return raw * self.scale + self.offset


def conversions(device: Device, files: Files, bases: dict[tuple[int, int], str], at: tuple[int, int], behind: str) -> str | None:
    """The function of an entry, or that of its object."""
    one, _ = device.entries[at]
    whole = "_".join(re.findall("[a-z0-9]+", f"{device.key} {one['name']}".lower()))
    tell = f"_{at[0]:04x}_{at[1]}"
    of_object = rf"{re.escape(whole)}_{behind}(_{at[0]:04x}_\d+)?"
    base = bases[at].lower()
    for name in (f"{base}_{behind}", f"{base}_{behind}{tell}"):
        if name.upper() in files.controller.codes:
            return name
    return next((name.lower() for name in files.controller.codes if re.fullmatch(of_object, name.lower())), None)


def check_quantity(check: Check, where: str, files: Files, quantity: Quantity, to_value: str, to_raw: str | None, chance: random.Random) -> None:
    controller = files.controller
    raws = {quantity.least, quantity.least + 1, -1, 0, 1, quantity.most - 1, quantity.most, quantity.low, quantity.high, *quantity.special}
    raws |= {chance.randint(quantity.least, quantity.most) for _ in range(12)} | {raw + step for raw in quantity.special for step in (-1, 1)}
    raws = sorted(raw for raw in raws if quantity.least <= raw <= quantity.most)
    for raw in raws:
        told, after = controller.call(to_value, raw=raw, value=-12345.678)
        if raw in quantity.special:
            check.that(told is False and after["value"] == -12345.678, f"{where}: the special value {raw} is {told}, {after}")
            continue
        exact = quantity.value(raw)
        room = abs(exact) * Fraction(1, 2**51) if abs(raw) > EXACT else 0
        right = abs(Fraction(after["value"]) - exact) <= room or after["value"] == float(exact)
        check.that(told is True and right, f"{where}: {raw} is {told}, {after['value']}, not {float(exact)}")
    if to_raw is None:
        return
    old = 77 if quantity.least <= 77 <= quantity.most else quantity.most

    def back(value: float, accepted: set[int | None], what: str) -> None:
        try:
            told, after = controller.call(to_raw, value=value, raw=old)
        except Fault as fault:
            check.that(False, f"{where}: {value}: {fault}")
            return
        result = after["raw"] if told else None
        is_kept = told or after["raw"] == old
        check.that(result in accepted and is_kept, f"{where}: {what} {value!r} is {result}, not {accepted}; raw {after['raw']}")

    def taken(raw: int) -> int | None:
        return raw if quantity.low <= raw <= quantity.high and raw not in quantity.special else None

    def nearest(value: float) -> set[int | None]:
        """What a value may become: where it is a hair beside the middle of two steps, either; but not where LREAL has all numbers on the way."""
        steps = (Fraction(value) - quantity.offset) / quantity.scale
        parts = [Fraction(value).denominator, abs(value), *(abs(part) for one in (quantity.scale, quantity.offset) for part in (one.numerator, one.denominator))]
        room = 0 if max(parts) < 1 << 16 else (abs(steps) + abs(quantity.offset / quantity.scale) + 1) * Fraction(1, 2**50)
        return {taken(away_of(steps + shift)) for shift in (-room, 0, room)}

    for rounding in ROUNDINGS.values():
        controller.round = rounding
        for raw in raws:
            back(float(quantity.value(raw)), {taken(raw)}, "the step") if abs(raw) <= EXACT else None
        for raw in (quantity.low, quantity.high, 0, *quantity.special):
            for part in (-1, -0.75, -0.5, -0.49, 0.49, 0.5, 0.75, 1):
                value = float(quantity.value(raw) + Fraction(part) * quantity.scale)
                back(value, nearest(value), "beside a step")
        span = quantity.value(quantity.high) - quantity.value(quantity.low)
        for _ in range(6):
            value = float(quantity.value(quantity.low) + span * Fraction(chance.random() * 1.2 - 0.1))
            back(value, nearest(value), "anywhere")
        for eighth in range(-20, 20):
            value = float(round(quantity.value(max(quantity.low, min(0, quantity.high))))) + eighth / 8
            back(value, nearest(value), "an eighth")
        for value in (math.nan, math.inf, -math.inf, 1e300, -1e300):
            back(value, {None}, "no quantity")
    controller.round = ROUNDINGS["to even"]


def away_of(exact: Fraction) -> int:
    return math.floor(exact + Fraction(1, 2)) if exact >= 0 else math.ceil(exact - Fraction(1, 2))


def check_quantities(check: Check, device: Device, files: Files, bases: dict[tuple[int, int], str]) -> None:
    chance = random.Random(5)
    used = set()
    for at, (_, entry) in device.entries.items():
        if "unit" not in entry or "named-type" in entry or not entry["type"].startswith(("integer", "unsigned")) or at not in bases:
            continue
        where = f"{device.key} {at[0]:04X}h.{at[1]}"
        to_value = conversions(device, files, bases, at, "to_value")
        to_raw = conversions(device, files, bases, at, "to_raw")
        is_taken = entry["access"] in ("rw", "wo", "rwr", "rww")
        check.that(to_value is not None and (to_raw is not None) == is_taken, f"{where}: the functions are {to_value} and {to_raw}")
        if to_value is not None:
            used |= {to_value, to_raw}
            check_quantity(check, where, files, Quantity(device, entry), to_value, to_raw, chance)
    functions = {name.lower() for name in files.controller.codes if re.search(r"_to_(value|raw)(_[0-9a-f]{4}_\d+)?$", name.lower())}
    check.that(functions <= used, f"{device.key}: functions of no entry: {functions - used}")


def check_bits(check: Check, device: Device, files: Files) -> None:
    chance = random.Random(11)
    for named in device.used_types:
        fields = [field for field in named.get("bits", []) if field["usage"] == "used" and (field["name"] or field.get("modes"))]
        if not fields:
            continue
        wanted = letters(f"{device.key} {named['name']}")
        found = [name for name, code in files.controller.codes.items() if letters(name) in (wanted + "unpack", wanted + "unpackbits", wanted + "typeunpack")]
        check.that(len(found) == 1, f"{device.key}: {len(found)} functions for the bits of {named['name']}")
        if len(found) != 1:
            continue
        code = files.controller.codes[found[0]]
        members = files.controller.structures[code.returns.upper()]
        check.that(len(members) == len(fields), f"{code.returns}: {len(members)} members for {len(fields)} fields")
        for member, field in zip(members, fields):
            have = re.sub(rf"b{field['first']}$", "", letters(member.name)) if field["name"] else letters(member.name)
            expected = letters(field["name"]) or f"bit{field['first']}"
            check.that(have in (expected, letters(member.name) if letters(member.name) == expected else expected) or have.removeprefix("n") == expected or have.startswith("x"), f"{code.returns}: {member.name} for {field['name']}")
        bits = WHOLE[code.inputs[0].of_type]
        pack = next(name for name in files.controller.codes if name == re.sub("_UNPACK", "_PACK", found[0]))
        used = sum(((1 << field["last"] - field["first"] + 1) - 1) << field["first"] for field in fields)
        for _ in range(60):
            word = chance.getrandbits(bits)
            told, _ = files.controller.call(found[0], raw=word)
            for member, field in zip(members, fields):
                number = word >> field["first"] & (1 << field["last"] - field["first"] + 1) - 1
                expected = bool(number) if member.of_type == "BOOL" else number
                check.that(told[member.name.upper()] == expected, f"{code.returns}: {word:X}h: {member.name} is {told[member.name.upper()]}, not {expected}")
            again, after = files.controller.call(pack, bits=told, raw=chance.getrandbits(bits))
            check.that(again is True and after["raw"] == word & used, f"{pack}: {word:X}h came back as {after['raw']:X}h")
        for member, field in zip(members, fields):
            most = (1 << field["last"] - field["first"] + 1) - 1
            if member.of_type != "BOOL" and most < least_and_most(member.of_type)[1]:
                large = dict(told, **{member.name.upper(): most + 1})
                again, after = files.controller.call(pack, bits=large, raw=3)
                check.that(again is False and after["raw"] == 3, f"{pack}: {most + 1} in {member.name} is {again}, {after}")


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


def check_layout(check: Check, where: str, device: Device, files: Files, structure: str, fields: list[Field]) -> bool:
    members = files.controller.structures.get(structure)
    check.that(members is not None, f"{where}: no structure {structure}")
    if members is None:
        return False
    types = [one.of_type for one in members]
    check.that(types == [field.of_type for field in fields], f"{where}: {structure} has {types}")
    for member, field in zip(members, fields):
        if field.entry is not None:
            have = re.sub(rf"{field.at[0]:04x}{field.at[1]}\d*$", "", letters(member.name)).removeprefix("n")
            expected = letters(device.name(field.at)).removeprefix("n")
            check.that(have == expected or letters(member.name) == expected or have == "x", f"{where}: {structure}.{member.name} for {device.name(field.at)}")
    return types == [field.of_type for field in fields]


def check_frame(check: Check, where: str, files: Files, name: str, is_sent: bool, fields: list[Field], data: bytes) -> None:
    """The bytes of a frame and the structure of its raw values."""
    members = files.controller.structures[name.upper()]
    number = int.from_bytes(data, "little")
    expected = {member.name.upper(): field.raw(number) for member, field in zip(members, fields)}
    frame = list(data) + [0xEE] * (8 - len(data))
    if is_sent:
        told, _ = files.controller.call(f"{name}_unpack", data=frame)
        check.that(told == expected, f"{where}: {data.hex()} is {told}, not {expected}")
    else:
        told, after = files.controller.call(f"{name}_pack", raw=expected, data=[0xEE] * 8)
        check.that(told is True and bytes(after["data"]) == bytes(frame), f"{where}: {expected} is {bytes(after['data']).hex()}, not {bytes(frame).hex()}")


def check_pdos(check: Check, device: Device, files: Files, bases: dict[tuple[int, int], str], node: int | None) -> None:
    chance = random.Random(13)
    for pdo in device.pdos:
        mapping = mapping_of(device, pdo)
        bits = sum(parameter & 0xFF for parameter in mapping)
        if not mapping or bits > 64:
            continue
        fields = fields_of(device, mapping)
        is_sent = pdo["direction"] == "transmit"
        key = "_".join(re.findall("[a-z0-9]+", device.key))
        name = f"{key}_{'t' if is_sent else 'r'}pdo{pdo['number']}"
        name = f"n{name}" if name[0].isdigit() else name
        where = f"{device.key} {pdo['direction']} {pdo['number']}"
        if not check_layout(check, where, device, files, name.upper(), fields):
            continue
        has_real = any(field.of_type in ("REAL", "LREAL") for field in fields)
        behind = "unpack" if is_sent else "pack"
        check.that((f"{name}_{behind}".upper() in files.controller.codes) != has_real, f"{where}: {behind}")
        used = sum(((1 << field.bits) - 1) << field.first for field in fields)
        for _ in range(0 if has_real else 60):
            number = chance.getrandbits(bits) & (used if not is_sent else (1 << bits) - 1)
            check_frame(check, where, files, name, is_sent, fields, number.to_bytes((bits + 7) // 8, "little"))
        if not is_sent and not has_real:
            check_too_wide(check, where, files, name, fields)
        (check_in if is_sent else check_out)(check, where, device, files, bases, name, fields, chance, node)


def check_too_wide(check: Check, where: str, files: Files, name: str, fields: list[Field]) -> None:
    """A number with more bits than are mapped is refused."""
    members = files.controller.structures[name.upper()]
    zero = {member.name.upper(): field.raw(0) for member, field in zip(members, fields)}
    for member, field in zip(members, fields):
        if field.of_type == "BOOL" or WHOLE[field.of_type] == field.bits:
            continue
        ends = [1 << field.bits - 1, -(1 << field.bits - 1) - 1] if field.of_type in SIGNED else [1 << field.bits]
        for value in ends:
            told, after = files.controller.call(f"{name}_pack", raw=dict(zero, **{member.name.upper(): value}), data=[0xEE] * 8)
            check.that(told is False and after["data"] == [0xEE] * 8, f"{where}: {value} in {member.name} is {told}, {after}")


def any_raw(field: Field, chance: random.Random) -> Any:
    if field.of_type in ("REAL", "LREAL"):
        return chance.uniform(-1000, 1000)
    specials = [one["value"] for one in (field.entry or {}).get("special", [])] if field.is_whole else []
    return chance.choice(specials) if specials and chance.random() < 0.3 else field.raw(chance.getrandbits(64))


def check_in(check: Check, where: str, device: Device, files: Files, bases: dict, name: str, fields: list[Field], chance: random.Random, node: int | None) -> None:
    controller, block = files.controller, f"{name}_in"
    members = controller.structures[name.upper()]
    instance = controller.instance(block)
    kept: dict[str, float] = {}
    for _ in range(60):
        raws = {member.name: any_raw(field, chance) for member, field in zip(members, fields)}
        controller.cycle(block, instance, raw={key.upper(): value for key, value in raws.items()})
        for member, field in zip(members, fields):
            raw, told = raws[member.name], instance[member.name.upper()][1]
            here = f"{where}: {member.name} of {raw}"
            if field.is_whole and "unit" in field.entry and "named-type" not in field.entry and field.of_type in WHOLE:
                quantity = Quantity(device, field.entry)
                is_valid = instance[f"{member.name}_valid".upper()][1]
                check.that(is_valid == (raw not in quantity.special), f"{here} is valid: {is_valid}")
                expected = float(quantity.value(raw)) if is_valid else kept.get(member.name, 0.0)
                check.that(told == expected or abs(raw) > EXACT, f"{here} is {told}, not {expected}")
                kept[member.name] = told
            elif field.is_whole and isinstance(told, dict):
                bits = [one for one in device.types[field.entry["named-type"]]["bits"] if one["usage"] == "used"]
                numbers = [raw >> one["first"] & (1 << one["last"] - one["first"] + 1) - 1 for one in bits]
                check.that([int(one) for one in told.values()] == numbers, f"{here} is {told}")
            else:
                check.that(told == raw, f"{here} is {told}")
            for machine in device.machines:
                if device.of(machine["status"]) != field.at or not field.is_whole:
                    continue
                words = "_".join(re.findall("[a-z0-9]+", machine["name"].lower()))
                patterns = [pattern_of(state["pattern"])[:2] for state in machine["states"]]
                expected = next((number for number, (mask, value) in enumerate(patterns, 1) if raw & mask == value), 0)
                state = instance[f"{member.name}_{words}_state".upper()][1]
                check.that(state == expected, f"{here} shows the state {state}, not {expected}")


def check_out(check: Check, where: str, device: Device, files: Files, bases: dict, name: str, fields: list[Field], chance: random.Random, node: int | None) -> None:
    controller, block = files.controller, f"{name}_out"
    members = controller.structures[name.upper()]
    instance = controller.instance(block)

    def default(field: Field) -> Any:
        value = field.entry["default"] if field.is_whole else None
        if value is None or not isinstance(value.get("raw"), (int, float)) or "formula" in value and node is None:
            return {"BOOL": False, "REAL": 0.0, "LREAL": 0.0}.get(field.of_type, 0)
        raw = value["raw"] + (node if "formula" in value else 0)
        return bool(raw) if field.of_type == "BOOL" else raw % (1 << WHOLE[field.of_type]) if field.of_type in BITS else raw

    expected = {member.name.upper(): default(field) for member, field in zip(members, fields)}
    check.that(instance["RAW"][1] == expected, f"{where}: {block} begins with {instance['RAW'][1]}, not {expected}")
    # What nobody sets goes out as the default.
    controller.cycle(block, instance)
    check.that(instance["RAW"][1] == expected, f"{where}: {block} sends {instance['RAW'][1]} when nothing is set, not {expected}")
    for _ in range(60):
        inputs: dict[str, Any] = {}
        refused: dict[str, bool] = {}
        for member, field in zip(members, fields):
            is_quantity = field.is_whole and "unit" in field.entry and "named-type" not in field.entry and field.of_type in WHOLE
            if is_quantity and field.entry["access"] in ("rw", "wo", "rwr", "rww"):
                quantity = Quantity(device, field.entry)
                raw = chance.randint(quantity.low - 3, quantity.high + 3)
                if abs(raw) > EXACT:
                    raw = 0
                inputs[member.name] = float(quantity.value(raw))
                is_taken = quantity.low <= raw <= quantity.high and raw not in quantity.special
            else:
                raw = any_raw(field, chance)
                inputs[member.name] = raw
                is_taken = is_allowed(device, field, raw)
            refused[member.name] = not is_taken
            if is_taken:
                expected[member.name.upper()] = raw
        controller.cycle(block, instance, **inputs)
        check.that(instance["RAW"][1] == expected, f"{where}: {inputs} is {instance['RAW'][1]}, not {expected}")
        for member, field in zip(members, fields):
            accepted = instance.get(f"{member.name}_accepted".upper())
            if accepted is not None or refused[member.name]:
                check.that(accepted is not None and accepted[1] != refused[member.name], f"{where}: {member.name} = {inputs[member.name]} is accepted: {accepted}")


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


def texts_in(folder: Path, key: str) -> dict[str, str]:
    names = [f"{key}.st", f"{key}-constants.st", f"{key}-enums.st"]
    return {name: (folder / name).read_text(encoding="utf-8") for name in names if (folder / name).exists()}


def check_texts(check: Check, device: Device, texts: dict[str, str], node: int | None, pool: ProcessPoolExecutor | None) -> Files:
    """Everything that one set of files says and does."""
    files = Files(check, device.key, texts, pool)
    check_names(check, device.key, files, texts)
    constants = Constants(check, device.key, files)
    bases = check_entries(check, device, constants, node)
    check_types(check, device, files, constants)
    check_machines(check, device, files, constants)
    check_services(device, constants, node)
    check.that(not constants.left, f"{device.key}: constants of nothing: {list(constants.left)[:20]}")
    check_quantities(check, device, files, bases)
    check_bits(check, device, files)
    check_pdos(check, device, files, bases, node)
    return files


def check_spec(check: Check, odgen: Path, spec: Path, device: Device, pool: ProcessPoolExecutor) -> None:
    with tempfile.TemporaryDirectory() as folder:
        base = (odgen, "st", spec, "--device", device.key, "--out")
        run(*base, Path(folder, "en"), "--lang", "en", "--node", NODE)
        run(*base, Path(folder, "de"), "--lang", "de", "--node", NODE)
        run(*base, Path(folder, "any"), "--lang", "en")
        english, german, any_node = (texts_in(Path(folder, name), device.key) for name in ("en", "de", "any"))
    check_texts(check, device, english, NODE, pool)
    # blark parses what it has cleaned of comments: two texts that are one then parse alike.
    check.that(english != german, f"{device.key}: there is nothing in German")
    for name, text in german.items():
        same = strip_comments(text).split() == strip_comments(english[name]).split()
        check.that(same, f"{device.key}: {name} differs by language in more than comments")
        check.that(all(not has_mark(inner) for inner in re.findall(r"\(\*(.*?)\*\)", text, re.DOTALL)), f"{device.key}: a comment in {name}")
    # Without a node, COB-IDs and values that depend on it have none in them.
    differing = [line for name, text in any_node.items() for line in strip_comments(text).split("\n") if line not in strip_comments(english[name]).split("\n")]
    check.that(all("CAN_ID_BASE" in line or not line.strip() for line in differing), f"{device.key}: without a node there is {differing[:5]}")


def has_mark(inner: str) -> bool:
    return "(*" in inner or "*)" in inner


def check_frames(check: Check, odgen: Path, frames: Path, spec: Path, device: Device) -> int:
    """Frames that the generated Rust has packed, or taken apart."""
    by_mapping: dict[tuple[str, tuple[int, ...]], list[bytes]] = {}
    for line in run(frames, device.key).splitlines():
        direction, mapping, frame, _ = line.split(" ")
        by_mapping.setdefault((direction, tuple(int(one, 16) for one in mapping.split(","))), []).append(bytes.fromhex(frame))
    numbers = {direction: sorted(pdo["number"] for pdo in device.pdos if pdo["direction"] == direction and pdo["mapping"] == "variable")[:4] for direction in ("receive", "transmit")}
    waiting = {direction: [mapping for of, mapping in by_mapping if of == direction] for direction in numbers}
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        while any(waiting.values()):
            settings, placed = [], []
            for direction, of in numbers.items():
                for number in of:
                    if not waiting[direction]:
                        continue
                    mapping = waiting[direction].pop(0)
                    first = {"receive": (0x1400, 0x200), "transmit": (0x1800, 0x180)}[direction]
                    index = first[0] + number - 1
                    settings += [f"{index:04X}.1=0x{first[1] + 0x100 * (number - 1) + NODE:X}", f"{index + 0x200:04X}.0={len(mapping)}"]
                    settings += [f"{index + 0x200:04X}.{sub}=0x{one:08X}" for sub, one in enumerate(mapping, 1)]
                    placed.append((direction, number, mapping))
            dcf, out = Path(folder, "node.dcf"), Path(folder, "st")
            run(odgen, "dcf", spec, "--device", device.key, "--node", NODE, "--out", dcf, "--force", *(part for one in settings for part in ("--set", one)))
            run(odgen, "st", dcf, "--out", out, "--force")
            [path] = [path for path in out.glob("*.st") if not path.name.endswith(("-constants.st", "-enums.st"))]
            parts = [part for part in items_of(path.read_text(encoding="utf-8")) if re.search(r"^TYPE \w+_[RT]PDO\d+ :|^FUNCTION \w+_[rt]pdo\d+_(un)?pack ", part, re.MULTILINE)]
            files = Files(check, device.key, {path.name: "".join(parts)}, None)
            for direction, number, mapping in placed:
                fields = fields_of(device, list(mapping))
                name = f"{path.stem.lower().replace('-', '_')}_{direction[0]}pdo{number}"
                where = f"{device.key} {direction} {mapping}"
                if not check_dcf_layout(check, where, files, name, fields):
                    continue
                for frame in by_mapping[(direction, mapping)]:
                    count += 1
                    check_frame(check, where, files, name, direction == "transmit", fields, frame)
    return count


def check_dcf_layout(check: Check, where: str, files: Files, name: str, fields: list[Field]) -> bool:
    found = [key for key in files.controller.structures if key.endswith(name.upper().rsplit("_", 1)[1])]
    check.that(found == [name.upper()], f"{where}: the structures {found} for {name}")
    if found != [name.upper()]:
        return False
    types = [one.of_type for one in files.controller.structures[name.upper()]]
    check.that(types == [field.of_type for field in fields], f"{where}: {types}")
    return types == [field.of_type for field in fields]


# A fault: a file, what stands in it, and what is put there. All of the README's device.
FAULTS = [
    ("valve-constants.st", "SET_PRESSURE_INDEX : UINT := 16#2000", "SET_PRESSURE_INDEX : UINT := 16#2002"),
    ("valve-constants.st", "SET_PRESSURE_SUB : USINT := 0", "SET_PRESSURE_SUB : USINT := 1"),
    ("valve-constants.st", "SET_PRESSURE_HIGH : UINT := 160", "SET_PRESSURE_HIGH : UINT := 16"),
    ("valve-constants.st", "SET_PRESSURE_DEFAULT : UINT", "SET_PRESSURE_DEFAULT : INT"),
    ("valve-constants.st", "SENSOR_BROKEN : UINT := 65535", "SENSOR_BROKEN : UINT := 65534"),
    ("valve-constants.st", "RPDO1_CAN_ID : UDINT := 16#205", "RPDO1_CAN_ID : UDINT := 16#185"),
    ("valve-constants.st", "GENERIC_ERROR_MASK : BYTE := 16#01", "GENERIC_ERROR_MASK : BYTE := 16#02"),
    ("valve.st", "(data[0]) + BYTE_TO_UINT(data[1])", "(data[1]) + BYTE_TO_UINT(data[0])"),
    ("valve.st", "data[0] := UINT_TO_BYTE(u1 MOD 256);\ndata[1]", "data[1] := UINT_TO_BYTE(u1 MOD 256);\ndata[0]"),
    ("valve.st", "UINT_TO_LREAL(raw) / 10.0", "UINT_TO_LREAL(raw) * 10.0"),
    ("valve.st", "steps := value * 10.0", "steps := value * 100.0"),
    ("valve.st", "(whole <= 160)", "(whole <= 161)"),
    ("valve.st", "(whole <= 160)", "(whole < 160)"),
    ("valve.st", "IF rest >= 0.5 THEN", "IF rest > 0.5 THEN"),
    ("valve.st", "IF rest < -0.5 THEN", "IF rest <= -0.5 THEN"),
    ("valve.st", "IF (value > -0.1) AND (value < 16.1) THEN", "IF (value > -0.1) THEN"),
    ("valve.st", "raw := DINT_TO_UINT(whole);\n        valve_set_pressure_to_raw := TRUE", "valve_set_pressure_to_raw := TRUE"),
    ("valve.st", "IF (raw = 65535) THEN", "IF (raw = 65534) THEN"),
    ("valve.st", "set_pressure : UINT := 25;", "set_pressure : UINT := 0;"),
    ("valve.st", "set_pressure : LREAL := 2.5;", "set_pressure : LREAL;"),
    ("valve.st", "bits.voltage := (raw AND 16#04) <> 0", "bits.voltage := (raw AND 16#08) <> 0"),
    ("valve.st", "IF bits.voltage THEN\n    joined := joined OR 16#04", "IF bits.voltage THEN\n    joined := joined OR 16#02"),
    ("valve.st", "actual_pressure : UINT;", "actual_pressure : INT;"),
    ("valve.st", "bits.major_revision := UDINT_TO_UINT(DWORD_TO_UDINT(raw AND 16#FFFF0000) / 65536)", "bits.major_revision := UDINT_TO_UINT(DWORD_TO_UDINT(raw AND 16#FFFF0000) / 256)"),
    ("valve.st", "END_STRUCT;", "END_STRUC;"),
]


def check_faults(check: Check, odgen: Path, spec: Path, device: Device) -> int:
    """Each fault in the files of the README's device is found."""
    with tempfile.TemporaryDirectory() as folder:
        run(odgen, "st", spec, "--node", NODE, "--out", folder)
        texts = texts_in(Path(folder), device.key)
    # Items that no fault is in are parsed once.
    known: dict[str, tuple[str | None, list[Any]]] = {}

    def remembered(text: str) -> tuple[str | None, list[Any]]:
        head, block, inner = text.partition("VAR_GLOBAL CONSTANT\n")
        if block and "\n\n" in inner:
            groups = inner.removesuffix("END_VAR\n").split("\n\n")
            parsed = [remembered(f"{block}{group}\nEND_VAR\n") for group in groups]
            return next((wrong for wrong, _ in parsed if wrong), None), [item for _, items in parsed for item in items]
        if text not in known:
            known[text] = parse(text)
        return known[text]

    class Memory:
        @staticmethod
        def map(_: Any, parts: list[str], chunksize: int) -> list[Any]:
            return [remembered(part) for part in parts]

    for name, old, new in [("valve.st", "", ""), *FAULTS]:
        check.that(old in texts[name], f"{name} has no {old!r}")
        changed = dict(texts, **{name: texts[name].replace(old, new)}) if old else texts
        of_fault = Check()
        try:
            check_texts(of_fault, device, changed, NODE, Memory())
        except (Fault, KeyError, AssertionError, StopIteration) as fault:
            of_fault.that(False, repr(fault))
        check.that(bool(of_fault.wrong) == bool(old), f"{new!r} in place of {old!r}: {of_fault.wrong[:3]}")
    return len(FAULTS)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--frames", type=Path, required=True, help="pdo-frames of the tests")
    parser.add_argument("--as-it-is", type=Path, action="append", default=[], help="a specification of which there is no Rust")
    parser.add_argument("--faults", type=Path, help="the specification of the README's device, for planted faults")
    parser.add_argument("specs", type=Path, nargs="*")
    arguments = parser.parse_args()
    is_right = True

    def show(key: str, check: Check, what: str) -> None:
        nonlocal is_right
        for difference in check.wrong[:LIMIT]:
            print(f"  {difference}")
        print(f"{key}: {what}{check.done} checks, {len(check.wrong)} wrong", flush=True)
        is_right &= not check.wrong and check.done > 20

    with ProcessPoolExecutor() as pool:
        for spec in [*arguments.specs, *arguments.as_it_is, *([arguments.faults] if arguments.faults else [])]:
            dump = json.loads(run(arguments.odgen, "dump", spec))
            for one in dump["devices"]:
                device, check = Device(dump, one), Check()
                frames = 0
                try:
                    check_spec(check, arguments.odgen, spec, device, pool)
                    if spec in arguments.specs:
                        frames = check_frames(check, arguments.odgen, arguments.frames, spec, device)
                except Fault as fault:
                    check.that(False, f"{device.key}: {fault}")
                show(device.key, check, f"{frames} frames, " if frames else "")
                if spec == arguments.faults:
                    check = Check()
                    count = check_faults(check, arguments.odgen, spec, device)
                    show(device.key, check, f"{count} planted faults, ")
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
