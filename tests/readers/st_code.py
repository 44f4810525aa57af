"""What functions and function blocks of Structured Text do, compared with what the JSON dump says that they should."""

from __future__ import annotations

import math
import random
import re
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from st_dump import EXACT, Check, Device, Field, Quantity, away_of, fields_of, is_allowed, letters, mapping_of, pattern_of
from st_machine import BITS, ROUNDINGS, SIGNED, WHOLE, Fault, least_and_most

if TYPE_CHECKING:
    from st import Files


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
        """What a value may become: where it is very near the middle of two steps, either; but not where LREAL has all numbers on the way."""
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
                back(value, nearest(value), "next to a step")
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
    # What is not set goes out as the default.
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
