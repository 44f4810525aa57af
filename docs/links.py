"""A hook of MkDocs for links to files outside the book, which lead somewhere in a clone of the repository.

In the built book, a link to a file that one of its pages shows leads to this page. Any other becomes
plain text, because the book is built without the repository around it.
"""

import logging
import posixpath
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BOOK = "docs/book"
SHOWN = re.compile(r'--8<-- "(.+)"')
OUTSIDE = re.compile(r"\[([^\]]*)\]\(((?:\.\./)+[^)#\s]*)(#[^)\s]*)?\)")

log = logging.getLogger("mkdocs.hooks.links")
pages = {}  # from a file to the page that shows it


def on_files(files, config):
    for file in files.documentation_pages():
        if shown := SHOWN.match(file.content_string):
            pages[shown[1]] = file.src_uri


def on_page_markdown(markdown, page, config, files):
    here = posixpath.dirname(page.file.src_uri)

    def in_the_book(link):
        text, target, anchor = link[1], link[2], link[3] or ""
        path = posixpath.normpath(posixpath.join(BOOK, here, target))
        if path.startswith(f"{BOOK}/"):
            return link[0]
        if path in pages:
            return f"[{text}]({posixpath.relpath(pages[path], here or '.')}{anchor})"
        if not (ROOT / path).exists():
            log.warning("%s links to %s, which does not exist", page.file.src_uri, path)
        return text

    return OUTSIDE.sub(in_the_book, markdown)
