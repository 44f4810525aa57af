"""Read an EDS or DCF file with eds-utils and compare it with the model."""

from __future__ import annotations

import re
import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

from eds_utils.core.file_io.read_eds import read_eds
from eds_utils.core.objects import Variable

from compare import Case, Job, Limit, Reading, Tool, main, not_exposed
from expected import OCTETS, REALS, STRINGS, TIMES, real_value, text_value

TEXTS = STRINGS | OCTETS


def is_sub0(case: Case) -> bool:
    return case.section.endswith("sub0")


LIMITS = (
    not_exposed("ObjFlags", "the reader has no place for ObjFlags"),
    not_exposed("ParameterValue", "the reader has no place for ParameterValue"),
    Limit(
        "sub0 computed",
        "of sub 0 only name and access are kept; default, type and mapping are made up",
        lambda c: is_sub0(c) and c.key in ("DefaultValue", "DataType", "PDOMapping", "LowLimit", "HighLimit"),
    ),
    Limit(
        "no default reads as 0",
        "a missing DefaultValue becomes '0'",
        lambda c: c.key == "DefaultValue" and c.expected is None and c.read in (0, 0.0, "0"),
    ),
    Limit(
        "DOMAIN read as VAR",
        "ObjectType 2 is an uncaught ValueError, so this script hands the reader a copy with 7",
        lambda c: c.key == "ObjectType" and c.expected == 2 and c.read == 7,
    ),
)
ACCEPTED = {
    # both are keys of CiA 306
    r'Unknown entry "ObjFlags"': "complaint about ObjFlags",
    r'Unknown entry "ParameterValue"': "complaint about ParameterValue",
    # CiA 306 lets an unused mapping entry go without a default
    r"misformatted, replacing 0 with 0x00000000": "complaint about an empty mapping entry",
    # said of a list with SupportedObjects=0, too
    r"Section \[(Optional|Manufacturer)Objects\] was missing": "complaint about an empty list",
}


def read(job: Job) -> Reading:
    eds, errors = read_without_domain(job.path)
    info = eds.device_info
    facts: dict[str, Any] = {
        "DeviceInfo": {
            "VendorNumber": info.vendor_number,
            "ProductNumber": info.product_number,
            "RevisionNumber": info.revision_number,
            "NrOfRXPDO": info.num_of_rpdo,
            "NrOfTXPDO": info.num_of_tpdo,
        }
    }
    if job.dcf:
        facts["DeviceComissioning"] = {"NodeID": eds.device_commissioning.node_id}
    for index in eds.indexes:
        add_object(facts, f"{index:04X}", eds[index], job.node)
    return Reading(facts, list(errors))


def read_without_domain(path: Path) -> tuple[Any, list[str]]:
    """The reader dies of ObjectType 2; everything else goes to it unchanged."""
    text = path.read_bytes().decode("ascii")
    changed = re.sub(r"(?m)^(ObjectType=)(?:0x0*2|2)(\r?)$", r"\g<1>0x7\2", text)
    if changed == text:
        return read_eds(str(path))
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, path.name)
        copy.write_bytes(changed.encode("ascii"))
        return read_eds(str(copy))


def add_object(facts: dict[str, Any], section: str, obj: Any, node: int) -> None:
    facts[section] = {"ParameterName": obj.parameter_name, "ObjectType": int(obj.object_type)}
    if isinstance(obj, Variable):
        facts[section].update(variable(obj, node))
        return
    for sub in obj.subindexes:
        facts[f"{section}sub{sub:X}"] = variable(obj[sub], node)


def variable(entry: Variable, node: int) -> dict[str, Any]:
    data_type = int(entry.data_type)
    return {
        "ParameterName": entry.parameter_name,
        "DataType": data_type,
        "AccessType": entry.access_type.to_str(),
        "PDOMapping": int(entry.pdo_mapping),
        "DefaultValue": plain(entry.default_value, data_type, node),
        "LowLimit": plain(entry.low_limit, data_type, node),
        "HighLimit": plain(entry.high_limit, data_type, node),
    }


def plain(text: str, data_type: int, node: int) -> Any:
    """The reader keeps numbers as text."""
    if data_type in TEXTS | TIMES:
        return text_value(text, data_type)
    if not text:
        return None
    if data_type in REALS:
        return real_value(text, data_type)
    return int(text.replace("$NODEID+", ""), 0) + (node if "$NODEID" in text else 0)


if __name__ == "__main__":
    main(Tool("eds-utils", lambda job: version("eds-utils"), read, LIMITS, ACCEPTED))
