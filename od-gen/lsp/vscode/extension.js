// Starts `odgen lsp` when the first document for it is open, and runs `odgen` for the commands.
"use strict";

const { execFile } = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");
const { commands, env, EventEmitter, Location, Position, Range, Uri, ViewColumn, window, workspace } = require("vscode");
const { isOurs } = require("./content");

let client;
let starting;
let hasComplained = false;

const isForUs = (document) => isOurs(document.languageId, document.fileName, () => document.getText());

/** The program: what the settings name, or that of the extension, which a platform's package has. */
function program(context) {
  const set = workspace.getConfiguration("odgen").get("path") || "odgen";
  const name = process.platform === "win32" ? "odgen.exe" : "odgen";
  const bundled = context.asAbsolutePath(path.join("bin", name));
  return set === "odgen" && fs.existsSync(bundled) ? bundled : set;
}

/** Runs odgen; the output, or an error with what it printed. */
function run(context, args, cwd) {
  return new Promise((resolve, reject) => {
    execFile(program(context), args, { cwd, maxBuffer: 1 << 26 }, (error, stdout, stderr) => {
      if (error && error.code === "ENOENT") {
        reject(Object.assign(new Error("not found"), { isMissing: true }));
      } else if (error) {
        reject(Object.assign(new Error(stderr.trim() || stdout.trim() || error.message), { code: error.code, stdout }));
      } else {
        resolve(stdout);
      }
    });
  });
}

/** One message with a way out. */
async function complain(context) {
  if (hasComplained) {
    return;
  }
  hasComplained = true;
  const text = `The program "${program(context)}" was not found. Install it with "cargo install odgen", or set its path.`;
  const choice = await window.showErrorMessage(text, "Open Settings", "Copy Install Command");
  if (choice === "Open Settings") {
    await commands.executeCommand("workbench.action.openSettings", "odgen.path");
  } else if (choice === "Copy Install Command") {
    await env.clipboard.writeText("cargo install odgen");
  }
}

async function start(context) {
  try {
    await run(context, ["--version"]);
  } catch (error) {
    if (error.isMissing) {
      complain(context);
    } else {
      window.showErrorMessage(`"${program(context)}" does not run: ${error.message.split("\n")[0]}`);
    }
    return;
  }
  // Only now: a workspace without CANopen never loads it.
  const { LanguageClient } = require("vscode-languageclient/node");
  const documentSelector = ["yaml", "canopen-eds", "canopen-xdd"].flatMap((language) => [
    { language, scheme: "file" },
    { language, scheme: "untitled" },
  ]);
  const starts = new LanguageClient(
    "odgen",
    "odgen",
    { command: program(context), args: ["lsp"] },
    {
      documentSelector,
      initializationOptions: {
        inlayHints: workspace.getConfiguration("odgen").get("hints"),
        suggestNext: "editor.action.triggerSuggest",
        showPlaces: "odgen.showPlaces",
      },
    },
  );
  await starts.start();
  client = starts;
}

/** Starts the server for the first document that needs it. */
async function look(context, document) {
  if (!client && !starting && isForUs(document)) {
    starting = start(context);
    try {
      await starting;
    } catch (error) {
      window.showErrorMessage(`The language server does not start: ${error.message}`);
    } finally {
      starting = undefined;
    }
  }
}

async function restart(context) {
  await starting?.catch(() => {});
  await client?.stop().catch(() => {});
  client = undefined;
  hasComplained = false;
  for (const document of workspace.textDocuments) {
    await look(context, document);
  }
}

/** The file of the active editor, saved. */
async function active() {
  const document = window.activeTextEditor?.document;
  if (!document || document.uri.scheme !== "file" || !isForUs(document)) {
    window.showInformationMessage("Open a specification, an EDS, a DCF, an XDD or an XDC first.");
    return undefined;
  }
  await document.save();
  return document.fileName;
}

/** Does something with odgen; what it refuses is shown. */
async function attempt(context, action) {
  const file = await active();
  if (!file) {
    return;
  }
  try {
    await action(file);
  } catch (error) {
    if (error.isMissing) {
      complain(context);
    } else {
      const lines = error.message.split("\n");
      window.showErrorMessage(lines.find((line) => line.startsWith("error")) ?? lines[0]);
    }
  }
}

