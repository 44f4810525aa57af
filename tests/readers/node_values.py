#!/usr/bin/env python3
"""Compare what python-canopen reads of EDS and DCF files with what the commands of odgen make of them.

    node_values.py --odgen target/debug/odgen tests/readers/nodes [FOLDER or FILE ...]

The value of an entry is its ParameterValue where one is written, else its DefaultValue. `odgen dump` is compared with all facts of
the file, `odgen serve` with the value of each entry that can be read, by SDO; `odgen dbc`, as cantools reads it, and `odgen decode`
with the PDOs that these values make. Prints a table; exit code 1 when there is a difference without a known reason.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

import can
import canopen
import cantools
from canopen.objectdictionary import ODVariable
from canopen.sdo import SdoAbortedError, SdoClient, SdoCommunicationError

from compare import NOT_EXPOSED, Case, Limit, Reading, Tool, compare
from expected import TIMES, Facts, expected_facts
from patience import PATIENCE
from python_canopen import DUMMIES, LIMITS, add_object, device_info, read
from unfold import unfolded

NODE = 5  # of a file that names none
DIRECTIONS = {"RPDO": (0x1400, 0x1600), "TPDO": (0x1800, 0x1A00)}
SHOWN = 40
ACCESS_TYPES = {"ro", "wo", "rw", "rwr", "rww", "const"}
POWERS = {1 << bits for bits in (8, 16, 32, 64)}
MAPPING = re.compile("1[6-7AB][0-9A-F]{2}sub0")
# What files of many makers do, and odgen reports when it checks them.
OF_FILES = (
    Limit("DeviceInfo has no such number", "the objects have it", lambda c: c.section == "DeviceInfo" and c.read is None),
    Limit("DeviceInfo contradicts the objects", "the objects are what a node has", lambda c: c.section == "DeviceInfo"),
    Limit("no name", "odgen names the index", lambda c: c.key == "ParameterName" and c.read == ""),
    Limit(
        "a name with spaces at its end or beyond ASCII", "an EDS is read in the code page that its texts speak for",
        lambda c: c.key == "ParameterName" and isinstance(c.read, str) and (c.read.strip() != c.read or not c.read.isascii()),
    ),
    Limit(
        "PDOs of CompactPDO", "a file need not describe them",
        lambda c: c.read is NOT_EXPOSED and re.match("1[4-7AB89]", c.section) is not None,
    ),
    Limit("no sub-index 0", "CiA 301 gives every record and array one", lambda c: c.section.endswith("sub0") and c.read is NOT_EXPOSED),
    Limit("sub-index 0 has no value", "it follows from the entries", lambda c: c.section.endswith("sub0") and c.key == "DefaultValue" and c.read is None),
    Limit("the count of a compact mapping is a value of the node", "CIA 306 has a constant", lambda c: MAPPING.fullmatch(c.section) is not None),
    Limit("a word for an access that no standard has", "odgen has a table of them", lambda c: c.key == "AccessType" and c.read not in ACCESS_TYPES),
    Limit("a value that its type does not have", "left out, which odgen reports", lambda c: c.key == "DefaultValue" and (is_no_value(c) or is_beyond(c))),
    Limit(
        "a signed number in its bit pattern", "CIA 306 allows both forms",
        lambda c: c.key == "DefaultValue" and isinstance(c.read, int) and isinstance(c.expected, int) and c.read - c.expected in POWERS,
    ),
    Limit("limits that no value of the type can have", "left out, which odgen reports", lambda c: c.key in ("LowLimit", "HighLimit") and is_beyond(c)),
    Limit(
        "a low limit above the high limit", "both are left out, which odgen reports",
        lambda c: c.section == "2020" and (c.key, c.read) in (("LowLimit", 3), ("HighLimit", 1)),
    ),
    Limit("a section of sub-index 255", "left out, which odgen reports", lambda c: c.section.endswith("subFF")),
    Limit("the errors of 1003h are empty at start", "CiA 301 7.5.2.4", lambda c: c.section == "1003sub0"),
)
TOOL = Tool("python-canopen", lambda _: "", read, LIMITS + OF_FILES)
COMMANDS = ("dump", "serve", "dbc", "decode")


@dataclass
class Row:
    files: int = 0
    facts: int = 0
    differences: list[str] = field(default_factory=list)
    named: Counter[str] = field(default_factory=Counter)

    def that(self, where: str, found: Any, expected: Any, known: str | None = None) -> None:
        self.facts += 1
        if found != expected and known:
            self.named[known] += 1
        elif found != expected:
            self.differences.append(f"{where}: {found!r}, python-canopen has {expected!r}")


@dataclass(frozen=True)
class Pdo:
    name: str
    cob_id: int
    mapped: list[int]

    @property
    def bits(self) -> int:
        return sum(parameter & 0xFF for parameter in self.mapped)


def is_no_value(case: Case) -> bool:
    return isinstance(case.read, str) and (case.read.startswith("not understood") or not case.read.isascii())


def is_beyond(case: Case) -> bool:
    bits = {1: 1, 2: 7, 3: 15, 4: 31, 5: 8, 6: 16, 7: 32}.get(case.data_type or 0)
    is_signed = (case.data_type or 0) in (2, 3, 4)
    return bits is not None and isinstance(case.read, int) and not (-(1 << bits) if is_signed else 0) <= case.read < 1 << bits


def value(entry: ODVariable) -> Any:
    return entry.default if entry.value is None else entry.value


def variables(dictionary: canopen.ObjectDictionary) -> list[ODVariable]:
    parts = [[one] if isinstance(one, ODVariable) else one.subindices.values() for one in dictionary.values()]
    return [entry for of_one in parts for entry in of_one]


def pdos(dictionary: canopen.ObjectDictionary) -> list[Pdo]:
    """The PDOs that are valid and map something."""
    def number(index: int, sub: int) -> int:
        one = dictionary.indices.get(index)
        found = None if one is None or isinstance(one, ODVariable) else one.subindices.get(sub)
        raw = None if found is None else value(found)
        return raw if isinstance(raw, int) else 0

    found = []
    for word, (communication, mapping) in DIRECTIONS.items():
        for at in range(512):
            if communication + at not in dictionary.indices:
                continue
            cob_id = number(communication + at, 1)
            mapped = [number(mapping + at, sub) for sub in range(1, number(mapping + at, 0) + 1)]
            if mapped and all(mapped) and not cob_id >> 31 and cob_id & 0x1FFFFFFF:
                found.append(Pdo(f"{word}{at + 1}", cob_id & 0x1FFFFFFF, mapped))
    return found


def told_apart(row: Row, pdos: list[Pdo]) -> list[Pdo]:
    """Those that a frame can carry, and that share their COB-ID with no other one."""
    of_cob_id = Counter(pdo.cob_id for pdo in pdos)
    kept = [pdo for pdo in pdos if pdo.bits <= 64 and of_cob_id[pdo.cob_id] == 1]
    if left_out := len(pdos) - len(kept):
        row.named["PDOs of more than 64 bits, or that share a COB-ID"] += left_out
    return kept


def run(*command: object) -> str:
    done = subprocess.run([str(one) for one in command], capture_output=True, encoding="utf-8", check=False)
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr.strip()[:300]}")
    return done.stdout


def check_dump(row: Row, odgen: Path, path: Path, node: int, dictionary: canopen.ObjectDictionary) -> None:
    (device,) = json.loads(run(odgen, "dump", path))["devices"]
    facts: Facts = {"DeviceInfo": device_info(dictionary)}
    for index, one in dictionary.indices.items():
        if index not in DUMMIES:
            add_object(facts, one, dcf=False)
    result = compare(TOOL, expected_facts(device, node, dcf=False), Reading(facts))
    row.facts += result.compared
    row.named += result.limits
    row.differences += [f"{path.name}: {one}" for one in result.differences]


def why_served_otherwise(entry: ODVariable, wanted: Any) -> str | None:
    if entry.index == 0x1003:
        return "the errors of 1003h are empty at start"
    if entry.index in (0x1010, 0x1011):
        return "1010h and 1011h say what the node can do (CiA 301 7.5.2.13)"
    if entry.data_type in TIMES:
        return "CIA 306 has no notation for TIME_OF_DAY and TIME_DIFFERENCE"
    if wanted in ("", b""):
        return "an empty ParameterValue is not a value"
    return None


def check_serve(row: Row, odgen: Path, path: Path, node: int, dictionary: canopen.ObjectDictionary) -> None:
    command = [str(odgen), "serve", str(path), "--node", str(node), "--slcan", "tcp:127.0.0.1:0"]
    pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere, text=True)
    try:
        assert process.stdout
        line = process.stdout.readline()
        if ":" not in line:
            raise RuntimeError("it does not serve")
        channel = f"socket://127.0.0.1:{line.rsplit(':', 1)[1].strip()}"
        network = canopen.Network(can.Bus(interface="slcan", channel=channel, bitrate=500_000, sleep_after_open=0))
        try:
            network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
            # A RemoteNode wants PDOs to be whole.
            client = SdoClient(0x600 + node, 0x580 + node, dictionary)
            client.network = network
            network.subscribe(client.tx_cobid, client.on_response)
            for entry in variables(dictionary):
                wanted = value(entry)
                if entry.index < 0x1000 or "r" not in entry.access_type and entry.access_type != "const" or wanted is None:
                    continue
                try:
                    served: Any = entry.decode_raw(client.upload(entry.index, entry.subindex))
                except SdoAbortedError as abort:
                    served = f"abort {abort.code:08X}h"
                except SdoCommunicationError as error:
                    raise RuntimeError(f"{entry.index:04X}h.{entry.subindex}: {error}") from error
                row.that(f"{path.name}: {entry.index:04X}h.{entry.subindex}", served, wanted, why_served_otherwise(entry, wanted))
        finally:
            network.disconnect()
    finally:
        process.kill()
        process.wait(timeout=PATIENCE)


def check_dbc(row: Row, odgen: Path, path: Path, node: int, expected: list[Pdo]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "node.dbc")
        run(odgen, "dbc", path, "--node", node, "--out", file)
        database = cantools.database.load_file(str(file), strict=False)
    messages = {message.frame_id: message for message in database.messages}
    found = sorted(message.frame_id for message in database.messages if "PDO" in message.name)
    row.that(f"{path.name}: the identifiers of PDOs", found, sorted({pdo.cob_id for pdo in expected if pdo.bits <= 64}))
    for pdo in told_apart(row, expected):
        if (message := messages.get(pdo.cob_id)) is None:
            continue
        where = f"{path.name}: {pdo.name}"
        row.that(f"{where} length", message.length, (pdo.bits + 7) // 8)
        first = 0
        for parameter in pdo.mapped:
            bits = range(first, first + (parameter & 0xFF))
            signals = [signal for signal in message.signals if signal.start in bits]
            is_whole = all(signal.start + signal.length <= bits.stop for signal in signals)
            row.that(f"{where} {parameter:08X}h has its own signals", bool(signals) and is_whole, parameter >> 16 >= 0x20)
            first = bits.stop


def check_decode(row: Row, odgen: Path, path: Path, node: int, expected: list[Pdo]) -> None:
    sent = told_apart(row, expected)
    frames = [f"({at}.0) can0 {pdo.cob_id:03X}#{'00' * ((pdo.bits + 7) // 8)}\n" for at, pdo in enumerate(sent)]
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder, "trace")
        trace.write_text("".join(frames))
        lines = run(odgen, "decode", path, "--node", node, "--trace", trace).splitlines() if frames else []
    told = {line.split(")", 1)[0].strip("( "): line for line in lines if line.startswith("(")}
    for at, pdo in enumerate(sent):
        line = told.get(f"{at}.0", "")
        wanted = {parameter >> 16 for parameter in pdo.mapped if parameter >> 16 >= 0x20}
        found = {int(index, 16) for index in re.findall(r"\b([0-9A-F]{4})h", line.split(")", 2)[-1])}
        row.that(f"{path.name}: {pdo.name} {pdo.cob_id:03X}h", sorted(found), sorted(wanted))


def read_text(text: str, path: Path, node: int | None) -> canopen.ObjectDictionary:
    source = StringIO(text)
    source.name = str(path)
    dictionary = canopen.import_od(source, node)
    if path.suffix.lower() == ".eds":
        for entry in variables(dictionary):
            entry.value = None  # an EDS has no values of a node; odgen says so
    return dictionary


def check_file(rows: dict[str, Row], odgen: Path, path: Path, asked: Path) -> None:
    """What python-canopen reads of a file compared with what the commands make of the file that they are asked for."""
    try:
        text = unfolded(path.read_text())
        node = read_text(text, path, None).node_id or NODE
        dictionary = read_text(text, path, node)
        expected = pdos(dictionary)
    except Exception as error:  # whatever a reader of others raises
        rows[next(iter(rows))].named[f"files that python-canopen cannot read: {type(error).__name__}"] += 1
        return
    checks = {"dump": (check_dump, dictionary), "serve": (check_serve, dictionary), "dbc": (check_dbc, expected), "decode": (check_decode, expected)}
    for command, (check, about) in checks.items():
        if command not in rows:
            continue
        if command != "dump" and not 1 <= node <= 127:
            rows[command].named["files without a node-ID"] += 1
            continue
        rows[command].files += 1
        try:
            check(rows[command], odgen, asked, node, about)
        except RuntimeError as error:
            rows[command].differences.append(f"{path.name}: {error}")


def notices(odgen: Path, paths: list[Path]) -> list[str]:
    """The commands that may lose ParameterValues without a difference: each is asked for copies without them."""
    rows = {command: Row() for command in ("serve", "dbc", "decode")}
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            copy = Path(folder, path.name)
            copy.write_bytes(re.sub(rb"(?mi)^ParameterValue=.*\n", b"", path.read_bytes()))
            check_file(rows, odgen, path, copy)
    return [command for command, row in rows.items() if not row.differences]


def files(places: list[Path]) -> list[Path]:
    found = [list(place.rglob("*")) if place.is_dir() else [place] for place in places]
    return sorted(path for of_one in found for path in of_one if path.suffix.lower() in (".eds", ".dcf"))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--self-test", action="store_true", help="also ask for files without their ParameterValues, and want differences")
    parser.add_argument("places", type=Path, nargs="+")
    arguments = parser.parse_args()
    rows = {command: Row() for command in COMMANDS}
    paths = files(arguments.places)
    for path in paths:
        check_file(rows, arguments.odgen, path, path)
    for command, row in rows.items():
        for difference in row.differences[:SHOWN]:
            print(f"  {command}: {difference}")
    print(f"{'command':<10}{'files':>8}{'facts':>10}{'differences':>14}")
    for command, row in rows.items():
        print(f"{command:<10}{row.files:>8}{row.facts:>10}{len(row.differences):>14}")
    for reason, count in sum((row.named for row in rows.values()), Counter()).items():
        print(f"  {count} known: {reason}")
    silent = notices(arguments.odgen, paths) if arguments.self_test else []
    for command in silent:
        print(f"FAIL: {command} without ParameterValues would not be noticed")
    is_right = not silent and all(row.files and row.facts and not row.differences for row in rows.values())
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
