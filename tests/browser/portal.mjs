// The start page of several documents: one search finds places in all of them, and pages lead to one another and back.
//
//   node portal.mjs DOCS CHROMIUM
import { resolve, join } from "node:path";
import { pathToFileURL } from "node:url";
import { check, end, fail, launch, same } from "./browser.mjs";

const [docs, executablePath] = process.argv.slice(2).map((path) => resolve(path));
const address = (path) => pathToFileURL(join(docs, path)).href;
const browser = await launch(executablePath);
const context = await browser.newContext();
const page = await context.newPage();
page.on("pageerror", (error) => fail(error.message));

// What a question finds: the pages, without what follows `#`.
const ask = async (question) => {
  await page.goto(address("index.html"));
  await page.fill("#ui_search", question);
  await page.waitForFunction(() => performance.getEntriesByName("search", "measure").length > 0);
  return page.$$eval("#ui_results a", (links) => links.map((link) => link.getAttribute("href")));
};

const found = await ask("threshold");
check(found.length > 0, "the start page finds nothing");
for (const folder of ["two/en", "two/de", "twice/en", "twice/de"]) {
  check(found.some((href) => href.startsWith(`${folder}/`)), `no result is in ${folder}: ${found.join(", ")}`);
}
await page.goto(new URL(found[0], address("index.html")).href);
const target = decodeURIComponent(new URL(page.url()).hash.slice(1));
check(await page.locator(`[id="${target}"]`).count() === 1, `${found[0]} leads nowhere`);
// To the same page in the other language and back, to the start page, and to a document from there.
const first = page.url().split("#")[0];
await page.click("a[hreflang]");
check(page.url() !== first, "the language does not change");
check(await page.locator("html").getAttribute("lang") !== await page.locator("a[hreflang]").getAttribute("lang"), "a page leads to its own language");
await page.click("a[hreflang]");
same(page.url().split("#")[0], first, "back in the first language");
await page.click(".brand a");
same(page.url(), address("index.html"), "the first link of a page");
// A document is listed once, and each of its pages leads to the other language.
same(await page.$$eval("main section.part", (all) => all.map((one) => one.id)), ["two/en", "twice/en"], "the documents that are listed");
const others = await page.$$eval("main section.part a[hreflang]", (links) => links.map((link) => link.getAttribute("href")));
for (const href of ["two/de/index.html", "two/de/two.html", "twice/de/index.html"]) check(others.includes(href), `no link to ${href}: ${others}`);
await page.click("main section a[hreflang]");
same(await page.locator("html").getAttribute("lang"), "de", "the other language of a document");
await page.goto(address("index.html"));
await page.click("main section h2 a");
check(await page.locator("main h1").count() === 1, "a document opens from the start page");
await browser.close();
end();
