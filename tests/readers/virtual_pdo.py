#!/usr/bin/env python3
"""Exchange PDOs with virtual nodes: python-canopen against `odgen serve`, over SLCAN and TCP.

    virtual_pdo.py --odgen target/debug/odgen od-spec/devices/pitch-control-system.od.yaml

Each device is served as node 5, and known to the client by its EDS alone. The client maps entries into the first PDOs by the
procedure of CiA 301, receives what the device itself sets, after an event and after SYNC, sends what it then reads by SDO, hears
emergencies, and asks LSS for the node-ID. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import can
import canopen

from patience import Heard, eventually, settle
from sdo_client import IN_USE, NODE, Check, code_of
from virtual_node import Served, reset

TRANSMIT, RECEIVE = 0x180 + NODE, 0x200 + NODE
BITS = {"8": 8, "16": 16, "32": 32}


def candidates(device: dict, types: dict[str, dict], direction: str) -> list[tuple[int, int, int, bool]]:
    """Entries that can be mapped and have a value of their own: index, sub-index, bits, whether it is signed. At most two, which fit into a PDO."""
    found = []
    for one in device["objects"]:
        index = int(one["index"], 16)
        for entry in one["entries"]:
            kind = entry["type"].removeprefix("unsigned").removeprefix("integer")
            if kind not in BITS or entry["pdo"] not in (direction, "both") or index < 0x2000:
                continue
            is_plain = not entry["locked"] and "writable-when" not in entry and "alias" not in entry
            is_enum = "values" in types.get(entry.get("named-type", ""), {})
            is_writable = direction == "transmit" or entry["access"] in ("rw", "wo", "rwr", "rww")
            limited = int(entry.get("min") or 0) > 20 or int(entry.get("max") or 100) < 100
            if is_plain and not is_enum and is_writable and not limited and entry["access"] != "const":
                found.append((index, entry["sub"], BITS[kind], entry["type"].startswith("integer")))
    return found[:2]


def remap(pdo: canopen.pdo.PdoMap, entries: list[tuple[int, int, int, bool]], cob_id: int, transmission: int) -> None:
    """Maps entries by the procedure of CiA 301: switch off, no entries, the entries, their number, switch on."""
    pdo.read()
    pdo.clear()
    for index, sub, *_ in entries:
        pdo.add_variable(index, sub)
    pdo.cob_id, pdo.trans_type, pdo.enabled = cob_id, transmission, True
    pdo.event_timer = None if pdo.event_timer is None else 0
    pdo.inhibit_time = None if pdo.inhibit_time is None else 0
    pdo.save()


def packed(entries: list[tuple[int, int, int, bool]], values: list[int]) -> bytes:
    return b"".join(v.to_bytes(e[2] // 8, "little", signed=e[3]) for e, v in zip(entries, values, strict=True))


def check_transmit(check: Check, served: Served, network: canopen.Network, node: canopen.RemoteNode, entries: list) -> None:
    """An event-driven TPDO, and one by SYNC where the device follows it."""
    remap(node.tpdo[1], entries, TRANSMIT, 255)
    check.that("mapping while the PDO is valid", code_of(node.sdo.download, 0x1A00, 0, b"\0"), IN_USE)
    heard = Heard(network, TRANSMIT)
    index, sub, *_ = entries[0]
    served.say(f"set {index:04X}.{sub}=11")
    # Standard input and the bus do not wait for each other; answers say what the node has done.
    check.that("what is set before start", eventually(lambda: read_all(node, entries[:1]), [11]), [11])
    settle(node)
    check.that("TPDOs before start", heard.now(), [])
    node.nmt.state = "OPERATIONAL"
    settle(node)
    values = [11] + [3 + at for at in range(1, len(entries))]
    for (index, sub, *_), value in list(zip(entries, values, strict=True))[1:]:
        served.say(f"set {index:04X}.{sub}={value}")
    if len(entries) == 1:
        values = [12]
        served.say(f"set {index:04X}.{sub}=12")
    check.that("the TPDO of an event", heard.until(packed(entries, values)), packed(entries, values))
    check.that("what it reports by SDO", read_all(node, entries), values)
    settle(node)
    check.that("TPDOs of other values after it", set(heard.now()) - {packed(entries, values)}, set())
    node.nmt.state = "PRE-OPERATIONAL"
    if code_of(node.sdo.upload, 0x1005, 0) == 0x06020000:
        return
    remap(node.tpdo[2], entries, TRANSMIT + 0x100, 2)
    node.tpdo[1].enabled = False
    node.tpdo[1].save()
    by_sync = Heard(network, TRANSMIT + 0x100)
    node.nmt.state = "OPERATIONAL"
    has_counter = node.sdo.upload(0x1019, 0) != b"\0"
    start = node.sdo.upload(0x1801, 6)[0] if has_counter else None
    for counter in (start - 1, start) if has_counter else (None,):
        network.sync.transmit(counter)
    settle(node)
    check.that("the first SYNC of two", by_sync.now(), [])
    network.sync.transmit(start + 1 if has_counter else None)
    check.that("the second SYNC", by_sync.next(), packed(entries, values))
    node.nmt.state = "PRE-OPERATIONAL"


def read_all(node: canopen.RemoteNode, entries: list) -> list[int]:
    return [int.from_bytes(node.sdo.upload(index, sub), "little") for index, sub, *_ in entries]


def check_receive(check: Check, node: canopen.RemoteNode, entries: list) -> None:
    """An RPDO takes effect while the node is operational, and not before."""
    remap(node.rpdo[1], entries, RECEIVE, 255)
    before = [node.sdo.upload(index, sub) for index, sub, *_ in entries]
    values = [5 + at for at in range(len(entries))]
    for at, value in enumerate(values):
        node.rpdo[1][at].raw = value
    node.rpdo[1].transmit()
    check.that("an RPDO before start", [node.sdo.upload(e[0], e[1]) for e in entries], before)
    node.nmt.state = "OPERATIONAL"
    node.rpdo[1].transmit()
    read = b"".join(node.sdo.upload(index, sub) for index, sub, *_ in entries)
    check.that("what an RPDO has written", read, packed(entries, values))
    node.nmt.state = "PRE-OPERATIONAL"


def check_emergencies(check: Check, served: Served, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """An error occurs and goes."""
    heard = Heard(network, 0x80 + NODE)
    served.say("fault 0x4210")
    check.that("an emergency", heard.next(), b"\x10\x42\x09\0\0\0\0\0")
    check.that("the client's list of errors", [error.code for error in node.emcy.active], [0x4210])
    check.that("the error register", node.sdo.upload(0x1001, 0), b"\x09")
    newest = code_of(node.sdo.upload, 0x1003, 1)
    check.that("the newest error", newest, 0x06020000 if 0x1003 not in node.object_dictionary else b"\x10\x42\0\0")
    served.say("nonsense")
    served.say("clear 0x4210")
    check.that("the end of an emergency", heard.next(), bytes(8))
    check.that("the error register then", node.sdo.upload(0x1001, 0), b"\0")


def check_lss(check: Check, network: canopen.Network, node: canopen.RemoteNode, device: dict) -> None:
    """A device with LSS reports its node-ID, and one without says nothing."""
    lss = network.lss
    lss.send_switch_state_global(lss.CONFIGURATION_STATE)
    if device["lss"]:
        check.that("LSS", lss.inquire_node_id(), NODE)
    else:
        heard = Heard(network, lss.LSS_RX_COBID)
        network.send_message(lss.LSS_TX_COBID, b"\x5e" + bytes(7))
        settle(node)
        check.that("LSS", heard.now(), [])
    lss.send_switch_state_global(lss.WAITING_STATE)


def check_device(odgen: str, spec: Path, eds: Path, device: dict, types: dict[str, dict]) -> Check:
    check = Check()
    served = Served(odgen, spec, device["key"], "--script", "-")
    network = canopen.Network(served.bus())
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.05)
        node = canopen.RemoteNode(NODE, str(eds))
        network.add_node(node)
        reset(check, node)
        check_lss(check, network, node, device)
        check_transmit(check, served, network, node, candidates(device, types, "transmit"))
        check_receive(check, node, candidates(device, types, "receive"))
        check_emergencies(check, served, network, node)
        reset(check, node)
    finally:
        network.disconnect()
        served.end()
    return check


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("specs", nargs="+", type=Path)
    options = parser.parse_args()
    failed = 0
    for spec in options.specs:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([options.odgen, "build", spec, "--out", folder], check=True, stdout=subprocess.DEVNULL)
            (dump,) = (json.loads(path.read_text(encoding="utf-8")) for path in Path(folder).glob("*.json"))
            types = {named["name"]: named for named in dump["types"]}
            for device in dump["devices"]:
                started = time.monotonic()
                check = check_device(options.odgen, spec, Path(folder) / "eds" / f"{device['key']}.eds", device, types)
                failed += bool(check.failures) or check.done < 13
                for failure in check.failures:
                    print(f"  {failure}")
                verdict = "ok" if not check.failures else f"{len(check.failures)} differences"
                print(f"PDOs of {device['key']}: {check.done} checks, {verdict}, {time.monotonic() - started:.1f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
