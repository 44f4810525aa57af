// Uses the page of the command, odgen.html: drops files, checks, fixes, converts, looks at, compares and decodes them, and compares what the page makes with what the
// command makes of the same files with the same arguments, byte for byte. Nothing may leave the page; it works without a network, with keys, on a phone, and for axe.
//
//   node page.mjs PAGE CHROMIUM ODGEN LARGE FILE…
//
// FILEs are what is dropped; LARGE is an EDS with many objects.
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { becomes, check, end, fail, launch, same } from "./browser.mjs";

const [pagePath, executablePath, odgen, large, ...paths] = process.argv.slice(2).map((path) => resolve(path));
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const names = paths.map((path) => basename(path));
const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(2)} s`;

// ---- The command ----

const folders = [];
// A run in a folder with the same files, under the same names: what it printed, and what it made or changed.
const run = (parameters, inputs = paths) => {
  const folder = mkdtempSync(join(tmpdir(), "odgen-page-"));
  folders.push(folder);
  for (const path of inputs) {
    cpSync(path, join(folder, basename(path)));
  }
  const { status, stdout, stderr } = spawnSync(odgen, parameters, { cwd: folder, encoding: "utf8", maxBuffer: 1 << 30, env: { COLUMNS: "" } });
  const made = new Map();
  const walk = (below) => {
    for (const name of readdirSync(join(folder, below)).sort()) {
      const path = below ? `${below}/${name}` : name;
      if (statSync(join(folder, path)).isDirectory()) { walk(path); continue; }
      const bytes = readFileSync(join(folder, path));
      const input = inputs.find((one) => basename(one) === path);
      if (!input || !bytes.equals(readFileSync(input))) made.set(path, bytes);
    }
  };
  walk("");
  return { status, out: stdout, err: stderr, made };
};
// The arguments of a command as the page shows it.
const words = (text) => [...text.matchAll(/"((?:\\.|[^"])*)"|(\S+)/g)].map(([, quoted, plain]) => plain ?? quoted.replace(/\\(.)/g, "$1")).slice(1);

// ---- The page ----

const browser = await launch(executablePath);
const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, offline: true, acceptDownloads: true });
const asked = [];
context.on("request", (request) => asked.push(request.url()));
const open = async () => {
  const page = await context.newPage();
  page.on("console", (message) => fail(`console: ${message.text()}`));
  page.on("pageerror", (error) => fail(`error: ${error.message}`));
  const network = await context.newCDPSession(page);
  await network.send("Network.enable");
  for (const kind of ["requestWillBeSent", "webSocketCreated", "webTransportCreated"]) network.on(`Network.${kind}`, ({ request, url }) => asked.push(request?.url ?? url));
  await page.goto(pathToFileURL(pagePath).href);
  return page;
};
// As a hand drops them; `setInputFiles` is what the button does.
const drop = async (page, dropped) => {
  const contents = dropped.map((path) => [basename(path), readFileSync(path).toString("base64")]);
  const transfer = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    for (const [name, text] of all) data.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
    return data;
  }, contents);
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
};
// Until all files are checked.
const settled = (page) => page.waitForFunction(() => files.length > 0 && !waiting.length && files.every((file) => file.kind === "other" || file.check));
const choose = (page, name) => page.click(`#files li:has(button[aria-label$="${name}"], button[aria-label*="${name} "]) button:first-child`);
const tab = (page, name) => page.click(`#tab_${name}`);
const downloaded = async (page, act) => {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  return [download.suggestedFilename(), readFileSync(await download.path())];
};
// The files of an archive that stores them as they are.
const unzipped = (bytes) => {
  const found = new Map(), end = bytes.lastIndexOf(Buffer.from([0x50, 0x4b, 5, 6]));
  let at = bytes.readUInt32LE(end + 16);
  for (let left = bytes.readUInt16LE(end + 10); left > 0; left--) {
    const [size, name, extra, comment, header] = [bytes.readUInt32LE(at + 24), bytes.readUInt16LE(at + 28), bytes.readUInt16LE(at + 30), bytes.readUInt16LE(at + 32), bytes.readUInt32LE(at + 42)];
    const start = header + 30 + bytes.readUInt16LE(header + 26) + bytes.readUInt16LE(header + 28);
    found.set(bytes.toString("utf8", at + 46, at + 46 + name), bytes.subarray(start, start + size));
    at += 46 + name + extra + comment;
  }
  return found;
};
const sameFiles = (found, expected, text) => {
  same([...found.keys()].sort(), [...expected.keys()].sort(), `${text}: files`);
  for (const [path, bytes] of found) check(expected.has(path) && Buffer.from(bytes).equals(expected.get(path)), `${text}: ${path} has other bytes than that of the command`);
};

