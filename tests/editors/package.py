#!/usr/bin/env python3
"""Packages the extension for VS Code as its registry takes it, and looks into the package.

    package.py --odgen target/debug/odgen [--out target/editors/vscode]

Needs npm, which fetches `vsce` and a Node.js that it runs on. One package is for every platform, and one has the program for
this platform in it. Exit code 3: npm could not fetch something.
"""

from __future__ import annotations

import argparse
import json
import platform
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "od-gen/lsp/vscode"
# The project has no public address yet, to which links of the README could lead.
NO_ADDRESS = ["--allow-missing-repository", "--no-rewrite-relative-links"]
TOOLS = ["node@24", "@vscode/vsce@3", "esbuild@0.25"]
FILES = [
    "package.json", "readme.md", "license.txt", "icon.png", "extension.js", "eds-configuration.json",
    "syntaxes/eds.tmLanguage.json", "syntaxes/xdd.tmLanguage.json",
]  # fmt: skip
MACHINES = {"x86_64": "x64", "AMD64": "x64", "aarch64": "arm64", "arm64": "arm64"}
SYSTEMS = {"linux": "linux", "darwin": "darwin", "win32": "win32"}


def run(command: list[str], folder: Path) -> bool:
    print("+", " ".join(command), flush=True)
    return subprocess.run(command, cwd=folder, check=False).returncode == 0


def fetched(out: Path) -> bool:
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(SOURCE, out / "extension")
    npm = shutil.which("npm") or "npm"
    quiet = ["--no-audit", "--no-fund", "--loglevel=error"]
    (out / "tools").mkdir()
    return run([npm, "install", *quiet, *TOOLS], out / "tools") and run(
        [npm, "install", "--omit=dev", "--ignore-scripts", *quiet], out / "extension"
    )


def bundled(tools: Path, folder: Path) -> bool:
    """Makes one script of the extension and what it needs, and one file of its licences."""
    bundle = folder / "bundle.js"
    esbuild = [str(tools / "node_modules/.bin/esbuild"), "extension.js", "--bundle", "--minify"]
    options = ["--platform=node", "--external:vscode", f"--outfile={bundle}"]
    if not run([*esbuild, *options], folder):
        return False
    bundle.replace(folder / "extension.js")
    (folder / "content.js").unlink()
    shutil.rmtree(folder / "node_modules")
    licences = [folder / "LICENSE-MIT", folder / "LICENSE-APACHE"]
    texts = ["MIT or Apache-2.0, at your option.", *(one.read_text(encoding="utf-8") for one in licences)]
    (folder / "LICENSE.txt").write_text("\n\n".join(texts), encoding="utf-8")
    for one in licences:
        one.unlink()
    return True


def wrong_of(package: Path, program: str | None) -> list[str]:
    with zipfile.ZipFile(package) as archive:
        names = {name.lower() for name in archive.namelist()}
        wanted = [f"extension/{name}".lower() for name in FILES]
        if program:
            wanted.append(f"extension/bin/{program}".lower())
        lacks = [f"{package.name} lacks {name}" for name in wanted if name not in names]
        manifest = json.loads(archive.read("extension/package.json"))
    main = manifest["main"].removeprefix("./")
    if f"extension/{main}" not in names:
        lacks.append(f"{package.name} lacks its main file {main}")
    return lacks


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--odgen", required=True, type=Path)
    parser.add_argument("--out", type=Path, default=ROOT / "target/editors/vscode")
    args = parser.parse_args()
    if not fetched(args.out):
        print("npm could not install vsce or what the extension needs", file=sys.stderr)
        return 3
    node = args.out / "tools/node_modules/node/bin/node"
    vsce = args.out / "tools/node_modules/@vscode/vsce/vsce"
    folder = args.out / "extension"
    if not bundled(args.out / "tools", folder):
        print("the extension cannot be bundled", file=sys.stderr)
        return 1
    wrong: list[str] = []
    target = f"{SYSTEMS[sys.platform]}-{MACHINES[platform.machine()]}"
    program = "odgen.exe" if sys.platform == "win32" else "odgen"
    for platform_name in (None, target):
        package = args.out / f"odgen-{platform_name or 'any'}.vsix"
        command = [str(node), str(vsce), "package", "--no-dependencies", *NO_ADDRESS, "--out", str(package)]
        if platform_name:
            (folder / "bin").mkdir()
            shutil.copy(args.odgen, folder / "bin" / program)
            command += ["--target", platform_name]
        if not run(command, folder):
            wrong.append(f"vsce does not package for {platform_name or 'any platform'}")
            continue
        wrong += wrong_of(package, program if platform_name else None)
    for one in wrong:
        print(one, file=sys.stderr)
    print(f"{2 - min(2, len(wrong))} passed, {len(wrong)} failed: packages of the extension")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