/** All files below a folder. */
function below(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const full = path.join(folder, entry.name);
    return entry.isDirectory() ? below(full) : [full];
  });
}

/** Texts that are shown and belong to no file, by their URI. */
const shown = new Map();
const SCHEME = "odgen-preview";
const changed = new EventEmitter();

/** Shows a text next to the editor. It cannot be edited, and asks for nothing when it is closed. */
async function beside(name, text) {
  const uri = Uri.from({ scheme: SCHEME, path: `/${name}` });
  shown.set(uri.toString(), text);
  changed.fire(uri);
  await window.showTextDocument(await workspace.openTextDocument(uri), { viewColumn: ViewColumn.Beside, preview: true });
}

async function page(name, text) {
  const panel = window.createWebviewPanel("odgen.page", name, ViewColumn.Beside, { enableScripts: true });
  panel.webview.html = text;
}

/** Builds into a folder that is thrown away, and shows one of the files. */
async function preview(context, args, extension, show) {
  await attempt(context, async (file) => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "odgen-"));
    try {
      await run(context, ["build", ...args, "--out", folder, file], path.dirname(file));
      const made = below(folder).filter((one) => one.endsWith(extension) && path.basename(one) !== "index.html");
      const names = made.map((one) => path.relative(folder, one));
      const name = names.length > 1 ? await window.showQuickPick(names) : names[0];
      if (name) {
        await show(path.basename(name), fs.readFileSync(path.join(folder, name), "utf8"));
      }
    } finally {
      fs.rmSync(folder, { recursive: true, force: true });
    }
  });
}

async function diff(context) {
  await attempt(context, async (file) => {
    const filters = { "Specifications, EDS, DCF, XDD, XDC": ["yaml", "eds", "dcf", "xdd", "xdc"] };
    const chosen = await window.showOpenDialog({ title: "The earlier version", canSelectMany: false, filters });
    if (!chosen) {
      return;
    }
    const earlier = chosen[0].fsPath;
    // Exit code 1 reports a difference.
    const text = await run(context, ["diff", earlier, file]).catch((error) => {
      if (error.code === 1 && error.stdout) {
        return error.stdout;
      }
      throw error;
    });
    await beside(`${path.basename(earlier)} → ${path.basename(file)}.txt`, text);
  });
}

async function build(context) {
  await attempt(context, async (file) => {
    const text = await run(context, ["build", file], path.dirname(file));
    const counted = text.split("\n").find((line) => /^ *\d+ files? changed/.test(line));
    window.showInformationMessage(counted ? counted.trim() : "The files are up to date.");
  });
}

/** The places that a lens counts: from the protocol's form to that of the editor. */
function showPlaces(uri, position, places) {
  const at = ({ line, character }) => new Position(line, character);
  const locations = places.map(
    ({ uri, range }) => new Location(Uri.parse(uri), new Range(at(range.start), at(range.end))),
  );
  return commands.executeCommand("editor.action.showReferences", Uri.parse(uri), at(position), locations);
}

exports.activate = async (context) => {
  const command = (name, action) => context.subscriptions.push(commands.registerCommand(name, action));
  command("odgen.build", () => build(context));
  command("odgen.previewEds", () => preview(context, [], ".eds", beside));
  command("odgen.previewRust", () => preview(context, ["--rust"], ".rs", beside));
  command("odgen.previewPage", () => preview(context, ["--docs", "html"], ".html", page));
  command("odgen.diff", () => diff(context));
  command("odgen.restart", () => restart(context));
  command("odgen.showPlaces", showPlaces);
  const mark = (editor) =>
    commands.executeCommand("setContext", "odgen.isOurs", Boolean(editor && isForUs(editor.document)));
  const provider = { onDidChange: changed.event, provideTextDocumentContent: (uri) => shown.get(uri.toString()) };
  context.subscriptions.push(
    workspace.registerTextDocumentContentProvider(SCHEME, provider),
    workspace.onDidOpenTextDocument((document) => look(context, document)),
    workspace.onDidSaveTextDocument((document) => look(context, document)),
    workspace.onDidChangeConfiguration((event) => event.affectsConfiguration("odgen") && restart(context)),
    window.onDidChangeActiveTextEditor(mark),
  );
  mark(window.activeTextEditor);
  for (const document of workspace.textDocuments) {
    await look(context, document);
  }
};

exports.deactivate = () => client?.stop();
