"""A machine of three virtual nodes, which `odgen node` reaches over a relay, and python-canopen past it."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import can
import canopen
from canopen.objectdictionary import ODVariable
from canopen.sdo import SdoClient

from fault_relay import Fault, Id, Relay
from patience import PATIENCE, Heard

ROOT = Path(__file__).parents[2]
SPEC = ROOT / "od-spec/devices/pitch-control-system.od.yaml"
EDS = ROOT / "generated/eds"
PLANT = f"""\
od-plant: 1
title: Two blades of a turbine
devices: {{pmm: {SPEC}, pmc: {SPEC}}}
types:
  turbine: {{bit-rate: 500, positions: {{A: {{pmm: 1, pmc: 11}}, B: {{pmc: 12}}}}}}
sites:
  Bench:
    type: turbine
    machines:
      1: {{positions: {{A: {{pmm: {{serial: 101}}, pmc: {{serial: 111}}}}, B: {{pmc: {{serial: 112}}}}}}}}
"""
DEVICES = {1: "pmm", 11: "pmc", 12: "pmc"}
TIMEOUT = 3.0
"""Seconds after which `odgen node` gives up waiting for a lost answer. All others come within a millisecond, and have PATIENCE."""

State = dict[Id, bytes]


@dataclass(frozen=True)
class Room:
    """What a command can write: so many bytes of a file, and whether standard output takes anything."""

    of_file: int | None = None
    is_stdout_full: bool = False


@dataclass(frozen=True)
class Done:
    """How a command ended, and what it printed."""

    code: int
    out: str
    err: str


class Running:
    """The command that runs now. A relay may want to interrupt it before anything knows its process."""

    def __init__(self) -> None:
        self.process: subprocess.Popen[str] | None = None
        self.is_started = threading.Event()

    def interrupt(self) -> None:
        self.is_started.wait(PATIENCE)
        assert self.process
        self.process.send_signal(signal.SIGINT)


class Machine:
    """`odgen serve` with the machine, and a relay before it."""

    def __init__(self, odgen: str, folder: Path) -> None:
        self.odgen, self.folder = odgen, folder
        self.plant = folder / "plant.yaml"
        self.plant.write_text(PLANT, encoding="utf-8")
        command = [odgen, "serve", str(self.plant), "--slcan", "tcp:127.0.0.1:0"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        assert self.process.stdout
        self.port = int(self.process.stdout.readline().rsplit(":", 1)[1])
        self.relay = Relay(self.port)
        self.dictionaries = {node: canopen.import_od(str(EDS / f"{key}.eds"), node) for node, key in DEVICES.items()}

    @contextmanager
    def nodes(self) -> Iterator[dict[int, SdoClient]]:
        """What python-canopen reads and writes the nodes with, past the relay."""
        channel = f"socket://127.0.0.1:{self.port}"
        network = canopen.Network(can.Bus(interface="slcan", channel=channel, bitrate=500_000, sleep_after_open=0))
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        clients = {}
        for node, dictionary in self.dictionaries.items():
            clients[node] = SdoClient(0x600 + node, 0x580 + node, dictionary)
            clients[node].network = network
            network.subscribe(0x580 + node, clients[node].on_response)
        try:
            yield clients
        finally:
            network.disconnect()

    def state(self) -> dict[int, State]:
        """What every node has in the entries that can be read and written."""
        with self.nodes() as nodes:
            return {node: {id: client.upload(*id) for id in writable(self.dictionaries[node])} for node, client in nodes.items()}

    def give(self, values: dict[int, list[tuple[Id, bytes]]]) -> None:
        with self.nodes() as nodes:
            for node, of_node in values.items():
                for id, value in of_node:
                    nodes[node].download(*id, value)

    def reset(self) -> None:
        """Starts the nodes again, with what they have stored."""
        with self.nodes() as nodes:
            for node, client in nodes.items():
                heard = Heard(client.network, 0x700 + node)
                client.network.send_message(0, bytes([0x81, node]))
                assert heard.until(b"\0") == b"\0", f"node {node} does not start"

    def forget(self) -> None:
        """Gives the nodes their defaults."""
        with self.nodes() as nodes:
            for client in nodes.values():
                client.download(0x1011, 1, b"load")
        self.reset()

    def node(self, arguments: list[str], folder: Path, fault: Fault, running: Running, room: Room) -> Done:
        """Runs `odgen node` over the relay, in a folder."""
        timeout = TIMEOUT if fault.keeps_waiting else PATIENCE
        whole = [self.odgen, "node", *arguments, "--timeout", f"{1000 * timeout:.0f}", "--slcan", self.relay.address]
        if room.of_file is not None:
            # A limit for the size of files ends a write as a full disk does, and needs no disk of its own. It counts 512 bytes.
            whole = ["sh", "-c", f"trap '' XFSZ; ulimit -f {room.of_file // 512}; exec {shlex.join(whole)}"]
        self.relay.fault = fault
        with open("/dev/full" if room.is_stdout_full else os.devnull, "w", encoding="utf-8") as full:
            out = full if room.is_stdout_full else subprocess.PIPE
            process = subprocess.Popen(whole, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, text=True, cwd=folder)
            running.process = process
            running.is_started.set()
            said, failed = process.communicate(timeout=10 * PATIENCE)
        assert self.relay.is_idle.wait(PATIENCE), "the relay does not come to an end"
        return Done(process.returncode, said or "", failed)

    def end(self) -> None:
        self.process.kill()
        self.process.wait(timeout=PATIENCE)


def writable(dictionary: canopen.ObjectDictionary) -> list[Id]:
    parts = [[one] if isinstance(one, ODVariable) else one.subindices.values() for one in dictionary.values()]
    entries = [entry for of_one in parts for entry in of_one if entry.index >= 0x1000]
    return [(entry.index, entry.subindex) for entry in entries if entry.access_type == "rw" and entry.index not in (0x1010, 0x1011)]
