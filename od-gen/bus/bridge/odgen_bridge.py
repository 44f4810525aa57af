"""Offer a CAN adapter that python-can knows as SLCAN over TCP, on this machine only.

SLCAN is the protocol of serial CAN adapters: lines of ASCII that end with a carriage return. `odgen node --slcan
tcp:127.0.0.1:3333` speaks it. Several hosts can be connected at once, and each sees what the others send.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import logging
import re
import signal
import sys
import threading
from collections.abc import Callable

import can

BIT_RATES = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 800_000, 1_000_000)
"""In bit/s, by the digit of their command."""

ANY_BIT_RATE = ("virtual", "udp_multicast")
"""Interfaces without wires."""

OWN_BIT_RATE = ("socketcan", "socketcand", "slcan")
"""Interfaces that can be opened with the bit rate that they have."""

DONE, REFUSED = b"\r", b"\a"

LONGEST = 31
"""No line is longer: `T`, eight digits, length, eight bytes, time stamp."""

MOST_WAITING = 1 << 20
"""A host for which more bytes wait does not read any more."""

NAP = 0.2
"""Seconds after which the thread that reads from the adapter looks whether it is to end."""

PATIENCE = 1.0
"""Seconds that a frame may wait to be sent."""

FRAME = re.compile("(?:([tr])([0-7][0-9A-Fa-f]{2})|([TR])([01][0-9A-Fa-f]{7}))([0-8])((?:[0-9A-Fa-f]{2})*)")


class Unusable(Exception):
    """Why the adapter cannot be used, in words for the user."""


def say(text: str) -> None:
    """Reports something to the user."""
    print(f"odgen-bridge: {text}", file=sys.stderr, flush=True)


def words(error: BaseException) -> str:
    """The first line of an error; drivers add more."""
    text = str(error).strip().split("\n", 1)[0]
    return text or type(error).__name__


def message_of(line: str) -> can.Message | None:
    """The frame of a line."""
    if (match := FRAME.fullmatch(line)) is None:
        return None
    short, short_id, long, long_id, length, digits = match.groups()
    data, is_remote = bytes.fromhex(digits), (short or long) in "rR"
    if len(data) != (0 if is_remote else int(length)):
        return None
    return can.Message(
        arbitration_id=int(short_id or long_id, 16),
        is_extended_id=bool(long),
        is_remote_frame=is_remote,
        dlc=int(length),
        data=None if is_remote else data,
    )


def line_of(message: can.Message) -> str | None:
    """The line of a frame, without its end; none for what classic CAN does not have."""
    if message.is_error_frame or message.is_fd:
        return None
    kind = "tTrR"[message.is_extended_id + 2 * message.is_remote_frame]
    digits = 8 if message.is_extended_id else 3
    data = "" if message.is_remote_frame else message.data[: message.dlc].hex().upper()
    return f"{kind}{message.arbitration_id:0{digits}X}{message.dlc}{data}"


class Adapter:
    """A bus of python-can, which can be opened again with another bit rate."""

    def __init__(self, interface: str, channel: str, bitrate: int | None, options: dict[str, str]) -> None:
        self.interface, self.channel, self.options = interface, channel, options
        self.bitrate = bitrate
        self.is_fixed = bitrate is not None
        self.bus: can.BusABC | None = None
        self.reader: threading.Thread | None = None
        self.is_over = threading.Event()

    @property
    def needs_bitrate(self) -> bool:
        return self.bitrate is None and self.interface not in ANY_BIT_RATE + OWN_BIT_RATE

    def open(self, heard: Callable[[can.Message], None], broken: Callable[[str], None]) -> None:
        """Joins the bus, unless that is done."""
        if self.bus is not None:
            return
        rate = {} if self.bitrate is None else {"bitrate": self.bitrate}
        try:
            self.bus = can.Bus(interface=self.interface, channel=self.channel, **rate, **self.options)
        except (can.CanInterfaceNotImplementedError, ImportError, NameError) as error:
            help_ = "install the driver of the adapter and the Python package that python-can needs for it"
            raise Unusable(f"python-can cannot use `{self.interface}` here: {words(error)}; {help_}") from None
        except Exception as error:  # each driver has errors of its own
            help_ = "check that it is plugged in, and the channel"
            raise Unusable(f"cannot open `{self.interface}` `{self.channel}`: {words(error)}; {help_}") from None
        self.is_over.clear()
        self.reader = threading.Thread(target=self.read, args=(self.bus, heard, broken), daemon=True)
        self.reader.start()

    def read(self, bus: can.BusABC, heard: Callable[[can.Message], None], broken: Callable[[str], None]) -> None:
        """Reads what comes from the bus, until the end."""
        while not self.is_over.is_set():
            try:
                message = bus.recv(NAP)
            except Exception as error:
                if not self.is_over.is_set():
                    broken(words(error))
                return
            if message is not None and message.is_rx:
                heard(message)

    def send(self, message: can.Message) -> str | None:
        """Puts a frame on the bus; why that fails."""
        try:
            assert self.bus is not None
            self.bus.send(message, timeout=PATIENCE)
        except Exception as error:
            return words(error)
        return None

    def close(self) -> None:
        """Leaves the bus."""
        if self.bus is None:
            return
        self.is_over.set()
        if self.reader is not None and self.reader is not threading.current_thread():
            self.reader.join(5 * NAP)
        with contextlib.suppress(Exception):
            self.bus.shutdown()
        self.bus = None


class Host:
    """A program that is connected, and the state of its channel."""

    def __init__(self, writer: asyncio.StreamWriter) -> None:
        self.writer = writer
        self.is_open = False
        self.only_listens = False
        self.has_stamps = False

    def write(self, data: bytes) -> None:
        transport = self.writer.transport
        if transport.is_closing():
            return
        if transport.get_write_buffer_size() > MOST_WAITING:
            say("a host that does not read was disconnected")
            transport.abort()
            return
        self.writer.write(data)

    def show(self, line: str, seconds: float) -> None:
        if self.is_open:
            stamp = f"{int(seconds * 1000) % 60_000:04X}" if self.has_stamps else ""
            self.write(f"{line}{stamp}\r".encode("ascii"))


class Bridge:
    """Hosts, and the adapter that they share."""

    def __init__(self, adapter: Adapter) -> None:
        self.adapter = adapter
        self.hosts: list[Host] = []
        self.why: str | None = None
        self.is_failing = False

    async def run(self, port: int, ready: Callable[[int], None]) -> str | None:
        """Serves hosts until the adapter is gone; why it is."""
        self.loop, self.end = asyncio.get_running_loop(), asyncio.Event()
        try:
            if self.adapter.needs_bitrate:
                say("the adapter stays off the bus until a host sets the bit rate; `--bitrate` sets it now")
            else:
                self.join()
            server = await self.listen(port)
            ready(server.sockets[0].getsockname()[1])
            try:
                await self.end.wait()
            finally:
                server.close()
                for host in self.hosts:
                    host.writer.transport.abort()
        finally:
            self.adapter.close()
        return self.why

    async def listen(self, port: int) -> asyncio.AbstractServer:
        try:
            return await asyncio.start_server(self.serve, "127.0.0.1", port)
        except OSError as error:
            raise Unusable(f"cannot listen at port {port}: {error.strerror or error}; `--port` takes another one") from None

    def join(self) -> None:
        """Has the adapter join the bus; what it hears comes into this thread."""
        self.adapter.open(lambda message: self.later(self.heard, message), lambda why: self.later(self.broke, why))

    def later(self, do: Callable[..., None], what: object) -> None:
        with contextlib.suppress(RuntimeError):  # the end was faster
            self.loop.call_soon_threadsafe(do, what)

    def broke(self, why: str) -> None:
        self.why = f"the adapter does not work any more: {why}"
        self.end.set()

    def heard(self, message: can.Message, sender: Host | None = None) -> None:
        """Shows a frame to all hosts except its sender."""
        if (line := line_of(message)) is not None:
            seconds = self.loop.time()
            for host in self.hosts:
                if host is not sender:
                    host.show(line, seconds)

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Talks to a host until it goes away."""
        host = Host(writer)
        self.hosts.append(host)
        line = bytearray()
        try:
            while data := await reader.read(4096):
                for byte in data:
                    if byte == ord("\r"):
                        host.write(self.take(host, line.decode("latin-1")))
                        line.clear()
                    elif byte != ord("\n") and len(line) <= LONGEST:
                        line.append(byte)
                await writer.drain()
        except (OSError, asyncio.CancelledError):
            pass  # it has gone
        finally:
            self.hosts.remove(host)
            writer.close()

    def take(self, host: Host, line: str) -> bytes:
        """Carries out a line of a host; the answer."""
        if line[:1] in ("t", "T", "r", "R"):
            return self.send(host, line)
        if line in ("", "C"):
            host.is_open = host.is_open and line == ""
            return DONE
        if line in ("V", "v", "N"):
            return {"V": b"V1010\r", "v": b"v1010\r", "N": b"NODGE\r"}[line]
        if line == "F" and host.is_open:
            return b"F00\r"
        if host.is_open:
            return REFUSED
        if line in ("O", "L"):
            return self.open(host, line == "L")
        if line in ("Z0", "Z1"):
            host.has_stamps = line == "Z1"
            return DONE
        if re.fullmatch("[Mm][0-9A-Fa-f]{8}", line):
            return DONE  # all frames are let through
        if re.fullmatch("S[0-8]", line):
            return self.set_bitrate(BIT_RATES[int(line[1])])
        return REFUSED

    def open(self, host: Host, only_listens: bool) -> bytes:
        if self.adapter.needs_bitrate:
            say("a host opens the channel without a bit rate: start with `--bitrate`, or use `odgen node --bit-rate`")
            return REFUSED
        try:
            self.join()
        except Unusable as error:
            say(str(error))
            return REFUSED
        host.is_open, host.only_listens = True, only_listens
        return DONE

    def set_bitrate(self, bitrate: int) -> bytes:
        adapter = self.adapter
        if adapter.interface in ANY_BIT_RATE or adapter.bitrate == bitrate:
            return DONE
        why = None
        if adapter.is_fixed:
            why = f"`--bitrate {adapter.bitrate}` is set"
        elif adapter.interface in OWN_BIT_RATE and adapter.interface != "slcan":
            why = f"the bit rate of `{adapter.interface}` is set elsewhere"
        elif any(other.is_open for other in self.hosts):
            why = "another host has the channel open"
        if why is not None:
            say(f"a host wants {bitrate} bit/s, which is refused: {why}")
            return REFUSED
        adapter.close()
        adapter.bitrate = bitrate
        return DONE

    def send(self, host: Host, line: str) -> bytes:
        message = message_of(line)
        if message is None or not host.is_open or host.only_listens:
            return REFUSED
        if (why := self.adapter.send(message)) is not None:
            if not self.is_failing:
                say(f"cannot send: {why}")
            self.is_failing = True
            return REFUSED
        self.is_failing = False
        self.heard(message, host)
        return b"Z\r" if message.is_extended_id else b"z\r"


