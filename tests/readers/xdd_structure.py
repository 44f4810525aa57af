#!/usr/bin/env python3
"""Hold generated XDD and XDC files to the structure of CiA 311, and compare what they say with the dump.

    xdd_structure.py --xdd-dir target/everything/xdd --dump target/everything/everything.json [--node 5]

Reads KEY.xdd and KEY.xdc of every device with the XML parser of Python, which is not ours, and with what is written
down here of the format: which elements are in which, in which order, which attributes they need and what these look
like. Then every entry is compared with `odgen dump`. Exit code 0: all agrees; 1: a difference.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import xml.etree.ElementTree as ET
from fractions import Fraction
from pathlib import Path
from typing import Any, Iterator

NAMESPACE = "{http://www.canopen.org/xml/1.1}"
XSI_TYPE = "{http://www.w3.org/2001/XMLSchema-instance}type"
# What is in an element, in this order; `?` may be missing, `*` and `+` may be there several times.
CHILDREN = {
    "ISO15745ProfileContainer": "ISO15745Profile+",
    "ISO15745Profile": "ProfileHeader ProfileBody",
    "ProfileHeader": "ProfileIdentification ProfileRevision ProfileName ProfileSource ProfileClassID ISO15745Reference",
    "ISO15745Reference": "ISO15745Part ISO15745Edition ProfileTechnology",
    "DeviceIdentity": "vendorName vendorID productName productID productText? orderNumber* version*",
    "productText": "description+",
    "DeviceFunction": "capabilities",
    "capabilities": "characteristicsList",
    "characteristicsList": "characteristic+",
    "characteristic": "characteristicName characteristicContent+",
    "characteristicName": "label+",
    "characteristicContent": "label+",
    "ApplicationProcess": "dataTypeList? parameterList",
    "dataTypeList": "array* struct*",
    "array": "subrange TYPE",
    "struct": "varDeclaration+",
    "varDeclaration": "TYPE",
    "parameterList": "parameter+",
    "parameter": "label+ description* TYPE defaultValue? allowedValues? unit? property*",
    "allowedValues": "value* range*",
    "value": "label+",
    "range": "minValue maxValue",
    "unit": "label+",
    "ApplicationLayers": "CANopenObjectList dummyUsage? dynamicChannels?",
    "CANopenObjectList": "CANopenObject+",
    "CANopenObject": "CANopenSubObject*",
    "dummyUsage": "dummy+",
    "dynamicChannels": "dynamicChannel+",
    "TransportLayers": "PhysicalLayer",
    "PhysicalLayer": "baudRate",
    "baudRate": "supportedBaudRate+",
    "NetworkManagement": "CANopenGeneralFeatures CANopenMasterFeatures? deviceCommissioning?",
}
BODY = {
    "ProfileBody_Device_CANopen": "DeviceIdentity DeviceFunction+ ApplicationProcess?",
    "ProfileBody_CommunicationNetwork_CANopen": "ApplicationLayers TransportLayers NetworkManagement?",
}
TYPES = {
    "boolean": "BOOL", "integer8": "SINT", "integer16": "INT", "integer32": "DINT", "integer64": "LINT",
    "unsigned8": "USINT", "unsigned16": "UINT", "unsigned32": "UDINT", "unsigned64": "ULINT", "real32": "REAL",
    "real64": "LREAL", "visible-string": "STRING", "unicode-string": "WSTRING",
}
TYPE_ELEMENTS = set(TYPES.values()) | {"BITSTRING", "dataTypeIDRef"}
# Elements that the schema declares at its top, which are qualified; all others are not.
QUALIFIED = {
    "ISO15745ProfileContainer", "ISO15745Profile", "DeviceIdentity", "vendorName", "vendorID", "productName", "productID",
    "productText", "orderNumber", "version", "DeviceFunction", "capabilities", "characteristicsList", "characteristic",
    "characteristicName", "characteristicContent", "ApplicationProcess", "dataTypeList", "array", "subrange", "struct",
    "varDeclaration", "parameterList", "parameter", "dataTypeIDRef", "defaultValue", "allowedValues", "range", "unit",
    "CANopenObjectList", "property",
}
HEX4, HEX2, FLAG, NUMBER = "[0-9A-F]{4}", "[0-9A-F]{2}", "true|false", r"\d+"
ENTRY = {
    "name": ".+", "objectType": "[27]|8|9", "dataType?": HEX4, "lowLimit?": r"\S+", "highLimit?": r"\S+",
    "accessType?": "const|ro|wo|rw", "defaultValue?": "(?s).*", "actualValue?": "(?s).*", "denotation?": ".+",
    "PDOmapping?": "no|default|optional|TPDO|RPDO", "objFlags?": HEX4, "uniqueIDRef?": r"\w+",
}
# The attributes of an element and what each looks like; those with `?` may be missing.
ATTRIBUTES: dict[str, dict[str, str]] = {
    "ProfileBody": {
        XSI_TYPE: "canopen:ProfileBody_(Device|CommunicationNetwork)_CANopen", "formatName": "CANopen", "formatVersion": r"1\.0",
        "fileName": r"[^/\\]+\.xd[dc]", "fileCreator": ".*", "fileCreationDate": r"\d{4}-\d\d-\d\d",
        "fileCreationTime": r"\d\d:\d\d:\d\d", "fileModifiedBy": ".*", "fileModificationDate": r"\d{4}-\d\d-\d\d",
        "fileModificationTime": r"\d\d:\d\d:\d\d", "fileVersion": ".+", "supportedLanguages": "[a-z]{2}( [a-z]{2})*",
    },
    "version": {"versionType": "SW|FW|HW"},
    "label": {"lang": "[a-z]{2}"},
    "description": {"lang": "[a-z]{2}"},
    "array": {"name": ".+", "uniqueID": r"\w+"},
    "struct": {"name": ".+", "uniqueID": r"\w+"},
    "subrange": {"lowerLimit": NUMBER, "upperLimit": NUMBER},
    "varDeclaration": {"name": ".+", "uniqueID": r"\w+"},
    "dataTypeIDRef": {"uniqueIDRef": r"\w+"},
    "parameter": {
        "uniqueID": r"\w+", "access?": "const|read|write|readWrite|readWriteInput|readWriteOutput|noAccess",
        "persistent?": FLAG, "multiplier?": r"\d+(\.\d+)?",
    },
    "defaultValue": {"value": "(?s).*"},
    "property": {
        "name": "CO_(countLabel|storageGroup|flagsPDO|accessSRDO|stringLengthMin)", "value": r"\w+",
    },
    "value": {"value": r"-?\d+"},
    "minValue": {"value": r"\S+"},
    "maxValue": {"value": r"\S+"},
    "CANopenObjectList": {"mandatoryObjects": NUMBER, "optionalObjects": NUMBER, "manufacturerObjects": NUMBER},
    "CANopenObject": {"index": HEX4, **ENTRY, "subNumber?": NUMBER},
    "CANopenSubObject": {"subIndex": HEX2, **ENTRY},
    "dummy": {"entry": "Dummy000[1-7]=[01]"},
    "dynamicChannel": {
        "dataType": HEX4, "accessType": "readOnly|writeOnly|readWriteOutput", "startIndex": HEX4, "endIndex": HEX4,
        "maxNumber": NUMBER, "addressOffset": "0x[0-9A-F]{8}",
    },
    "supportedBaudRate": {"value": "(10|20|50|100|125|250|500|800|1000) Kbps"},
    "CANopenGeneralFeatures": {
        "groupMessaging": FLAG, "dynamicChannels": NUMBER, "selfStartingDevice": FLAG, "SDORequestingDevice": FLAG,
        "granularity": NUMBER, "nrOfRxPDO": NUMBER, "nrOfTxPDO": NUMBER, "bootUpSlave": FLAG,
        "layerSettingServiceSlave": FLAG,
    },
    "CANopenMasterFeatures": {"bootUpMaster": FLAG},
    "deviceCommissioning": {
        "NodeID": NUMBER, "nodeName": ".*", "actualBaudRate": r"\d+ Kbps", "networkNumber": NUMBER, "networkName": ".*",
        "CANopenManager": FLAG,
    },
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--xdd-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, nargs="+", required=True)
    parser.add_argument("--node", type=int, default=1)
    arguments = parser.parse_args()
    faults = 0
    for dump in arguments.dump:
        model = json.loads(dump.read_text(encoding="utf-8"))
        for device in model["devices"]:
            for ending in ("xdd", "xdc"):
                path = arguments.xdd_dir / f"{device['key']}.{ending}"
                root = ET.parse(path).getroot()
                problems = list(structure(root)) + list(references(root))
                compared = [0]
                problems += facts(root, device, model, arguments.node if ending == "xdc" else None, compared)
                print(f"{path.name}: {sum(1 for _ in root.iter())} elements, {compared[0]} facts compared", end="")
                print("".join(f"\n  FAIL {problem}" for problem in problems[:20]))
                faults += len(problems)
    return 1 if faults else 0


def local(element: ET.Element) -> str:
    return element.tag.rsplit("}", 1)[-1]


def structure(root: ET.Element) -> Iterator[str]:
    """Order of elements, namespaces and attributes."""
    if local(root) != "ISO15745ProfileContainer":
        yield f"the root is {root.tag}"
    for element in root.iter():
        name = local(element)
        if element.tag != (NAMESPACE + name if name in QUALIFIED else name):
            yield f"<{name}> is in the wrong namespace: {element.tag}"
        expected = CHILDREN.get(name, "")
        if name == "ProfileBody":
            expected = BODY[element.get(XSI_TYPE, "").split(":")[-1]]
        found = "".join(f"{'TYPE' if local(child) in TYPE_ELEMENTS else local(child)} " for child in element)
        if not re.fullmatch(pattern(expected), found):
            yield f"<{name}> has {found}, expected {expected}"
        yield from attributes(element, ATTRIBUTES.get(name, {}))


def pattern(children: str) -> str:
    """A regular expression for the names of children, each with a space after it."""
    parts = []
    for child in children.split():
        name, times = (child[:-1], child[-1]) if child[-1] in "?*+" else (child, "")
        parts.append(f"(?:{name} ){times}")
    return "".join(parts)


def attributes(element: ET.Element, known: dict[str, str]) -> Iterator[str]:
    name = local(element)
    for key, form in known.items():
        value = element.get(key.rstrip("?"))
        if value is None and not key.endswith("?"):
            yield f"<{name}> lacks {key}: {element.attrib}"
        if value is not None and not re.fullmatch(form, value):
            yield f"<{name}>: {key}={value!r}"
    for key in set(element.keys()) - {key.rstrip("?") for key in known}:
        yield f"<{name}> has an attribute {key}"


def references(root: ET.Element) -> Iterator[str]:
    """Every identifier is there once, and every reference leads to one."""
    defined = [element.get("uniqueID") for element in root.iter() if element.get("uniqueID")]
    for twice in {uid for uid in defined if defined.count(uid) > 1} if len(set(defined)) < len(defined) else ():
        yield f"{twice} is defined twice"
    known = set(defined)
    for element in root.iter():
        uid = element.get("uniqueIDRef")
        if uid is not None and uid not in known:
            yield f"{uid} is not defined"


class Compare:
    def __init__(self, compared: list[int]) -> None:
        self.compared, self.problems = compared, []

    def __call__(self, what: str, found: Any, expected: Any) -> None:
        self.compared[0] += 1
        if found != expected:
            self.problems.append(f"{what}: found {found!r}, expected {expected!r}")


def facts(
    root: ET.Element, device: dict[str, Any], model: dict[str, Any], node: int | None, compared: list[int]
) -> list[str]:
    """What the file says, compared with the dump."""
    that = Compare(compared)
    parameters = {one.get("uniqueID"): one for one in root.iter(f"{NAMESPACE}parameter")}
    objects = {one.get("index"): one for one in root.iter("CANopenObject")}
    units = {unit["name"]: unit for unit in model["units"]}
    named = {one["name"]: one for one in model["types"]}
    that("objects", sorted(objects), sorted(one["index"][2:] for one in device["objects"]))
    for one in device["objects"]:
        index = one["index"][2:]
        found = objects.get(index)
        if found is None:
            continue
        that(f"{index} name", found.get("name"), one["name"])
        subs = {sub.get("subIndex"): sub for sub in found}
        if one["kind"] in ("array", "record"):
            that(f"{index} kind", found.get("objectType"), "8" if one["kind"] == "array" else "9")
            that(f"{index} subs", sorted(subs), sorted(f"{entry['sub']:02X}" for entry in one["entries"]))
            that(f"{index} subNumber", found.get("subNumber"), str(len(one["entries"])))
        for entry in one["entries"]:
            where = f"{index}.{entry['sub']}"
            element = subs.get(f"{entry['sub']:02X}") if subs else found
            if element is None:
                continue
            compare_entry(that, where, element, parameters[element.get("uniqueIDRef")], entry, units, named, node)
    return that.problems


def compare_entry(
    that: Compare, where: str, element: ET.Element, parameter: ET.Element, entry: dict[str, Any],
    units: dict[str, Any], named: dict[str, Any], node: int | None,
) -> None:
    access = entry["eds"]["access"]
    that(f"{where} accessType", element.get("accessType"), "rw" if access in ("rwr", "rww") else access)
    words = {"const": "const", "ro": "read", "wo": "write", "rw": "readWrite", "rwr": "readWriteInput", "rww": "readWriteOutput"}
    that(f"{where} access", parameter.get("access"), words[access])
    mapped = element.get("PDOmapping") != "no"
    that(f"{where} mapping", mapped, entry["pdo"] != "none")
    that(f"{where} dataType", element.get("dataType"), TYPE_CODES[entry["type"]])
    types = [child for child in parameter if local(child) in TYPE_ELEMENTS]
    that(f"{where} type", [local(child) for child in types], [TYPES.get(entry["type"], "BITSTRING")])
    default = parameter.find(f"{NAMESPACE}defaultValue")
    that(f"{where} default", None if default is None else default.get("value"), element.get("defaultValue"))
    shown = entry["default"] is not None and entry["eds"]["default"] == "written" and entry["type"] != "domain"
    that(f"{where} has a default", element.get("defaultValue") is not None, shown)
    if shown and element.get("defaultValue") and isinstance(entry["default"].get("raw"), (int, str)) and entry["type"].startswith(("integer", "unsigned", "boolean")):
        raw = int(entry["default"]["raw"])
        text = element.get("defaultValue", "")
        if "formula" in entry["default"]:
            expected = raw + node if node is not None else raw
            text = text.replace("$NODEID+", "") if node is None else text
            that(f"{where} formula", int(text.replace("$NODEID", "0"), 0), expected)
        else:
            that(f"{where} default value", int(text, 0), raw)
    unit = parameter.find(f"{NAMESPACE}unit")
    that(f"{where} has a unit", unit is not None, "unit" in entry)
    if unit is not None and "unit" in entry:
        known = units[entry["unit"]]
        label = unit.findtext("label")
        if parameter.get("multiplier") is not None or label == known["symbol"]:
            that(f"{where} symbol", label, known["symbol"])
            numerator, denominator = known["scale"]
            that(f"{where} scale", Fraction(parameter.get("multiplier", "1")), Fraction(int(numerator), int(denominator)))
    values = {int(value.get("value", "")): value.findtext("label") for value in parameter.iter("value")}
    for special in entry.get("special", []):
        that(f"{where} special", values.get(int(special["value"])), special["name"])
    for value in named.get(entry.get("named-type"), {}).get("values") or []:
        if int(value["value"]) not in {int(special["value"]) for special in entry.get("special", [])}:
            shown_name = value["name"] + ("" if value.get("supported", True) else " (not supported)")
            that(f"{where} value", values.get(int(value["value"])), shown_name)


TYPE_CODES = {
    "boolean": "0001", "integer8": "0002", "integer16": "0003", "integer32": "0004", "unsigned8": "0005",
    "unsigned16": "0006", "unsigned32": "0007", "real32": "0008", "visible-string": "0009", "octet-string": "000A",
    "unicode-string": "000B", "time-of-day": "000C", "time-difference": "000D", "domain": "000F", "integer24": "0010",
    "real64": "0011", "integer40": "0012", "integer48": "0013", "integer56": "0014", "integer64": "0015",
    "unsigned24": "0016", "unsigned40": "0018", "unsigned48": "0019", "unsigned56": "001A", "unsigned64": "001B",
}

if __name__ == "__main__":
    sys.exit(main())