let since = performance.now();
const page = await open();
await page.waitForFunction(() => document.documentElement.lang === "en");
console.log(`the page is there after ${seconds(since)}`);

// ---- Check ----

since = performance.now();
await drop(page, paths);
await settled(page);
console.log(`${paths.length} files are checked after ${seconds(since)}`);
for (const name of names) {
  const found = await page.evaluate((name) => { const { kind, check: one } = files.find((file) => file.name === name); return { kind, one }; }, name);
  if (found.kind === "other") continue;
  const expected = run(["check", "--notes", "--format", "json", name]);
  same([found.one.failed, found.one.code, found.one.out, found.one.err], ["", expected.status, expected.out, expected.err], `check of ${name}`);
  await choose(page, name);
  const findings = expected.err.split("\n").filter(Boolean).map((line) => JSON.parse(line));
  const shown = findings.filter(({ severity }) => severity !== "note");
  await page.waitForFunction((count) => document.querySelectorAll("#view > div > .finding").length === Math.min(count, 100), shown.length);
  if (found.kind === "eds") for (const reader of findings.flatMap((one) => one["minded-by"] ?? [])) {
    check(/refuses|stumbles/.test(await page.innerText(`#programs tr:has(th:text-is("${reader}"))`)), `${name}: ${reader} minds nothing`);
  }
}
// What a code means, and the line that it is about.
const broken = names.find((name) => name === "eds113_blank_in_key.eds");
await choose(page, broken);
const first = page.locator(".finding").first();
await first.locator("summary").click();
const code = (await first.innerText()).match(/\b(?:EDS|OD)\d+/)[0];
check(await becomes(page, () => document.querySelector(".finding details pre")?.textContent), "no explanation comes");
same(await first.locator("details pre").textContent(), run(["explain", code]).out, `explanation of ${code}`);
const marked = await page.evaluate((name) => {
  const file = files.find((one) => one.name === name), { line, column } = file.check.findings[0].labels[0];
  return [document.querySelector(".finding pre").textContent, `${line} │ ${linesOf(file)[line - 1]}`.slice(0, 40), column];
}, broken);
check(marked[0].startsWith(marked[1]), `the line of the finding is ${marked[0]}`);

// ---- Fix ----

let fixed = 0;
for (const name of names.filter((one) => /\.(eds|dcf)$/.test(one))) {
  await choose(page, name);
  await tab(page, "fix");
  await page.waitForFunction((name) => active.name === name && active.shown.fix && document.querySelector("#view h2"), name);
  await page.evaluate(() => active.shown.fix);
  const parameters = words(await page.innerText("#view .command code"));
  const expected = run(parameters);
  const found = await page.evaluate(async () => { const { out, err, code, failed } = await active.shown.fix; return [failed, code, out, err]; });
  same(found, ["", expected.status, expected.out, expected.err], `fix of ${name}`);
  if (!expected.made.size) continue;
  fixed += 1;
  sameFiles(new Map([await downloaded(page, () => page.click("#fix_save"))]), expected.made, `fix of ${name}`);
  same((await page.textContent("#difference")).trimEnd(), expected.out.trimEnd(), `difference of ${name}`);
}
check(fixed >= 5, `only ${fixed} files are fixed`);

