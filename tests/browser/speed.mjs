// How long the script of a large page takes for each letter of a question, in milliseconds.
//
//   python3 tests/bench/synthetic.py 10000 --out large.od.yaml && cargo odgen docs large.od.yaml --format html --out large
//   node speed.mjs large/large/controller.html CHROMIUM
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [file, executablePath] = process.argv.slice(2).map((path) => resolve(path));
const QUESTIONS = ["channel 17 target speed", "warning limit", "status", "temprature", "0x2050", "rpm", "undervoltage"];
const LIMIT = 10;

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
await page.goto(pathToFileURL(file).href);
// The page is read in idle time.
await page.waitForFunction(() => performance.getEntriesByName("search-ready").length > 0, null, { timeout: 120000 });
const all = [];
for (const question of QUESTIONS) {
  const times = await page.evaluate(async (text) => {
    const search = document.getElementById("ui_search"), durations = [];
    for (let length = 1; length <= text.length; length++) {
      search.value = text.slice(0, length);
      search.dispatchEvent(new Event("input"));
      durations.push(performance.getEntriesByName("search", "measure").at(-1).duration);
      await new Promise((done) => setTimeout(done, 150));
    }
    return durations;
  }, question);
  all.push(...times);
  console.log(`${question}: ${times.map((time) => time.toFixed(1)).join(" ")}`);
}
await browser.close();
all.sort((one, other) => one - other);
const at = (part) => all[Math.floor(part * (all.length - 1))].toFixed(1);
console.log(`${all.length} letters: half below ${at(0.5)} ms, nine of ten below ${at(0.9)} ms, the longest ${at(1)} ms`);
process.exit(Number(at(0.9)) > LIMIT ? 1 : 0);
