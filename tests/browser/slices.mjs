// Holds a search that may be interrupted against how much it does at once: the places of the index that are looked at between two interruptions are counted, as
// time depends on the machine.
//
//   node slices.mjs _words.js _search.js
import { readFileSync } from "node:fs";

// Places of one card, and how many of all may be looked at in one go.
const PLACES = 20000, MOST = 1024;
const scripts = process.argv.slice(2, 4).map((file) => readFileSync(file, "utf8")).join("\n");
const WordIndex = new Function(`${scripts}\nreturn WordIndex;`)();

const failures = [];
// All in one card, as a list of ten thousand rows is; and each in a card of its own.
for (const perCard of [PLACES, 1]) {
  const index = new WordIndex([["limit", "threshold"]]);
  for (let at = 0; at < PLACES; at++) {
    if (at % perCard === 0) index.card({});
    index.place({ kind: "row" }, [[`channel ${at}`], ["warning limit"], ["stored at once"], []]);
  }
  let looked = 0;
  index.places = new Proxy(index.places, { get: (places, key) => { if (/^\d+$/.test(String(key))) looked += 1; return places[key]; } });
  for (const question of ["ch", "channel", "channel limit", "threshold", "warning limt", "wa st", "channel 17 warning"]) {
    for (const allowed of [null, () => true]) {
      const work = index.search(question, allowed);
      let most = 0, step;
      do {
        looked = 0;
        step = work.next();
        most = Math.max(most, looked);
      } while (!step.done);
      if (step.value.cards.length === 0) failures.push(`${question}: nothing is found`);
      if (most > MOST) failures.push(`${question}, ${perCard} places per card: ${most} places at once, at most ${MOST} expected`);
    }
  }
}
for (const failure of failures) console.error(`FAILED ${failure}`);
console.log(`${failures.length} failed`);
process.exit(failures.length ? 1 : 0);
