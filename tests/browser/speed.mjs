// How long the script of a large page takes for each letter of a question, in milliseconds, and until all that it puts off is done.
//
//   python3 tests/bench/synthetic.py 10000 --out large.od.yaml && cargo odgen docs large.od.yaml --format html --out large
//   node speed.mjs large/large/controller.html CHROMIUM
//
// The page is opened several times, and all is typed as if for the first time: what a letter takes is the middle of these, as a machine has more to do than
// this. Exit code 1: a letter takes too long.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [file, executablePath] = process.argv.slice(2).map((path) => resolve(path));
const QUESTIONS = ["channel 17 target speed", "warning limit", "status", "temprature", "0x2050", "rpm", "undervoltage"];
const LIMIT = 10, TIMES = 5;

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const open = async () => {
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  await page.goto(pathToFileURL(file).href);
  // The page is read in idle time.
  await page.waitForFunction(() => performance.getEntriesByName("search-ready").length > 0, null, { timeout: 120000 });
  // What reading the page left is taken away once, not while a reader types.
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  return page;
};

// Everything that the script does between a letter and the next one is measured, in the handler and in every later piece: the longest piece, and the end of the last.
const type = (page, question) => page.evaluate(async (text) => {
  const search = document.getElementById("ui_search"), letters = [];
  for (let length = 1; length <= text.length; length++) {
    performance.clearMeasures();
    search.value = text.slice(0, length);
    const begun = performance.now();
    search.dispatchEvent(new Event("input"));
    await new Promise((done) => setTimeout(done, 150));
    const pieces = performance.getEntriesByName("search-piece", "measure");
    letters.push({
      longest: Math.max(...pieces.map((one) => one.duration)),
      whole: Math.max(...pieces.map((one) => one.startTime + one.duration)) - begun,
    });
  }
  return letters;
}, question);
const middle = (numbers) => [...numbers].sort((one, other) => one - other)[numbers.length >> 1];

const runs = [], paints = [];
for (let time = 0; time < TIMES; time++) {
  const page = await open(), letters = [];
  paints.push(await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime));
  for (const question of QUESTIONS) letters.push(...await type(page, question));
  runs.push(letters);
  await page.close();
}
await browser.close();
const texts = QUESTIONS.flatMap((question) => [...question].map((_, at) => question.slice(0, at + 1)));
const all = texts.map((text, at) => ({ text, longest: middle(runs.map((run) => run[at].longest)), whole: middle(runs.map((run) => run[at].whole)) }));
let line = "";
for (const { text, longest } of all) {
  if (text.length === 1 && line) { console.log(line); line = ""; }
  line += ` ${text.at(-1)} ${longest.toFixed(1)}`;
}
console.log(line);
const at = (part, key) => all.map((one) => one[key]).sort((one, other) => one - other)[Math.floor(part * (all.length - 1))].toFixed(1);
const [slowest] = [...all].sort((one, other) => other.longest - one.longest);
console.log(`first paint after ${middle(paints).toFixed(0)} ms`);
console.log(`${all.length} letters: half below ${at(0.5, "longest")} ms, nine of ten below ${at(0.9, "longest")} ms, the longest ${at(1, "longest")} ms (${slowest.text})`);
console.log(`until everything is found: half below ${at(0.5, "whole")} ms, nine of ten below ${at(0.9, "whole")} ms, the longest ${at(1, "whole")} ms`);
process.exit(slowest.longest > LIMIT ? 1 : 0);
