#!/usr/bin/env python3
"""Compare what `odgen check` predicts for five readers with what they do.

    predictions.py [FOLDER] [--odgen PROGRAM] [--out CACHE] [--sample]

A file is predicted to be refused by a reader if a finding about it, also a note, names the reader. Every reader
has to agree on at least 97 of 100 files of FOLDER, by default those that mutate.py makes. With `--sample`, it has to agree on all of a
sample of these, and to refuse some of them, but not all.
Exit code 0: they do; 1: one does not; 3: a reader could not be installed and was not asked.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

from mutate import write
from run import ROOT, installed
from verdicts import Verdicts, files_in, verdicts

ENOUGH, ENOUGH_OF_SAMPLE = 97, 100
SHOWN = 10
Predictions = dict[str, dict[str, list[str]]]


def predictions(program: Path, folder: Path, files: list[Path]) -> Predictions:
    """The codes of the findings that name a reader: by file, then by reader."""
    command = [program, "check", "--format", "json", "--notes", "--all", folder]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    found: Predictions = {file.name: defaultdict(list) for file in files}
    for line in done.stderr.splitlines():
        if not line.startswith("{"):
            raise SystemExit(f"odgen: {line}")
        finding = json.loads(line)
        for reader in finding.get("minded-by", []):
            name = Path(finding["labels"][0]["file"]).name
            if finding["code"] not in found[name][reader]:
                found[name][reader].append(finding["code"])
    return found


def wrong(reader: str, said: Verdicts, foretold: Predictions) -> list[str]:
    """The files on which they disagree, with what each side says."""
    lines = []
    for file, readers in said.items():
        codes, reason = foretold[file].get(reader, []), readers[reader]
        if codes and reason is None:
            lines.append(f"  {file}: accepted, though {', '.join(codes)} name it")
        if not codes and reason is not None:
            lines.append(f"  {file}: refused, which no finding predicted: {reason}")
    return lines


def compare(said: Verdicts, foretold: Predictions, names: list[str], enough: int) -> list[str]:
    """Prints a table; the readers that do what was predicted on fewer than so many of 100 files, or say the same of all of a sample."""
    files, short = len(said), []
    print(f"{'reader':<16}{'files':>6}{'refused':>9}{'agreed':>8}")
    for name in names:
        lines = wrong(name, said, foretold)
        refused = sum(readers[name] is not None for readers in said.values())
        share = 100 * (files - len(lines)) / files
        verdict = f"  under {enough} %" if share < enough else ""
        if enough == ENOUGH_OF_SAMPLE and refused in (0, files):
            verdict = "  says the same of all"
        print(f"{name:<16}{files:>6}{refused:>9}{share:>7.1f}%{verdict}")
        for line in lines[:SHOWN]:
            print(line)
        if len(lines) > SHOWN:
            print(f"  and {len(lines) - SHOWN} more")
        short += [name] * bool(verdict)
    return short


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--odgen", type=Path, required=True, help="the program")
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "readers", help="cache of the tools")
    parser.add_argument("--sample", action="store_true", help="take a sample of the files that mutate.py makes, of which all have to agree")
    args = parser.parse_args()
    readers, missing = installed(args.out.resolve())
    folder = args.folder or args.out / "mutated"
    if not args.folder:
        write(folder, sample=args.sample)
    files = files_in(folder)
    said = verdicts(files, readers)
    names = [reader.name for reader in readers]
    short = compare(said, predictions(args.odgen, folder, files), names, ENOUGH_OF_SAMPLE if args.sample else ENOUGH)
    for name, reason in missing.items():
        print(f"{name} was not asked: {reason}")
    print(f"\n{len(names) - len(short)} passed, {len(short)} failed, {len(missing)} skipped")
    return 1 if short or not names else 3 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
