#!/usr/bin/env python3
"""Check generated EDS and DCF files with five CANopen tools of other people.

    run.py [--out CACHE] [--eds-dir generated/eds] [--dump generated/*.json] [--node 1] [--values FILE]
    run.py [--out CACHE] --install

Installs the tools into the cache, reads KEY.eds and KEY.dcf of every device in the dumps with each of
them and compares what they read with the dump. With --values it reads KEY.dcf only, which must hold the
parameter values of that file: a line `INDEX.SUB VALUE` each, raw numbers or text. Exit code 0: everything
was read and agrees; 1: a difference, or a file missing or too many; 3: a tool could not be installed, so
part was not checked.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PYTHON_TOOLS = {
    "python-canopen": "python_canopen.py",
    "dcfchk": "lely_dcfchk.py",
    "eds-utils": "eds_utils_reader.py",
}


class NotInstalled(Exception):
    """Why a tool cannot be run."""


@dataclass(frozen=True)
class Reader:
    name: str
    command: list[str]
    options: tuple[str, ...] = ()


@dataclass(frozen=True)
class Outcome:
    ok: bool
    text: str
    seconds: float


def installed(cache: Path) -> tuple[list[Reader], dict[str, str]]:
    """The readers that can run, and for the others why not."""
    readers: list[Reader] = []
    missing: dict[str, str] = {}
    for names, install in (
        (tuple(PYTHON_TOOLS), install_python),
        (("node-canopen",), install_node),
        (("canopen-host",), install_rust),
    ):
        try:
            readers += install(cache)
        except NotInstalled as error:
            missing |= {name: str(error) for name in names}
    return readers, missing


def install_python(cache: Path) -> list[Reader]:
    folder = cache / "venv"
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    requirements = HERE / "requirements.txt"
    if is_stale(folder, [requirements], sys.version):
        shutil.rmtree(folder, ignore_errors=True)
        command([sys.executable, "-m", "venv", str(folder)])
        pip = [str(python), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        command([*pip, "-r", str(requirements)])
        set_stamp(folder, [requirements], sys.version)
    return [Reader(name, [str(python), str(HERE / script)]) for name, script in PYTHON_TOOLS.items()]


def install_node(cache: Path) -> list[Reader]:
    folder = cache / "npm"
    files = [HERE / name for name in ("package.json", "package-lock.json", ".npmrc")]
    version = command(["node", "--version"])
    if is_stale(folder, files, version):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for file in files:
            shutil.copy(file, folder)
        # no install scripts: a dependency would build a native module that the EDS reader never loads
        npm = shutil.which("npm") or "npm"
        command([npm, "ci", "--omit=dev", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder)
        set_stamp(folder, files, version)
    options = ("--reader", str(folder / "node_modules"))
    return [Reader("node-canopen", [sys.executable, str(HERE / "node_canopen.py")], options)]


def install_rust(cache: Path) -> list[Reader]:
    target = cache / "cargo"
    manifest = HERE / "canopen-host" / "Cargo.toml"
    build = ["cargo", "build", "--release", "--locked", "--quiet"]
    command([*build, "--manifest-path", str(manifest), "--target-dir", str(target)])
    program = target / "release" / ("read-eds.exe" if sys.platform == "win32" else "read-eds")
    options = ("--reader", str(program))
    return [Reader("canopen-host", [sys.executable, str(HERE / "canopen_host.py")], options)]


def command(argv: list[str], cwd: Path | None = None) -> str:
    try:
        done = subprocess.run(argv, cwd=cwd, capture_output=True, text=True, check=False)
    except OSError as error:
        raise NotInstalled(f"{argv[0]}: {error.strerror}") from error
    if done.returncode != 0:
        last = (done.stderr or done.stdout).strip().splitlines()[-3:]
        raise NotInstalled(f"`{Path(argv[0]).name} {' '.join(argv[1:3])} ..` failed: {' / '.join(last)}")
    return done.stdout.strip()


def digest(files: list[Path], more: str) -> str:
    return hashlib.sha256(b"".join(file.read_bytes() for file in files) + more.encode()).hexdigest()


def is_stale(folder: Path, files: list[Path], more: str) -> bool:
    stamp = folder / "stamp"
    return not stamp.is_file() or stamp.read_text() != digest(files, more)


def set_stamp(folder: Path, files: list[Path], more: str) -> None:
    folder.joinpath("stamp").write_text(digest(files, more))


def check(reader: Reader, file: Path, dump: Path, device: str, node: int) -> Outcome:
    argv = [*reader.command, str(file), str(dump), device, "--node", str(node), *reader.options]
    start = time.monotonic()
    done = subprocess.run(argv, capture_output=True, text=True, check=False)
    ok = done.returncode == 0 and not done.stderr
    return Outcome(ok, (done.stdout + done.stderr).rstrip(), time.monotonic() - start)


def with_values(dump: Path, values: Path, copy: Path) -> Path:
    """A copy of a dump of one device in which the entries carry their configured value as `dcf`."""
    model = json.loads(dump.read_text(encoding="utf-8"))
    (device,) = model["devices"]
    entries = {
        (int(obj["index"], 16), entry["sub"]): entry for obj in device["objects"] for entry in obj["entries"]
    }
    for line in values.read_text(encoding="utf-8").splitlines():
        place, text = line.split(" ", 1)
        index, sub = place.split(".")
        entries[int(index, 16), int(sub)]["dcf"] = {"raw": raw(text), "text": text}
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(json.dumps(model), encoding="utf-8")
    return copy


def raw(text: str) -> int | float | None:
    """The number, if the text is one; whether it is meant as one is for the entry's type to say."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return None


