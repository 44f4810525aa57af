#!/usr/bin/env python3
"""Prove that the reader scripts pass a right file and notice a wrong one.

    selftest.py [--out CACHE]

device.eds and device.dcf agree with device.json. Each fault below is put into a copy; every reader must
then fail, except those that cannot see it: these are named, and must indeed pass, so that the list stays
true. Exit code 0, 1 (a reader did not do as stated) or 3 (a tool could not be installed).
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from run import ROOT, Reader, check, installed

PY, LELY, UTILS, NODE, RUST = "python-canopen", "dcfchk", "eds-utils", "node-canopen", "canopen-host"
Edit = Callable[[str], str]


@dataclass(frozen=True)
class Fault:
    name: str
    file: str
    edit: Edit
    blind: tuple[str, ...] = ()


def section(text: str, name: str) -> str:
    """The lines of one section, up to the next blank line."""
    match = re.search(rf"(?m)^\[{name}\]\n(?:.+\n?)*", text)
    assert match, f"no section [{name}]"
    return match.group(0)


def put(name: str, key: str, value: str | None) -> Edit:
    """Set a key, add it, or remove it (None)."""

    def edit(text: str) -> str:
        old = section(text, name)
        new = re.sub(rf"(?m)^{key}=.*\n?", "", old).rstrip("\n") + "\n"
        return text.replace(old, new if value is None else f"{new}{key}={value}\n")

    return edit


def without(name: str) -> Edit:
    """Cut a section with the comment above it and the blank line below."""
    return lambda text: re.sub(rf"(?m)^(;.*\n)*{re.escape(section(text, name))}\n", "", text)


def in_list(name: str, change: Callable[[list[str]], None]) -> Edit:
    """Change an object list and keep its count and numbers right."""

    def edit(text: str) -> str:
        old = section(text, name)
        indices = re.findall(r"(?m)^\d+=(.*)$", old)
        change(indices)
        lines = [f"[{name}]", f"SupportedObjects={len(indices)}"]
        lines += [f"{number}={index}" for number, index in enumerate(indices, 1)]
        return text.replace(old, "\n".join(lines) + "\n")

    return edit


def also(name: str, keys: str) -> Edit:
    return lambda text: text.rstrip("\n") + f"\n\n[{name}]\n" + keys.replace(" ", "\n") + "\n"


def chain(*edits: Edit) -> Edit:
    def edit(text: str) -> str:
        for step in edits:
            text = step(text)
        return text

    return edit


VARIABLE = "ParameterName=Extra ObjectType=0x7 DataType=0x0002 AccessType=ro PDOMapping=0"
UNLISTED = in_list("OptionalObjects", lambda indices: indices.remove("0x1008"))
LISTED = in_list("ManufacturerObjects", lambda indices: indices.append("0x2003"))
EDS, DCF = "device.eds", "device.dcf"

FAULTS = (
    Fault("access ro -> rw", EDS, put("2001sub1", "AccessType", "rw")),
    Fault("access rwr -> rww", EDS, put("2002sub4", "AccessType", "rww"), (RUST,)),
    Fault("locked entry writable", EDS, put("2002sub2", "AccessType", "rww")),
    Fault("default", EDS, put("2000", "DefaultValue", "-6")),
    Fault("default lost", EDS, put("2002sub4", "DefaultValue", None)),
    Fault("withheld default written", EDS, put("2002sub5", "DefaultValue", "77")),
    Fault("text default", EDS, put("1008", "DefaultValue", "Selftest")),
    Fault("octet default", EDS, put("2002subA", "DefaultValue", "01A1053D")),
    Fault("formula offset", EDS, put("1400sub1", "DefaultValue", "$NODEID+0x201")),
    Fault("formula lost", EDS, put("1400sub1", "DefaultValue", "0x200"), (RUST,)),
    Fault("type", EDS, put("2002sub4", "DataType", "0x0003")),
    Fault("low limit", EDS, put("2001sub1", "LowLimit", "-41"), (RUST,)),
    Fault("high limit", EDS, put("2000", "HighLimit", "3001"), (RUST,)),
    Fault("limit lost", EDS, put("2001sub1", "LowLimit", None), (RUST,)),
    Fault("limit invented", EDS, put("1400sub2", "HighLimit", "255"), (RUST,)),
    Fault("name", EDS, put("2001sub1", "ParameterName", "Motor temperatur")),
    Fault("name of a record", EDS, put("2002", "ParameterName", "Everythin"), (RUST,)),
    Fault("PDO mapping", EDS, put("2002sub4", "PDOMapping", "0")),
    Fault("kind", EDS, put("2001", "ObjectType", "0x9"), (RUST,)),
    Fault("flags", EDS, put("2002sub5", "ObjFlags", None), (PY, UTILS, RUST)),
    Fault("object missing", EDS, chain(without("1008"), UNLISTED)),
    Fault("object too many", EDS, chain(also("2003", VARIABLE), LISTED)),
    Fault("object in no list", EDS, also("2003", VARIABLE)),
    Fault("sub-object missing", EDS, chain(without("2002sub9"), put("2002", "SubNumber", "12"))),
    Fault("sub-object too many", EDS, chain(also("2001sub3", VARIABLE), put("2001", "SubNumber", "4"))),
    Fault("SubNumber", EDS, put("2001", "SubNumber", "4"), (PY, UTILS, NODE, RUST)),
    Fault("section twice", EDS, also("1008", VARIABLE)),
    Fault("vendor number", EDS, put("DeviceInfo", "VendorNumber", "0x1235"), (RUST,)),
    Fault("number of PDOs", EDS, put("DeviceInfo", "NrOfTXPDO", "2"), (RUST,)),
    Fault("node id", DCF, put("DeviceComissioning", "NodeID", "2"), (NODE,)),
    Fault("configured value", DCF, put("1800sub2", "ParameterValue", "11"), (UTILS, NODE)),
    Fault("configured value lost", DCF, put("1800sub2", "ParameterValue", None), (UTILS, NODE)),
    Fault("configured signed value", DCF, put("2002sub7", "ParameterValue", "42"), (UTILS, NODE, RUST)),
    Fault("configured real", DCF, put("2002sub9", "ParameterValue", "0.25"), (LELY, UTILS, NODE)),
    Fault("configured octets", DCF, put("2002subA", "ParameterValue", "0A0C"), (UTILS, NODE)),
    Fault("configured text", DCF, put("2002subB", "ParameterValue", "Set there"), (UTILS, NODE)),
    Fault("value that was not configured", DCF, put("2000", "ParameterValue", "7"), (UTILS, NODE)),
    Fault("default in the DCF", DCF, put("2000", "DefaultValue", "-6")),
)


def faulty(fault: Fault, folder: Path) -> Path:
    """A copy with the fault in it; the originals have CR LF, like the files we generate."""
    right = HERE.joinpath(fault.file).read_bytes().decode("ascii").replace("\r\n", "\n")
    wrong = fault.edit(right)
    assert wrong != right, fault.name
    path = folder / re.sub(r"\W+", "-", fault.name) / fault.file
    path.parent.mkdir()
    path.write_bytes(wrong.replace("\n", "\r\n").encode("ascii"))
    return path


def verdict(reader: Reader, file: Path, name: str, must_pass: bool) -> str | None:
    """None if the reader did as it must, else what went wrong."""
    outcome = check(reader, file, HERE / "device.json", "device", 1)
    if outcome.ok == must_pass:
        return None
    wish = "should not notice, by the table" if must_pass else "does not notice"
    return f"{reader.name} {wish}: {name}\n    {outcome.text}"


def cases(readers: list[Reader], folder: Path) -> list[tuple[Reader, Path, str, bool]]:
    listed = [(reader, HERE / file, f"right {file}", True) for file in (EDS, DCF) for reader in readers]
    for fault in FAULTS:
        path = faulty(fault, folder)
        listed += [(reader, path, fault.name, reader.name in fault.blind) for reader in readers]
    return listed


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "readers", help="cache of the tools")
    options = parser.parse_args()
    readers, missing = installed(options.out.resolve())
    for name in (PY, LELY, UTILS, NODE, RUST):
        assert len({name in fault.blind for fault in FAULTS}) == 2, f"{name} has to notice some of the faults, and some not"
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(max_workers=2) as pool:
        verdicts = list(pool.map(lambda case: verdict(*case), cases(readers, Path(folder))))
    wrong = [text for text in verdicts if text]
    print("\n".join(wrong + [f"not installed: {name}: {reason}" for name, reason in missing.items()]))
    skipped = len(missing) * (len(FAULTS) + 2)
    print(f"{len(verdicts) - len(wrong)} passed, {len(wrong)} failed, {skipped} skipped")
    if wrong or not verdicts:
        return 1
    return 3 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
