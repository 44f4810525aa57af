#!/usr/bin/env python3
"""Be the master of the demo firmware on an emulated Cortex-M4: python-canopen over SLCAN, through the UART.

    demo.py [--odgen target/debug/odgen]     build, measure, run in QEMU, check
    demo.py --run                            build and run until Ctrl-C; the adapter is at the address that is printed

The firmware is firmware-glue/examples/pitch-controller. The client knows it by the generated EDS alone and does to it what
tests/readers/virtual_node.py and virtual_pdo.py do to virtual nodes. Here stands what a virtual node has not: an axis that moves, a
fault with its cause, parameters in a flash, a UART that hears nonsense.

With --odgen, `odgen node` looks for the node, backs it up, compares, and restores it, too. The EDS readers have to be installed: it
needs python-canopen, and is run with the Python of target/readers. Exit codes as those of run.py.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import run

sys.path.append(str(run.ROOT / "tests" / "readers"))

FIRMWARE = run.ROOT / "firmware-glue" / "examples" / "pitch-controller"
PROGRAM = "pitch-controller"
DEVICE = "pmc"
SPECIFICATION = run.ROOT / "od-spec" / "devices" / "pitch-control-system.od.yaml"
DUMP = run.ROOT / "generated" / "pitch-control-system.json"
EDS = run.ROOT / "generated" / "eds" / f"{DEVICE}.eds"
BOARD = ["-machine", "mps2-an386", "-nographic", "-monitor", "none"]
HOST = "127.0.0.1"
FEWEST = 2000  # checks: fewer were not all


class Board:
    """The emulated board with the firmware: its UART is a TCP server."""

    def __init__(self, program: Path) -> None:
        with socket.socket() as free:
            free.bind((HOST, 0))
            port = free.getsockname()[1]
        self.address = f"{HOST}:{port}"
        # Without `nodelay`, each answer waits for the acknowledgement of the one before.
        serial = ["-serial", f"tcp:{self.address},server=on,wait=off,nodelay=on"]
        command = [run.QEMU, *BOARD, *serial, "-kernel", str(program)]
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL)
        until = time.monotonic() + 20
        while True:
            try:
                socket.create_connection((HOST, port)).close()
                return
            except OSError as error:
                if self.process.poll() is not None or time.monotonic() > until:
                    self.end()
                    raise run.Failed(f"{run.QEMU} does not listen at {self.address}: {error}") from error
                time.sleep(0.05)

    def raw(self) -> socket.socket:
        host, port = self.address.split(":")
        connection = socket.create_connection((host, int(port)), timeout=5)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection

    def end(self) -> None:
        self.process.kill()
        self.process.wait(timeout=10)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path)
    parser.add_argument("--run", action="store_true")
    options = parser.parse_args()
    try:
        if not shutil.which(run.QEMU):
            raise run.Missing(run.INSTALL_QEMU)
        toolchain = run.find_toolchain()
        if options.run:
            _, program = run.build(toolchain, FIRMWARE)[PROGRAM]
            return serve(Board(program))
        faults = measure(toolchain)
        _, program = run.build(toolchain, FIRMWARE)[PROGRAM]
        board = Board(program)
        try:
            return max(faults, check(board, options.odgen))
        finally:
            board.end()
    except (run.Failed, run.Missing) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3 if isinstance(error, run.Missing) else 1


def measure(toolchain: run.Toolchain) -> int:
    """Prints the sizes, with names and without; 1 when the firmware can panic."""
    with_names = run.Elf(run.build(toolchain, FIRMWARE, ("names",))[PROGRAM][1])
    elf = run.Elf(run.build(toolchain, FIRMWARE)[PROGRAM][1])
    print(f"{toolchain.describe()}\n\n{run.table({PROGRAM: elf, 'with names': with_names})}\n")
    if elf.named(run.HEAVY[run.PANICS]):
        print(f"error: {PROGRAM} can panic", file=sys.stderr)
        return 1
    return 0


def serve(board: Board) -> int:
    print(f"node 5, a {DEVICE}, at tcp:{board.address}; Ctrl-C ends it", flush=True)
    try:
        board.process.wait()
    except KeyboardInterrupt:
        pass
    finally:
        board.end()
    return 0


def check(board: Board, odgen: Path | None) -> int:
    # `--run` does without python-canopen.
    from demo_checks import check_axis, check_storage, check_text, check_writes
    from virtual_node import Reached, check_device

    dump = json.loads(DUMP.read_text(encoding="utf-8"))
    (device,) = (one for one in dump["devices"] if one["key"] == DEVICE)
    entries = sum(len(one["entries"]) for one in device["objects"])
    passed = failed = 0

    def tell(what: str, done: int, failures: list[str], seconds: float) -> None:
        nonlocal passed, failed
        passed += done - len(failures)
        failed += len(failures)
        for failure in failures[:20]:
            print(f"  {failure}")
        print(f"{what}: {done} tried, {done - len(failures)} right, {len(failures)} wrong, {seconds:.1f} s", flush=True)

    parts = [
        ("what the UART hears", lambda: check_text(board.raw())),
        (f"{entries} entries, states, blocks, storage", lambda: check_device(Reached(board.address), EDS, device, dump["types"])),
        ("wrong lengths and values", lambda: check_writes(board.address, EDS, device, dump["types"])),
        ("axis, PDOs, heartbeat, emergencies", lambda: check_axis(board.address, EDS, device, dump["types"])),
        ("parameters in the flash", lambda: check_storage(board.address, EDS)),
    ]
    for what, part in parts:
        begin = time.monotonic()
        result = part()
        tell(f"python-canopen and the emulated {DEVICE}, {what}", result.done, result.failures, time.monotonic() - begin)
    if odgen:
        begin = time.monotonic()
        done, failures = check_odgen(odgen.resolve(), f"tcp:{board.address}")
        tell(f"odgen node and the emulated {DEVICE}", done, failures, time.monotonic() - begin)
    if passed < FEWEST:
        print(f"error: {passed} checks, expected at least {FEWEST}", file=sys.stderr)
        failed += 1
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


def check_odgen(odgen: Path, address: str) -> tuple[int, list[str]]:
    """Finds the node, backs it up, changes it, compares, restores; how many checks, and what was wrong."""
    failures, done = [], 0

    def expect(code: int, pattern: str, *command: str) -> None:
        nonlocal done
        done += 1
        whole = [str(odgen), "node", *command, "--slcan", address]
        said = subprocess.run(whole, capture_output=True, text=True, check=False, timeout=120)
        text = said.stdout + said.stderr
        if said.returncode != code or not re.search(pattern, text):
            failures.append(f"{' '.join(whole)}: ended with {said.returncode} and {text[-300:]!r}, expected {code} and {pattern!r}")

    spec, of_node = str(SPECIFICATION), ("--device", DEVICE, "--node", "5")
    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder, "pmc-5.yaml"))
        expect(0, rf"can be {DEVICE} ", "scan", spec, "--timeout", "200")
        expect(0, "", "backup", spec, "--out", file, *of_node)
        expect(0, "", "compare", spec, file, *of_node)
        expect(0, "", "write", spec, "EFC target position=88.00 °", *of_node)
        expect(3, "567Ah", "compare", spec, file, *of_node)
        expect(0, "567Ah", "restore", spec, file, *of_node)
        expect(0, "", "compare", spec, file, *of_node)
    return done, failures


if __name__ == "__main__":
    sys.exit(main())
