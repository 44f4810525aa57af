// Starts `odgen lsp` for specifications, EDS, DCF, XDD and XDC files.
"use strict";

const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = () => {
  const command = workspace.getConfiguration("odgen").get("path");
  client = new LanguageClient(
    "odgen",
    "odgen",
    { command, args: ["lsp"] },
    {
      documentSelector: [
        { language: "yaml", pattern: "**/*.od.yaml" },
        { language: "yaml", pattern: "**/{plant,turbine,parameters}*.yaml" },
        { language: "canopen-eds" },
        { pattern: "**/*.{xdd,xdc}" },
      ],
    },
  );
  return client.start();
};

exports.deactivate = () => client?.stop();