def option(text: str) -> tuple[str, str]:
    name, sign, value = text.partition("=")
    if not (name.isidentifier() and sign):
        raise argparse.ArgumentTypeError(f"expected NAME=VALUE, found {text!r}")
    return name, value


def bitrate(text: str) -> int:
    if not text.isdecimal() or not 10_000 <= int(text) <= 1_000_000:
        raise argparse.ArgumentTypeError(f"expected 10000 to 1000000 bit/s, found {text!r}")
    return int(text)


def port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"expected 0 to 65535, found {text!r}")
    return int(text)


def arguments(given: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="odgen-bridge", description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("interface", metavar="INTERFACE", help="kind of adapter as python-can names it: pcan, kvaser, ixxat, vector, gs_usb, ...")
    parser.add_argument("channel", metavar="CHANNEL", help="which adapter, as python-can names it: PCAN_USBBUS1, 0, ...")
    parser.add_argument("--bitrate", type=bitrate, metavar="BIT/S", help="bit rate of the bus, such as 125000 [default: the host sets it]")
    parser.add_argument("--port", type=port, default=3333, help="TCP port on 127.0.0.1; 0 takes a free one [default: 3333]")
    parser.add_argument("--option", type=option, action="append", default=[], metavar="NAME=VALUE", help="another option of the interface, such as app_name=odgen")
    chosen = parser.parse_args(given)
    if chosen.interface not in can.VALID_INTERFACES:
        known = ", ".join(sorted(can.VALID_INTERFACES))
        parser.error(f"python-can has no interface {chosen.interface!r}; it has {known}")
    if chosen.bitrate is not None and chosen.interface.startswith("socketcan"):
        parser.error(f"the bit rate of `{chosen.interface}` is set elsewhere; leave out --bitrate")
    return chosen


def main(given: list[str] | None = None) -> int:
    chosen = arguments(given)
    # What drivers warn about is in the error that follows.
    logging.getLogger("can").setLevel(logging.CRITICAL)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    # A terminal that lacks a character shows it in another way.
    sys.stdout.reconfigure(errors="backslashreplace")
    adapter = Adapter(chosen.interface, chosen.channel, chosen.bitrate, dict(chosen.option))

    def ready(at: int) -> None:
        print(f"{chosen.interface} {chosen.channel} is at --slcan tcp:127.0.0.1:{at}", flush=True)

    try:
        why = asyncio.run(Bridge(adapter).run(chosen.port, ready))
    except Unusable as error:
        why = str(error)
    except KeyboardInterrupt:
        return 0
    if why is not None:
        say(why)
    return 1


if __name__ == "__main__":
    sys.exit(main())