def wrong_files(folder: Path, wanted: list[Path]) -> list[str]:
    there = {path for path in folder.glob("*") if path.suffix.lower() in (".eds", ".dcf")}
    lines = [f"{path}: not there" for path in wanted if path not in there]
    return lines + [f"{path}: of no device in the dumps" for path in sorted(there - set(wanted))]


def run(args: argparse.Namespace) -> int:
    dumps, suffixes = args.dump or sorted((ROOT / "generated").glob("*.json")), (".eds", ".dcf")
    if args.values:
        (dump,) = dumps
        dumps, suffixes = [with_values(dump, args.values, args.out / "with-values.json")], (".dcf",)
    wanted = [
        (args.eds_dir / f"{device['key']}{suffix}", dump, device["key"])
        for dump in dumps
        for device in json.loads(dump.read_text(encoding="utf-8"))["devices"]
        for suffix in suffixes
    ]
    problems = wrong_files(args.eds_dir, [file for file, _, _ in wanted])
    readers, missing = installed(args.out.resolve())
    work = [(reader, *rest) for reader in readers for rest in wanted if rest[0].is_file()]
    with ThreadPoolExecutor(max_workers=2) as pool:
        outcomes = list(pool.map(lambda one: check(*one, args.node), work))
    for outcome in outcomes:
        print(f"{'ok  ' if outcome.ok else 'FAIL'} {outcome.text} [{outcome.seconds:.2f} s]")
    return conclude(outcomes, problems, missing, len(wanted))


def conclude(outcomes: list[Outcome], problems: list[str], missing: dict[str, str], files: int) -> int:
    failed = sum(not outcome.ok for outcome in outcomes) + len(problems)
    for line in problems:
        print(f"FAIL {line}")
    print("\nNot run:")
    for name, reason in missing.items():
        print(f"  {name}, on {files} files: {reason}")
    if not missing:
        print("  nothing was left out")
    print(f"\n{sum(o.ok for o in outcomes)} passed, {failed} failed, {len(missing) * files} skipped")
    if failed or not outcomes:
        return 1
    return 3 if missing else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "readers", help="cache of the tools")
    parser.add_argument("--eds-dir", type=Path, default=ROOT / "generated" / "eds")
    parser.add_argument("--dump", type=Path, nargs="+", help="default: all of generated/")
    parser.add_argument("--node", type=int, default=1)
    parser.add_argument("--values", type=Path, help="values that the DCF of the only device must hold")
    parser.add_argument("--install", action="store_true", help="install the tools, and read nothing")
    args = parser.parse_args()
    if args.install:
        return 3 if installed(args.out.resolve())[1] else 0
    return run(args)


if __name__ == "__main__":
    sys.exit(main())
