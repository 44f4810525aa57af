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

NODE = 5


def bus(port: str, bitrate: int | None) -> can.BusABC:
    return can.Bus(interface="slcan", channel=port, bitrate=bitrate, sleep_after_open=0)


def check_node(port: str, eds: str, failures: list[str]) -> int:
    """Reads, writes and commands a node; how much was right."""
    network = canopen.Network(bus(port, 500_000))
    try:
        network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
        node = canopen.RemoteNode(NODE, eds)
        network.add_node(node)
        done = 0
        network.send_message(0, [0x81, NODE])
        time.sleep(0.5)
        for index in (0x1000, 0x1001, 0x1017):
            if index in node.object_dictionary:
                node.sdo[index].raw
                done += 1
        name = node.sdo.upload(0x1008, 0)
        if not name:
            failures.append("1008h is empty")
        node.sdo[0x1017].raw = 50
        state = node.nmt.wait_for_heartbeat(timeout=5)
        if state != "PRE-OPERATIONAL":
            failures.append(f"state {state} in a heartbeat")
        node.nmt.state = "OPERATIONAL"
        node.nmt.wait_for_heartbeat(timeout=5)
        try:
            node.sdo.download(0x1000, 0, b"\0\0\0\0")
            failures.append("1000h was written")
        except canopen.SdoAbortedError as error:
            if error.code != 0x06010002:
                failures.append(f"1000h refused with {error.code:08X}")
        return done + 4
    finally:
        network.disconnect()


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    for option in ("odgen", "spec", "device", "eds"):
        parser.add_argument(f"--{option}", required=True)
    options = parser.parse_args()
    failures: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        link = Path(folder) / "bus"
        node = f"{NODE}={options.device}"
        command = [options.odgen, "serve", options.spec, "--node", node, "--slcan", f"pty:{link}"]
        served = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            assert served.stdout
            port = served.stdout.readline().rsplit("serial:", 1)[1].strip()
            if port != str(link):
                failures.append(f"the port is {port}")
            done = check_node(port, options.eds, failures)
            # Half a line, an open channel, frames that nobody reads.
            with serial.Serial(port, 115_200, timeout=1) as rude:
                rude.write(b"C\rS6\rO\rt6058400018000000")
                rude.flush()
                time.sleep(0.3)
            time.sleep(0.3)
            done += check_node(port, options.eds, failures)
            time.sleep(0.3)
            # A plain host: what the adapter says to each command, and nothing that was for others.
            with serial.Serial(port, 115_200, timeout=2) as plain:
                plain.write(b"V\rt6050\rO\rO\r")
                said = plain.read(9)
                if said != b"V1010\r\x07\r\x07":
                    failures.append(f"a plain host is told {said!r}")
                done += 1
        finally:
            served.terminate()
            code = served.wait(timeout=10)
        if code != 0 or link.is_symlink():
            failures.append(f"the end: exit code {code}, link {'left' if link.is_symlink() else 'gone'}")
    for failure in failures:
        print(f"  {failure}")
    verdict = "ok" if not failures else f"{len(failures)} differences"
    print(f"python-can at the serial port of {options.device}: {done} checks, {verdict}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
