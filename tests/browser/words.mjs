// Asks an index of a few places what readers ask: sentences, other forms of words, compounds, words that nothing has, and addresses in every notation.
//
//   node words.mjs _words.js _search.js
import { readFileSync } from "node:fs";

const scripts = process.argv.slice(2, 4).map((file) => readFileSync(file, "utf8")).join("\n");
const { WordIndex, addressesOf, stem } = new Function(`${scripts}\nreturn { WordIndex, addressesOf, stem };`)();

let passed = 0;
const failures = [];
const same = (found, expected, text) => {
  if (JSON.stringify(found) === JSON.stringify(expected)) passed += 1;
  else failures.push(`${text}: ${JSON.stringify(found)} instead of ${JSON.stringify(expected)}`);
};

// Cards by their names, each with rows by theirs. A row has a fact, a text, an erratum, and words by which it is looked for.
const index = new WordIndex([["Zwischenkreis", "DC link"], ["Spannung", "voltage"], ["Störung", "fault"], ["quittieren", "reset"], ["store", "save"]]);
const card = (id, name, { text = "", phrases = [], rows = [] } = {}) => {
  index.card({});
  index.place({ kind: "object", id }, [[id, name], [], [text], []], phrases);
  for (const { name, fact = "", about = "", erratum = "", phrases: own = [] } of rows) {
    index.place({ kind: "row", id: `${id}.${name}` }, [[], [name, fact], [about], [erratum]], own, 1);
  }
};
card("1010", "Store parameters");
card("6040", "Controlword", { rows: [{ name: "bit 7", fact: "fault reset" }, { name: "bit 8", fact: "halt" }] });
card("6041", "Statusword", { rows: [{ name: "bit 7", fact: "warning" }] });
card("6064", "position actual value", { phrases: ["pitch angle", "Blattwinkel"], text: "Where the axis is." });
card("6067", "position window", { text: "Positionsfenster um die Zielposition." });
card("6079", "DC link circuit voltage", { text: "Messwert." });
card("6510", "drive data", { rows: [{ name: "min", fact: "lowest limit of the temperature" }, { name: "max", fact: "highest limit" }] });
card("607C", "home offset", { rows: [{ name: "value", fact: "Nullpunkt", erratum: "the manual prints actual pitch parameters of the statusword" }] });

const ask = (text) => {
  const work = index.search(text, null);
  let step;
  do step = work.next(); while (!step.done);
  return step.value;
};
const finds = (text, expected) => {
  const [first] = ask(text).cards;
  same(first && index.places[first.at].id, expected, text);
};
// A sentence; other forms; words of the specification; a compound of the question and one of the page; synonyms of two words; the object before its erratum.
for (const [text, expected] of [
  ["how do I store the parameters?", "1010"], ["saving a parameter", "1010"], ["what is bit 7 of the statusword", "6041.bit 7"], ["warnings", "6041.bit 7"],
  ["pitch angle", "6064"], ["actual pitch angle", "6064"], ["Blattwinkel", "6064"], ["Zwischenkreisspannung", "6079"], ["Zwischenkreisspannungen", "6079"],
  ["Fenster", "6067"], ["Position Fenster", "6067"], ["Störung quittieren", "6040.bit 7"], ["Störungen quittiert", "6040.bit 7"], ["limits temperature", "6510.min"],
  ["statusword parameters", "6041"], ["statusword", "6041"],
]) finds(text, expected);
// What nothing has is left out, and said; what no place has as a whole is found by most of it, and that is said, too.
for (const [text, unknown, partial] of [
  ["pitch angle", [], false], ["pitch angle xyzzyq", ["xyzzyq"], false], ["halt controlword blattwinkel", [], true], ["xyzzyq", ["xyzzyq"], false],
]) {
  const found = ask(text);
  same([found.unknown, found.partial], [unknown, partial], text);
}
same(ask("xyzzyq").cards, [], "xyzzyq");
same(ask("  ,"), null, "no words");

// Each word and those that are the same except for their endings.
for (const words of [
  ["limit", "limits", "limited", "limiting"], ["store", "stores", "stored", "storing"], ["battery", "batteries"], ["switch", "switches", "switching", "switched"],
  ["parameter", "parameters"], ["stop", "stopped", "stopping"], ["storung", "storungen"], ["begrenzen", "begrenzt", "begrenzung"], ["spannung", "spannungen"],
  ["quittieren", "quittiert", "quittierung"], ["fehler", "fehlern", "fehlers"], ["grenzwert", "grenzwerte"],
]) same(new Set(words.map(stem)).size, 1, words.join(", "));
for (const words of [["storung", "stored"], ["wert", "werk"], ["status", "statu"]]) same(new Set(words.map(stem)).size, 2, words.join(", "));

// The likeliest meaning of each notation.
for (const [text, expected] of [
  ["6041", "6041"], ["606c", "606C"], ["0x6041", "6041"], ["6041h", "6041"], ["16#6041", "6041"], ["6041.b7", "6041.b7"], ["6041:07", "6041.7"], ["0x6041:0A", "6041.10"],
  ["6510sub7", "6510.7"], ["6510 sub 7", "6510.7"], ["6510sub-index 7", "6510.7"], ["6510,7", "6510.7"], ["6510.7", "6510.7"], ["6510/0x0A", "6510.10"], ["6510.0Ah", "6510.10"],
  ["6510.7.b3", "6510.7.b3"], ["bit 7 of 6041h", "6041.b7"], ["what is bit 7 of 6041?", "6041.b7"], ["Bit 7 von 6041", "6041.b7"], ["6041 bit 7", "6041.b7"], ["6060.v-113", "6060.v-113"],
  ["value 8 of 6060", "6060.v8"], ["60410010", "6041"], ["0x60410010", "6041"], ["60410010h", "6041"], ["65100710", "6510.7"], ["1614872592", "6041"],
]) same(addressesOf(text)[0], expected, text);
same(addressesOf("24640").includes("6040"), true, "24640");
for (const text of ["statusword", "bit 7", "6041 and 6040", "the 12 V supply", "battery 24640 V"]) same(addressesOf(text), [], text);

for (const failure of failures) console.error(`FAILED ${failure}`);
console.log(`${passed} passed, ${failures.length} failed`);
process.exit(failures.length ? 1 : 0);
