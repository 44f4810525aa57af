"""A relay between `odgen node` and an adapter, which does something to frames of one node.

A fault begins at a request, counted from the start of the command, so that nothing depends on the speed of a machine.
"""

from __future__ import annotations

import select
import socket
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import ClassVar

Id = tuple[int, int]

UPLOAD, DOWNLOAD = 0x40, 0x20
"""The first three bits of a request that begins to read or to write an entry."""
NO_ANSWER = 0xFF
"""CiA 301 has no such command."""


@dataclass(frozen=True)
class At:
    """The request at which a fault begins: so many of a kind have been sent to the node, this one included."""

    kind: int
    count: int
    entry: Id
    """What it is about."""


class Fault:
    """Does nothing; the others change a part of it. Lines of SLCAN go in, and those that go on come out."""

    keeps_waiting: ClassVar[bool] = False
    """Whether the host does not get an answer within its timeout."""

    def __init__(self, node: int, at: At, interrupt: Callable[[], None] = lambda: None) -> None:
        self.node, self.at, self.interrupt = node, at, interrupt
        self.requests = 0
        self.has_begun = False

    def to_nodes(self, line: bytes) -> Iterable[bytes]:
        if line.startswith(b"t%03X" % (0x600 + self.node)):
            if int(line[5:7], 16) & 0xE0 == self.at.kind:
                self.requests += 1
                if self.requests == self.at.count and not self.has_begun:
                    self.has_begun = True
                    return self.first(line)
            return self.later(line)
        return [line]

    def from_nodes(self, line: bytes) -> Iterable[bytes]:
        is_answer = line.startswith(b"t%03X" % (0x580 + self.node))
        return self.answer(line) if is_answer else self.other(line)

    def first(self, line: bytes) -> Iterable[bytes]:
        """The request at which the fault begins."""
        return [line]

    def later(self, line: bytes) -> Iterable[bytes]:
        """Other requests to the node, before and after."""
        return [line]

    def answer(self, line: bytes) -> Iterable[bytes]:
        """An answer of the node."""
        return [line]

    def other(self, line: bytes) -> Iterable[bytes]:
        """Anything else that comes from the bus."""
        return [line]

    def overdue(self) -> Iterable[bytes]:
        """Lines that go to the host before anything else does."""
        return []


class Dead(Fault):
    """The node gets the request, and is not heard any more."""

    keeps_waiting = True

    def later(self, line: bytes) -> Iterable[bytes]:
        return [] if self.has_begun else [line]

    def answer(self, line: bytes) -> Iterable[bytes]:
        return [] if self.has_begun else [line]

    def other(self, line: bytes) -> Iterable[bytes]:
        is_of_node = line[:1] == b"t" and int(line[1:4], 16) & 0x7F == self.node
        return [] if self.has_begun and is_of_node else [line]


class Another(Fault):
    """The answer about an entry has another value: another device is at the place."""

    entry: ClassVar[Id]

    def answer(self, line: bytes) -> Iterable[bytes]:
        if about(line) != self.entry:
            return [line]
        self.has_begun = True
        return [line[:13] + b"EFBEADDE"]


class AnotherType(Another):
    entry = (0x1000, 0)


class AnotherSerial(Another):
    entry = (0x1018, 4)


class Resets(Fault):
    """The node starts again just before it gets the request."""

    def first(self, line: bytes) -> Iterable[bytes]:
        return [b"t000281%02X" % self.node, line]


class Slow(Fault):
    """The answer comes after the host has given up: when it sends the next frame to the node."""

    keeps_waiting = True
    held: bytes | None = None
    is_given_up = False

    def later(self, line: bytes) -> Iterable[bytes]:
        self.is_given_up = self.has_begun
        return [line]

    def answer(self, line: bytes) -> Iterable[bytes]:
        if not self.has_begun or self.is_given_up:
            return [line]
        self.held = line
        return []

    def overdue(self) -> Iterable[bytes]:
        if self.held is None or not self.is_given_up:
            return []
        late, self.held = self.held, None
        return [late]


class RequestLost(Fault):
    keeps_waiting = True

    def first(self, line: bytes) -> Iterable[bytes]:
        return []


class AnswerLost(Fault):
    keeps_waiting = True
    is_lost = False

    def answer(self, line: bytes) -> Iterable[bytes]:
        if self.has_begun and not self.is_lost:
            self.is_lost = True
            return []
        return [line]


class Doubled(Fault):
    """The node gets the request twice, and answers twice."""

    def first(self, line: bytes) -> Iterable[bytes]:
        return [line, line]


class Malformed(Fault):
    """Every answer about the entry of a request is not an answer."""

    def answer(self, line: bytes) -> Iterable[bytes]:
        if about(line) != self.at.entry:
            return [line]
        self.has_begun = True
        return [line[:5] + b"%02X" % NO_ANSWER + line[7:]]


class CtrlC(Fault):
    """The user presses Ctrl-C while the request is on its way."""

    def first(self, line: bytes) -> Iterable[bytes]:
        self.interrupt()
        return [line]


def about(line: bytes) -> Id:
    """The entry that an SDO answer is about."""
    return int(line[9:11] + line[7:9], 16), int(line[11:13], 16)


class Relay:
    """Is an adapter, for one host after the other."""

    def __init__(self, port: int) -> None:
        self.adapter = port
        self.fault: Fault | None = None
        self.is_idle = threading.Event()
        self.is_idle.set()
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = f"tcp:127.0.0.1:{self.server.getsockname()[1]}"
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self) -> None:
        while True:
            host, _ = self.server.accept()
            self.is_idle.clear()
            with host, socket.create_connection(("127.0.0.1", self.adapter)) as adapter:
                for one in (host, adapter):
                    one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self.carry(host, adapter)
            self.is_idle.set()

    def carry(self, host: socket.socket, adapter: socket.socket) -> None:
        """Carries lines until the adapter has ended, which it does after the host."""
        assert self.fault
        fault, rest = self.fault, {host: b"", adapter: b""}
        while adapter in rest:
            for source in select.select(list(rest), [], [])[0]:
                data = received(source)
                if not data:
                    del rest[source]
                    if source is host:
                        adapter.shutdown(socket.SHUT_WR)
                    continue
                *lines, rest[source] = (rest[source] + data).split(b"\r")
                for line in lines:
                    if source is host:
                        to_nodes = fault.to_nodes(line)
                        send(host, fault.overdue())
                        send(adapter, to_nodes)
                    else:
                        send(host, fault.from_nodes(line))


def received(source: socket.socket) -> bytes:
    try:
        return source.recv(4096)
    except OSError:
        return b""  # A program that was killed leaves no orderly end.


def send(sink: socket.socket, lines: Iterable[bytes]) -> None:
    try:
        sink.sendall(b"".join(line + b"\r" for line in lines))
    except OSError:
        pass  # The host has gone.
