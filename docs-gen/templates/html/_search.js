  // ---- Words: what is compared when a reader looks for something. This part knows nothing about the page.

  // What a hit is worth by where it is (less is better), and what is added for the beginning and the middle of a word.
  const NAME = 0, FACT = 1, TEXT = 2, ERRATUM = 3;
  const COST = [0, 2, 5, 8], GRADE = [0, 1, 16], NEVER = 255;
  const SYNONYM = 1, SIMILAR = 4, SCATTERED = 24, READ_AT_ONCE = 200, MANY_PLACES = 20000;
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
    #synonyms = [];
    // For beginnings of words, all of them in order; for their middles, those that begin with a letter. Both once all are read.
    #sorted = [];
    #lettered = [];

    constructor(synonyms) {
      const lists = synonyms.map((phrases) => phrases.map((phrase) => wordsOf(phrase)));
      for (const phrases of lists) {
        for (const words of phrases) this.#synonyms.push({ words, others: phrases.filter((other) => other !== words) });
      }
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

    // Many cells say the same, so that their words are worked out once.
    place(place, fields) {
      const number = this.places.push(place) - 1;
      place.names = fields[NAME].filter(Boolean).map((text) => this.#name(text));
      place.fields = fields.map((texts, field) => texts.filter(Boolean).map((text) => {
        let list = this.#texts.get(text);
        if (!list) this.#texts.set(text, list = wordsOf(text).map((word) => this.#number(word)));
        for (const word of list) {
          const hit = number * 4 + field, hits = this.#hits[word];
          if (hits.at(-1) !== hit) hits.push(hit);
        }
        return list;
      }));
      return place;
    }

    // A name without spaces, and how many words it has.
    #name(text) {
      let name = this.#names.get(text);
      if (!name) {
        const words = wordsOf(text);
        this.#names.set(text, name = { name: words.join(""), length: words.length });
      }
      return name;
    }

    #sort() {
      if (this.#sorted.length === this.words.length) return;
      this.#sorted = [...this.words.keys()].sort((one, other) => (this.words[one] < this.words[other] ? -1 : 1));
      this.#lettered = this.#sorted.filter((number) => /^\p{L}/u.test(this.words[number]));
    }

    // A search is made of pieces, between which it may be interrupted: each part of it is a generator that says only when, and returns what it found.

    // The numbers of words that begin so, and if wanted those that hold it, with how well they fit.
    *#like(text, middle) {
      const found = [];
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
        if (isWhole || text.length > 1 || this.places.length < MANY_PLACES) found.push([number, isWhole ? 0 : 1]);
      }
      if (middle && text.length > 2 && !/\d/.test(text)) {
        for (let at = 0; at < this.#lettered.length; at++) {
          const number = this.#lettered[at], word = this.words[number];
          if (word.indexOf(text, 1) > 0 && !word.startsWith(text)) found.push([number, 2]);
          if (at % SOME === 0) yield;
        }
      }
      return found;
    }

    // Where words follow each other; a longer word may replace one of four letters or more (`rates` for `rate`).
    *#phrase(words) {
      const sets = [];
      for (const word of words) sets.push(new Map(word.length > 3 ? yield* this.#like(word, false) : [[this.#numbers.get(word), 0]]));
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

    // Everything that a word of the question may mean: itself, one word with its neighbour, two words, synonyms.
    *#meanings(words, at) {
      const meanings = [], index = this;
      const single = function* (text, extra, middle) {
        const like = yield* index.#like(text, middle);
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
      for (const { words: known, others } of this.#synonyms) {
        for (let from = Math.max(0, at - known.length + 1); from <= at; from++) {
          if (known.every((one, step) => words[from + step] === one)) for (const other of others) yield* phrase(other, SYNONYM);
        }
      }
      return meanings;
    }

    // The same for a word that is written wrongly; numbers are not guessed.
    *#similar(word) {
      if (word.length < 4 || /\d/.test(word)) return [];
      const most = word.length > 7 ? 2 : 1;
      let least = most, near = [];
      const known = this.#synonyms.flatMap(({ words }) => (words.length === 1 ? words : []));
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
        ...meaning, like: meaning.like?.filter(([, grade]) => grade === 0), extra: meaning.extra + SIMILAR,
      }));
    }

    // What each place costs for one word of the question.
    *#costs(meanings) {
      const costs = new Uint8Array(this.places.length).fill(NEVER);
      let looked = 0;
      for (const { like, hits, extra } of meanings) {
        for (const [list, grade] of hits ? [[hits, 0]] : like.map(([word, fit]) => [this.#hits[word], GRADE[fit]])) {
          for (const hit of list) {
            const cost = COST[hit & 3] + grade + extra;
            if (cost < costs[hit >> 2]) costs[hit >> 2] = cost;
            if (++looked % SOME === 0) yield;
          }
        }
      }
      return costs;
    }

    // All cards that have every word: the best first. `allowed` says which places count.
    *search(text, allowed) {
      const words = wordsOf(text);
      if (words.length === 0) return null;
      this.#sort();
      const meanings = [];
      for (const at of words.keys()) meanings.push(yield* this.#meanings(words, at));
      let found = yield* this.#rank(words, meanings, allowed);
      const similar = found.cards.length === 0;
      if (similar) {
        for (const [at, word] of words.entries()) meanings[at].push(...yield* this.#similar(word));
        found = yield* this.#rank(words, meanings, allowed);
      }
      return { ...found, similar: similar && found.cards.length > 0, meanings: meanings.flat() };
    }

    // What a place costs for the whole question. A row is also found by the name of its card, if something of its own fits.
    #sum(costs, at, first) {
      let sum = 0, fits = false;
      for (const cost of costs) {
        const ofPlace = cost[at], ofCard = cost[first];
        if (ofPlace < NEVER) fits = true;
        const less = ofCard < COST[TEXT] && ofCard < ofPlace ? ofCard : ofPlace;
        if (less === NEVER) return -1;
        sum += less;
      }
      return fits ? sum : -1;
    }

    #end(card) {
      return this.cards[card + 1]?.first ?? this.places.length;
    }

    *#rank(words, meanings, allowed) {
      const costs = [], whole = words.join("");
      for (const list of meanings) costs.push(yield* this.#costs(list));
      for (let at = 0; allowed && at < this.places.length; at++) {
        if (!allowed(this.places[at])) for (const cost of costs) cost[at] = NEVER;
        if (at % SOME === 0) yield;
      }
      const cards = [], kinds = new Map();
      // A card can have ten thousand places, so that these are counted, too.
      let looked = 0;
      for (let number = 0; number < this.cards.length; number++) {
        if (number % SOME_CARDS === 0) yield;
        const { first } = this.cards[number], end = this.#end(number);
        let best = -1, least = Infinity, rank = Infinity;
        for (let at = first; at < end; at++) {
          const sum = this.#sum(costs, at, first);
          if (++looked % SOME === 0) yield;
          if (sum < 0) continue;
          const { kind } = this.places[at];
          kinds.set(kind, (kinds.get(kind) ?? 0) + 1);
          if (sum > least) continue;
          const ranked = sum * 64 + this.#near(this.places[at], whole) + (at === first ? 0 : 1);
          if (ranked < rank) [best, least, rank] = [at, sum, ranked];
        }
        if (best < 0 && costs.length > 1) [best, rank] = this.#scattered(costs, first, end);
        if (best >= 0) cards.push({ number, at: best, rank });
      }
      yield;
      const ordered = this.#ordered(cards);
      yield;
      return { costs, kinds, cards: ordered };
    }

    // A card that has all words, but no place of it: after the others, and shown where most of them are.
    #scattered(costs, first, end) {
      let best = -1, most = 0, rank = SCATTERED * 64;
      for (const cost of costs) {
        let least = NEVER;
        for (let at = first; at < end; at++) if (cost[at] < least) least = cost[at];
        if (least === NEVER) return [-1, 0];
        rank += least * 64;
      }
      for (let at = first; at < end; at++) {
        const count = costs.filter((cost) => cost[at] < NEVER).length;
        if (count > most) [best, most] = [at, count];
      }
      return [best, rank];
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

    // The places of a card that answer the whole question, or else those that have a word of it.
    placesOf({ number }, { costs }) {
      const { first } = this.cards[number], whole = [], some = [];
      for (let at = first; at < this.#end(number); at++) {
        if (this.#sum(costs, at, first) >= 0) whole.push(at);
        else if (costs.some((cost) => cost[at] < NEVER)) some.push(at);
      }
      return whole.length > 0 ? whole : some;
    }

    // How near a name is to the question, as a number below 64: the same, begins so, holds it; what is put last (`later`) is.
    #near(place, whole) {
      let near = 50;
      for (let at = 0; at < place.names.length; at++) {
        const { name, length } = place.names[at];
        if (name.length < whole.length || !name.includes(whole)) continue;
        const far = name.length === whole.length ? 0 : (name.startsWith(whole) ? 10 : 30) + Math.min(length, 7);
        if (far < near) near = far;
      }
      return near + (place.later ? 5 : 0);
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
      return {
        single: new Set(meanings.flatMap(({ like }) => (like ?? []).map(([word]) => word))),
        phrases: meanings.flatMap(({ sets }) => (sets ? [sets] : [])),
      };
    }
  }
