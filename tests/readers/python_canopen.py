"""Read an EDS or DCF file with python-canopen and compare it with the model."""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

import canopen
from canopen.objectdictionary import ODArray, ODRecord, ODVariable

from compare import Job, Limit, Reading, Tool, main, not_exposed
from expected import REALS, text_value

ODD_INTEGERS = {0x10, 0x12, 0x13, 0x14}

LIMITS = (
    not_exposed("ObjFlags", "import_eds does not look at ObjFlags"),
    Limit(
        "limits of REAL lost",
        "LowLimit and HighLimit are read as integers, and a decimal number is dropped silently",
        lambda c: c.key in ("LowLimit", "HighLimit") and c.data_type in REALS and c.read is None,
    ),
    Limit(
        "REAL bit patterns not understood",
        "it takes decimal numbers only; lely takes bit patterns only",
        lambda c: c.data_type in REALS and (isinstance(c.read, int) or str(c.read).startswith("not understood: 0x")),
    ),
    Limit(
        "limits of 24/40/48/56-bit INTEGER lost",
        "_calc_bit_length knows 8, 16, 32 and 64 bits, and its ValueError is swallowed",
        lambda c: c.key in ("LowLimit", "HighLimit") and c.data_type in ODD_INTEGERS and c.read is None,
    ),
)
DUMMIES = range(1, 8)  # [DummyUsage] makes an object of each


def read(job: Job) -> Reading:
    od = canopen.import_od(str(job.path), None if job.dcf else job.node)
    facts = {"DeviceInfo": device_info(od)}
    if job.dcf:
        facts["DeviceComissioning"] = {"NodeID": od.node_id}
    for index, obj in od.indices.items():
        if index not in DUMMIES:
            add_object(facts, obj, job.dcf)
    return Reading(facts)


def device_info(od: canopen.ObjectDictionary) -> dict[str, Any]:
    info = od.device_information
    return {
        "VendorNumber": info.vendor_number,
        "ProductNumber": info.product_number,
        "RevisionNumber": info.revision_number,
        "NrOfRXPDO": info.nr_of_RXPDO,
        "NrOfTXPDO": info.nr_of_TXPDO,
    }


def add_object(facts: dict[str, Any], obj: Any, dcf: bool) -> None:
    section = f"{obj.index:04X}"
    facts[section] = {"ParameterName": obj.name, "ObjectType": object_type(obj)}
    if isinstance(obj, ODVariable):
        facts[section].update(variable(obj, dcf))
        return
    for sub, entry in obj.subindices.items():
        facts[f"{section}sub{sub:X}"] = variable(entry, dcf)


def object_type(obj: Any) -> int:
    """The reader keeps the class, not the number; it reads VAR and DOMAIN alike."""
    if isinstance(obj, ODRecord):
        return 9
    if isinstance(obj, ODArray):
        return 8
    return 2 if obj.data_type == 0x0F else 7


def variable(entry: ODVariable, dcf: bool) -> dict[str, Any]:
    facts = {
        "ParameterName": entry.name,
        "DataType": entry.data_type,
        "AccessType": entry.access_type,
        "PDOMapping": int(entry.pdo_mappable),
        "DefaultValue": plain(entry, entry.default, getattr(entry, "default_raw", None)),
        "LowLimit": entry.min,
        "HighLimit": entry.max,
    }
    if dcf:
        facts["ParameterValue"] = plain(entry, entry.value, getattr(entry, "value_raw", None))
    return facts


def plain(entry: ODVariable, value: Any, raw: str | None) -> Any:
    if value is None and raw:
        return f"not understood: {raw}"
    if isinstance(value, bytes):
        value = value.hex()
    return text_value(value, entry.data_type) if isinstance(value, str) else value


if __name__ == "__main__":
    main(Tool("python-canopen", lambda job: version("canopen"), read, LIMITS))
