#!/usr/bin/env python3
"""Write a synthetic specification of a given size, for measurements.

    synthetic.py OBJECTS [--out FILE]

The same size always gives the same bytes. Of every ten objects six are scalars, two are records of
four members, one is an array of eight and one a string; half of them lie in the manufacturer area,
half in the profile area. Four 16-bit aliases and eight PDOs come on top. `odgen check` has nothing
to say about the result.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

MANUFACTURER_AREA = 0x2000
PROFILE_AREA = 0x6000
AREA_SIZE = 0x4000
ALIAS_AREA = 0x5FF0
MOST_OBJECTS = 2 * (AREA_SIZE - 0x10)  # the aliases take the end of the manufacturer area
WIDEST_GAP = 16
BLOCK = 10
OBJECTS_PER_TYPE = 50

HEAD = """\
# Synthetic: written by tests/bench/synthetic.py {count}
od-spec: 1
title: Synthetic controller of {count} objects
languages: [en]
revision: {{number: "1.00", date: 2024-01-31}}
vendor: {{name: Example Works, number: 0x123}}
uses: [cia301]
devices:
  controller:
    name: Synthetic controller
    product-name: SC{count}
    product: {count}
    bit-rates: [125, 250, 500, 1000]
    device-type: 0x00000000
    features: [device type, identity, device name, heartbeat producer, emergency, sync consumer, store parameters, restore defaults, sdo server]
    eds: {{description: Measures how fast a compiler is, created: 2024-01-31 12:00, created-by: Example Works}}
    about: A device that is not built, with as many objects as a measurement needs.
units:
  millivolt: {{symbol: mV, base: 1/1000 V}}
  decicelsius: {{symbol: °C, scale: 1/10}}
  millisecond: {{symbol: ms, base: 1/1000 s}}
  revolution per minute: {{symbol: rpm}}
  position unit: {{symbol: PU, base: 1/100 °}}
types:
"""

TYPES = """\
  mode {n}:
    base: unsigned8
    about: Operating modes of channel group {n}.
    values:
      0: {{name: idle, about: Nothing is driven.}}
      1: {{name: manual, about: The operator moves the channel with the buttons.}}
      2: {{name: automatic, about: The sequence moves the channel.}}
      0x10: {{name: calibration, about: The zero point is searched., supported: no}}
  status {n}:
    base: unsigned16
    about: Status bits of channel group {n}.
    bits:
      0: ok
      1: {{name: warning, about: A value is beyond its warning limit.}}
      2: {{name: fault, about: "The channel was switched off; the error register shows why."}}
      3: {{name: limit active, about: The output is limited.}}
      4..6: {{name: step, about: Step of the sequence., values: {{0: stopped, 1: starting, 2: running, 3: stopping}}}}
      7: reserved
      8..15: {{reserved: yes, about: Read as 0.}}
"""

PDOS = """\
pdos:
  controller:
    receive:
      1: {{map: [0x{setpoint:04X}]}}
      2: {{transmission: 1, map: [0x{setpoint:04X}, 0x{speed:04X}]}}
      3: {{valid: no, map: [0x{record:04X}.1, 0x{record:04X}.3]}}
      4: {{valid: no, map: [0x{mode:04X}]}}
    transmit:
      1: {{no-rtr: yes, map: [0x{status:04X}]}}
      2: {{no-rtr: yes, transmission: 1, map: [0x{status:04X}, 0x{temperature:04X}]}}
      3: {{no-rtr: yes, valid: no, event-timer: 100, map: [0x{record:04X}.4, 0x{status:04X}]}}
      4: {{no-rtr: yes, valid: no, map: [0x{array:04X}.1, 0x{array:04X}.2, 0x{array:04X}.3, 0x{array:04X}.4]}}
