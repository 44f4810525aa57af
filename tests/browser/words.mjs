// Asks an index of a few places what readers ask: sentences, other forms of words, compounds, words that nothing has, and addresses in every notation.
//
//   node words.mjs _words.js _search.js
import { readFileSync } from "node:fs";

const scripts = process.argv.slice(2, 4).map((file) => readFileSync(file, "utf8")).join("\n");
const { STOP_WORDS, WordIndex, addressesOf, plain, stem, stopWords, wordsOf } =
  new Function(`${scripts}\nreturn { STOP_WORDS, WordIndex, addressesOf, plain, stem, stopWords, wordsOf };`)();

let passed = 0;
const failures = [];
const same = (found, expected, text) => {
  if (JSON.stringify(found) === JSON.stringify(expected)) passed += 1;
  else failures.push(`${text}: ${JSON.stringify(found)} instead of ${JSON.stringify(expected)}`);
};

// Cards by their names, each with rows by theirs. A row has a fact, a text, an erratum, and words by which it is looked for.
const fill = (index, decoys) => {
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
  for (const word of decoys) card(word, word);
  return index;
};
const SYNONYMS = [["Zwischenkreis", "DC link"], ["Spannung", "voltage"], ["Störung", "fault"], ["quittieren", "reset"], ["store", "save"]];
const index = fill(new WordIndex(SYNONYMS), []);

const ask = (text, within = index) => {
  const work = within.search(text, null);
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

// Questions as readers ask them, with what they mean between asterisks. Each other word is the name of a card, too, and changes nothing: it is not asked for.
const SENTENCES = `
How do I *store* the *parameters*? / What is *bit 7* of the *statusword*? / Where can you find my *pitch angle* and its *limits*?
Who set our *voltage*, and how much is it? / Could we get a *fault* with this *voltage*? / Which one of these should I use for *home offset*?
Why did it go into *fault*? / Why has there been a *fault*? / What happens when the *temperature* goes up too much?
What would happen to the *position* at *halt*? / Tell me what *bit 8* does. / What will it do if I give a *halt*? / Do I need any *home offset*?
What must be in *drive data*? / I want to see some *voltage*. / What *voltage* had the *DC link*? / How do you adjust your *position window*?
How to change, configure, check or read an *offset*? / Does this *statusword* mean that there was a *fault*?
What are those *warnings*, and were they from the *DC link*? / So show me their *limits* by *drive data*. / How do I have them *stored*?
Can the *temperature* be *higher* than its *limit*? / What contains *limits*, and which contain the *statusword*? / the one containing *statusword*
What carries the *DC link circuit voltage*? / Does it carry *position* as *actual value*? / What happened then? *fault*
What does *bit 7* in it mean? / What means *warning*? / *halt* but one *fault* / Wie kann ich *Störungen* *quittieren*?
Was ist der *Blattwinkel*, und wo steht er? / Kannst du mir das *Statusword* ablesen, oder ist es nach dem *Halt* da? / Bin ich im *Fault*?
Was soll man bei einer *Störung* prüfen? / Wozu sind die *Parameter*? / Wofür ist dieses *Fenster*? / Wann hat mein *Blattwinkel* einen *Offset*?
Warum geht er noch in *Halt*? / Muss ich beim *Blattwinkel* auch den *Offset* einstellen? / Womit können sie ihr *Fenster* konfigurieren?
Woher ist das *Statusword* zu lesen, und durch was? / Gibt es aber für uns einen *Reset*?
Wie müssen die *Parameter* sein, damit sich der *Blattwinkel* *bewegt*? / Ob eine *Störung* steht? Wo stehen diese?
Auf dem *Blattwinkel* bis zum *Halt* / am *Fenster* vom *Reset* / als *Halt* / Welche *Parameter* werden zur *Position* *gespeichert*?
Was passiert mit dem *Fenster*, wenn *Halt* in *Bit 8* ist? / Um den *Offset* auslesen zu können / Heißt das, dass eines nur aus dem *Offset* ist?
Welcher enthält den *Offset*, und in welchem ist die *Temperatur* enthalten? / Welches *Bit 7* heißt *Warnung*?
Welchen *Offset* haben diese *Parameter*? / Wer kann mich vor *Störungen* *schützen*?
Sollte in diesem *Bit 7* von einem *Reset* des *Statusword* sein? / Wird ein *Halt* ins *Statusword* *gesetzt*?
dieser *Offset*, diesen *Offset*, dies über *Parameter* sehen
Please tell me about the *statusword* again. / What may I send out to *store* it? / Every *limit* may work while each other thing works just like *halt*.
Also, make only such *parameters*. / Is the *fault* still there? / Bitte zeigen: *Statusword* / Was zeigt alle *Parameter*? / Ich möchte dann doch etwas *Spannung*.
Hier immer jede *Warnung* / jeden *Fehler*, jeder *Reset* / Lassen wir mal mehr *Offset*? / Lässt er schon wieder sehr *Halt* machen? / Was macht das *Fenster*?
Was soll ich tun: *Störung* / Wo finde ich den *Offset*, und wo finden wir *Parameter*? / Ich brauche *Offset*. / Wir brauchen, wollen *Halt*.
Wie ändere ich den *Offset*, wie ändern wir *Parameter*? / Wie stelle ich den ein? *Offset* / Wie lese ich den *Offset*? / Liegt die *Warnung* an?
`;
const MEANT = /\*(.*?)\*/g, written = SENTENCES.trim().split(/ \/ |\n/);
const sentences = written.map((text) => [text.replaceAll("*", ""), [...text.matchAll(MEANT)].map(([, meant]) => meant).join(" ")]);
const decoys = new Set(written.flatMap((text) => wordsOf(text.replace(MEANT, " "))));
const asked = (within, text) => {
  const { cards, unknown, partial, of } = ask(text, within);
  return [of.gains.length, unknown, partial, cards.map(({ at }) => within.places[at].id)];
};
const among = () => fill(new WordIndex(SYNONYMS), decoys);
const failing = (within, list = sentences) => list.filter(([text, meant]) => JSON.stringify(asked(within, text)) !== JSON.stringify(asked(within, meant)));
for (const [text, meant] of failing(among())) failures.push(`${text} does not ask for ${meant} alone`);
// Each of the stop words is there once, and one of these questions needs it.
same(STOP_WORDS.filter((word, at) => STOP_WORDS.indexOf(word) !== at), [], "stop words that are there twice");
const unneeded = STOP_WORDS.map(plain).filter((word) => {
  stopWords.delete(word);
  const isNeeded = failing(among(), sentences.filter(([text]) => wordsOf(text).includes(word))).length > 0;
  stopWords.add(word);
  return !isNeeded;
});
same(unneeded, [], "stop words that no question needs");

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
