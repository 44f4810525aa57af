// The extension for VS Code with an editor that only pretends: when it starts the server, and what it shows if there is no program.
"use strict";

const assert = require("assert");
const Module = require("module");
const path = require("path");

const load = Module._load;
const FOLDER = path.resolve(__dirname, "../../od-gen/lsp/vscode");

/** An editor with documents, a program and a server whose first starts fail; what the extension did. */
function session(documents, program, failures = 0) {
  const seen = { messages: [], started: 0, commands: {}, opened: undefined };
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
    Uri: { parse: (text) => text, file: (text) => text },
    ViewColumn: { Beside: 2 },
    window: {
      activeTextEditor: undefined,
      onDidChangeActiveTextEditor: event,
      showErrorMessage: async (text, ...choices) => {
        seen.messages.push({ text, choices });
      },
      showInformationMessage: async () => undefined,
    },
    workspace: {
      textDocuments: documents,
      getConfiguration: () => ({ get: (key) => ({ path: program, hints: ["raw-values"] })[key] }),
      onDidOpenTextDocument: (listener) => {
        seen.opened = listener;
        return { dispose() {} };
      },
      onDidSaveTextDocument: event,
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

const document = (languageId, fileName, text) => ({ languageId, fileName, getText: () => text });
const foreign = document("yaml", "compose.yaml", "services: {}\n");
const plant = document("yaml", "farm.yaml", "# A farm\nod-plant: 1\n");

// A program that runs and takes `--version`: this one.
const node = process.execPath;

const CASES = {
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
