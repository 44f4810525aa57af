#!/usr/bin/env python3
"""Let something go wrong in each command that an operator gives to a machine, and say what comes of it.

    fault_matrix.py --odgen target/debug/odgen [--self-test] [--write] [--only COMMAND] [--verbose]

A relay between `odgen node` and three virtual nodes does something to the frames of one of them, from a request in the middle of
the command on. Afterwards python-canopen reads every node, past the relay. Prints the table of docs/book/guides/live-bus.md;
`--write` writes it there. Exit code 1 when a command does something else than is expected here, or the page has another table.
"""

from __future__ import annotations

import argparse
import multiprocessing
import re
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

import fault_relay as relay
from fault_machine import DEVICES, ROOT, Done, Machine, Room, Running, State
from fault_relay import DOWNLOAD, UPLOAD, At, Fault, Id

PAGE = ROOT / "docs/book/guides/live-bus.md"
NODE = 11
"""The node whose frames something happens to: the second of three."""
FILES = ("A-pmm.yaml", "A-pmc.yaml", "B-pmc.yaml")
FULL = Room(of_file=4096)
"""A part of a file fits."""
NOT_A_BYTE = Room(of_file=0)
"""For commands that write no file: they need nothing."""
WORKERS = 4

COB_ID, COUNT, MAPPED, TARGET, VELOCITY = (0x1800, 1), (0x1A00, 0), (0x1A00, 2), (0x567A, 0), (0x5681, 0)
OFF = 1 << 31
"""The bit of a COB-ID that switches a PDO off."""
STORE = (0x1010, 1)


def new_values(node: int) -> list[tuple[Id, bytes]]:
    """What the files hold and the nodes do not, in an order that a node takes: TPDO 1 is switched off while its mapping changes."""
    values: list[tuple[Id, int, int]] = [
        (COB_ID, 0xC0000180 + node, 4),
        (COUNT, 0, 1),
        (MAPPED, 0x60610008, 4),
        (COUNT, 2, 1),
        (COB_ID, 0x40000180 + node, 4),
        (TARGET, 8500, 4),
        (VELOCITY, 1200, 4),
    ]
    if DEVICES[node] == "pmm":
        values = [((0x30C0, 0), 900, 2), ((0x30E1, 0), 45, 2)]
    return [(id, value.to_bytes(size, "little")) for id, value, size in values]


SETTINGS = [
    "1800.1=$NODEID + 0xC0000180",
    "1A00.0=0",
    "1A00.2=0x60610008",
    "1A00.0=2",
    "1800.1=$NODEID + 0x40000180",
    "EFC target position=85.00 °",
    "EFC profile velocity=1200",
]
"""The same for `odgen node write`."""

READ = At(UPLOAD, 60, MAPPED)
COMMANDS: dict[str, tuple[list[str], At]] = {
    "backup": (["backup", "{plant}", "--out", "kept"], READ),
    "compare": (["compare", "{plant}", "{new}"], READ),
    # The fourth value is the mapping of a PDO that is switched off.
    "restore": (["restore", "{plant}", "{new}", "--yes"], At(DOWNLOAD, 4, MAPPED)),
    "write": (["write", "{plant}", "--node", str(NODE), *SETTINGS, "--yes"], At(DOWNLOAD, 3, MAPPED)),
    "store": (["store", "{plant}", "--node", str(NODE), "--yes"], At(DOWNLOAD, 1, STORE)),
}
"""What is given to `odgen node`, and the request at which a fault begins."""

FAULTS: dict[str, tuple[type[Fault], Room]] = {
    "nothing": (Fault, Room()),
    "node dead": (relay.Dead, Room()),
    "wrong type": (relay.AnotherType, Room()),
    "wrong serial": (relay.AnotherSerial, Room()),
    "restarts in the middle": (relay.Resets, Room()),
    "slow": (relay.Slow, Room()),
    "request lost": (relay.RequestLost, Room()),
    "answer lost": (relay.AnswerLost, Room()),
    "request doubled": (relay.Doubled, Room()),
    "malformed answers": (relay.Malformed, Room()),
    "Ctrl-C": (relay.CtrlC, Room()),
    "disk full": (Fault, FULL),
    "standard output full": (Fault, Room(is_stdout_full=True)),
}

