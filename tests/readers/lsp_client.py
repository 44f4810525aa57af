#!/usr/bin/env python3
"""Sessions with `odgen lsp` by a client that others wrote: pygls, whose types (lsprotocol) read each answer.

    lsp_client.py --odgen target/debug/odgen od-spec/devices/pitch-control-system.od.yaml ...

Each specification is opened as it is, broken in the middle, and fixed again. What is said about it is compared with
`odgen check --notes`; every request that the server says it answers is asked at places all over the text, and what comes
back has to have the types of the protocol, with ranges that lie in the text. Exit code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import shutil
import subprocess
import sys
from pathlib import Path

import attrs
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.client import LanguageClient

PATIENCE = 120
# Every so many lines, requests at a position are asked.
STEP = 97


class Client(LanguageClient):
    """Keeps what is published."""

    def __init__(self) -> None:
        super().__init__("odgen-tests", "1")
        self.said: dict[tuple[str, int | None], list[lsp.Diagnostic]] = {}
        self.news = asyncio.Event()
        self.errors: list[str] = []

        @self.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def publish(params: lsp.PublishDiagnosticsParams) -> None:
            self.said[(params.uri, params.version)] = list(params.diagnostics)
            self.news.set()

        @self.feature(lsp.WINDOW_LOG_MESSAGE)
        def log(params: lsp.LogMessageParams) -> None:
            self.errors.append(params.message)

    def report_server_error(self, error: Exception, source: object) -> None:
        self.errors.append(f"{source}: {error!r}")

    async def diagnostics(self, uri: str, version: int) -> list[lsp.Diagnostic]:
        while (uri, version) not in self.said:
            self.news.clear()
            await asyncio.wait_for(self.news.wait(), PATIENCE)
        return self.said[(uri, version)]


class Check:
    def __init__(self) -> None:
        self.done = 0
        self.wrong: list[str] = []

    def that(self, is_right: bool, what: str) -> None:
        self.done += 1
        if not is_right:
            self.wrong.append(what)


def ranges(value: object, uri: str, here: str):
    """Every range of an answer that is about a document; `here` is the document of values that name none."""
    if isinstance(value, lsp.Range):
        if here == uri:
            yield value
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from ranges(item, uri, here)
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from ranges(item, uri, key if isinstance(key, str) and ":" in key else here)
    elif attrs.has(type(value)):
        here = getattr(value, "uri", None) or getattr(value, "target_uri", None) or here
        for field in attrs.fields(type(value)):
            yield from ranges(getattr(value, field.name), uri, here)


def lies_in(lines: list[str], found: lsp.Range) -> bool:
    def is_place(place: lsp.Position) -> bool:
        length = len(lines[place.line].encode("utf-16-le")) // 2 if place.line < len(lines) else -1
        return place.character <= length

    start, end = found.start, found.end
    return is_place(start) and is_place(end) and (start.line, start.character) <= (end.line, end.character)


def checked(odgen: Path, spec: Path) -> list[tuple[str, int]]:
    """Code and line of each message that `odgen check` has for a file."""
    command = [odgen, "check", "--notes", "--format", "json", spec]
    out = subprocess.run(command, capture_output=True, text=True, check=False)
    messages = [json.loads(line) for line in (out.stdout + out.stderr).splitlines() if line.startswith("{")]
    places = []
    for message in messages:
        if "code" in message:
            place = message.get("labels", [message])[0]
            if Path(place.get("file", "")).name == spec.name:
                places.append((message["code"], place["line"]))
    return sorted(places)


REQUESTS = [
    ("hover_provider", "text_document_hover_async", lsp.HoverParams),
    ("completion_provider", "text_document_completion_async", lsp.CompletionParams),
    ("definition_provider", "text_document_definition_async", lsp.DefinitionParams),
    ("references_provider", "text_document_references_async", lsp.ReferenceParams),
    ("rename_provider", "text_document_prepare_rename_async", lsp.PrepareRenameParams),
]


async def session(client: Client, server: lsp.ServerCapabilities, odgen: Path, spec: Path, check: Check) -> None:
    text = spec.read_text(encoding="utf-8")
    uri = spec.resolve().as_uri()
    client.text_document_did_open(
        lsp.DidOpenTextDocumentParams(lsp.TextDocumentItem(uri=uri, language_id="yaml", version=1, text=text))
    )
    said = await client.diagnostics(uri, 1)
    found = sorted((str(one.code), one.range.start.line + 1) for one in said)
    expected = checked(odgen, spec)
    check.that(found == expected, f"{spec.name}: {found} is said, and {expected} on the command line")
    await ask(client, server, uri, text, spec.name, check)
    symbols = await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=lsp.TextDocumentIdentifier(uri=uri))
    )
    names = {symbol.name for symbol in symbols or []}
    check.that({"devices", "objects"} <= names, f"{spec.name}: symbols are {names}")

    # Broken in the middle, with a wide character before it: nothing is lost.
    lines = text.splitlines()
    middle = next(at for at in range(len(lines) // 2, len(lines)) if lines[at].startswith("  0x"))
    broken = "\n".join([*lines[:middle], "  0x2FFF: {name: °🌀, type: [unsigned8", *lines[middle:], ""])
    change(client, uri, 2, broken)
    said = await client.diagnostics(uri, 2)
    check.that(any(one.severity == lsp.DiagnosticSeverity.Error for one in said), f"{spec.name}: a broken text is right")
    await ask(client, server, uri, broken, f"{spec.name}, broken", check)
    change(client, uri, 3, text)
    said = await client.diagnostics(uri, 3)
    check.that(sorted((str(one.code), one.range.start.line + 1) for one in said) == expected, f"{spec.name}: fixed")
    client.text_document_did_close(lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(uri=uri)))


def change(client: Client, uri: str, version: int, text: str) -> None:
    client.text_document_did_change(
        lsp.DidChangeTextDocumentParams(
            text_document=lsp.VersionedTextDocumentIdentifier(version=version, uri=uri),
            content_changes=[lsp.TextDocumentContentChangeWholeDocument(text=text)],
        )
    )


async def ask(
    client: Client, server: lsp.ServerCapabilities, uri: str, text: str, name: str, check: Check
) -> None:
    """Asks everything, and looks at the ranges of each answer."""
    document = lsp.TextDocumentIdentifier(uri=uri)
    lines = text.splitlines() + [""]
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(len(lines), 0))
    answers: list[tuple[str, object]] = [
        ("folding", await client.text_document_folding_range_async(lsp.FoldingRangeParams(document))),
        ("symbols", await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(document))),
        (
            "formatting",
            await client.text_document_formatting_async(
                lsp.DocumentFormattingParams(document, lsp.FormattingOptions(tab_size=2, insert_spaces=True))
            ),
        ),
        (
            "actions",
            await client.text_document_code_action_async(
                lsp.CodeActionParams(document, whole, lsp.CodeActionContext(diagnostics=[]))
            ),
        ),
        ("workspace symbols", await client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query="10"))),
    ]
    if server.inlay_hint_provider:
        hints = await client.text_document_inlay_hint_async(lsp.InlayHintParams(document, whole))
        answers.append(("inlay hints", hints))
    asked = [one for one in REQUESTS if getattr(server, one[0])]
    for line in range(0, len(lines), STEP):
        character = min(len(lines[line]), 7 + line % 13)
        place = lsp.Position(line, character)
        for provider, method, params in asked:
            more = {"context": lsp.ReferenceContext(include_declaration=True)} if "references" in method else {}
            try:
                answer = await getattr(client, method)(params(text_document=document, position=place, **more))
            except JsonRpcException as refused:
                # What cannot be renamed is refused with the reason; nothing else is.
                check.that("rename" in method and bool(refused.message), f"{name}: {provider}: {refused}")
                continue
            answers.append((f"{provider} at {line + 1}:{character + 1}", answer))
    for what, answer in answers:
        wrong = [found for found in ranges(answer, uri, uri) if not lies_in(lines, found)]
        check.that(not wrong, f"{name}: {what}: {wrong[:1]} lies outside")


# Language, name and text of documents, and whether they are for odgen: the extension sends them, and the server has something to say.
CONTENTS = [
    ("yaml", "a.yaml", "# comment\n\nod-spec: 1\n", True),
    ("yaml", "b.yaml", "title: Pump\nod-spec: 1\n", True),
    ("yaml", "c.yaml", "part-of: pump.od.yaml\n", True),
    ("yaml", "plant.yaml", "title: Plant\nod-plant : 1\n", True),
    ("yaml", "values.yaml", "spec: pump.od.yaml\nod-parameters: 1\n", True),
    ("yaml", "late.yaml", "# comment\n" * 100 + "od-spec: 1\n", False),
    ("yaml", "parameters.yaml", "services: {}\n", False),
    ("yaml", "d.yaml", "about: od-spec is a language\n", False),
    ("yaml", "a.od.yaml", "", True),
    ("canopen-eds", "a.eds", "", True),
    ("json", "a.json", "{}", False),
]


async def contents(client: Client, check: Check) -> None:
    """The server takes the same files as the extension; each of them is wrong."""
    for language, name, text, is_ours in CONTENTS:
        uri = f"file:///nowhere/{name}"
        item = lsp.TextDocumentItem(uri=uri, language_id=language, version=1, text=text)
        client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        said = await client.diagnostics(uri, 1)
        check.that(bool(said) == is_ours, f"{name}: {[one.message for one in said]}")


def of_editors(check: Check) -> None:
    """The extension for VS Code is JavaScript, as far as there is something that reads it."""
    extension = Path(__file__).resolve().parents[2] / "od-gen/lsp/vscode"
    manifest = json.loads((extension / "package.json").read_text(encoding="utf-8"))
    contributes = manifest["contributes"]
    named = [manifest["icon"], manifest["main"]]
    named += [one["path"] for one in contributes["grammars"]]
    named += [one["configuration"] for one in contributes["languages"] if "configuration" in one]
    for name in named:
        check.that((extension / name).is_file(), f"the extension names {name}, which is not there")
    for name in extension.glob("**/*.json"):
        json.loads(name.read_text(encoding="utf-8"))
    if node := shutil.which("node"):
        for script in extension.glob("*.js"):
            read = subprocess.run([node, "--check", script], capture_output=True, text=True, check=False)
            check.that(read.returncode == 0, read.stderr)
        script = Path(__file__).resolve().parents[1] / "editors/extension.js"
        read = subprocess.run([node, script], capture_output=True, text=True, check=False)
        check.that(read.returncode == 0, read.stderr)
        for language, name, text, is_ours in CONTENTS:
            code = "const [a, b, c] = process.argv.slice(1); console.log(require('./content').isOurs(a, b, () => c))"
            command = [node, "-e", code, language, name, text]
            said = subprocess.run(command, cwd=extension, capture_output=True, text=True, check=False)
            check.that(said.stdout.strip() == str(is_ours).lower(), f"{name}: {said.stdout}{said.stderr}")


async def run(odgen: Path, specs: list[Path]) -> int:
    check = Check()
    client = Client()
    await client.start_io(str(odgen), "lsp", "--stdio")
    answer = await client.initialize_async(
        lsp.InitializeParams(capabilities=lsp.ClientCapabilities(), process_id=None, root_uri=None)
    )
    check.that(answer.capabilities.position_encoding == lsp.PositionEncodingKind.Utf16, "positions are not in UTF-16")
    client.initialized(lsp.InitializedParams())
    for spec in specs:
        await session(client, answer.capabilities, odgen, spec, check)
    await contents(client, check)
    await client.shutdown_async(None)
    client.exit(None)
    await client.stop()
    of_editors(check)
    for error in client.errors:
        check.that(False, error)
    for wrong in check.wrong[:40]:
        print(wrong, file=sys.stderr)
    print(f"odgen lsp with pygls: {check.done} checks, {len(check.wrong)} wrong")
    return 1 if check.wrong or check.done < 50 else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--odgen", required=True, type=Path)
    parser.add_argument("specs", nargs="+", type=Path)
    args = parser.parse_args()
    return asyncio.run(run(args.odgen, args.specs))


if __name__ == "__main__":
    sys.exit(main())
