"""Read an EDS or DCF file with the Rust crate canopen-host (through canopen-host/) and compare it."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import Any

from compare import NOT_EXPOSED, Job, Limit, Reading, Tool, main, not_exposed
from expected import OCTETS, REALS, STRINGS, Facts, IfWritten, text_value

TYPES = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0x09, 0x0A, 0x0F, 0x11, 0x15, 0x1B}
NO_VALUE = (None, 0)
LONGEST_STRING = 32

LIMITS = (
    not_exposed("ObjectType", "the crate keeps entries, not objects"),
    not_exposed("LowLimit", "the crate does not look at limits"),
    not_exposed("HighLimit", "the crate does not look at limits"),
    not_exposed("ObjFlags", "the crate does not look at ObjFlags"),
    Limit(
        "[DeviceInfo] not exposed",
        "of [DeviceInfo] the crate keeps two names",
        lambda c: c.section == "DeviceInfo",
    ),
    Limit(
        "arrays and records not exposed",
        "a section without DataType is skipped",
        lambda c: c.data_type is None and c.read is NOT_EXPOSED,
    ),
    Limit(
        "types not modelled",
        "UNICODE_STRING, TIME_OF_DAY, TIME_DIFFERENCE and 24/40/48/56-bit integers are skipped",
        lambda c: c.data_type is not None and c.data_type not in TYPES and c.read is NOT_EXPOSED,
    ),
    Limit(
        "rwr and rww read as rw",
        "the crate has four kinds of access",
        lambda c: c.key == "AccessType" and c.expected in ("rwr", "rww") and c.read == "rw",
    ),
    Limit(
        "no default reads as 0",
        "every entry has a value",
        lambda c: c.key == "DefaultValue" and c.expected is None and c.read in NO_VALUE,
    ),
    Limit(
        "strings cut at 32 bytes",
        "its string buffer is that long",
        lambda c: c.key == "DefaultValue" and isinstance(c.expected, str) and len(c.expected) > LONGEST_STRING
        and c.read == c.expected[:LONGEST_STRING].strip(),
    ),
)


def effective(facts: Facts) -> Facts:
    """The crate shows one value: ParameterValue if there is one, else DefaultValue."""
    for keys in facts.values():
        configured = keys.pop("ParameterValue", None)
        if isinstance(configured, IfWritten):
            if keys["DefaultValue"] is None:
                keys["DefaultValue"] = IfWritten(configured.value, absent=NO_VALUE)
        elif configured is not None:
            keys["DefaultValue"] = configured
    return facts


def version(job: Job) -> str:
    lock = Path(__file__).with_name("canopen-host").joinpath("Cargo.lock").read_text(encoding="utf-8")
    match = re.search(r'name = "canopen-host"\nversion = "([^"]+)"', lock)
    return match.group(1) if match else "?"


def read(job: Job) -> Reading:
    done = subprocess.run([job.installed, job.path], capture_output=True, text=True, check=False)
    if done.returncode != 0 or done.stderr:
        raise RuntimeError(done.stderr.strip())
    head, *lines = done.stdout.splitlines()
    facts: dict[str, Any] = {}
    if job.dcf:
        facts["DeviceComissioning"] = {"NodeID": int(head.split("\t")[1])}
    subs = sections_with_subs(job.path)
    for line in lines:
        add_entry(facts, line.split("\t", 6), subs)
    return Reading(facts)


def sections_with_subs(path: Path) -> set[int]:
    """The crate gives 3000 and 3000sub0 the same address, so the file must say which it was."""
    return {int(found, 16) for found in re.findall(r"(?m)^\[(\w{4})sub\w+\]", path.read_text(encoding="ascii"))}


def add_entry(facts: dict[str, Any], fields: list[str], subs: set[int]) -> None:
    index, sub, data_type, access, pdo, value, name = fields
    section = f"{int(index):04X}" + (f"sub{int(sub):X}" if int(index) in subs else "")
    facts[section] = {
        "ParameterName": name,
        "DataType": int(data_type),
        "AccessType": access.lower(),
        "PDOMapping": int(pdo),
        "DefaultValue": plain(value, int(data_type)),
    }


def plain(text: str, data_type: int) -> Any:
    if data_type in STRINGS | OCTETS:
        return text_value(text, data_type)
    return float(text) if data_type in REALS else int(text)


if __name__ == "__main__":
    # without [DeviceComissioning] the crate takes $NODEID as 0
    main(Tool("canopen-host", version, read, LIMITS, eds_node=lambda job: 0, expect=effective))
