// At every width of a window tables stay tables, except on a phone; what is wider than its place is scrolled there, says so, and is reached by the keyboard.
//
//   node widths.mjs DOCS CHROMIUM AMOUNT
//
// AMOUNT is `all` or `sample`: then the narrowest and the widest screen of each layout.
import { readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { end, fail, frames, launch, same } from "./browser.mjs";

const [docs, executablePath] = process.argv.slice(2, 4).map((path) => resolve(path));
const isSample = process.argv[4] === "sample";
// Screens that are common, and both sides of where the layout changes.
const PHONE = 600, WIDTHS = isSample ? [390, PHONE + 1, 1024, 1400] : [390, PHONE, PHONE + 1, 800, 1000, 1024, 1201, 1280, 1366, 1400, 1920];

const browser = await launch(executablePath);
const context = await browser.newContext();
for (const name of readdirSync(docs).filter((file) => file.endsWith(".html"))) {
  const page = await context.newPage();
  page.on("pageerror", (error) => fail(`${name}: ${error.message}`));
  await page.goto(pathToFileURL(join(docs, name)).href);
  // Everything is laid out and shown, also errata and what is folded.
  await page.addStyleTag({ content: "* { content-visibility: visible !important }" });
  await page.evaluate(() => {
    document.documentElement.classList.remove("unmarked");
    for (const one of document.querySelectorAll("main details")) one.open = true;
  });
  for (const width of WIDTHS) {
    await page.setViewportSize({ width, height: 900 });
    if (width <= PHONE) await page.waitForFunction(() => !document.querySelector(".stack:not(.stacked)"));
    await frames(page, 3);
    const found = await page.evaluate(() => {
      const place = (one) => `${one.closest("[id]")?.id}: ${one.textContent.slice(0, 40)}`;
      const isTable = (table) => getComputedStyle(table).display === "table" && [...table.tBodies[0].rows].every((row) => row.matches(".off") || getComputedStyle(row).display === "table-row");
      const tables = [...document.querySelectorAll("main table")], boxes = [...document.querySelectorAll(".scroll")];
      const isWide = (box) => box.scrollWidth > box.clientWidth + 1;
      const isSaid = (box) => box.tabIndex === 0 && box.role === "group" && box.ariaLabel && getComputedStyle(box, "::before").content.length > 4;
      const { scrollWidth, clientWidth } = document.documentElement;
      return {
        cards: tables.filter((table) => !isTable(table)).length,
        stacks: tables.filter((table) => table.matches(".stack")).length,
        scrolled: boxes.filter(isWide).length,
        unsaid: boxes.filter((box) => isWide(box) && !isSaid(box)).map(place),
        idle: boxes.filter((box) => !isWide(box) && box.tabIndex === 0).map(place),
        wide: [...document.querySelectorAll("main :is(.object, .part, .intro, .table, details, dl, p, table)")].filter((one) => !one.closest(".scroll") && isWide(one)).map(place),
        sideways: scrollWidth - clientWidth,
        all: tables.length,
      };
    });
    same(found.cards, width <= PHONE ? found.stacks : 0, `${name} (${width} px): tables shown as cards`);
    for (const [fault, list] of [["is scrolled and does not say so", found.unsaid], ["is reached by the keyboard for nothing", found.idle], ["is wider than its place", found.wide]]) {
      same(list, [], `${name} (${width} px): ${fault}`);
    }
    same(found.sideways, 0, `${name} (${width} px): the page is scrolled sideways`);
    console.log(`${name}, ${width} px: ${found.cards} of ${found.all} tables as cards, ${found.scrolled} tables and pictures scrolled`);
  }
  await page.close();
}
await browser.close();
end();
