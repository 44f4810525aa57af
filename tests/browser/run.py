#!/usr/bin/env python3
"""Use the generated documents like a reader: in Chromium, on paper, and through Asciidoctor.

    run.py [--sample] DOCS...
    run.py --page PAGE ODGEN    only uses the page of the command, and compares it with the command
    run.py --install    only installs what npm brings

DOCS are directories with HTML pages, `workbench.json` (what their tools have to show), `dump.json` and `context.json`
(without these two, only the tools are used and the questions of `questions.json` asked), or with documents in two languages
and a start page for them, or with `manual.adoc`, or with `hostile.json` and pages that hold its texts. With --sample, axe
looks at one of each kind of element, and questions and links take turns at the widths of a window. Every HTML page is held
against the HTML standard (with --sample, those that are compared with a dump), and the search against how much it does at once
and what it finds. What npm brings is installed below target/browser. Needs Node, npm, Chromium (CHROMIUM names another program)
and pdftotext of poppler-utils. Exit code 0: the documents are as they must be; 1: they are not; 3: a program is missing or npm
could not install, nothing was checked.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
CACHE = HERE.parent.parent / "target" / "browser"
FILES = ["package.json", "package-lock.json", ".npmrc"]
SCRIPTS = [
    *["browser.mjs", "check.mjs", "workbench.mjs", "questions.mjs", "questions.json", "widths.mjs", "portal.mjs", "hostile.mjs"],
    *["asciidoc.mjs", "validate.mjs", "slices.mjs", "words.mjs", "page.mjs"],
]
TEMPLATES = HERE.parent.parent / "docs-gen" / "templates" / "html"
SEARCH = [str(TEMPLATES / name) for name in ["_words.js", "_search.js"]]
# Two cores are what a machine has at least.
AT_ONCE = 2
# What is dropped onto the page of the command.
DROPPED = ["tests/eds/*", "generated/eds/*", "od-spec/devices/*.od.yaml", "od-gen/cli/tests/cli/eds/*.xdd"]
# A node of the kind `pmc`: it is read, sends its state, and starts.
TRACE = """\
(1700000000.000100) can0 605#4041600000000000
(1700000000.000900) can0 585#4B41600037020000
(1700000000.001000) can0 705#05
(1700000000.002000) can0 185#3702
(1700000000.003000) can0 000#0105
"""
BROWSERS = ["chromium", "chromium-browser", "google-chrome", "chrome"]


class Missing(Exception):
    """What has to be installed."""


def program(names: list[str], package: str) -> str:
    for name in names:
        if found := shutil.which(name):
            return found
    raise Missing(f"{' or '.join(names)} is missing; install {package}")


def install() -> Path:
    """Node modules as the lock file names them; the scripts next to them, as Node looks for modules from there."""
    folder = CACHE / "npm"
    stamp = folder / "stamp"
    digest = hashlib.sha256(b"".join((HERE / name).read_bytes() for name in FILES)).hexdigest()
    if not stamp.is_file() or stamp.read_text() != digest:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name in FILES:
            shutil.copy(HERE / name, folder)
        command = [program(["npm"], "npm"), "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"]
        if subprocess.run(command, cwd=folder, check=False).returncode != 0:
            raise Missing("`npm ci` could not install the modules")
        stamp.write_text(digest)
    for name in SCRIPTS:
        shutil.copy(HERE / name, folder)
    return folder


def run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def size(command: list[str]) -> int:
    """How much the command has to read, in bytes of HTML."""
    folders = [Path(argument) for argument in command[2:] if Path(argument).is_dir()]
    return sum(file.stat().st_size for folder in folders for file in folder.rglob("*.html"))


def is_only_asked(docs: Path) -> bool:
    """Whether nothing is compared with a dump. Such documents are large, and have no element that others have not."""
    return (docs / "workbench.json").exists() and not (docs / "dump.json").exists()


def large(objects: int) -> str:
    """An EDS with many objects."""
    indices = [f"{0x2000 + number:04X}" for number in range(objects)]
    lists = ["[FileInfo]", "FileName=large.eds", "[DeviceInfo]", "VendorName=Example", "BaudRate_125=1"]
    lists += ["[MandatoryObjects]", "SupportedObjects=1", "1=0x1000", "[1000]", "ParameterName=Device type"]
    lists += ["ObjectType=0x7", "DataType=0x0007", "AccessType=ro", "DefaultValue=0", "PDOMapping=0"]
    lists += ["[ManufacturerObjects]", f"SupportedObjects={objects}"]
    lists += [f"{number}=0x{index}" for number, index in enumerate(indices, 1)]
    fields = "ObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=7\nPDOMapping=1"
    lists += [f"[{index}]\nParameterName=value {index}\n{fields}" for index in indices]
    return "\n".join(lists).replace("\n", "\r\n") + "\r\n"


def use_page(node: str, browser: str, folder: Path, page: str, odgen: str) -> int:
    """Uses the page of the command on files of the tests and of the shipped devices."""
    root, made = HERE.parent.parent, CACHE / "page"
    made.mkdir(parents=True, exist_ok=True)
    (made / "bus.log").write_text(TRACE, encoding="ascii")
    (made / "large.eds").write_text(large(10_000), encoding="ascii", newline="")
    dropped = [path for pattern in DROPPED for path in sorted(root.glob(pattern)) if path.suffix in (".eds", ".dcf", ".xdd", ".yaml")]
    files = map(str, [made / "large.eds", *dropped, made / "bus.log"])
    return subprocess.run([node, str(folder / "page.mjs"), page, browser, odgen, *files], check=False).returncode


def main() -> int:
    try:
        node, browser = program(["node"], "nodejs"), os.environ.get("CHROMIUM") or program(BROWSERS, "chromium")
        program(["pdftotext"], "poppler-utils")
        folder = install()
        if sys.argv[1:] == ["--install"]:
            return 0
        if sys.argv[1:2] == ["--page"]:
            return use_page(node, browser, folder, *sys.argv[2:])
    except Missing as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    is_sample = sys.argv[1:2] == ["--sample"]
    amount = "sample" if is_sample else "all"
    directories = [Path(argument).resolve() for argument in sys.argv[1 + is_sample :]]
    pages = [str(docs) for docs in directories if any(docs.rglob("*.html")) and not (is_sample and is_only_asked(docs))]
    asked = json.loads((HERE / "questions.json").read_text(encoding="utf-8"))
    work: list[tuple[str, list[str]]] = []
    for docs in directories:
        if (docs / "manual.adoc").exists():
            work.append((docs.name, [node, str(folder / "asciidoc.mjs"), str(docs / "manual.adoc")]))
        elif (docs / "index.html").exists() and not (docs / "dump.json").exists() and any(docs.glob("*/*/index.html")):
            work.append((docs.name, [node, str(folder / "portal.mjs"), str(docs), browser]))
        elif (docs / "hostile.json").exists():
            work.append((docs.name, [node, str(folder / "hostile.mjs"), str(docs), browser]))
        else:
            if (docs / "workbench.json").exists():
                work.append((f"{docs.name}: tools", [node, str(folder / "workbench.mjs"), str(docs), browser, amount]))
            if any(docs.rglob("*.html")) and not docs.name.endswith("-print"):
                work.append((f"{docs.name}: widths", [node, str(folder / "widths.mjs"), str(docs), browser, amount]))
            if docs.name in asked:
                work.append((f"{docs.name}: questions", [node, str(folder / "questions.mjs"), str(docs), browser, amount]))
            if (docs / "dump.json").exists():
                files = [docs, docs / "dump.json", docs / "context.json", CACHE / "seen" / docs.name]
                work.append((docs.name, [node, str(folder / "check.mjs"), *map(str, files), browser, amount]))
    work.append(("slices of the search", [node, str(folder / "slices.mjs"), *SEARCH]))
    work.append(("words of the search", [node, str(folder / "words.mjs"), *SEARCH]))
    if pages:
        work.append(("all pages", [node, str(folder / "validate.mjs"), *pages]))
    failed = 0
    # A browser waits a lot: what is large begins first, at the same time the next; it is reported in the given order.
    with ThreadPoolExecutor(max_workers=AT_ONCE) as pool:
        started = {name: pool.submit(run, command) for name, command in sorted(work, key=lambda one: -size(one[1]))}
        for name, _ in work:
            done = started[name].result()
            print(f"== {name}", done.stdout.rstrip(), sep="\n", flush=True)
            failed += done.returncode != 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
