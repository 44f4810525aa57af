#!/usr/bin/env python3
"""Read and write a node of python-canopen with the SDO client of firmware-glue.

    sdo_local_node.py generated/eds/fullmo.eds --client target/debug/sdo-client

The node has the dictionary of the EDS, and strings that take values of any length. Every entry is read in segments and in blocks, which the
node answers with segments, and in writing refuses: the client has to go on without them. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import logging
import subprocess
import sys
from pathlib import Path

import canopen
from canopen.sdo.exceptions import SdoAbortedError

from patience import PATIENCE

NODE = 5
STRINGS = (0x5F00, 0x5F01, 0x5F02)
LENGTHS = (1, 2, 3, 4, 5, 6, 7, 8, 13, 14, 15, 100, 889, 890)
WAYS = ("segments", "blocks")
READ_ONLY, NO_OBJECT = 0x06010002, 0x06020000


class Client(canopen.Network):
    """The client is a process, and this is the bus between it and the node."""

    def __init__(self, command: list[str], eds: Path) -> None:
        super().__init__()
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.answers: list[bytes] = []
        self.node = canopen.LocalNode(NODE, str(eds))
        for index in STRINGS:
            string = canopen.objectdictionary.ODVariable(f"string {index:04X}h", index)
            string.data_type, string.access_type = canopen.objectdictionary.OCTET_STRING, "rw"
            self.node.object_dictionary.add_object(string)
        self.add_node(self.node)

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        if can_id == 0x580 + NODE:
            self.answers.append(bytes(data))

    def run(self, command: str) -> str:
        """How a transfer ends."""
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(command + "\n")
        self.process.stdin.flush()
        while True:
            word, _, rest = self.process.stdout.readline().strip().partition(" ")
            if word != "send":
                return f"{word} {rest}"
            self.answers.clear()
            self.notify(0x600 + NODE, bytearray.fromhex(rest), 0.0)
            for answer in self.answers:
                self.process.stdin.write(answer.hex() + "\n")
            self.process.stdin.write("\n")
            self.process.stdin.flush()


def value_of(node: canopen.LocalNode, index: int, sub: int) -> str:
    """How reading ends, by what the node says of itself."""
    try:
        data = bytes(node.get_data(index, sub, check_readable=True))
    except SdoAbortedError as abort:
        return f"refused {abort.code:08x}"
    return f"done {data.hex()}" if data else "refused 08000024"


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("eds", type=Path)
    parser.add_argument("--client", required=True)
    options = parser.parse_args()
    logging.disable(logging.ERROR)  # the node complains of every block
    client = Client([options.client, str(NODE)], options.eds)
    failures: list[str] = []
    done = 0

    def that(command: str, expected: str) -> None:
        nonlocal done
        done += 1
        if (found := client.run(command)) != expected:
            failures.append(f"{command}: found {found!r}, expected {expected!r}")

    node = client.node
    entries = []
    for index, one in node.object_dictionary.items():
        parts = [one] if isinstance(one, canopen.objectdictionary.ODVariable) else list(one.values())
        entries += [(index, part.subindex, part.writable) for part in parts]
    for index, sub, writable in entries:
        for way in WAYS:
            that(f"read {way} {index:x}.{sub:x}", value_of(node, index, sub))
            if not writable:
                that(f"write {way} {index:x}.{sub:x} 00", f"refused {READ_ONLY:08x}")
            elif (own := value_of(node, index, sub)).startswith("done "):
                that(f"write {way} {index:x}.{sub:x} {own[5:]}", own)
    for number, index in enumerate(STRINGS):
        for length in LENGTHS:
            for way in WAYS:
                data = bytes((at * 7 + number + length) % 256 for at in range(length)).hex()
                that(f"write {way} {index:x}.0 {data}", f"done {data}")
                if (stored := value_of(node, index, 0)) != f"done {data}":
                    failures.append(f"{index:04X}h holds {stored!r}, expected {data}")
                for reading in WAYS:
                    that(f"read {reading} {index:x}.0", f"done {data}")
    that("read segments 5fff.0", f"refused {NO_OBJECT:08x}")
    that("write blocks 5fff.0 0102030405", f"refused {NO_OBJECT:08x}")
    assert client.process.stdin
    client.process.stdin.close()
    client.process.wait(timeout=PATIENCE)
    for failure in failures[:20]:
        print(f"  {failure}")
    enough = len(entries) > 100
    verdict = f"{len(failures)} differences" if failures else "ok" if enough else "too few entries"
    print(f"python-canopen as SDO server, {options.eds.stem}: {len(entries)} entries, {done} transfers, {verdict}")
    return 1 if failures or not enough else 0


if __name__ == "__main__":
    sys.exit(main())
