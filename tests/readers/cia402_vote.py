#!/usr/bin/env python3
"""What vendors' drives say about the standard objects of CiA 402, and where most of them differ from the library.

    cia402_vote.py CORPUS DUMP [--all] [--vendors]

CORPUS is a directory with EDS and DCF files, searched with everything below it. DUMP is the output of `odgen dump FILE --json` or
`odgen dump FILE` for a specification whose devices together have every object of the library.

Of the files, those count that describe a drive: the low word of the device type (1000h) is 0192h, or there are 6040h and 6041h.
A vendor has one vote on each fact, whatever the number of its files: what most of them say, none if they are split. Files that
name no vendor have no vote. The output is a Markdown table of the facts on which at least three vendors vote and more than half of them
say something else than the library.
"""

import argparse
import collections
import json
import pathlib
import re
import sys

DATA_TYPES = {
    0x01: "BOOLEAN", 0x02: "INTEGER8", 0x03: "INTEGER16", 0x04: "INTEGER32", 0x05: "UNSIGNED8", 0x06: "UNSIGNED16",
    0x07: "UNSIGNED32", 0x08: "REAL32", 0x09: "VISIBLE_STRING", 0x0A: "OCTET_STRING", 0x0B: "UNICODE_STRING",
    0x0C: "TIME_OF_DAY", 0x0D: "TIME_DIFFERENCE", 0x0F: "DOMAIN", 0x10: "INTEGER24", 0x11: "REAL64", 0x12: "INTEGER40",
    0x13: "INTEGER48", 0x14: "INTEGER56", 0x15: "INTEGER64", 0x16: "UNSIGNED24", 0x18: "UNSIGNED40", 0x19: "UNSIGNED48",
    0x1A: "UNSIGNED56", 0x1B: "UNSIGNED64",
}
OBJECT_TYPES = {2: "DOMAIN", 7: "VAR", 8: "ARRAY", 9: "RECORD"}
# What can be done with an entry; the three words for "read and write" differ only in the direction of PDOs.
ACCESS = {"ro": "ro", "const": "ro", "wo": "wo", "rw": "rw", "rwr": "rw", "rww": "rw"}
# What says nothing about whose file it is.
LEGAL_FORMS = {
    "ag", "co", "company", "corp", "corporation", "electric", "electronic", "electronics", "gmbh", "inc", "kg", "limited", "ltd",
    "technologies", "technology",
}
# What is in examples where a company's name belongs.
PLACEHOLDERS = {"demo", "example", "manufacturer", "test", "unknown", "vendor"}
# Facts on which there is no vote, so that a device of the dump may depart from the library in them.
NOT_VOTED = {"default", "min", "max", "unit"}
FACTS = ["object type", "highest sub-index", "data type", "access", "PDO mapping"]


# --- EDS and DCF files ---------------------------------------------------------------------------------------------------

