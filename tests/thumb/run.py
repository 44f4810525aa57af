#!/usr/bin/env python3
"""Build firmware for thumbv7em-none-eabi, print how large it is, run it in QEMU.

    run.py sizes [--write] [NAME ...]        Markdown tables of all programs in firmware/src/size; --write puts the rows
                                             of firmware-glue/README.md there
    run.py test [--timeout 600] [NAME ...]   run all programs in firmware/src/test

A NAME picks a program from either folder. Nothing is skipped: what is missing on the machine is named.

`sizes` has the sections of every program and what it links of the parts of core that make firmware
large, with their callers. `sdo` is the SDO server of firmware-glue with the PMC, `services150`
SDO, PDOs, NMT and heartbeat with 150 objects, `node150`, `node-full150` and `node-pmc` complete nodes with
what their dictionaries need; their flash beyond the vector table and their RAM without the stack have a budget each. All
other programs but `baseline` are one server of lookups, reads and checked
writes (firmware/src/shared), over the PMC and over the model of tests/bench/runtime/scaled.py with
10 (the fewest that it has), 150 and 2,000 objects, which the crate `scaled` generates when it is
built. From these three come the bytes that one more entry costs, and of what they are made. An
entry is what has a sub-index of its own, sub-index 0 of an array or record too.

`test` runs on an emulated Cortex-M4:

    hello     a firmware starts and reports
    access    every case of tests/tests/rust/access.rs; firmware/build.rs makes them from the JSON dump
    alias     16-bit aliases of the PMC at the ends of their range
    sdo-instructions   how many instructions the SDO server takes for a request
    pdo-instructions   the same of a PDO of four entries

The target's core library is taken from the first that there is of

1. the default toolchain, after `rustup target add thumbv7em-none-eabi`;
2. /usr/bin/rustc with the library's sources (Debian: rustc-web, cargo-web, rust-web-src), which
   builds core with the unstable `-Z build-std` and with this workspace's profile.

The linker is rust-lld, which rustup brings with every toolchain, or arm-none-eabi-ld where there is
none. Sizes depend on these, so compare numbers of one toolchain only; `sizes` says which it was.

The exit code is 0 when all went well, 1 when a build or a program failed or did not end in time,
when a measured program can panic or is larger than its budget, or when an entry takes more flash than its target (of the scaled
model in all, of the PMC for finding it), 3 when a tool is missing or the crates that the firmware
uses cannot be fetched.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import re
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
COUNTED = {name: ["-icount", "shift=0"] for name in ("pdo-instructions", "sdo-instructions")}  # the clock goes by instructions
SEMIHOSTING = ["-semihosting-config", "enable=on,target=native"]
SYSTEM = Path("/usr/bin")  # where a distribution has its Rust
SECTIONS = [".vector_table", ".text", ".rodata", ".data", ".bss"]
FLASH = [".text", ".rodata", ".data"]  # .data is kept in flash and copied to RAM
RAM = [".data", ".bss"]

# The scaled model: programs by their number of objects, the first is where the others are counted from.
SCALED = {10: "scaled10", 150: "scaled150", 2000: "scaled2000"}
DEVICE = "pmc"  # a real device
MODEL = ROOT / "tests" / "bench" / "runtime" / "scaled.py"
FLASH_PER_ENTRY = 8  # target
README = ROOT / "firmware-glue" / "README.md"
# The rows of its table.
PROGRAMS = {
    "sdo": "SDO server with segments and blocks, PMC",
    "services150": "SDO with blocks, PDOs, NMT, heartbeat put together by hand, 150 objects",
    "node150": "complete `Node`, 150 objects without those of other services than heartbeat",
    "node-full150": "complete `Node`, 150 objects and those of all services: also SYNC, guarding, heartbeats watched, emergencies with history and of others, LSS",
    "node-pmc": "complete `Node` with the PMC: also emergencies with history, limits, aliases, parameters in flash",
}
# Bytes of flash and RAM, a little above what is measured: a change that costs more has to say so here.
BUDGETS = {
    "sdo": (17_300, 800),
    "services150": (23_000, 2_800),
    "node150": (28_000, 3_100),
    "node-full150": (33_600, 3_150),
    "node-pmc": (36_000, 2_700),
}
ENTRY_ROW = 4  # bytes of an item of ENTRIES
PEER = "the best of the peers at 150 objects, in an earlier study", 69, 26  # flash per object, per entry

# What no firmware should get with a dictionary, by a part of the symbol's name.
HEAVY = {
    "panics": re.compile(r"core::panicking"),
    "core::fmt": re.compile(r"core::fmt"),
    "64-bit division": re.compile(r"^__aeabi_u?ldivmod$"),
    "128-bit arithmetic": re.compile(r"^__\w+ti\d?$"),
    "soft-float": re.compile(r"^__aeabi_[df]|^__\w+[ds]f\d?$"),
}
PANICS = "panics"

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
    linker: str = LINKER

    def describe(self) -> str:
        version = output([self.rustc, "--version"], self.environment)
        core = "core built from source" if self.flags else "core as shipped"
        return f"{version}, {core}, linked with {Path(self.linker).stem}"


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    commands = parser.add_subparsers(dest="command", required=True)
    sizes = commands.add_parser("sizes", help="print the sizes of the programs' sections")
    test = commands.add_parser("test", help="run programs in QEMU")
    test.add_argument("--timeout", type=float, default=600, help="seconds for one program")
    sizes.add_argument("--write", action="store_true", help="write the table of firmware-glue/README.md")
    for command in (sizes, test):
        command.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    try:
        if options.command == "test" and not shutil.which(QEMU):
            raise Missing(INSTALL_QEMU)
        toolchain = find_toolchain()
        programs = pick(build(toolchain), "size" if options.command == "sizes" else "test", options.names)
        if options.command == "sizes":
            elves = {name: Elf(program) for name, program in programs.items()}
            print(f"{toolchain.describe()}\n\n{table(elves)}\n\n{heavy(elves)}")
            faults = [f"{name} can panic" for name, elf in elves.items() if elf.named(HEAVY[PANICS])]
            for name, budget in BUDGETS.items():
                faults += over(name, elves[name], budget) if name in elves else []
            if set(SCALED.values()) <= set(elves):
                text, fault = slopes({objects: elves[name] for objects, name in SCALED.items()})
                print(f"\n{text}")
                faults += fault
            if DEVICE in elves:
                text, fault = lookup(elves[DEVICE])
                print(f"\n{text}")
                faults += fault
            if options.write:
                write(elves)
            for fault in faults:
                print(f"error: {fault}", file=sys.stderr)
            return 1 if faults else 0
        failed = [name for name, program in programs.items() if not passes(name, program, options.timeout)]
        print(f"{len(programs) - len(failed)} passed, {len(failed)} failed")
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
    found.environment["PYTHON"] = sys.executable  # for scaled/build.rs
    found.environment.pop("RUSTC_WORKSPACE_WRAPPER", None)  # clippy compiles with fewer optimisations
    found.environment["CARGO_ENCODED_RUSTFLAGS"] = "\x1f".join(short)
    found.linker = find_linker(found)
    found.environment[f"CARGO_TARGET_{TARGET.upper().replace('-', '_')}_LINKER"] = found.linker
    return found


def find_linker(toolchain: Toolchain) -> str:
    """The toolchain's own rust-lld, or that of the default toolchain, or the GNU linker."""
    sysroots = [toolchain.sysroot, default_sysroot()]
    for lld in (lld for sysroot in sysroots if sysroot for lld in sorted(sysroot.glob("lib/rustlib/*/bin/rust-lld*"))):
        return str(lld)
    if not shutil.which(LINKER):
        raise Missing(INSTALL_LINKER)
    return LINKER


