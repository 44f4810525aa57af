// Uses the workbench of each device's page: what it converts, decodes and shows is compared with what the model, the SDO client and virtual nodes say, for every entry
// and PDO. Opens it with keys and on a phone, and lets axe look at it.
//
//   node workbench.mjs DOCS CHROMIUM AMOUNT
//
// AMOUNT is `all` or `sample`: then of a device with many entries a part has its turn.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { becomes, check, end, fail, launch, same } from "./browser.mjs";

const [docs, executablePath] = process.argv.slice(2, 4).map((path) => resolve(path));
const { node, aborts, decimal_sign: sign, pages } = JSON.parse(readFileSync(join(docs, "workbench.json")));
const isSample = process.argv[4] === "sample", MANY = 150, PART = 24;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

const browser = await launch(executablePath);
const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
await context.grantPermissions(["clipboard-read", "clipboard-write"]);
const open = async (name, options = {}) => {
  const page = await context.newPage();
  page.on("console", (message) => fail(`${name}: console: ${message.text()}`));
  page.on("pageerror", (error) => fail(`${name}: ${error.message}`));
  await page.setViewportSize({ width: options.width ?? 1280, height: 900 });
  await page.goto(pathToFileURL(join(docs, name)) + (options.hash ?? ""));
  return page;
};
const hex = (number, digits) => number.toString(16).toUpperCase().padStart(digits, "0");

// Run in a page: comes near everything, so that all entries have their buttons.
const layOut = async () => {
  for (const chunk of document.querySelectorAll("main .chunk")) {
    chunk.scrollIntoView();
    while (!chunk.querySelector(".bench")) await new Promise(requestAnimationFrame);
  }
};

// Run in a page: uses the panel as a reader does, by its buttons and fields, and notes what it shows.
const use = ({ index, sub, structured, cases }) => {
  const card = document.getElementById(index), id = structured && sub > 0 ? `${index}.${sub}` : structured ? `${index}.0` : index;
  const row = structured ? document.getElementById(id) : card.querySelector("tr[data-entry]");
  row.querySelector("button.bench").click();
  const panel = document.getElementById("ui_bench"), fields = Object.fromEntries([...panel.querySelectorAll(".line")].map((line) => [line.querySelector("label").textContent, line.querySelector("input, select")]));
  const type = (input, text) => { input.value = text; input.dispatchEvent(new Event("input", { bubbles: true })); };
  const lines = [...panel.children].find((one) => one.localName === "div");
  const own = [...lines.querySelectorAll(":scope > .line")].map((line) => [line.querySelector("label").textContent, line.querySelector("input, select")]);
  const inputs = own.filter(([, input]) => input.localName === "input"), [, bytes] = inputs.at(-1), [, first] = inputs[0];
  const seen = () => ({
    fields: inputs.map(([name, input]) => [name, input.value]),
    text: lines.querySelector(".result > b")?.textContent ?? null,
    refusal: lines.querySelector(".result > .wrong")?.textContent ?? null,
    lines: [...lines.querySelectorAll(".result > span:not(.wrong)")].map((line) => line.textContent),
    set: [...lines.querySelectorAll(".bits .set label")].map((label) => Number(label.textContent.split(" ")[0].split("..").pop())),
    frames: [...lines.querySelectorAll("dl dd .copy")].map((one) => one.dataset.copy),
    wrong: [...panel.querySelectorAll(".line > .wrong")].map((note) => note.textContent).filter(Boolean),
  });
  const initial = bytes.value;
  const copied = [...lines.querySelectorAll(".copies [data-copy]")].map((one) => one.dataset.copy);
  const found = cases.map((one, at) => {
    type(bytes, one.bytes);
    const byBytes = seen();
    const back = {};
    // Each other field takes what it shows as well as the bytes do; some of the values are enough of that.
    for (const [name, input] of at % 4 === 0 ? inputs.slice(0, -1) : []) {
      const text = byBytes.fields.find(([label]) => label === name)[1];
      // A formula and what is no number are only shown.
      if (text === "" || text.includes("×")) continue;
      type(bytes, "");
      type(input, text);
      back[name] = bytes.value;
    }
    return { ...byBytes, back };
  });
  return { heading: panel.querySelector("h2").textContent, initial, copied, found, first: first === bytes };
};

