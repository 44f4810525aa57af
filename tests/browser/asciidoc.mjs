// Converts the AsciiDoc example with Asciidoctor: no message, every table, no dead link. Notes and warnings become tables, too, of
// another class.
//
//   node asciidoc.mjs FILE
import { readFileSync } from "node:fs";
import { convert, LoggerManager, MemoryLogger } from "@asciidoctor/core";

const log = MemoryLogger.create();
LoggerManager.setLogger(log);
const text = readFileSync(process.argv[2], "utf8");
const html = await convert(text, { safe: "safe", standalone: true });
const ids = new Set([...html.matchAll(/id="([^"]+)"/g)].map((match) => match[1]));
const dead = [...html.matchAll(/href="#([^"]+)"/g)].map((match) => match[1]).filter((id) => !ids.has(id));
const wanted = (text.match(/^\[cols=/gm) ?? []).length, tables = (html.match(/<table[^>]* class="tableblock/g) ?? []).length;
const messages = log.getMessages().length;
const failed = (messages > 0) + (dead.length > 0) + (tables !== wanted) + (wanted === 0);
console.log(`asciidoctor: ${messages} messages, ${tables} of ${wanted} tables, ${dead.length} dead links`);
console.log(`${4 - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
