  // ---- Words: what is compared when a reader looks for something. This part knows nothing about the page.

  // What a hit is worth by where it is (less is better), and what is added for a longer text.
  const NAME = 0, FACT = 1, TEXT = 2, ERRATUM = 3;
  const COST = [0, 2, 5, 20], PER_LENGTH = [0, 1, 1, 1], NEVER = 255;
  // What is added by how a word fits: the same, another form of it, its beginning, its end, its middle.
  const SAME = 0, FORM = 1, BEGINNING = 2, END = 3, MIDDLE = 4;
  const GRADE = [0, 1, 3, 4, 16];
  const SYNONYM = 1, COMPOUND = 1, SIMILAR = 4, SCATTERED = 24, SOUGHT = 1, PARTLY = 20, ENOUGH = 8, HOLDS = 30, LATER = 5, READ_AT_ONCE = 200, MANY_PLACES = 8000;
  // What a word costs that a place does not have, at least and for each halving of the places that have it; how much worse than the best such a place may be.
  const MISSING = 28, PER_HALF = 4, MOST_MISSING = 64, NOUN = 12, AS_GOOD = 12;
  // A text of more words than this is a long one; a synonym has at most so many words after its first.
  const LONG = 12, MOST_OF_PHRASE = 5;
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
    #names = new Map();
    // Phrases that mean the same as others, by their first word.
    #synonyms = new Map();
    // For beginnings of words, all of them in order; for their middles, those that begin with a letter. Both once all are read.
    #sorted = [];
    #lettered = [];

    // Words by what they have in common with other forms of them.
    #forms = new Map();

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

    // Many cells say the same, so that their words are worked out once. A row is `called` by a fact, and something may be `named` by less than all that counts as its
    // name; `phrases` are names that the page does not show.
    place(place, fields, phrases = [], field = NAME) {
      const number = this.places.push(place) - 1;
      place.names = (place.named ?? [...fields[NAME], place.called]).filter(Boolean).map((text) => this.#name(text));
      place.phrases = phrases.map((text) => this.#name(text));
      const all = fields.map((texts, at) => (at === field ? [...texts, ...phrases] : texts));
      place.fields = all.map((texts, at) => texts.filter(Boolean).map((text) => {
        const { list, isLong } = this.#text(text);
        for (const word of list) {
          const hit = number * 8 + isLong * 4 + at, hits = this.#hits[word];
          if (hits.at(-1) !== hit) hits.push(hit);
        }
        return list;
      }));
      return place;
    }

    #text(text) {
      let known = this.#texts.get(text);
      if (!known) {
        const list = wordsOf(text).map((word) => this.#number(word));
        this.#texts.set(text, known = { list, isLong: list.length > LONG ? 1 : 0 });
      }
      return known;
    }

    // A name without spaces, and its words.
    #name(text) {
      let name = this.#names.get(text);
      if (!name) {
        const words = wordsOf(text);
        const meant = meantOf(words), numbers = (list) => list.map((word) => this.#number(word));
        this.#names.set(text, name = { name: words.join(""), meant: meant.join(""), parts: numbers(meant), words: numbers(words), length: words.length });
      }
      return name;
    }

    #sort() {
      if (this.#sorted.length === this.words.length) return;
      this.#sorted = [...this.words.keys()].sort((one, other) => (this.words[one] < this.words[other] ? -1 : 1));
      this.#lettered = this.#sorted.filter((number) => /^\p{L}/u.test(this.words[number]));
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
          if (word.indexOf(text, 1) > 0 && !found.has(number)) found.set(number, text.length > 3 && word.endsWith(text) ? END : MIDDLE);
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
          const texts = this.places[hit >> 3].fields[hit & 3];
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
      yield* single(word, 0, true);
      if (at > 0) yield* single(words[at - 1] + word, 0, false);
      if (at + 1 < words.length) yield* single(word + words[at + 1], 0, false);
      for (let cut = 2; cut < word.length; cut++) {
        const parts = [word.slice(0, cut), word.slice(cut)];
        if ((parts[1].length > 1 || /\d/.test(parts[1])) && parts.every((part) => this.#numbers.has(part))) yield* phrase(parts, 0);
      }
      for (const others of this.#othersAt(words, at)) yield* phrase(others, SYNONYM);
      const compound = yield* this.#compound(word);
      if (compound) meanings.push({ parts: compound, extra: COMPOUND });
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
          if (like.length > 0) found.push({ like, extra: 0 });
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

    // For a word that is unknown as a whole, its longest beginning or end that is not.
    #partOf(word) {
      if (!/^\p{L}+$/u.test(word)) return [];
      for (let length = word.length - 2; length > SHORTEST_PART; length--) {
        for (const part of [word.slice(-length), word.slice(0, length)]) {
          const like = (this.#forms.get(stem(part)) ?? []).map((number) => [number, FORM]);
          if (like.length > 0) return [{ like, extra: SIMILAR }];
        }
      }
      return [];
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
        ...meaning, like: meaning.like?.filter(([, grade]) => grade === SAME), extra: meaning.extra + SIMILAR,
      }));
    }

    // What each place costs for one word of the question, and how many places have it.
    *#costs(meanings) {
      const costs = new Uint8Array(this.places.length).fill(NEVER);
      let looked = 0;
      for (const { like, hits, parts, extra } of meanings) {
        if (parts) {
          const ofParts = [];
          for (const part of parts) ofParts.push((yield* this.#costs(part)));
          for (let at = 0; at < costs.length; at++) {
            let sum = extra;
            for (const cost of ofParts) sum += cost[at];
            if (sum < costs[at]) costs[at] = sum;
            if (++looked % SOME === 0) yield;
          }
          continue;
        }
        for (const [list, grade] of hits ? [[hits, SAME]] : like.map(([word, fit]) => [this.#hits[word], fit])) {
          for (const hit of list) {
            const cost = COST[hit & 3] + (hit & 4 ? PER_LENGTH[hit & 3] : 0) + GRADE[grade] + extra;
            if (cost < costs[hit >> 3]) costs[hit >> 3] = cost;
            if (++looked % SOME === 0) yield;
          }
        }
      }
      return costs;
    }

    // All cards that have every word: the best first. Where none has all, those that have most. `allowed` says which places count.
    *search(text, allowed) {
      const all = wordsOf(text);
      if (all.length === 0) return null;
      this.#sort();
      const asked = meantOf(all), words = [], meanings = [], unknown = [];
      // Of a German question, nouns are what it is about.
      const nouns = new Set((text.match(WORD) ?? []).filter((word) => /^\p{Lu}\p{Ll}/u.test(word)).map(plain));
      let isSimilar = false;
      for (const at of asked.keys()) {
        let found = yield* this.#meanings(asked, at);
        if (found.length === 0) {
          found = yield* this.#similar(asked[at]);
          if (found.length > 0) isSimilar = true;
        }
        if (found.length === 0) {
          found = this.#partOf(asked[at]);
          if (found.length > 0) isSimilar = true;
        }
        if (found.length > 0) { words.push(asked[at]); meanings.push(found); } else unknown.push(asked[at]);
      }
      const whole = [all.join(""), asked.join(""), asked];
      const heavy = words.map((word) => (nouns.has(word) ? NOUN : 0));
      let found = yield* this.#rank(whole, words, heavy, meanings, allowed);
      if (!found.cards.some(({ missing }) => missing === 0)) {
        const more = [];
        for (const [at, word] of words.entries()) more.push([...meanings[at], ...yield* this.#similar(word)]);
        const similar = yield* this.#rank(whole, words, heavy, more, allowed);
        if (similar.cards.some(({ missing }) => missing === 0)) {
          found = similar;
          isSimilar = true;
          meanings.splice(0, meanings.length, ...more);
        }
      }
      return {
        ...found, unknown, similar: isSimilar && found.cards.length > 0, partial: found.cards.length > 0 && found.cards[0].missing > 0, meanings: meanings.flat(),
      };
    }

    // What a place costs for the whole question, and what of that is for words that it does not have. A row is also found by the name of its card, if something of its
    // own fits.
    #sum(costs, weights, at, first) {
      let sum = 0, missing = 0, fits = false;
      for (let word = 0; word < costs.length; word++) {
        const ofPlace = costs[word][at], ofCard = costs[word][first];
        if (ofPlace < NEVER) fits = true;
        const less = ofCard < COST[TEXT] && ofCard < ofPlace ? ofCard : ofPlace;
        if (less === NEVER) missing += weights[word]; else sum += less;
      }
      this.#missing = missing;
      return fits ? sum + missing : -1;
    }
    #missing = 0;

    #end(card) {
      return this.cards[card + 1]?.first ?? this.places.length;
    }

    *#rank(whole, words, heavy, meanings, allowed) {
      const costs = [], weights = [];
      for (const list of meanings) {
        const cost = yield* this.#costs(list);
        let having = 1;
        for (let at = 0; at < cost.length; at++) {
          if (allowed && !allowed(this.places[at])) cost[at] = NEVER;
          if (cost[at] < NEVER) having += 1;
          if (at % SOME === 0) yield;
        }
        costs.push(cost);
        weights.push(heavy[weights.length] + Math.min(MOST_MISSING, MISSING + Math.floor(PER_HALF * Math.log2(this.places.length / having))));
      }
      const asked = meanings.map((list) => new Set(list.flatMap(({ like }) => (like ?? []).flatMap(([word, fit]) => (fit <= BEGINNING ? [word] : [])))));
      const cards = [], kinds = new Map();
      // A card can have ten thousand places, so that these are counted, too.
      let looked = 0;
      for (let number = 0; number < this.cards.length; number++) {
        if (number % SOME_CARDS === 0) yield;
        const { first } = this.cards[number], end = this.#end(number);
        let best = -1, least = Infinity, rank = Infinity, missing = 0;
        for (let at = first; at < end; at++) {
          const sum = this.#sum(costs, weights, at, first);
          if (++looked % SOME === 0) yield;
          if (sum < 0) continue;
          if (this.#missing === 0) {
            const { kind } = this.places[at];
            kinds.set(kind, (kinds.get(kind) ?? 0) + 1);
          }
          const place = this.places[at];
          if (sum > least && place.phrases.length === 0) continue;
          const lacks = this.#missing;
          let near = this.#near(place, whole, asked);
          // Of those that lack a word, the one that is called like the rest.
          if (lacks > 0) {
            const rest = words.filter((_, word) => costs[word][at] < NEVER || costs[word][first] < COST[TEXT]).join("");
            if ([...place.names, ...place.phrases].some(({ name, meant }) => name === rest || meant === rest)) near = 9;
          }
          const isPartly = lacks > 0 && place.phrases.some((one) => this.#holds(one, asked));
          if (isPartly) near = Math.min(near, PARTLY);
          // What is looked for by exactly these words is what they mean; the name of an error is worth that of an object, if the question begins it or has its code, and
          // so is that of a PDO which has the rest; what is looked for by some of the words is nearly as good.
          const isSought = near === SOUGHT || near === SOUGHT + LATER, isPdo = place.kind === "pdo" && near <= HOLDS && lacks === 0;
          const isNamed = isPdo || (place.kind === "error" && near < HOLDS), most = isNamed ? SYNONYM : isPartly ? ENOUGH : Infinity;
          const counted = isSought || isPdo ? 0 : Math.min(sum, most), ranked = counted * 64 + near + (at === first ? 0 : 1);
          if (ranked < rank) [best, least, rank, missing] = [at, counted, ranked, isSought ? 0 : lacks];
        }
        if (missing > 0 && costs.length > 1) {
          const scattered = this.#scattered(costs, first, end);
          if (scattered && scattered.rank < rank) [best, rank, missing] = [scattered.at, scattered.rank, 0];
        }
        if (best >= 0) cards.push({ number, at: best, rank, missing });
      }
      yield;
      const chosen = this.#chosen(cards);
      yield;
      const ordered = this.#ordered(chosen);
      yield;
      return { costs, weights, kinds, cards: ordered };
    }

    // Those that have all words, and those without that are better all the same; where none has all, those that are nearly as good as the best.
    #chosen(cards) {
      let best = Infinity, bestOfAll = Infinity;
      for (const { rank, missing } of cards) {
        if (missing === 0 && rank < best) best = rank;
        if (rank < bestOfAll) bestOfAll = rank;
      }
      const limit = best === Infinity ? bestOfAll + AS_GOOD * 64 : best;
      return cards.filter(({ rank, missing }) => missing === 0 || rank < limit);
    }

    // A card that has all words, but no place of it: after the others, and shown where most of them are.
    #scattered(costs, first, end) {
      let at = -1, most = 0, rank = SCATTERED * 64;
      for (const cost of costs) {
        let least = NEVER;
        for (let one = first; one < end; one++) if (cost[one] < least) least = cost[one];
        if (least === NEVER) return null;
        rank += least * 64;
      }
      for (let one = first; one < end; one++) {
        let count = 0;
        for (const cost of costs) if (cost[one] < NEVER) count += 1;
        if (count > most) [at, most] = [one, count];
      }
      return { at, rank };
    }

    // Only as many as a reader looks at have to be in order at once.
    #ordered(cards) {
      // Of equals, the one with the plainer name, then the one that more depends on.
      const words = ({ number }) => this.places[this.cards[number].first].names.at(-1)?.length ?? 0;
      const uses = ({ number }) => this.cards[number].uses ?? 0;
      const order = (one, other) => one.rank - other.rank || words(one) - words(other) || uses(other) - uses(one) || one.number - other.number;
      if (cards.length <= READ_AT_ONCE) return cards.sort(order);
      const last = Uint32Array.from(cards, ({ rank }) => rank).sort()[READ_AT_ONCE];
      const before = cards.filter(({ rank }) => rank < last).sort(order), equal = cards.filter(({ rank }) => rank === last);
      return [...before, ...(equal.length <= READ_AT_ONCE ? equal.sort(order) : equal), ...cards.filter(({ rank }) => rank > last)];
    }

    // The places of a card that answer the whole question, or else those that have most of it.
    placesOf({ number }, { costs, weights }) {
      const { first } = this.cards[number];
      let least = Infinity, places = [];
      for (let at = first; at < this.#end(number); at++) {
        if (this.#sum(costs, weights, at, first) < 0 || this.#missing > least) continue;
        if (this.#missing < least) [least, places] = [this.#missing, []];
        places.push(at);
      }
      return places;
    }

    // Whether the question has all words of a phrase of several.
    #holds({ parts }, asked) {
      return parts.length > 1 && parts.every((word) => asked.some((set) => set.has(word)));
    }

    // How near a name is to the question, as a number below 64: the same, begins so, holds it, has all its words; what is put last (`later`) is.
    #near(place, [whole, meant, words], asked) {
      let near = 50;
      const far = ({ words, length }) => (asked.every((set) => words.some((word) => set.has(word))) ? 38 + Math.min(length, 7) : 50);
      for (const one of place.names) {
        let own = one.name === whole ? 0 : far(one);
        if (own > HOLDS && one.length > 1 && whole.includes(one.name)) own = HOLDS;
        if (own > 0 && one.name.includes(whole)) own = (one.name.startsWith(whole) ? 10 : HOLDS) + Math.min(one.length, 7);
        near = Math.min(near, own);
      }
      // The code of an error is a name, too, and no other place is meant by it.
      if (place.kind === "error" && place.code !== undefined && words.includes(place.code)) near = Math.min(near, HOLDS - 1);
      for (const one of place.phrases) {
        near = Math.min(near, one.meant === meant ? SOUGHT : far(one));
      }
      return near + (place.later ? LATER : 0);
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
