// The extension for VS Code with an editor that only pretends: when it starts the server, and what it shows if there is no program.
"use strict";

const assert = require("assert");
const fs = require("fs");
const Module = require("module");
const os = require("os");
const path = require("path");

const load = Module._load;
const FOLDER = path.resolve(__dirname, "../../od-gen/lsp/vscode");

/** An editor with documents, a program and a server whose first starts fail; what the extension did. */
function session(documents, program, failures = 0) {
  const seen = { messages: [], started: 0, commands: {}, opened: undefined, texts: {}, pages: [], picks: [], said: [] };
  class LanguageClient {
    constructor(id, name, server, options) {
      seen.server = server;
      seen.options = options;
    }
    async start() {
      if (failures > 0) {
        failures -= 1;
        throw new Error("refused");
      }
      seen.started += 1;
    }
    async stop() {}
  }
  const event = (listener) => ({ dispose() {}, listener });
  const vscode = {
    commands: {
      registerCommand: (name, action) => {
        seen.commands[name] = action;
        return { dispose() {} };
      },
      executeCommand: async () => undefined,
    },
    env: {},
    Location: class {},
    Position: class {},
    Range: class {},
    Uri: { parse: (text) => text, file: (text) => text, from: ({ scheme, path }) => `${scheme}:${path}` },
    EventEmitter: class {
      event = event;
      fire() {}
    },
    ViewColumn: { Beside: 2 },
    window: {
      activeTextEditor: documents.length ? { document: documents[0] } : undefined,
      createWebviewPanel: (_, title) => {
        const panel = { title, webview: { html: "" } };
        seen.pages.push(panel);
        return panel;
      },
      showOpenDialog: async () => [{ fsPath: "/earlier.eds" }],
      showQuickPick: async (names) => {
        seen.picks.push(names);
        return names[0];
      },
      showTextDocument: async () => undefined,
      onDidChangeActiveTextEditor: event,
      showErrorMessage: async (text, ...choices) => {
        seen.messages.push({ text, choices });
      },
      showInformationMessage: async (text) => {
        seen.said.push(text);
      },
    },
    workspace: {
      textDocuments: documents,
      getConfiguration: () => ({ get: (key) => ({ path: program, hints: ["raw-values"] })[key] }),
      onDidOpenTextDocument: (listener) => {
        seen.opened = listener;
        return { dispose() {} };
      },
      onDidSaveTextDocument: event,
      registerTextDocumentContentProvider: (_, provider) => {
        seen.provider = provider;
        return { dispose() {} };
      },
      openTextDocument: async (uri) => {
        seen.texts[uri] = seen.provider.provideTextDocumentContent(uri);
      },
      onDidChangeConfiguration: event,
    },
  };
  // It stays: a restart loads the client again.
  Module._load = (name, ...rest) => {
    const fakes = { vscode, "vscode-languageclient/node": { LanguageClient } };
    return fakes[name] ?? load(name, ...rest);
  };
  const file = path.join(FOLDER, "extension.js");
  delete require.cache[file];
  const extension = require(file);
  const context = { subscriptions: [], asAbsolutePath: (name) => path.join(FOLDER, name) };
  return { seen, started: extension.activate(context) };
}

const document = (languageId, fileName, text) => ({
  languageId,
  fileName,
  getText: () => text,
  uri: { scheme: "file" },
  save: async () => true,
});
const foreign = document("yaml", "compose.yaml", "services: {}\n");
const plant = document("yaml", "farm.yaml", "# A farm\nod-plant: 1\n");

// A program that runs and takes `--version`: this one.
const node = process.execPath;

/** A program that builds an EDS and the pages of a device, finds one change, and notes the folder that it builds into. */
function builder(folder) {
  const program = path.join(folder, "odgen");
  fs.writeFileSync(
    program,
    `#!${process.execPath}
const fs = require("fs");
const path = require("path");
const [command, ...rest] = process.argv.slice(2);
if (command === "build" && rest.includes("--out")) {
  const out = rest[rest.indexOf("--out") + 1];
  fs.writeFileSync(${JSON.stringify(path.join(folder, "out"))}, out);
  for (const name of ["eds/valve.eds", "docs/valve/index.html", "docs/valve/valve.html"]) {
    fs.mkdirSync(path.join(out, path.dirname(name)), { recursive: true });
    fs.writeFileSync(path.join(out, name), name);
  }
} else if (command === "build" && rest.includes("/broken.od.yaml")) {
  console.error("warning[OD0001]: a warning\\n\\nerror[OD0608]: there is no unit");
  process.exit(1);
} else if (command === "build") {
  console.log("  generated/valve.json\\n  2 files changed, 1 unchanged\\nto open:\\n  EDS  generated/eds/valve.eds");
} else if (command === "diff") {
  console.log("1 change");
  process.exit(1);
}
`,
    { mode: 0o755 },
  );
  return program;
}

