#!/usr/bin/env python3
"""Plant faults in EDS and DCF files, one in each copy.

    mutate.py OUT [--all]

Takes files without a fault, the device of the self test and the shipped ones, and writes copies with one fault
each: what vendors and editors do wrong, and what one reader or another does not take. A fault of an entry is
planted in the first, a middle and the last object and sub-index where it can be. The same files come out of each
run; their names say what was done where. Without --all, it is one of seven.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from run import HERE, ROOT

EVERY = 7
# Of those, a sample that has faults of every kind: each so many, beginning so far after the first, and what there is once only.
SAMPLE, FIRST = 6, 4
ONCE = re.compile(r"-(as-it-is|cp1252|utf-16)\.eds$")


class File:
    """A file as blocks of lines: what is before the first section, then the sections with comments above."""

    def __init__(self, text: str) -> None:
        self.text = text.replace("\r\n", "\n")

    def names(self) -> list[str]:
        return re.findall(r"(?m)^\[(.*)\]$", self.text)

    def values(self) -> list[str]:
        """Sections that describe a value."""
        return [name for name in self.names() if re.fullmatch(r"[0-9A-F]{4}(sub[0-9A-F]+)?", name) and self.get(name, "DataType")]

    def objects(self, kind: str) -> list[str]:
        return [name for name in self.names() if re.fullmatch(r"[0-9A-F]{4}", name) and self.get(name, "ObjectType") == kind]

    def body(self, name: str) -> tuple[int, int]:
        start = self.text.index(f"[{name}]\n") + len(name) + 3
        end = self.text.find("\n\n", start - 1)
        return start, end + 1 if end >= 0 else len(self.text)

    def get(self, name: str, key: str) -> str | None:
        start, end = self.body(name)
        found = re.search(rf"(?m)^{key}=(.*)$", self.text[start:end])
        return found.group(1) if found else None

    def edit(self, name: str, change: Callable[[str], str]) -> str:
        """The text with the keys of a section changed."""
        start, end = self.body(name)
        return self.text[:start] + change(self.text[start:end]) + self.text[end:]

    def set(self, name: str, key: str, value: str) -> str:
        """The text with a key set, or added."""

        def change(body: str) -> str:
            line = f"{key}={value}"
            if re.search(rf"(?m)^{key}=", body):
                return re.sub(rf"(?m)^{key}=.*$", lambda _: line, body)
            return f"{body}{line}\n"

        return self.edit(name, change)

    def drop(self, name: str, key: str) -> str:
        return self.edit(name, lambda body: re.sub(rf"(?m)^{key}=.*\n", "", body))

    def cut(self, name: str) -> str:
        """The text without a section."""
        start, end = self.body(name)
        return self.text[: start - len(name) - 3] + self.text[end:].lstrip("\n")

    def header(self, name: str, written: str) -> str:
        return self.text.replace(f"[{name}]\n", f"{written}\n", 1)

    def add(self, section: str) -> str:
        return f"{self.text.rstrip()}\n\n{section}\n"


def some(names: list[str]) -> list[str]:
    """First, middle and last."""
    return list(dict.fromkeys([names[0], names[len(names) // 2], names[-1]])) if names else []


def spread(names: list[str]) -> list[str]:
    """First, middle and last object, and sub-index."""
    return some([name for name in names if "sub" not in name]) + some([name for name in names if "sub" in name])


Mutation = tuple[str, str]

KEYS = {
    "AccessType": ["", "readonly", "R", "RW", "Const", "rw ; r", "rw # r", "UNKNOWN"],
    "DataType": ["", "7", "07", "0x99", "0xA0", "0x17", "UNSIGNED8", "0x0007 ; x"],
    "PDOMapping": ["", "0x1", "yes", "01", "2"],
    "ObjectType": ["", "7", "0x2", "0x5", "0x6", "0x8", "0x1", "07", "VAR", "0X7"],
    "ParameterName": ["", "x" * 300, "a ; b", "a # b", "a=b", "\u00e4\u00f6", '"quoted"', "100 %"],
    "ObjFlags": ["", "0x4", "x"],
    "Denotation": ["text"],
    "SubNumber": ["0", "2"],
    "CompactSubObj": ["", "0", "3"],
}
INTEGER_VALUES = [
    "", "0x", "010", "08", "1.0", "0x10UL", "10h", "-0x10", "+5", "99999999999999999999999", "0x80", "-129", "true", '"5"',
    "$NODEID", "$nodeid", "$NODEID+0x80", "0x80+$NODEID", "$NodeID + 0x80", "$NODEID+", "5 ; x", "5 # x", "1_0", "\u00e4", "text",
]
TEXT_VALUES = ["", "a;b", "a ;b", "a#b", "a=b", "true", "\u00e4", '"quoted"', "5"]


def entry_faults(file: File, name: str) -> Iterator[Mutation]:
    """What can be wrong with a section that describes a value."""
    for key in ("ParameterName", "ObjectType", "DataType", "AccessType", "PDOMapping", "DefaultValue"):
        if file.get(name, key) is not None:
            yield f"no-{key}", file.drop(name, key)
            yield f"small-{key}", file.edit(name, lambda body, key=key: body.replace(f"{key}=", f"{key.lower()}="))
            yield f"twice-{key}", file.edit(name, lambda body, key=key: body + f"{key}={file.get(name, key)}\n")
            yield f"blanks-{key}", file.edit(name, lambda body, key=key: body.replace(f"{key}=", f"{key} = "))
    for key, values in KEYS.items():
        for at, value in enumerate(values):
            yield f"{key}-{at}", file.set(name, key, value)
    values = TEXT_VALUES if file.get(name, "DataType") == "0x0009" else INTEGER_VALUES
    for key in ("DefaultValue", "ParameterValue", "LowLimit", "HighLimit"):
        chosen = values if key == "DefaultValue" else values[:10:3] + values[14:15]
        for at, value in enumerate(chosen):
            yield f"{key}-{at}", file.set(name, key, value)
    yield "high-below-low", File(file.set(name, "LowLimit", "5")).set(name, "HighLimit", "3")
    yield "default-above-high", File(file.set(name, "HighLimit", "3")).set(name, "DefaultValue", "4")
    yield "vendor-key", file.set(name, "Unit", "mV")
    yield "comment-inside", file.edit(name, lambda body: body + ";a comment\n")
    yield "comment-key-inside", file.edit(name, lambda body: body + ";StorageLocation=RAM\n")
    yield "hash-inside", file.edit(name, lambda body: body + "# a comment\n")
    yield "no-equals", file.edit(name, lambda body: body + "a line\n")
    yield "colon", file.edit(name, lambda body: body + "Unit: mV\n")
    yield "indented", file.edit(name, lambda body: re.sub("(?m)^AccessType", "  AccessType", body))
    yield "empty-line-inside", file.edit(name, lambda body: body.replace("\n", "\n\n", 1))
    yield "no-empty-line", file.text.replace(f"\n\n[{name}]", f"\n[{name}]")
    yield "blank-line", file.text.replace(f"\n\n[{name}]", f"\n \n[{name}]")
    yield "twice", file.edit(name, lambda body: f"{body}\n[{name}]\n{body}")
    yield "renamed", file.header(name, f"[{name.lower()}]")
    yield "capital-sub", file.header(name, f"[{name.replace('sub', 'Sub')}]")
    yield "zero-sub", file.header(name, f"[{name.replace('sub', 'sub0')}]")
    yield "text-behind-header", file.header(name, f"[{name}] # text")
    yield "blank-behind-header", file.header(name, f"[{name}] ")
    yield "blank-before-header", file.header(name, f"  [{name}]")
    yield "open-header", file.header(name, f"[{name}")
    yield "blanks-in-header", file.header(name, f"[ {name} ]")
    yield "cut", file.cut(name)
    start, end = file.body(name)
    section = file.text[start - len(name) - 3 : end]
    yield "at-the-end", File(file.cut(name)).add(section.rstrip())
    yield "at-the-beginning", f"{section}\n{file.cut(name)}"


def type_faults(file: File, name: str) -> Iterator[Mutation]:
    """Values at the edge of every type."""
    for data_type in [*range(0x01, 0x0E), *range(0x0F, 0x1C)]:
        typed = File(file.drop(name, "LowLimit"))
        typed = File(File(typed.drop(name, "HighLimit")).set(name, "DataType", f"0x{data_type:04X}"))
        for at, value in enumerate(["", "0.5", "0xFF", "-1", "0x3F000000", "0x8000000000000000", "$NODEID+1", "00 00", "1e3"]):
            yield f"type-{data_type:02X}-default-{at}", typed.set(name, "DefaultValue", value)
        for at, value in enumerate(["0x80", "0.5", "-1"]):
            yield f"type-{data_type:02X}-low-{at}", typed.set(name, "LowLimit", value)


def object_faults(file: File, name: str) -> Iterator[Mutation]:
    """What can be wrong with an ARRAY or RECORD."""
    for key, values in {
        "SubNumber": ["", "0", "1", "0x03", "200", "x"],
        "ObjectType": ["", "0x7", "0x8", "0x9", "0x6", "9"],
        "DataType": ["0x0007", ""],
        "AccessType": ["rw", ""],
        "PDOMapping": ["0"],
        "DefaultValue": ["1", ""],
        "LowLimit": ["1"],
        "CompactSubObj": ["3", "0"],
    }.items():
        for at, value in enumerate(values):
            yield f"{key}-{at}", file.set(name, key, value)
    yield "no-SubNumber", file.drop(name, "SubNumber")
    yield "no-ParameterName", file.drop(name, "ParameterName")
    yield "cut", file.cut(name)
    yield "sub0-cut", file.cut(f"{name}sub0")
    yield "sub0-wide", file.set(f"{name}sub0", "DataType", "0x0007")
    yield "sub0-wrong", file.set(f"{name}sub0", "DefaultValue", "9")
    yield "subFF", file.add(f"[{name}subFF]\nParameterName=Structure\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x00070907\nPDOMapping=0")
    yield "sub100", file.add(f"[{name}sub100]\nParameterName=Beyond\nDataType=0x0007\nAccessType=ro\nPDOMapping=0")
    yield "names", file.add(f"[{name}Name]\nNrOfEntries=1\n1=First")
    yield "denotations", file.add(f"[{name}Denotation]\nNrOfEntries=1\n1=First")
    yield "links", file.add(f"[{name}ObjectLinks]\nObjectLinks=1\n1=0x1000")


def list_faults(file: File, name: str) -> Iterator[Mutation]:
    """What can be wrong with a list of objects."""
    count = int(file.get(name, "SupportedObjects") or "0")
    for at, value in enumerate(["", "0", str(count - 1), str(count + 1), hex(count), "x", f"0{count}"]):
        yield f"SupportedObjects-{at}", file.set(name, "SupportedObjects", value)
    yield "no-count", file.drop(name, "SupportedObjects")
    yield "blank-in-key", file.edit(name, lambda body: body.replace("SupportedObjects", "Supported Objects"))
    yield "small-key", file.edit(name, lambda body: body.replace("SupportedObjects", "supportedobjects"))
    for at, value in enumerate(["", "1000", "0x5", "0x2FFF", "0x2000", "0x6040", "1000h", "0x1000 ; x", "x"]):
        yield f"first-{at}", file.set(name, "1", value)
    yield "gap", file.edit(name, lambda body: body.replace("1=", f"{count + 1}=", 1))
    yield "cut", file.cut(name)
    yield "twice", file.edit(name, lambda body: f"{body}\n[{name}]\n{body}")


def device_faults(file: File) -> Iterator[Mutation]:
    """What can be wrong with the sections about file, device and node."""
    for name in ("FileInfo", "DeviceInfo", "DummyUsage", "Comments", "DeviceComissioning"):
        if name not in file.names():
            continue
        yield f"{name}-cut", file.cut(name)
        yield f"{name}-vendor-key", file.set(name, "NG_Slave", "0")
        yield f"{name}-small", file.header(name, f"[{name.lower()}]")
        start, end = file.body(name)
        keys = re.findall(r"(?m)^(\w+)=", file.text[start:end])
        for key in some(keys) + [key for key in keys if key.startswith(("Vendor", "Nr", "Gran", "Node", "Baudrate", "Lines", "LSS"))]:
            for at, value in enumerate(["", "0x1", "010", "x", "1.0", "-1"]):
                yield f"{name}-{key}-{at}", file.set(name, key, value)
            yield f"{name}-no-{key}", file.drop(name, key)
            yield f"{name}-small-{key}", file.edit(name, lambda body, key=key: body.replace(f"{key}=", f"{key.lower()}="))
    yield "date", file.set("FileInfo", "CreationDate", "2024-05-15")
    yield "wrong-vendor", file.set("DeviceInfo", "VendorNumber", "99")
    yield "more-pdos", file.set("DeviceInfo", "NrOfTXPDO", "9")
    yield "odd-rate", file.set("DeviceInfo", "BaudRate_100", "1")
    yield "compact-pdo", File(file.set("DeviceInfo", "CompactPDO", "3")).set("DeviceInfo", "NrOfTXPDO", "5")
    yield "two-m", file.text.replace("[DeviceComissioning]", "[DeviceCommissioning]")


def pdo_faults(file: File) -> Iterator[Mutation]:
    mapping = next(name for name in file.names() if re.fullmatch(r"1A..sub1", name))
    for at, value in enumerate(
        ["0x29990008", "0x20000110", "0x00050008", "0x00050108", "0x20010210", "0x10000020", "0x400002", "536936968", "0", "", "x", "$NODEID+0x1"]
    ):
        yield f"mapping-{at}", file.set(mapping, "DefaultValue", value)
    yield "mapping-cut", file.cut(mapping[:4])
    yield "mapping-listed-only", file.text.replace(f"=0x{mapping[:4]}\n", "=0x2000\n")
    yield "mapping-count", file.set(f"{mapping[:4]}sub0", "DefaultValue", "9")
    yield "mapping-no-count", file.drop(f"{mapping[:4]}sub0", "DefaultValue")
    yield "plain-cob-id", file.set("1800sub1", "DefaultValue", "0x185")


SECTIONS = {
    "module": "[M1ModuleInfo]\nProductName=One\nProductVersion=1",
    "modules": "[SupportedModules]\nNrOfEntries=0",
    "tools": "[Tools]\nItems=0",
    "dynamic": "[DynamicChannels]\nNrOfSeg=0",
    "vendor": "[StandardizedObjects]\nSupportedObjects=0",
    "profile": "[DeviceProfile]\nx=1",
    "default": "[DEFAULT]\nx=1",
    "unlisted": "[2FF0]\nParameterName=Unlisted\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nPDOMapping=0",
    "unlisted-bare": "[2FF0]\nParameterName=Unlisted\nObjectType=0x7",
    "domain": "[2FF0]\nParameterName=Block\nObjectType=0x2\nDataType=0x000F\nAccessType=rw",
    "domain-mapping": "[2FF0]\nParameterName=Block\nObjectType=0x2\nDataType=0x000F\nAccessType=rw\nPDOMapping=0",
    "deftype": "[00A0]\nParameterName=Type\nObjectType=0x5\nDataType=0x0005\nAccessType=rw",
    "compact": "[2FF0]\nParameterName=Many\nObjectType=0x8\nDataType=0x0005\nAccessType=rw\nPDOMapping=0\nCompactSubObj=3\n\n[2FF0Name]\nNrOfEntries=1\n2=Second",
    "compact-values": "[2FF0]\nParameterName=Many\nObjectType=0x8\nDataType=0x0005\nAccessType=rw\nCompactSubObj=3\n\n[2FF0Value]\nNrOfEntries=2\n1=5\n2=300",
    "compact-bare": "[2FF0]\nParameterName=Many\nObjectType=0x8\nAccessType=rw\nCompactSubObj=3",
    "compact-names": "[2FF0]\nParameterName=Many\nObjectType=0x8\nDataType=0x0005\nAccessType=rw\nCompactSubObj=2\n\n[2FF0Name]\nNrOfEntries=2\n1=First\n2=Second",
    "mixed": "[2FF0]\nParameterName=Mixed\nObjectType=0x8\nSubNumber=3\n\n[2FF0sub0]\nParameterName=n\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n\n"
    "[2FF0sub1]\nParameterName=a\nDataType=0x0005\nAccessType=ro\n\n[2FF0sub2]\nParameterName=b\nDataType=0x0006\nAccessType=ro",
    "orphan": "[2FF0sub1]\nParameterName=Orphan\nDataType=0x0005\nAccessType=rw\nPDOMapping=0",
}


def text_faults(file: File) -> Iterator[Mutation]:
    """What can be wrong with the text as a whole. Carriage returns stay as they are written here."""
    yield "crlf", file.text.replace("\n", "\r\n")
    yield "cr", file.text.replace("\n", "\r")
    yield "mark", "\ufeff" + file.text
    yield "mark-comment", "\ufeff; a comment\n" + file.text
    yield "junk-first", "junk\n" + file.text
    yield "key-first", "Key=1\n" + file.text
    yield "comment-first", "; a comment\n\n" + file.text
    yield "comment-last", file.text + "\n; the end\n"
    for count in range(5):
        yield f"end-{count}", file.text.rstrip("\n") + "\n" * count
    yield "empty-lines", file.text.replace("\n\n", "\n\n\n")
    yield "long-line", "; " + "x" * 300 + "\n" + file.text
    for key, section in SECTIONS.items():
        yield f"section-{key}", file.add(section)


def mutations(file: File, is_small: bool) -> Iterator[Mutation]:
    values = file.values()
    for name in spread(values) if is_small else some([name for name in values if "sub" in name]):
        for what, text in entry_faults(file, name):
            yield f"{name}-{what}", text
    structured = some(file.objects("0x9")) + some(file.objects("0x8"))
    for name in dict.fromkeys(structured if is_small else structured[:1]):
        for what, text in object_faults(file, name):
            yield f"{name}-{what}", text
    if not is_small:
        return
    for name in (next(name for name in values if name.startswith("2") and "sub" not in name), "2001sub1"):
        for what, text in type_faults(file, name):
            yield f"{name}-{what}", text
    for name in ("MandatoryObjects", "OptionalObjects", "ManufacturerObjects"):
        for what, text in list_faults(file, name):
            yield f"{name}-{what}", text
    yield from device_faults(file)
    yield from pdo_faults(file)
    yield from text_faults(file)


def readable_by_all(file: File) -> File:
    """The device of the self test without its DOMAINs, which eds-utils does not know, and without REAL values."""
    for name in ("1021", "2002subC"):
        file = File(file.cut(name))
    file = File(file.text.replace("2=0x1021\n3=0x1400\n4=0x1600\n5=0x1800\n6=0x1A00", "2=0x1400\n3=0x1600\n4=0x1800\n5=0x1A00"))
    file = File(file.set("OptionalObjects", "SupportedObjects", "5"))
    file = File(file.set("2002", "SubNumber", "12"))
    file = File(file.drop("2002sub9", "ParameterValue"))
    return File(file.set("2002sub0", "DefaultValue", "11"))


def bases() -> Iterator[tuple[str, File, bool]]:
    for name in ("device.eds", "device.dcf"):
        text = (HERE / "selftest" / name).read_text(encoding="utf-8")
        yield name, readable_by_all(File(text)), name.endswith(".eds")
    shipped = ROOT / "generated" / "eds" / "pmm.eds"
    yield shipped.name, File(shipped.read_text(encoding="utf-8")), False


def contents() -> dict[str, bytes]:
    """All files by name."""
    files: dict[str, bytes] = {}
    for base, file, is_small in bases():
        stem, suffix = base.split(".")
        files[f"{stem}-as-it-is.{suffix}"] = file.text.encode("utf-8")
        for what, text in mutations(file, is_small):
            if text != file.text:
                files[f"{stem}-{what}.{suffix}"] = text.encode("utf-8")
        for encoding in ("cp1252", "utf-16") if is_small else ():
            text = file.text.replace("Umlaut", "Uml\u00e4ut", 1)
            files[f"{stem}-{encoding}.{suffix}"] = text.encode(encoding)
    return files


def write(folder: Path, every: int = EVERY, sample: bool = False) -> int:
    """Writes one file of so many, or a sample of them; how many there are."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    chosen = list(contents().items())[::every]
    if sample:
        chosen = [one for at, one in enumerate(chosen) if at % SAMPLE == FIRST or ONCE.search(one[0])]
    for name, content in chosen:
        (folder / name).write_bytes(content)
    return len(chosen)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--all", action="store_true")
    args = parser.parse_args()
    print(f"{write(args.out, 1 if args.all else EVERY)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