def default_sysroot() -> Path | None:
    """Of the toolchain that the command line means, for rustup the one of `rust-toolchain.toml`."""
    try:
        return Path(output(["rustc", "--print", "sysroot"]))
    except Failed:
        return None


def default_toolchain() -> Toolchain | None:
    sysroot = default_sysroot()
    if not sysroot or not (sysroot / "lib" / "rustlib" / TARGET).is_dir():
        return None
    return Toolchain("cargo", "rustc", sysroot)


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


def output(command: list[str], environment: dict[str, str] | None = None) -> str:
    try:
        done = subprocess.run(command, check=False, cwd=HERE, env=environment, text=True, capture_output=True)
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror}") from error
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()[-400:]}")
    return done.stdout.strip()


def build(toolchain: Toolchain, workspace: Path = HERE, features: tuple[str, ...] = ()) -> dict[str, tuple[str, Path]]:
    """All programs: name to source folder and ELF file, in the order of their names."""
    fetch = [toolchain.cargo, "fetch", "--locked", "--quiet"]
    if subprocess.run(fetch, check=False, cwd=workspace, env=toolchain.environment).returncode != 0:
        raise Missing("the crates that the firmware uses cannot be fetched")
    command = [toolchain.cargo, "build", "--release", "--locked", "--quiet", "--target", TARGET, *toolchain.flags]
    command += ["--message-format=json-render-diagnostics", *(f"--features={feature}" for feature in features)]
    done = subprocess.run(
        command, check=False, cwd=workspace, env=toolchain.environment, stdout=subprocess.PIPE, text=True, encoding="utf-8"
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


class Elf:
    """What a 32-bit little-endian ELF file has on the device: sections by name, and symbols."""

    def __init__(self, program: Path) -> None:
        self.program, self.data = program, program.read_bytes()
        if self.data[:6] != b"\x7fELF\x01\x01":
            raise Failed(f"{program} is not a 32-bit little-endian ELF file")
        (offset,) = struct.unpack_from("<I", self.data, 0x20)
        entry_size, count, names_index = struct.unpack_from("<3H", self.data, 0x2E)
        # name, type, flags, address, offset, size, link
        headers = [struct.unpack_from("<7I", self.data, offset + entry_size * index) for index in range(count)]
        self.sizes: dict[str, int] = {}
        self.text: list[tuple[int, int, int]] = []  # address, offset, size
        self.symbols: list[tuple[str, int, int]] = []  # readable name, address, size
        allocated, executable, symbol_table = 2, 4, 2  # SHF_ALLOC, SHF_EXECINSTR, SHT_SYMTAB
        for name, kind, flags, address, place, size, link in headers:
            if flags & allocated and size:
                text = self.string(headers[names_index][4] + name)
                self.sizes[text] = self.sizes.get(text, 0) + size
            if flags & allocated and flags & executable:
                self.text.append((address, place, size))
            if kind == symbol_table:
                for at in range(place, place + size, 16):
                    its_name, value, its_size = struct.unpack_from("<3I", self.data, at)
                    self.symbols.append((readable(self.string(headers[link][4] + its_name)), value, its_size))
        if not self.symbols:
            raise Failed(f"{program} has no symbols")

    def string(self, start: int) -> str:
        return self.data[start : self.data.index(0, start)].decode("utf-8", "replace")

    def total(self, sections: list[str]) -> int:
        return sum(self.sizes.get(section, 0) for section in sections)

    def static(self, name: str) -> int:
        """Bytes of the statics of this name."""
        return sum(size for its_name, _, size in self.symbols if its_name.rpartition("::")[2] == name)

    def named(self, pattern: re.Pattern[str]) -> dict[str, int]:
        return {name: address for name, address, _ in self.symbols if pattern.search(name)}

    def callers(self, function: int) -> set[str]:
        """Functions with a BL or B.W to an address. A constant in the code that looks like one counts, too."""
        found = set()
        for address, offset, size in self.text:
            for at in range(0, size - 3, 2):
                high, low = struct.unpack_from("<2H", self.data, offset + at)
                if high >> 11 == 0b11110 and low >> 14 in (0b10, 0b11) and low & 0x1000:
                    sign, first, second = high >> 10 & 1, low >> 13 & 1, low >> 11 & 1
                    distance = (high & 0x3FF) << 12 | (low & 0x7FF) << 1
                    distance |= (1 ^ first ^ sign) << 23 | (1 ^ second ^ sign) << 22
                    if address + at + 4 + distance - (sign << 24) == function & ~1:
                        found.add(self.at(address + at))
        return found

    def at(self, address: int) -> str:
        inside = (name for name, start, size in self.symbols if start & ~1 <= address < (start & ~1) + size)
        return next(inside, f"{address:#x}")


def readable(symbol: str) -> str:
    """The identifiers in a mangled name, without what is between them."""
    prefix = re.match(r"_R|_ZN", symbol)
    if not prefix:
        return symbol
    names, at = [], prefix.end()
    while at < len(symbol):
        if length := re.compile(r"(\d+)_?").match(symbol, at):
            at = length.end() + int(length[1])
            names.append(symbol[length.end() : at])
        elif skipped := re.compile(r"[sB][0-9A-Za-z]*_").match(symbol, at):  # disambiguator, back reference
            at = skipped.end()
        else:
            at += 1
    return "::".join(name for name in names if not re.fullmatch(r"h[0-9a-f]{16}", name)) or symbol


def over(name: str, elf: Elf, budget: tuple[int, int]) -> list[str]:
    """What a program takes beyond its budget of flash and RAM."""
    taken = zip(("flash", "RAM"), (elf.total(FLASH), elf.total(RAM)), budget, strict=True)
    return [f"{name} takes {size} bytes of {memory}, more than its budget of {most}" for memory, size, most in taken if size > most]


def row(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def table(elves: dict[str, Elf]) -> str:
    lines = [row(["bytes", *SECTIONS, "flash", "RAM"]), "|---|" + "--:|" * (len(SECTIONS) + 2)]
    for name, elf in elves.items():
        if other := set(elf.sizes) - set(SECTIONS):
            raise Failed(f"{name} has sections that the table does not show: {', '.join(sorted(other))}")
        sizes = [elf.sizes.get(section, 0) for section in SECTIONS]
        lines.append(row([name, *(str(size) for size in [*sizes, elf.total(FLASH), elf.total(RAM)])]))
    return "\n".join(lines)


def write(elves: dict[str, Elf]) -> None:
    """Puts the table of programs into the README."""
    lines = ["| program | code | constants | initial values | flash | RAM |", "|---|" + "--:|" * 5]
    for name, about in PROGRAMS.items():
        elf = elves[name]
        sizes = [elf.total([section]) for section in FLASH] + [elf.total(FLASH), elf.total(RAM)]
        lines.append(row([f"{about} (`{name}`)", *(f"{size:,}" for size in sizes)]))
    text = README.read_text(encoding="utf-8")
    head, mark, rest = text.partition("<!-- sizes -->\n")
    _, end, tail = rest.partition("<!-- end of sizes -->\n")
    if not end:
        raise Failed(f"{README} has no place for sizes")
    README.write_text(head + mark + "\n".join(lines) + "\n" + end + tail, encoding="utf-8", newline="\n")


def heavy(elves: dict[str, Elf]) -> str:
    lines = [row(["links", *HEAVY]), "|---|" + "---|" * len(HEAVY)]
    for name, elf in elves.items():
        cells = []
        for pattern in HEAVY.values():
            found = elf.named(pattern)
            callers = {caller for address in found.values() for caller in elf.callers(address)} - set(found)
            cells.append(f"{', '.join(sorted(found))} from {', '.join(sorted(callers)) or '?'}" if found else "-")
        lines.append(row([name, *cells]))
    return "\n".join(lines)


def model(objects: int) -> tuple[int, int]:
    """Entries and bytes of values that a number of objects of the scaled model has."""
    specification = importlib.util.spec_from_file_location("scaled", MODEL)
    if not specification or not specification.loader:
        raise Failed(f"{MODEL} cannot be loaded")
    scaled = sys.modules["scaled"] = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(scaled)
    entries = values = 0
    for one in scaled.objects(objects):
        times = scaled.ARRAY_LENGTH if one.kind == "array" else 1
        entries += times * len(one.entries) + (one.kind != "var")
        values += times * sum(entry.type.size for entry in one.entries)
    return entries, values


def parts(elf: Elf) -> dict[str, int]:
    """What the flash is made of."""
    found = {
        "rows": elf.static("ENTRIES") + elf.static("OBJECTS"),
        "directory": elf.static("BLOCKS") + elf.static("SEEDS") + elf.static("ORDER"),
        "`Entry` by row": elf.static("BY_ROW"),
        "attributes": elf.static("ATTRIBUTES"),
        "factory image": elf.static("FACTORY") + elf.total([".data"]),
    }
    found["other constants"] = elf.total([".rodata", ".data"]) - sum(found.values())
    return {**found, "code": elf.total([".text"])}


def slopes(scaled: dict[int, Elf]) -> tuple[str, list[str]]:
    (first, base), *others = scaled.items()
    columns = ["flash/object", "flash/entry", "RAM/object", "values/object", *parts(base)]
    lines = [row([f"bytes from {first} objects on", *columns]), "|---|" + "--:|" * len(columns)]
    faults = []
    for objects, elf in others:
        count = objects - first
        entries, values = (now - before for now, before in zip(model(objects), model(first), strict=True))
        flash, ram = elf.total(FLASH) - base.total(FLASH), elf.total(RAM) - base.total(RAM)
        numbers = [flash / count, flash / entries, ram / count, values / count]
        numbers += [(size - parts(base)[part]) / entries for part, size in parts(elf).items()]
        lines.append(row([f"to {objects}", *(f"{number:.2f}" for number in numbers)]))
        if flash > FLASH_PER_ENTRY * entries:
            faults.append(f"up to {objects} objects, an entry takes {flash / entries:.1f} bytes of flash")
    empty = [""] * len(parts(base))
    lines.append(row(["target", "", str(FLASH_PER_ENTRY), "values", "", *empty]))
    name, per_object, per_entry = PEER
    lines.append(row([name, str(per_object), str(per_entry), "", "", *empty]))
    return "\n".join(lines) + f"\n\nThe columns from \"{next(iter(parts(base)))}\" on: flash per entry.", faults


def lookup(elf: Elf) -> tuple[str, list[str]]:
    """What finding an entry and its place costs on a real device, whose indices have gaps."""
    size, entries = parts(elf)["rows"] + parts(elf)["directory"], elf.static("ENTRIES") // ENTRY_ROW
    text = f"{DEVICE}: {size / entries:.2f} bytes an entry for rows and directory, target {FLASH_PER_ENTRY}"
    return text, [text] if size > FLASH_PER_ENTRY * entries else []


def passes(name: str, program: Path, timeout: float) -> bool:
    print(f"== {name}", flush=True)
    command = [QEMU, *BOARD, *COUNTED.get(name, []), *SEMIHOSTING, "-kernel", str(program)]
    try:
        code = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, timeout=timeout).returncode
    except subprocess.TimeoutExpired:
        print(f"{name}: FAILED, did not end within {timeout:g} s (an endless loop, or a fault)", flush=True)
        return False
    print(f"{name}: {'ok' if code == 0 else f'FAILED, ended with {code}'}", flush=True)
    return code == 0


if __name__ == "__main__":
    sys.exit(main())
