#!/usr/bin/env python3
"""Measure what generated dictionaries cost to compile: ours compared with those of two other projects.

    compile.py [--sizes 150 2000] [--contenders ours zencan canopen-rs] [--limit 300]
    compile.py --generators

Prints Markdown; what cargo prints goes to standard error. Measured is the one rustc that compiles a
crate of generated code and nothing else (`dictionaries/`), its dependencies built before: this script
puts itself between cargo and rustc (`RUSTC_WORKSPACE_WRAPPER`) and asks the system what that process
used. A rustc that runs longer than the limit is ended. `generate` is the time of the generator itself
in an unoptimised build script, as cargo builds it. With `--generators`: what it takes to build the
generators themselves, everything they depend on included, from nothing. The exit code is 1 when
something could not be built; nothing is judged. Needs a POSIX system.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Not that of `run.py`, whose dictionaries must not be compiled again because of a measurement here.
TARGET = HERE.parents[2] / "target" / "bench-runtime" / "compile"
SIZES = (150, 2000, 10000)
CONTENDERS = ("ours", "zencan", "canopen-rs")
# What a crate that uses a generator has in its Cargo.toml. The only zencan-macro there is belongs to zencan 0.0.1.
GENERATORS = {
    "od-macros": 'od-macros = {{ path = "{root}/od-macros" }}',
    "od-gen (build script)": 'od-gen = {{ path = "{root}/od-gen", default-features = false, features = ["format"] }}',
    "zencan-macro 0.0.1": 'zencan-macro = "=0.0.1"',
    "zencan-build 0.0.5": 'zencan-build = "=0.0.5"',
    "canopen-host 0.6.1": 'canopen-host = "=0.6.1"',
}
MISSING = {("canopen-rs", 10000): "left out: hours"}
# What the script passes to the wrapper, which is the script itself.
CRATE, LIMIT, RESULT = "BENCH_COMPILE_CRATE", "BENCH_COMPILE_LIMIT", "BENCH_COMPILE_RESULT"


class Failed(Exception):
    """Why something could not be built."""


@dataclass(frozen=True)
class Cost:
    """What a rustc used, or that it was stopped."""

    user: float = 0
    wall: float = 0
    megabytes: float = 0
    stopped: bool = False


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--sizes", type=int, nargs="+", choices=SIZES, default=[150, 2000])
    parser.add_argument("--contenders", nargs="+", choices=CONTENDERS, default=list(CONTENDERS))
    parser.add_argument("--limit", type=float, default=300, help="seconds for one rustc")
    parser.add_argument("--generators", action="store_true", help="build the generators themselves, from nothing")
    options = parser.parse_args()
    rustc = subprocess.run(["rustc", "--version"], check=False, cwd=HERE, text=True, stdout=subprocess.PIPE).stdout
    print(f"{rustc.strip()}, {platform.system()} {platform.machine()}, {os.cpu_count()} cores\n")
    if options.generators:
        return generators()
    print("| objects | contender | generate s | check: user s | wall s | peak MB | release: user s | wall s | peak MB |")
    print("|--:|---|--:|--:|--:|--:|--:|--:|--:|", flush=True)
    failed = False
    for size in sorted(options.sizes):
        for name in options.contenders:
            if why := MISSING.get((name, size)):
                print(f"| {size} | {name} | | {why} |" + " |" * 5, flush=True)
                continue
            try:
                print(line(name, size, options.limit), flush=True)
            except Failed as error:
                failed = True
                print(f"error: {error}", file=sys.stderr)
    return int(failed)


def generators() -> int:
    print("| generator | crates | user s | wall s |")
    print("|---|--:|--:|--:|", flush=True)
    cargo, failed = os.environ.get("CARGO", "cargo"), False
    TARGET.mkdir(parents=True, exist_ok=True)  # below the project, so that its version of Rust is used
    for name, dependency in GENERATORS.items():
        with tempfile.TemporaryDirectory(prefix="generator-", dir=TARGET) as folder:
            crate = Path(folder)
            (crate / "src").mkdir()
            (crate / "src" / "lib.rs").touch()
            manifest = '[package]\nname = "user"\nversion = "0.0.0"\nedition = "2024"\n[workspace]\n[dependencies]\n'
            manifest += dependency.format(root=HERE.parents[2]) + "\n"
            (crate / "Cargo.toml").write_text(manifest, encoding="utf-8")
            subprocess.run([cargo, "fetch"], check=False, cwd=crate, stdout=sys.stderr)
            before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, os.times().elapsed
            words = [cargo, "build", "--offline", "--target-dir", str(crate / "target"), "--message-format", "json-render-diagnostics"]
            done = subprocess.run(words, check=False, cwd=crate, text=True, stdout=subprocess.PIPE)
            wall = os.times().elapsed - start
            user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            if done.returncode != 0:
                failed = True
                print(f"error: {name} does not compile", file=sys.stderr)
                continue
            messages = map(json.loads, done.stdout.splitlines())
            built = {message["package_id"] for message in messages if message["reason"] == "compiler-artifact"}
            print(f"| {name} | {len(built) - 1} | {user:.1f} | {wall:.1f} |", flush=True)
    return int(failed)


def line(name: str, size: int, limit: float) -> str:
    seconds, check = built(["check"], name, size, limit)
    _, release = built(["build", "--release"], name, size, limit)
    cells = [str(size), name, f"{seconds:.2f}", *cost(check, limit), *cost(release, limit)]
    return "| " + " | ".join(cells) + " |"


def cost(used: Cost, limit: float) -> list[str]:
    if used.stopped:
        return [f"stopped after {limit:.0f} s", "", f"{used.megabytes:.0f}"]
    return [f"{used.user:.2f}", f"{used.wall:.2f}", f"{used.megabytes:.0f}"]


def built(command: list[str], name: str, size: int, limit: float) -> tuple[float, Cost]:
    """Builds the dependencies and the build script, and then the generated code, measured."""
    package = f"bench-{name}"
    cargo, profile = os.environ.get("CARGO", "cargo"), command[1:]
    clean = [cargo, "clean", "--quiet", "--target-dir", str(TARGET), "--package", package, *profile]
    subprocess.run(clean, check=False, cwd=HERE)
    words = [cargo, *command, "--target-dir", str(TARGET), "--package", package, "--features", f"{package}/size{size}"]
    with tempfile.TemporaryDirectory(prefix="bench-compile-") as folder:
        wrapper, result = Path(folder) / "rustc", Path(folder) / "result.json"
        wrapper.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{Path(__file__).resolve()}" --as-rustc "$@"\n', encoding="utf-8")
        wrapper.chmod(0o755)
        environment = {
            **os.environ,
            "RUSTC_WORKSPACE_WRAPPER": str(wrapper),
            CRATE: package.replace("-", "_"),
            LIMIT: str(limit),
            RESULT: str(result),
        }
        words += ["--message-format", "json-render-diagnostics"]
        done = subprocess.run(words, check=False, cwd=HERE, text=True, stdout=subprocess.PIPE, env=environment)
        if not result.is_file():
            raise Failed(f"{package} with {size} objects: cargo ended with {done.returncode}")
        used = Cost(**json.loads(result.read_text(encoding="utf-8")))
        if done.returncode != 0 and not used.stopped:
            raise Failed(f"{package} with {size} objects does not compile")
        messages = [json.loads(message) for message in done.stdout.splitlines() if message.startswith("{")]
        for message in messages:
            if message.get("reason") == "build-script-executed" and package in message["package_id"]:
                return float((Path(message["out_dir"]) / f"size{size}" / "seconds").read_text(encoding="utf-8")), used
        raise Failed(f"cargo does not say what the build script of {package} wrote")


def as_rustc(command: list[str]) -> int:
    """Replaces rustc: runs it, and notes what it used if it compiles the crate in question."""
    crate = command[command.index("--crate-name") + 1] if "--crate-name" in command else ""
    if crate != os.environ[CRATE]:
        os.execvp(command[0], command)
    limit = float(os.environ[LIMIT])
    process = subprocess.Popen(command, close_fds=False)  # the job server of cargo is one of them
    stop = threading.Timer(limit, process.kill)
    stop.start()
    start = os.times().elapsed
    _, status, used = os.wait4(process.pid, 0)
    wall = os.times().elapsed - start
    stop.cancel()
    code = os.waitstatus_to_exitcode(status)
    unit = 1024 * 1024 if sys.platform == "darwin" else 1024
    result = {"user": used.ru_utime, "wall": wall, "megabytes": used.ru_maxrss / unit, "stopped": code < 0 and wall >= limit}
    Path(os.environ[RESULT]).write_text(json.dumps(result), encoding="utf-8")
    return code if code >= 0 else 1


if __name__ == "__main__":
    sys.exit(as_rustc(sys.argv[2:]) if sys.argv[1:2] == ["--as-rustc"] else main())
