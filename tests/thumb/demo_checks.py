"""What demo.py checks of the demo firmware, in addition to what it shares with virtual nodes."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import can
import canopen

from patience import Heard, eventually, settle
from sdo_client import IN_USE, LOCKED, NODE, NOT_STORED, Check, code_of
from virtual_node import Reached, reset
from virtual_pdo import candidates, check_lss, check_receive, remap

TOO_SHORT, TOO_HIGH, TOO_LOW, NOT_A_VALUE, NOT_MAPPABLE, TOO_MUCH = 0x06070013, 0x06090031, 0x06090032, 0x06090030, 0x06040041, 0x06040042
SIZES = {"integer8": 1, "unsigned8": 1, "integer16": 2, "unsigned16": 2, "integer32": 4, "unsigned32": 4}
CONTROLWORD, STATUSWORD, POSITION, TARGET = 0x6040, 0x6041, 0x6064, 0x607A
UNDER_VOLTAGE = 0x3220
READ_DEVICE_TYPE, DEVICE_TYPE = b"t60584000100000000000\r", b"t58584300100092010200\r"


@contextmanager
def client(address: str, eds: Path):
    """A client of the node: its check, the network, the node."""
    network = canopen.Network(Reached(address).bus())
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.05)
        node = canopen.RemoteNode(NODE, str(eds))
        network.add_node(node)
        check = Check()
        reset(check, node)
        yield check, network, node
    finally:
        network.disconnect()


def check_text(connection: socket.socket) -> Check:
    """The lines of SLCAN, also those that are not lines."""
    check = Check()

    def expect(what: str, said: bytes, answer: bytes) -> None:
        connection.sendall(said)
        got = b""
        while len(got) < len(answer) and (more := connection.recv(4096)):
            got += more
        check.that(what, got, answer)

    with connection:
        expect("an empty line", b"\r", b"\r")
        expect("close", b"C\r", b"\r")
        expect("a frame while closed", READ_DEVICE_TYPE, b"\x07")
        expect("a bit rate", b"S6\r", b"\r")
        expect("a bit rate that there is not", b"S9\r", b"\x07")
        expect("version", b"V\r", b"V1010\r")
        expect("serial number", b"N\r", b"NDEMO\r")
        expect("open", b"O\r", b"\r")
        expect("a bit rate while open", b"S6\r", b"\x07")
        expect("a frame", READ_DEVICE_TYPE, b"z\r" + DEVICE_TYPE)
        expect("small letters", b"t6058409a600000000000\r", b"z\rt5858809A600000000206\r")
        expect("a remote frame", b"r7050\r", b"z\rt70517F\r")
        for line in (b"t60", b"t6051", b"t6059000000000000000000", b"t8000", b"t605140x", b"t605g40", b"r70511F", b"T000006051F", b"x"):
            expect(f"{line!r}", line + b"\r", b"\x07")
        expect("a line that does not end", b"t" * 1000 + b"\r", b"\x07")
        expect("bytes that are no text", bytes(range(14, 256)) + b"\r", b"\x07")
        many = 200
        expect("more than is read", READ_DEVICE_TYPE * many, (b"z\r" + DEVICE_TYPE) * many)
        expect("close again", b"C\r", b"\r")
    return check


def check_writes(address: str, eds: Path, device: dict, types: list[dict]) -> Check:
    """Every number that can be written: a byte too few, its limits, what is beyond them, and values that an enum has not."""
    named = {one["name"]: one for one in types}
    with client(address, eds) as (check, _, node):
        for one in device["objects"]:
            index = int(one["index"], 16)
            for entry in one["entries"]:
                is_plain = not entry["locked"] and "writable-when" not in entry and entry["access"] == "rw"
                # The state machine has its own test, and mapping parameters and COB-IDs their own rules.
                if index < 0x2000 or index == CONTROLWORD or not is_plain or entry["type"] not in SIZES:
                    continue
                check_number(check, node, index, entry, named.get(entry.get("named-type", ""), {}))
        reset(check, node)
    return check


def check_number(check: Check, node: canopen.RemoteNode, index: int, entry: dict, named: dict) -> None:
    sub, size, is_signed = entry["sub"], SIZES[entry["type"]], entry["type"].startswith("integer")
    where = f"{index:04X}h.{sub}"
    before = node.sdo.upload(index, sub)

    def write(value: int) -> int | None:
        return code_of(node.sdo.download, index, sub, value.to_bytes(size, "little", signed=is_signed))

    if size > 1:
        check.that(f"{where} written too short", code_of(node.sdo.download, index, sub, before[:-1]), TOO_SHORT)
    lowest, highest = (-(1 << 8 * size - 1), (1 << 8 * size - 1) - 1) if is_signed else (0, (1 << 8 * size) - 1)
    low, high = entry.get("min", entry["low"]), entry.get("max", entry["high"])
    low, high = (None if limit is None else int(limit) for limit in (low, high))
    special = [int(one["value"]) for one in entry.get("special", [])]
    if "values" in named:
        values = {int(one["value"]) for one in named["values"] if one.get("supported", True)}
        for value in (lowest, highest, min(values) - 1, max(values) + 1):
            if lowest <= value <= highest and value not in values:
                check.that(f"{where} = {value}", write(value), NOT_A_VALUE)
        for value in sorted(values):
            check_value(check, node, where, (index, sub), write, value, size, is_signed)
    else:
        if high is not None and high < highest and high + 1 not in special:
            check.that(f"{where} = {high + 1}", write(high + 1), TOO_HIGH)
        if low is not None and low > lowest and low - 1 not in special:
            check.that(f"{where} = {low - 1}", write(low - 1), TOO_LOW)
        for value in (lowest if low is None else low, highest if high is None else high):
            check_value(check, node, where, (index, sub), write, value, size, is_signed)
    check.that(f"{where} as before", code_of(node.sdo.download, index, sub, before), None)


def check_value(check: Check, node, where: str, at: tuple[int, int], write, value: int, size: int, is_signed: bool) -> None:
    check.that(f"{where} = {value}", write(value), None)
    check.that(f"{where} read", node.sdo.upload(*at), value.to_bytes(size, "little", signed=is_signed))


def check_axis(address: str, eds: Path, device: dict, types: list[dict]) -> Check:
    """PDOs, states, emergencies: what happens by itself."""
    named = {one["name"]: one for one in types}
    with client(address, eds) as (check, network, node):
        check_lss(check, network, node, device)
        check_receive(check, node, candidates(device, named, "receive"))
        reset(check, node)
        check_states(check, network, node)
        check_motion(check, network, node)
        check_mapping(check, node)
        check_fault(check, network, node)
        reset(check, node)
    return check


def written(node: canopen.RemoteNode, index: int, sub: int, value: int, size: int) -> int | None:
    return code_of(node.sdo.download, index, sub, value.to_bytes(size, "little"))


def number(node: canopen.RemoteNode, index: int, sub: int = 0) -> int:
    return int.from_bytes(node.sdo.upload(index, sub), "little", signed=True)


def go_by(node: canopen.RemoteNode, network: canopen.Network, steps: int) -> None:
    """Lets so many of the drive's steps of 10 ms go by, by the clock of the node: heartbeats are one step apart."""
    heard = Heard(network, 0x700 + NODE)
    node.sdo.download(0x1017, 0, (10).to_bytes(2, "little"))
    for _ in range(steps + 1):
        heard.next()
    node.sdo.download(0x1017, 0, b"\0\0")
    network.unsubscribe(0x700 + NODE, heard.hear)


