#!/usr/bin/env python3
"""Be the master of virtual nodes: python-canopen against `odgen serve`, over SLCAN and TCP.

    virtual_node.py --odgen target/debug/odgen --eds-dir generated/eds --dump generated/pitch-control-system.json \\
        --spec od-spec/devices/pitch-control-system.od.yaml

Each device is served from its specification, as node 5, and known to the client by its EDS alone. The client gets the boot-up
message and heartbeats, changes states, reads and writes every entry as sdo_client.py does, reads and writes in blocks, sees what
is stored over a reset, and guards the node. A second client sees the same bus. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import can
import canopen

from patience import PATIENCE, Heard, settle
from sdo_client import NODE, NOT_STORED, Check, begin, check_dictionary, code_of

SAVE = b"save"


class Reached:
    """A node that runs already, alone on its bus, on an adapter over TCP that has one client."""

    is_shared = False

    def __init__(self, address: str) -> None:
        self.address = address

    @property
    def port(self) -> int:
        return int(self.address.rsplit(":", 1)[1])

    def bus(self) -> can.BusABC:
        channel = f"socket://{self.address}"
        return can.Bus(interface="slcan", channel=channel, bitrate=500_000, sleep_after_open=0)

    def end(self) -> None:
        pass


class Served(Reached):
    """`odgen serve` with one node, and a client of it."""

    is_shared = True

    def __init__(self, odgen: str, spec: Path, key: str, *more: str) -> None:
        command = [odgen, "serve", str(spec), "--node", f"{NODE}={key}", "--slcan", "tcp:127.0.0.1:0", *more]
        pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere, text=True)
        assert self.process.stdout
        super().__init__(f"127.0.0.1:{self.process.stdout.readline().rsplit(':', 1)[1].strip()}")

    def say(self, command: str) -> None:
        """A command of a script on standard input."""
        assert self.process.stdin
        self.process.stdin.write(f"{NODE} {command}\n")
        self.process.stdin.flush()

    def end(self) -> None:
        self.process.kill()
        self.process.wait(timeout=PATIENCE)


def reset(check: Check, node: canopen.RemoteNode, command: int = 0x81) -> None:
    """Resets the node or its communication, and waits for its boot-up message, which is there before a program could begin to wait for it."""
    heard = Heard(node.network, 0x700 + NODE)
    node.nmt.send_command(command)
    check.that("boot-up message", heard.until(b"\0"), b"\0")
    node.network.unsubscribe(0x700 + NODE, heard.hear)


def check_states(check: Check, node: canopen.RemoteNode) -> None:
    """Boot-up, heartbeat, and the commands of NMT."""
    reset(check, node)
    period = node.sdo.upload(0x1017, 0)
    node.sdo.download(0x1017, 0, (30).to_bytes(2, "little"))
    heard = Heard(node.network, 0x700 + NODE)
    for command, state in (("OPERATIONAL", 5), ("STOPPED", 4), ("PRE-OPERATIONAL", 127)):
        node.nmt.state = command
        # Heartbeats from before the command may be on their way; after the first one of the state is no other.
        check.that(f"state {state}", (heard.until(bytes([state])), heard.next()), (bytes([state]), bytes([state])))
        check.that(f"state {state} as the client shows it", node.nmt._state, state)
        if state == 4:
            check.that("SDO while stopped", is_silent(node), True)
    node.sdo.download(0x1017, 0, period)
    node.network.unsubscribe(0x700 + NODE, heard.hear)


def is_silent(node: canopen.RemoteNode) -> bool:
    """Whether a stopped node answers nothing: its first answer is for what it is asked when it is not stopped any more."""
    node.network.send_message(0x600 + NODE, upload_of(0x1001))
    node.nmt.send_command(0x80)
    node.network.send_message(0x600 + NODE, upload_of(0x1000))
    return node.sdo.read_response()[1:4] == upload_of(0x1000)[1:4]


def upload_of(index: int) -> bytes:
    """The frame that asks for an entry with sub-index 0."""
    return b"\x40" + index.to_bytes(2, "little") + bytes(5)


def check_blocks(check: Check, node: canopen.RemoteNode, device: dict) -> None:
    """A text, in segments and in a block; a number in a block."""
    found = [
        (int(one["index"], 16), entry["sub"])
        for one in device["objects"]
        for entry in one["entries"]
        if entry["type"] == "visible-string" and entry["access"] != "wo"
    ]
    for index, sub in [(0x1000, 0), *found[:3]]:
        whole = node.sdo.upload(index, sub)
        with node.sdo.open(index, sub, "rb", block_transfer=True) as stream:
            check.that(f"{index:04X}h.{sub} in a block", stream.read(), whole)


def stored_entry(device: dict) -> tuple[int, int, str, int] | None:
    """A stored number that can be changed: index, sub-index, type, and another value than its default."""
    for one in device["objects"]:
        for entry in one["entries"]:
            default = entry["default"]
            if entry["stored"] != "application" or entry["access"] != "rw" or entry["locked"] or "alias" in entry:
                continue
            if not default or "raw" not in default or "writable-when" in entry or "named-type" in entry:
                continue
            other = int(default["raw"]) - 1
            low = entry.get("min", entry["low"])
            if low is None or other >= int(low):
                return int(one["index"], 16), entry["sub"], entry["type"], other
    return None


def check_reset(check: Check, node: canopen.RemoteNode, device: dict) -> None:
    """A reset takes back what was not stored."""
    if (found := stored_entry(device)) is None:
        return
    index, sub, kind, other = found
    before = node.sdo.upload(index, sub)
    after = other.to_bytes(len(before), "little", signed=kind.startswith("integer"))
    node.sdo.download(index, sub, after)
    period = node.sdo.upload(0x1017, 0)
    node.sdo.download(0x1017, 0, b"\x39\x05")
    reset(check, node, 0x82)
    check.that("1017h after a reset of communication", node.sdo.upload(0x1017, 0), period)
    check.that(f"{index:04X}h.{sub} after a reset of communication", node.sdo.upload(index, sub), after)
    reset(check, node)
    check.that(f"{index:04X}h.{sub} after a reset", node.sdo.upload(index, sub), before)
    node.sdo.download(index, sub, after)
    check.that("a wrong signature", code_of(node.sdo.download, 0x1010, 3, b"evas"), NOT_STORED)
    check.that("store parameters", code_of(node.sdo.download, 0x1010, 3, SAVE), None)
    reset(check, node)
    check.that(f"{index:04X}h.{sub} stored", node.sdo.upload(index, sub), after)
    check.that("restore defaults", code_of(node.sdo.download, 0x1011, 3, b"load"), None)
    check.that(f"{index:04X}h.{sub} until the reset", node.sdo.upload(index, sub), after)
    reset(check, node)
    check.that(f"{index:04X}h.{sub} restored", node.sdo.upload(index, sub), before)


def check_second(check: Check, served: Served, node: canopen.RemoteNode) -> None:
    """Another client sees what this one sends, and what the node answers; it guards the node."""
    # The end of a block has no answer, and what another client sends could overtake it.
    settle(node)
    with served.bus() as other:
        # An answer to the second client says that it is there; the first one gets it, too.
        other.send(can.Message(arbitration_id=0x600 + NODE, data=upload_of(0x1000), is_extended_id=False))
        seen_until(other, 0x580 + NODE)
        node.sdo.read_response()
        node.sdo.download(0x1017, 0, b"\0\0")
        check.that("what a second client sees", seen_until(other, 0x580 + NODE)[-2:], [0x600 + NODE, 0x580 + NODE])
        for toggle in (0, 0x80, 0):
            other.send(can.Message(arbitration_id=0x700 + NODE, is_remote_frame=True, dlc=1, is_extended_id=False))
            answer = other.recv(PATIENCE)
            check.that("node guarding", bytes(answer.data) if answer else None, bytes([toggle | 127]))


def seen_until(bus: can.BusABC, identifier: int) -> list[int]:
    """The identifiers on a bus up to one."""
    seen: list[int] = []
    while seen[-1:] != [identifier] and (message := bus.recv(PATIENCE)) is not None:
        seen.append(message.arbitration_id)
    return seen


def check_device(served: Reached, eds: Path, device: dict, types: list[dict]) -> Check:
    check = begin(device, types)
    network = canopen.Network(served.bus())
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        node = canopen.RemoteNode(NODE, str(eds))
        network.add_node(node)
        check_states(check, node)
        reset(check, node)
        check_dictionary(check, node, device)
        reset(check, node)
        check_blocks(check, node, device)
        if served.is_shared:
            check_second(check, served, node)
            reset(check, node)
        check_reset(check, node, device)
    finally:
        network.disconnect()
        served.end()
    return check


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("--spec", type=Path, required=True)
    parser.add_argument("--eds-dir", type=Path, required=True)
    parser.add_argument("--dump", type=Path, required=True)
    options = parser.parse_args()
    dump = json.loads(options.dump.read_text(encoding="utf-8"))
    failed = 0
    for device in dump["devices"]:
        eds = options.eds_dir / f"{device['key']}.eds"
        started = time.monotonic()
        served = Served(options.odgen, options.spec, device["key"])
        check = check_device(served, eds, device, dump["types"])
        failed += bool(check.failures) or check.done < 500
        for failure in check.failures[:20]:
            print(f"  {failure}")
        verdict = "ok" if not check.failures else f"{len(check.failures)} differences"
        seconds = time.monotonic() - started
        print(f"python-canopen as master, {device['key']}: {check.done} checks, {verdict}, {seconds:.1f} s")
    devices = len(dump["devices"])
    print(f"{devices - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
