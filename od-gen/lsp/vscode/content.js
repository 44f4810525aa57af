// Which texts are for odgen. By their content: parameter files and plants have no extension of their own.
"use strict";

const KEYS = ["od-spec", "part-of", "od-plant", "od-parameters"];
const LANGUAGES = ["canopen-eds", "canopen-xdd"];

/** Whether a YAML text has one of the keys at the start of a line, before anything else but comments and other keys. */
function isSpecification(text) {
  const begin = new RegExp(`^(?:${KEYS.join("|")})\\s*:`, "m");
  return begin.test(text.slice(0, 4096));
}

/** Whether a document is for odgen. */
function isOurs(languageId, name, text) {
  if (LANGUAGES.includes(languageId)) {
    return true;
  }
  return languageId === "yaml" && (name.endsWith(".od.yaml") || isSpecification(text()));
}

module.exports = { isOurs };