const CASES = {
  "previews and comparisons belong to no file, and leave none": async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "odgen-test-"));
    const spec = document("yaml", path.join(folder, "valve.od.yaml"), "od-spec: 1\n");
    const { seen, started } = session([spec], builder(folder));
    await started;
    await seen.commands["odgen.previewEds"]();
    const out = fs.readFileSync(path.join(folder, "out"), "utf8");
    await seen.commands["odgen.diff"]();
    await seen.commands["odgen.previewPage"]();
    assert.deepStrictEqual(seen.messages, []);
    assert.deepStrictEqual(seen.texts, {
      "odgen-preview:/valve.eds": "eds/valve.eds",
      "odgen-preview:/earlier.eds → valve.od.yaml.txt": "1 change\n",
    });
    // There is one page of the device: nothing is asked.
    assert.deepStrictEqual(seen.picks, []);
    assert.deepStrictEqual(
      seen.pages.map((panel) => [panel.title, panel.webview.html]),
      [["valve.html", "docs/valve/valve.html"]],
    );
    assert.ok(!fs.existsSync(out), `${out} is left`);
    await seen.commands["odgen.build"]();
    assert.deepStrictEqual(seen.said, ["2 files changed, 1 unchanged"]);
    fs.rmSync(folder, { recursive: true });
  },
  "of what is wrong, an error is shown": async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "odgen-test-"));
    const spec = document("yaml", "/broken.od.yaml", "od-spec: 1\n");
    const { seen, started } = session([spec], builder(folder));
    await started;
    await seen.commands["odgen.build"]();
    assert.deepStrictEqual(
      seen.messages.map((message) => message.text),
      ["error[OD0608]: there is no unit"],
    );
    fs.rmSync(folder, { recursive: true });
  },
  "foreign YAML starts nothing": async () => {
    const { seen, started } = session([foreign], node);
    await started;
    assert.deepStrictEqual([seen.started, seen.messages], [0, []]);
  },
  "a plant starts the server, whatever it is called": async () => {
    const { seen, started } = session([foreign, plant], node);
    await started;
    assert.strictEqual(seen.started, 1);
    assert.deepStrictEqual(seen.server, { command: node, args: ["lsp"] });
    assert.deepStrictEqual(seen.options.initializationOptions.inlayHints, ["raw-values"]);
  },
  "an EDS starts it": async () => {
    const { seen, started } = session([document("canopen-eds", "a.eds", "")], node);
    await started;
    assert.strictEqual(seen.started, 1);
  },
  "without the program, foreign YAML has no message": async () => {
    const { seen, started } = session([foreign], "no-such-program");
    await started;
    assert.deepStrictEqual(seen.messages, []);
  },
  "without the program, there is one message": async () => {
    const { seen, started } = session([plant, plant], "no-such-program");
    await started;
    await seen.opened(plant);
    assert.strictEqual(seen.messages.length, 1);
    assert.match(seen.messages[0].text, /"no-such-program" was not found/);
    assert.deepStrictEqual(seen.messages[0].choices, ["Open Settings", "Copy Install Command"]);
    assert.strictEqual(seen.started, 0);
  },
  "a program that fails is not called missing": async () => {
    const { seen, started } = session([plant], "/dev/null");
    await started;
    assert.match(seen.messages[0].text, /does not run/);
  },
  "after a failed start, a restart starts the server": async () => {
    const { seen, started } = session([plant], node, 1);
    await started;
    assert.match(seen.messages[0].text, /The language server does not start: refused/);
    assert.strictEqual(seen.started, 0);
    await seen.commands["odgen.restart"]();
    assert.strictEqual(seen.started, 1);
  },
  "every command of the manifest runs something": async () => {
    const { seen, started } = session([], node);
    await started;
    const manifest = require(path.join(FOLDER, "package.json"));
    for (const { command } of manifest.contributes.commands) {
      assert.ok(seen.commands[command], `nothing runs ${command}`);
    }
  },
};

(async () => {
  let failed = 0;
  for (const [name, test] of Object.entries(CASES)) {
    await test().catch((error) => {
      failed += 1;
      console.error(`${name}: ${error.message}`);
    });
  }
  console.log(`${Object.keys(CASES).length - failed} passed, ${failed} failed: the extension for VS Code`);
  process.exit(failed ? 1 : 0);
})();