let compared = 0, packed = 0;
for (const [name, { entries, pdos }] of Object.entries(pages)) {
  const page = await open(name);
  await page.evaluate(layOut);
  same(await page.$$eval("tr[data-entry]", (rows) => rows.filter((row) => !row.querySelector(".bench")).length), 0, `${name}: entries without a button`);

  // The node-ID is typed once.
  await page.locator("#ui_bus").click();
  await page.fill("#ui_bench_node", String(node));
  await page.reload();
  await page.locator("#ui_bus").click();
  same(await page.inputValue("#ui_bench_node"), String(node), `${name}: the node-ID after a reload`);
  await page.evaluate(layOut);

  for (const one of entries.filter((_, at) => !isSample || entries.length < MANY || at % PART === 0)) {
    const place = `${name} ${hex(one.index, 4)}h.${one.sub}`;
    const { heading, initial, copied, found } = await page.evaluate(use, { ...one, index: hex(one.index, 4) });
    check(heading.startsWith(`${hex(one.index, 4)}h`), `${place}: heading ${heading}`);
    same(initial, one.initial ?? "", `${place}: default`);
    const path = `0x${hex(one.index, 4)}`, [rust, c, st] = one.names ?? ["", "", ""];
    const wanted = [one.structured ? `${hex(one.index, 4)}h.${one.sub}` : `${hex(one.index, 4)}h`, `${path}:${hex(one.sub, 2)}`, String(one.index), `16#${hex(one.index, 4)}`,
      ...(rust ? [`.${rust}`] : []), ...(c ? [c] : []), ...(st ? [st] : []), one.structured ? `node.sdo[${path}][${one.sub}].raw` : `node.sdo[${path}].raw`];
    same(copied.filter((text) => !/^[0-9A-F]{8}h$/.test(text)), wanted, `${place}: to copy`);
    check(one.names !== null, `${place}: no names in code`);
    for (const [at, expected] of one.cases.entries()) {
      const seen = found[at], here = `${place} ${expected.bytes}`;
      compared += 1;
      if (expected.text !== null) same(seen.text, expected.text, `${here}: text`);
      if (expected.raw !== null) {
        same(seen.fields[0][1], expected.raw, `${here}: number`);
        for (const [field, bytes] of Object.entries(seen.back)) same(bytes, expected.bytes, `${here}: bytes of ${field}`);
      }
      if (expected.amount !== null) same(seen.fields[2][1], expected.amount, `${here}: quantity`);
      if (expected.set !== null) same(seen.set, expected.set, `${here}: bits`);
      if (expected.machines !== null) {
        const [states, commands] = expected.machines, shows = (names) => names.every((text) => seen.lines.some((line) => line.includes(`: ${text}`)));
        check(shows(states) && shows(commands), `${here}: ${seen.lines} instead of ${expected.machines}`);
        if (states.length + commands.length === 0) check(one.ruled || seen.lines.length === 0, `${here}: ${seen.lines}`);
      }
      if (expected.taken === true) same(seen.refusal, null, `${here}: refused`);
      if (expected.taken === false) check(seen.refusal !== null || one.ruled, `${here}: a virtual node refuses it`);
      // To read, the answer, to write, the answer.
      const writes = seen.frames.filter((text) => text.startsWith(hex(0x600 + node, 3)) && !text.startsWith(`${hex(0x600 + node, 3)} 40`));
      same(writes, one.writable && seen.refusal === null ? [expected.frames.join("\n")] : [], `${here}: frames`);
      if (one.readable) {
        const [low, high] = [one.index & 0xFF, one.index >> 8];
        same(seen.frames[0], `${hex(0x600 + node, 3)} 40 ${[low, high, one.sub, 0, 0, 0, 0].map((byte) => hex(byte, 2)).join(" ")}`, `${here}: to read it`);
      }
    }
  }

  for (const pdo of pdos) {
    const found = await page.evaluate(({ name, frames }) => {
      const heading = [...document.querySelectorAll(".pdo h3")].find((one) => one.textContent.trim() === name);
      heading.querySelector(".bench").click();
      const panel = document.getElementById("ui_bench"), inputs = [...panel.querySelectorAll("div > .line > input")], [bytes, ...fields] = inputs;
      const type = (input, text) => { input.value = text; input.dispatchEvent(new Event("input", { bubbles: true })); };
      const outputs = () => [...panel.querySelectorAll("div > output")].map((one) => one.textContent);
      return frames.map((frame) => {
        type(bytes, frame.bytes);
        const values = fields.map((field) => field.value), texts = outputs(), copied = panel.querySelector("dd .copy")?.dataset.copy ?? null;
        // And back: the values one by one, from a frame of zeros on.
        type(bytes, frame.bytes.replace(/[0-9A-F]/g, "0"));
        for (const [at, field] of fields.entries()) type(field, values[at]);
        return { texts, values, copied, bytes: bytes.value };
      });
    }, pdo);
    for (const [at, { texts, values, copied, bytes }] of found.entries()) {
      const expected = pdo.frames[at], here = `${name} ${pdo.name} ${expected.bytes}`;
      packed += 1;
      // What is no number of a REAL has no text.
      if (!values.includes("")) same(bytes, expected.bytes, `${here}: back from the values`);
      if (pdo.can_id !== null) same(copied, `${pdo.can_id} ${expected.bytes}`, `${here}: frame`);
      same(texts.length, pdo.places.length, `${here}: values`);
      for (const [field, value] of expected.values.entries()) {
        const entry = entries.find(({ index, sub }) => index === pdo.places[field][0] && sub === pdo.places[field][1]);
        // The number of the entry's bytes, as the entry itself shows it.
        if (value === null) continue;
        const raw = await page.evaluate(use, { index: hex(entry.index, 4), sub: entry.sub, structured: entry.structured, cases: [{ bytes: value }] });
        const [{ fields, text }] = raw.found;
        same(values[field], fields[0][1], `${here}: value ${field}`);
        if (text !== null) check(texts[field].startsWith(text), `${here}: ${texts[field]} instead of ${text}`);
      }
    }
  }

  // Codes and frames in words.
  const written = entries.flatMap((one) => one.cases.filter(({ taken, frames }) => taken && frames.length === 1).slice(0, 3).map((expected) => ({ one, expected })));
  const mapped = pdos.flatMap(({ places }) => places);
  const codes = [...aborts.map(([code]) => code), ...mapped.map(([index, sub]) => `${hex(index, 4)}${hex(sub, 2)}10h`), ...written.map(({ expected }) => expected.frames[0]), "no code"];
  await page.locator("#ui_bus").click();
  const said = await page.evaluate((all) => all.map((text) => {
    const input = document.querySelector("#ui_bench div > .line > input");
    input.value = text;
    input.dispatchEvent(new Event("input", { bubbles: true }));
    return document.querySelector("#ui_bench .result").textContent;
  }), codes);
  for (const [at, [code, text]] of aborts.entries()) check(text !== null && said[at].includes(text), `${name}: ${code} is ${said[at]}`);
  for (const [at, [index]] of mapped.entries()) check(said[aborts.length + at].startsWith(`${hex(index, 4)}h`), `${name}: mapping of ${hex(index, 4)}h is ${said[aborts.length + at]}`);
  for (const [at, { one, expected }] of written.entries()) {
    const text = said[aborts.length + mapped.length + at];
    check(text.includes(`${hex(one.index, 4)}h`) && text.endsWith(`= ${expected.text}`), `${name}: ${expected.frames[0]} is ${text}`);
  }
  const ids = await page.$$eval("#ui_bench dl .copy", (all) => all.map((one) => one.dataset.copy));
  for (const { name: pdo, can_id: id } of pdos) if (id !== null) check(ids.includes(id), `${name}: ${pdo} has no CAN-ID ${id} among ${ids}`);
  for (const base of [0x580, 0x600, 0x700]) check(ids.includes(hex(base + node, 3)), `${name}: no CAN-ID ${hex(base + node, 3)}`);
  await page.close();
}

