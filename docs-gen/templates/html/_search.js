  // ---- Words: what is compared when a reader looks for something. This part knows nothing about the page.

  // What a word of the question is worth by where it is, and by how a word of the page fits: it is the same, another form, longer, or has it inside.
  const NAME = 0, FACT = 1, TEXT = 2, ERRATUM = 3;
  const WORTH = [1, 0.9, 0.45, 0.15], FULL = 255;
  const SAME = 0, FORM = 1, BEGINNING = 2, INSIDE = 3;
  const GRADE = [1, 0.85, 0.85, 0.4];
  // What is left of that for words that mean the same, for one that is written like it, for one that only the head of the card has, and for a place without another word.
  const SYNONYM = 0.9, SIMILAR = 0.6, OF_CARD = 0.97, PARTLY = 0.9;
  // How much depends on what a place is called, the weight of a stop word in a name, from where on a name is the question, and from where on two places differ.
  const NEARNESS = 0.2, LITTLE = 3, EXACT = 0.99, STEPS = 50;
  // What a place that lacks a word has to have of the best one, to be found.
  const AS_GOOD = 0.7;
  const READ_AT_ONCE = 200, MANY_PLACES = 8000;
  const NOTHING = { asked: 0 };
  // A synonym has at most so many words after its first.
  const MOST_OF_PHRASE = 5;
  // The parts of a German compound, and what joins them.
  const SHORTEST_PART = 4, MOST_PARTS = 3, JOINTS = ["s", "es", "n", "en", "er"];
  // After so many words, hits, places and cards a search may be interrupted: none of these takes a millisecond.
  const SOME = 512, SOME_CARDS = 64;

  // A word; a number of any notation; `r(w)` and `(w)`, which are words of their own.
  const WORD = /r?\(w\)|0x[0-9a-f]+|\d+(?:[.,]\d+)+|[\p{L}\p{M}\p{N}°%]+/giu;
  // `0x8611`, `8611h` and `8611` are one word, and so are `Ä`, `ae` and `a`.
  const plain = (word) => {
    const folded = word.toLowerCase().normalize("NFKD").replace(/\p{M}/gu, "");
    if (/\d/.test(folded)) {
      const digits = /^0x([0-9a-f]+)$|^([0-9a-f]+)h$/.exec(folded);
      return digits ? (digits[1] ?? digits[2]).replace(/^0+(?=.)/, "") : folded.replaceAll(",", ".");
    }
    return folded.replaceAll("ß", "ss").replace(/([aou])e/g, "$1");
  };
  const wordsOf = (text) => (text.match(WORD) ?? []).map(plain);
  const stopWords = new Set(STOP_WORDS.map(plain));
  // The words that carry the meaning; of a question of nothing but stop words, all.
  const meantOf = (words) => {
    // A bus is called like a verb, which such a word follows.
    const meant = words.filter((word, at) => !stopWords.has(word) || (word === "can" && !stopWords.has(words[at + 1])));
    return meant.length > 0 ? meant : words;
  };

  // ---- Addresses: an object, an entry, a bit or a value, in any notation.
  const ADDRESS = new RegExp([
    /^(?:(?<first>bit|value|wert) ?(?<ofFirst>-?\d+) )?(?:0x|16#)?(?<index>[0-9a-f]{4})h?/,
    /(?: ?(?:[.,/]|sub-?(?:index)?) ?(?<decimal>\d{1,3})(?![0-9a-f]*h)|:(?:0x|16#)?(?<hex>[0-9a-f]{1,2})h?|[.,/](?:0x|16#)?(?<marked>[0-9a-f]{1,2})h|[.,/](?:0x|16#)(?<prefixed>[0-9a-f]{1,2}))?/,
    /(?:[ .,:/]{0,2}(?<last>bit|b|value|wert|v) ?(?<ofLast>-?\d+))?$/,
  ].map(({ source }) => source).join(""));
  const hexadecimal = (number, digits) => number.toString(16).toUpperCase().padStart(digits, "0");
  // The anchors that a whole question may be the address of, the likeliest first: of `6041.b7`, `6510sub7`, `0x6510:07`, `16#6041`, `bit 7 of 6041h`, `24640`, and of
  // `60410010`, which maps an entry. After `:`, a prefix or before `h`, a sub-index is hexadecimal.
  const addressesOf = (text) => {
    const asked = text.trim().replace(/[?.!]$/, "").toLowerCase().split(/\s+/).filter((word) => !stopWords.has(plain(word))).join(" ");
    const entry = (index, sub) => (sub > 0 ? [`${index}.${sub}`] : [index, `${index}.0`]), anchors = [];
    const parts = ADDRESS.exec(asked)?.groups;
    if (parts) {
      const { first, ofFirst, decimal, hex, marked, prefixed, last, ofLast } = parts;
      const of = entry(parts.index.toUpperCase(), decimal === undefined ? parseInt(hex ?? marked ?? prefixed ?? "0", 16) : Number(decimal));
      const number = ofLast ?? ofFirst, kind = (last ?? first)?.[0] === "b" ? "b" : "v";
      if (number !== undefined) anchors.push(...of.map((one) => `${one}.${kind}${number}`));
      anchors.push(...of);
    }
    const mapped = /^\d{9,10}$/.test(asked) ? hexadecimal(Number(asked), 8) : /^(?:0x|16#)?([0-9a-f]{8})h?$/.exec(asked)?.[1].toUpperCase();
    if (mapped?.length === 8) anchors.push(...entry(mapped.slice(0, 4), parseInt(mapped.slice(4, 6), 16)));
    const number = /^\d{4,5}$/.test(asked) ? Number(asked) : 0;
    if (number >= 0x1000 && number <= 0xFFFF) anchors.push(hexadecimal(number, 4));
    return anchors;
  };

  // How many letters have to be put, left out, exchanged or swapped; more than `most` is not counted.
  const distance = (one, other, most) => {
    if (Math.abs(one.length - other.length) > most) return most + 1;
    let older = [], old = Array.from({ length: other.length + 1 }, (_, at) => at);
    for (let row = 1; row <= one.length; row++) {
      const line = [row];
      let least = row;
      for (let at = 1; at <= other.length; at++) {
        const equal = one[row - 1] === other[at - 1];
        let steps = Math.min(old[at] + 1, line[at - 1] + 1, old[at - 1] + (equal ? 0 : 1));
        if (row > 1 && at > 1 && one[row - 1] === other[at - 2] && one[row - 2] === other[at - 1]) steps = Math.min(steps, older[at - 2] + 1);
        line[at] = steps;
        least = Math.min(least, steps);
      }
      if (least > most) return most + 1;
      [older, old] = [old, line];
    }
    return old[other.length];
  };

  // Places (a card's head, a row, a caption) with their words. Each place belongs to a card, whose head is its first place.
  class WordIndex {
    words = [];
    places = [];
    cards = [];
    #numbers = new Map();
    #hits = [];
    #texts = new Map();
    // Phrases that mean the same as others, by their first word.
    #synonyms = new Map();
    // For beginnings of words, all of them in order; for their middles, those that begin with a letter. Both once all are read.
    #sorted = [];
    #lettered = [];

    // Words by what they have in common with other forms of them.
    #forms = new Map();
    // What words weigh in names.
    #weights = [];

    constructor(synonyms) {
      const lists = synonyms.map((phrases) => phrases.map((phrase) => wordsOf(phrase)));
      for (const phrases of lists) {
        for (const words of phrases) {
          const stems = meantOf(words).map(stem);
          const entry = { words, stems, others: phrases.filter((other) => other !== words) };
          this.#synonyms.get(stems[0])?.push(entry) ?? this.#synonyms.set(stems[0], [entry]);
        }
      }
    }

    // Whether a word is anywhere.
    knows(word) {
      return this.#numbers.has(plain(word));
    }

    #number(word) {
      const known = this.#numbers.get(word);
      if (known !== undefined) return known;
      this.#numbers.set(word, this.words.length);
      this.#hits.push([]);
      return this.words.push(word) - 1;
    }

    // A card begins; the places added next are its own.
    card(card) {
      card.first = this.places.length;
      this.cards.push(card);
    }

    // Many cells say the same, so that their words are worked out once. A row is `called` by a fact, and something may be `named` by others than all that counts as its
    // name; `phrases` are names that the page does not show. A place is `worth` less than 1 where others with the same words go before it, or `exact` if it is called
    // like the question.
    place(place, fields, phrases = []) {
      const number = this.places.push(place) - 1;
      const names = (place.named ?? [...fields[NAME], place.called]).filter(Boolean);
      place.names = [...names, ...phrases].map((text) => this.#text(text));
      place.length = place.names[names.length - 1]?.length ?? 0;
      const all = fields.map((texts, at) => (at === NAME ? [...texts, ...phrases] : texts));
      place.fields = all.map((texts, at) => texts.filter(Boolean).map((text) => {
        const list = this.#text(text);
        for (const word of list) {
          const hit = number * 4 + at, hits = this.#hits[word];
          if (hits.at(-1) !== hit) hits.push(hit);
        }
        return list;
      }));
      return place;
    }

    #text(text) {
      let known = this.#texts.get(text);
      if (!known) {
        known = Object.assign(wordsOf(text).map((word) => this.#number(word)), { number: this.#texts.size });
        this.#texts.set(text, known);
      }
      return known;
    }

    #sort() {
      if (this.#sorted.length === this.words.length) return;
      this.#sorted = [...this.words.keys()].sort((one, other) => (this.words[one] < this.words[other] ? -1 : 1));
      this.#lettered = this.#sorted.filter((number) => /^\p{L}/u.test(this.words[number]));
      this.#weights = this.words.map((word, number) => (stopWords.has(word) ? LITTLE : this.#weight(this.#hits[number].length + 1)));
      this.#forms = new Map();
      for (const number of this.#lettered) {
        const form = stem(this.words[number]);
        this.#forms.get(form)?.push(number) ?? this.#forms.set(form, [number]);
      }
    }

    // A search is made of pieces, between which it may be interrupted: each part of it is a generator that says only when, and returns what it found.

    // The numbers of words that begin so or are another form of it, and if wanted those that hold it, with how well they fit.
    *#like(text, parts) {
      const found = new Map(), form = stem(text);
      let from = 0, to = this.#sorted.length;
      while (from < to) {
        const half = (from + to) >> 1;
        if (this.words[this.#sorted[half]] < text) from = half + 1; else to = half;
      }
      for (let count = 1; from < this.#sorted.length && this.words[this.#sorted[from]].startsWith(text); from++, count++) {
        const number = this.#sorted[from];
        if (count % SOME === 0) yield;
        const isWhole = this.words[number].length === text.length;
        // On a large page nearly everything has a word that begins with a given letter.
        if (isWhole || text.length > 1 || this.places.length < MANY_PLACES) found.set(number, isWhole ? SAME : BEGINNING);
      }
      for (const number of this.#forms.get(form) ?? []) if (found.get(number) !== SAME) found.set(number, FORM);
      if (parts && text.length > 2 && !/\d/.test(text)) {
        for (let at = 0; at < this.#lettered.length; at++) {
          const number = this.#lettered[at], word = this.words[number];
          // The end of a compound says what it is: a `Positionsfenster` is a `Fenster`.
          if (word.indexOf(text, 1) > 0 && !found.has(number)) found.set(number, INSIDE);
          if (at % SOME === 0) yield;
        }
      }
      return [...found];
    }

    // Where words follow each other, each in any form; a longer word may replace one of four letters or more (`rates` for `rate`).
    *#phrase(words) {
      const sets = [];
      for (const word of words) sets.push(new Map(word.length > 3 ? yield* this.#like(word, false) : [[this.#numbers.get(word), SAME]]));
      if (sets.some((set) => set.size === 0 || set.has(undefined))) return { sets, hits: [] };
      const count = (set) => [...set.keys()].reduce((sum, word) => sum + this.#hits[word].length, 0);
      const rarest = sets.reduce((one, other) => (count(other) < count(one) ? other : one));
      const hits = new Set();
      let looked = 0;
      for (const word of rarest.keys()) {
        for (const hit of this.#hits[word]) {
          if (++looked % SOME_CARDS === 0) yield;
          const texts = this.places[hit >> 2].fields[hit & 3];
          if (texts.some((list) => list.some((_, at) => sets.every((set, step) => set.has(list[at + step]))))) hits.add(hit);
        }
      }
      return { sets, hits: [...hits] };
    }

    // Everything that a word of the question may mean: itself, one word with its neighbour, two words, synonyms, the parts of a compound.
    *#meanings(words, at) {
      const meanings = [], index = this;
      const single = function* (text, extra, parts) {
        const like = yield* index.#like(text, parts);
        if (like.length > 0) meanings.push({ like, extra });
      };
      const phrase = function* (list, extra) {
        if (list.length === 1) return yield* single(list[0], extra, false);
        const { sets, hits } = yield* index.#phrase(list);
        if (hits.length > 0) meanings.push({ sets, hits, extra });
      };
      const word = words[at];
      yield* single(word, 1, true);
      if (at > 0) yield* single(words[at - 1] + word, 1, false);
      if (at + 1 < words.length) yield* single(word + words[at + 1], 1, false);
      for (let cut = 2; cut < word.length; cut++) {
        const parts = [word.slice(0, cut), word.slice(cut)];
        if ((parts[1].length > 1 || /\d/.test(word)) && parts.every((part) => this.#numbers.has(part))) yield* phrase(parts, 1);
      }
      for (const others of this.#othersAt(words, at)) yield* phrase(others, SYNONYM);
      const compound = yield* this.#compound(word);
      if (compound) meanings.push({ parts: compound, extra: SYNONYM });
      return meanings;
    }

    // What means the same as words of the question of which one is at a place.
    #othersAt(words, at) {
      const forms = words.map(stem), found = [];
      for (let from = Math.max(0, at - MOST_OF_PHRASE); from <= at; from++) {
        for (const { stems, others } of this.#synonyms.get(forms[from]) ?? []) {
          if (from + stems.length > at && stems.every((one, step) => forms[from + step] === one)) found.push(...others);
        }
      }
      return found;
    }

    // The meanings of the parts of a compound, if all of it is made of words that are known by themselves: `Zwischenkreisspannung`. The fewest parts are tried first.
    *#compound(word) {
      if (word.length < 2 * SHORTEST_PART || !/^\p{L}+$/u.test(word)) return null;
      for (const parts of this.#divided(word, MOST_PARTS)) {
        const meanings = [];
        for (const part of parts) {
          const found = [];
          const like = (this.#forms.get(stem(part)) ?? []).map((number) => [number, this.words[number] === part ? SAME : FORM]);
          if (like.length > 0) found.push({ like, extra: 1 });
          for (const others of this.#othersAt([part], 0)) {
            if (others.length === 1) found.push({ like: yield* this.#like(others[0], false), extra: SYNONYM });
            else {
              const { sets, hits } = yield* this.#phrase(others);
              if (hits.length > 0) found.push({ sets, hits, extra: SYNONYM });
            }
          }
          meanings.push(found);
        }
        if (meanings.every((found) => found.length > 0)) return meanings;
      }
      return null;
    }

    // The ways to divide a word into words that are known, with what may join two of them.
    #divided(word, most) {
      const ways = [], isKnown = (part) => this.#forms.has(stem(part)) || this.#synonyms.has(stem(part));
      for (let cut = SHORTEST_PART; cut <= word.length - SHORTEST_PART; cut++) {
        const head = word.slice(0, cut), rest = word.slice(cut);
        const before = [head, ...JOINTS.filter((joint) => head.endsWith(joint)).map((joint) => head.slice(0, -joint.length))].find((one) => one.length >= SHORTEST_PART && isKnown(one));
        if (before === undefined) continue;
        if (isKnown(rest)) ways.push([before, rest]);
        else if (most > 2) for (const more of this.#divided(rest, most - 1)) ways.push([before, ...more]);
      }
      return ways.sort((one, other) => one.length - other.length);
    }

    // The same for a word that is written wrongly; numbers are not guessed.
    *#similar(word) {
      if (word.length < 4 || /\d/.test(word)) return [];
      const most = word.length > 7 ? 2 : 1;
      let least = most, near = [];
      const known = [...this.#synonyms.values()].flat().flatMap(({ words }) => (words.length === 1 ? words : []));
      let looked = 0;
      for (const other of new Set([...this.#lettered.map((number) => this.words[number]), ...known])) {
        if (++looked % SOME_CARDS === 0) yield;
        if (other.length < 3 || Math.abs(other.length - word.length) > least || /\d/.test(other)) continue;
        const steps = distance(word, other, least);
        if (steps < least) [least, near] = [steps, [other]];
        else if (steps === least) near.push(other);
      }
      const meanings = [];
      for (const other of near) meanings.push(...yield* this.#meanings([other], 0));
      return meanings.map((meaning) => ({
        ...meaning, like: meaning.like?.filter(([, grade]) => grade === SAME), extra: meaning.extra * SIMILAR,
      }));
    }

    // How much each place has of one word of the question, up to FULL.
    *#gains(meanings) {
      const gains = new Uint8Array(this.places.length);
      let looked = 0;
      for (const { like, hits, parts, extra } of meanings) {
        if (parts) {
          const ofParts = [];
          for (const part of parts) ofParts.push((yield* this.#gains(part)));
          for (let at = 0; at < gains.length; at++) {
            let least = FULL;
            for (const gain of ofParts) if (gain[at] < least) least = gain[at];
            if (least * extra > gains[at]) gains[at] = least * extra;
            if (++looked % SOME === 0) yield;
          }
          continue;
        }
        for (const [list, grade] of hits ? [[hits, SAME]] : like.map(([word, fit]) => [this.#hits[word], fit])) {
          const most = FULL * GRADE[grade] * extra;
          for (const hit of list) {
            const gain = most * WORTH[hit & 3];
            if (gain > gains[hit >> 2]) gains[hit >> 2] = gain;
            if (++looked % SOME === 0) yield;
          }
        }
      }
      return gains;
    }

    // All cards that have every word: the best first. Where none has all, those that have most. `allowed` says which places count.
    *search(text, allowed) {
      const all = wordsOf(text);
      if (all.length === 0) return null;
      this.#sort();
      const asked = meantOf(all), meanings = [], unknown = [];
      let isSimilar = false;
      for (const at of asked.keys()) {
        let found = yield* this.#meanings(asked, at);
        if (found.length === 0) {
          found = yield* this.#similar(asked[at]);
          if (found.length > 0) isSimilar = true;
        }
        if (found.length > 0) meanings.push(found); else unknown.push(asked[at]);
      }
      const stops = new Set(all.filter((word) => !asked.includes(word)).map((word) => this.#numbers.get(word)));
      const found = yield* this.#rank(stops, meanings, allowed);
      return {
        ...found, unknown, similar: isSimilar && found.cards.length > 0, partial: found.cards.length > 0 && found.cards[0].missing, meanings: meanings.flat(),
      };
    }

    // What the head of a card gives to its places; its texts count only there.
    #ofCard(gain, head) {
      return gain[head] > FULL * WORTH[TEXT] ? gain[head] * OF_CARD : 0;
    }

    // What a place has of the question, as a part of 1; below 0 if nothing of its own fits. A row is also found by the name of its card.
    #sum({ gains, weights, all }, at, first) {
      let sum = 0, fits = false;
      this.#isMissing = false;
      for (let word = 0; word < gains.length; word++) {
        const own = gains[word][at], gain = Math.max(own, this.#ofCard(gains[word], first));
        if (own > 0) fits = true;
        if (gain === 0) this.#isMissing = true;
        sum += gain * weights[word];
      }
      return fits ? sum / all : -1;
    }
    #isMissing = false;

    #end(card) {
      return this.cards[card + 1]?.first ?? this.places.length;
    }

    // How much a word of the page says: the rarer, the more.
    #weight(having) {
      return Math.log2(1 + this.places.length / having);
    }

    *#rank(stops, meanings, allowed) {
      const gains = [], weights = [], kinds = new Map(), cards = [];
      for (const list of meanings) {
        const gain = yield* this.#gains(list);
        let having = 1;
        for (let at = 0; at < gain.length; at++) {
          if (allowed && !allowed(this.places[at])) gain[at] = 0;
          if (gain[at] > 0) having += 1;
          if (at % SOME === 0) yield;
        }
        weights.push(this.#weight(having));
        gains.push(gain);
      }
      const of = { gains, weights, all: FULL * weights.reduce((sum, one) => sum + one, 0), fits: meanings.map(WordIndex.#fits), stops, compared: new Array(this.#texts.size) };
      // A card can have ten thousand places, so that these are counted, too.
      let looked = 0, bestOfAll = 0;
      for (let number = 0; number < this.cards.length; number++) {
        if (number % SOME_CARDS === 0) yield;
        const { first } = this.cards[number], end = this.#end(number);
        let best = -1, score = 0, missing = false;
        for (let at = first; at < end; at++) {
          const sum = this.#sum(of, at, first);
          if (++looked % SOME === 0) yield;
          if (sum < 0) continue;
          const isMissing = this.#isMissing, place = this.places[at];
          if (!isMissing) kinds.set(place.kind, (kinds.get(place.kind) ?? 0) + 1);
          const most = sum * (isMissing ? PARTLY : 1), { worth = 1, exact = worth } = place;
          if (most * exact <= score) continue;
          const near = this.#nearness(place, of, at === first ? -1 : first);
          const own = most * (near > EXACT ? exact : worth) * (1 - NEARNESS + NEARNESS * near);
          if (own > score) [best, score, missing] = [at, own, isMissing];
        }
        if (best < 0) continue;
        cards.push({ number, at: best, score: Math.round(score * STEPS), missing });
        bestOfAll = Math.max(bestOfAll, cards.at(-1).score);
      }
      yield;
      const chosen = cards.filter(({ score, missing }) => !missing || score > AS_GOOD * bestOfAll);
      yield;
      const ordered = this.#ordered(chosen);
      yield;
      return { of, kinds, cards: ordered };
    }

    // How well words of the page fit a word of the question. Of a phrase that means the same, and of the parts of a compound, a name has to have all.
    static #fits(meanings) {
      const words = new Map(), phrases = [];
      for (const { like, sets, parts, extra } of meanings) {
        for (const [word, grade] of like ?? []) words.set(word, Math.max(words.get(word) ?? 0, GRADE[grade] * extra));
        if (sets) phrases.push({ sets, extra });
        if (parts) phrases.push({ sets: parts.map(WordIndex.#anyOf), extra });
      }
      return { words, phrases };
    }

    static #anyOf(meanings) {
      const { words, phrases } = WordIndex.#fits(meanings);
      return new Set([...words.keys(), ...phrases.flatMap(({ sets }) => sets.flatMap((set) => [...set.keys()]))]);
    }

    // How much of a name is asked for, and how much it has of each word of the question, and of its stop words. This is done for every name of a page.
    #compared(name, { fits, stops }) {
      const asked = this.#asked, had = [];
      let whole = 0, part = 0, stopped = 0;
      for (let at = 0; at < name.length; at++) {
        asked[at] = stops.has(name[at]) ? 1 : 0;
        stopped += asked[at];
      }
      for (const { words, phrases } of fits) {
        let most = 0;
        for (let at = 0; at < name.length; at++) {
          const fit = words.get(name[at]) ?? 0;
          if (fit > most) most = fit;
          if (fit > asked[at]) asked[at] = fit;
        }
        for (const { sets, extra } of phrases) {
          if (!sets.every((set) => name.some((word) => set.has(word)))) continue;
          if (extra > most) most = extra;
          for (let at = 0; at < name.length; at++) if (extra > asked[at] && sets.some((set) => set.has(name[at]))) asked[at] = extra;
        }
        had.push(most);
      }
      for (let at = 0; at < name.length; at++) {
        const weight = this.#weights[name[at]];
        whole += weight;
        part += weight * asked[at];
      }
      return part > 0 ? { asked: part / whole, had, stops: stopped } : NOTHING;
    }
    #asked = [];

    // How near what a place is called is to the question: 1 if both have the same words. A row is called like its card, too.
    #nearness(place, of, head) {
      let nearest = 0;
      const { compared, gains, weights, all } = of;
      for (const name of place.names) {
        const own = compared[name.number] ??= this.#compared(name, of);
        if (own.asked === 0) continue;
        let had = LITTLE * own.stops;
        for (let word = 0; word < weights.length; word++) had += weights[word] * Math.max(own.had[word], this.#ofCard(gains[word], head) / FULL);
        had *= FULL / all;
        nearest = Math.max(nearest, 2 * own.asked * had / (own.asked + had));
      }
      return nearest;
    }

    // Only as many as a reader looks at have to be in order at once.
    #ordered(cards) {
      // Of equals, the one with the plainer name, then the one that more depends on.
      const length = ({ number }) => this.places[this.cards[number].first].length;
      const uses = ({ number }) => this.cards[number].uses ?? 0;
      const order = (one, other) => other.score - one.score || length(one) - length(other) || uses(other) - uses(one) || one.number - other.number;
      if (cards.length <= READ_AT_ONCE) return cards.sort(order);
      const last = Uint32Array.from(cards, ({ score }) => score).sort().at(-READ_AT_ONCE);
      const before = cards.filter(({ score }) => score > last).sort(order), equal = cards.filter(({ score }) => score === last);
      return [...before, ...(equal.length <= READ_AT_ONCE ? equal.sort(order) : equal), ...cards.filter(({ score }) => score < last)];
    }

    // The places of a card that answer the whole question, or else those that have most of it.
    placesOf({ number }, { of }) {
      const { first } = this.cards[number], complete = [];
      let most = 0, places = [];
      for (let at = first; at < this.#end(number); at++) {
        const sum = this.#sum(of, at, first);
        if (sum < 0) continue;
        if (!this.#isMissing) complete.push(at);
        if (sum > most) [most, places] = [sum, []];
        if (sum === most) places.push(at);
      }
      return complete.length > 0 ? complete : places;
    }

    // The pieces of a text that the question means: pairs of beginning and end.
    marks(text, meanings) {
      const pieces = [], list = [];
      for (const found of text.matchAll(WORD)) {
        const word = this.#numbers.get(plain(found[0]));
        if (meanings.single.has(word)) pieces.push([found.index, found.index + found[0].length]);
        list.push([word, found.index, found.index + found[0].length]);
      }
      for (const sets of meanings.phrases) {
        for (let at = 0; at + sets.length <= list.length; at++) {
          if (sets.every((set, step) => set.has(list[at + step][0]))) pieces.push([list[at][1], list[at + sets.length - 1][2]]);
        }
      }
      return pieces.sort(([one], [other]) => one - other);
    }

    // The words of a question as `marks` takes them.
    static marked(meanings) {
      const all = meanings.flatMap((one) => [one, ...(one.parts ?? []).flat()]);
      return {
        single: new Set(all.flatMap(({ like }) => (like ?? []).map(([word]) => word))),
        phrases: all.flatMap(({ sets }) => (sets ? [sets] : [])),
      };
    }
  }
