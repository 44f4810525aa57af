#!/usr/bin/env python3
"""Structured Text from `odgen st`, read by blark, a parser that others wrote, compared with the JSON dump, and evaluated.

    st.py --odgen target/debug/odgen --frames target/debug/pdo-frames od-spec/devices/pitch-control-system.od.yaml ...

Every file is parsed without a remark, in every language; with `--sample`, of lists of constants one group of some, and the others, where all
values are plain numbers, are read by their lines, as those of the sample are, too, with the same outcome; and one planted fault of some. Each constant and each value of an enum is one of the dump, and none of those is missing.
Functions and function blocks run in a controller of our own over blark's tree (st_machine.py): conversions at the limits, at special
values, between steps and anywhere, with every way in which tools round, against the exact fractions; bits, states and commands against
masks and patterns; PDOs against the mapping, and against frames that the generated Rust has packed. In the end faults are planted
into files, and each has to be found. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, Iterable

from blark import transform as tree
from blark.parse import parse_source_code
from blark.util import find_and_clean_comments

from st_code import check_bits, check_frame, check_pdos, check_quantities
from st_constants import Constants, check_entries, check_machines, check_services, check_types
from st_dump import Check, Device, Field, fields_of
from st_machine import Controller, Fault, text_of

NODE = 5
LIMIT = 40  # differences that are shown
LEAST_CHECKS, LEAST_FAULTS = 2000, 4  # of a device; with fewer, something was left out
LONGEST = 120
SAMPLE = 12  # with `--sample`, one of so many groups of constants and of faults
# Where an item of a file ends; a list of constants is one.
LIST = "VAR_GLOBAL CONSTANT\n"
END = re.compile(r"(?<=^END_FUNCTION\n)|(?<=^END_FUNCTION_BLOCK\n)|(?<=^END_TYPE\n)", re.MULTILINE)
# Faults by device: the file, what is in it, and what is put there.
FAULTS: dict[str, list[tuple[str, str, str]]] = {
    "valve": [
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
    ],
    "scales": [
        ("scales-enums.st", "reverse_slow := -1", "reverse_slow := 1"),
        ("scales-enums.st", ") SINT;", ") INT;"),
        ("scales-constants.st", "SCALES_MODE_FORWARD : SINT := 1;", "SCALES_MODE_FORWARD : SINT := 2;"),
        ("scales.st", "raw.way_back + 16777216", "raw.way_back + 8388608"),
        ("scales.st", "BYTE_TO_UINT(data[0] AND 16#FE) / 2", "BYTE_TO_UINT(data[0] AND 16#FC) / 2"),
        ("scales.st", "BYTE_TO_UINT(data[2] AND 16#01) * 32768", "BYTE_TO_UINT(data[2] AND 16#01) * 256"),
        ("scales.st", "WORD_TO_UINT(raw AND 16#001C) / 4", "WORD_TO_UINT(raw AND 16#001C) / 2"),
        ("scales.st", "value * 8.0 + 800.0", "value * 8.0 - 800.0"),
        ("scales.st", "UDINT_TO_LREAL(raw) / 3.0", "UDINT_TO_LREAL(raw) * 0.333"),
        ("scales.st", "mode_accepted := (mode = -1) OR (mode = 0) OR (mode = 1)", "mode_accepted := (mode = -1) OR (mode = 0)"),
    ],
    "lift": [
        ("lift.st", "(raw AND 16#006F) = 16#0027", "(raw AND 16#006F) = 16#0023"),
        ("lift.st", "(raw AND 16#FF7F) OR 16#0080", "(raw AND 16#FF7F) OR 16#0040"),
        ("lift-constants.st", "_STATE_OPERATION_ENABLED_MASK : WORD := 16#006F", "_STATE_OPERATION_ENABLED_MASK : WORD := 16#004F"),
        ("lift-constants.st", "LIFT_ERROR_LOAD_CELL_BROKEN : UINT := 16#FF01", "LIFT_ERROR_LOAD_CELL_BROKEN : UINT := 16#FF02"),
    ],
}


def run(*command: object) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def parse(text: str) -> tuple[str | None, list[Any]]:
    """What blark says of a text, and the items in it."""
    result = parse_source_code(text)
    if result.exception is not None:
        return str(result.exception), []
    return None, result.transform().items


def items_of(text: str) -> list[str]:
    """The items of a file, with the comments above them; of a list of constants its groups, each as a list."""
    head, block, inner = text.partition(LIST)
    if block:
        return [f"{block}{group}\nEND_VAR\n" for group in inner.removesuffix("END_VAR\n").split("\n\n")]
    items = [item for item in END.split(text) if item.strip()]
    assert "".join(items) == text
    # What is after the last item of a file of nothing is its head.
    return [item for item in items if re.search(r"^[A-Z]", item, re.MULTILINE)]


LINE = re.compile(r"(\w+) : (\w+) := (16#[0-9A-F]+|-?[0-9]+);( \(\*.*\*\))?")


def lines_of(group: str) -> list[tuple[str, str, int]] | None:
    """Name, type and value of each constant of a group, by its lines; none if they are not all plain numbers."""
    lines = re.sub(r"(?m)^ *\(\*.*?\*\)$", "", group.removeprefix(LIST).removesuffix("\nEND_VAR\n"), flags=re.DOTALL).split("\n")
    found = [LINE.fullmatch(line.strip()) for line in lines if line.strip()]
    if None in found:
        return None
    return [(one[1], one[2], int(one[3].removeprefix("16#"), 16 if "#" in one[3] else 10)) for one in found]


def constants_of(items: Iterable[Any]) -> list[tuple[str, tuple[str, Any]]]:
    """Name, type and value of each constant."""
    found = []
    controller = Controller([])
    for block in items:
        assert isinstance(block, tree.GlobalVariableDeclarations) and text_of(block.attrs).strip().upper().endswith("CONSTANT"), block
        for declaration in block.items:
            for variable in declaration.spec.variables:
                init = declaration.init
                found.append((text_of(variable), (text_of(init.spec.type), controller.literal(init.value))))
    return found


class Parsed:
    """What blark has made of pieces, each once. Of groups of constants and of planted faults one of so many is taken."""

    def __init__(self, pool: ProcessPoolExecutor, every: int) -> None:
        self.pool = pool
        self.every = every
        self.known: dict[str, tuple[str | None, list[Any]]] = {}

    def all(self, parts: list[str]) -> list[tuple[str | None, list[Any]]]:
        new = [part for part in dict.fromkeys(parts) if part not in self.known]
        self.known.update(zip(new, self.pool.map(parse, new, chunksize=4) if len(new) > 1 else map(parse, new)))
        return [self.known[part] for part in parts]


class Files:
    """What one run of `odgen st` made of a device, parsed."""

    def __init__(self, check: Check, where: str, texts: dict[str, str], parsed: Parsed) -> None:
        self.constant_names: list[str] = []
        self.constants: dict[str, tuple[str, Any]] = {}
        code = []
        for name, text in texts.items():
            parts = items_of(text)
            is_list = name.endswith("-constants.st")
            items, plain = [], {}
            if is_list and parsed.every > 1:
                plain = {part: of_lines for part in parts if (of_lines := lines_of(part)) is not None}
                unread = [part for at, part in enumerate(parts) if at % parsed.every and part in plain]
                parts = [part for part in parts if part not in unread]
                for part in unread:
                    self.take((name, (of_type, value)) for name, of_type, value in plain[part])
            for part, (wrong, of_part) in zip(parts, parsed.all(parts)):
                check.that(wrong is None, f"{where} {name}: blark refuses {wrong}\n{part[:400]}")
                items += of_part
                if part in plain and wrong is None:
                    of_blark = [(name.upper(), *found) for name, found in constants_of(of_part)]
                    of_lines = [(name.upper(), of_type, value) for name, of_type, value in plain[part]]
                    check.that(of_lines == of_blark, f"{where} {name}: by lines {of_lines}, by blark {of_blark}")
            if is_list:
                self.take(constants_of(items))
            else:
                code += items
        self.controller = Controller(code)
        self.names = self.constant_names + self.controller.names

    def take(self, constants: Iterable[tuple[str, tuple[str, Any]]]) -> None:
        for name, found in constants:
            self.constant_names.append(name)
            self.constants[name.upper()] = found


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


def texts_in(folder: Path, key: str) -> dict[str, str]:
    names = [f"{key}.st", f"{key}-constants.st", f"{key}-enums.st"]
    return {name: (folder / name).read_text(encoding="utf-8") for name in names if (folder / name).exists()}


def check_texts(check: Check, device: Device, texts: dict[str, str], node: int | None, parsed: Parsed) -> None:
    """Everything that one set of files says and does."""
    files = Files(check, device.key, texts, parsed)
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


def check_spec(check: Check, odgen: Path, spec: Path, device: Device, parsed: Parsed) -> None:
    with tempfile.TemporaryDirectory() as folder:
        base = (odgen, "st", spec, "--device", device.key, "--out")
        run(*base, Path(folder, "en"), "--lang", "en", "--node", NODE)
        run(*base, Path(folder, "de"), "--lang", "de", "--node", NODE)
        run(*base, Path(folder, "any"), "--lang", "en")
        english, german, any_node = (texts_in(Path(folder, name), device.key) for name in ("en", "de", "any"))
    check_texts(check, device, english, NODE, parsed)
    # A list as it is, where that does not take minutes.
    whole = english[f"{device.key}-constants.st"]
    if len(whole) < 30_000:
        check.that(parse(whole)[0] is None, f"{device.key}: blark refuses the list as a whole")
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


def check_frames(check: Check, odgen: Path, frames: Path, spec: Path, device: Device, parsed: Parsed) -> int:
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
            files = Files(check, device.key, {path.name: "".join(parts)}, parsed)
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


def check_faults(check: Check, odgen: Path, spec: Path, device: Device, parsed: Parsed) -> int:
    """Each fault in the files of a device is found."""
    with tempfile.TemporaryDirectory() as folder:
        run(odgen, "st", spec, "--node", NODE, "--out", folder)
        texts = texts_in(Path(folder), device.key)
    faults = FAULTS[device.key][:: parsed.every]
    for name, old, new in [(f"{device.key}.st", "", ""), *faults]:
        check.that(old in texts[name], f"{name} has no {old!r}")
        changed = dict(texts, **{name: texts[name].replace(old, new)}) if old else texts
        of_fault = Check()
        try:
            check_texts(of_fault, device, changed, NODE, parsed)
        except (Fault, KeyError, AssertionError, StopIteration) as fault:
            of_fault.that(False, repr(fault))
        check.that(bool(of_fault.wrong) == bool(old), f"{new!r} in place of {old!r}: {of_fault.wrong[:3]}")
    return len(faults)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--frames", type=Path, required=True, help="pdo-frames of the tests")
    parser.add_argument("--as-it-is", type=Path, action="append", default=[], help="a specification of which there is no Rust")
    parser.add_argument("--faults", type=Path, action="append", default=[], help="a specification into whose files faults are planted")
    parser.add_argument("--sample", action="store_true", help="most constants are not parsed by blark, and most faults not planted")
    parser.add_argument("specs", type=Path, nargs="*")
    arguments = parser.parse_args()
    is_right = True

    def show(key: str, check: Check, what: str, least: int) -> None:
        nonlocal is_right
        for difference in check.wrong[:LIMIT]:
            print(f"  {difference}")
        too_few = f", fewer than {least}" if check.done < least else ""
        print(f"{key}: {what}{check.done} checks, {len(check.wrong)} wrong{too_few}", flush=True)
        is_right &= not check.wrong and not too_few

    with ProcessPoolExecutor() as pool:
        for spec in [*arguments.specs, *arguments.as_it_is, *arguments.faults]:
            dump = json.loads(run(arguments.odgen, "dump", spec))
            for one in dump["devices"]:
                device, check, parsed = Device(dump, one), Check(), Parsed(pool, SAMPLE if arguments.sample else 1)
                frames = 0
                try:
                    check_spec(check, arguments.odgen, spec, device, parsed)
                    if spec in arguments.specs:
                        frames = check_frames(check, arguments.odgen, arguments.frames, spec, device, parsed)
                except Fault as fault:
                    check.that(False, f"{device.key}: {fault}")
                show(device.key, check, f"{frames} frames, " if frames else "", LEAST_CHECKS)
                if spec in arguments.faults:
                    check = Check()
                    count = check_faults(check, arguments.odgen, spec, device, parsed)
                    show(device.key, check, f"{count} planted faults, ", 2 * LEAST_FAULTS)
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
