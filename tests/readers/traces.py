#!/usr/bin/env python3
"""Read the traces that python-can writes: `odgen decode` reports the same of a `.trc`, an `.asc` and a log of `candump`.

    traces.py --odgen target/debug/odgen

Frames of all lengths, remote frames, identifiers of 29 bits and error frames are written three times. Exit code 1 when anything
differs.
"""

from __future__ import annotations

import argparse
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import can

SPEC = Path("od-spec/devices/pitch-control-system.od.yaml")
# What a line reports of a frame, after what the trace says of time and bus.
TOLD = re.compile(r"(?:^|  )([0-9A-F]{3}h  .*|[0-9A-F]{8}h  .*|error frame: .*)$")


def frames() -> list[can.Message]:
    """Frames as a node and its master send them, and some of anything."""
    one = random.Random(301)
    made = [
        (0x000, bytes([1, 0])), (0x080, b""), (0x085, bytes([0x10, 0x23, 1, 0, 0, 0, 0, 0])), (0x705, bytes([5])),
        (0x605, bytes.fromhex("4000100000000000")), (0x585, bytes.fromhex("4300100091010200")),
        (0x7E5, bytes.fromhex("11C8000000000000")), (0x7E4, bytes.fromhex("1101000000000000")),
    ]
    made += [(one.randrange(0x800), one.randbytes(one.randrange(9))) for _ in range(500)]
    messages = [can.Message(arbitration_id=cob_id, data=data, is_extended_id=False) for cob_id, data in made]
    messages += [can.Message(arbitration_id=one.randrange(1 << 29), data=one.randbytes(4)) for _ in range(50)]
    messages += [can.Message(arbitration_id=0x700 + node, is_remote_frame=True, dlc=0, is_extended_id=False) for node in range(1, 20)]
    for at, message in enumerate(messages):
        message.timestamp, message.channel, message.is_rx = 1_700_000_000 + at / 1000, 0, at % 3 > 0
    return messages


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--odgen", required=True, type=Path)
    odgen = arguments.parse_args().odgen.resolve()
    messages = frames()
    data = [message for message in messages if not message.is_remote_frame]
    errors = [can.Message(is_error_frame=True, timestamp=1_700_000_001, channel=0)]
    told: dict[str, list[str]] = {}
    with tempfile.TemporaryDirectory() as directory:
        # python-can writes neither remote frames nor error frames into a `.trc`.
        for kind, writer, written in [
            (".log", can.CanutilsLogWriter, messages + errors),
            (".asc", can.ASCWriter, messages + errors),
            (".trc", can.TRCWriter, data),
        ]:
            path = Path(directory) / f"trace{kind}"
            with writer(str(path)) as out:
                for message in written:
                    out.on_message_received(message)
            command = [odgen, "decode", SPEC, "--node", "5=pmc", "--trace", path]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                print(f"{kind}: exit code {done.returncode}\n{done.stderr}")
                return 1
            told[kind] = [found.group(1) for line in done.stdout.splitlines() if (found := TOLD.search(line))]
            if len(told[kind]) != len(written):
                print(f"{kind}: {len(told[kind])} lines about {len(written)} frames")
                return 1
    problems = [
        f"{kind}: {line!r}, the log says {log!r}"
        for kind in (".asc", ".trc")
        for log, line in zip(told[".log"], told[kind])
        if log != line
    ]
    print("\n".join(problems[:20]))
    print(f"traces of python-can: {len(messages)} frames in 3 formats, {len(problems)} differences")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
