#!/usr/bin/env python3
"""Reach nodes through `odgen-bridge`: on a bus inside this program, and on another one reached through a process.

    bridge.py --odgen target/debug/odgen [--self-test]

A node of python-canopen is on a virtual bus of python-can: `odgen node` makes a first specification of it, scans, reads, writes,
backs up and loads a program through the bridge; the node refuses blocks, and its memory is busy for a while. Then `odgen serve` is the adapter: the bridge is a process,
and python-canopen reads the program back, past the bridge. Then lines of SLCAN, hosts that misbehave, bit rates, adapters that are
not there or are unplugged. `--self-test` also breaks the bridge, and wants that to be noticed. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import asyncio
import logging
import queue
import signal
import socket
import subprocess
import sys
import tempfile
import threading
from contextlib import contextmanager
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

import can
import canopen
from can.interfaces.virtual import VirtualBus

from patience import PATIENCE
from sdo_client import NODE
from virtual_node import Served

FOLDER = Path(__file__).resolve().parents[2] / "od-gen/bus/bridge"
sys.path.insert(0, str(FOLDER))

import odgen_bridge  # noqa: E402

SPEC = """\
od-spec: 1
title: Pump
uses: [cia301, cia302]
vendor: {name: Makers of pumps, number: 0x1234}
devices:
  pump: {name: Pump, bit-rates: [125], product: 7, product-revision: 0x00010002, device-type: 0, features: [device name, identity, heartbeat producer, {program download: 1}, program identification, flash status]}
objects:
  0x2000: {name: flow, type: integer16, access: rw, default: 40, max: 900}
  0x2001: {name: place, type: visible-string, access: rw, capacity: 60, default: at the window}
