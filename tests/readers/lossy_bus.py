#!/usr/bin/env python3
"""Back up and restore a node over a bus that loses, doubles and swaps frames.

    lossy_bus.py --odgen target/debug/odgen [--runs 50] [--seed 1]

Between `odgen node` and `odgen serve` is a relay that does something to some of the frames, the same with the same seed. A backup either is
what it is over a good bus, or it fails with exit code 1, says why, and leaves no file. A restore either gives back every value, or
it fails with exit code 1 and says why; and no entry has a value then that is neither the old one nor the one of the file. What the node has is read
by python-canopen, past the relay. Exit code 1 when anything else happens.
"""

from __future__ import annotations

import argparse
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import can
import canopen

from patience import PATIENCE
from sdo_client import NODE
from virtual_node import Served

KINDS = ("lost", "doubled", "swapped", "all of it")
RATES = (0.0005, 0.002, 0.01)
HURRY_MS = 250
"""How long `odgen node` waits on a bad bus, where each frame that is lost takes so long; the node answers within a millisecond."""

SPEC = """\
od-spec: 1
title: Oven
uses: [cia301]
vendor: {name: Makers of ovens, number: 0x1234}
devices:
  oven: {name: Oven, bit-rates: [125], product: 7, product-revision: 0x00010002, device-type: 0, features: [heartbeat producer, identity]}
objects:
  0x2000: {name: temperature, type: integer16, access: rw, default: 40, min: 0, max: 900}
  0x2001: {name: highest temperature, type: integer16, access: rw, default: 60, max: 900}
  0x2002: {name: place, type: visible-string, access: rw, capacity: 60, default: at the window}
  0x2003: {name: recipe, type: visible-string, access: rw, capacity: 900, default: none}
  0x2004: {name: counter, type: unsigned64, access: rw, default: 1}
  0x2005: {name: steps, array: {count: 12, name: "step {n}", type: unsigned32, access: rw, default: 7}}
constraints:
  below highest: {require: "0x2000 < 0x2001"}
"""
Id = tuple[int, int]
OLD: dict[Id, bytes] = {
    (0x1017, 0): b"\0\0",
    (0x2000, 0): (50).to_bytes(2, "little"),
    (0x2001, 0): (70).to_bytes(2, "little"),
    (0x2002, 0): b"on the roof, behind the chimney",
    (0x2003, 0): b"flour and water; " * 40,
    (0x2004, 0): (1 << 40).to_bytes(8, "little"),
    **{(0x2005, sub): (sub * 1000).to_bytes(4, "little") for sub in range(1, 13)},
}
NEW: dict[Id, bytes] = {
    (0x1017, 0): b"\0\0",
    (0x2000, 0): (300).to_bytes(2, "little"),
    (0x2001, 0): (400).to_bytes(2, "little"),
    (0x2002, 0): b"in the cellar, on the left",
    (0x2003, 0): b"salt, yeast, and patience. " * 30,
    (0x2004, 0): (1 << 50).to_bytes(8, "little"),
    **{(0x2005, sub): (sub * 77777).to_bytes(4, "little") for sub in range(1, 13)},
}


@dataclass
class Fate:
    """What happens to frames."""

    kind: str
    rate: float
    random: random.Random
    happened: Counter[str] = field(default_factory=Counter)

    def of_next(self) -> str:
        if self.random.random() >= self.rate:
            return "kept"
        what = self.random.choice(KINDS[:3]) if self.kind == KINDS[3] else self.kind
        self.happened[what] += 1
        return what


class Relay:
    """Is in front of an adapter, for one host after the other."""

    def __init__(self, port: int) -> None:
        self.behind = port
        self.fate = Fate("lost", 0, random.Random(0))
        self.is_idle = threading.Event()
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = f"tcp:127.0.0.1:{self.server.getsockname()[1]}"
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self) -> None:
        while True:
            host, _ = self.server.accept()
            adapter = socket.create_connection(("127.0.0.1", self.behind))
            ways = [threading.Thread(target=self.pass_on, args=way, daemon=True) for way in ((host, adapter), (adapter, host))]
            for one in (host, adapter):
                one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            for way in ways:
                way.start()
            for way in ways:
                way.join()
            host.close()
            adapter.close()
            self.is_idle.set()

    def pass_on(self, source: socket.socket, sink: socket.socket) -> None:
        """Lines go on as they are; what are frames, as it is their fate. A frame that is held back follows the next one, or the end."""
        rest, held = b"", b""
        try:
            while data := source.recv(4096):
                *lines, rest = (rest + data).split(b"\r")
                for line in lines:
                    what = self.fate.of_next() if line.startswith(b"t") else "kept"
                    if what == "swapped" and not held:
                        held = line + b"\r"
                        continue
                    times = {"lost": 0, "doubled": 2}.get(what, 1)
                    sink.sendall((line + b"\r") * times)
                    if line.startswith(b"t") and held:
                        sink.sendall(held)
                        held = b""
            sink.sendall(held)
            sink.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # one of them has gone


