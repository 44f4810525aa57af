"""Constants and enums of Structured Text compared with the JSON dump: every one that has to be there, and no other."""

from __future__ import annotations

import random
import re
from typing import TYPE_CHECKING, Any

from st_dump import CODES, Check, Device, elementary, letters, pattern_of, up, width
from st_machine import BITS, UNSIGNED, WHOLE

if TYPE_CHECKING:
    from st import Files


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
        """A constant is there whose name has these words; with a number after it, where two would be one."""
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