"""
PROGRAM = bytes(at * 11 % 256 for at in range(3000))
IDENTIFICATION = 0x1F56
STOPPED, STARTED, NO_PROGRAM = 0, 1, 3
BUSY = 3
"""So often the memory of the node is busy after a command."""


class Trial:
    """What was looked at, and what is wrong."""

    def __init__(self) -> None:
        self.count, self.failures = 0, []

    def that(self, what: str, found: object, expected: object) -> None:
        self.count += 1
        if found != expected:
            self.failures.append(f"{what}: found {found!r}, expected {expected!r}")

    def has(self, what: str, text: str, part: str) -> None:
        self.count += 1
        if part not in text or "Traceback" in text or "panicked" in text:
            self.failures.append(f"{what}: expected {part!r} in {text!r}")


@contextmanager
def bridge(channel: str, interface: str = "virtual", bitrate: int | None = None) -> Iterator[tuple[int, queue.Queue, odgen_bridge.Bridge]]:
    """A bridge inside this program: its port, what it ends with, and itself."""
    ended: queue.Queue = queue.Queue()
    ports: queue.Queue = queue.Queue()
    one = odgen_bridge.Bridge(odgen_bridge.Adapter(interface, channel, bitrate, {}))
    thread = threading.Thread(target=lambda: ended.put(asyncio.run(one.run(0, ports.put))), daemon=True)
    thread.start()
    try:
        yield ports.get(timeout=PATIENCE), ended, one
    finally:
        if thread.is_alive():
            one.loop.call_soon_threadsafe(one.end.set)
        thread.join(PATIENCE)


class Host:
    """A host that speaks SLCAN by hand."""

    def __init__(self, port: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.rest = b""

    def say(self, line: bytes) -> None:
        self.socket.sendall(line + b"\r")

    def hear(self) -> bytes:
        """The next line, or a bell; nothing at the end."""
        while b"\r" not in self.rest and b"\a" not in self.rest:
            try:
                data = self.socket.recv(4096)
            except ConnectionError:
                data = b""
            if not data:
                return b""
            self.rest += data
        end = min(self.rest.find(mark) % (1 << 30) for mark in (b"\r", b"\a"))
        line, self.rest = self.rest[: end + 1], self.rest[end + 1 :]
        return line

    def ask(self, line: bytes) -> bytes:
        self.say(line)
        return self.hear()

    def close(self) -> None:
        self.socket.close()


class PumpNode:
    """A node of python-canopen with a boot loader: it refuses blocks, as python-canopen does, and is busy after commands."""

    def __init__(self, channel: str, eds: Path) -> None:
        self.network = canopen.Network(can.Bus(interface="virtual", channel=channel))
        self.network.notifier = can.Notifier(self.network.bus, self.network.listeners, 0.1)
        self.node = canopen.LocalNode(NODE, str(eds))
        self.network.add_node(self.node)
        self.state, self.busy, self.commands = STARTED, 0, []
        self.node.add_write_callback(self.write)
        self.node.add_read_callback(self.read)

    def write(self, *, index: int, subindex: int, od: object, data: bytes) -> None:
        if index == 0x1F51 and subindex == 1:
            self.commands.append(data[0])
            self.state, self.busy = {0: STOPPED, 1: STARTED, 3: NO_PROGRAM}[data[0]], BUSY
        elif index == 0x1F50:
            if self.state != NO_PROGRAM:
                raise canopen.SdoAbortedError(0x08000022)
            self.state, self.busy = STOPPED, BUSY

    def read(self, *, index: int, subindex: int, od: object) -> int | None:
        if subindex != 1 or index not in (0x1F51, IDENTIFICATION, 0x1F57):
            return None
        if index == 0x1F51:
            return self.state
        if index == IDENTIFICATION:
            return 0 if self.state == NO_PROGRAM else 42
        self.busy -= self.busy > 0
        return int(self.busy > 0)

    def end(self) -> None:
        self.network.disconnect()


class Commands:
    """`odgen node` for the pump."""

    def __init__(self, odgen: str, folder: Path) -> None:
        self.odgen, self.folder = odgen, folder

    def run(self, port: int, name: str, *arguments: str) -> tuple[int, str]:
        spec = ["pump.od.yaml"] if name == "scan" else ["pump.od.yaml", "--node", str(NODE)]
        # A scan waits so long whatever comes.
        timeout = "1500" if name == "scan" else "5000"
        whole = [self.odgen, "node", name, *spec, *arguments, "--slcan", f"tcp:127.0.0.1:{port}", "--timeout", timeout]
        done = subprocess.run(whole, cwd=self.folder, capture_output=True, text=True, check=False, timeout=3 * PATIENCE)
        return done.returncode, done.stdout + done.stderr

    def specify(self, trial: Trial, port: int, eds: Path) -> None:
        """A specification of a node that no file describes, and its EDS next to the one that the node has."""
        scan = ["node", "scan", "--write-spec", "first.od.yaml", "--node", str(NODE), "--range", "2000h..2010h"]
        link = ["--slcan", f"tcp:127.0.0.1:{port}", "--timeout", "5000"]
        for command in ([*scan, *link], ["check", "first.od.yaml"], ["build", "first.od.yaml", "--out", "first"]):
            done = subprocess.run([self.odgen, *command], cwd=self.folder, capture_output=True, text=True, check=False, timeout=3 * PATIENCE)
            trial.that(f"{command[0]} of a first specification", (done.returncode, "" if done.returncode == 0 else done.stderr), (0, ""))
            if done.returncode:
                return
        made, own = (entries_of(canopen.import_od(str(file), NODE)) for file in (self.folder / "first/eds/first.eds", eds))
        trial.that("entries of a first specification", sorted(made), sorted(own))
        for place, entry in own.items():
            found = made.get(place)
            if found and entry.data_type in canopen.objectdictionary.INTEGER_TYPES:
                trial.that(f"length of {entry.name}", len(found), len(entry))

    def look(self, trial: Trial, port: int, *more: str) -> None:
        """What every user does with a node."""
        for name, arguments, expected in (
            ("scan", (), "can be pump (Pump) of pump.od.yaml"),
            ("read", ("flow", "place"), '2001h place = "at the window"'),
            ("write", ("flow=55", "place=on the roof, behind the chimney", "--yes"), "flow = 55"),
            ("read", ("flow", "place"), 'place = "on the roof, behind the chimney"'),
            ("backup", ("--out", "kept.yaml", "--force"), "kept.yaml"),
            ("compare", ("kept.yaml",), "0 differ"),
            ("program", ("pump.bin", "--yes"), "1F51h.1: started"),
        ):
            code, text = self.run(port, name, *arguments, *more)
            trial.that(f"{name} ends", (code, "" if code == 0 else text), (0, ""))
            trial.has(name, text, expected)


def entries_of(dictionary: canopen.ObjectDictionary) -> dict[tuple[int, int], canopen.objectdictionary.ODVariable]:
    parts = (one if hasattr(one, "subindices") else {0: one} for one in dictionary.values())
    return {(entry.index, entry.subindex): entry for part in parts for entry in part.values()}


def check_own_node(trial: Trial, commands: Commands, eds: Path) -> None:
    """A node of python-canopen, on a virtual bus."""
    node = PumpNode("pump", eds)
    try:
        with bridge("pump") as (port, *_):
            commands.specify(trial, port, eds)
            commands.look(trial, port)
            trial.that("commands for the program", node.commands, [0, 3, 1])
            trial.that("the program in the node", bytes(node.node.get_data(0x1F50, 1)), PROGRAM)
    finally:
        node.end()


@contextmanager
def process(*arguments: str) -> Iterator[subprocess.Popen]:
    command = [sys.executable, str(FOLDER / "odgen_bridge.py"), *arguments]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as one:
        try:
            yield one
        finally:
            one.kill()


def port_of(one: subprocess.Popen) -> int:
    assert one.stdout
    line = one.stdout.readline()
    assert "--slcan tcp:127.0.0.1:" in line, (line, one.stderr and one.stderr.read())
    return int(line.rsplit(":", 1)[1])


def check_process(trial: Trial, commands: Commands, odgen: str, spec: Path, eds: Path) -> None:
    """Virtual nodes on an adapter that the bridge reaches by python-can; then the adapter is unplugged."""
    served = Served(odgen, spec, "pump")
    behind = ("slcan", f"socket://{served.address}", "--port", "0", "--option", "sleep_after_open=0")
    with process(*behind, "--bitrate", "125000") as one:
        port = port_of(one)
        commands.look(trial, port, "--bit-rate", "125")
        code, text = commands.run(port, "read", "flow", "--bit-rate", "250")
        trial.that("another bit rate", code, 1)
        trial.has("another bit rate", text, "the adapter refuses 250 kbit/s")
        network = canopen.Network(served.bus())
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        foreign = network.add_node(NODE, str(eds))
        trial.that("the program, read by python-canopen", foreign.sdo.upload(0x1F50, 1), PROGRAM)
        network.disconnect()
        host = Host(port)
        trial.that("open", host.ask(b"O"), b"\r")
        served.end()
        # Answers of the node may still be on their way.
        answers = b"t%03X" % (0x580 + NODE)
        while (heard := host.hear()).startswith(answers):
            pass
        trial.that("the host hears the end", heard, b"")
        trial.that("the bridge ends", one.wait(PATIENCE), 1)
        assert one.stderr
        said = one.stderr.read()
        trial.has("unplugged", said, "the adapter does not work any more")
        trial.has("refused bit rate", said, "`--bitrate 125000` is set")
    with process(*behind) as one:
        trial.that("no adapter", one.wait(PATIENCE), 1)
        assert one.stderr
        trial.has("no adapter", one.stderr.read(), "cannot open `slcan`")


def check_command_line(trial: Trial) -> None:
    # A shell that runs this in the background has SIGINT ignored, which a started process keeps.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with process("virtual", "line", "--port", "0") as one:
        port = port_of(one)
        with process("virtual", "line", "--port", str(port)) as second:
            trial.that("port in use", second.wait(PATIENCE), 1)
            assert second.stderr
            trial.has("port in use", second.stderr.read(), f"cannot listen at port {port}")
        one.send_signal(signal.SIGINT)
        trial.that("Ctrl-C", one.wait(PATIENCE), 0)
        assert one.stderr
        trial.that("Ctrl-C, said", one.stderr.read(), "")
    for arguments, code, said in (
        (["nope", "0"], 2, "python-can has no interface 'nope'"),
        (["virtual", "0", "--bitrate", "125"], 2, "expected 10000 to 1000000 bit/s"),
        (["virtual", "0", "--port", "70000"], 2, "expected 0 to 65535"),
        (["virtual", "0", "--option", "x"], 2, "expected NAME=VALUE"),
        (["socketcan", "can0", "--bitrate", "125000"], 2, "leave out --bitrate"),
        (["pcan", "PCAN_USBBUS1", "--bitrate", "125000"], 1, "`pcan`"),
        (["slcan", "/dev/no-such-port", "--option", "sleep_after_open=0"], 1, "cannot open `slcan` `/dev/no-such-port`"),
    ):
        with process(*arguments) as one:
            trial.that(" ".join(arguments), one.wait(PATIENCE), code)
            assert one.stderr
            trial.has(" ".join(arguments), one.stderr.read(), said)


def check_lines(trial: Trial) -> None:
    """Each command of SLCAN, frames in both directions, and hosts that share the bus or misbehave."""
    other = can.Bus(interface="virtual", channel="lines")
    with bridge("lines") as (port, *_):
        host = Host(port)
        for line, answer in (
            (b"", b"\r"), (b"C", b"\r"), (b"t1000", b"\a"), (b"F", b"\a"), (b"S4", b"\r"), (b"S9", b"\a"), (b"S", b"\a"), (b"s031C", b"\a"),
            (b"Z0", b"\r"), (b"M00000000", b"\r"), (b"mFFFFFFFF", b"\r"), (b"m0", b"\a"), (b"x", b"\a"), (b"V", b"V1010\r"), (b"v", b"v1010\r"),
            (b"N", b"NODGE\r"), (b"O", b"\r"), (b"O", b"\a"), (b"S4", b"\a"), (b"Z1", b"\a"), (b"F", b"F00\r"), (b"t0", b"\a"), (b"t8000", b"\a"),
            (b"t1009", b"\a"), (b"t100211", b"\a"), (b"t1001112", b"\a"), (b"T200000000", b"\a"), (b"r1001AA", b"\a"), (b"0" * 1000, b"\a"),
            (b"\xff", b"\a"), (b"", b"\r"),
        ):
            trial.that(f"answer to {line[:20]!r}", host.ask(line), answer)
        sent = (
            (b"t1238FFEEDDCCBBAA9988", b"z\r", can.Message(arbitration_id=0x123, data=bytes.fromhex("ffeeddccbbaa9988"), is_extended_id=False)),
            (b"t7ff0", b"z\r", can.Message(arbitration_id=0x7FF, is_extended_id=False)),
            (b"T1ABCDEF021a2B", b"Z\r", can.Message(arbitration_id=0x1ABCDEF0, data=b"\x1a\x2b")),
            (b"r7051", b"z\r", can.Message(arbitration_id=0x705, dlc=1, is_remote_frame=True, is_extended_id=False)),
            (b"R000000FF8", b"Z\r", can.Message(arbitration_id=0xFF, dlc=8, is_remote_frame=True)),
        )
        for line, answer, message in sent:
            trial.that(f"answer to {line!r}", host.ask(line), answer)
            frame = other.recv(PATIENCE)
            trial.that(f"frame of {line!r}", frame is not None and frame.equals(message, timestamp_delta=None, check_channel=False, check_direction=False), True)
        # Two hosts: each sees what the other sends, and not what it sends itself.
        second = Host(port)
        trial.that("time stamps", second.ask(b"Z1"), b"\r")
        trial.that("second host", second.ask(b"O"), b"\r")
        listener = Host(port)
        trial.that("a host that only listens", (listener.ask(b"L"), listener.ask(b"t1000")), (b"\r", b"\a"))
        for line, _, message in sent:
            other.send(message)
            trial.that(f"line of {line!r}", host.hear().strip().upper(), line.upper())
            stamped = second.hear().strip()
            trial.that(f"stamped line of {line!r}", (stamped[:-4].upper(), int(stamped[-4:], 16) < 60_000), (line.upper(), True))
            trial.that(f"heard line of {line!r}", listener.hear().strip().upper(), line.upper())
        other.send(can.Message(arbitration_id=1, is_error_frame=True))
        trial.that("from the first host", (host.ask(b"t10010A"), second.hear()[:7]), (b"z\r", b"t10010A"))
        trial.that("to one that listens", listener.hear(), b"t10010A\r")
        # One that goes away leaves half a line, and one that is cut off leaves frames.
        second.socket.sendall(b"t60")
        second.close()
        listener.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        other.send(sent[0][2])
        listener.close()
        trial.that("the first one goes on", host.hear().upper(), b"t1238FFEEDDCCBBAA9988\r".upper())
        trial.that("closed", (host.ask(b"C"), host.ask(b"t1000")), (b"\r", b"\a"))
        other.send(sent[0][2])
        trial.that("nothing comes to a closed channel", host.ask(b"V"), b"V1010\r")
        host.close()
    other.shutdown()


def check_deaf_host(trial: Trial) -> None:
    """A host that reads nothing is left, and the others stay."""
    with bridge("deaf") as (port, _, inside):
        host, deaf = Host(port), Host(port)
        trial.that("a deaf host", deaf.ask(b"O"), b"\r")
        with mock.patch.object(odgen_bridge, "MOST_WAITING", 1 << 16):
            flood(inside)
        trial.that("the others are still there", host.ask(b"V"), b"V1010\r")
        while deaf.hear():
            pass
        host.close()


def flood(inside: odgen_bridge.Bridge) -> None:
    """Shows frames until the last host, which reads nothing, is left."""
    message = can.Message(arbitration_id=0x123, data=bytes(8), is_extended_id=False)
    shown, deaf = threading.Semaphore(0), inside.hosts[-1]
    while deaf in inside.hosts:
        for _ in range(1000):
            inside.loop.call_soon_threadsafe(inside.heard, message)
        inside.loop.call_soon_threadsafe(shown.release)
        shown.acquire(timeout=PATIENCE)


class Wired(VirtualBus):
    """An adapter with wires: it has a bit rate, and can break."""

    opened: list[object] = []
    is_broken = False

    def __init__(self, channel: str, **options: object) -> None:
        type(self).opened.append(options.get("bitrate"))
        super().__init__(channel)

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        if type(self).is_broken:
            raise can.CanOperationError("pulled out")
        return super()._recv_internal(timeout)

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        if msg.arbitration_id == 0x666:
            raise can.CanOperationError("no node acknowledges")
        super().send(msg, timeout)


@contextmanager
def with_wires() -> Iterator[None]:
    names = can.interfaces.BACKENDS | {"wired": (__name__, "Wired")}
    with mock.patch.dict(can.interfaces.BACKENDS, names), mock.patch.object(can.util, "VALID_INTERFACES", frozenset(names)):
        Wired.opened, Wired.is_broken = [], False
        yield


def check_bit_rates(trial: Trial) -> None:
    """An adapter joins the bus with the bit rate that a user has set, and not before."""
    with with_wires(), bridge("wires", "wired") as (port, ended, _):
        host, second = Host(port), Host(port)
        trial.that("no bit rate", host.ask(b"O"), b"\a")
        trial.that("off the bus", Wired.opened, [])
        trial.that("a bit rate", (host.ask(b"S4"), host.ask(b"O")), (b"\r", b"\r"))
        trial.that("on the bus", Wired.opened, [125_000])
        trial.that("another one meanwhile", second.ask(b"S5"), b"\a")
        trial.that("the same", (second.ask(b"S4"), second.ask(b"O"), second.ask(b"C")), (b"\r", b"\r", b"\r"))
        trial.that("a frame that is not sent", (host.ask(b"t6660"), host.ask(b"t1000")), (b"\a", b"z\r"))
        trial.that("another one afterwards", (host.ask(b"C"), host.ask(b"S5"), host.ask(b"O")), (b"\r", b"\r", b"\r"))
        trial.that("the bus anew", Wired.opened, [125_000, 250_000])
        Wired.is_broken = True
        trial.that("the end", (host.hear(), second.hear()), (b"", b""))
        trial.has("why", str(ended.get(timeout=PATIENCE)), "the adapter does not work any more: pulled out")
    with with_wires(), bridge("wires", "wired", 125_000) as (port, *_):
        host = Host(port)
        trial.that("on the bus from the start", Wired.opened, [125_000])
        trial.that("only the bit rate that is set", (host.ask(b"S5"), host.ask(b"S4"), host.ask(b"O")), (b"\a", b"\r", b"\r"))
        host.close()


def cut(line_of: Callable[[can.Message], str | None]) -> Callable[[can.Message], str | None]:
    return lambda message: (line := line_of(message)) and line[:-1]


FAULTS = {
    "a frame loses its last digit": lambda: mock.patch.object(odgen_bridge, "line_of", cut(odgen_bridge.line_of)),
    "remote frames become data": lambda: mock.patch.object(odgen_bridge, "line_of", lambda message: f"t{message.arbitration_id:03X}0"),
    "hosts hear themselves": lambda: mock.patch.object(
        odgen_bridge.Bridge, "heard", lambda self, message, sender=None, heard=odgen_bridge.Bridge.heard: heard(self, message)
    ),
    "a frame is not sent": lambda: mock.patch.object(odgen_bridge.Adapter, "send", lambda self, message: None),
    "any bit rate does": lambda: mock.patch.object(odgen_bridge.Bridge, "set_bitrate", lambda self, bitrate: b"\r"),
    "the adapter joins without a bit rate": lambda: mock.patch.object(odgen_bridge.Adapter, "needs_bitrate", False),
}


def check_faults(trial: Trial) -> None:
    """Each planted fault is noticed."""
    for name, plant in FAULTS.items():
        tried = Trial()
        with plant(), mock.patch(f"{__name__}.PATIENCE", 1.0):
            try:
                check_bit_rates(tried)
                check_lines(tried)
            except (AssertionError, TimeoutError, ValueError, queue.Empty):
                tried.failures.append("no end")
        trial.that(f"noticed: {name}", bool(tried.failures), True)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    odgen, trial = str(Path(options.odgen).resolve()), Trial()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spec = folder / "pump.od.yaml"
        spec.write_text(SPEC, encoding="utf-8")
        folder.joinpath("pump.bin").write_bytes(PROGRAM)
        subprocess.run([odgen, "build", spec, "--out", folder / "made"], check=True, capture_output=True)
        eds, commands = folder / "made" / "eds" / "pump.eds", Commands(odgen, folder)
        check_command_line(trial)
        check_process(trial, commands, odgen, spec, eds)
        # What it says to its user would be among what this program says.
        with mock.patch.object(odgen_bridge, "say"):
            check_lines(trial)
            check_deaf_host(trial)
            check_bit_rates(trial)
            check_own_node(trial, commands, eds)
            if options.self_test:
                check_faults(trial)
    for failure in trial.failures[:20]:
        print(f"  WRONG {failure}")
    print(f"odgen-bridge: {trial.count - len(trial.failures)} passed, {len(trial.failures)} failed")
    return 1 if trial.failures else 0


if __name__ == "__main__":
    sys.exit(main())