OLD, NEW, PART, STORED, UNSTORED = "as before", "new", "in part", "stored", "not stored"
WHOLE, LACKS, ABSENT, NONE = "whole", "whole, except for the entry", "absent", "–"


@dataclass(frozen=True)
class Expected:
    """What is right: exit code, state of each node, file."""

    code: int
    nodes: tuple[str, str, str]
    file: str = NONE


DONE = {
    "backup": r"kept/B-pmc\.yaml  \d+ values of B pmc \(node 12\)",
    "compare": "Bench 1: 3 of 3 nodes compared, 3 differ",
    "restore": "Bench 1: 3 of 3 nodes restored",
    "write": "5681h .*  written",
    "store": r"A pmc \(node 11\) has stored its parameters",
}
"""What is printed after success."""

FAILED = {
    "node dead": "the node does not answer",
    "wrong type": "node 11 is no `pmc`: 1000h Device type",
    "wrong serial": r"node 11 is another `pmc`: 1018h\.4 .*Serial number",
    "restarts in the middle": r"A pmc \(node 11\) started again in the middle",
    "slow": "the node does not answer",
    "request lost": "the node does not answer",
    "answer lost": "the node does not answer",
    "malformed answers": "the node's answer is malformed",
    "Ctrl-C": "interrupted before all was",
    "disk full": r"cannot write kept/A-pmm\.yaml",
    "standard output full": "cannot write to standard output",
}
"""What is printed where a command fails."""

AGAIN = r"A pmc \(node 11\): 1 value was read only when asked for again"
HAS_IT = "read back, it has the value"
OVERCOME = {
    **{(command, fault): AGAIN for command in ("backup", "compare") for fault in ("slow", "request lost", "answer lost")},
    **{(command, fault): HAS_IT for command in ("restore", "write") for fault in ("slow", "answer lost")},
    ("restore", "request lost"): "read back, it does not have the value, which is written again",
    ("backup", "malformed answers"): r"left out: 1A00h\.2 ",
}
"""What is printed where a command succeeds all the same."""


def said(command: str, fault: str) -> list[str]:
    is_done = expected(command, fault).code in (0, 3)
    overcome = OVERCOME.get((command, fault)) if is_done else None
    return [DONE[command] if is_done else FAILED[fault], *([overcome] if overcome else [])]


def expected(command: str, fault: str) -> Expected:
    same = (OLD, OLD, OLD)
    match command:
        case "backup":
            fails = fault in ("node dead", "wrong type", "wrong serial", "restarts in the middle", "disk full")
            code = 130 if fault == "Ctrl-C" else int(fails or fault == "standard output full")
            file = ABSENT if fails or fault == "Ctrl-C" else LACKS if fault == "malformed answers" else WHOLE
            return Expected(code, same, file)
        case "compare":
            fails = fault not in ("nothing", "slow", "request lost", "answer lost", "request doubled", "disk full")
            return Expected(130 if fault == "Ctrl-C" else 1 if fails else 3, same)
        case "restore":
            match fault:
                case "wrong type" | "wrong serial" | "standard output full":
                    # Nothing is sent before every node is known to be the right one.
                    return Expected(1, same)
                case "Ctrl-C":
                    return Expected(130, (NEW, PART, OLD))
                case "node dead" | "malformed answers" | "restarts in the middle":
                    return Expected(1, (NEW, PART, NEW))
            return Expected(0, (NEW, NEW, NEW))
        case "write":
            match fault:
                case "wrong type" | "wrong serial" | "standard output full":
                    return Expected(1, same)
                case "restarts in the middle":
                    # It has lost what was written, and the next value is refused because TPDO 1 is on again.
                    return Expected(1, same)
                case "node dead" | "malformed answers" | "request lost" | "Ctrl-C":
                    return Expected(130 if fault == "Ctrl-C" else 1, (OLD, PART, OLD))
            return Expected(0, (OLD, NEW, OLD))
        case "store":
            is_stored = fault not in ("wrong type", "wrong serial", "restarts in the middle", "request lost", "standard output full")
            is_known = fault in ("nothing", "request doubled", "Ctrl-C", "disk full")
            return Expected(0 if is_known else 1, (OLD, STORED if is_stored else UNSTORED, OLD))
    raise ValueError(command)


