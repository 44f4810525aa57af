#!/usr/bin/env python3
"""Build firmware for thumbv7em-none-eabi, print how large it is, run it in QEMU.

    run.py sizes [NAME ...]                  Markdown table of sections, of all programs in firmware/src/size
    run.py test [--timeout 30] [NAME ...]    run all programs in firmware/src/test

A NAME picks a program from either folder. Nothing is skipped: what is missing on the machine is named.

The target's core library is taken from the first that there is of

1. the default toolchain, after `rustup target add thumbv7em-none-eabi`;
2. /usr/bin/rustc with the library's sources (Debian: rustc-web, cargo-web, rust-web-src), which
   builds core with the unstable `-Z build-std` and with this workspace's profile.

The linker is the toolchain's rust-lld, or arm-none-eabi-ld where there is none. Sizes depend on
these, so compare numbers of one toolchain only; `sizes` says which it was.

The exit code is 0 when all went well, 1 when a build or a program failed or did not end in time,
3 when a tool is missing.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import struct
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TARGET = "thumbv7em-none-eabi"
LINKER = "arm-none-eabi-ld"
QEMU = "qemu-system-arm"
BOARD = ["-machine", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "none"]
SEMIHOSTING = ["-semihosting-config", "enable=on,target=native"]
SYSTEM = Path("/usr/bin")  # where a distribution has its Rust
SECTIONS = [".vector_table", ".text", ".rodata", ".data", ".bss"]

INSTALL_RUST = f"""no Rust toolchain here can build for {TARGET}; install one of
  rustup target add {TARGET}                         (in this folder)
  apt-get install rustc-web cargo-web rust-web-src   (Debian)"""
INSTALL_LINKER = f"""no linker for {TARGET}: the toolchain has no rust-lld, and {LINKER} is not there; install
  apt-get install binutils-arm-none-eabi   (Debian)"""
INSTALL_QEMU = f"""{QEMU} is not there; install
  apt-get install qemu-system-arm   (Debian)"""


class Failed(Exception):
    """Why something went wrong."""


class Missing(Exception):
    """What has to be installed."""


@dataclass
class Toolchain:
    cargo: str
    rustc: str
    sysroot: Path
    flags: list[str] = field(default_factory=list)
    environment: dict[str, str] = field(default_factory=lambda: dict(os.environ))

    def describe(self) -> str:
        version = output([self.rustc, "--version"], self.environment)
        core = "core built from source" if self.flags else "core as shipped"
        return f"{version}, {core}, linked with {'rust-lld' if has_lld(self.sysroot) else LINKER}"


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    commands = parser.add_subparsers(dest="command", required=True)
    sizes = commands.add_parser("sizes", help="print the sizes of the programs' sections")
    test = commands.add_parser("test", help="run programs in QEMU")
    test.add_argument("--timeout", type=float, default=30, help="seconds for one program")
    for command in (sizes, test):
        command.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    try:
        if options.command == "test" and not shutil.which(QEMU):
            raise Missing(INSTALL_QEMU)
        toolchain = find_toolchain()
        programs = pick(build(toolchain), "size" if options.command == "sizes" else "test", options.names)
        if options.command == "sizes":
            print(f"{toolchain.describe()}\n\n{table(programs)}")
            return 0
        failed = [name for name, program in programs.items() if not passes(name, program, options.timeout)]
        print(f"{len(programs)} run, {len(failed)} failed")
        return 1 if failed else 0
    except (Failed, Missing) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3 if isinstance(error, Missing) else 1


def find_toolchain() -> Toolchain:
    found = default_toolchain() or system_toolchain()
    if not found:
        raise Missing(INSTALL_RUST)
    # Panic messages hold paths, and a size must not depend on where the sources lie. Replaces RUSTFLAGS, for the same reason.
    home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    short = [f"--remap-path-prefix={ROOT}=.", f"--remap-path-prefix={home / 'registry' / 'src'}=registry"]
    found.environment["CARGO_ENCODED_RUSTFLAGS"] = "\x1f".join(short)
    if not has_lld(found.sysroot):
        if not shutil.which(LINKER):
            raise Missing(INSTALL_LINKER)
        found.environment[f"CARGO_TARGET_{TARGET.upper().replace('-', '_')}_LINKER"] = LINKER
    return found


def default_toolchain() -> Toolchain | None:
    """The one that the command line means, for rustup the one of `rust-toolchain.toml`."""
    try:
        found = Toolchain("cargo", "rustc", Path(output(["rustc", "--print", "sysroot"])))
    except Failed:
        return None
    return found if (found.sysroot / "lib" / "rustlib" / TARGET).is_dir() else None


def system_toolchain() -> Toolchain | None:
    """The distribution's, by its full path: a `cargo` in PATH may be rustup's."""
    cargo, rustc = str(SYSTEM / "cargo"), str(SYSTEM / "rustc")
    environment = {**os.environ, "RUSTC": rustc, "RUSTC_BOOTSTRAP": "1"}
    environment.pop("LD_LIBRARY_PATH", None)  # below `cargo run`: the libraries of the other toolchain
    try:
        output([cargo, "--version"], environment)
        sysroot = Path(output([rustc, "--print", "sysroot"], environment))
    except Failed:
        return None
    if not (sysroot / "lib" / "rustlib" / "src" / "rust" / "library" / "core").is_dir():
        return None
    return Toolchain(cargo, rustc, sysroot, ["-Zbuild-std=core"], environment)


def has_lld(sysroot: Path) -> bool:
    return any(sysroot.glob("lib/rustlib/*/bin/rust-lld*"))


def output(command: list[str], environment: dict[str, str] | None = None) -> str:
    try:
        done = subprocess.run(command, check=False, cwd=HERE, env=environment, text=True, capture_output=True)
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror}") from error
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()[-400:]}")
    return done.stdout.strip()


def build(toolchain: Toolchain) -> dict[str, tuple[str, Path]]:
    """All programs: name to source folder and ELF file, in the order of their names."""
    command = [toolchain.cargo, "build", "--release", "--locked", "--quiet", "--target", TARGET, *toolchain.flags]
    command.append("--message-format=json-render-diagnostics")
    done = subprocess.run(
        command, check=False, cwd=HERE, env=toolchain.environment, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    )
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} ended with {done.returncode}")
    artifacts = [message for line in done.stdout.splitlines() if (message := json.loads(line)).get("executable")]
    return {
        one["target"]["name"]: (Path(one["target"]["src_path"]).parent.name, Path(one["executable"]))
        for one in sorted(artifacts, key=lambda one: str(one["target"]["name"]))
        if "bin" in one["target"]["kind"]
    }


def pick(programs: dict[str, tuple[str, Path]], folder: str, names: list[str]) -> dict[str, Path]:
    if unknown := set(names) - set(programs):
        raise Failed(f"no program {', '.join(sorted(unknown))}; there are {', '.join(programs)}")
    picked = names or [name for name, (its_folder, _) in programs.items() if its_folder == folder]
    if not picked:
        raise Failed(f"no program in firmware/src/{folder}")
    return {name: programs[name][1] for name in picked}


def table(programs: dict[str, Path]) -> str:
    lines = [f"| bytes | {' | '.join(SECTIONS)} |", "|---|" + "--:|" * len(SECTIONS)]
    for name, program in programs.items():
        sizes = section_sizes(program)
        if other := set(sizes) - set(SECTIONS):
            raise Failed(f"{name} has sections that the table does not show: {', '.join(sorted(other))}")
        lines.append(f"| {name} | {' | '.join(str(sizes.get(section, 0)) for section in SECTIONS)} |")
    return "\n".join(lines)


def section_sizes(program: Path) -> dict[str, int]:
    """The sections of a 32-bit little-endian ELF file that take up memory on the device."""
    elf = program.read_bytes()
    if elf[:6] != b"\x7fELF\x01\x01":
        raise Failed(f"{program} is not a 32-bit little-endian ELF file")
    (offset,) = struct.unpack_from("<I", elf, 0x20)
    entry_size, count, names_index = struct.unpack_from("<3H", elf, 0x2E)
    # name, type, flags, address, offset, size
    headers = [struct.unpack_from("<6I", elf, offset + entry_size * index) for index in range(count)]
    names = headers[names_index][4]
    sizes: dict[str, int] = {}
    allocated = 2  # SHF_ALLOC
    for name, _, flags, _, _, size in headers:
        if flags & allocated and size:
            text = elf[names + name : elf.index(0, names + name)].decode("ascii")
            sizes[text] = sizes.get(text, 0) + size
    return sizes


def passes(name: str, program: Path, timeout: float) -> bool:
    print(f"== {name}", flush=True)
    command = [QEMU, *BOARD, *SEMIHOSTING, "-kernel", str(program)]
    try:
        code = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, timeout=timeout).returncode
    except subprocess.TimeoutExpired:
        print(f"{name}: FAILED, did not end within {timeout:g} s (an endless loop, or a fault)", flush=True)
        return False
    print(f"{name}: {'ok' if code == 0 else f'FAILED, ended with {code}'}", flush=True)
    return code == 0


if __name__ == "__main__":
    sys.exit(main())