// ---------------------------------------------------------------- what is wrong is said at its field
for (const [name, { entries }] of Object.entries(pages)) {
  const scaled = entries.find(({ cases }) => cases.some(({ amount }) => amount?.includes(sign) && !amount.includes("×")));
  if (!scaled) continue;
  const page = await open(name), index = hex(scaled.index, 4);
  await page.evaluate(layOut);
  const { amount, raw } = scaled.cases.find(({ amount }) => amount?.includes(sign) && !amount.includes("×"));
  await page.evaluate(use, { ...scaled, index, cases: [] });
  const [number, , quantity] = await page.locator("#ui_bench div > .line > input").all();
  const other = amount.replace(sign, sign === "." ? "," : ".");
  for (const [field, text, isRight] of [[quantity, amount, true], [quantity, `${amount}123`, false], [quantity, other, false], [number, "1.5", false], [number, "0x", false], [number, raw, true], [number, `0x${"1".repeat(40)}`, false]]) {
    await field.fill(text);
    const invalid = await field.getAttribute("aria-invalid"), note = await field.evaluate((one) => document.getElementById(one.getAttribute("aria-describedby"))?.textContent ?? "");
    same([invalid, note !== ""], isRight ? ["false", false] : ["true", true], `${name} ${index}: ${text}`);
    same(await number.inputValue(), isRight ? raw : field === number ? text : "", `${name} ${index}: number after ${text}`);
  }
  await page.close();
}

