"""Waiting for a node: for what it does, never for a time.

A busy machine delays everything, so each wait ends with the thing itself, and PATIENCE only bounds a failure. That something is
not sent follows from the order of frames: a node answers after what it had to send before.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TypeVar

import canopen
from canopen.lss import LssMaster
from canopen.sdo.client import SdoClient

T = TypeVar("T")

PATIENCE = 60.0
"""Seconds after which what is waited for is missing."""

SCANS = (200, 2000, 20_000)
"""Milliseconds that one scan after the other waits, until one finds something."""

SdoClient.RESPONSE_TIMEOUT = PATIENCE
LssMaster.RESPONSE_TIMEOUT = PATIENCE


class Heard:
    """Frames with an identifier, as they come."""

    def __init__(self, network: canopen.Network, cob_id: int) -> None:
        self.frames: list[bytes] = []
        self.came = threading.Condition()
        network.subscribe(cob_id, self.hear)

    def hear(self, _: int, data: bytearray, __: float) -> None:
        with self.came:
            self.frames.append(bytes(data))
            self.came.notify_all()

    def next(self) -> bytes | None:
        """The next frame; none if there is none in all patience."""
        with self.came:
            self.came.wait_for(lambda: self.frames, PATIENCE)
            return self.frames.pop(0) if self.frames else None

    def until(self, wanted: bytes) -> bytes | None:
        """The wanted frame, whatever comes before it; the last one if it does not come."""
        last, end = None, time.monotonic() + PATIENCE
        while last != wanted and time.monotonic() < end and (frame := self.next()) is not None:
            last = frame
        return last

    def now(self) -> list[bytes]:
        """The frames that have come and were not taken, which are taken now."""
        with self.came:
            taken, self.frames = self.frames, []
            return taken


def settle(node: canopen.RemoteNode) -> None:
    """Lets come what the node has to send by now. Between two answers it has looked at everything that is due."""
    for _ in range(2):
        node.sdo.upload(0x1000, 0)


def eventually(read: Callable[[], T], wanted: T) -> T:
    """What is read, as soon as it is what is wanted; at last whatever it is."""
    end = time.monotonic() + PATIENCE
    while (found := read()) != wanted and time.monotonic() < end:
        time.sleep(0.005)
    return found