@dataclass(frozen=True)
class Baseline:
    """What is the same in all cells: what nodes have before, what the files hold, and a backup over a good bus."""

    odgen: str
    folder: Path
    old: dict[int, State]
    new: dict[int, State]
    kept: dict[str, bytes]


@dataclass(frozen=True)
class Observed:
    """What came of a command."""

    done: Done
    has_begun: bool
    nodes: dict[int, State]
    after_reset: State
    """What the node has after a restart, where it was commanded to store."""
    files: dict[str, bytes]
    loads: bool
    again: tuple[int, dict[int, State]] | None
    """Exit code and state of the nodes after `restore` or `write` failed and was given again, over a good bus."""


@dataclass
class Cell:
    command: str
    fault: str
    observed: Observed
    problems: list[str] = field(default_factory=list)


def set_up(odgen: str, folder: Path) -> Baseline:
    """Gives nodes the new values and keeps them as files."""
    machine = Machine(odgen, folder)
    try:
        old = machine.state()
        kept = machine_backup(machine, folder, "old")
        machine.give({node: new_values(node) for node in DEVICES})
        machine_backup(machine, folder, "new")
        return Baseline(odgen, folder, old, machine.state(), kept)
    finally:
        machine.end()


def machine_backup(machine: Machine, folder: Path, name: str) -> dict[str, bytes]:
    done = machine.node(["backup", str(machine.plant), "--out", name], folder, Fault(NODE, READ), Running(), Room())
    assert done.code == 0, done.err
    return files_in(folder / name)


def files_in(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else b"" for path in folder.rglob("*")}


def observe(machine: Machine, baseline: Baseline, command: str, fault: str) -> Observed:
    """Lets it happen."""
    arguments, at = COMMANDS[command]
    kind, room = FAULTS[fault]
    if fault == "disk full" and command != "backup":
        room = NOT_A_BYTE
    running = Running()
    happens = kind(NODE, at, running.interrupt)
    if command == "store":
        machine.give({NODE: [(TARGET, baseline.new[NODE][TARGET])]})
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        given = [text.format(plant=machine.plant, new=baseline.folder / "new") for text in arguments]
        done = machine.node(given, folder, happens, running, room)
        nodes = machine.state()
        again = None
        if command in ("restore", "write") and done.code != 0:
            repeated = machine.node(given, folder, Fault(NODE, at), Running(), Room())
            again = repeated.code, machine.state()
        after_reset: State = {}
        if command == "store":
            machine.reset()
            with machine.nodes() as clients:
                after_reset = {TARGET: clients[NODE].upload(*TARGET)}
        files, loads = files_in(folder), False
        kept = {name: files.get(f"kept/{name}") for name in FILES}
        if all(kept.values()) and kept != baseline.kept:
            compared = machine.node(["compare", str(machine.plant), str(folder / "kept")], folder, Fault(NODE, at), Running(), Room())
            loads = compared.code == 0
    machine.forget()
    return Observed(done, happens.has_begun, nodes, after_reset, files, loads, again)


# What is said.

WORD = re.compile(r"(?:[\w ]*\(node (\d+)\)[:,]? )?.*?\b([0-9A-F]{4})h(?:\.(\d+))? ")


