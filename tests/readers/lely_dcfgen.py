#!/usr/bin/env python3
"""Compare the concise DCF files of odgen with those of lely's dcfgen.

    lely_dcfgen.py --odgen target/debug/odgen [--out target/dcfgen]

Configures node 5 of everything.od.yaml by the settings below with `odgen dcf --concise`, and by the same values with
dcfgen, which knows the EDS of odgen. Where both have one order, the files are the same byte for byte; else every record
of the one is compared with one of the other, and what dcfgen cannot say or says wrongly is counted. Run by the Python
that `run.py` has installed the readers for. Exit code 0: all agrees; 1: a difference.
"""

from __future__ import annotations

import argparse
import struct
import subprocess
import sys
import warnings
from collections import Counter
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import yaml

with warnings.catch_warnings():
    # It uses a part of setuptools that is to be removed.
    warnings.simplefilter("ignore")
    from dcfgen.cli import Slave
# What else it warns of is a difference.
warnings.simplefilter("error")

HERE = Path(__file__).resolve().parent
SPEC = HERE / "everything.od.yaml"
NODE = 5
OPTIONS = {"cob_id": 0x680, "dcf_path": "", "heartbeat_multiplier": 3.0, "retry_factor": 3}
# Types whose values dcfgen writes as the next larger number of the machine, with the right size before them.
ODD = {0x10: 3, 0x12: 5, 0x13: 6, 0x14: 7, 0x16: 3, 0x18: 5, 0x19: 6, 0x1A: 7}


@dataclass(frozen=True)
class Case:
    """A configuration in two languages."""

    name: str
    settings: tuple[str, ...]
    config: dict[str, Any]
    """Whether both write the records in one order."""
    same_order: bool = True
    """Settings that dcfgen has no words for: all but whole numbers."""
    beyond: tuple[str, ...] = ()
    """How many of its records have too many bytes."""
    odd: int = 0


def sdo(index: int, value: int, sub: int = 0) -> dict[str, int]:
    return {"index": index, "sub_index": sub, "value": value}


CASES = (
    Case(
        "an RPDO with another mapping",
        ("1400.1=0x301", "1600.0=3", "1600.1=0x20090008", "1600.2=0x20020010", "1600.3=0x200A0010"),
        {"rpdo": {1: {"cob_id": 0x301, "mapping": [{"index": 0x2009}, {"index": 0x2002}, {"index": 0x200A}]}}},
    ),
    Case(
        "the parameters of a TPDO",
        ("1800.3=50", "1800.5=100"),
        {"tpdo": {1: {"inhibit_time": 50, "event_timer": 100}}},
    ),
    Case(
        "a TPDO with another SYNC to begin with",
        ("1801.2=10", "1801.6=2"),
        {"tpdo": {2: {"transmission": 10, "sync_start": 2}}},
    ),
    Case(
        "whole numbers of 1, 8, 16, 32 and 64 bits",
        ("2000=0", "2001=-127", "2002=32767", "2004=-2147483648", "2008=-9223372036854775808", "2009=1",
         "200A=0x1234", "200C=0x705", "2010=18446744073709551614", "2019=1", "201A=7", "201C.12=3"),
        {"sdo": [sdo(0x2000, 0), sdo(0x2001, -127), sdo(0x2002, 32767), sdo(0x2004, -2147483648),
                 sdo(0x2008, -9223372036854775808), sdo(0x2009, 1), sdo(0x200A, 0x1234), sdo(0x200C, 0x705),
                 sdo(0x2010, 18446744073709551614), sdo(0x2019, 1), sdo(0x201A, 7), sdo(0x201C, 3, 12)]},
    ),
    Case(
        "a heartbeat",
        ("1017=500",),
        {"heartbeat_producer": 500},
    ),
    Case(
        "everything at once",
        ("1017=500", "1400.2=1", "1400.1=0x301", "1600.0=2", "1600.1=0x20090008", "1600.2=0x20020010",
         "1800.3=50", "2003=-8388608", "2005=-549755813888", "2006=140737488355327",
         "2007=-36028797018963968", "200B=1", "200D=1099511627775", "200E=281474976710655",
         "200F=72057594037927935", "2011=0.1", "2012=-2.5e300", "2013=Good bye", "2014=ff 00 A5",
         "2015=another text", "201B=21.5 °C"),
        {
            "heartbeat_producer": 500,
            "rpdo": {1: {"cob_id": 0x301, "transmission": 1, "mapping": [{"index": 0x2009}, {"index": 0x2002}]}},
            "tpdo": {1: {"inhibit_time": 50}},
            "sdo": [sdo(0x2003, -8388608), sdo(0x2005, -549755813888), sdo(0x2006, 140737488355327),
                    sdo(0x2007, -36028797018963968), sdo(0x200B, 1), sdo(0x200D, 1099511627775),
                    sdo(0x200E, 281474976710655), sdo(0x200F, 72057594037927935), sdo(0x201B, 215)],
        },
        same_order=False,
        beyond=("2011", "2012", "2013", "2014", "2015"),
        odd=8,
    ),
)


