// Opens the HTML documents in Chromium and uses them like a reader: searches, filters, follows links, copies, prints.
// What the pages show is compared with the dump of the model and with what templates see; axe-core looks for barriers.
//
//   node check.mjs DOCS DUMP CONTEXT OUT CHROMIUM AMOUNT
//
// AMOUNT is `all` or `sample`: then axe looks at one of each kind of element.
import { readFileSync, mkdirSync, statSync } from "node:fs";
import { execFile, execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { becomes, check, end, fail, frames, launch, same } from "./browser.mjs";

const [docs, dumpFile, contextFile, out, executablePath] = process.argv.slice(2, 7).map((path) => resolve(path));
const isSample = process.argv[7] === "sample";
const dump = JSON.parse(readFileSync(dumpFile));
const context = JSON.parse(readFileSync(contextFile));
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
mkdirSync(out, { recursive: true });

const browser = await launch(executablePath);
const browserContext = await browser.newContext({ viewport: { width: 1280, height: 900 } });
await browserContext.grantPermissions(["clipboard-read", "clipboard-write"]);

// A page with everything that it says on the console or asks from elsewhere.
const open = async (name, hash = "") => {
  const page = await browserContext.newPage();
  page.on("console", (message) => fail(`${name}: console: ${message.text()}`));
  page.on("pageerror", (error) => fail(`${name}: ${error.message}`));
  page.on("request", (request) => {
    if (!request.url().startsWith("file:") && !request.url().startsWith("data:")) fail(`${name} asks for ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(docs, name)) + hash);
  return page;
};
const clean = (text) => text.replace(/\s+/g, " ").trim();
const shownCards = (page) => page.$$eval("article.object", (cards) => cards.filter((card) => card.checkVisibility()).map((card) => card.id));
// The cards that are shown when they are those that are expected, or else in the end: cards follow a question piece by piece.
const cardsWhenShown = async (page, expected) => {
  await becomes(page, (ids) => {
    const shown = [...document.querySelectorAll("article.object")].filter((card) => card.checkVisibility());
    return shown.map((card) => card.id).join() === ids;
  }, expected.join());
  return shownCards(page);
};
const key = (index) => index.slice(2);
// Run in a page: indices of objects on it that are in a running text and lead nowhere. Headings, first cells of rows and pictures name what they show;
// a number that is an error code, too, is left plain.
const unlinked = (codes) => {
  const named = "a, h1, h2, h3, h4, h5, h6, .object-head, td:first-child, button, code, svg, #ui_contents, .bar, option";
  const errors = new Set(codes.map((code) => code.slice(2)));
  const found = [];
  const walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const text = walker.currentNode;
    if (text.parentElement.closest(named)) continue;
    for (const [, index] of text.data.matchAll(/(?<![\p{L}\p{N}_])([0-9A-F]{4})h(?![\p{L}\p{N}_])/gu)) {
      if (document.getElementById(index) && !errors.has(index)) found.push(`${index}: ${text.data.slice(0, 80)}`);
    }
  }
  return found;
};

// ---------------------------------------------------------------- what the tables say
check(await (async () => {
  const page = await open("index.html");
  const stated = await page.getAttribute("html", "lang");
  await page.close();
  return stated === context.language;
})(), `index.html: its language is not ${context.language}`);
const rowsOf = (page, selector) => page.$$eval(selector, (tables) => tables.map((table) => ({
  anchor: table.closest(".table")?.id ?? "",
  columns: [...table.querySelectorAll("thead th, thead td")].map((cell) => cell.textContent),
  rows: [...table.querySelectorAll("tbody tr")].map((row) => [...row.querySelectorAll("td")].map((cell) => {
    const copy = cell.cloneNode(true);
    for (const mark of copy.querySelectorAll(".mark")) mark.remove();
    for (const line of copy.querySelectorAll("br")) line.replaceWith("\n");
    return copy.textContent;
  })),
})));
const words = (cell) => clean(cell.text);

// The words and numbers that the tables of a device have in each language; stated here once more, so that a wrong one is seen.
const language = context.language;
const say = {
  en: { sub: "Sub-index", index: "Index", name: "Name", type: "Type", access: "Attr", map: "Map", about: "Description", unit: "Unit",
    stored: "Stored", default: "Default", point: ".",
    kept: { no: "", communication: "communication", application: "application", manufacturer: "manufacturer", remanent: "by itself" } },
  de: { sub: "Subindex", index: "Index", name: "Name", type: "Typ", access: "Zugriff", map: "Map", about: "Beschreibung", unit: "Einheit",
    stored: "Gespeichert", default: "Vorgabe", point: ",",
    kept: { no: "", communication: "Kommunikation", application: "Anwendung", manufacturer: "Hersteller", remanent: "von selbst" } },
}[language];
const inLanguage = (number) => String(number).replace(".", say.point);
const numberIn = (text) => (say.point === "," && text?.includes(".") ? NaN : Number(text?.replace(say.point, ".")));
// A text in the language of the page, or else in the default language of the specification.
const fallback = dump.languages[0];
const ofDump = (text) => clean(text[language] ?? text[fallback] ?? "").replaceAll("->", "→");

const accessCell = (entry) => (entry.locked ? (entry.access === "wo" ? "(w)" : "r(w)") : entry.access);
const mapCell = { none: "N", receive: "Y (R)", transmit: "Y (T)", both: "Y (RT)" };

for (const device of dump.devices) {
  const page = await open(`${device.key}.html`);
  const cards = await page.$$eval("article.object", (list) => list.map((card) => ({ id: card.id, heading: card.querySelector("h3").textContent })));
  same(cards.map((card) => card.id), device.objects.map((object) => key(object.index)), `${device.key}: cards`);
  for (const [at, object] of device.objects.entries()) {
    check(clean(cards[at].heading).includes(clean(object.name)), `${object.index}: heading ${cards[at].heading}`);
  }
  const tables = await rowsOf(page, "article.object > .scroll > table.grid");
  same(tables.length, device.objects.length, `${device.key}: a detail table per object`);
  for (const [at, object] of device.objects.entries()) {
    const { columns, rows } = tables[at];
    same(rows.length, object.entries.length, `${object.index}: rows`);
    for (const [line, entry] of object.entries.entries()) {
      const cell = (title) => { const column = columns.indexOf(title); return column < 0 ? "" : clean(rows[line][column]); };
      const place = `${device.key} ${object.index}.${entry.sub}`;
      const structured = object.kind === "array" || object.kind === "record";
      same(structured ? cell(say.sub) : cell(say.index), structured ? String(entry.sub) : `${key(object.index)}h`, place);
      same(cell(say.name), clean(entry.name), `${place} name`);
      same(cell(say.type), entry.type, `${place} type`);
      same(cell(say.access), accessCell(entry), `${place} access`);
      same(cell(say.map), mapCell[entry.pdo], `${place} mapping`);
      check(clean(cell(say.about)).startsWith(ofDump(entry.about)), `${place} description`);
      const unit = dump.units.find((one) => one.name === entry.unit);
      const [upper, lower] = unit?.scale ?? [1, 1];
      const space = unit?.symbol === "°" ? "" : " ";
      const step = upper / lower === 1 ? unit?.symbol : `${Number.isInteger(1e6 * upper / lower) ? inLanguage(upper / lower) : `${upper}/${lower}`}${space}${unit?.symbol}`;
      same(cell(say.unit), unit ? step : "", `${place} unit`);
      same(cell(say.stored), say.kept[entry.stored], `${place} stored`);
      if (entry.default === null) same(cell(say.default), "", `${place} default`);
      else if (typeof entry.default.raw === "number" && !entry.default.formula && Number.isSafeInteger(entry.default.raw)) {
        // A raw number, or hexadecimal digits of it, or a physical value with the raw one after it.
        const shown = cell(say.default), raw = entry.default.raw;
        const numbers = [shown, shown.split(/[ :]/)[0], shown.match(/\((-?\d+)\)$/)?.[1]].map(numberIn);
        // The name of a special value follows in brackets.
        const pattern = shown.split(" (")[0], hexadecimal = pattern.replace(/[ h]/g, "");
        const digits = /^[0-9A-F ]+h$/.test(pattern) ? Number(`0x${hexadecimal}`) : NaN;
        check(numbers.includes(raw) || digits === raw || digits - 2 ** (4 * hexadecimal.length) === raw,
          `${place} default ${shown}, raw ${raw}`);
      }
    }
  }

  // Keyboard, deep links. A page that is still being read answers later.
  await becomes(page, () => performance.getEntriesByName("search-ready").length > 0);
  await page.locator("body").press("/");
  same(await page.evaluate(() => document.activeElement.id), "ui_search", `${device.key}: / goes to the search`);
  const structured = device.objects.find((object) => object.entries.length > 2);
  const entry = structured.entries.at(-1).sub, hash = `${key(structured.index)}.${entry}`;
  for (const text of [hash, `${structured.index}:${entry.toString(16).padStart(2, "0")}`]) {
    await page.fill("#ui_search", text);
    await page.press("#ui_search", "Enter");
    same(await page.evaluate(() => decodeURIComponent(location.hash)), `#${hash}`, `${device.key}: Enter on ${text}`);
    await page.evaluate(() => { location.hash = ""; });
  }
  await page.press("#ui_search", "Escape");
  same((await shownCards(page)).length, device.objects.length, `${device.key}: Escape shows all`);
  await page.fill("#ui_search", device.objects[3].name);
  await page.press("#ui_search", "ArrowDown");
  same(await page.evaluate(() => document.activeElement.closest("section")?.id), "ui_results", `${device.key}: arrow goes to the results`);
  await page.keyboard.press("ArrowUp");
  same(await page.evaluate(() => document.activeElement.id), "ui_search", `${device.key}: arrow comes back`);
  await page.fill("#ui_search", "qqqqq zzzzz");
  same([await shownCards(page), await page.isVisible("#ui_nothing")], [[], true], `${device.key}: nothing found`);
  // Enter goes to the best result, not to the first.
  for (const object of device.objects.slice(-5)) {
    for (const text of [key(object.index), object.name]) {
      await page.fill("#ui_search", text);
      await page.press("#ui_search", "Enter");
      const target = await page.evaluate(() => document.getElementById(decodeURIComponent(location.hash.slice(1)))?.closest("article")?.querySelector("h3")?.textContent ?? "");
      check(clean(target).includes(clean(object.name)), `${device.key}: Enter on ${text} goes to ${target}`);
    }
  }
  await page.fill("#ui_search", "qqqqq zzzzz");
  // A link into a hidden card shows it.
  await page.evaluate((target) => { location.hash = target; }, hash);
  await page.waitForFunction((target) => document.getElementById(target).checkVisibility(), hash);

  // Filters.
  const facts = (object) => (["array", "record"].includes(object.kind) ? object.entries.filter((one) => one.sub > 0) : object.entries);
  const symbol = (name) => dump.units.find((unit) => unit.name === name)?.symbol;
  const has = {
    type: (object, value) => facts(object).some((one) => one.type === value),
    access: (object, value) => object.entries.some((one) => accessCell(one) === value
      && (facts(object).includes(one) || ["rw", "wo", "rwr", "rww"].includes(one.access))),
    pdo: (object, value) => object.entries.some((one) => one.pdo === value || one.pdo === "both"),
    stored: (object, value) => facts(object).some((one) => one.stored === value),
    unit: (object, value) => facts(object).some((one) => symbol(one.unit) === value),
  };
  for (const [name, fits] of Object.entries(has)) {
    const values = await page.$$eval(`select[data-filter=${name}] option`, (options) => options.map((one) => one.value).filter(Boolean));
    check(values.length > 0 || ["unit", "pdo"].includes(name), `${device.key}: nothing to filter by ${name}`);
    for (const value of values) {
      await page.selectOption(`select[data-filter=${name}]`, value);
      const expected = device.objects.filter((object) => fits(object, value)).map((object) => key(object.index));
      same(await cardsWhenShown(page, expected), expected, `${device.key}: ${name} ${value}`);
      check(expected.length > 0, `${device.key}: ${name} ${value} offers nothing`);
    }
    if (values.length > 0) await page.selectOption(`select[data-filter=${name}]`, "");
  }
  // Two filters are about the same entry.
  const stored = await page.$$eval("select[data-filter=stored] option", (options) => options.map((one) => one.value).filter(Boolean));
  for (const value of stored) {
    await page.selectOption("select[data-filter=access]", { index: 1 });
    await page.selectOption("select[data-filter=stored]", value);
    const access = await page.inputValue("select[data-filter=access]");
    const both = device.objects.filter((object) => facts(object).some((one) => accessCell(one) === access && one.stored === value));
    const expected = both.map((object) => key(object.index));
    same(await cardsWhenShown(page, expected), expected, `${device.key}: ${access} and stored ${value}`);
  }
  await page.press("#ui_search", "Escape");
  await page.close();

  // A link that is opened elsewhere leaves this page where it is; a plain click goes there.
  const clicked = await open(`${device.key}.html`, `#${hash}`);
  // What was opened is followed until it stays, or until the reader scrolls.
  await clicked.evaluate(() => { dispatchEvent(new WheelEvent("wheel")); scrollTo(0, 0); });
  const away = clicked.locator("#ui_contents a").last();
  await away.evaluate((link) => link.dispatchEvent(new MouseEvent("click", { bubbles: true, cancelable: true, ctrlKey: true })));
  await frames(clicked, 12);
  same(await clicked.evaluate(() => scrollY), 0, `${device.key}: Ctrl and a click`);
  await away.click();
  check(await becomes(clicked, (before) => {
    if (location.hash === before) return false;
    const { top, bottom } = document.getElementById(decodeURIComponent(location.hash.slice(1))).getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  }, `#${hash}`), `${device.key}: a click does not go to its target`);
  await clicked.close();

  // A deep link from outside.
  const linked = await open(`${device.key}.html`, `#${hash}`);
  await linked.waitForFunction((target) => {
    const { top, bottom } = document.getElementById(target).getBoundingClientRect();
    const end = scrollY + innerHeight >= document.documentElement.scrollHeight - 1;
    const bar = document.querySelector(".bar").getBoundingClientRect().bottom;
    return bottom <= innerHeight && top >= bar - 1 && (end || top < bar + 40);
  }, hash).catch(() => fail(`${device.key}: #${hash} is not at the top`));
  await linked.close();
}

// ---------------------------------------------------------------- the system's page
{
  const page = await open("index.html");
  const expected = [{ ...context.notation, anchor: "" }, ...(context.warnings ? [context.warnings] : []), ...context.chapters.flatMap((chapter) => chapter.sections.flatMap((section) => section.tables)),
    ...context.appendices.flatMap((appendix) => appendix.tables)];
  const grids = expected.flatMap((table) => table.grids.map((grid) => ({ anchor: table.anchor, grid })));
  const found = await rowsOf(page, "table.grid");
  same(found.length, grids.length, "index.html: tables");
  for (const [at, { anchor, grid }] of grids.entries()) {
    same(found[at].anchor, anchor, "index.html: order of tables");
    same(found[at].columns.map(clean), grid.columns.map((column) => clean(column.title)), `${anchor}: columns`);
    same(found[at].rows.map((row) => row.map(clean)), grid.rows.map((row) => row.cells.map(words)), `${anchor}: cells`);
  }
  const ids = await page.$$eval("[id]", (all) => all.map((one) => one.id));
  same(ids.filter((id, at) => ids.indexOf(id) !== at), [], "index.html: ids are there once");
  const dead = await page.$$eval("a[href^='#']", (links) => links.map((link) => decodeURIComponent(link.getAttribute("href").slice(1))).filter((id) => id && !document.getElementById(id)));
  same(dead, [], "index.html: links");
  same(await page.evaluate(unlinked, dump.errors.map((error) => error.code)), [], "index.html: indices without a link");
  await page.close();
}

for (const device of dump.devices) {
  const page = await open(`${device.key}.html`);
  const ids = await page.$$eval("[id]", (all) => all.map((one) => one.id));
  same(ids.filter((id, at) => ids.indexOf(id) !== at), [], `${device.key}: ids are there once`);
  const dead = await page.$$eval("a[href^='#']", (links) => links.map((link) => decodeURIComponent(link.getAttribute("href").slice(1))).filter((id) => id && !document.getElementById(id)));
  same([...new Set(dead)], [], `${device.key}: links`);
  same(await page.evaluate(unlinked, dump.errors.map((error) => error.code)), [], `${device.key}: indices without a link`);
  await page.close();
}

// ---------------------------------------------------------------- the contents: where the reader is
for (const name of ["index.html", ...dump.devices.map((device) => `${device.key}.html`)]) {
  const page = await open(name);
  await page.setViewportSize({ width: 1400, height: 900 });
  const marked = (id) => becomes(page, (wanted) => {
    const all = [...document.querySelectorAll("#ui_contents [aria-current]")];
    return all.length === 1 && decodeURIComponent(all[0].hash.slice(1)) === wanted;
  }, id);
  const isSeen = () => page.$eval("#ui_contents [aria-current]", (line) => {
    const frame = document.getElementById("ui_contents").getBoundingClientRect(), { top, bottom } = line.getBoundingClientRect();
    return line.checkVisibility() && top >= frame.top - 1 && bottom <= Math.min(frame.bottom, innerHeight) + 1;
  }).catch(() => false);
  const cards = await page.$$eval("article.object, .part", (all) => all.map((one) => one.id));
  const listed = await page.$$eval("#ui_contents a[href^='#']", (all) => all.map((one) => decodeURIComponent(one.hash.slice(1))));
  same([...listed].sort(), [...cards].sort(), `${name}: each card is once in the contents`);
  const places = [0.2, 0.5, 0.9].map((part) => cards[Math.floor(part * (cards.length - 1))]);
  for (const id of places) {
    await page.evaluate((hash) => { location.hash = hash; }, id);
    check(await marked(id), `${name}: after a jump the contents do not mark #${id}`);
    check(await isSeen(), `${name}: the mark of #${id} is out of sight`);
  }
  for (const id of places) {
    // As the wheel does, until the card is at the top: cards on the way get their height only then.
    await page.evaluate(async (target) => {
      dispatchEvent(new WheelEvent("wheel"));
      for (let frames = 0; frames < 30; frames++) {
        const bar = document.querySelector(".bar").getBoundingClientRect().bottom;
        scrollBy({ top: document.getElementById(target).getBoundingClientRect().top - bar - 4, behavior: "instant" });
        await new Promise(requestAnimationFrame);
      }
    }, id);
    check(await marked(id), `${name}: after scrolling the contents do not mark #${id}`);
  }

  // On a phone they open over the page at the place where the reader is, and close after a choice.
  const [, here, there] = places;
  await page.setViewportSize({ width: 390, height: 800 });
  // Few cards may have given one place twice, and an address that stays the same goes nowhere.
  for (const id of ["", here]) await page.evaluate((hash) => { location.hash = hash; }, id);
  await marked(here);
  check(!await page.isVisible("#ui_contents"), `${name}: the contents cover a phone`);
  const press = () => page.click("#ui_open");
  await press();
  check(await page.isVisible("#ui_contents"), `${name}: the button does not open the contents`);
  check(await marked(here) && await isSeen(), `${name}: on a phone the contents do not mark #${here}`);
  await page.keyboard.press("Escape");
  check(!await page.isVisible("#ui_contents"), `${name}: Escape does not close the contents`);
  await press();
  // A group may have to be opened first.
  await page.$eval(`#ui_contents a[href="#${there}"]`, (link) => { const group = link.closest("details"); if (group) group.open = true; });
  await page.click(`#ui_contents a[href="#${there}"]`);
  check(!await page.isVisible("#ui_contents"), `${name}: a choice does not close the contents`);
  check(await marked(there), `${name}: after a choice the contents do not mark #${there}`);
  const lands = (id) => { const { top } = document.getElementById(id).getBoundingClientRect(); return top >= -0.5 && top <= 8; };
  check(await becomes(page, lands, there), `${name}: after a choice #${there} is not at the top`);
  await page.close();
}

// ---------------------------------------------------------------- errata: shown when asked for
for (const name of ["index.html", ...dump.devices.map((device) => `${device.key}.html`)]) {
  const page = await open(name);
  const marks = () => page.$$eval(".mark, .errata-of, .compared", (all) => all.filter((one) => one.checkVisibility()).length);
  const all = await page.$$eval(".mark, .errata-of, .compared", (all) => all.length);
  if (dump.errata.length === 0) {
    check(all === 0 && await page.$("#ui_errata") === null, `${name}: a button for errata of a device without errata`);
    await page.close();
    continue;
  }
  const pressed = () => page.getAttribute("#ui_errata", "aria-pressed");
  // While they are hidden, their number is where they will be; each mark says what it is about.
  const hints = () => page.$$eval(".hint", (all) => all.filter((one) => one.checkVisibility()).map((one) => [one.parentElement.id, Number(one.textContent.match(/\d+$/)[0])]));
  const counted = await page.evaluate(() => {
    const numbersIn = (box) => new Set([...box.querySelectorAll(".mark, .compared tbody td:first-child a")].map((mark) => mark.textContent.match(/^E\d+/)[0]));
    const boxes = [...document.querySelectorAll("article.object, .table")].filter((box) => !box.matches("article .table"));
    return boxes.map((box) => [box.id, numbersIn(box).size]).filter(([, count]) => count > 0);
  });
  same(await hints(), counted, `${name}: numbers of hidden errata`);
  const unsaid = await page.$$eval(".mark", (all) => all.filter((mark) => !/^\S+ \d+: ./.test(mark.title)).map((mark) => mark.textContent));
  same(unsaid, [], `${name}: marks that do not say which fact is wrong`);
  same([await marks(), await pressed()], [0, "false"], `${name}: errata before they are asked for`);
  await page.click(counted.length > 0 ? ".hint" : "#ui_errata");
  same([await marks(), await pressed(), await hints()], [all, "true", []], `${name}: errata when asked for`);
  await page.reload();
  same([await marks(), await pressed()], [all, "true"], `${name}: errata after a reload`);
  await page.click("#ui_errata");
  same([await marks(), await pressed()], [0, "false"], `${name}: errata when not asked for any more`);
  await page.evaluate(() => localStorage.clear());
  await page.close();
}

// ---------------------------------------------------------------- keys, filters, and a page without its script
for (const name of ["index.html", ...dump.devices.map((device) => `${device.key}.html`)]) {
  const page = await open(name);
  await page.locator("body").press("?");
  check(await page.isVisible("#ui_keys"), `${name}: ? does not show the keys`);
  await page.keyboard.press("Escape");
  check(!await page.isVisible("#ui_keys"), `${name}: Escape does not close the keys`);
  await page.click("#ui_help");
  check(await page.isVisible("#ui_keys"), `${name}: the button does not show the keys`);
  await page.click("#ui_keys button");
  await page.fill("#ui_search", "a?");
  check(!await page.isVisible("#ui_keys"), `${name}: a question shows the keys`);
  await page.press("#ui_search", "Escape");
  // On a phone a button opens the filters.
  if (name !== "index.html") {
    check(await page.isVisible("select") && !await page.isVisible("#ui_filters"), `${name}: filters on a screen`);
    await page.setViewportSize({ width: 390, height: 800 });
    check(!await page.isVisible("select") && await page.isVisible("#ui_filters"), `${name}: filters on a phone`);
    const word = await page.textContent("#ui_filters");
    await page.click("#ui_filters");
    await page.selectOption("select[data-filter=access]", { index: 1 });
    same([await page.textContent("#ui_filters"), await page.getAttribute("#ui_filters", "aria-expanded")], [`${word} (1)`, "true"], `${name}: filters in use`);
  }
  await page.close();

  const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  await plain.goto(pathToFileURL(join(docs, name)).href);
  same([await plain.isVisible("#ui_search"), await plain.isVisible("h1"), await plain.isVisible(".hint")], [false, true, false], `${name}: without the script`);
  check((await plain.textContent(".made")).includes("odgen"), `${name}: the foot does not say what made it`);
  await plain.close();
}

// ---------------------------------------------------------------- pictures: every name is whole and inside
const figured = (table) => table.grids.flatMap((grid) => [
  ...(grid.timing?.signals ?? []).flatMap((signal) => [signal.name, signal.place, ...signal.levels.map((level) => level.text)]),
  ...(grid.hysteresis?.switches ?? []).flatMap((one) => [one.name, ...one.texts.map((text) => text.text)]),
  ...[...(grid.flow?.boxes ?? []), ...(grid.axis?.marks ?? []), ...(grid.axis?.spans ?? [])].flatMap((part) => part.lines).map((line) => line.text),
]);
const pictured = (table) => table.grids.flatMap((grid) => grid.bits?.rows ?? []).flatMap((row) => row.fields.map((field) => field.name));
const picturesOf = async (page, name) => {
  await page.addStyleTag({ content: "* { content-visibility: visible !important }" });
  const shown = await page.$$eval(".picture", (all) => all.map((one) => {
    const box = one.getBoundingClientRect();
    const texts = [...one.querySelectorAll("text")];
    const sticksOut = (text) => {
      const { left, right, top, bottom } = text.getBoundingClientRect();
      return left < box.left - 1 || right > box.right + 1 || top < box.top - 1 || bottom > box.bottom + 1;
    };
    return { texts: texts.map((text) => text.textContent), outside: texts.filter(sticksOut).map((text) => text.textContent) };
  }));
  same(shown.flatMap((one) => one.outside), [], `${name}: names that stick out of their picture`);
  return shown;
};
{
  const page = await open("index.html");
  const shown = await picturesOf(page, "index.html");
  const tables = context.chapters.flatMap((chapter) => chapter.sections.flatMap((section) => section.tables)).filter((table) => figured(table).length);
  const texts = shown.map((one) => new Set(one.texts));
  const missing = tables.filter((table) => !texts.some((all) => figured(table).every((text) => !text || all.has(text))));
  same(missing.map((table) => table.anchor), [], "index.html: figures whose texts no picture shows whole");
  await page.close();
}
for (const device of context.devices) {
  const page = await open(`${device.key}.html`);
  const shown = await picturesOf(page, device.key);
  const names = device.objects.flatMap((object) => object.types.flatMap(pictured)).filter((name) => name);
  const texts = new Set(shown.flatMap((one) => one.texts));
  same(names.filter((name) => !texts.has(name)), [], `${device.key}: names that no picture shows whole`);
  const fields = device.pdos.flatMap((pdo) => pdo.fields).filter((field) => !texts.has(`${field.entry} ${field.name}`));
  same(fields.map((field) => field.name), [], `${device.key}: mapped entries that no picture names whole`);
  await page.close();
}

// ---------------------------------------------------------------- pictures: what they name is a link, for fingers and keys, too
const targetsOf = (table) => [...(table.ladder?.rungs ?? []), ...table.grids.flatMap((grid) => [
  ...(grid.timing?.signals ?? []), ...(grid.hysteresis?.switches ?? []).flatMap((one) => one.texts), ...(grid.machine?.states ?? []).map(() => ({ target: grid.machine.status })),
  ...[...(grid.flow?.boxes ?? []), ...(grid.axis?.marks ?? []), ...(grid.axis?.spans ?? [])].flatMap((part) => part.lines).flatMap((line) => line.link ?? []),
])].flatMap(({ target }) => target ?? []);
// Tables of a page with the targets that their pictures have to lead to, in any order.
const isLinked = async (page, name, key, wanted) => {
  const addressOf = ({ anchor, page: home }) => (home && home !== key && context.devices.some((device) => device.key === home) ? `${home}.html#${anchor}` : `#${anchor}`);
  const found = await page.evaluate((ids) => ids.map((id) => {
    return [...document.getElementById(id).querySelectorAll("svg a, .narrow a, li a")].map((link) => link.getAttribute("href"));
  }), wanted.map(({ id }) => id));
  for (const [at, { id, targets }] of wanted.entries()) same([...found[at]].sort(), targets.map(addressOf).sort(), `${name}: links in the pictures of #${id}`);
  for (const width of [390, 800, 1400]) {
    await page.setViewportSize({ width, height: 900 });
    const faults = await page.$$eval(".picture a, .narrow a", (links) => links.flatMap((link) => {
      const { width: wide, height } = link.getBoundingClientRect(), name = link.textContent.trim(), picture = link.closest("svg");
      link.focus();
      return [name === "" && "no name", picture && (wide < 24 || height < 24) && `${wide} x ${height}`, document.activeElement !== link && "no focus",
        picture && (picture.getAttribute("role") !== "group" || !picture.getAttribute("aria-label")) && "in an image"].filter(Boolean).map((fault) => `${name}: ${fault}`);
    }));
    same(faults, [], `${name} (${width} px): links in pictures`);
  }
};
{
  const page = await open("index.html");
  await page.addStyleTag({ content: "* { content-visibility: visible !important }" });
  const tables = [...context.chapters.flatMap((chapter) => chapter.sections.flatMap((section) => section.tables)), ...context.appendices.flatMap((appendix) => appendix.tables)];
  await isLinked(page, "index.html", "index", tables.map((table) => ({ id: table.figure?.anchor ?? table.anchor, targets: targetsOf(table) })).filter(({ targets }) => targets.length > 0));
  await page.close();
}
for (const device of context.devices) {
  const page = await open(`${device.key}.html`);
  await page.addStyleTag({ content: "* { content-visibility: visible !important }" });
  await isLinked(page, device.key, device.key, [
    ...device.pdos.map((pdo) => ({ id: pdo.anchor, targets: pdo.fields.flatMap(({ target }) => target ?? []) })),
    ...device.appendices.flatMap((appendix) => appendix.tables).map((table) => ({ id: table.anchor, targets: targetsOf(table) })).filter(({ targets }) => targets.length > 0),
  ]);
  const entries = device.pdos.flatMap((pdo) => pdo.fields).filter((field) => field.entry);
  same(entries.filter((field) => field.target?.anchor !== field.anchor).map((field) => field.entry), [], `${device.key}: mapped entries without a link`);

  // The bits and values of a type have an address below each entry that has the type.
  const objects = dump.devices.find((one) => one.key === device.key).objects;
  const types = Object.fromEntries(dump.types.map((type) => [type.name, (type.bits ?? []).map((bit) => `b${bit.first}`).concat((type.values ?? []).map((value) => `v${value.value}`))]));
  const wanted = objects.flatMap((object) => object.entries.filter((entry) => entry["named-type"]).flatMap((entry) => {
    const before = entry.sub === 0 ? key(object.index) : `${key(object.index)}.${entry.sub}`;
    return (types[entry["named-type"]] ?? []).map((part) => `${before}.${part}`);
  }));
  const missing = await page.evaluate((ids) => ids.filter((id) => !document.getElementById(id)?.closest("tr")), wanted);
  same(missing, [], `${device.key}: bits and values without an address`);
  check(wanted.length > 0 || objects.every((object) => object.entries.every((entry) => !entry["named-type"])), `${device.key}: no address of a bit was looked for`);
  await page.close();
}

// ---------------------------------------------------------------- the search that the project promises
if (dump.devices.some((device) => device.key === "pmc")) {
  const page = await open("pmc.html");
  await page.fill("#ui_search", "following error");
  await becomes(page, () => performance.getEntriesByName("search", "measure").length > 0);
  const cards = await shownCards(page);
  check(cards.includes("6065") && cards.includes("60F4"), `following error: ${cards}`);
  check(cards.length < 20, `following error finds ${cards.length} cards`);
  await page.close();
}

// ---------------------------------------------------------------- both themes, barriers, paper
const names = ["index.html", ...dump.devices.map((device) => `${device.key}.html`)];
// Off by default, and what small screens are about.
const rules = { "target-size": { enabled: true }, "scrollable-region-focusable": { enabled: true } };
const layout = { runOnly: { type: "rule", values: Object.keys(rules) } };
const colours = { runOnly: { type: "rule", values: ["color-contrast", "link-in-text-block"] } };
// At one width axe looks at everything but colours. What is small or scrolled is looked for everywhere at the others, too; for colours and for the rest at these widths
// those cards are enough that have, all together, each kind of element: axe takes half a minute for a page. A sample has nothing but these.
const kinds = [[800, "light", { rules }], [800, "dark", colours], [390, "light", { rules }], [390, "dark", colours]];
const looks = isSample ? { kinds: [...kinds, [1400, "light", { rules }], [1400, "dark", colours]] } : {
  page: [[1400, "light", { rules: { ...rules, "color-contrast": { enabled: false } } }], [390, "light", layout], [800, "light", layout]],
  kinds: [...kinds, [1400, "light", colours], [1400, "dark", colours]],
};
// Kinds that axe has seen on the pages before; in a sample, once is enough.
let known = [];
// The colours of an element follow from what it and all around it are.
const keepKinds = (known) => {
  const kinds = new Set(known);
  const ways = new Map([[null, ""]]);
  const wayOf = (one) => {
    if (!ways.has(one)) ways.set(one, `${one.matches(".object, .part") ? "" : wayOf(one.parentElement)} ${one.localName}.${one.getAttribute("class") ?? ""}`);
    return ways.get(one);
  };
  for (const card of document.querySelectorAll(".object, .part")) {
    const before = kinds.size;
    for (const one of card.querySelectorAll("*")) {
      if (one.closest("tbody tr, li")) continue;
      kinds.add(wayOf(one));
    }
    // Of rows and items those stay that have something new, and one of each list.
    for (const one of [...card.querySelectorAll("tbody tr, li")]) {
      const some = kinds.size;
      for (const part of [one, ...one.querySelectorAll("*")]) kinds.add(wayOf(part));
      if (kinds.size === some && one.previousElementSibling) one.remove();
    }
    // The heading stays: the next one has its level below it.
    if (kinds.size === before) card.replaceChildren(card.querySelector("h1, h2, h3, h4, h5, h6"));
  }
  return [...kinds];
};
const areStacked = () => !document.querySelector(".stack:not(.stacked)");
let spent = 0;
const printPage = promisify(execFile);
for (const name of names) {
  // The documented command, with everything else.
  const pdf = join(out, name.replace(".html", ".pdf"));
  const print = printPage(executablePath, ["--headless", "--no-sandbox", "--no-pdf-header-footer", `--print-to-pdf=${pdf}`, pathToFileURL(join(docs, name)).href]);
  print.catch(() => null);
  const page = await open(name);
  await page.setViewportSize({ width: 1400, height: 900 });
  const backs = new Set();
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    await page.screenshot({ path: join(out, `${name}-${colorScheme}.png`) });
    backs.add(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
  }
  check(backs.size === 2, `${name}: looks alike in both schemes`);
  await page.addStyleTag({ content: "* { content-visibility: visible !important }" });
  await page.evaluate(axe);
  for (const [where, list] of Object.entries(looks)) {
    const begun = performance.now();
    if (where === "kinds") {
      const seen = await page.evaluate(keepKinds, known);
      if (isSample) known = seen;
    }
    for (const [width, colorScheme, options] of list) {
      await page.setViewportSize({ width, height: 900 });
      if (width < 600) await page.waitForFunction(areStacked);
      await page.emulateMedia({ colorScheme });
      const { violations, passes } = await page.evaluate((given) => axe.run(document, { ...given, resultTypes: ["violations"] }), options);
      const looked = passes.map((one) => one.id);
      check(looked.includes(options === colours ? "color-contrast" : "target-size"), `${name} (${width} px): axe looked at ${looked}`);
      for (const one of violations) {
        fail(`${name} (${width} px, ${colorScheme}): axe ${one.id}, ${one.nodes.length} times: ${one.help}: ${one.nodes[0].html.slice(0, 160)}`);
      }
    }
    spent += performance.now() - begun;
  }
  const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await page.click("#ui_theme");
  check(back !== await page.evaluate(() => getComputedStyle(document.body).backgroundColor), `${name}: the button changes the theme`);
  // The pages share what the button keeps: the next one has to look as the system says again.
  await page.evaluate(() => localStorage.clear());
  await page.close();

  // On a phone the cells of a row are below one another, each after the title of its column, and only pictures are scrolled.
  const phone = await open(name);
  await phone.setViewportSize({ width: 390, height: 800 });
  await phone.waitForFunction(areStacked);
  await phone.addStyleTag({ content: "* { content-visibility: visible !important }" });
  // What is folded or hidden is looked at, too.
  await phone.evaluate(() => {
    document.documentElement.classList.remove("unmarked");
    for (const one of document.querySelectorAll("main details")) one.open = true;
  });
  await frames(phone, 3);
  const { unnamed, unsaid, narrow, sideways, shrunk } = await phone.evaluate(() => {
    const place = (one) => `${one.closest("[id]")?.id} ${one.textContent.slice(0, 40)}`;
    const unnamed = [], unsaid = [], narrow = [], sideways = [];
    const pictures = [...document.querySelectorAll(".picture")].filter((one) => one.checkVisibility());
    const shrunk = pictures.filter((one) => one.getBoundingClientRect().width < one.width.baseVal.value - 1).map((one) => `${one.closest("[id]")?.id} ${one.getAttribute("class")}`);
    // What is laid out as something else loses its role with some screen readers.
    for (const one of document.querySelectorAll("table, thead, tbody, tr, th, td")) {
      if (one.checkVisibility() && !getComputedStyle(one).display.startsWith("table") && !one.role) unsaid.push(`${one.localName} ${place(one)}`);
    }
    for (const table of document.querySelectorAll("table")) {
      const titles = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
      for (const cell of table.querySelectorAll("tbody td")) {
        if (!cell.checkVisibility()) { if (cell.textContent) unnamed.push(place(cell)); continue; }
        const { width, left, right } = cell.getBoundingClientRect(), { paddingLeft, paddingRight } = getComputedStyle(cell);
        // A table of two columns stays one; what a row is called is in its first line.
        const isOne = titles.length <= 2, isCalled = cell.matches("[data-called]");
        if (isCalled && (right > innerWidth || left < 0)) sideways.push(place(cell));
        if (isCalled) continue;
        if (!isOne && getComputedStyle(cell, "::before").content.split(" / ")[0] !== JSON.stringify(titles[cell.cellIndex])) unnamed.push(place(cell));
        if (width - (isOne ? 0 : parseFloat(paddingLeft) + parseFloat(paddingRight)) < 114) narrow.push(`${place(cell)}: ${width}`);
        if (left < 0 || right > innerWidth) sideways.push(place(cell));
      }
    }
    for (const one of document.querySelectorAll("body, body *")) {
      if (one.scrollWidth <= one.clientWidth + 1 || one.clientWidth === 0 || one.closest("svg, thead, .unseen") || !one.checkVisibility()) continue;
      if (getComputedStyle(one).display === "inline") continue;
      if (!(one.tabIndex === 0 && one.matches(".scrolls") && one.ariaLabel)) sideways.push(`${one.localName}.${one.className} ${place(one)}`);
    }
    return { unnamed, unsaid, narrow, sideways, shrunk };
  });
  same(unnamed, [], `${name}: cells without the title of their column on a phone`);
  same(unsaid, [], `${name}: parts of tables that do not say what they are on a phone`);
  same(narrow, [], `${name}: columns narrower than 114 px on a phone`);
  same(sideways, [], `${name}: wider than a phone`);
  same(shrunk, [], `${name}: pictures smaller than they are on a phone`);
  same(await phone.evaluate(() => document.documentElement.scrollWidth), 390, `${name}: width on a phone`);
  // What is read aloud is a table all the same.
  const { nodes } = await (await browserContext.newCDPSession(phone)).send("Accessibility.getFullAXTree");
  const heard = (role) => nodes.filter((node) => !node.ignored && node.role.value === role).length;
  const seen = (selector) => phone.$$eval(selector, (all) => all.filter((one) => one.checkVisibility()).length);
  same([heard("table"), heard("row"), heard("columnheader")], [await seen("table"), await seen("tr"), await seen("thead th")], `${name}: tables, rows and titles read aloud on a phone`);
  same(heard("cell"), await seen("td"), `${name}: cells read aloud on a phone`);
  await phone.close();

  // On paper nothing may stick out: A4 less the margins of the style sheet.
  const paper = await open(name);
  await paper.emulateMedia({ media: "print" });
  await paper.setViewportSize({ width: Math.floor((210 - 26) / 25.4 * 96), height: 1000 });
  const wide = await paper.$$eval("table, .picture", (all) => all.filter((one) => {
    const { left, right, width } = one.getBoundingClientRect();
    return width > 0 && (right > innerWidth + 1 || left < -1 || one.scrollWidth > one.clientWidth + 1);
  }).map((one) => `${one.closest("[id]")?.id}: ${Math.round(one.getBoundingClientRect().right)}`));
  same(wide, [], `${name}: tables wider than the paper`);
  // Errata are put away there.
  const cells = await paper.$$eval("td", (all) => all.filter((one) => !one.closest(".compared")).map((one) => {
    const copy = one.cloneNode(true);
    for (const mark of copy.querySelectorAll(".mark")) mark.remove();
    return copy.textContent;
  }));
  await paper.close();

  // What a reader of PDF files finds in the printed one.
  await print;
  const text = execFileSync("pdftotext", ["-raw", pdf, "-"], { maxBuffer: 1 << 28 }).toString();
  const pages = text.split("\f").slice(0, -1);
  for (const [at, one] of pages.entries()) check(one.includes(`${at + 1} / ${pages.length}`), `${name}: page ${at + 1} has no number`);
  const letters = (part) => part.replace(/[\s\u00ad]+/g, "");
  const printed = letters(text.replace(/\d+ \/ \d+\s*\f/g, ""));
  // A cell that runs over the end of a page is found in its halves.
  const missing = cells.filter((cell) => letters(cell) && !printed.includes(letters(cell)));
  check(missing.length === 0, `${name}: ${missing.length} of ${cells.length} cells are not in the PDF, such as ${missing[0]}`);
  console.log(`${name}: ${(statSync(join(docs, name)).size / 1024).toFixed(0)} kB, ${cells.length} cells, ${pages.length} pages of PDF, ${missing.length} cells over the end of a page`);
}
await browser.close();
console.log(`axe took ${(spent / 1000).toFixed(0)} s`);

end();
