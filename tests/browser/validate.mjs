// Reads all HTML pages below directories as the HTML standard does: elements that are allowed where they are, attributes, ids, names, tables.
//
//   node validate.mjs DOCS...
import { readFileSync, readdirSync } from "node:fs";
import { join, relative, resolve } from "node:path";
import { HtmlValidate } from "html-validate";

const validator = new HtmlValidate({
  extends: ["html-validate:recommended"],
  rules: {
    // An object's address is its index: `#6040`. HTML allows any id without a space; CSS would have to escape it, and no style names one.
    "valid-id": ["error", { relaxed: true }],
    // A page is called as its maker calls the device, however long that is.
    "long-title": "off",
  },
});

let pages = 0;
const failures = [];
for (const docs of process.argv.slice(2).map((path) => resolve(path))) {
  const files = readdirSync(docs, { recursive: true }).filter((file) => file.endsWith(".html")).sort();
  for (const file of files.map((name) => join(docs, name))) {
    const { results } = await validator.validateString(readFileSync(file, "utf8"), file);
    pages += 1;
    for (const { line, ruleId, message } of results.flatMap((one) => one.messages)) {
      failures.push(`${relative(join(docs, ".."), file)}:${line}: ${ruleId}: ${message}`);
    }
  }
}
for (const failure of failures.slice(0, 40)) console.error(`FAILED ${failure}`);
console.log(`${pages} pages of HTML, ${failures.length} remarks`);
process.exit(pages === 0 || failures.length ? 1 : 0);