def operational(node: canopen.RemoteNode) -> None:
    node.nmt.state = "OPERATIONAL"
    node.sdo.upload(0x1000, 0)


def check_states(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """Heartbeat in its time, guarding, commands for others and for all."""
    heard = Heard(network, 0x700 + NODE)
    for toggle in (0, 0x80, 0):
        network.send_message(0x700 + NODE, b"\0", remote=True)
        check.that("node guarding", heard.next(), bytes([toggle | 127]))
    operational(node)
    heartbeats = in_time(node, lambda: node.sdo.download(0x1017, 0, (50).to_bytes(2, "little")), heard, 20, 0.9, 3)
    check.that("20 heartbeats of 50 ms", heartbeats, [b"\x05"] * 20)
    node.sdo.download(0x1017, 0, b"\0\0")
    heard.now()
    for target, command, state in ((NODE + 1, 2, 5), (0, 2, 4), (0, 1, 5), (0, 128, 127)):
        network.send_message(0, bytes([command, target]))
        network.send_message(0x700 + NODE, b"\0", remote=True)
        check.that(f"command {command} for {target}", (heard.next() or b"\0")[0] & 0x7F, state)


def in_time(node: canopen.RemoteNode, begin: Callable[[], object], heard: Heard, count: int, least: float, most: float) -> list[bytes | None]:
    """So many frames of a node, which come within a time from their beginning. On a busy machine they come late, but in one of some attempts they
    do not; too early they never come."""
    seconds = 0.0
    for _ in range(20):
        settle(node)
        heard.now()
        began = time.monotonic()
        begin()
        frames = [heard.next() for _ in range(count)]
        seconds = time.monotonic() - began
        if seconds < most or None in frames:
            break
    return frames if least < seconds < most else [*frames, f"in {seconds:.2f} s".encode()]


def check_motion(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """The state machine by the PDOs of the factory, then an axis that follows its target, with PDOs mapped anew."""
    status = Heard(network, 0x180 + NODE)
    check.that("mode", written(node, 0x6060, 0, 1, 1), None)
    check.that("mode shown", node.sdo.upload(0x6061, 0), b"\x01")
    operational(node)
    for word, state in ((0x06, 0x21), (0x07, 0x23), (0x10F, 0x27)):
        network.send_message(0x200 + NODE, word.to_bytes(2, "little"))
        frame = status.next()
        check.that(f"statusword after {word:X}", frame and int.from_bytes(frame, "little") & 0x6F, state)
    check.that("mode while enabled", written(node, 0x6060, 0, 3, 1), LOCKED)
    node.nmt.state = "PRE-OPERATIONAL"
    # Index, sub-index, bits, whether it is signed.
    remap(node.tpdo[2], [(POSITION, 0, 32, True), (0x606C, 0, 32, True)], 0x280 + NODE, 255)
    remap(node.rpdo[2], [(TARGET, 0, 32, True), (CONTROLWORD, 0, 16, False)], 0x300 + NODE, 255)
    check.that("a limit", written(node, 0x607D, 2, 3000, 4), None)
    check.that("a velocity", written(node, 0x6081, 0, 5000, 4), None)
    heard = Heard(network, 0x280 + NODE)

    def go(target: int, word: int) -> None:
        network.send_message(0x300 + NODE, target.to_bytes(4, "little", signed=True) + word.to_bytes(2, "little"))

    def travel(target: int) -> list[tuple[int, int]]:
        """What the TPDO shows, until the target is reached: positions and velocities."""
        shown: list[tuple[int, int]] = []
        while (not shown or shown[-1][0] != target) and (frame := heard.next()):
            shown.append(tuple(int.from_bytes(part, "little", signed=True) for part in (frame[:4], frame[4:])))
        return shown

    operational(node)
    for asked, reached in ((1000, 1000), (50_000, 3000), (500, 500)):
        start = number(node, POSITION)
        heard.now()
        go(asked, 0x0F)
        go(asked, 0x1F)
        shown = travel(reached)
        positions = [position for position, _ in shown]
        check.that(f"the way to {asked}", positions[-1:], [reached])
        check.that("there and not back", positions, sorted(positions, reverse=reached < start))
        check.that("more than once", len(positions) > 4, True)
        # The last one may be reported together with the standstill.
        check.that("velocity", {velocity for _, velocity in shown[:-1]}, {5000 if reached > start else -5000})
        check.that("standstill", eventually(lambda: number(node, 0x606C), 0), 0)
        check.that("position by SDO", (number(node, POSITION), number(node, 0x5064)), (reached, reached))
        check.that("target reached", number(node, STATUSWORD) >> 10 & 1, 1)
    # So slow that it is not there before it is halted.
    check.that("a low velocity", written(node, 0x6081, 0, 100, 4), None)
    heard.now()
    go(3000, 0x0F)
    go(3000, 0x1F)
    heard.next()
    go(3000, 0x11F)
    check.that("standstill after halt", eventually(lambda: number(node, 0x606C), 0), 0)
    halted = number(node, POSITION)
    check.that("halt", (500 < halted < 3000, number(node, STATUSWORD) >> 10 & 1), (True, 0))
    check.that("a velocity again", written(node, 0x6081, 0, 5000, 4), None)
    go_by(node, network, 5)
    check.that("halt goes on", number(node, POSITION), halted)
    heard.now()
    go(3000, 0x1F)
    shown = travel(3000)
    check.that("halt ends", ([position for position, _ in shown[-1:]], {velocity for _, velocity in shown[:-1]}), ([3000], {5000}))
    # Too short: nothing takes effect, and the node says so.
    emergencies = Heard(network, 0x80 + NODE)
    network.send_message(0x300 + NODE, b"\0")
    check.that("an RPDO that is too short", (emergencies.next() or b"")[:2], b"\x10\x82")
    check.that("target after it", number(node, TARGET), 3000)
    network.send_message(0x200 + NODE, b"\0\0")
    check.that("voltage off", eventually(lambda: number(node, STATUSWORD) & 0x4F, 0x40), 0x40)
    node.nmt.state = "PRE-OPERATIONAL"


def check_mapping(check: Check, node: canopen.RemoteNode) -> None:
    """What a mapping is refused for."""
    check.that("mapping of a valid PDO", written(node, 0x1A00, 0, 0, 1), IN_USE)
    node.sdo.download(0x1A02, 0, b"\0")
    for entry, code in ((0x10000020, NOT_MAPPABLE), (0x607A0020, NOT_MAPPABLE), (0x60640010, NOT_MAPPABLE), (0x5FFF0020, 0x06020000)):
        check.that(f"mapping {entry:08X}h", written(node, 0x1A02, 1, entry, 4), code)
    for sub in (1, 2, 3):
        check.that(f"mapping {sub}", written(node, 0x1A02, sub, 0x60640020, 4), None)
    check.that("96 bits", written(node, 0x1A02, 0, 3, 1), TOO_MUCH)
    check.that("64 bits", written(node, 0x1A02, 0, 2, 1), None)


def check_fault(check: Check, network: canopen.Network, node: canopen.RemoteNode) -> None:
    """A fault with its cause: reported, shown, kept until the cause is gone and it is acknowledged."""
    heard = Heard(network, 0x80 + NODE)
    status = number(node, STATUSWORD)
    check.that("no fault", status & 0x08, 0)
    node.emcy.reset()
    check.that("a voltage that is not there", written(node, 0x6510, 4, 600, 2), None)
    check.that("an emergency", heard.next(), b"\x20\x32\x05\0\0\0\0\0")
    check.that("the client's list of errors", [error.code for error in node.emcy.active], [UNDER_VOLTAGE])
    check.that("its words", "oltage" in node.emcy.active[0].get_desc(), True)
    check.that("error register", node.sdo.upload(0x1001, 0), b"\x05")
    check.that("error history", (node.sdo.upload(0x1003, 0), node.sdo.upload(0x1003, 1)), (b"\x01", b"\x20\x32\0\0"))
    check.that("time of the error", number(node, 0x2030, 1) > 0, True)
    check.that("error code", number(node, 0x603F), UNDER_VOLTAGE)
    check.that("statusword", number(node, STATUSWORD) & 0x4F, 0x08)
    for word in (0, 0x80):
        node.sdo.download(CONTROLWORD, 0, word.to_bytes(2, "little"))
    go_by(node, network, 5)
    check.that("acknowledged too soon", number(node, STATUSWORD) & 0x4F, 0x08)
    check.that("a voltage that is there", written(node, 0x6510, 4, 100, 2), None)
    check.that("still a fault", number(node, STATUSWORD) & 0x4F, 0x08)
    for word in (0, 0x80):
        node.sdo.download(CONTROLWORD, 0, word.to_bytes(2, "little"))
    check.that("the end of the emergency", heard.next(), bytes(8))
    check.that("no errors are left", [error.code for error in node.emcy.active], [])
    check.that("error register then", node.sdo.upload(0x1001, 0), b"\0")
    check.that("statusword then", number(node, STATUSWORD) & 0x4F, 0x40)
    check.that("error code then", number(node, 0x603F), 0)
    check.that("history remains", node.sdo.upload(0x1003, 1), b"\x20\x32\0\0")
    check.that("history cleared", written(node, 0x1003, 0, 0, 1), None)
    check.that("history is empty", code_of(node.sdo.upload, 0x1003, 1), 0x08000024)


def check_storage(address: str, eds: Path) -> Check:
    """Stored by group, restored by group, over both resets."""
    transmission, window, factory = (0x1802, 2), (0x6065, 0), (b"\xff", (100).to_bytes(4, "little"))
    other = (b"\x05", (123).to_bytes(4, "little"))
    with client(address, eds) as (check, _, node):

        def values() -> tuple[bytes, bytes]:
            return node.sdo.upload(*transmission), node.sdo.upload(*window)

        def change() -> None:
            for at, value in zip((transmission, window), other, strict=True):
                check.that(f"{at[0]:04X}h changed", code_of(node.sdo.download, *at, value), None)

        check.that("1010h", [number(node, 0x1010, sub) for sub in range(1, 5)], [1, 1, 1, 0])
        check.that("1011h", [code_of(node.sdo.download, 0x1011, sub, b"save") for sub in (1, 2, 3, 4)], [NOT_STORED] * 4)
        check.that("1010h refuses", [code_of(node.sdo.download, 0x1010, sub, b"load") for sub in (1, 2, 3, 4)], [NOT_STORED] * 4)
        steps = [
            ("nothing stored", [], 0x81, factory),
            ("communication stored", [(0x1010, 2)], 0x81, (other[0], factory[1])),
            ("application stored, too", [(0x1010, 3)], 0x81, other),
            ("communication restored", [(0x1011, 2)], 0x81, (factory[0], other[1])),
            ("all stored", [(0x1010, 1)], 0x81, other),
            ("reset of communication", [(0x1011, 1)], 0x82, (factory[0], other[1])),
            ("all restored", [], 0x81, factory),
        ]
        for what, commands, kind, expected in steps:
            change()
            for index, sub in commands:
                check.that(f"{index:04X}h.{sub}", code_of(node.sdo.download, index, sub, b"save" if index == 0x1010 else b"load"), None)
            check.that(f"{what}: until the reset", values(), other)
            reset(check, node, kind)
            check.that(what, values(), expected)
    return check
