// What the scripts that use Chromium have in common: the browser, what was found, and how a page is waited for.
import { chromium } from "playwright-core";

// How long anything may take, in milliseconds: a right page never takes it, however busy the machine is.
const LONGEST = 120000;

const failures = [];
let passed = 0;
export const fail = (text) => failures.push(text);
export const check = (holds, text) => { if (holds) passed += 1; else fail(text); };
export const same = (found, expected, text) => {
  const [a, b] = [JSON.stringify(found), JSON.stringify(expected)];
  check(a === b, `${text}: ${a?.slice(0, 300)} instead of ${b?.slice(0, 300)}`);
};

export const launch = async (executablePath) => {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"], timeout: LONGEST });
  return {
    newContext: async (options) => {
      const context = await browser.newContext(options);
      context.setDefaultTimeout(LONGEST);
      return context;
    },
    close: () => browser.close(),
  };
};

// Whether something comes true in a page.
export const becomes = (page, condition, argument) => page.waitForFunction(condition, argument).then(() => true, () => false);
// Until a page has drawn so often, with the timers before that.
export const frames = (page, count) => page.evaluate(async (most) => {
  await new Promise((done) => setTimeout(done));
  for (let drawn = 0; drawn < most; drawn++) await new Promise(requestAnimationFrame);
}, count);

// Reports what was found, and ends the program.
export const end = () => {
  for (const failure of failures.slice(0, 60)) console.error(`FAILED ${failure}`);
  console.log(`${passed} passed, ${failures.length} failed`);
  process.exit(failures.length ? 1 : 0);
};
