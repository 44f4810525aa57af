"""Read an EDS or DCF file with node-canopen (through node_canopen.js) and compare it with the model."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from compare import Job, Limit, Reading, Tool, main, not_exposed
from expected import OCTETS, REALS, STRINGS, TIMES, evaluate, real_value, text_value

LIMIT_KEYS = ("LowLimit", "HighLimit")
BOOLEAN = 0x01
BYTES = {0x14, 0x1A}  # the reader hands out 56-bit values as a buffer

LIMITS = (
    not_exposed("ParameterValue", "load() ignores ParameterValue"),
    not_exposed("NodeID", "load() ignores [DeviceComissioning]"),
    Limit(
        "limit 0 lost",
        "edsToEntry says `parseInt(..) || undefined`",
        lambda c: c.key in LIMIT_KEYS and c.expected == 0 and c.read is None,
    ),
    Limit(
        "limits past 2^53 rounded",
        "limits are JavaScript numbers",
        lambda c: c.key in LIMIT_KEYS and isinstance(c.expected, int) and isinstance(c.read, int)
        and abs(c.expected) > 2**53 and float(c.read) == float(c.expected),
    ),
    Limit(
        "limits of REAL cut to integers",
        "limits are read with parseInt",
        lambda c: c.key in LIMIT_KEYS and c.data_type in REALS,
    ),
    Limit(
        "BOOLEAN 0 reads as true",
        "typeToRaw asks whether the text is empty, not whether it is 0",
        lambda c: c.data_type == BOOLEAN and c.key == "DefaultValue" and (c.expected, c.read) == (0, 1),
    ),
)


def version(job: Job) -> str:
    return json.loads(job.installed.joinpath("canopen", "package.json").read_text(encoding="utf-8"))["version"]


def dump(job: Job) -> list[dict[str, Any]]:
    script = Path(__file__).with_suffix(".js")
    done = subprocess.run(
        ["node", script, job.installed, job.path], capture_output=True, text=True, check=False
    )
    if done.returncode != 0 or done.stderr:
        said = [line for line in done.stderr.splitlines() if "Error" in line]
        raise RuntimeError(said[0] if said else done.stderr)
    return [json.loads(line) for line in done.stdout.splitlines()]


def read(job: Job) -> Reading:
    head, *objects = dump(job)
    keys = ("VendorNumber", "ProductNumber", "RevisionNumber", "NrOfRXPDO", "NrOfTXPDO")
    info = head["deviceInfo"]
    facts = {"DeviceInfo": {key: int(info[key], 0) if info.get(key) else None for key in keys}}
    if job.dcf:
        facts["DeviceComissioning"] = {}
    for obj in objects:
        facts[obj["section"]] = section_facts(obj, job.node)
    return Reading(facts)


def section_facts(obj: dict[str, Any], node: int) -> dict[str, Any]:
    facts = {"ParameterName": obj["parameterName"]}
    if "sub" not in obj["section"]:
        facts["ObjectType"] = obj["objectType"]
    if "dataType" in obj:
        facts.update(variable(obj, node))
    return facts


def variable(obj: dict[str, Any], node: int) -> dict[str, Any]:
    return {
        "DataType": obj["dataType"],
        "AccessType": obj["accessType"],
        "PDOMapping": int(obj.get("pdoMapping", 0)),
        "DefaultValue": default(obj, node),
        "LowLimit": obj.get("lowLimit"),
        "HighLimit": obj.get("highLimit"),
        "ObjFlags": obj.get("objFlags", 0),
    }


def default(obj: dict[str, Any], node: int) -> Any:
    """The reader's value where it makes one, else its text: it leaves $NODEID, octets and REAL bit
    patterns as text, and overwrites the value of sub 0 with the highest sub-index that it meets."""
    text, data_type = obj.get("defaultValue"), obj["dataType"]
    if not text:
        return None
    if data_type in STRINGS | OCTETS | TIMES:
        return text_value(text, data_type)
    if text.startswith("$NODEID") or obj["section"].endswith("sub0") or data_type in BYTES:
        return evaluate(text, node)
    if data_type == BOOLEAN:
        return int(obj["value"] == "true")
    return real_value(text, data_type) if data_type in REALS else int(obj["value"])


if __name__ == "__main__":
    main(Tool("node-canopen", version, read, LIMITS))