"""


def specification(count: int) -> str:
    if not BLOCK <= count <= MOST_OBJECTS:
        raise ValueError(f"a specification can have {BLOCK} to {MOST_OBJECTS} objects, not {count}")
    places = indices(count)
    types = max(1, count // OBJECTS_PER_TYPE)
    parts = [HEAD.format(count=count)]
    parts += (TYPES.format(n=n) for n in range(1, types + 1))
    parts.append("objects:\n")
    parts += (described(number, index, number // OBJECTS_PER_TYPE % types + 1) for number, index in enumerate(places))
    parts += aliases(places)
    setpoint, temperature, _, speed, mode, status, record, _, array, _ = places[:BLOCK]
    parts.append(
        PDOS.format(
            setpoint=setpoint,
            temperature=temperature,
            speed=speed,
            mode=mode,
            status=status,
            record=record,
            array=array,
        )
    )
    return "".join(parts)


def indices(count: int) -> list[int]:
    """Indices in ascending order, the first half in one area and the rest in the other."""
    lower = count - count // 2
    gap = min(WIDEST_GAP, (AREA_SIZE - 0x10) // lower)
    return [
        MANUFACTURER_AREA + number * gap if number < lower else PROFILE_AREA + (number - lower) * gap
        for number in range(count)
    ]


def described(number: int, index: int, kind: int) -> str:
    """Object number `number`: which of the ten shapes it has depends on the last digit."""
    channel = number // BLOCK + 1
    shape = SHAPES[number % BLOCK]
    return f"  0x{index:04X}:\n" + shape.format(
        channel=channel,
        kind=kind,
        low=channel % 50,
        middle=50 + channel % 100,
        high=1000 + channel % 500,
        mask=channel * 0x9E3779B1 & 0xFFFFFFFF,
    )


SHAPES = (
    """\
    name: channel {channel} nominal voltage
    type: unsigned16
    unit: millivolt
    access: rww
    pdo: receive
    stored: application
    min: {low}
    max: {high} mV
    default: {middle}
    about: >-
      Voltage that channel {channel} drives while the mode is automatic. A change is taken over
      at the start of the next control cycle.
""",
    """\
    name: channel {channel} temperature
    type: integer16
    unit: decicelsius
    access: ro
    pdo: transmit
    special: {{-32768: short circuit, 32767: wire break}}
    about: Temperature at the output stage of channel {channel}.
""",
    """\
    name: channel {channel} output mask
    type: unsigned32
    access: rw
    stored: application
    default: 0x{mask:08X}
    about: Outputs that follow channel {channel}, one bit each.
""",
    """\
    name: channel {channel} target speed
    type: integer32
    unit: revolution per minute
    access: rww
    pdo: receive
    min: -{high}
    max: {high} rpm
    default: -{low}
    about: "Speed to go to; negative turns the other way."
""",
    """\
    name: channel {channel} mode
    type: mode {kind}
    access: rww
    pdo: receive
    default: manual
    about: How channel {channel} is commanded.
""",
    """\
    name: channel {channel} status
    type: status {kind}
    access: ro
    pdo: transmit
    about: State of channel {channel}, refreshed every control cycle.
""",
    """\
    name: channel {channel} controller
    about: Speed controller of channel {channel}.
    record:
      1: {{name: gain, type: unsigned16, access: rww, pdo: receive, stored: application, default: {middle}, max: {high}, about: Proportional gain.}}
      2: {{name: integration time, type: unsigned16, unit: millisecond, access: rw, stored: application, default: {high} ms, about: 0 switches the integral part off.}}
      3: {{name: output limit, type: integer32, unit: position unit, access: rww, pdo: receive, min: -{high}, max: {high}, default: {low}, about: Largest output.}}
      4: {{name: output, type: integer32, unit: position unit, access: ro, pdo: transmit, about: Present output.}}
""",
    """\
    name: channel {channel} supervision
    stored: application
    access: rw
    record:
      1: {{name: warning limit, type: integer16, unit: decicelsius, default: {middle}.0 °C, about: Temperature of the warning.}}
      2: {{name: fault limit, type: integer16, unit: decicelsius, default: {middle}.5 °C, about: Temperature that switches off.}}
      3: {{name: delay, type: unsigned32, unit: millisecond, min: {low}, max: 60000, default: {high}, about: Time before the reaction.}}
      4: {{name: reaction, type: mode {kind}, default: idle, about: Mode to fall back to.}}
""",
    """\
    name: channel {channel} samples
    about: Latest measured values, newest first.
    array: {{count: 8, name: "sample {{n}}", type: unsigned16, unit: millivolt, access: ro, pdo: transmit, about: One measured value.}}
""",
    """\
    name: channel {channel} label
    type: visible-string
    capacity: 16
    access: rw
    stored: application
    default: CH-{channel:05}
    about: Name of the channel on the operator's panel.
""",
)


def aliases(places: list[int]) -> Iterator[str]:
    """16-bit views of the first objects that are wider: target speeds and output masks."""
    wide = [index for number, index in enumerate(places) if SHAPES[number % BLOCK] is SHAPES[3]]
    for number, index in enumerate(wide[:4]):
        yield (
            f"  0x{ALIAS_AREA + number:04X}: {{alias: 0x{index:04X}, type: integer16, "
            f"about: Short form of 0x{index:04X} for masters with 16-bit variables.}}\n"
        )


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("objects", type=int)
    parser.add_argument("--out", type=Path, help="file to write; standard output without it")
    options = parser.parse_args()
    try:
        text = specification(options.objects)
    except ValueError as error:
        parser.error(str(error))
    if options.out:
        options.out.write_text(text, encoding="utf-8", newline="\n")
    else:
        sys.stdout.reconfigure(encoding="utf-8", newline="\n")  # type: ignore[union-attr]
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