@dataclass
class Lists:
    """What a command says of the values that it sends to a node."""

    written: set[Id] = field(default_factory=set)
    unsent: set[Id] = field(default_factory=set)
    doubtful: set[Id] = field(default_factory=set)
    """Refused, or in doubt."""
    left_off: set[Id] = field(default_factory=set)
    """COB-IDs of PDOs that are switched off."""

    @property
    def missing(self) -> set[Id]:
        return self.unsent | self.doubtful


def lists(done: Done, node: int) -> Lists:
    found = Lists()
    for line in (done.out + done.err).splitlines():
        is_off = "not switched on again: " in line
        is_written = line.endswith("  written")
        is_unsent = line.startswith("note: ") and "not sent" in line
        is_failed = line.startswith("error[") and "cannot write" in line
        match = WORD.match(line.partition(": ")[2] if is_unsent or is_failed or is_off else line)
        if not match or int(match[1] or NODE) != node:
            continue
        id = int(match[2], 16), int(match[3] or 0)
        if is_off:
            found.left_off.add(id)
        elif is_written:
            found.written.add(id)
        elif is_unsent:
            found.unsent.add(id)
        elif is_failed:
            found.doubtful.add(id)
    return found


def printed(done: Done) -> list[str]:
    """The lines that matter most: the error that explains most, what is known of values and files, and the last line about a machine."""
    lines = done.err.splitlines()
    errors = [re.sub(r"^error(\[\w+\])?: ", "", line) for line in lines if line.startswith("error")]
    errors.sort(key=lambda error: "started again" not in error and "interrupted" not in error)
    notes = [line.removeprefix("note: ") for line in lines if line.startswith("note: ")]
    unsent = [note for note in notes if re.search("not sent any more|not sent, as", note)]
    less = [note for note in notes if errors and re.search("a rule looks at|^read back, it is", note)]
    found = [*errors[:1], *(note for note in notes if note not in unsent and note not in less)]
    if unsent:
        found.append(f"{len(unsent)} entries are named as not sent")
    of_machine = [line for line in done.out.splitlines() if line.startswith("Bench 1")]
    return found + (of_machine or [line.strip() for line in done.out.splitlines()[-1:] if done.code == 0])


# What is right.


def judge(command: str, fault: str, baseline: Baseline, observed: Observed) -> list[str]:
    """What is wrong with it."""
    right, done, problems = expected(command, fault), observed.done, []
    if FAULTS[fault][0] is not Fault and not observed.has_begun:
        problems.append("nothing happened to the command")
    if done.code != right.code:
        problems.append(f"exit code {done.code}, and {right.code} is right")
    if "panicked" in done.err:
        problems.append("it panics")
    if not printed(done) or right.code not in (0, 3) and "error" not in done.err:
        problems.append("it is silent")
    problems += [f"it does not print: {words}" for words in said(command, fault) if not re.search(words, done.out + done.err)]
    found = states(command, baseline, observed)
    if found != right.nodes:
        problems.append(f"nodes are {found}, and {right.nodes} is right")
    problems += files_problems(observed, baseline, right.file)
    written = DEVICES if command == "restore" else {NODE}
    if observed.again and observed.again != (0, baseline.old | {node: baseline.new[node] for node in written}):
        problems.append("given again, it does not bring all values")
    for node in DEVICES:
        problems += [f"node {node}: {problem}" for problem in values_problems(node, baseline, observed)]
    return problems


def states(command: str, baseline: Baseline, observed: Observed) -> tuple[str, str, str]:
    def of_node(node: int) -> str:
        if command == "store" and node == NODE:
            is_stored = observed.after_reset[TARGET] == baseline.new[NODE][TARGET]
            return STORED if is_stored else UNSTORED
        has = observed.nodes[node]
        return OLD if has == baseline.old[node] else NEW if has == baseline.new[node] else PART

    first, second, third = (of_node(node) for node in DEVICES)
    return first, second, third


