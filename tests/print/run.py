#!/usr/bin/env python3
"""Print the manuals and read the paper.

    run.py DOCS...
    run.py --install    only installs WeasyPrint

DOCS are directories with `manual.html` and `context.json`. WeasyPrint makes `manual.pdf` next to them, pdftotext reads it, and all that the
context says has to be there: titles on the page that the contents name, captions next to what they name, cells, texts, warnings. What lies
where on its pages (`layout.py`) has to be readable: no small print, no heading at the foot of a page, no warning overleaf, no page that is
nearly empty. WeasyPrint is installed below target/print. Needs Python with venv, Pango, and pdftotext of poppler-utils. Exit code 0: the manuals are as they must be; 1:
they are not; 3: a program is missing or pip could not install, nothing was checked.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
# The smallest letters that are read without effort, in points.
SMALLEST = 7.0
# How much of a page is used, where nothing says that what follows begins a page.
FULL = 0.45
CACHE = HERE.parent.parent / "target" / "print"


class Missing(Exception):
    """What has to be installed."""


def install() -> list[str]:
    """The command of WeasyPrint as the requirements name it."""
    folder, requirements = CACHE / "venv", HERE / "requirements.txt"
    stamp = folder / "stamp"
    digest = hashlib.sha256(requirements.read_bytes() + sys.version.encode()).hexdigest()
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    if not stamp.is_file() or stamp.read_text() != digest:
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([sys.executable, "-m", "venv", str(folder)], check=False)
        pip = [str(python), "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "-r", str(requirements)]
        if subprocess.run(pip, check=False).returncode != 0:
            raise Missing("pip could not install WeasyPrint")
        stamp.write_text(digest)
    return [str(python), str(HERE / "layout.py")]


def squeezed(text: str) -> str:
    """A text without its white space: lines are broken elsewhere on paper."""
    return re.sub(r"\s+", "", text.replace("\u00ad", ""))


class Manual:
    """A printed manual and what it has to say."""

    def __init__(self, docs: Path, weasyprint: list[str]) -> None:
        self.passed = 0
        self.failures: list[str] = []
        self.context = json.loads((docs / "context.json").read_text(encoding="utf-8"))
        pdf = docs / "manual.pdf"
        made = subprocess.run(
            [*weasyprint, str(docs / "manual.html"), str(pdf)], check=False, capture_output=True, text=True
        )
        self.layout = [json.loads(line) for line in made.stdout.splitlines()]
        self.check(made.returncode == 0, f"WeasyPrint: {made.stderr[-500:]}")
        for line in sorted({line for line in made.stderr.splitlines() if "ERROR" in line}):
            self.check(False, line)
        if made.returncode != 0:
            self.pages, self.raw, self.lines = [], [], []
            return
        # In the order of the file a cell stays together; laid out as on paper, a line of the contents does.
        self.raw = [squeezed(page) for page in self.read(pdf, "-raw")]
        laid_out = self.read(pdf, "-layout")
        self.lines = [page.splitlines() for page in laid_out]
        self.whole = "".join(self.raw)

    @staticmethod
    def read(pdf: Path, how: str) -> list[str]:
        text = subprocess.run(["pdftotext", how, str(pdf), "-"], check=True, capture_output=True, text=True).stdout
        return text.split("\f")[:-1]

    def check(self, is_so: bool, otherwise: str) -> None:
        if is_so:
            self.passed += 1
        else:
            self.failures.append(otherwise)

    def has(self, text: str, what: str) -> None:
        # What is in another language says so after it.
        self.check(squeezed(text) in self.whole, f"{what} is missing: {text[:100]}")

    def run(self) -> None:
        if not self.raw:
            return
        self.numbers_of_pages()
        self.contents()
        self.breaks()
        self.fullness()
        self.tables_in_two()
        self.small_print()
        self.overfull()
        self.short_lines()
        self.warnings()
        for chapter in self.context["chapters"]:
            for section in chapter["sections"]:
                self.section(section)
        left_out = set() if self.context["errata"] else {"errata", "tables"}
        for appendix in self.context["appendices"]:
            if appendix["page"] not in left_out:
                for table in appendix["tables"]:
                    self.table(table)
        for device in self.context["devices"]:
            for item in device["objects"]:
                if item["anchor"] in device["details"]:
                    self.table(item["table"])
                    self.has(item["name"], f"{device['key']}: {item['index']}")
        marks = re.search(r"\bE\d+\s+E\d+\b", "\n".join("\n".join(lines) for lines in self.lines))
        self.check((marks is None) or self.context["errata"], f"a mark of an erratum: {marks and marks[0]}")

    def numbers_of_pages(self) -> None:
        for number, lines in enumerate(self.lines[1:], start=2):
            *text, last = [line.strip() for line in lines if line.strip()] or [""]
            self.check(last.split()[-1:] == [str(number)], f"page {number} ends with: {last}")
            self.check(not "".join(text[-1:]).endswith(":"), f"page {number} ends before what it announces: {text[-1:]}")

    def contents(self) -> None:
        """Each title is on the page that the contents name."""
        named = {}
        for lines in self.lines:
            for line in lines:
                if found := re.fullmatch(r"\s*(.*?)\s?\.{3,}\s*(\d+)", line):
                    named.setdefault(squeezed(found[1]), []).append(int(found[2]))
        titles = [
            f"{section['number']} {section['title']['text']}"
            for chapter in self.context["chapters"]
            for section in chapter["sections"]
        ]
        titles += [appendix["title"] for appendix in self.context["appendices"] if appendix["page"] not in ("errata", "tables")]
        tables = [
            (table, f"{table['number']} {table['title']['text']}")
            for chapter in self.context["chapters"]
            for section in chapter["sections"]
            for table in section["tables"]
            if table["number"] is not None
        ]
        titles.append(self.context["words"]["notation"])
        if tables:
            titles.append(self.context["words"]["list_of_tables"])
        figures = [
            f"{table['figure']['number']} {table['figure']['title']['text']}"
            for chapter in self.context["chapters"]
            for section in chapter["sections"]
            for table in section["tables"]
            if table["figure"] is not None
        ]
        if figures:
            titles.append(self.context["words"]["list_of_figures"])
        for title in titles + [title for _, title in tables] + figures:
            # A long title is broken into lines, of which the last has the number.
            words = squeezed(title)
            pages = named.get(words) or [page for line, found in named.items() if len(line) > 3 and words.endswith(line) for page in found]
            self.check(bool(pages), f"not in the contents: {title}")
            if pages:
                self.check(any(words in self.raw[page - 1] for page in pages), f"not on page {pages}: {title}")

    def breaks(self) -> None:
        """No heading is the last thing of a page, and no warning the first."""
        following = [page["chapter"] for page in self.layout[1:]] + [True]
        overleaf = [page["blocks"][:1] for page in self.layout[1:]] + [[]]
        for number, (page, is_last, behind) in enumerate(zip(self.layout, following, overleaf), start=1):
            blocks = page["blocks"]
            if blocks:
                last, first = blocks[-1], blocks[0]
                # A section may have nothing but its title.
                is_empty = is_last or any(one.get("level", 9) <= last.get("level", 0) for one in behind)
                self.check(is_empty or last["kind"] not in ("heading", "caption"), f"page {number} ends with: {last['text'][:80]}")
                self.check(first["kind"] != "warning", f"page {number} begins with the warning: {first['text'][:80]}")

    def fullness(self) -> None:
        """No page is nearly empty, but at the end of a chapter or before what is as high as the rest of it."""
        for number, (page, behind) in enumerate(zip(self.layout, self.layout[1:]), start=1):
            # A caption and what leads to it go with their picture.
            begins = [one["kind"] for one in behind["blocks"][:4]]
            is_apart = behind["chapter"] or behind["height"] != page["height"] or "picture" in begins
            share = page["bottom"] / page["height"]
            self.check(is_apart or share >= FULL, f"page {number} is used to {share:.0%} only")

    def tables_in_two(self) -> None:
        """Of a table that goes on overleaf, no single row of usual height is alone on a page."""
        parts: dict[int, list[tuple[int, dict]]] = {}
        for number, page in enumerate(self.layout, start=1):
            for table in page["tables"]:
                parts.setdefault(table["element"], []).append((number, table))
        for table in parts.values():
            for number, part in table if len(table) > 1 else []:
                heights = part["heights"]
                is_high = sum(heights) > self.layout[number - 1]["height"] / 5
                self.check(len(heights) > 1 or is_high, f"page {number} has a single row of a table of {part['id']}")

    def small_print(self) -> None:
        for number, page in enumerate(self.layout, start=1):
            for size, sample in page["sizes"].items():
                self.check(float(size) >= SMALLEST, f"page {number} has letters of {size} pt: {sample}")

    def overfull(self) -> None:
        for number, page in enumerate(self.layout, start=1):
            self.check(not page["overfull"], f"page {number} has a table that is wider than the text, of {page['overfull'][:3]}")

    def short_lines(self) -> None:
        for number, page in enumerate(self.layout, start=1):
            self.check(not page["short"], f"page {number} has lines that end early: {page['short'][:3]}")

    def warnings(self) -> None:
        """The overview leads from each warning to the page that it is on."""
        if not self.context["warnings"]:
            return
        heading = squeezed(self.context["words"]["warnings"] + self.context["words"]["warnings_intro"])
        first = next((number for number, page in enumerate(self.raw) if heading in page), None)
        self.check(first is not None, "there is no overview of the warnings")
        # The overview ends where the first chapter begins.
        behind = next((at for at in range((first or 0) + 1, len(self.layout)) if self.layout[at]["chapter"]), len(self.raw))
        overview = "".join(self.raw[first or 0 : behind])
        for row in self.context["warnings"]["grids"][0]["rows"]:
            places, warning = (cell["text"] for cell in row["cells"])
            for place in places.splitlines():
                # After the place are leading dots and the page. An object may have several warnings, each with a place of its own.
                found = re.findall(re.escape(squeezed(place)) + r"[.…]*(\d+)", overview)
                self.check(bool(found), f"not in the overview of the warnings: {place}")
                if found:
                    lines = [squeezed(line) for line in warning.splitlines()]
                    # Digits of the next place may follow those of the page.
                    pages = {int(number[:digits]) for number in found for digits in range(1, len(number) + 1)}
                    pages = {page for page in pages if 0 < page <= len(self.raw)}
                    stands = any(all(line in self.raw[page - 1] for line in lines) for page in pages)
                    self.check(stands, f"not on pages {found}: the warning of {place}")

    def section(self, section: dict) -> None:
        for part in section["content"]:
            if part["kind"] == "table":
                self.table(section["tables"][part["table"]])
            else:
                for item in part["items"]:
                    for line in item["parts"]:
                        self.has(line["text"], part["kind"])

    def table(self, table: dict) -> None:
        grids = table["grids"]
        self.figures(table)
        for grid in grids:
            for row in grid["rows"]:
                for cell in self.printed_cells(grid, row):
                    for part in cell["parts"]:
                        self.has(part["text"], f"a cell of {table['anchor']}")
        caption = squeezed(f"{self.context['words']['table']} {table['number']} {table['title']['text']}")
        if table["number"] is None or not grids or not grids[0]["rows"] or self.is_drawn(grids[0]):
            return
        first = grids[0]
        pages = [page for page in self.raw if caption in page]
        columns = "".join(squeezed(column["title"]) for column in first["columns"])
        self.check(any(columns in page.split(caption, 1)[1] for page in pages), f"parted from its table: {caption}")
        if first["bits"]:
            names = [squeezed(field["name"]) for row in first["bits"]["rows"] for field in row["fields"]]
            self.check(
                any(all(name in page.split(caption, 1)[1] for name in names) for page in pages),
                f"parted from its picture: {caption}",
            )

    @staticmethod
    def is_drawn(grid: dict) -> bool:
        """A block diagram or a sequence of events: below it is only what it does not say itself."""
        return bool(grid["flow"] or grid["timing"])

    def printed_cells(self, grid: dict, row: dict) -> list[dict]:
        """The cells of a row that are printed."""
        keys = [column["key"] for column in grid["columns"]]
        cells = dict(zip(keys, row["cells"]))
        if grid["timing"]:
            return [cells["event"]] if cells["step"]["text"] else []
        if grid["flow"]:
            return [cells["block"], cells["does"]] if cells.get("does", {}).get("text") else []
        return row["cells"]

    def figures(self, table: dict) -> None:
        """A picture is on one page with its caption, and all of its texts do."""
        figure = table["figure"]
        caption = squeezed(
            f"{self.context['words']['figure']} {figure['number']} {figure['title']['text']}" if figure else table["title"]["text"]
        )
        for grid in table["grids"]:
            signals = grid["timing"]["signals"] if grid["timing"] else []
            switches = grid["hysteresis"]["switches"] if grid["hysteresis"] else []
            texts = [text for signal in signals for text in (signal["name"], signal["place"])]
            texts += [level["text"] for signal in signals for level in signal["levels"]]
            texts += [text for switch in switches for text in (switch["name"], *(one["text"] for one in switch["texts"]))]
            texts += [line["text"] for box in (grid["flow"] or {"boxes": []})["boxes"] for line in box["lines"]]
            texts += [arrow["label"]["text"] for arrow in (grid["flow"] or {"arrows": []})["arrows"] if arrow["label"]]
            axis = grid["axis"] or {"marks": [], "spans": []}
            texts += [line["text"] for part in axis["marks"] + axis["spans"] for line in part["lines"]]
            if figure and grid["machine"]:
                texts += [state["name"] for state in grid["machine"]["states"]]
            if figure and grid["bits"]:
                texts += [field["name"] for row in grid["bits"]["rows"] for field in row["fields"]]
            if not texts:
                continue
            wanted = [squeezed(text) for text in texts]
            # Without a caption, the texts are somewhere on one page.
            behind = [page[page.index(caption) :] for page in self.raw if caption in page]
            self.check(
                any(all(text in page for text in wanted) for page in behind), f"parted from its picture: {caption}"
            )


def main() -> int:
    try:
        if not shutil.which("pdftotext"):
            raise Missing("pdftotext is missing; install poppler-utils")
        weasyprint = install()
        if sys.argv[1:] == ["--install"]:
            return 0
    except Missing as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    passed = failed = 0
    for argument in sys.argv[1:]:
        docs = Path(argument).resolve()
        manual = Manual(docs, weasyprint)
        manual.run()
        print(f"== {docs.name}: {len(manual.raw)} pages", flush=True)
        for failure in manual.failures[:40]:
            print(f"FAILED {failure}")
        passed, failed = passed + manual.passed, failed + len(manual.failures)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
