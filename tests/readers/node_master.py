#!/usr/bin/env python3
"""Be a node of python-canopen for `odgen node`, on an adapter with SLCAN.

    node_master.py --odgen target/debug/odgen --spec od-spec/devices/pitch-control-system.od.yaml --device pmc --eds generated/eds/pmc.eds

The node has the dictionary of the EDS, and no rules. odgen reads every entry; writes a backup of what it has; distinguishes what was changed
meanwhile, entry by entry; gives it back in its own order; finds it in a scan, and commands its states. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import logging
import re
import socket
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import canopen
from canopen.objectdictionary import INTEGER_TYPES, ODVariable
from canopen.sdo.exceptions import SdoAbortedError

from patience import PATIENCE, SCANS, eventually

NODE = 5
LINE = re.compile(r"^([0-9A-F]{4})h(?:\.(\d+))? .* {2}\[([0-9A-F ]*)\]$", re.MULTILINE)
REFUSED = re.compile(r"cannot read ([0-9A-F]{4})h(?:\.(\d+))? .*: the node refuses: ([0-9A-F]{4}) ([0-9A-F]{4})h")
DIFFERS = re.compile(r"^([0-9A-F]{4})h(?:\.(\d+))? .* in the node, .* in the file$", re.MULTILINE)

Id = tuple[int, int]


class Adapter(canopen.Network):
    """A node on an adapter that takes one host after the other."""

    def __init__(self, eds: Path) -> None:
        super().__init__()
        self.host: socket.socket | None = None
        self.node = canopen.LocalNode(NODE, str(eds))
        self.add_node(self.node)
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = f"tcp:127.0.0.1:{self.server.getsockname()[1]}"
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self) -> None:
        while True:
            host, _ = self.server.accept()
            host.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.host = host
            line = b""
            while byte := host.recv(1):
                if byte != b"\r":
                    line += byte
                    continue
                self.take(line.decode())
                line = b""
            self.host = None
            host.close()

    def take(self, line: str) -> None:
        assert self.host
        if not line.startswith("t"):
            self.host.sendall(b"\r")
            return
        self.host.sendall(b"z\r")
        self.notify(int(line[1:4], 16), bytearray.fromhex(line[5:]), 0.0)

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        if self.host:
            self.host.sendall(f"t{can_id:03X}{len(data)}{bytes(data).hex().upper()}\r".encode())


class Check:
    def __init__(self) -> None:
        self.passed = 0
        self.failures: list[str] = []

    def that(self, what: str, found: object, expected: object) -> None:
        if found == expected:
            self.passed += 1
        else:
            self.failures.append(f"{what}: found {found!r}, expected {expected!r}")


def value_of(node: canopen.LocalNode, index: int, sub: int) -> bytes | int:
    """What the node says of itself: bytes, or the code of its refusal."""
    try:
        data = bytes(node.get_data(index, sub, check_readable=True))
    except SdoAbortedError as abort:
        return abort.code
    return data or 0x08000024


def ids(pattern: re.Pattern[str], text: str) -> list[Id]:
    return [(int(found[1], 16), int(found[2] or 0)) for found in pattern.finditer(text)]


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("--spec", required=True)
    parser.add_argument("--device", required=True)
    parser.add_argument("--eds", type=Path, required=True)
    options = parser.parse_args()
    logging.disable(logging.ERROR)
    adapter, check = Adapter(options.eds), Check()
    node = adapter.node

    def odgen(command: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        whole = [options.odgen, "node", command, *arguments, "--slcan", adapter.address]
        return subprocess.run(whole, capture_output=True, text=True, check=False, timeout=10 * PATIENCE)

    def of_node(command: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        return odgen(command, options.spec, *arguments, "--device", options.device, "--node", str(NODE), "--timeout", str(int(1000 * PATIENCE)))

    entries: list[tuple[Id, ODVariable]] = []
    for index, one in node.object_dictionary.items():
        parts = [one] if isinstance(one, ODVariable) else list(one.values())
        entries += [((index, part.subindex), part) for part in parts]

    # Every entry: its bytes, or why not.
    said = of_node("read", *[f"{index:04X}.{sub}" for (index, sub), _ in entries])
    read: dict[Id, bytes | int] = {}
    for found in LINE.finditer(said.stdout):
        read[int(found[1], 16), int(found[2] or 0)] = bytes.fromhex(found[3])
    for found in REFUSED.finditer(said.stderr):
        read[int(found[1], 16), int(found[2] or 0)] = int(found[3] + found[4], 16)
    for at, _ in entries:
        check.that(f"read {at[0]:04X}h.{at[1]}", read.get(at), value_of(node, *at))

    with tempfile.TemporaryDirectory() as directory:
        file = str(Path(directory, "node.yaml"))
        check.that("backup", of_node("backup", "--out", file).returncode, 0)
        same = of_node("compare", file)
        check.that("compare with itself", (same.returncode, ids(DIFFERS, same.stdout)), (0, []))
        kept = [
            (at, part)
            for at, part in entries
            if part.writable and part.readable and part.data_type in INTEGER_TYPES and isinstance(value_of(node, *at), bytes)
        ]
        before = {at: value_of(node, *at) for at, _ in kept}
        changed = set()
        for at, _ in kept:
            if at[0] < 0x2000:
                continue
            data = before[at]
            assert isinstance(data, bytes)
            node.set_data(*at, bytes([data[0] ^ 1]) + data[1:])
            changed.add(at)
        told = of_node("compare", file)
        # What is a command, or a view of another entry, is no parameter.
        differing = set(ids(DIFFERS, told.stdout))
        check.that("compare with changes", told.returncode, 3)
        check.that("nothing else differs", differing - changed, set())
        check.that("something differs", len(differing) > 2, True)
        restored = of_node("restore", file, "--yes")
        check.that(f"restore {restored.stderr}", restored.returncode, 0)
        check.that("what was written", set(ids(LINE_WRITTEN, restored.stdout)), differing)
        for at in sorted(differing):
            check.that(f"{at[0]:04X}h.{at[1]} is given back", value_of(node, *at), before[at])
        check.that("compare after all", of_node("compare", file).returncode, 0)

    # A scan waits for those who are not there, so it is short; a busy machine needs a longer one.
    for milliseconds in SCANS:
        scanned = odgen("scan", options.spec, "--timeout", str(milliseconds))
        if scanned.stdout.startswith("node "):
            break
    check.that("scan", scanned.stdout.split()[:2], ["node", str(NODE)])
    check.that("scan knows the device", f"can be {options.device} " in scanned.stdout, True)
    for command, state in (("start", "OPERATIONAL"), ("stop", "STOPPED"), ("pre-operational", "PRE-OPERATIONAL")):
        check.that(command, odgen("nmt", command, "--node", "all").returncode, 0)
        check.that(f"state after {command}", eventually(lambda: node.nmt.state, state), state)
    for failure in check.failures[:20]:
        print(f"  {failure}")
    print(f"python-canopen as node of odgen, {options.device}: {len(entries)} entries, {len(differing)} given back")
    print(f"{check.passed} passed, {len(check.failures)} failed")
    return 1 if check.failures or len(entries) < 100 else 0


LINE_WRITTEN = re.compile(r"^([0-9A-F]{4})h(?:\.(\d+))? .*\]  written$", re.MULTILINE)

if __name__ == "__main__":
    sys.exit(main())