def files_problems(observed: Observed, baseline: Baseline, right: str) -> list[str]:
    kept = {name: data for name in FILES if (data := observed.files.get(f"kept/{name}")) is not None}
    wanted = {"kept", *(f"kept/{name}" for name in FILES)} if right in (WHOLE, LACKS) else set()
    problems = []
    if set(observed.files) != wanted:
        problems.append(f"files {sorted(observed.files)}, and {sorted(wanted)} is right")
    elif right == WHOLE and kept != baseline.kept:
        problems.append("a file has something else than over a good bus")
    elif right == LACKS and (not observed.loads or entry_name(MAPPED) not in observed.done.err):
        problems.append("a file does not load, or what it lacks is not named")
    return problems


def entry_name(id: Id) -> str:
    return f"{id[0]:04X}h" if id[1] == 0 else f"{id[0]:04X}h.{id[1]}"


def values_problems(node: int, baseline: Baseline, observed: Observed) -> list[str]:
    """Every entry is old or new, every PDO is whole or off, and what is said of entries is so."""
    old, new, has = baseline.old[node], baseline.new[node], observed.nodes[node]
    told, problems = lists(observed.done, node), []
    restarted = re.search(rf"\(node {node}\) started again", observed.done.err) is not None
    for id, value in has.items():
        name = entry_name(id)
        if value not in (old[id], new[id]):
            is_step = id == COUNT and value == b"\0" or id == COB_ID and value[3] == old[id][3] | 0x80
            if not is_step or not is_off(has):
                problems.append(f"{name} is {value.hex()}, which is not old and not new")
            elif id not in told.missing or COB_ID not in told.left_off:
                problems.append(f"{name} is neither old nor new, and not named")
        elif old[id] == new[id]:
            continue
        elif value == new[id] and id not in told.written | told.doubtful and not was_given(observed, id):
            problems.append(f"{name} is new, and not named as written")
        elif value == old[id] and id in told.written - told.missing and not restarted:
            problems.append(f"{name} is old, and named as written")
        elif value == old[id] and told.written and id not in told.missing and not restarted:
            problems.append(f"{name} is old, and not named as missing")
    if told.left_off and not is_off(has):
        problems.append("TPDO 1 is on, and named as left off")
    pdo = [id for id in has if id[0] in (COB_ID[0], COUNT[0])]
    if not is_off(has) and [has[id] for id in pdo] not in ([old[id] for id in pdo], [new[id] for id in pdo]):
        problems.append("TPDO 1 is on, and a mixture")
    return problems


def was_given(observed: Observed, id: Id) -> bool:
    """Whether a value was there before the command."""
    return bool(observed.after_reset) and id == TARGET


def is_off(has: State) -> bool:
    return COB_ID in has and bool(has[COB_ID][3] & 0x80)


# The table.

HEAD = ("command", "what happens", "what it prints", "exit code", "node 1", "node 11", "node 12", "files")


def row(cell: Cell, baseline: Baseline) -> list[str]:
    words = list(states(cell.command, baseline, cell.observed))
    for at, node in enumerate(DEVICES):
        if words[at] == PART:
            has, new, old = cell.observed.nodes[node], baseline.new[node], baseline.old[node]
            changing = [id for id in has if new[id] != old[id]]
            count = sum(has[id] == new[id] for id in changing)
            words[at] = f"{count} of {len(changing)} new" + ("; TPDO 1 is off" if is_off(has) else "")
    texts = [re.sub(r"[|<]", r"\\\g<0>", line) for line in printed(cell.observed.done)]
    if cell.fault == "disk full" and cell.command != "backup":
        texts.insert(0, "does not apply, as the command writes no file:")
    code = str(cell.observed.done.code)
    file = expected(cell.command, cell.fault).file
    return [f"`{cell.command}`", cell.fault, "<br>".join(texts), code, *words, file]


