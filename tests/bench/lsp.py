"""From a keystroke to its diagnostics: `odgen lsp` on a specification, over standard input and output.

    cargo build --release -p odgen
    python3 tests/bench/lsp.py [SPEC] [--keys N] [--odgen PATH]

Types a word into the specification, letter by letter, and waits for what is said about each version; asks for symbols,
folding and formatting of the same text. Prints median and slowest of each, and the memory that the server uses.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Server:
    """A running server."""

    def __init__(self, odgen):
        self.process = subprocess.Popen([odgen, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.next_id = 0

    def send(self, message):
        text = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(text) + text)
        self.process.stdin.flush()

    def read(self):
        length = 0
        while (line := self.process.stdout.readline().strip()):
            name, _, value = line.partition(b":")
            if name == b"Content-Length":
                length = int(value)
        return json.loads(self.process.stdout.read(length))

    def request(self, method, params):
        self.next_id += 1
        self.send({"id": self.next_id, "method": method, "params": params})
        while (answer := self.read()).get("id") != self.next_id:
            pass
        if "error" in answer:
            raise SystemExit(f"{method}: {answer['error']}")
        return answer["result"]

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def diagnostics(self, uri, version):
        while True:
            message = self.read()
            params = message.get("params", {})
            if message.get("method") == "textDocument/publishDiagnostics" and params["uri"] == uri:
                if params.get("version") == version:
                    return params["diagnostics"]

    def computing(self):
        """What the server has computed for, in ms."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) * 1000 / os.sysconf("SC_CLK_TCK")

    def memory(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("spec", nargs="?", default=ROOT / "od-spec/devices/pitch-control-system.od.yaml", type=pathlib.Path)
    parser.add_argument("--keys", default=200, type=int)
    parser.add_argument("--odgen", default=ROOT / "target/release/odgen")
    args = parser.parse_args()
    text = args.spec.read_text(encoding="utf-8")
    uri = args.spec.resolve().as_uri()
    server = Server(args.odgen)
    server.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
    server.notify("initialized", {})
    started = time.perf_counter()
    document = {"uri": uri, "languageId": "yaml", "version": 1, "text": text}
    server.notify("textDocument/didOpen", {"textDocument": document})
    server.diagnostics(uri, 1)
    print(f"{args.spec.name}: {len(text.splitlines())} lines; opened in {(time.perf_counter() - started) * 1000:.1f} ms")
    # A comment after the middle line grows: everything is read anew, and nothing becomes wrong.
    line = len(text.splitlines()) // 2
    column = len(text.splitlines()[line].encode("utf-16-le")) // 2
    took, before = [], server.computing()
    for key in range(args.keys):
        place = {"line": line, "character": column}
        letter = " # typed"[key] if key < 8 else "x"
        change = {"range": {"start": place, "end": place}, "text": letter}
        started = time.perf_counter()
        document = {"uri": uri, "version": key + 2}
        server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        server.diagnostics(uri, key + 2)
        took.append((time.perf_counter() - started) * 1000)
        column += 1
    show("keystroke to diagnostics", took)
    print(f"  of computing: {(server.computing() - before) / args.keys:.1f} ms each, however busy the machine is")
    for method, params in [
        ("textDocument/documentSymbol", {}),
        ("textDocument/foldingRange", {}),
        ("textDocument/formatting", {"options": {"tabSize": 2, "insertSpaces": True}}),
        ("workspace/symbol", {"query": "6041"}),
    ]:
        took = []
        for _ in range(20):
            started = time.perf_counter()
            server.request(method, {"textDocument": {"uri": uri}, **params})
            took.append((time.perf_counter() - started) * 1000)
        show(method, took)
    at_places(server, uri, args.keys + 2, text)
    print(f"memory: {server.memory()} kB")
    server.request("shutdown", None)
    server.notify("exit", None)
    server.process.wait()


def at_places(server, uri, version, text):
    """What is asked at a place: each time after a keystroke, so that nothing is known from before."""
    lines = text.splitlines()
    places = [number for number, line in enumerate(lines) if "unit: " in line or "type: " in line][::40]
    start = {"line": 0, "character": 0}
    whole = {"start": start, "end": {"line": len(lines), "character": 0}}
    for method, params in [
        ("textDocument/hover", {}),
        ("textDocument/definition", {}),
        ("textDocument/references", {"context": {"includeDeclaration": True}}),
        ("textDocument/completion", {}),
        ("textDocument/inlayHint", {"range": whole}),
    ]:
        took = []
        for line in places:
            column = lines[line].index("unit: " if "unit: " in lines[line] else "type: ") + 7
            version += 1
            change = {"range": {"start": start, "end": start}, "text": "#"}
            document = {"uri": uri, "version": version}
            started = time.perf_counter()
            server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
            place = {"line": line, "character": column}
            server.request(method, {"textDocument": {"uri": uri}, "position": place, **params})
            took.append((time.perf_counter() - started) * 1000)
            server.diagnostics(uri, version)
        show(f"keystroke to {method}", took)
    line = next(number for number, line in enumerate(lines) if line.startswith("  decicelsius:"))
    took = []
    for _ in range(5):
        started = time.perf_counter()
        place = {"line": line, "character": 4}
        params = {"textDocument": {"uri": uri}, "position": place, "newName": "tenth of a degree"}
        server.request("textDocument/rename", params)
        took.append((time.perf_counter() - started) * 1000)
    show("textDocument/rename", took)


def show(what, took):
    print(f"{what}: median {statistics.median(took):.1f} ms, slowest {max(took):.1f} ms")


if __name__ == "__main__":
    main()
