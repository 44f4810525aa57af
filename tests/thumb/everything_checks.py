"""What demo.py checks of the device with everything: what the shipped ones have not."""

from __future__ import annotations

from pathlib import Path

import canopen

from demo_checks import client, in_time, operational
from patience import Heard, settle
from sdo_client import LOCKED, NO_DATA, NODE, READ_ONLY, TOO_LONG, WRITE_ONLY, Check, code_of
from sdo_client import read_in_blocks, write_in_blocks, write_in_segments
from virtual_node import reset
from virtual_pdo import remap

OUT_OF_MEMORY = 0x05040005
DOMAIN, LARGEST = (0x2018, 0), 2048
# Index, sub-index, bytes that it has room for.
STRINGS = [(0x2013, 0, 20), (0x2014, 0, 6), (0x2015, 0, 24), (0x1023, 1, 32)]
# Index, and bytes of the number.
NUMBERS = [(0x2003, 3), (0x2005, 5), (0x2006, 6), (0x2007, 7), (0x2008, 8), (0x200B, 3), (0x200D, 5), (0x200E, 6), (0x200F, 7), (0x2010, 8)]
NUMBERS += [(0x2011, 4), (0x2012, 8)]
WAYS = {"": lambda sdo, *a: sdo.download(*a), " in segments": write_in_segments, " in blocks": write_in_blocks}


def check_everything(address: str, eds: Path) -> Check:
    with client(address, eds) as (check, network, node):
        check_data(check, node)
        check_domain(check, node)
        check_access(check, node)
        check_sync(check, network, node)
        check_event_timer(check, network, node)
        check_watched(check, network, node)
        reset(check, node)
        check_lss(check, network)
    return check


def check_way(check: Check, node: canopen.RemoteNode, at: tuple[int, int], data: bytes, expected: int | None = None) -> None:
    """Writes data each way, and reads it back each way."""
    for way, write in WAYS.items():
        where = f"{at[0]:04X}h.{at[1]}, {len(data)} bytes{way}"
        check.that(where, code_of(write, node.sdo, *at, data), expected)
        if expected is None:
            check.that(f"{where}, read", code_of(node.sdo.upload, *at), data)
            check.that(f"{where}, read in blocks", code_of(read_in_blocks, node.sdo, *at), data)


def check_data(check: Check, node: canopen.RemoteNode) -> None:
    """Strings of lengths around those of frames, and one more than there is room for; numbers of every size."""
    for index, sub, room in STRINGS:
        size = 2 if index == 0x2015 else 1
        for length in sorted({size, 4, 6, 8, 14, room}.intersection(range(size, room + 1, size))):
            check_way(check, node, (index, sub), bytes(0x41 + at % 26 if at % size == 0 else 0 for at in range(length)))
        check_way(check, node, (index, sub), b"A" * (room + size), TOO_LONG)
    for index, size in NUMBERS:
        for data in (bytes(range(1, size + 1)), b"\xff" * size, bytes(size)):
            check_way(check, node, (index, 0), data)
        check_way(check, node, (index, 0), bytes(size + 1), TOO_LONG)
    for index, text in ((0x1008, b"Everything"), (0x100A, b"v2.0 beta")):
        check.that(f"{index:04X}h in segments", node.sdo.upload(index, 0), text)
        check.that(f"{index:04X}h in blocks", read_in_blocks(node.sdo, index, 0), text)


def check_domain(check: Check, node: canopen.RemoteNode) -> None:
    """A DOMAIN: nothing, then lengths around those of segments, of blocks and of its memory."""
    check.that("an empty DOMAIN", code_of(node.sdo.upload, *DOMAIN), NO_DATA)
    for length in (1, 5, 7, 8, 889, 890, LARGEST):
        check_way(check, node, DOMAIN, bytes((at * 7 + length) % 251 for at in range(length)))
    for way, write in WAYS.items():
        check.that(f"a DOMAIN that is too long{way}", code_of(write, node.sdo, *DOMAIN, bytes(LARGEST + 1)), OUT_OF_MEMORY)
    check.that("a DOMAIN after that", code_of(node.sdo.upload, *DOMAIN), NO_DATA)


def check_access(check: Check, node: canopen.RemoteNode) -> None:
    check.that("write-only", code_of(node.sdo.upload, 0x200A, 0), WRITE_ONLY)
    check.that("read-only DOMAIN", code_of(node.sdo.download, 0x1021, 0, bytes(20)), READ_ONLY)
    check.that("locked number", code_of(node.sdo.download, 0x201D, 5, bytes(4)), LOCKED)
    check.that("locked DOMAIN", code_of(node.sdo.download, 0x201D, 254, bytes(20)), LOCKED)
    check.that("constant string", code_of(node.sdo.download, 0x1009, 0, b"2.00"), READ_ONLY)