def table(cells: list[Cell], baseline: Baseline) -> str:
    rows = [list(HEAD), ["---"] * len(HEAD), *(row(cell, baseline) for cell in cells)]
    text = "".join(f"| {' | '.join(one)} |\n" for one in rows)
    return text.replace(f"{baseline.folder}/", "")


def page_with(page: str, text: str) -> str:
    begin, end = "<!-- fault-matrix -->\n", "<!-- /fault-matrix -->\n"
    return page[: page.index(begin) + len(begin)] + text + page[page.index(end) :]


# That each check can fail.

Spoil = Callable[[Observed, Baseline], Observed]


def with_value(id: Id, value: bytes, node: int = NODE) -> Spoil:
    def spoil(observed: Observed, _: Baseline) -> Observed:
        return replace(observed, nodes={**observed.nodes, node: {**observed.nodes[node], id: value}})

    return spoil


def with_done(change: Callable[[Done], Done]) -> Spoil:
    return lambda observed, _: replace(observed, done=change(observed.done))


def without(words: str) -> Spoil:
    """Without the lines that have these words."""
    def lines(text: str) -> str:
        return "".join(line for line in text.splitlines(keepends=True) if words not in line)

    return with_done(lambda done: replace(done, out=lines(done.out), err=lines(done.err)))


def with_files(change: Callable[[dict[str, bytes]], dict[str, bytes]]) -> Spoil:
    return lambda observed, _: replace(observed, files=change(observed.files))


SPOILED: list[tuple[str, str, str, Spoil]] = [
    ("nothing happened", "write", "slow", lambda observed, _: replace(observed, has_begun=False)),
    ("exit code 0, and 1", "restore", "node dead", with_done(lambda done: replace(done, code=0))),
    ("exit code -2", "backup", "Ctrl-C", with_done(lambda _: Done(-2, "", ""))),
    ("it panics", "compare", "node dead", with_done(lambda done: replace(done, err=f"{done.err}thread panicked"))),
    ("it is silent", "write", "node dead", with_done(lambda done: replace(done, err=""))),
    ("it is silent", "store", "nothing", with_done(lambda done: replace(done, out=""))),
    ("it does not print: the node does not answer", "backup", "node dead", without("does not answer")),
    ("it does not print: A pmc", "compare", "slow", without("asked for again")),
    ("it does not print: read back, it has", "write", "answer lost", without("read back")),
    ("it does not print: interrupted", "restore", "Ctrl-C", without("interrupted")),
    ("nodes are", "write", "nothing", with_value((0x30C0, 0), (900).to_bytes(2, "little"), 1)),
    ("nodes are", "store", "nothing", lambda observed, base: replace(observed, after_reset={TARGET: base.old[NODE][TARGET]})),
    ("which is not old and not new", "restore", "answer lost", with_value(TARGET, bytes(4))),
    ("1800h.1 is neither old nor new, and not named", "restore", "node dead", without("not switched on again")),
    ("1800h.1 is neither old nor new, and not named", "write", "node dead", without("not sent any more: 1800h.1")),
    ("5681h is new, and not named as written", "write", "Ctrl-C", with_value(VELOCITY, (1200).to_bytes(4, "little"))),
    ("5681h is old, and named as written", "restore", "request doubled", with_value(VELOCITY, (1000).to_bytes(4, "little"))),
    ("567Ah is old, and not named as missing", "restore", "node dead", without("not sent any more: 567Ah")),
    ("TPDO 1 is on, and named as left off", "write", "node dead", with_value(COB_ID, (0x4000018B).to_bytes(4, "little"))),
    ("TPDO 1 is on, and a mixture", "restore", "Ctrl-C", with_value(COUNT, b"\1")),
    ("something else than over a good bus", "backup", "slow", with_files(lambda files: {**files, "kept/A-pmc.yaml": b""})),
    ("files [", "backup", "nothing", with_files(lambda files: {name: files[name] for name in sorted(files)[:-1]})),
    ("files [", "backup", "node dead", with_files(lambda _: {"kept/A-pmc.yaml": b""})),
    ("files [", "backup", "disk full", with_files(lambda _: {"kept": b""})),
    ("given again", "restore", "node dead", lambda observed, base: replace(observed, again=(0, base.old))),
    ("given again", "write", "request lost", lambda observed, base: replace(observed, again=(1, base.old | {NODE: base.new[NODE]}))),
    ("a file does not load", "backup", "malformed answers", lambda observed, _: replace(observed, loads=False)),
    ("what it lacks is not named", "backup", "malformed answers", without("1A00h.2")),
]
"""What is found, and the true observation that is spoiled for it."""


