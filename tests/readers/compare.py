"""Shared by the reader scripts: run one reader on one file, compare, report."""

from __future__ import annotations

import argparse
import logging
import re
import struct
import sys
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from expected import Facts, IfWritten, expected_facts, load_device

NOT_EXPOSED = object()


class Case(NamedTuple):
    """One value on which reader and model do not agree."""

    section: str
    key: str
    expected: Any
    read: Any
    data_type: int | None


@dataclass(frozen=True)
class Limit:
    """Something a reader cannot do, or does wrong, on any file."""

    name: str
    reason: str
    covers: Callable[[Case], bool]


@dataclass
class Reading:
    """What a reader made of a file."""

    facts: Facts
    complaints: list[str] = field(default_factory=list)


class Job(NamedTuple):
    path: Path
    node: int
    reader: Path | None  # the installed tool, where a script needs its path

    @property
    def installed(self) -> Path:
        if self.reader is None:
            raise SystemExit("--reader is needed: it says where the tool is")
        return self.reader

    @property
    def dcf(self) -> bool:
        return self.path.suffix.lower() == ".dcf"


@dataclass
class Tool:
    name: str
    version: Callable[[Job], str]
    read: Callable[[Job], Reading]
    limits: tuple[Limit, ...] = ()
    # complaints that are the tool's own limits: pattern -> name of the limit
    accepted: dict[str, str] = field(default_factory=dict)
    # the node id with which the tool evaluates $NODEID in an EDS
    eds_node: Callable[[Job], int] = lambda job: job.node
    # bends the expectation where the tool merges two keys
    expect: Callable[[Facts], Facts] = lambda facts: facts


def not_exposed(key: str, reason: str) -> Limit:
    return Limit(f"{key} not exposed", reason, lambda c: c.key == key and c.read is NOT_EXPOSED)


@dataclass
class Result:
    compared: int = 0
    entries: int = 0
    differences: list[str] = field(default_factory=list)
    limits: Counter[str] = field(default_factory=Counter)


def compare(tool: Tool, expected: Facts, reading: Reading) -> Result:
    result = Result(entries=sum("DataType" in keys for keys in expected.values()))
    for text in reading.complaints:
        accept_or_report(tool, result, text)
    for section in sorted(reading.facts.keys() - expected.keys()):
        if not excused(tool, result, Case(section, "", NOT_EXPOSED, None, None)):
            result.differences.append(f"[{section}] is in the file, not in the model")
    for section, keys in expected.items():
        compare_section(tool, result, section, keys, reading.facts.get(section))
    return result


def accept_or_report(tool: Tool, result: Result, text: str) -> None:
    for pattern, name in tool.accepted.items():
        if re.search(pattern, text):
            result.limits[name] += 1
            return
    result.differences.append(f"complaint: {text}")


def compare_section(
    tool: Tool, result: Result, section: str, expected: dict[str, Any], read: dict[str, Any] | None
) -> None:
    data_type = expected.get("DataType")
    if read is None:
        case = Case(section, "", None, NOT_EXPOSED, data_type)
        if not excused(tool, result, case, weight=len(expected)):
            result.differences.append(f"[{section}] is in the model, not in the file")
        return
    for key, value in expected.items():
        compare_value(tool, result, Case(section, key, value, read.get(key, NOT_EXPOSED), data_type))


def compare_value(tool: Tool, result: Result, case: Case) -> None:
    if isinstance(case.expected, IfWritten):
        if case.read in case.expected.absent:
            return
        case = case._replace(expected=case.expected.value)
    if same(case.expected, case.read, case.data_type):
        result.compared += 1
    elif not excused(tool, result, case):
        read = "nothing (not exposed)" if case.read is NOT_EXPOSED else repr(case.read)
        result.differences.append(
            f"[{case.section}] {case.key}: model says {case.expected!r}, {tool.name} reads {read}"
        )


def same(expected: Any, read: Any, data_type: int | None) -> bool:
    if isinstance(expected, float) and isinstance(read, float) and data_type == 0x08:
        return struct.pack("<f", expected) == struct.pack("<f", read)
    return type(expected) is type(read) and expected == read


def excused(tool: Tool, result: Result, case: Case, weight: int = 1) -> bool:
    for limit in tool.limits:
        if limit.covers(case):
            result.limits[limit.name] += weight
            return True
    return False


class Collector(logging.Handler):
    def __init__(self, complaints: list[str]) -> None:
        super().__init__(logging.WARNING)
        self.complaints = complaints

    def emit(self, record: logging.LogRecord) -> None:
        self.complaints.append(f"{record.name}: {record.getMessage()}")


@contextmanager
def strict(complaints: list[str]) -> Iterator[None]:
    """Python warnings become errors, log records of WARNING and above become complaints."""
    handler = Collector(complaints)
    root = logging.getLogger()
    root.addHandler(handler)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    finally:
        root.removeHandler(handler)


def read_strictly(tool: Tool, job: Job) -> Reading:
    logged: list[str] = []
    with strict(logged):
        reading = tool.read(job)
    reading.complaints += logged
    return reading


def main(tool: Tool) -> None:
    parser = argparse.ArgumentParser(description=f"Check an EDS or DCF file with {tool.name}.")
    parser.add_argument("eds", type=Path)
    parser.add_argument("dump", type=Path)
    parser.add_argument("device")
    parser.add_argument("--node", type=int, default=1)
    parser.add_argument("--reader", type=Path, help="where the tool is, if it is not a Python package")
    args = parser.parse_args()

    job = Job(args.eds, args.node, args.reader)
    node = job.node if job.dcf else tool.eds_node(job)
    expected = tool.expect(expected_facts(load_device(args.dump, args.device), node, job.dcf))
    try:
        result = compare(tool, expected, read_strictly(tool, job))
    except Exception as error:  # whatever a reader dies of is its verdict on the file
        result = Result(differences=[f"{tool.name} failed: {type(error).__name__}: {error}"])
    report(tool, job, result)
    sys.exit(1 if result.differences else 0)


def report(tool: Tool, job: Job, result: Result) -> None:
    known = ", ".join(f"{count} x {name}" for name, count in sorted(result.limits.items()))
    print(
        f"{tool.name} {tool.version(job)}: {job.path.name}: {result.entries} entries, "
        f"{result.compared} values compared, {len(result.differences)} differences, "
        f"{len(result.limits)} known reader limits" + (f" ({known})" if known else "")
    )
    for line in result.differences:
        print(f"  {line}")
