// Asks the pages what readers ask, and compares the first result; follows links in every way, and measures where they land.
//
//   node questions.mjs DOCS CHROMIUM AMOUNT
//
// AMOUNT is `all` or `sample`: then each sixth question and each sixth link has its turn at one of the widths.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { becomes, check, end, fail, launch } from "./browser.mjs";

const [docs, executablePath] = process.argv.slice(2, 4).map((path) => resolve(path));
const isSample = process.argv[4] === "sample";
const table = JSON.parse(readFileSync(join(dirname(fileURLToPath(import.meta.url)), "questions.json")))[basename(docs)] ?? {};
const WIDTHS = [390, 800, 1400];
// How far below the bar a target may be.
const NEAR = 8;
// How much later than usual a page hears of what is laid out, in frames: longer than it waits for a target to stop moving.
const LATE = 30;
// What has its turn at a width.
const turns = (list, width) => list.filter((_, at) => WIDTHS[at % WIDTHS.length] === width);
const sixths = (list) => (isSample ? list.filter((_, at) => at % 6 === 1) : list);
const some = (list, width) => (isSample ? turns(sixths(list), width) : list);
// Copies of pages that do something late or in small pieces.
const copies = mkdtempSync(join(tmpdir(), "od-pages-"));
const copyOf = (name, change) => {
  const text = readFileSync(join(docs, name), "utf8"), file = join(copies, name);
  writeFileSync(file, change(text));
  return pathToFileURL(file).href;
};

let farthest = 0;
const browser = await launch(executablePath);
const context = await browser.newContext();

const open = async (address, width) => {
  const page = await context.newPage();
  page.on("pageerror", (error) => fail(`${address}: ${error.message}`));
  await page.setViewportSize({ width, height: 900 });
  await page.goto(address);
  return page;
};

// Where a target is below what covers the top, once it has stopped moving.
const gap = (page, id) => page.evaluate(async (name) => {
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  let still = 0, last = NaN;
  // Longer than the page itself follows what it went to.
  for (let frames = 0; still < 14 && frames < 240; frames++) {
    await frame();
    const bar = document.querySelector(".bar"), covered = getComputedStyle(bar).position === "sticky" ? bar.getBoundingClientRect().bottom : 0;
    const named = document.getElementById(name), target = named?.matches("td > i") ? named.closest("tr") : named;
    const here = target?.checkVisibility() ? target.getBoundingClientRect().top - Math.max(covered, 0) : NaN;
    still = here === last ? still + 1 : 0;
    last = here;
  }
  return last;
}, id);
const lands = async (page, id, text) => {
  const here = await gap(page, id);
  farthest = Math.max(farthest, Math.abs(here));
  check(here >= -0.5 && here <= NEAR, `${text}: #${id} is ${here} px below the bar`);
};

// Until the page says that it has shown its answer to the last question.
const answered = (page) => becomes(page, () => performance.getEntriesByName("search", "measure").length > 0);

const firstOf = (page) => page.evaluate(() => {
  const link = document.querySelector("#ui_results:not(.off) ol a");
  return link ? decodeURIComponent(link.hash.slice(1)) : null;
});