class Trial:
    def __init__(self, odgen: str, folder: Path, served: Served, spec: Path) -> None:
        self.odgen, self.folder, self.spec = odgen, folder, spec
        self.relay = Relay(served.port)
        subprocess.run([odgen, "build", spec, "--out", folder / "made"], check=True, capture_output=True)
        self.network = canopen.Network(served.bus())
        self.network.notifier = can.Notifier(self.network.bus, self.network.listeners, 0.1)
        self.node = canopen.RemoteNode(NODE, str(folder / "made" / "eds" / "oven.eds"))
        self.network.add_node(self.node)
        self.asked = 0
        self.outcomes: Counter[str] = Counter()
        self.failures: list[str] = []

    def hush(self) -> None:
        """Forgets what others talked about. They have gone, so that nothing of it comes after the answer to a question that nothing else asks."""
        self.asked += 1
        question = b"\x40\xff\x5f" + bytes([self.asked % 256, 0, 0, 0, 0])
        # What a transfer that was given up would take for its own.
        self.network.send_message(0x600 + NODE, b"\x80" + bytes(7))
        self.network.send_message(0x600 + NODE, question)
        while self.node.sdo.responses.get(timeout=PATIENCE)[1:4] != question[1:4]:
            pass

    def give(self, values: dict[Id, bytes]) -> None:
        self.hush()
        for (index, sub), data in values.items():
            self.node.sdo.download(index, sub, data)

    def has(self) -> dict[Id, bytes]:
        self.hush()
        return {id: self.node.sdo.upload(*id) for id in OLD}

    def command(self, name: str, *arguments: str, within_ms: float = HURRY_MS) -> subprocess.CompletedProcess[str]:
        """Runs a command, until nothing of it is under way any more."""
        of_node = [str(self.spec), "--node", str(NODE), "--slcan", self.relay.address, "--timeout", str(int(within_ms))]
        whole = [self.odgen, "node", name, *of_node, *arguments]
        self.relay.is_idle.clear()
        done = subprocess.run(whole, capture_output=True, text=True, check=False, timeout=10 * PATIENCE, cwd=self.folder)
        assert self.relay.is_idle.wait(PATIENCE), "the relay does not come to an end"
        return done

    def good_bus(self) -> None:
        """What a backup and a restore are where nothing happens."""
        self.give(NEW)
        done = self.command("backup", "--out", "new.yaml", within_ms=1000 * PATIENCE)
        assert done.returncode == 0, done.stderr
        self.new = self.folder.joinpath("new.yaml").read_bytes()
        self.give(OLD)
        done = self.command("backup", "--out", "old.yaml", within_ms=1000 * PATIENCE)
        assert done.returncode == 0, done.stderr
        self.old = self.folder.joinpath("old.yaml").read_bytes()

    def judge(self, what: str, done: subprocess.CompletedProcess[str]) -> bool | None:
        """Whether it says that it has finished; none where it says neither that nor why not."""
        if done.returncode == 0:
            self.outcomes[f"{what} finished"] += 1
            return True
        if done.returncode == 1 and "error[OD07" in done.stderr and "panicked" not in done.stderr:
            self.outcomes[f"{what} failed and said so"] += 1
            return False
        self.failures.append(f"{what}: exit code {done.returncode}: {done.stderr[:300]}")
        return None

    def backup(self, name: str) -> bool | None:
        there = set(self.folder.iterdir())
        finished = self.judge("backup", self.command("backup", "--out", "kept.yaml"))
        kept = self.folder / "kept.yaml"
        if finished and kept.read_bytes() != self.old:
            self.failures.append(f"{name}: a backup of other values:\n{kept.read_text(encoding='utf-8')}")
        if finished is False and set(self.folder.iterdir()) != there:
            self.failures.append(f"{name}: a backup that failed leaves {set(self.folder.iterdir()) - there}")
        kept.unlink(missing_ok=True)
        return finished

    def restore(self, name: str) -> bool | None:
        finished = self.judge("restore", self.command("restore", "new.yaml", "--yes"))
        has = self.has()
        if finished and has != NEW:
            self.failures.append(f"{name}: a restore that is said to have finished: {different(has, NEW)}")
        if finished is False:
            strange = {id: data for id, data in has.items() if data not in (OLD[id], NEW[id])}
            if strange:
                self.failures.append(f"{name}: values that were not written: {strange}")
        self.give(OLD)
        if self.has() != OLD:
            self.failures.append(f"{name}: the node does not take values any more")
        return finished

    def run(self, number: int, seed: int) -> None:
        chosen = random.Random(seed * 1_000_003 + number)
        kind, rate = chosen.choice(KINDS), chosen.choice(RATES)
        self.relay.fate = Fate(kind, rate, chosen)
        name = f"run {number}, {kind} at {rate}"
        if (finished := self.backup(name) if number % 2 else self.restore(name)) and self.relay.fate.happened:
            self.outcomes["finished all the same"] += 1
        for what, count in self.relay.fate.happened.items():
            self.outcomes[what] += count


def different(one: dict[Id, bytes], other: dict[Id, bytes]) -> dict[Id, bytes]:
    return {id: data for id, data in one.items() if other[id] != data}


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", required=True)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    began = time.monotonic()
    odgen = str(Path(options.odgen).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spec = folder / "oven.od.yaml"
        spec.write_text(SPEC, encoding="utf-8")
        served = Served(odgen, spec, "oven")
        try:
            trial = Trial(odgen, folder, served, spec)
            trial.good_bus()
            for number in range(options.runs):
                trial.run(number, options.seed)
            trial.network.disconnect()
        finally:
            served.end()
    for failure in trial.failures[:10]:
        print(f"  WRONG {failure}")
    told = ", ".join(f"{what} {count}" for what, count in sorted(trial.outcomes.items()))
    print(f"backup and restore over a bad bus: {told}; {len(trial.failures)} wrong, {time.monotonic() - began:.1f} s")
    print(f"{options.runs - len(trial.failures)} passed, {len(trial.failures)} failed")
    too_good = any(trial.outcomes[what] == 0 for what in ("backup finished", "restore finished", "backup failed and said so", "restore failed and said so"))
    return 1 if trial.failures or too_good else 0


if __name__ == "__main__":
    sys.exit(main())
