"""Check an EDS or DCF file with lely's dcfchk, then compare what lely's reader made of it."""

from __future__ import annotations

import io
import re
import sys
import tempfile
import warnings
from contextlib import redirect_stderr, redirect_stdout
from importlib.metadata import version
from pathlib import Path
from typing import Any

from dcf import cli
from dcf.device import Device, Object, SubObject
from dcf.lint import lint
from dcf.parse import parse_file

from compare import Job, Limit, Reading, Tool, main
from expected import REALS, text_value

IDENTITY = {"VendorNumber": "vendor_id", "ProductNumber": "product_code", "RevisionNumber": "revision_number"}
# dcfchk does not print what it read. Its reader has every key, so nothing but REAL is excused here; it knows
# neither subFF nor UploadFile outside DOMAIN.
LIMITS = (
    Limit(
        "REAL in decimal not understood",
        "it takes bit patterns of IEEE 754 only and dies of a decimal number, so this script takes these out",
        lambda c: c.data_type in REALS and c.key in VALUES and isinstance(c.expected, float) and c.read is None,
    ),
)
VALUES = ("DefaultValue", "ParameterValue")


def read(job: Job) -> Reading:
    text = job.path.read_bytes().decode("ascii")
    changed = without_decimals(text)
    if changed == text:
        return read_file(job)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, job.path.name)
        copy.write_bytes(changed.encode("ascii"))
        return read_file(job._replace(path=copy))


def without_decimals(text: str) -> str:
    """The file without the REAL values that the reader dies of; everything else goes to it unchanged."""

    def section(match: re.Match[str]) -> str:
        lines = match.group(0)
        found = re.search(r"(?m)^DataType=(\w+)", lines)
        if found is None or int(found.group(1), 0) not in REALS:
            return lines
        return re.sub(rf"(?m)^(?:{'|'.join(VALUES)})=(?!0x).*\n", "", lines)

    return re.sub(r"(?m)^\[\w+\]\r?\n(?:[^\[\n].*\n?)*", section, text)


def read_file(job: Job) -> Reading:
    complaints = dcfchk(job)
    cfg = parse_file(str(job.path))
    if not lint(cfg):
        complaints.append("lint failed")
    device = Device(cfg, {} if job.dcf else {"NODEID": job.node})
    facts: dict[str, Any] = {"DeviceInfo": device_info(device)}
    if job.dcf:
        facts["DeviceComissioning"] = {"NodeID": device.node_id}
    for obj in device.values():
        add_object(facts, obj, job.dcf)
    add_unlisted(facts, cfg.sections())
    return Reading(facts, complaints)


def dcfchk(job: Job) -> list[str]:
    """What the command does, in this process: silent and exit code 0, or a complaint."""
    said = io.StringIO()
    with redirect_stdout(said), redirect_stderr(said), warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)
        try:
            code = command(["-n", str(job.node), str(job.path)])
        except Exception as error:  # it ends with a traceback
            code = 1
            print(f"{type(error).__name__}: {error}", file=said)
    lines = said.getvalue().strip().splitlines()
    return [f"dcfchk exit {code}: {lines[-1] if lines else 'no message'}"] if code or lines else []


def command(arguments: list[str]) -> int:
    """Runs dcfchk with these arguments; its exit code."""
    before, sys.argv = sys.argv, ["dcfchk", *arguments]
    try:
        cli.main()
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    finally:
        sys.argv = before
    return 0


def device_info(device: Device) -> dict[str, Any]:
    section = device.cfg["DeviceInfo"]
    info = {key: getattr(device, name) for key, name in IDENTITY.items()}
    return info | {key: int(section[key], 0) for key in ("NrOfRXPDO", "NrOfTXPDO")}


def add_object(facts: dict[str, Any], obj: Object, dcf: bool) -> None:
    name = f"{obj.index:04X}"
    facts[name] = {"ParameterName": obj.name, "ObjectType": obj.object_type}
    if obj.object_type in (8, 9):
        for sub, entry in obj.items():
            facts[f"{name}sub{sub:X}"] = variable(entry, f"{name}sub{sub:X}", dcf)
    else:
        facts[name].update(variable(obj[0], name, dcf))


def add_unlisted(facts: dict[str, Any], sections: list[str]) -> None:
    """Sections that no object list names: the reader has them, but makes no object of them."""
    known = {name.lower() for name in facts}
    for name in sections:
        if re.fullmatch(r"[0-9a-f]{4}(sub[0-9a-f]+)?", name.lower()) and name.lower() not in known:
            facts[name] = {}


def variable(entry: SubObject, section: str, dcf: bool) -> dict[str, Any]:
    keys = entry.cfg[section]
    facts = {
        "ParameterName": entry.name,
        "DataType": entry.data_type.index,
        "AccessType": entry.access_type.name,
        "PDOMapping": int(entry.pdo_mapping),
        # an absent default reads as zero, so the reader's section says whether it is there
        "DefaultValue": plain(entry, entry.default_value) if keys.get("DefaultValue") else None,
        "LowLimit": plain(entry, getattr(entry, "low_limit", None)),
        "HighLimit": plain(entry, getattr(entry, "high_limit", None)),
        "ObjFlags": int(keys.get("ObjFlags") or "0", 0),
    }
    if dcf:
        facts["ParameterValue"] = plain(entry, entry.value) if keys.get("ParameterValue") else None
    return facts


def plain(entry: SubObject, value: Any) -> Any:
    if value is None:
        return None
    if entry.data_type.is_basic():
        return value.parse(entry.env)
    return text_value(value.value, entry.data_type.index)


if __name__ == "__main__":
    main(Tool("dcfchk", lambda job: version("dcf-tools"), read, LIMITS))
