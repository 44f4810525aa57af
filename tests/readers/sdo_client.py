#!/usr/bin/env python3
"""Read and write a generated Rust dictionary with python-canopen, by the EDS of the same device.

    sdo_client.py --server target/debug/sdo-server --eds-dir generated/eds --dump generated/pitch-control-system.json

The server holds the Rust dictionary with the SDO server of firmware-glue; the client knows only the EDS. Every entry of
the EDS is read, in one frame, in segments and in blocks, and compared with the dump; every writable one gets its own value
back, each way; what must be refused is refused with the expected abort code. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

import canopen
from canopen.sdo import SdoAbortedError

from patience import PATIENCE

NODE = 5
READ_ONLY, WRITE_ONLY, NO_DATA, LOCKED, NOT_STORED = 0x06010002, 0x06010001, 0x08000024, 0x08000022, 0x08000020
IN_USE, TOO_LONG, NO_SUB_INDEX, NO_OBJECT = 0x06010000, 0x06070012, 0x06090011, 0x06020000


class Pipe(canopen.Network):
    """A network of one node, whose SDO server is a process."""

    def __init__(self, command: list[str]) -> None:
        super().__init__()
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        if can_id != 0x600 + NODE:
            return
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(bytes(data).ljust(8, b"\0").hex() + "\n")
        self.process.stdin.flush()
        while line := self.process.stdout.readline().strip():
            self.notify(0x580 + NODE, bytearray.fromhex(line), 0.0)


class Check:
    def __init__(self) -> None:
        self.done = 0
        self.segmented = 0
        self.blocks = 0
        self.failures: list[str] = []

    def that(self, what: str, found: object, expected: object) -> None:
        self.done += 1
        if found != expected:
            self.failures.append(f"{what}: found {found!r}, expected {expected!r}")


def code_of(access, *arguments) -> int | object:
    """The abort code of an access, or what it gave."""
    try:
        return access(*arguments)
    except SdoAbortedError as abort:
        return abort.code


def read_in_blocks(sdo, index: int, sub: int) -> bytes:
    with sdo.open(index, sub, "rb", block_transfer=True) as stream:
        return stream.read()


def write_in_blocks(sdo, index: int, sub: int, data: bytes) -> None:
    with sdo.open(index, sub, "wb", size=len(data), block_transfer=True) as stream:
        stream.write(data)


def write_in_segments(sdo, index: int, sub: int, data: bytes) -> None:
    with sdo.open(index, sub, "wb", size=len(data), force_segment=True) as stream:
        stream.write(data)


def check_ways(check: Check, sdo, index: int, sub: int, found: bytes, expected: int | None) -> None:
    """That segments and blocks give and take what one frame, or the segments that the client chose, did."""
    where = f"{index:04X}h.{sub}"
    check.that(f"{where} in blocks", code_of(read_in_blocks, sdo, index, sub), found)
    check.blocks += 1
    if not found:
        return  # the client sends nothing at all then
    if index in (0x1010, 0x1011):
        return  # a number is no signature, and the client does not end a stream that it gave up
    for way, write in (("segments", write_in_segments), ("blocks", write_in_blocks)):
        check.that(f"{where} written in {way}", code_of(write, sdo, index, sub, found), expected)
    check.segmented += 1
    check.blocks += 1


def check_entry(check: Check, sdo, index: int, entry: dict, size: int) -> None:
    sub = entry["sub"]
    where = f"{index:04X}h.{sub}"
    found = code_of(sdo.upload, index, sub)
    if entry["access"] == "wo":
        check.that(where, found, WRITE_ONLY)
        return
    if index == 0x1003 and sub > 0:
        check.that(where, found, NO_DATA)
        return
    default = entry["default"]
    if default and "raw" in default and "alias" not in entry:
        raw = int(default["raw"]) + (NODE if "formula" in default else 0)
        check.that(where, found, (raw & (1 << 8 * size) - 1).to_bytes(size, "little"))
    elif default and "text" in default and "alias" not in entry:
        check.that(where, found, default["text"].encode())
    else:
        check.that(f"{where} length", len(found) if isinstance(found, bytes) else found, size)
    if not isinstance(found, bytes):
        return
    outcome = code_of(sdo.download, index, sub, found)
    expected = expected_of_writing(index, sub, entry, found)
    check.that(f"{where} written back", outcome, expected)
    check_ways(check, sdo, index, sub, found, expected)
    if entry["access"] == "rw" and not entry["locked"] and not 0x1600 <= index < 0x1C00:
        check.that(f"{where} written too long", code_of(sdo.download, index, sub, found + b"\0"), TOO_LONG)


def expected_of_writing(index: int, sub: int, entry: dict, found: bytes) -> int | None:
    """What writing the value that was read gives."""
    if entry["access"] in ("ro", "const"):
        return READ_ONLY
    if entry["locked"]:
        return LOCKED
    if index in (0x1010, 0x1011):
        return NOT_STORED
    mapping = 0x1600 <= index < 0x1800 or 0x1A00 <= index < 0x1C00
    if mapping:
        return IN_USE if valid[index - 0x200] or sub > 0 and mapped[index] else None
    low, high = entry.get("min", entry["low"]), entry.get("max", entry["high"])
    if "writable-when" in entry:
        return LOCKED if entry["writable-when"] == "0x6061 == 6" else None
    value = int.from_bytes(found, "little", signed=entry["type"].startswith("integer"))
    special = [one["value"] for one in entry.get("special", [])]
    if value in special:
        return None
    if high is not None and value > int(high):
        return 0x06090031
    if low is not None and value < int(low):
        return 0x06090032
    names = enums.get(entry.get("named-type"))
    return 0x06090030 if names is not None and value not in names else None


valid: dict[int, bool] = {}
mapped: dict[int, int] = {}
enums: dict[str, set[int]] = {}


def begin(device: dict, types: list[dict]) -> Check:
    """A check of a device, of which is known what its PDOs and enums are."""
    valid.clear()
    for pdo in device["pdos"]:
        first = 0x1400 if pdo["direction"] == "receive" else 0x1800
        valid[first + pdo["number"] - 1] = pdo["valid"]
        mapped[first + pdo["number"] - 1 + 0x200] = len(pdo["map"])
    for named in types:
        if "values" in named:
            enums[named["name"]] = {int(v["value"]) for v in named["values"] if v.get("supported", True)}
    return Check()


def check_dictionary(check: Check, node: canopen.RemoteNode, device: dict) -> None:
    """Every entry of a node that is as after a factory reset."""
    for one in device["objects"]:
        index = int(one["index"], 16)
        variables = node.object_dictionary[index]
        for entry in one["entries"]:
            sub = entry["sub"]
            variable = variables if one["kind"] == "var" else variables[sub]
            check_entry(check, node.sdo, index, entry, len(variable) // 8)
        highest = max(entry["sub"] for entry in one["entries"])
        check.that(f"{index:04X}h.{highest + 1}", code_of(node.sdo.upload, index, highest + 1), NO_SUB_INDEX)
    check.that("5FFFh", code_of(node.sdo.upload, 0x5FFF, 0), NO_OBJECT)


def check_device(server: str, eds: Path, device: dict, types: list[dict]) -> Check:
    check = begin(device, types)
    network = Pipe([server, device["key"], str(NODE)])
    try:
        node = canopen.RemoteNode(NODE, str(eds))
        network.add_node(node)
        check_dictionary(check, node, device)
    finally:
        assert network.process.stdin
        network.process.stdin.close()
        network.process.wait(timeout=PATIENCE)
    return check


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--server", required=True)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, required=True)
    options = parser.parse_args()
    dump = json.loads(options.dump.read_text(encoding="utf-8"))
    failed = 0
    for device in dump["devices"]:
        check = check_device(options.server, options.eds_dir / f"{device['key']}.eds", device, dump["types"])
        failed += bool(check.failures) or check.done < 500
        for failure in check.failures[:20]:
            print(f"  {failure}")
        verdict = "ok" if not check.failures else f"{len(check.failures)} differences"
        ways = f"{check.segmented} entries in segments, {check.blocks} transfers in blocks"
        print(f"python-canopen as SDO client, {device['key']}: {check.done} accesses, of them {ways}, {verdict}")
    devices = len(dump["devices"])
    print(f"{devices - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