def check_sync(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """A TPDO with every second SYNC, and an RPDO that waits for it."""
    node.nmt.state = "PRE-OPERATIONAL"
    remap(node.tpdo[2], [(0x2010, 0, 64, False)], 0x280 + NODE, 2)
    remap(node.rpdo[2], [(0x2002, 0, 16, True), (0x2019, 0, 8, True)], 0x300 + NODE, 1)
    value = bytes(range(1, 9))
    node.sdo.download(0x2010, 0, value)
    start = node.sdo.upload(0x1801, 6)[0]
    heard = Heard(network, 0x280 + NODE)
    operational(node)
    for counter, expected in ((start - 1, []), (start, []), (start + 1, [value]), (start + 2, []), (start + 3, [value])):
        network.sync.transmit(counter)
        settle(node)
        check.that(f"SYNC {counter}", heard.now(), expected)
    before = node.sdo.upload(0x2002, 0)
    network.send_message(0x300 + NODE, b"\x34\x12\x01")
    check.that("before the SYNC", node.sdo.upload(0x2002, 0), before)
    network.sync.transmit(start + 4)
    check.that("after the SYNC", (node.sdo.upload(0x2002, 0), node.sdo.upload(0x2019, 0)), (b"\x34\x12", b"\x01"))
    node.nmt.state = "PRE-OPERATIONAL"


def check_event_timer(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """A TPDO again and again by its event timer, and a remote frame for one."""
    node.sdo.download(0x1800, 1, (0xC000_0180 + NODE).to_bytes(4, "little"))
    node.sdo.download(0x1800, 5, (100).to_bytes(2, "little"))
    node.sdo.download(0x1800, 1, (0x4000_0180 + NODE).to_bytes(4, "little"))
    heard = Heard(network, 0x180 + NODE)

    def restart() -> None:
        node.nmt.state = "PRE-OPERATIONAL"
        settle(node)
        heard.now()
        operational(node)

    frames = in_time(node, restart, heard, 6, 0.4, 2)
    expected = node.sdo.upload(0x2004, 0) + node.sdo.upload(0x200C, 0)
    check.that("6 TPDOs of the event timer of 100 ms", frames, [expected] * 6)
    asked = Heard(network, 0x380 + NODE)
    network.send_message(0x380 + NODE, b"", remote=True)
    answer = asked.next()
    check.that("a remote frame", answer and answer[:4], node.sdo.upload(0x2011, 0))
    node.nmt.state = "PRE-OPERATIONAL"


def check_watched(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """A node whose heartbeat stays away: an emergency, another state, and the end of it."""
    operational(node)
    heard = Heard(network, 0x80 + NODE)
    node.sdo.download(0x1016, 1, (9 << 16 | 100).to_bytes(4, "little"))
    network.send_message(0x709, b"\x05")
    check.that("an emergency", (heard.next() or b"")[:4], b"\x30\x81\x11\x09")
    states = Heard(network, 0x700 + NODE)
    network.send_message(0x700 + NODE, b"\0", remote=True)
    check.that("state after it", (states.next() or b"\0")[0] & 0x7F, 127)
    network.send_message(0x709, b"\x05")
    check.that("the end of it", heard.next(), bytes(8))
    node.sdo.download(0x1016, 1, bytes(4))


def check_lss(check: Check, network: canopen.Network) -> None:
    """LSS: who is there, and another node-ID, there and back."""
    lss = network.lss
    for old, new in ((NODE, NODE + 1), (NODE + 1, NODE)):
        lss.send_switch_state_global(lss.CONFIGURATION_STATE)
        check.that("node-ID", lss.inquire_node_id(), old)
        check.that("vendor", lss.inquire_lss_address(0x5A), 0xABC)
        check.that("product", lss.inquire_lss_address(0x5B), 0x12345678)
        check.that("a node-ID that there is not", lss_refuses(lss, 200), True)
        lss.configure_node_id(new)
        lss.store_configuration()
        lss.send_switch_state_global(lss.WAITING_STATE)
        boot = Heard(network, 0x700 + new)
        network.send_message(0, bytes([0x82, old]))
        check.that(f"boot-up of {new}", boot.next(), b"\0")
    check.that("chosen by its identity", lss.send_switch_state_selective(0xABC, 0x12345678, 0x00010002, 0), True)
    lss.send_switch_state_global(lss.WAITING_STATE)


def lss_refuses(lss, node: int) -> bool:
    try:
        lss.configure_node_id(node)
    except canopen.lss.LssError:
        return True
    return False