def text_of(path):
    data = path.read_bytes()
    for encoding in ("utf-8-sig", "latin-1"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            pass
    raise AssertionError("every byte is a character of latin-1")


def sections_of(text):
    """Sections by lower-case name, with lower-case keys. Of a section or key that is written twice, the first counts."""
    sections = {}
    section = None
    for line in text.splitlines():
        line = line.strip()
        if not line or line.startswith((";", "#")):
            continue
        header = re.match(r"\[\s*([^\]]*?)\s*\]", line)
        if header:
            section = sections.setdefault(header.group(1).lower(), {})
        elif section is not None and "=" in line:
            key, value = line.split("=", 1)
            section.setdefault(key.strip().lower(), value.strip())
    return sections


def number(text):
    """The number at the start of a value; what follows, such as a comment, is dropped."""
    found = re.match(r"(0[xX][0-9a-fA-F]+|\d+)\b", (text or "").strip())
    if not found:
        return None
    digits = found.group(1)
    return int(digits, 16) if digits.lower().startswith("0x") else int(digits)


def facts_of_entry(keys):
    facts = {}
    kind = number(keys.get("datatype"))
    if kind is not None:
        facts["data type"] = DATA_TYPES.get(kind, f"{kind:04X}h")
    word = re.match(r"[a-z]*", keys.get("accesstype", "").lower()).group(0)
    if word in ACCESS:
        facts["access"] = ACCESS[word]
    # CiA 306: an entry without the key cannot be mapped.
    facts["PDO mapping"] = "yes" if number(keys.get("pdomapping")) == 1 else "no"
    return facts


def facts_of_file(sections):
    """Facts of the objects 6000h to 67FFh: {(index, sub-index or None for the object, fact): value}."""
    facts = {}
    subs = collections.defaultdict(dict)
    for name, keys in sections.items():
        found = re.fullmatch(r"([0-9a-f]{4})sub([0-9a-f]{1,2})", name)
        if found:
            subs[int(found.group(1), 16)][int(found.group(2), 16)] = keys
    for name, keys in sections.items():
        if not re.fullmatch(r"6[0-7][0-9a-f]{2}", name):
            continue
        index = int(name, 16)
        # CiA 306: an object without the key is a VAR.
        kind = number(keys.get("objecttype")) or 7
        facts[index, None, "object type"] = OBJECT_TYPES.get(kind, f"{kind}")
        if kind not in (8, 9):
            entries = {0: keys}
        else:
            entries = {sub: keys for sub, keys in subs[index].items() if sub > 0}
            compact = number(keys.get("compactsubobj"))
            if compact:
                entries = {sub: keys for sub in range(1, compact + 1)}
            if entries:
                facts[index, None, "highest sub-index"] = str(max(entries))
        for sub, keys in entries.items():
            for fact, value in facts_of_entry(keys).items():
                facts[index, sub, fact] = value
    return facts


def is_drive(sections):
    device_type = number(sections.get("1000", {}).get("defaultvalue")) or 0
    return device_type & 0xFFFF == 0x0192 or ("6040" in sections and "6041" in sections)


def vendor_of(sections):
    """A short name under which the differently written names of one company meet; None if the file names none."""
    keys = sections.get("deviceinfo", {})
    words = re.findall(r"[a-z0-9]+", keys.get("vendorname", "").lower())
    words = [word for word in words if word not in LEGAL_FORMS]
    return words[0] if words and words[0] not in PLACEHOLDERS else None


# --- the library ---------------------------------------------------------------------------------------------------------

def facts_of_library(dump, profile):
    facts = {}
    names = {}
    for device in dump["devices"]:
        for each in device["objects"]:
            # An object in which the specification departs from the library says nothing about the library.
            departs = any(fact.split(": ")[-1] not in NOT_VOTED for fact in each.get("differs", []))
            if each.get("profile") != profile or departs:
                continue
            index = int(each["index"], 16)
            kind = each["kind"].upper()
            facts[index, None, "object type"] = kind
            names[index, None] = each["name"]
            entries = each["entries"]
            if kind in ("ARRAY", "RECORD"):
                entries = [entry for entry in entries if entry["sub"] > 0]
                facts[index, None, "highest sub-index"] = str(max(entry["sub"] for entry in entries))
            for entry in entries:
                sub = entry["sub"]
                names[index, sub] = entry["name"]
                facts[index, sub, "data type"] = entry["type"].upper().replace("-", "_")
                facts[index, sub, "access"] = ACCESS[entry["access"]]
                facts[index, sub, "PDO mapping"] = "no" if entry["pdo"] == "none" else "yes"
    return facts, names


# --- the vote ------------------------------------------------------------------------------------------------------------

def winner(counts):
    """The value that more than half of the votes are for, or None."""
    value, votes = counts.most_common(1)[0]
    return value if 2 * votes > sum(counts.values()) else None


def count_votes(corpus):
    """{fact: Counter of votes}, and what was read."""
    by_vendor = collections.defaultdict(lambda: collections.defaultdict(collections.Counter))
    files = unnamed = 0
    vendors = collections.Counter()
    for path in sorted(path for path in corpus.rglob("*") if path.suffix.lower() in (".eds", ".dcf") and path.is_file()):
        sections = sections_of(text_of(path))
        if not is_drive(sections):
            continue
        vendor = vendor_of(sections)
        if vendor is None:
            unnamed += 1
            continue
        files += 1
        vendors[vendor] += 1
        for fact, value in facts_of_file(sections).items():
            by_vendor[vendor][fact][value] += 1
    votes = collections.defaultdict(collections.Counter)
    for facts in by_vendor.values():
        for fact, counts in facts.items():
            value = winner(counts)
            if value is not None:
                votes[fact][value] += 1
    return votes, vendors, files, unnamed


def order(fact):
    index, sub, name = fact
    return index, -1 if sub is None else sub, FACTS.index(name)


def entry_name(fact):
    index, sub, _ = fact
    return f"{index:04X}h" if not sub else f"{index:04X}h.{sub}"


def spelled(counts):
    return ", ".join(f"{value} {votes}" for value, votes in counts.most_common())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("corpus", type=pathlib.Path, help="directory with EDS and DCF files")
    parser.add_argument("dump", type=pathlib.Path, help="JSON dump of a specification that has every object of the library")
    parser.add_argument("--profile", default="cia402", help="name of the library (cia402)")
    parser.add_argument("--least", type=int, default=3, help="vendors that have to vote on a fact (3)")
    parser.add_argument("--all", action="store_true", help="list the votes on every fact, also of objects that the library lacks")
    parser.add_argument("--vendors", action="store_true", help="list the vendors with their number of files instead")
    options = parser.parse_args()

    votes, vendors, files, unnamed = count_votes(options.corpus)
    if options.vendors:
        for vendor, number_of_files in sorted(vendors.items()):
            print(f"{vendor}: {number_of_files}")
        return 0
    library, names = facts_of_library(json.loads(options.dump.read_text(encoding="utf-8")), options.profile)
    if not library:
        print(f"the dump has no object of the library {options.profile}", file=sys.stderr)
        return 1

    compared = disagreed = 0
    rows = []
    for fact in sorted(votes, key=order):
        counts = votes[fact]
        ours = library.get(fact)
        enough = sum(counts.values()) >= options.least
        most = winner(counts)
        compared += enough and ours is not None
        differs = enough and ours is not None and most is not None and most != ours
        disagreed += differs
        if differs or options.all:
            rows.append([entry_name(fact), names.get(fact[:2], ""), fact[2], ours or "", spelled(counts)])
    print(
        f"{files} files of {len(vendors)} vendors; {unnamed} more name no vendor. "
        f"{compared} facts with {options.least} votes or more, {disagreed} of them against the library.\n"
    )
    print("| Entry | Name | Fact | Library | Vendors |\n| --- | --- | --- | --- | --- |")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