// ---- Convert ----

for (const [name, device] of [["pmc.eds"], ["pmm.dcf"], ["tank.xdd"], ["pitch-control-system.od.yaml", "pmm"], [broken]]) {
  await choose(page, name);
  await tab(page, "convert");
  await page.waitForSelector("#make");
  for (const box of await page.$$("#view .choices input")) await box.check();
  await page.fill("#node", "5");
  await page.fill("#rate", "125");
  if (device) await page.selectOption("#device", device);
  since = performance.now();
  await page.click("#make");
  await page.waitForSelector("#zip");
  const sections = await page.$$eval("#made h2", (all) => all.map((one) => {
    const texts = { format: one.textContent, command: "", err: "" };
    for (let next = one.nextElementSibling; next && next.localName !== "h2"; next = next.nextElementSibling) {
      if (next.matches(".command")) texts.command = next.querySelector("code").textContent;
      if (next.matches("pre")) texts.err = next.textContent;
    }
    return texts;
  }));
  const time = seconds(since), expected = new Map();
  for (const { format, command, err } of sections) {
    const native = run(words(command));
    same(err, native.err.trim() ? native.err : "", `${name}: messages about ${format}`);
    for (const [path, bytes] of native.made) if (!/(^|\/)\.odgen-/.test(path)) expected.set(path, bytes);
  }
  const [archive, bytes] = await downloaded(page, () => page.click("#zip"));
  same(archive, name.replace(/\.[^.]*$/, ".zip"), `${name}: name of the archive`);
  sameFiles(unzipped(bytes), expected, `conversion of ${name}`);
  console.log(`${name}: ${expected.size} files in ${sections.length} formats after ${time}`);
}
// A value in units, and one that is refused.
await choose(page, "pitch-control-system.od.yaml");
await tab(page, "convert");
for (const box of await page.$$("#view .choices input")) await box.setChecked(await box.inputValue() === "dcf");
for (const [value, is] of [["EFC target position=90.00 °", "made"], ["EFC target position=9000.00 °", "refused"]]) {
  await page.selectOption("#device", "pmc");
  await page.fill("#values", value);
  await page.click("#make");
  await page.waitForSelector("#made h2");
  const native = run(words(await page.innerText("#made .command code")));
  same(native.made.size > 0 ? "made" : "refused", is, `DCF with ${value}`);
  same(await page.locator("#made table").count(), native.made.size, `DCF with ${value}: files`);
  if (is === "made") sameFiles(new Map([await downloaded(page, () => page.click("#made table button"))]), native.made, "DCF with a value");
  if (native.err) same(await page.textContent("#made > pre"), native.err, `DCF with ${value}: messages`);
}

// ---- Look, compare, decode ----

await choose(page, "pmc.eds");
await tab(page, "look");
const frame = page.frameLocator("#look");
same(await frame.locator("h1").innerText(), "PMC", "page of the device");
await frame.locator("#ui_search").fill("6041");
check(await frame.locator("#ui_results li a").first().innerText().then((text) => text.includes("6041"), () => false), "the search of the reference finds nothing");
await frame.locator(".brand a[href^='index.html']").click();
check(await becomes(page, () => document.querySelector("#look_page")?.value === "index.html"), "a link does not lead to the other page");
check((await frame.locator("h1").innerText()).length > 0, "the other page is empty");

await choose(page, "pmc.eds");
await tab(page, "compare");
await page.selectOption("#other", "pmm.eds");
await page.click("#compare");
await page.waitForSelector("#changes");
same(await page.textContent("#changes"), run(["diff", "pmm.eds", "pmc.eds"]).out, "difference of pmm.eds and pmc.eds");

await tab(page, "decode");
await page.fill("#nodes", "5");
await page.click("#decode");
await page.waitForSelector("#frames");
const trace = names.find((name) => name.endsWith(".log"));
const decoded = run(["decode", "pmc.eds", "--node", "5", "--trace", trace]).out;
check(decoded.split("\n").length > 3, "the trace has nothing in it");
same((await page.textContent("#frames")).trimEnd(), decoded.trimEnd(), "the trace in words");

