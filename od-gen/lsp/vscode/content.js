// Which texts are for odgen. By their content: parameter files and plants have no extension of their own.
"use strict";

const KEYS = ["od-spec", "part-of", "od-plant", "od-parameters"];
const LANGUAGES = ["canopen-eds", "canopen-xdd"];
// Lines of a text in which it says what it is; the server looks at as many.
const BEGINNING = 100;

/** Whether a YAML text has one of the keys at the beginning of a line. */
function isMarked(text) {
  const marked = new RegExp(`^(?:${KEYS.join("|")})\\s*:`);
  return text.split("\n", BEGINNING).some((line) => marked.test(line));
}

/** Whether a document is for odgen. */
function isOurs(languageId, name, text) {
  if (LANGUAGES.includes(languageId)) {
    return true;
  }
  return languageId === "yaml" && (name.endsWith(".od.yaml") || isMarked(text()));
}

module.exports = { isOurs };