// ---------------------------------------------------------------- keys, clipboard, phone, barriers
{
  const [name, { entries, pdos }] = Object.entries(pages)[0];
  const withBits = entries.find(({ cases }) => cases.some(({ set }) => set !== null)) ?? entries[0], id = hex(withBits.index, 4);
  const page = await open(name, { hash: `#${id}` });
  const opener = page.locator(`[id="${id}"] .bench`).first();
  await opener.focus();
  // The buttons have their room: no row is higher with one than without.
  same(await page.evaluate(() => {
    const rows = [...document.querySelectorAll("tr:has(.bench)")], before = rows.map((row) => row.getBoundingClientRect().height);
    for (const row of rows) row.querySelector(".bench").style.display = "none";
    const after = rows.map((row) => row.getBoundingClientRect().height);
    for (const row of rows) row.querySelector(".bench").style.display = "";
    return rows.filter((_, at) => before[at] !== after[at]).length;
  }), 0, `${name}: rows that a button changes`);
  await page.fill("#ui_search", id);
  await opener.focus();
  await page.keyboard.press("Enter");
  check(await page.evaluate(() => document.activeElement.closest("#ui_bench") !== null), `${name}: Enter does not go into the panel`);
  await page.keyboard.press("Enter");
  same(await page.evaluate(() => navigator.clipboard.readText()), await page.locator("#ui_bench .copy").first().getAttribute("data-copy"), `${name}: copied`);
  const field = page.locator("#ui_bench div > .line > input").first();
  await field.fill("");
  await field.press("/");
  same(await field.inputValue(), "/", `${name}: a key of the page in the panel`);
  await page.keyboard.press("Escape");
  same([await page.isVisible("#ui_bench"), await page.inputValue("#ui_search")], [false, id], `${name}: Escape closes the panel alone`);
  check(await opener.evaluate((one) => one === document.activeElement), `${name}: the focus does not come back`);
  // A bit that is clicked is in the value.
  await opener.click();
  const box = page.locator("#ui_bench .bits [type=checkbox]").first();
  if (await box.count() > 0) {
    const before = await field.inputValue();
    await box.click();
    check(before !== await field.inputValue() && await page.locator("#ui_bench .bits [type=checkbox]").first().evaluate((one) => one === document.activeElement), `${name}: a bit that is clicked`);
  }
  // axe looks through the whole page for each answer: what the panels do not name is taken away.
  await page.fill("#ui_search", "");
  await page.evaluate((kept) => {
    for (const card of document.querySelectorAll("article.object, .part:not(#pdos, .pdo), #ui_contents details")) if (!kept.includes(card.id)) card.remove();
    for (const one of document.querySelectorAll("#pdos > :not(h2), .pdo > :not(h3)")) one.remove();
  }, [id, ...(pdos[0]?.places ?? []).map(([index]) => hex(index, 4))]);
  await page.evaluate(axe);
  const openers = [opener, page.locator("#ui_bus"), ...(pdos.length > 0 ? [page.locator(".pdo h3 .bench").first()] : [])];
  for (const [width, colorScheme] of [[1280, "light"], [1280, "dark"], [390, "light"], [390, "dark"]]) {
    await page.setViewportSize({ width, height: 800 });
    await page.emulateMedia({ colorScheme });
    for (const one of openers) {
      await one.click();
      const { left, right, top, bottom, wide } = await page.locator("#ui_bench").evaluate((panel) => ({ ...panel.getBoundingClientRect().toJSON(), wide: panel.scrollWidth > panel.clientWidth + 1 }));
      check(left >= 0 && right <= width && top >= 0 && bottom <= 800 && !wide, `${name} (${width} px): the panel is from ${left} to ${right}, ${top} to ${bottom}`);
      const { violations } = await page.evaluate(() => axe.run("#ui_bench", { rules: { "target-size": { enabled: true } }, resultTypes: ["violations"] }));
      for (const found of violations) fail(`${name} (${width} px, ${colorScheme}): axe ${found.id}: ${found.help}: ${found.nodes[0].html.slice(0, 160)}`);
      await page.keyboard.press("Escape");
      check(await becomes(page, () => !document.querySelector("#ui_bench:popover-open")), `${name}: Escape`);
    }
  }
  await page.close();

  // Without scripts there is no button that does nothing.
  const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  await plain.goto(pathToFileURL(join(docs, name)).href);
  same([await plain.locator(".bench").count(), await plain.locator("#ui_bus").count()], [0, 0], `${name}: buttons without scripts`);
  await plain.close();
}
await browser.close();
check(compared > 100, `only ${compared} values compared`);
console.log(`${compared} values and ${packed} frames of PDOs compared`);
end();