let asked = 0, followed = 0;
for (const [name, { questions, links }] of Object.entries(table)) {
  const address = pathToFileURL(join(docs, name)).href;
  // The widths at the same time: most of the time a page does not change, and that is waited for.
  await Promise.all(WIDTHS.map(async (width) => {
    const page = await open(address, width);
    const mine = turns(sixths(questions), width);
    for (const one of some(questions, width)) {
      const [question, expected] = one, place = `${name} at ${width} px: ${question}`;
      await page.fill("#ui_search", question);
      await answered(page);
      const first = await firstOf(page);
      check(first === expected, `${place}: #${first} instead of #${expected}`);
      asked += 1;
      // Enter goes there; one width for each question is enough of that.
      if (mine.includes(one) && first === expected) {
        await page.press("#ui_search", "Enter");
        // A row without an address of its own is reached inside of what has one.
        if (await page.locator("#ui_results ol a").first().evaluate((link) => !link.matches(".inside"))) await lands(page, expected, `${place}, Enter`);
        check(new URL(page.url()).searchParams.get("q") === question, `${place}: ${page.url()} does not hold the question`);
      }
    }
    await page.close();

    for (const id of some(links, width)) {
      const hash = `#${id}`, place = `${name} at ${width} px`;
      const opened = await open(address + hash, width);
      await lands(opened, id, `${place}, opened`);
      // As if typed into the address bar, in small letters, from the end of the page.
      await opened.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
      await opened.evaluate((text) => { location.hash = text; }, "#");
      await opened.evaluate((text) => { location.hash = text; }, hash.toLowerCase());
      await lands(opened, id, `${place}, typed`);
      // A link in the page, while the search has put the target away.
      await opened.fill("#ui_search", "qqqqq");
      await opened.evaluate((text) => {
        const link = Object.assign(document.createElement("a"), { href: text, textContent: "link" });
        document.querySelector(".bar").append(link);
        link.click();
        link.remove();
      }, hash);
      await lands(opened, id, `${place}, followed`);
      // Away, to another place of the page, and back.
      await opened.evaluate(() => { location.hash = "#ui_nowhere"; scrollTo(0, document.documentElement.scrollHeight / 2); });
      // Also the browser around the page has to know of the step.
      await opened.waitForURL(/#ui_nowhere$/);
      await opened.goBack();
      await lands(opened, id, `${place}, back`);
      // To another page and back.
      await opened.goto("about:blank");
      await opened.goBack();
      await lands(opened, id, `${place}, back from another page`);
      await opened.close();
      followed += 5;
    }
  }));
}

// What readers ask in their own words is the first result, or (`near`) among the first three. Enter leads some of them to a place that the first screen shows.
const FIRST_OF = isSample ? 16 : 4;
for (const [name, { sentences = [], near = [] }] of Object.entries(table)) {
  const page = await open(pathToFileURL(join(docs, name)).href, 1400);
  for (const [at, [question, expected, most]] of sixths([...sentences.map((one) => [...one, 0]), ...near.map((one) => [...one, 2])]).entries()) {
    await page.fill("#ui_search", question);
    await answered(page);
    const found = await page.$$eval("#ui_results:not(.off) ol a", (links) => links.slice(0, 3).map((link) => decodeURIComponent(link.getAttribute("href"))));
    const place = found.findIndex((href) => href === `#${expected}` || href.endsWith(`.html#${expected}`));
    check(place >= 0 && place <= most, `${name}: ${question} finds ${found.join(", ")}, not #${expected}`);
    asked += 1;
    if (at % FIRST_OF !== 0 || found[0] !== `#${expected}`) continue;
    await page.press("#ui_search", "Enter");
    const inside = await page.locator("#ui_results ol a").first().evaluate((link) => link.matches(".inside"));
    if (!inside) await lands(page, expected, `${name}: ${question}, Enter`);
  }
  await page.close();
}

// A page of which a busy machine makes something late, as it is on a fast one: the browser reports late what it has laid out, so that tables fold after a link has
// landed; it goes late where the reader was; and what an address asks for is found only after its target was shown.
const late = await browser.newContext();
await late.addInitScript((delay) => {
  const { addEventListener } = document;
  const after = (work, count = delay) => (count > 0 ? requestAnimationFrame(() => after(work, count - 1)) : work());
  document.addEventListener = function (kind, listener, ...more) {
    const isLate = kind === "contentvisibilityautostatechange";
    addEventListener.call(this, kind, isLate ? (event) => after(() => listener({ target: event.target, skipped: event.skipped })) : listener, ...more);
  };
  // A browser that goes back puts the reader where he was, unless the page does that itself.
  addEventListener("load", () => {
    after(() => { if (history.scrollRestoration === "auto") scrollTo(0, document.documentElement.scrollHeight / 2); });
    document.quiet = 0;
    const count = () => { document.quiet += 1; requestAnimationFrame(count); };
    count();
  });
  // What is folded is passed to the check.
  new MutationObserver((changes) => { if (changes.some(({ target }) => target.matches(".folded"))) document.quiet = 0; })
    .observe(document, { subtree: true, attributeFilter: ["class"] });
}, LATE);
await Promise.all(Object.entries(table).map(async ([name, { questions, links }]) => {
  const address = pathToFileURL(join(docs, name)).href, page = await late.newPage();
  page.on("pageerror", (error) => fail(`${name}, late: ${error.message}`));
  await page.setViewportSize({ width: 1400, height: 900 });
  for (const id of sixths(links)) {
    await page.goto("about:blank");
    await page.goto(`${address}#${id}`);
    // Until nothing more is folded.
    await becomes(page, (delay) => document.quiet > 2 * delay, LATE);
    await lands(page, id, `${name}, laid out late`);
    // Wherever the reader goes, what the link leads into stays laid out: else the rows after the estimated end of a part cannot be reached.
    const isHeld = await page.evaluate(async (name) => {
      const frame = () => new Promise((done) => requestAnimationFrame(done)), { scrollHeight } = document.documentElement;
      scrollTo(0, scrollY > scrollHeight / 2 ? 0 : scrollHeight);
      for (let frames = 0; frames < 6; frames++) await frame();
      return document.getElementById(name).checkVisibility({ contentVisibilityAuto: true });
    }, id);
    check(isHeld, `${name}: the part with #${id} is not laid out any more`);
  }
  await page.close();

  const slow = copyOf(name, (text) => text.replace("read(100)", "read(0.2)"));
  check(readFileSync(fileURLToPath(slow), "utf8").includes("read(0.2)"), `${name}: its script reads without a limit`);
  const [id] = links;
  for (const question of ["qqqqq", questions[0][0]]) {
    const opened = await open(`${slow}?q=${encodeURIComponent(question)}#${id}`, 1400);
    await answered(opened);
    await lands(opened, id, `${name}, ${question} found late`);
    await opened.close();
  }
}));
await late.close();

// A search in slices, which only pages of many thousand places have, finds the same: a copy of the page has one slice for each piece of the work.
for (const [name, { questions }] of Object.entries(table)) {
  const sliced = copyOf(name, (text) => text.replace("apply(index.places.length > MANY_PLACES)", "apply(true)").replace("SLICE = 3;", "SLICE = 0;"));
  const copy = readFileSync(fileURLToPath(sliced), "utf8");
  check(copy.includes("apply(true)") && copy.includes("SLICE = 0"), `${name}: its script has no slices`);
  const asked = some(questions, WIDTHS[0]).map(([question]) => question);
  const answers = async (address) => {
    const page = await open(address, 1400);
    await becomes(page, () => performance.getEntriesByName("search-ready").length > 0);
    const found = await page.evaluate(async (texts) => {
      const search = document.getElementById("ui_search"), ask = (value) => { search.value = value; search.dispatchEvent(new Event("input")); };
      const found = [];
      for (const text of texts) {
        // A letter follows while the search for the one before goes on.
        ask(text.slice(0, -1));
        ask(text);
        while (performance.getEntriesByName("search", "measure").length === 0) await new Promise(requestAnimationFrame);
        const pieces = performance.getEntriesByName("search-piece", "measure").length;
        found.push([pieces, [...document.querySelectorAll("#ui_results li")].map((line) => line.textContent + line.querySelector("a")?.hash).join("\n")]);
      }
      return found;
    }, asked);
    await page.close();
    return found;
  };
  const [expected, found] = await Promise.all([pathToFileURL(join(docs, name)).href, sliced].map(answers));
  for (const [at, question] of asked.entries()) check(found[at][1] === expected[at][1], `${name}, in slices: ${question} finds ${found[at][1].slice(0, 200)}`);
  check(found.some(([pieces]) => pieces > 10), `${name}: nothing is found in slices`);
}
rmSync(copies, { recursive: true });

// The question stays: in the address, when the page is loaded again, and on the way back.
await Promise.all(Object.entries(table).map(async ([name, { questions }]) => {
  const address = pathToFileURL(join(docs, name)).href, [question, expected] = questions[0];
  const page = await open(`${address}?q=${encodeURIComponent(question)}`, 1400);
  const state = async () => {
    await page.waitForFunction((text) => document.getElementById("ui_search").value === text, question).catch(() => null);
    await answered(page);
    return [await page.inputValue("#ui_search"), await firstOf(page)].join(" → ");
  };
  const wanted = `${question} → ${expected}`;
  check(await state() === wanted, `${name}: opened with a question, ${await state()}`);
  await page.reload();
  check(await state() === wanted, `${name}: loaded again, ${await state()}`);
  await page.goto(address);
  await page.fill("#ui_search", question);
  await page.waitForFunction(() => location.search !== "");
  await page.goBack();
  await page.waitForFunction(() => document.getElementById("ui_search").value === "").catch(() => null);
  check(await page.inputValue("#ui_search") === "", `${name}: back before the question, ${await page.inputValue("#ui_search")}`);
  await page.goForward();
  check(await state() === wanted, `${name}: forward, ${await state()}`);
  // Words are marked piece by piece, rows that do not fit are away, and all can be shown.
  check(await page.waitForSelector("mark", { state: "attached" }).catch(() => null), `${name}: nothing is marked`);
  // On paper everything is there, also while the page is filtered.
  const away = () => page.$$eval("article, .part, article tr", (all) => all.filter((one) => !one.checkVisibility()).length);
  await page.fill("#ui_search", question);
  await page.waitForFunction(() => [...document.querySelectorAll("article, .part, article tr")].some((one) => !one.checkVisibility())).catch(() => null);
  check(await away() > 0, `${name}: ${question} puts nothing away`);
  await page.emulateMedia({ media: "print" });
  check(await away() === 0, `${name}: ${await away()} cards and rows are missing on paper`);
  await page.close();
}));
await browser.close();

console.log(`${asked} questions, ${followed} links, at most ${farthest} px from the bar`);
end();