@dataclass
class Result:
    problems: list[str] = field(default_factory=list)
    records: int = 0
    counts: Counter[str] = field(default_factory=Counter)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--odgen", type=Path, required=True)
    parser.add_argument("--out", type=Path, default=HERE.parent.parent / "target/dcfgen")
    arguments = parser.parse_args()
    odgen = [str(arguments.odgen.resolve())]
    call([*odgen, "build", str(SPEC), "--out", str(arguments.out), "--force"])
    faults = 0
    for number, case in enumerate(CASES):
        result = compare(case, odgen, arguments.out, f"case-{number}")
        how = "byte for byte" if case.same_order else "record by record"
        more = "".join(f", {count} {what}" for what, count in sorted(result.counts.items()))
        print(f"dcfgen {version('dcf-tools')}: {case.name}: {result.records} records {how}{more}", end="")
        print("".join(f"\n  FAIL {problem}" for problem in result.problems))
        faults += len(result.problems)
    return 1 if faults else 0


def call(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")


def compare(case: Case, odgen: list[str], folder: Path, name: str) -> Result:
    dcf = folder / f"{name}.dcf"
    settings = [part for setting in case.settings for part in ("--set", setting)]
    call([*odgen, "dcf", str(SPEC), "--node", str(NODE), "--concise", "--force", "--out", str(dcf), *settings])
    ours = dcf.with_suffix(".bin").read_bytes()
    slave, theirs = made_by_dcfgen(case, folder, name)
    result = Result(records=len(slave.sdo))
    if case.same_order:
        if ours != theirs:
            result.problems.append(f"{ours.hex(' ')}, expected {theirs.hex(' ')}")
        return result
    found = records(ours)
    expected = [corrected(slave, record, result.counts) for record in slave.sdo]
    beyond = [record for record in found if f"{struct.unpack_from('<H', record)[0]:04X}" in case.beyond]
    result.counts["with values that dcfgen cannot take"] = len(beyond)
    if len(beyond) != len(case.beyond):
        result.problems.append(f"{len(beyond)} records are beyond dcfgen, expected {len(case.beyond)}")
    if result.counts[TOO_LONG] != case.odd:
        result.problems.append(f"{result.counts[TOO_LONG]} records with too many bytes, expected {case.odd}")
    rest = Counter(found) - Counter(beyond)
    result.problems += [f"record {record.hex(' ')} is ours alone" for record in rest - Counter(expected)]
    result.problems += [f"record {record.hex(' ')} is missing" for record in Counter(expected) - rest]
    # Within one PDO the order is the same except for the parameters, which may come before or after the mapping is emptied.
    for index in (0x1400, 0x1600, 0x1800):
        of_index = lambda record: struct.unpack_from("<H", record)[0] == index  # noqa: E731
        if list(filter(of_index, found)) != list(filter(of_index, expected)):
            result.problems.append(f"the records of {index:04X}h have another order")
    return result


TOO_LONG = "with too many bytes"


def made_by_dcfgen(case: Case, folder: Path, name: str) -> tuple[Slave, bytes]:
    """Its records, and the file that it writes."""
    config = {"dcf": str(folder / "eds/everything.eds"), "node_id": NODE, **case.config}
    text = folder / f"{name}.yml"
    text.write_text(yaml.safe_dump({"master": {"node_id": 1}, "node": config}), encoding="utf-8")
    slave = Slave.from_config("node", yaml.safe_load(text.read_text(encoding="utf-8"))["node"], dict(OPTIONS))
    command = folder / name
    command.mkdir(exist_ok=True)
    program = Path(sys.executable).with_name("dcfgen")
    call([str(program), "--directory", str(command), str(text)])
    return slave, (command / "node.bin").read_bytes()


def corrected(slave: Slave, record: bytes, counts: Counter[str]) -> bytes:
    """A record without the bytes that dcfgen adds to types of 24, 40, 48 and 56 bits."""
    index, sub, size = struct.unpack_from("<HBL", record)
    data_type = slave[index][sub].data_type.index
    if ODD.get(data_type) == size and len(record) > 7 + size:
        counts[TOO_LONG] += 1
        return record[: 7 + size]
    return record


def records(concise: bytes) -> list[bytes]:
    """The records of a concise DCF, read by this script alone."""
    (number,) = struct.unpack_from("<L", concise)
    at, found = 4, []
    for _ in range(number):
        end = at + 7 + struct.unpack_from("<HBL", concise, at)[2]
        found.append(concise[at:end])
        at = end
    assert at == len(concise), "something follows the last record"
    return found


if __name__ == "__main__":
    sys.exit(main())