// ---- Text ----

await tab(page, "edit");
await page.waitForSelector("#editor");
// As if typed: a whole text at once takes a browser long.
await page.evaluate(() => {
  const editor = document.querySelector("#editor"), at = editor.value.indexOf("DataType=0x0007") + "DataType=0x".length;
  editor.setRangeText("0FFF", at, at + 4);
  editor.dispatchEvent(new Event("input"));
});
check(await becomes(page, () => document.querySelector("#edit_findings .finding:not([data-severity=note])")), "a mistake is not found while it is typed");
const [typedName, typed] = await downloaded(page, () => page.click("#view .main, #view p > button"));
same([typedName, typed.includes("\r\n"), typed.includes("0x0FFF")], ["pmc.eds", readFileSync(paths[names.indexOf("pmc.eds")]).includes("\r\n"), true], "the changed file");
await page.click("#new");
await page.waitForFunction(() => active?.name === "device.od.yaml" && document.querySelector("#editor")?.value.includes("devices:"));
same(await page.inputValue("#editor"), run(["new", "device"]).made.get("device.od.yaml").toString(), "a new specification");

// ---- Large files, cancelling, and what is no file of ours ----

await page.reload();
since = performance.now();
await page.setInputFiles("#choose", large);
await settled(page);
const objects = readFileSync(large, "latin1").match(/ObjectType=/g).length;
console.log(`an EDS with ${objects} objects is checked after ${seconds(since)}`);
await tab(page, "convert");
await page.waitForSelector("#make");
await page.check("#format_eds");
since = performance.now();
await page.click("#make");
await page.waitForSelector("#made table");
console.log(`and written after ${seconds(since)}`);
for (const box of await page.$$("#view .choices input")) await box.check();
await page.click("#make");
await page.waitForSelector("#busy:not([hidden])");
// It can be used meanwhile.
await page.click("#theme");
check(await page.evaluate(() => ["light", "dark"].includes(document.documentElement.dataset.theme)), "the page does not answer while it works");
await page.click("#cancel");
check(await becomes(page, () => document.querySelector("#said").textContent.startsWith("Cancelled") && document.querySelector("#busy").hidden), "cancelling is not said");
await page.evaluate(() => { files = []; changed(); activate(undefined); });
const odd = mkdtempSync(join(tmpdir(), "odgen-page-"));
folders.push(odd);
const hostile = `<img src=x onerror=document.title="ran">.eds`;
for (const [name, contents] of [["empty.eds", ""], ["noise.eds", Buffer.from(Array.from({ length: 4096 }, (_, at) => (at * 167 + 13) & 255))], ["-notes.eds", "[FileInfo]\n"], [hostile, "[<b>]\n<script>=1\n"]]) writeFileSync(join(odd, name), contents);
await page.setInputFiles("#choose", readdirSync(odd).map((name) => join(odd, name)));
await settled(page);
const oddly = await page.evaluate(() => files.map(({ name, check: { failed, findings, others } }) => [name, failed, findings.length > 0, others.length]));
same(oddly.filter(([, failed, hasFindings, others]) => failed || !hasFindings || others), [], "files that are none");
await choose(page, "empty.eds");
await tab(page, "check");
await page.waitForSelector("#view .finding");
same(await page.locator("#programs").count(), 0, "what programs do with a file that cannot be read");
check(oddly.some(([name]) => name === "_notes.eds"), "a name that is like an option stays");
same([await page.title(), await page.locator("#work img, #work b b, #work script").count()], ["odgen", 0], "a name becomes markup");

