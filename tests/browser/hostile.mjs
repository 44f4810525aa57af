// Opens documents whose texts try to command the browser, next to the same ones with plain texts, and uses them: they have the
// same elements and attributes, no script of a text runs, and each text is shown letter by letter where the plain one is.
//
//   node hostile.mjs DOCS CHROMIUM
import { readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { check, end, fail, frames, launch, same } from "./browser.mjs";

const [docs, executablePath] = process.argv.slice(2).map((path) => resolve(path));
const texts = JSON.parse(readFileSync(join(docs, "hostile.json")));

const browser = await launch(executablePath);
// A context for each page: what one page stores (its theme, for one) reaches others of the same context at some time.
const open = async (path) => {
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 900 } })).newPage();
  page.on("console", (message) => fail(`${path}: console: ${message.text()}`));
  page.on("pageerror", (error) => fail(`${path}: ${error.message}`));
  page.on("dialog", (dialog) => { fail(`${path}: dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on("request", (request) => {
    if (!request.url().endsWith(path)) fail(`${path} asks for ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(docs, path)).href);
  return page;
};

// What a page is made of: how often each element is there with which attributes, what handlers and targets these name,
// what its own scripts and styles say, and the texts.
const parts = (page) => page.evaluate(() => {
  const elements = {}, handlers = [], targets = [];
  for (const one of document.querySelectorAll("*")) {
    // Rows get their buttons when they come near, which is a matter of time.
    if (one.matches(".bench")) continue;
    if (one.localName !== "br") {
      // What the script adds to a table that is wider than its place, and in how many lines a picture shows a text, are matters of its length.
      const isFolded = one.closest("table[role]");
      // Where a picture or table is wider than its place depends on its texts.
      const isScrolled = one.matches(".scroll");
      const attributes = one.getAttributeNames().filter((name) => !(isFolded && ["role", "data-label", "data-long"].includes(name)) && !(isScrolled && name === "tabindex"));
      const name = `${one.localName} ${attributes.sort().join(" ")}`;
      elements[name] = one.matches(".flow text, .axis text") ? elements[name] ?? 1 : (elements[name] ?? 0) + 1;
    }
    for (const { name, value } of one.attributes) {
      if (name.startsWith("on")) handlers.push(`${one.localName} ${name}=${value}`);
      if (["href", "src", "action", "formaction", "xlink:href"].includes(name)) targets.push(value);
    }
  }
  const shown = [document.title];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
  const blocks = "address,article,body,caption,dd,div,dt,figcaption,figure,footer,h1,h2,h3,h4,header,li,main,nav,ol,option,p,section,table,td,text,th,title,tr,ul";
  let last;
  while (walker.nextNode()) {
    const { localName, parentElement, data } = walker.currentNode;
    if (localName === "br") last = undefined;
    if (data === undefined) continue;
    if (parentElement.closest("script, style")) continue;
    // Parts of a sentence are joined, those of different blocks are not.
    const block = parentElement.closest(blocks);
    if (block === last) shown[shown.length - 1] += data; else shown.push(data);
    last = block;
  }
  return {
    elements: Object.entries(elements).sort(([a], [b]) => (a < b ? -1 : 1)), handlers, targets,
    // What runs; lists hold texts, and have to be readable as such.
    scripts: [...document.scripts].filter((one) => !one.type).map((one) => one.textContent),
    lists: [...document.scripts].filter((one) => one.type).map((one) => `${one.type} ${typeof JSON.parse(one.textContent)}`),
    text: shown.join("\n").replace(/[ \t]+/g, " "),
  };
});
const times = (text, part) => text.split(part).length - 1;
// `plain 1` is not the beginning of `plain 12`.
const shows = (text, plain) => new RegExp(`${plain.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}(?!\\d)`).test(text);

// What marks of the search and the panel of the tools consist of, also where a page has no such element before.
const BY_SCRIPT = new Set(["mark", "b", "code", "dd", "dl", "dt", "h3", "option", "output", "select", "small", "span"]);

const seen = new Set();
for (const name of readdirSync(join(docs, "hostile")).filter((file) => file.endsWith(".html")).sort()) {
  const clean = await open(`plain/${name}`);
  const expected = await parts(clean);
  await clean.close();
  const page = await open(`hostile/${name}`);
  const found = await parts(page);
  same(found.elements.filter(([element, count]) => !expected.elements.some(([one, times]) => one === element && times === count)),
    [], `${name}: other elements than with plain texts`);
  same(found.elements.length, expected.elements.length, `${name}: kinds of elements`);
  same(found.handlers, expected.handlers, `${name}: handlers`);
  same(found.scripts, expected.scripts, `${name}: scripts`);
  same(found.lists, expected.lists, `${name}: lists of the scripts`);
  const odd = found.targets.filter((target) => !/^([\w.-]+\.html)?(#|$)/.test(target));
  same(odd, [], `${name}: links`);
  for (const { plain, hostile } of texts.filter(({ plain }) => shows(expected.text, plain))) {
    seen.add(plain);
    check(times(found.text, hostile) > 0, `${name}: does not show ${hostile}`);
  }

  // The pointer over everything, the focus on everything, and what is copied, searched for and filtered by.
  await page.evaluate(() => {
    for (const one of document.querySelectorAll("*")) {
      for (const kind of ["mouseover", "mouseenter", "focus", "pointerover"]) one.dispatchEvent(new Event(kind));
    }
    for (const one of document.querySelectorAll("a, button, input, select, [tabindex]")) one.focus();
    for (const one of document.querySelectorAll("button")) one.click();
    for (const link of document.querySelectorAll("a[href^='#']")) link.dispatchEvent(new MouseEvent("click", { bubbles: true, cancelable: true }));
  });
  for (const { hostile } of texts.slice(0, 5)) {
    await page.fill("#ui_search", hostile);
    await page.waitForFunction(() => performance.getEntriesByName("search", "measure").length > 0);
    // A result on another page would lead away.
    const isHere = await page.evaluate(() => document.querySelector("#ui_results:not(.off) a")?.getAttribute("href").startsWith("#") ?? true);
    if (isHere) await page.press("#ui_search", "Enter");
  }
  for (const [select, value] of await page.$$eval("select[data-filter] option", (all) => all.map((one) => [one.parentElement.dataset.filter, one.value]))) {
    await page.selectOption(`select[data-filter=${select}]`, value);
  }
  await frames(page, 12);
  same(await page.evaluate(() => window.__hostile), undefined, `${name}: a text ran`);
  same((await parts(page)).handlers, expected.handlers, `${name}: handlers after its use`);
  same((await parts(page)).elements.map(([element]) => element.split(" ")[0]).filter((one) => !BY_SCRIPT.has(one) && !expected.elements.some(([element]) => element.split(" ")[0] === one)),
    [], `${name}: new kinds of elements after its use`);
  await page.close();
}
for (const { original, plain, shown } of texts) {
  check(seen.has(plain) === shown, `"${original}" is ${shown ? "shown by no page" : "shown, and need not be named among those that are not"}`);
}
await browser.close();

console.log(`${seen.size} of ${texts.length} texts are shown`);
end();
