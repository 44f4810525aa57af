#!/usr/bin/env python3
"""Be the master of the demo firmware on an emulated Cortex-M4: python-canopen over SLCAN, through the UART.

    demo.py [--odgen target/debug/odgen] [--sample]    build, measure, run in QEMU, check
    demo.py --run [PORT]                               build and run until Ctrl-C; the adapter is at tcp:127.0.0.1:3333

The firmware is firmware-glue/examples/pitch-controller, a PMC. The client knows it by the generated EDS alone and does to it what
tests/readers/virtual_node.py and virtual_pdo.py do to virtual nodes. Here is what a virtual node has not: an axis that moves, a
fault with its cause, parameters in a flash, a UART that hears nonsense. The programs of tests/thumb/node have the same drivers and the
dictionaries of PMM and Fullmo drive, whose entries are tried in the same way; with --sample, they are left out.

With --odgen, `odgen node` looks for the demo firmware, backs it up, compares, and restores it, too; and what those devices have not is
checked of one with everything, whose EDS odgen makes: strings that can be written, DOMAINs, SYNC, LSS, nodes that it watches.

It needs python-canopen, which the tests of the EDS readers install: target/readers/venv/bin/python. `--run` does without. Exit codes as
those of run.py.
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
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import run

sys.path.append(str(run.ROOT / "tests" / "readers"))
if TYPE_CHECKING:
    from sdo_client import Check

NODES, EVERYTHING = run.HERE / "node", "everything"
EVERYTHING_SPECIFICATION = run.ROOT / "tests" / "readers" / "everything.od.yaml"
FIRMWARE = run.ROOT / "firmware-glue" / "examples" / "pitch-controller"
PROGRAM = "pitch-controller"
DEVICE = "pmc"
SPECIFICATION = run.ROOT / "od-spec" / "devices" / "pitch-control-system.od.yaml"
GENERATED, STEMS = run.ROOT / "generated", ["pitch-control-system", "fullmo-drive"]
BOARD = ["-machine", "mps2-an386", "-nographic", "-monitor", "none"]
HOST, PORT = "127.0.0.1", 3333
FEWEST, FEWEST_OF_SAMPLE = 7000, 2800  # checks: fewer were not all


class Board:
    """The emulated board with the firmware, by the command that starts it: its UART is a TCP server."""

    def __init__(self, command: list[str], port: int = 0) -> None:
        # A socket of ours, which is listened to before the emulator is there: a client that connects waits for it.
        with socket.create_server((HOST, port)) as server:
            # Without it, each answer waits for the acknowledgement of the one before. Connections have it from here.
            server.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.address = f"{HOST}:{server.getsockname()[1]}"
            uart = ["-chardev", f"socket,id=uart,fd={server.fileno()},server=on,wait=off", "-serial", "chardev:uart"]
            self.process = subprocess.Popen([*command, *uart], stdin=subprocess.DEVNULL, pass_fds=[server.fileno()])

    def raw(self) -> socket.socket:
        from patience import PATIENCE

        host, port = self.address.split(":")
        connection = socket.create_connection((host, int(port)), timeout=PATIENCE)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection

    def end(self) -> None:
        self.process.kill()
        self.process.wait()


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--odgen", type=Path)
    parser.add_argument("--sample", action="store_true", help="only the demo firmware and the device with everything")
    parser.add_argument("--run", metavar="PORT", type=int, nargs="?", const=PORT)
    options = parser.parse_args()
    try:
        if not shutil.which(run.QEMU):
            raise run.Missing(run.INSTALL_QEMU)
        toolchain = run.find_toolchain()
        if options.run:
            _, program = run.build(toolchain, FIRMWARE)[PROGRAM]
            return serve(Board(emulated(program), options.run))
        faults = measure(toolchain)
        _, program = run.build(toolchain, FIRMWARE)[PROGRAM]
        others = {name: other for name, (_, other) in run.build(toolchain, NODES).items()}
        return max(faults, check(program, others, options.odgen, is_sample=options.sample))
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


def emulated(program: Path) -> list[str]:
    return [run.QEMU, *BOARD, "-kernel", str(program)]


@contextmanager
def running(command: list[str]) -> Iterator[Board]:
    board = Board(command)
    try:
        yield board
    finally:
        board.end()


class Tally:
    """What was tried, of all parts."""

    def __init__(self) -> None:
        self.passed = self.failed = 0

    def add(self, what: str, part: Callable[[], tuple[int, list[str]]]) -> None:
        begin = time.monotonic()
        done, failures = part()
        self.passed += done - len(failures)
        self.failed += len(failures)
        for failure in failures[:20]:
            print(f"  {failure}")
        right, seconds = done - len(failures), time.monotonic() - begin
        print(f"{what}: {done} tried, {right} right, {len(failures)} wrong, {seconds:.1f} s", flush=True)


def check(program: Path, others: dict[str, Path], odgen: Path | None, *, is_sample: bool) -> int:
    """The demo firmware, and the nodes of other devices."""
    try:
        from demo_checks import check_axis, check_storage, check_text, check_writes
        from everything_checks import check_everything
        from virtual_node import Reached, check_device
    except ImportError as error:
        raise run.Missing(f"{error.name} is not installed: run it with target/readers/venv/bin/python") from error

    tally = Tally()

    def client(what: str, part: Callable[[], Check]) -> None:
        def checked() -> tuple[int, list[str]]:
            result = part()
            return result.done, result.failures

        tally.add(f"python-canopen and {what}", checked)

    def entries(address: str, eds: Path, device: dict, types: list[dict]) -> None:
        name, count = device["key"], sum(len(one["entries"]) for one in device["objects"])
        client(f"{name}, {count} entries, states, blocks", lambda: check_device(Reached(address), eds, device, types))
        client(f"{name}, limits", lambda: check_writes(address, eds, device, types))

    dumps = [json.loads((GENERATED / f"{stem}.json").read_text(encoding="utf-8")) for stem in STEMS]
    for device, types in [(device, dump["types"]) for dump in dumps for device in dump["devices"]]:
        name = device["key"]
        eds = GENERATED / "eds" / f"{name}.eds"
        is_demo = name == DEVICE
        if is_sample and not is_demo:
            continue
        with running(emulated(program if is_demo else others[name])) as board:
            if is_demo:
                client(f"{name}, UART", lambda: check_text(board.raw()))
            entries(board.address, eds, device, types)
            if is_demo:
                client(f"{name}, axis, PDOs, heartbeat, emergencies", lambda: check_axis(board.address, eds, device, types))
                client(f"{name}, flash", lambda: check_storage(board.address, eds))
                if odgen:
                    tally.add(f"odgen node and {name}", lambda: check_odgen(odgen.resolve(), f"tcp:{board.address}"))
    if odgen:
        with tempfile.TemporaryDirectory() as folder, running(emulated(others[EVERYTHING])) as board:
            command = [odgen.resolve(), "build", EVERYTHING_SPECIFICATION, "--out", folder]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            eds = Path(folder, "eds", f"{EVERYTHING}.eds")
            client("strings, DOMAINs, SYNC, LSS", lambda: check_everything(board.address, eds))
        fewest = FEWEST_OF_SAMPLE if is_sample else FEWEST
        if tally.passed < fewest:
            print(f"error: {tally.passed} checks, expected at least {fewest}", file=sys.stderr)
            tally.failed += 1
    print(f"{tally.passed} passed, {tally.failed} failed")
    return 1 if tally.failed else 0


def check_odgen(odgen: Path, address: str) -> tuple[int, list[str]]:
    """Finds the node, backs it up, changes it, compares, restores; how many checks, and what was wrong."""
    from patience import PATIENCE, SCANS

    failures, done = [], 0

    def expect(code: int, pattern: str, *command: str, timeouts: tuple[int, ...] = (int(1000 * PATIENCE),)) -> None:
        nonlocal done
        done += 1
        for milliseconds in timeouts:
            whole = [str(odgen), "node", *command, "--slcan", address, "--timeout", str(milliseconds)]
            said = subprocess.run(whole, capture_output=True, text=True, check=False, timeout=10 * PATIENCE)
            text = said.stdout + said.stderr
            if re.search(pattern, text):
                break
        if said.returncode != code or not re.search(pattern, text):
            failures.append(f"{' '.join(whole)}: ended with {said.returncode} and {text[-300:]!r}, expected {code} and {pattern!r}")

    spec, of_node = str(SPECIFICATION), ("--device", DEVICE, "--node", "5")
    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder, "pmc-5.yaml"))
        expect(0, rf"can be {DEVICE} ", "scan", spec, timeouts=SCANS)
        expect(0, "", "backup", spec, "--out", file, *of_node)
        expect(0, "", "compare", spec, file, *of_node)
        expect(0, "", "write", spec, "EFC target position=88.00 °", "--yes", *of_node)
        expect(3, "567Ah", "compare", spec, file, *of_node)
        expect(0, "567Ah", "restore", spec, file, "--yes", *of_node)
        expect(0, "", "compare", spec, file, *of_node)
    return done, failures


if __name__ == "__main__":
    sys.exit(main())
