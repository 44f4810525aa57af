#!/usr/bin/env python3
"""Open the serial port of virtual nodes: python-can and pyserial at the pseudo-terminal of `odgen serve`, with python-canopen as the master.

    serial_node.py --odgen target/debug/odgen --spec od-spec/devices/fullmo-drive.od.yaml --device fullmo --eds generated/eds/fullmo.eds

One host after the other: each finds an adapter that was just switched on, whatever the one before has left. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import can
import canopen
import serial

from patience import PATIENCE, eventually
from sdo_client import NODE, Check
from virtual_node import reset

def bus(port: str, bitrate: int | None) -> can.BusABC:
    return can.Bus(interface="slcan", channel=port, bitrate=bitrate, sleep_after_open=0)


def check_node(check: Check, port: str, eds: str) -> None:
    """Reads, writes and commands a node."""
    network = canopen.Network(bus(port, 500_000))
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        node = canopen.RemoteNode(NODE, eds)
        network.add_node(node)
        reset(check, node)
        for index in (0x1000, 0x1001, 0x1017):
            if index in node.object_dictionary:
                node.sdo[index].raw
        check.that("1008h is empty", not node.sdo.upload(0x1008, 0), False)
        node.sdo[0x1017].raw = 50
        check.that("state in a heartbeat", node.nmt.wait_for_heartbeat(PATIENCE), "PRE-OPERATIONAL")
        node.nmt.state = "OPERATIONAL"
        check.that("state then", eventually(lambda: node.nmt.wait_for_heartbeat(PATIENCE), "OPERATIONAL"), "OPERATIONAL")
        try:
            node.sdo.download(0x1000, 0, b"\0\0\0\0")
            check.that("1000h was written", True, False)
        except canopen.SdoAbortedError as error:
            check.that("1000h refused", error.code, 0x06010002)
    finally:
        network.disconnect()


def be_rude(check: Check, port: str) -> None:
    """Leaves half a line, an open channel, and frames that are not read."""
    with serial.Serial(port, 115_200) as rude:
        rude.write(b"C\rS6\rO\rt6058400018000000")
        rude.flush()
        # Its answers are three bytes, and after them come heartbeats.
        check.that("frames for a host", eventually(lambda: rude.in_waiting > 30, True), True)


def check_plain(check: Check, port: str) -> None:
    """A plain host: as soon as the one before is seen to have gone, its adapter was just switched on: half a line of an unknown host, a closed channel,
    and no frame for others. What it says to each command then."""
    fresh, end = b"\r\x07", time.monotonic() + PATIENCE
    said = b""
    while said != fresh and time.monotonic() < end:
        with serial.Serial(port, 115_200, timeout=PATIENCE) as plain:
            plain.write(b"\rt6050\r")
            said = plain.read(len(fresh))
            if said == fresh:
                plain.write(b"V\rt6050\rO\rO\r")
                check.that("a plain host", plain.read(9), b"V1010\r\x07\r\x07")
    check.that("an adapter that was just switched on", said, fresh)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    for option in ("odgen", "spec", "device", "eds"):
        parser.add_argument(f"--{option}", required=True)
    options = parser.parse_args()
    check = Check()
    with tempfile.TemporaryDirectory() as folder:
        link = Path(folder) / "bus"
        node = f"{NODE}={options.device}"
        command = [options.odgen, "serve", options.spec, "--node", node, "--slcan", f"pty:{link}"]
        served = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            assert served.stdout
            port = served.stdout.readline().rsplit("serial:", 1)[1].strip()
            check.that("the port", port, str(link))
            check_node(check, port, options.eds)
            be_rude(check, port)
            check_plain(check, port)
            check_node(check, port, options.eds)
            check_plain(check, port)
        finally:
            served.terminate()
            code = served.wait(timeout=PATIENCE)
        check.that("the end: exit code, and whether the link is left", (code, link.is_symlink()), (0, False))
    for failure in check.failures:
        print(f"  {failure}")
    verdict = "ok" if not check.failures else f"{len(check.failures)} differences"
    print(f"python-can at the serial port of {options.device}: {check.done} checks, {verdict}")
    return 1 if check.failures else 0


if __name__ == "__main__":
    sys.exit(main())