def unnoticed(cells: list[Cell], baseline: Baseline) -> list[str]:
    """The spoiled observations in which it is not found, or is without the spoiling."""
    by_name = {(cell.command, cell.fault): cell for cell in cells}
    found = []
    for words, command, fault, spoil in SPOILED:
        cell = by_name[command, fault]
        spoiled = judge(command, fault, baseline, spoil(cell.observed, baseline))
        if any(words in problem for problem in cell.problems) or not any(words in problem for problem in spoiled):
            found.append(f"{words} ({command}, {fault})")
    return found


# All cells, some at a time.

def work(baseline: Baseline, names: list[tuple[str, str]]) -> list[Cell]:
    """Some cells, on a machine of their own."""
    machine = Machine(baseline.odgen, Path(tempfile.mkdtemp(dir=baseline.folder)))
    try:
        return [Cell(*name, observed := observe(machine, baseline, *name), judge(*name, baseline, observed)) for name in names]
    finally:
        machine.end()


def run(baseline: Baseline, names: list[tuple[str, str]]) -> list[Cell]:
    # Those in which a command waits are spread over all machines.
    order = sorted(names, key=lambda name: name[1] not in ("node dead", "slow", "request lost", "answer lost"))
    with ProcessPoolExecutor(WORKERS, multiprocessing.get_context("spawn")) as pool:
        some = pool.map(work, [baseline] * WORKERS, [order[at::WORKERS] for at in range(WORKERS)])
        cells = [cell for of_one in some for cell in of_one]
    return sorted(cells, key=lambda cell: names.index((cell.command, cell.fault)))


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--self-test", action="store_true", help="also spoil what was observed, and want it noticed")
    parser.add_argument("--write", action="store_true", help="write the table into the page")
    parser.add_argument("--only", choices=COMMANDS, help="a single command; the page is not compared")
    parser.add_argument("--verbose", action="store_true", help="also print what each command printed")
    options = parser.parse_args()
    # A program that is started in the background may ignore Ctrl-C, and so would all that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    began = time.monotonic()
    names = [(command, fault) for command in COMMANDS for fault in FAULTS if options.only in (None, command)]
    with tempfile.TemporaryDirectory() as folder:
        baseline = set_up(str(options.odgen.resolve()), Path(folder))
        cells = run(baseline, names)
        text = table(cells, baseline)
    print(text)
    wrong = [f"{cell.command}, {cell.fault}: {problem}" for cell in cells for problem in cell.problems]
    if options.verbose:
        for cell in cells:
            print(f"== {cell.command}, {cell.fault}: exit code {cell.observed.done.code}\n{cell.observed.done.out}{cell.observed.done.err}")
    if options.self_test and not options.only:
        wrong += [f"not noticed: {what}" for what in unnoticed(cells, baseline)]
    if not options.only:
        page = PAGE.read_text(encoding="utf-8")
        if options.write:
            PAGE.write_text(page_with(page, text), encoding="utf-8")
        elif page_with(page, text) != page:
            wrong.append(f"{PAGE.name} has another table; `--write` writes this one there")
    for problem in wrong:
        print(f"  WRONG {problem}")
    print(f"fault matrix: {len(cells)} cells, {len(wrong)} problems, {time.monotonic() - began:.1f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