// A program that fails in place of the command, as WebAssembly: its only function is `unreachable`.
const failing = ["0061736d01000000", "010401600000", "03020100", "0503010001", "0713", "02066d656d6f72790200", "065f73746172740000", "0a05010300000b"].join("");
await page.evaluate((packed) => {
  worker.postMessage({ packed: new Uint8Array(packed) });
  changed();
  choose("check");
}, [...gzipSync(Buffer.from(failing, "hex"))]);
await page.waitForSelector("#view .wrong");
check((await page.innerText("#view .wrong")).includes("send the file"), "a failure of the program is not said");

// ---- Nothing leaves ----

const own = pathToFileURL(pagePath).href;
same(asked.filter((url) => url !== own && !/^(blob:null\/|data:,|about:srcdoc)/.test(url)), [], "requests");
page.removeAllListeners("console");
const tried = await page.evaluate(async () => {
  const refused = [];
  addEventListener("securitypolicyviolation", ({ effectiveDirective }) => refused.push(effectiveDirective));
  await fetch("http://127.0.0.1:9/").catch(() => {});
  try { new WebSocket("ws://127.0.0.1:9/"); } catch { /* the same */ }
  navigator.sendBeacon("http://127.0.0.1:9/", "text");
  const image = new Image();
  image.src = "http://127.0.0.1:9/picture";
  document.body.append(Object.assign(document.createElement("iframe"), { src: "http://127.0.0.1:9/" }));
  await new Promise((done) => setTimeout(done, 300));
  return refused.sort();
}).catch((error) => [error.message]);
same([...new Set(tried)], ["connect-src", "frame-src", "img-src"], "what is refused when a page tries to send");
await page.close();

// ---- Languages, screens, keys ----

for (const [locale, width, colorScheme] of [["en", 1280, "light"], ["de", 1280, "dark"], ["de", 390, "light"], ["en", 390, "dark"]]) {
  const seen = await (await browser.newContext({ viewport: { width, height: 900 }, locale, colorScheme, offline: true })).newPage();
  const about = `${locale}, ${width} px, ${colorScheme}`;
  seen.on("pageerror", (error) => fail(`${about}: ${error.message}`));
  await seen.goto(pathToFileURL(pagePath).href);
  same(await seen.evaluate(() => document.documentElement.lang), locale, `${about}: language`);
  await seen.setInputFiles("#choose", [broken, "pmc.eds", "pmm.eds", trace].map((name) => paths[names.indexOf(name)]));
  await settled(seen);
  await seen.focus("#tab_check");
  await seen.evaluate(axe);
  for (const view of ["check", "fix", "convert", "look", "compare", "decode", "edit"]) {
    // With the arrows, as one goes through tabs.
    if (view !== "check") await seen.keyboard.press("ArrowRight");
    same(await seen.evaluate(() => [document.activeElement.id, document.querySelector("[aria-selected=true]").id]), [`tab_${view}`, `tab_${view}`], `${about}: the next view by its key`);
    await seen.waitForFunction(() => !waiting.length && document.querySelector("#view").children.length > 1);
    if (view === "compare") { await seen.press("#compare", "Enter"); await seen.waitForSelector("#changes"); await seen.focus("#tab_compare"); }
    if (view === "convert") { await seen.press("#format_dbc", "Space"); await seen.fill("#node", "5"); await seen.press("#make", "Enter"); await seen.waitForSelector("#made table"); await seen.focus("#tab_convert"); }
    const { violations } = await seen.evaluate(() => axe.run({ exclude: ["iframe"] }, { rules: { "target-size": { enabled: true } }, resultTypes: ["violations"] }));
    for (const found of violations) fail(`${about}, ${view}: axe ${found.id}: ${found.help}: ${found.nodes[0].html.slice(0, 160)}`);
    check(true, view);
    same(await seen.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0, `${about}, ${view}: the page is scrolled sideways`);
    same(await seen.evaluate(() => document.body.innerText.match(/undefined|NaN|\{\}/)?.[0]), undefined, `${about}, ${view}: a text`);
  }
  await seen.context().close();
}
await browser.close();
for (const folder of folders) rmSync(folder, { recursive: true, force: true });
end();
