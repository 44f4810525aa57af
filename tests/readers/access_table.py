#!/usr/bin/env python3
"""Try every kind of access on every entry of a node, with python-canopen as the master, and print a table of what came of it.

    access_table.py --dump generated/pitch-control-system.json --eds-dir generated/eds \\
        --odgen target/debug/odgen --spec od-spec/devices/pitch-control-system.od.yaml
    access_table.py --dump generated/pitch-control-system.json --eds-dir generated/eds --device pmc --at 127.0.0.1:3333

The first serves each device of the dump by `odgen serve` as node 5, the second finds node 5 at an address with SLCAN. The client knows the
device by its EDS; what must come of an access says access_rules.py. After each write the entry is read: it has the new value, or, where the write
was refused, the one from before. What was taken is given back at once. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import logging
import random
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import can
import canopen
from canopen.objectdictionary import ODVariable
from canopen.objectdictionary.datatypes import UNICODE_STRING
from canopen.sdo import SdoAbortedError

from access_rules import (
    NO_OBJECT,
    NO_SUB_INDEX,
    Entry,
    default_of,
    entries_of,
    expected_of_reading,
    expected_of_writing,
    holds,
    is_command,
    shown,
)
from patience import eventually
from sdo_client import NODE, read_in_blocks, write_in_blocks, write_in_segments
from virtual_node import Served

LENGTHS = (1, 4, 5, 7, 8, 14, 15, 888, 889, 890, 1800)
"""Of DOMAINs: a frame, segments, a block of 127 segments and what is around it, several blocks."""


class Table:
    """How often each operation had which outcome, and whether it was the right one."""

    def __init__(self) -> None:
        self.outcomes: dict[str, Counter[str]] = defaultdict(Counter)
        self.wrong: Counter[str] = Counter()
        self.failures: list[str] = []

    def add(self, operation: str, where: str, found: object, expected: object) -> None:
        outcome = f"{found >> 16:04X} {found & 0xFFFF:04X}h" if isinstance(found, int) else "done"
        self.outcomes[operation][outcome] += 1
        if found != expected:
            self.wrong[operation] += 1
            self.failures.append(f"{where}, {operation}: found {said(found)}, expected {said(expected)}")

    @property
    def tried(self) -> int:
        return sum(count.total() for count in self.outcomes.values())

    def text(self) -> Iterator[str]:
        width = max(map(len, self.outcomes))
        yield f"  {'operation':<{width}}  tried  right  wrong  outcomes"
        for operation, outcomes in self.outcomes.items():
            tried, wrong = outcomes.total(), self.wrong[operation]
            told = ", ".join(f"{outcome} {count}" for outcome, count in sorted(outcomes.items()))
            yield f"  {operation:<{width}}  {tried:>5}  {tried - wrong:>5}  {wrong:>5}  {told}"


def said(what: object) -> str:
    return f"{what:08X}h" if isinstance(what, int) else "done" if what is None else repr(what)


class Node:
    """The node, as one who tries things on it sees it."""

    def __init__(self, node: canopen.RemoteNode) -> None:
        self.sdo = node.sdo
        self.dictionary = node.object_dictionary

    def read(self, index: int, sub: int) -> bytes | int:
        return self.code(self.sdo.upload, index, sub)

    def write(self, index: int, sub: int, data: bytes) -> int | None:
        return self.code(self.sdo.download, index, sub, data)

    def code(self, access: Callable, *arguments):
        """The abort code of an access, or what it gave."""
        try:
            return access(*arguments)
        except SdoAbortedError as abort:
            return abort.code


class Trial:
    """All that is tried on a node that is as after a factory reset."""

    def __init__(self, node: Node, entries: list[Entry]) -> None:
        self.node = node
        self.entries = entries
        self.table = Table()

    def run(self) -> None:
        for entry in self.entries:
            self.reads(entry)
            if entry.has_numbers:
                for operation, value in self.numbers(entry):
                    self.write(operation, entry, entry.encode(value))
                self.lengths(entry)
            elif entry.is_text:
                self.texts(entry)
            elif entry.is_domain:
                self.domains(entry)
        self.what_is_not_there()

    def reads(self, entry: Entry) -> None:
        found = self.node.read(entry.index, entry.sub)
        expected: object = expected_of_reading(entry, NODE)
        if expected is None:
            expected = default_of(entry, NODE)
        if expected is None and entry.target is not None:
            target = self.node.read(entry.target.index, entry.target.sub)
            assert isinstance(target, bytes)
            expected = shown(entry, target)
        operation = "read"
        if expected is None:
            # It is not stated which value: it has the length of its type.
            operation = "read what has no default"
            right = isinstance(found, bytes) and (entry.is_text or len(found) == entry.size)
            expected = found if right else bytes(entry.size)
        self.table.add(operation, entry.name, found, expected)
        of_eds = entry.variable.default
        if isinstance(found, bytes) and of_eds is not None and entry.is_integer and "formula" not in (entry.facts["default"] or {}):
            self.table.add("read the default of the EDS", entry.name, found, entry.encode(of_eds))
        self.table.add("read in blocks", entry.name, self.node.code(read_in_blocks, self.node.sdo, entry.index, entry.sub), found)
        if isinstance(found, bytes) and found:
            self.write("write what it has", entry, found)
            if expected_of_writing(entry, found, self.node.read) is None:
                # The client does not end a stream that it gave up: what is refused is refused in one frame.
                self.write("write in segments", entry, found, write_in_segments)
                self.write("write in blocks", entry, found, write_in_blocks)

    def numbers(self, entry: Entry) -> Iterator[tuple[str, float]]:
        """Every boundary there is."""
        first, last = entry.ends
        low, high = entry.limits
        yield "write the lowest of the type", first
        yield "write the highest of the type", last
        if entry.facts["access"] in ("ro", "const"):
            return
        if entry.values is not None:
            for value in sorted(entry.values):
                yield "write a value of an enum", value
            others = {beside for value in entry.values for beside in (value - 1, value + 1)} - entry.values
            for value in sorted(others):
                if first <= value <= last:
                    yield "write what an enum has not", value
        for value in entry.special:
            yield "write a special value", value
            for step in (-1, 1):
                if (beside := entry.beside(value, step)) is not None:
                    yield "write beside a special value", beside
        for limit, step, names in ((low, -1, ("low", "below")), (high, 1, ("high", "above"))):
            if limit is None:
                continue
            yield f"write the {names[0]} limit", limit
            yield f"write just within the {names[0]} limit", entry.beside(limit, -step)
            if (beyond := entry.beside(limit, step)) is not None:
                yield f"write just {names[1]} the {names[0]} limit", beyond

    def lengths(self, entry: Entry) -> None:
        data = bytes(entry.size)
        self.write("write one byte too long", entry, data + b"\0")
        self.write("write in ten bytes", entry, data.ljust(10, b"\0"))
        if entry.size > 1:
            self.write("write one byte too short", entry, data[:-1])

    def texts(self, entry: Entry) -> None:
        room = entry.facts.get("capacity") or 8
        unit = 2 if entry.variable.data_type == UNICODE_STRING else 1
        whole = ("q\0" if unit == 2 else "q").encode() * (room // unit)
        self.write("write the longest text", entry, whole)
        if expected_of_writing(entry, whole, self.node.read) is None:
            self.write("write the longest text in segments", entry, whole, write_in_segments)
            self.write("write the longest text in blocks", entry, whole, write_in_blocks)
        self.write("write the shortest text", entry, whole[:unit])
        self.write("write a text too long", entry, whole + whole[:unit])
        self.write("write a text twice too long", entry, whole * 2)

    def domains(self, entry: Entry) -> None:
        for length in LENGTHS:
            data = bytes((at * 7 + length) % 256 for at in range(length))
            for way, write in (("segments", write_in_segments), ("blocks", write_in_blocks)):
                found = self.node.code(write, self.node.sdo, entry.index, entry.sub, data)
                self.table.add(f"write a DOMAIN in {way}", entry.name, found, expected_of_writing(entry, data, self.node.read))
                if found is None:
                    for how, read in (("segments", self.node.sdo.upload), ("blocks", lambda *id: read_in_blocks(self.node.sdo, *id))):
                        back = self.node.code(read, entry.index, entry.sub)
                        self.table.add(f"read a DOMAIN in {how}", f"{entry.name}, {length} bytes", back, data)

    def write(self, operation: str, entry: Entry, data: bytes, way: Callable | None = None) -> None:
        """Writes, sees what the entry has then, and gives back what it had."""
        index, sub = entry.index, entry.sub
        before = self.node.read(index, sub)
        expected = expected_of_writing(entry, data, self.node.read)
        found = self.node.code(way, self.node.sdo, index, sub, data) if way else self.node.write(index, sub, data)
        self.table.add(operation, f"{entry.name} = {data[:12].hex(' ')}", found, expected)
        if not isinstance(before, bytes):
            return
        after = self.node.read(index, sub)
        if found is None and is_command(entry):
            self.table.add("(read after a command)", f"{entry.name} after {operation}", after, before)
        elif found is None:
            self.table.add("(read what was written)", f"{entry.name} after {operation}", after, data)
            if data != before:
                self.table.add("(give it back)", f"{entry.name} after {operation}", self.node.write(index, sub, before), None)
        else:
            self.table.add("(read what was refused)", f"{entry.name} after {operation}", after, before)

    def what_is_not_there(self) -> None:
        subs: dict[int, set[int]] = defaultdict(set)
        for entry in self.entries:
            subs[entry.index].add(entry.sub)
        for index, known in subs.items():
            missing = {sub + 1 for sub in known} | {255} | ({1} if known == {0} else set())
            for sub in sorted(missing - known - {256}):
                self.absent("a missing sub-index", index, sub, NO_SUB_INDEX)
        chosen = random.Random(1)
        missing = {beside for index in subs for beside in (index - 1, index + 1)} | {chosen.randrange(0x10000) for _ in range(50)}
        for index in sorted((missing | {0, 0xFFFF}) - set(subs)):
            self.absent("a missing object", index, 0, NO_OBJECT)
            self.absent("a missing object", index, 3, NO_OBJECT)

    def absent(self, what: str, index: int, sub: int, expected: int) -> None:
        where = f"{index:04X}h.{sub}"
        self.table.add(f"read {what}", where, self.node.read(index, sub), expected)
        self.table.add(f"write {what}", where, self.node.write(index, sub, b"\0"), expected)

    def conditions(self, served: Served) -> None:
        """Entries that are writable only in some state, in the other one."""
        for entry in self.entries:
            condition = entry.facts.get("writable-when")
            if condition is None or " and " in condition or "bit" in condition:
                continue
            place, _, value = condition.partition(" == ") if " == " in condition else condition.partition(" != ")
            of = next(one for one in self.entries if one.name == f"{place[2:6]}h.{place[7:] or 0}")
            before = self.node.read(of.index, of.sub)
            assert isinstance(before, bytes)
            was = holds(condition, self.node.read)
            others = sorted(of.values) if of.values is not None else [int(value) + 1, int(value)]
            other = next(one for one in others if (str(one) == value) == ((" == " in condition) != was))
            self.bring(served, of, of.encode(other))
            data = self.node.read(entry.index, entry.sub)
            assert isinstance(data, bytes)
            self.write("write in the other state", entry, data)
            self.bring(served, of, before)

    def bring(self, served: Served, entry: Entry, data: bytes) -> None:
        """Makes the device itself put a value, and waits for it."""
        served.say(f"set {entry.index:04X}.{entry.sub}={entry.number(data)}")
        found = eventually(lambda: self.node.read(entry.index, entry.sub), data)
        self.table.add("(brought into a state)", entry.name, found, data)


def try_device(device: dict, types: list[dict], eds: Path, address: str | None, odgen: str, spec: Path) -> Table:
    served = None if address else Served(odgen, spec, device["key"], "--script", "-")
    channel = f"socket://{address}" if address else f"socket://127.0.0.1:{served.port if served else 0}"
    network = canopen.Network(can.Bus(interface="slcan", channel=channel, bitrate=500_000, sleep_after_open=0))
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        remote = canopen.RemoteNode(NODE, str(eds))
        network.add_node(remote)
        node = Node(remote)
        trial = Trial(node, entries_of(device, types, remote.object_dictionary))
        known = sum(1 if isinstance(one, ODVariable) else len(one) for one in remote.object_dictionary.values())
        trial.table.add("(entries of the EDS)", device["key"], known, len(trial.entries)) if known != len(trial.entries) else None
        trial.run()
        if served:
            trial.conditions(served)
        return trial.table
    finally:
        network.disconnect()
        if served:
            served.end()


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--dump", type=Path, required=True)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--device", help="only this one")
    parser.add_argument("--odgen", default="target/debug/odgen")
    parser.add_argument("--spec", type=Path)
    parser.add_argument("--at", metavar="HOST:PORT", help="a node that runs already, freshly started")
    parser.add_argument("--least", type=int, default=2000, help="fewer attempts are too few")
    options = parser.parse_args()
    logging.disable(logging.WARNING)  # the client knows the limits of the EDS, and says so
    dump = json.loads(options.dump.read_text(encoding="utf-8"))
    failed = 0
    devices = [one for one in dump["devices"] if options.device in (None, one["key"])]
    for device in devices:
        began = time.monotonic()
        table = try_device(device, dump["types"], options.eds_dir / f"{device['key']}.eds", options.at, options.odgen, options.spec)
        wrong = len(table.failures)
        print(f"python-canopen tries {device['key']}: {table.tried} attempts, {wrong} wrong, {time.monotonic() - began:.1f} s")
        for line in table.text():
            print(line)
        for failure in table.failures[:30]:
            print(f"  WRONG {failure}")
        failed += wrong > 0 or table.tried < options.least
    print(f"{len(devices) - failed} passed, {failed} failed")
    return 1 if failed or not devices else 0


if __name__ == "__main__":
    sys.exit(main())
