#!/usr/bin/env python3
"""Lay a manual out on paper, and say what lies where.

    layout.py HTML PDF

Runs in the environment of WeasyPrint. Writes the PDF and, to standard output, one JSON object for each page: `height` and `bottom` (of the
area of the text and of what is in it), `blocks` (what is on it, in order: `kind`, `id` of the section or object around it, `text`), `tables`
(heights of the rows of each on this page, and what is the same table on other pages), `sizes` (of the letters in points, those of pictures as
they are scaled, with a sample of each), `short` (lines of text that end early), `overfull` (sections whose table is wider than the text).
"""

from __future__ import annotations

import json
import re
import sys

import weasyprint

# CSS counts in pixels, paper in points.
POINTS = 0.75
HEADINGS = {"h1", "h2", "h3", "h4", "h5", "h6"}
# What begins on a page of its own.
CHAPTERS = ("part level-1", "part appendix", "notation", "warnings", "title", "imprint", "contents")


def text_of(box) -> str:
    return " ".join(part.text for part in descendants(box) if type(part).__name__ == "TextBox").strip()


def descendants(box):
    yield box
    for child in getattr(box, "children", ()):
        yield from descendants(child)


def class_of(box) -> str:
    element = getattr(box, "element", None)
    return element.get("class", "") if element is not None else ""


def id_of(box) -> str:
    element = getattr(box, "element", None)
    return element.get("id", "") if element is not None else ""


def is_chapter(box) -> bool:
    tag = getattr(box, "element_tag", "")
    return tag in ("section", "nav") and class_of(box).startswith(CHAPTERS)


def block(box, around: str) -> dict | None:
    """What a box is to a reader, if it is one thing."""
    kind = type(box).__name__
    tag = getattr(box, "element_tag", "")
    if tag in HEADINGS:
        return {"kind": "heading", "level": int(tag[1]), "id": around, "text": text_of(box)}
    if "warning" in class_of(box).split() and tag in ("p", "div"):
        return {"kind": "warning", "id": around, "text": text_of(box)}
    if tag == "p" and class_of(box) in ("caption", "object-head"):
        return {"kind": "caption", "id": around, "text": text_of(box)}
    if is_picture(box):
        return {"kind": "picture", "id": around, "text": ""}
    if tag == "tr" and kind == "TableRowBox":
        return {"kind": "row", "id": around, "text": text_of(box)}
    if tag in ("p", "li") and kind == "BlockBox":
        return {"kind": "text", "id": around, "text": text_of(box)}
    return None


def is_picture(box) -> bool:
    # The name of an element of SVG has its namespace before it.
    return getattr(box, "element_tag", "").endswith("}svg") and type(box).__name__.endswith("ReplacedBox")


def letters(box):
    """Sizes of the letters of a picture, each with its text: as its own style sheet says, scaled to the width that it has on the page."""
    picture = box.element
    *_, width, height = (float(number) for number in picture.get("viewBox").split())
    scale = min(box.width / width, box.height / height) * POINTS
    rules = {}
    for sheet in picture.iterfind(".//{*}style"):
        for names, declarations in re.findall(r"([^{}]+)\{([^}]*)\}", sheet.text or ""):
            if found := re.search(r"font-size:([\d.]+)px", declarations):
                rules.update((name.strip(), float(found[1])) for name in names.split(","))

    def walk(element, inherited):
        name = element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
        size = rules.get(name, inherited)
        for one in element.get("class", "").split():
            size = rules.get(f".{one}", size)
        if name in ("text", "tspan") and (element.text or "").strip():
            yield round(size * scale, 2), element.text.strip()
        for child in element:
            yield from walk(child, size)

    # Letters whose size no rule names are too small, so that they are seen.
    return walk(picture, 0.0)


def short_lines(box):
    """Lines that end in the first half of their text, though neither the text nor a line of its own ends there."""
    lines = [child for child in box.children if type(child).__name__ == "LineBox"]
    for line, following in zip(lines, lines[1:]):
        parts = list(descendants(line))
        width = max((part.position_x + part.width for part in parts if type(part).__name__ == "TextBox"), default=0) - line.position_x
        has_break = any(getattr(part, "element_tag", "") == "br" for part in parts)
        # A long word may take its whole line.
        next_word = len(text_of(following).split(" ")[0])
        if not has_break and width < box.width / 2 and next_word < 20:
            yield text_of(line)


class Page:
    """What lies on a page."""

    def __init__(self, page) -> None:
        box = page._page_box
        top = box.content_box_y()
        self.found = {"height": box.height, "bottom": 0.0, "chapter": False, "blocks": [], "tables": [], "sizes": {}, "short": [], "overfull": []}
        self.right = box.content_box_x() + box.width
        for child in box.children:
            if type(child).__name__ != "MarginBox":
                self.walk(child, "", top)

    def walk(self, box, around: str, top: float) -> None:
        kind = type(box).__name__
        tag = getattr(box, "element_tag", "")
        if is_chapter(box) and not self.found["blocks"]:
            # On the first page of a box its heading is not yet known.
            first = next((part for part in descendants(box) if getattr(part, "element_tag", "") in HEADINGS | {"p", "table", "li"}), None)
            self.found["chapter"] = first is not None and (first.element_tag in ("h1", "h2") or class_of(box) in ("imprint", "title"))
        if tag in ("section", "article") and id_of(box):
            around = id_of(box)
        if kind == "TextBox":
            size = round(box.style["font_size"] * POINTS, 2)
            self.found["sizes"].setdefault(str(size), box.text[:60])
        if is_picture(box):
            self.letters(box)
        if kind == "LineBox" or kind.endswith("ReplacedBox"):
            self.found["bottom"] = max(self.found["bottom"], box.position_y + box.height - top)
        if tag == "table" and kind == "TableBox":
            # Half a pixel is the width of a line.
            if box.border_box_x() + box.border_width() > self.right + 1:
                self.found["overfull"].append(around)
            groups = [group for group in box.children if not getattr(group, "is_header", False)]
            rows = [row for group in groups for row in group.children]
            heights = [row.height for row in rows]
            self.found["tables"].append({"id": around, "element": id(box.element), "heights": heights})
        if tag in ("p", "li") and kind == "BlockBox":
            self.found["short"] += short_lines(box)
        one = block(box, around)
        if one:
            self.found["blocks"].append(one)
            if one["kind"] != "row":
                return self.sizes(box, top)
        for child in getattr(box, "children", ()):
            self.walk(child, around, top)

    def letters(self, picture) -> None:
        for size, sample in letters(picture):
            self.found["sizes"].setdefault(str(size), sample[:60])

    def sizes(self, box, top: float) -> None:
        for part in descendants(box):
            kind = type(part).__name__
            if kind == "TextBox":
                size = round(part.style["font_size"] * POINTS, 2)
                self.found["sizes"].setdefault(str(size), part.text[:60])
            if kind == "LineBox" or kind.endswith("ReplacedBox"):
                self.found["bottom"] = max(self.found["bottom"], part.position_y + part.height - top)


def main() -> None:
    document = weasyprint.HTML(filename=sys.argv[1]).render()
    document.write_pdf(sys.argv[2])
    for page in document.pages:
        print(json.dumps(Page(page).found))


if __name__ == "__main__":
    main()
