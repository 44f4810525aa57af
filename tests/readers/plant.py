"""Build a plant, and read every DCF of it with lely's dcfchk and python-canopen, and its workbook with openpyxl.

    plant.py --odgen FILE

The values that python-canopen finds are compared with `values.csv`, and what else it finds is not set by a level. The
cells of the workbook are those of `values.csv`, and none of them is a date.
"""

from __future__ import annotations

import argparse
import configparser
import csv
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import canopen
import openpyxl
from canopen.objectdictionary import ODVariable

from compare import Job
from lely_dcfchk import dcfchk

ROOT = Path(__file__).resolve().parent.parent.parent
PITCH = "pitch-control-system"
PLANT = """\
od-plant: 1
title: Test farm
devices: {pmm: PITCH.od.yaml, pmc: PITCH.od.yaml}
types:
  T:
    bit-rate: 500
    positions: {A: {pmm: 1, pmc: 11}, B: {pmm: 2, pmc: 12}, C: {pmm: 3, pmc: 13}}
    parameters: {pmc: {EFC target position: 90.00 °, 0x6065: 500}, pmm: {0x1017: 500}}
sites:
  North:
    type: T
    machines:
      1..4: {}
      2: {serial: "1.10", comment: =2026-1-2, parameters: {pmc: {EFC target position: 89.00 °}}}
      3: {serial: "0017", comment: '<5 & "6"', positions: {B: {pmc: {node: 22, serial: 4711, parameters: {EFC target position: 88.00 °}}}}}
"""


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--odgen", required=True, type=Path)
    odgen = parser.parse_args().odgen.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for path in (ROOT / "od-spec" / "devices").glob(f"{PITCH}*.yaml"):
            shutil.copy(path, folder)
        (folder / "plant.yaml").write_text(PLANT.replace("PITCH", PITCH), encoding="utf-8")
        subprocess.run([odgen, "plant", "build", "plant.yaml", "--out", "out"], cwd=folder, check=True)
        return judge(folder / "out")


def judge(out: Path) -> int:
    with (out / "values.csv").open(encoding="utf-8-sig", newline="") as text:
        rows = list(csv.DictReader(text, delimiter=";"))
    complaints, nodes, values = workbook(out, rows), 0, 0
    for nodelist in sorted(out.glob("*/*/nodelist.cpj")):
        topology = configparser.ConfigParser(interpolation=None)
        topology.optionxform = str  # type: ignore[assignment]
        topology.read(nodelist, encoding="ascii")
        listed = topology["Topology"]
        present = [int(key[4:-7]) for key in listed if key.startswith("Node") and key.endswith("Present")]
        assert len(present) == int(listed["Nodes"], 0), nodelist
        site, machine = nodelist.parts[-3:-1]
        for node in present:
            nodes += 1
            path = nodelist.with_name(listed[f"Node{node}DCFName"])
            complaints += [f"{path}: {said}" for said in dcfchk(Job(path, node, None))]
            od = canopen.import_od(str(path))
            position, device = path.stem.split("-")
            own = [row for row in rows if (row["site"], row["machine"], row["position"], row["device"]) == (site, machine, position, device)]
            if od.node_id != node or {int(row["node-ID"]) for row in own} != {node}:
                complaints.append(f"{path}: node {od.node_id}, listed as {node}")
            wanted = {row["entry"]: int(row["raw value"]) for row in own if row["entry"]}
            found = set_values(od)
            values += len(found)
            if found != wanted:
                complaints.append(f"{path}: {found}, in the table {wanted}")
    for complaint in complaints:
        print(complaint)
    print(f"{nodes} DCF files of a plant, {values} values: {len(complaints)} complaints")
    return 1 if complaints or nodes != 24 or values == 0 else 0


NUMBERS = ("node-ID", "bit rate", "node serial", "raw value")


def workbook(out: Path, rows: list[dict[str, str]]) -> list[str]:
    """What a spreadsheet sees: texts as texts, numbers as numbers, and the cells of the other table."""
    complaints = []
    sheet = openpyxl.load_workbook(out / "values.xlsx").active
    titles, *cells = sheet.iter_rows()
    names = [cell.value for cell in titles]
    if names != list(rows[0]) or len(cells) != len(rows):
        complaints.append(f"values.xlsx: {len(cells)} rows of {names}")
    for row, expected in zip(cells, rows):
        for name, cell in zip(names, row):
            kind = int if name in NUMBERS else str
            is_right = cell.value is None or isinstance(cell.value, kind) and (kind is int or cell.number_format == "@")
            shown = "" if cell.value is None else str(cell.value)
            # A text that looks like a formula has a mark in the other table.
            if not is_right or cell.is_date or shown != expected[name].removeprefix("'"):
                complaints.append(f"values.xlsx {cell.coordinate}: {cell.value!r}, expected {expected[name]!r}")
    return complaints


def set_values(od: canopen.ObjectDictionary) -> dict[str, int]:
    """The parameter values, by entry as the table names them."""
    found = {}
    for index, entry in od.items():
        variables = [(None, entry)] if isinstance(entry, ODVariable) else list(entry.items())
        for sub, variable in variables:
            if variable.value is not None and variable.value != variable.default:
                found[f"{index:04X}h" if sub is None else f"{index:04X}h.{sub}"] = variable.value
    return found


if __name__ == "__main__":
    sys.exit(main())
