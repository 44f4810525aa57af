"""Read entries of a node with python-canopen, or with a bare socket, for reading.py: a line `NAME ENTRIES SECONDS` for each time.

    canopen_reads.py entries ADDRESS RUNS NODE=EDS...
    canopen_reads.py lengths ADDRESS RUNS NODE=EDS

`entries` reads all entries that can be read and written: by python-canopen, and with a socket that sends the request of each and waits for the
end of its transfer, which is as fast as the other side allows. `lengths` reads the entries of 2000h to 5FFFh one by one, in segments and in
blocks: `segments BYTES SECONDS`.
"""

import socket
import sys
import time

import can
import canopen
from canopen.objectdictionary.eds import import_eds

COMMANDS = range(0x1010, 0x1012)


def variables(dictionary: canopen.ObjectDictionary) -> list[canopen.objectdictionary.ODVariable]:
    parts = (one if hasattr(one, "subindices") else {0: one} for one in dictionary.values())
    return [entry for part in parts for entry in part.values()]


# A machine that others keep busy is no silent node.
canopen.sdo.SdoClient.RESPONSE_TIMEOUT = 60


def network(address: str) -> canopen.Network:
    network = canopen.Network(can.Bus(interface="slcan", channel=f"socket://{address}", bitrate=500_000, sleep_after_open=0))
    network.notifier = can.Notifier(network.bus, network.listeners, 0.1)
    return network


def told(name: str, count: int, start: float) -> None:
    print(f"{name} {count} {time.perf_counter() - start:.9f}", flush=True)


def all_entries(address: str, runs: int, nodes: dict[int, canopen.ObjectDictionary]) -> None:
    wanted = [
        (node, entry.index, entry.subindex)
        for node, dictionary in nodes.items()
        for entry in variables(dictionary)
        if entry.access_type == "rw" and entry.index not in COMMANDS and entry.data_type != canopen.objectdictionary.DOMAIN
    ]
    for _ in range(runs):
        with network(address) as bus:
            clients = {node: bus.add_node(canopen.RemoteNode(node, dictionary)) for node, dictionary in nodes.items()}
            start = time.perf_counter()
            for node, index, sub in wanted:
                clients[node].sdo.upload(index, sub)
            told("python-canopen", len(wanted), start)
        with socket.create_connection(tuple(address.rsplit(":", 1))) as stream:
            stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            bare(stream, wanted)


def bare(stream: socket.socket, wanted: list[tuple[int, int, int]]) -> None:
    """Uploads in segments, without a look at what comes except for the end of each."""
    came = b""

    def asked(node: int, data: bytes) -> bytes:
        nonlocal came
        stream.sendall(b"t%03X8%s\r" % (0x600 + node, data.hex().upper().encode()))
        while True:
            line, end, rest = came.partition(b"\r")
            if not end:
                came += stream.recv(4096)
                continue
            came = rest
            if line.startswith(b"t%03X8" % (0x580 + node)):
                return bytes.fromhex(line[-16:].decode())

    stream.sendall(b"O\r")
    start = time.perf_counter()
    for node, index, sub in wanted:
        answer = asked(node, bytes([0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0]))
        toggle = 0x60
        # In segments, if the first answer has not the value or a refusal; until one is the last.
        is_over = answer[0] & 0x02 != 0 or answer[0] == 0x80
        while not is_over:
            answer = asked(node, bytes([toggle, 0, 0, 0, 0, 0, 0, 0]))
            toggle ^= 0x10
            is_over = answer[0] & 0x01 != 0 or answer[0] == 0x80
    told("bare", len(wanted), start)


def lengths(address: str, runs: int, nodes: dict[int, canopen.ObjectDictionary]) -> None:
    [(node, dictionary)] = nodes.items()
    with network(address) as bus:
        client = bus.add_node(canopen.RemoteNode(node, dictionary))
        for entry in (entry for entry in variables(dictionary) if entry.index in range(0x2000, 0x6000)):
            for name, in_blocks in (("segments", False), ("blocks", True)):
                for _ in range(runs):
                    start = time.perf_counter()
                    with client.sdo.open(entry.index, entry.subindex, "rb", buffering=4096, block_transfer=in_blocks) as file:
                        count = len(file.read())
                    told(name, count, start)


def main() -> None:
    what, address, runs, *nodes = sys.argv[1:]
    files = (text.split("=", 1) for text in nodes)
    dictionaries = {int(node): import_eds(file, int(node)) for node, file in files}
    {"entries": all_entries, "lengths": lengths}[what](address, int(runs), dictionaries)


if __name__ == "__main__":
    main()
