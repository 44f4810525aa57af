"use strict";
(() => {
{% include "_words.js" %}
{% include "_search.js" %}

  const byId = (id) => document.getElementById(id);
  const root = document.documentElement, search = byId("ui_search"), count = byId("ui_count"), contents = byId("ui_contents"), main = byId("ui_content");
  const element = (name, text = "") => Object.assign(document.createElement(name), { textContent: text });
  const show = (one, shown) => one?.classList.toggle("off", !shown);
  // Without the script none of the tools would do anything.
  document.querySelector(".tools").hidden = false;

  // Light or dark: as the system says, until the button is used.
  const remember = (theme) => { try { localStorage.setItem("od-theme", theme); } catch { /* not from file:// everywhere */ } };
  try { const theme = localStorage.getItem("od-theme"); if (theme) root.dataset.theme = theme; } catch { /* the same */ }
  byId("ui_theme").addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    remember(root.dataset.theme);
  });

  // Where the printed manual says something else is shown only when asked for, and to a reader who searches. Without the script it is shown.
  const compare = byId("ui_errata");
  const showErrata = (shown) => {
    root.classList.toggle("unmarked", !shown);
    compare.setAttribute("aria-pressed", shown);
  };
  if (compare) {
    let shown = false;
    try { shown = localStorage.getItem("od-errata") === "shown"; } catch { /* the same */ }
    showErrata(shown);
    document.addEventListener("click", (event) => {
      const button = event.target.closest?.("#ui_errata, .hint");
      if (!button) return;
      const shows = root.classList.contains("unmarked");
      showErrata(shows);
      try { localStorage.setItem("od-errata", shows ? "shown" : "hidden"); } catch { /* the same */ }
      // A count goes away when what it counts is shown: the keyboard goes on there.
      if (button.matches(".hint")) button.parentElement.querySelector(".mark, .errata-of a, summary")?.focus();
    });
  }

  // What the keys do.
  const keys = byId("ui_keys");
  byId("ui_help").addEventListener("click", () => keys.showModal());

  // On a phone one button opens the filters; it says how many are in use.
  const fold = byId("ui_filters"), foldName = fold?.textContent;
  fold?.addEventListener("click", () => fold.setAttribute("aria-expanded", fold.getAttribute("aria-expanded") !== "true"));

  // What is linked to stops below the bar, which is as high as its lines.
  const bar = document.querySelector(".bar");
  const measure = () => root.style.setProperty("--bar", `${bar.offsetHeight}px`);
  measure();
  addEventListener("resize", measure);

  // ---- Cards and their places, read from the page once.
  const data = JSON.parse(byId("ui_data")?.textContent ?? "{}");
  const { words = {}, synonyms = [], search: sought = [], elsewhere = [] } = data;
  const index = new WordIndex(synonyms);
  // Words of the specification by which readers look for what has other names, by where links to it lead.
  const phrasesOf = new Map(sought.filter(Boolean).map(([anchor, ...phrases]) => [anchor, phrases]));
  const links = new Map([...contents.querySelectorAll("a[href^='#']")].map((link) => [decodeURIComponent(link.hash.slice(1)), link.parentElement]));
  const items = [...document.querySelectorAll("article.object, .intro, .part")]
    .map((card) => ({ card, link: links.get(card.id), shown: true, isObject: card.matches(".object"), isPdo: card.matches(".pdo") }));
  const objects = items.filter((item) => item.isObject), isDevice = objects.length > 0;
  const itemOf = new Map(items.map((item) => [item.card, item]));
  // Groups of cards, and of lines of the contents, that the browser lays out together.
  const groups = new Map();
  for (const item of items) {
    for (const [one, group] of [[item.card, item.card.closest(".chunk") ?? item.card], [item.link, item.link?.closest(".chunk")]]) {
      if (group) groups.get(group)?.push({ one, item, shown: true }) ?? groups.set(group, [{ one, item, shown: true }]);
    }
  }

  // Objects that show another one have its name, and follow it.
  const views = new Set([...document.querySelectorAll("dd[data-kind=aliases] a")].map((link) => decodeURIComponent(link.hash.slice(1)).slice(0, 4)));

  // What a place is worth where others have the same words: parts of an object, what only repeats, and what is on another page, more if it is called like the
  // question. A PDO has the names of what is mapped, too.
  const WORTH_OF_KIND = { bit: 0.96, value: 0.96 }, PART = 0.98, PDO = 1.05, REPEATED = 0.95, ELSEWHERE = { worth: 0.92, exact: 0.95 }, OFF_DEVICE = { worth: 0.65, exact: 0.85 };
  // What the parameters of a PDO hold is shown with it.
  const PARAMETER_OF_PDO = /^1[4-7AB]/, hasPdos = items.some((item) => item.isPdo);
  // What a column's words are worth in the order of results, where it is not that of a fact.
  const FIELD_OF_COLUMN = {
    name: NAME, title: NAME, code: NAME, abbreviation: NAME, description: TEXT, meaning: TEXT, reaction: TEXT, event: TEXT, action: TEXT, warning: TEXT,
    place: ERRATUM, prints: ERRATUM, reads: ERRATUM, because: ERRATUM,
  };
  // Rows by their first column: what they are.
  const KIND_OF_ROW = { bit: "bit", value: "value", code: "error", sub: "entry", index: "entry" };
  const kindOf = (columns) => (columns.includes("because") ? "erratum" : KIND_OF_ROW[columns[0]] ?? "row");
  // The name of a bit or a value is a fact of what has it. An appendix of a device and rows that no link leads to only repeat.
  const fieldOf = (column, at, kind, repeats) => {
    const field = FIELD_OF_COLUMN[column] ?? FACT;
    const isNumbered = kind === "bit" || kind === "value";
    if (isNumbered && at === 0) return NAME;
    // What a bit, a value or an error means is said nowhere else.
    if ((isNumbered && column === "meaning") || (kind === "error" && column === "description")) return FACT;
    return field === NAME && (isNumbered || (column !== "code" && repeats && kind !== "error")) ? FACT : field;
  };
  // What a chapter, an appendix or a table is called, with its number and without.
  const namesOf = (title) => [title, title.replace(/^(?:[\d.]+|[0-9A-F]{4}h?|\p{L}+ [\dA-Z]+:?) /u, "")];
  const clean = (text) => text.replace(/\s+/g, " ").trim();
  // What filters look at; many rows have the same.
  const knownFacts = new Map();
  const factsOf = (row) => {
    const text = row.dataset.entry;
    let facts = knownFacts.get(text);
    if (!facts && text !== undefined) {
      const [access, pdo, type, stored, ...unit] = text.split("|");
      knownFacts.set(text, facts = { access, pdo, type, stored, unit: unit.join("|") });
    }
    return facts;
  };
  // What a list of results calls a place.
  const titleOf = ({ title, item, row, kind }) => {
    if (title !== undefined || !row) return title ?? item.title;
    if (!row.matches("tr")) return clean(row.textContent);
    const table = row.closest("table"), columns = table.dataset.columns.split(" "), name = columns.indexOf("name");
    const label = kind === "bit" ? table.tHead.rows[0].cells[0].textContent : "";
    return clean(`${label} ${row.cells[0].textContent} ${row.cells[name > 0 ? name : 1]?.textContent ?? ""}`);
  };

  const readRows = (item, table, inHead) => {
    const columns = (table.dataset.columns ?? "").split(" "), kind = kindOf(columns), name = columns.indexOf("name");
    const repeats = !item.isObject && (isDevice || !table.tBodies[0]?.rows[0]?.id);
    const fieldsOfColumns = columns.map((column, at) => fieldOf(column, at, kind, repeats));
    // A bit and a value are also found by what their numbers are: `bit 3`.
    const label = kind === "bit" || kind === "value" ? table.tHead.rows[0].cells[0].textContent : "";
    for (const row of table.tBodies[0]?.rows ?? []) {
      const fields = inHead ?? [[], [label], [], []];
      for (let at = 0; at < columns.length; at++) {
        const text = row.cells[at]?.textContent;
        // The index and name of an object of one value are in its heading.
        if (text && !(inHead && (at === 0 || at === name))) fields[fieldsOfColumns[at]].push(text);
      }
      if (inHead) continue;
      const isMain = item.isObject || (row.id && (!isDevice || kind === "error"));
      const worth = isMain ? item.worth * (WORTH_OF_KIND[kind] ?? PART) : REPEATED;
      index.place({ item, row, kind, facts: factsOf(row), worth, called: name < 0 ? "" : row.cells[name].textContent }, fields, phrasesOf.get(row.id));
    }
  };

  const readTable = (item, table) => {
    const caption = table.querySelector(":scope > .caption"), texts = [...table.querySelectorAll(":scope > p:not(.caption, .object-head)")];
    if (caption) {
      const title = clean(caption.textContent);
      const fields = [[], [], texts.map((text) => text.textContent), []];
      fields[item.isObject ? FACT : NAME].push(title);
      index.place({ item, row: table, kind: item.isObject ? "type" : "table", title, named: item.isObject ? undefined : namesOf(title) }, fields);
    }
    for (const one of table.children) {
      if (one.matches(".object-head")) {
        const about = one.querySelector(".about")?.textContent ?? "", title = clean(one.textContent.slice(0, one.textContent.length - about.length));
        index.place({ item, row: one, kind: "object", title, named: namesOf(title) }, [[title], [], [about], []]);
      }
      else for (const own of one.querySelectorAll(":scope > table")) readRows(item, own);
    }
  };

  // A PDO is asked for by what it is, by what is mapped into it, and by its settings.
  const readPdo = (item, title) => {
    const { card } = item, settings = [...card.querySelectorAll("td:first-child")].map((cell) => cell.textContent);
    const fields = [[title, words.pdo, words.mapping, ...settings], [], [], []];
    const mapped = [...card.querySelectorAll(".used text, .narrow a")].map((one) => one.textContent);
    fields[NAME].push(...mapped);
    for (const link of card.querySelectorAll("a[href^='#']")) fields[FACT].push(...phrasesOf.get(decodeURIComponent(link.getAttribute("href").slice(1))) ?? []);
    for (const part of card.querySelectorAll("svg title, svg text")) fields[TEXT].push(part.textContent);
    for (const part of card.querySelectorAll("td:not(:first-child)")) fields[FACT].push(part.textContent);
    for (const about of card.querySelectorAll(":scope > p")) fields[TEXT].push(about.textContent);
    const named = [...mapped.map((own) => `${words.pdo} ${own}`), ...[words.pdo, words.mapping, ...settings, ...mapped].map((own) => `${title} ${own}`), title];
    index.place({ item, row: null, kind: "pdo", title, worth: PDO, named }, fields);
  };

  const readCard = (item) => {
    const { card } = item;
    index.card(item);
    const heading = card.querySelector("h1, h2, h3, h4, h5, h6"), title = clean(heading?.textContent ?? "");
    // The index of an object is before its name, its kind after it.
    const small = heading?.querySelector("small")?.textContent ?? "";
    const [number, name] = item.isObject ? [title.slice(0, 5), clean(title.slice(5, title.length - small.length))] : ["", title];
    item.uses = card.querySelectorAll(":scope > dl dd[data-kind]").length;
    item.worth = views.has(card.id) || (hasPdos && PARAMETER_OF_PDO.test(number)) ? REPEATED : 1;
    item.title = item.isObject ? `${number} ${name}` : title;
    const fields = [[number, name], [small], [], []];
    if (item.isPdo) return readPdo(item, title);
    // An appendix of a device is called like what its rows repeat.
    if (!item.isObject && isDevice) [fields[NAME], fields[FACT]] = [[], [title]];
    for (const one of card.children) {
      if (one.matches("p.notes") && item.isObject) {
        fields[FACT].push(one.textContent);
        // The standard's name of the object, where it is another.
        for (const standard of one.querySelectorAll("code")) fields[NAME].push(standard.textContent);
      }
      else if (one.matches("p:not(.notes)")) fields[TEXT].push(one.textContent);
    }
    const tables = [...card.querySelectorAll(":scope > .scroll > table")];
    for (const table of tables) if (table.dataset.columns?.startsWith("index")) readRows(item, table, fields);
    const head = { item, row: null, kind: item.isObject ? "object" : "part", title: item.title, worth: item.worth };
    if (!item.isObject) head.named = namesOf(title);
    index.place(head, fields, phrasesOf.get(card.id));
    for (const one of card.children) {
      const own = tables.find((table) => table.parentNode === one);
      if (own && !own.dataset.columns?.startsWith("index")) readRows(item, own);
      else if (one.matches(".table")) readTable(item, one);
      else if (one.matches("dl")) {
        for (const line of one.querySelectorAll("dd")) {
          index.place({ item, row: line, kind: "use", title: item.title }, [[], [], [line.textContent], []]);
        }
      } else if (one.matches("details")) {
        for (const line of one.querySelectorAll(".compared tbody tr")) {
          index.place({ item, row: line, kind: "erratum", title: item.title }, [[], [], [], [line.textContent]]);
        }
      }
    }
  };

  // Reading is spread over idle times; who searches before waits for the rest.
  const reader = (function* () {
    for (const item of items) yield readCard(item);
    for (const [page, label, places, phrases] of elsewhere.filter(Boolean)) {
      // What is looked for there, by the words of the specification: objects, and single entries, bits, values and errors.
      const more = new Map((phrases ?? []).filter(Boolean).map(([anchor, ...own]) => [anchor, own])), titles = new Map();
      const add = (anchor, title, facts) => {
        index.card({ page });
        const place = { kind: "page", ...(isDevice ? OFF_DEVICE : ELSEWHERE), label, href: `${page}#${anchor}`, title, named: namesOf(title) };
        index.place(place, [[title.slice(0, 5), title], [facts], [], []], more.get(anchor));
      };
      for (const [anchor, title, facts = ""] of places.filter(Boolean)) {
        add(anchor, title, facts);
        titles.set(anchor, title);
        yield;
      }
      for (const anchor of more.keys()) {
        if (titles.has(anchor)) continue;
        const title = titles.get(anchor.slice(0, 4));
        add(anchor, title ? `${title} (${anchor})` : anchor.replace(/^error-/, `${words.error} `), "");
        yield;
      }
    }
  })();
  let isRead = false;
  const read = (time) => {
    const end = performance.now() + time;
    while (!isRead && performance.now() < end) isRead = reader.next().done;
    return isRead;
  };
  const whenIdle = (work) => (window.requestIdleCallback ? requestIdleCallback((idle) => work(Math.max(idle.timeRemaining(), 4))) : setTimeout(() => work(8), 16));
  const atOnce = (work) => {
    for (;;) { const { done, value } = work.next(); if (done) return value; }
  };
  // A first search without a user makes the next ones quick.
  const warmUp = () => {
    for (const text of ["er", "in", "st ac", "re"]) atOnce(index.search(text, null));
    performance.mark("search-ready");
  };
  const readOn = (time) => whenIdle(read(time) ? warmUp : readOn);
  addEventListener("load", () => whenIdle(readOn));

  // ---- Filters: one entry has to have everything that is asked for.
  const filters = [...document.querySelectorAll("select[data-filter]")];
  const wanted = () => filters.filter((filter) => filter.value).map((filter) => [filter.dataset.filter, filter.value]);
  const fitsEntry = (asked, facts) => asked.every(([key, value]) => facts[key] === value || (key === "pdo" && facts.pdo === "both"));

  // What an address names: an id, in any case of letters; sub-index 0 of an object without others is the object.
  const targetOf = (name) => byId(name) ?? byId(name.toUpperCase()) ?? byId(name.replace(/^[0-9a-f]{4}/i, (digits) => digits.toUpperCase()))
    ?? (/^[0-9a-f]{4}\.0$/i.test(name) ? byId(name.slice(0, 4).toUpperCase()) : null);

  // The anchor that a whole question is the address of. Of a run of bits, any is; a place on another page is known by its index.
  const addressed = (text) => {
    const anchors = addressesOf(text);
    return anchors.find((anchor) => targetOf(anchor)) ?? anchors.map(runOf).find((anchor) => anchor)
      ?? anchors.find((anchor) => index.knows(anchor.slice(0, 4))) ?? null;
  };
  const runOf = (anchor) => {
    const [, entry, bit] = /^(.+\.b)(\d+)$/.exec(anchor) ?? [];
    for (let first = Number(bit) - 1; first >= 0; first--) {
      const row = targetOf(`${entry}${first}`)?.closest("tr"), last = /\d+\D+(\d+)/.exec(row?.cells[0].textContent ?? "");
      if (row) return Number(last?.[1]) >= Number(bit) ? `${entry}${first}` : null;
    }
    return null;
  };

  // ---- Showing what was found.
  // What was found, here and on other pages.
  let hits = [];
  let landing = 0, working = 0, found = null, marked = null, dressed = new Set(), round = 0;
  // The row that the address names; the answer to the question next to it may still be looked for.
  let aimed = null;
  // Cards that have marks or rows put away, of this question or of one before.
  const worn = new Set();
  const near = new Set();

  const showRows = (item) => {
    for (const row of item.off ?? []) show(row, true);
    item.off = [];
    item.isWhole = true;
    show(item.all, false);
  };
  // While many rows of a table come and go it is away: else the browser would lay out all of it again after each piece.
  const putAway = (item) => {
    item.away ??= [...item.card.querySelectorAll("table")].filter((table) => table.tBodies[0].rows.length > SOME && !table.contains(aimed));
    for (const table of item.away) show(table, false);
  };
  const bringBack = (item) => {
    for (const table of item.away ?? []) show(table, true);
    item.away = null;
  };
  // A card can be a list of ten thousand rows, so that the work on one is done in pieces, too: these generators say after some rows that they may be interrupted.
  const undress = function* (item, isOver = () => false) {
    for (let done = 1; item.marks?.length > 0; done++) {
      const mark = item.marks.pop(), parent = mark.parentNode;
      if (parent) {
        mark.replaceWith(mark.firstChild);
        parent.normalize();
      }
      if (done % SOME_CARDS === 0) yield;
      if (isOver()) return;
    }
    item.marks = [];
    if (item.off?.length > SOME) putAway(item);
    while (item.off?.length > SOME) {
      for (const row of item.off.splice(-SOME)) show(row, true);
      yield;
      if (isOver()) return;
    }
    showRows(item);
    bringBack(item);
    worn.delete(item);
  };

  const markText = function* (item, within) {
    const walker = document.createTreeWalker(within, NodeFilter.SHOW_TEXT), nodes = [];
    for (let looked = 1; walker.nextNode(); looked++) {
      if (!walker.currentNode.parentElement.closest("svg, button")) nodes.push(walker.currentNode);
      if (looked % SOME === 0) yield;
    }
    for (const [at, node] of nodes.entries()) {
      if (at % SOME_CARDS === SOME_CARDS - 1) yield;
      const pieces = index.marks(node.data, marked);
      let end = node.length;
      for (const [from, to] of pieces.reverse()) {
        if (to > end) continue;
        end = from;
        const mark = document.createElement("mark"), piece = node.splitText(from);
        piece.splitText(to - from);
        piece.replaceWith(mark);
        mark.append(piece);
        item.marks.push(mark);
      }
    }
  };

  // Of a card that is found by some of its rows, the others are put away.
  const dress = function* (item) {
    if (dressed.has(item)) return;
    dressed.add(item);
    yield* undress(item);
    worn.add(item);
    putAway(item);
    item.isWhole = false;
    const asked = wanted();
    const places = item.found ? index.placesOf(item.found, found) : [], rows = [];
    yield;
    for (const [at, place] of places.entries()) {
      const { row } = index.places[place];
      if (row?.matches("tr")) rows.push(row);
      if (at % SOME === SOME - 1) yield;
    }
    // A card that is found by its heading is shown as a whole.
    const keep = new Set(places.includes(item.first) ? [] : rows);
    const hasEntries = rows.some((row) => row.dataset.entry);
    for (const table of item.card.querySelectorAll("table")) {
      yield;
      const list = [...table.tBodies[0].rows], isOfEntries = list[0]?.dataset.entry !== undefined;
      const some = list.some((row) => keep.has(row));
      for (const [at, row] of list.entries()) {
        if (at % SOME_CARDS === SOME_CARDS - 1) yield;
        // The reader wants to see all of them.
        if (item.isWhole) break;
        const fits = asked.length === 0 || row.dataset.entry === undefined || fitsEntry(asked, factsOf(row));
        const away = !fits || (keep.size > 0 && !keep.has(row) && (isOfEntries ? hasEntries && list.length > 1 : true));
        if (away && row !== aimed) { show(row, false); item.off.push(row); }
      }
      const box = table.closest(".table, .compared");
      // A table of which nothing is left goes with its caption and picture.
      if (box && list.length > 0 && !some && keep.size > 0 && !box.querySelector("tbody tr:not(.off)")) { show(box, false); item.off.push(box); }
    }
    if (item.off.length > 0) {
      if (!item.all) {
        item.all = Object.assign(element("button", words.rows_all), { type: "button", className: "all" });
        item.all.addEventListener("click", () => showRows(item));
        item.card.querySelector("h1, h2, h3, h4, h5, h6").after(item.all);
      }
      show(item.all, true);
    }
    if (marked) yield* markText(item, item.card);
    bringBack(item);
  };

  // Work that is not needed at once is done in pieces; a new question ends that of the last one. What takes longer is a generator.
  const inPieces = (list, work) => {
    const begun = round;
    let at = 0, begunOne = null;
    const isLeft = () => begun === round && (begunOne !== null || at < list.length);
    const go = () => {
      const start = performance.now(), end = start + 2;
      while (isLeft() && performance.now() < end) {
        begunOne ??= work(list[at++]) ?? null;
        if (begunOne?.next().done) begunOne = null;
      }
      performance.measure("search-piece", { start });
      if (isLeft()) requestAnimationFrame(go); else working -= 1;
    };
    working += 1;
    go();
  };
  const place = ([group, members]) => {
    const some = members.some(({ item }) => item.shown);
    if (group.matches(".chunk")) show(group, some);
    // What lies in a group that is put away need not be.
    if (!some && group.matches(".chunk")) return;
    for (const member of members) {
      if (member.shown === member.item.shown) continue;
      member.shown = member.item.shown;
      show(member.one, member.shown);
    }
  };
  const cardsOf = (group) => groups.get(group).filter(({ one, item }) => one === item.card && item.shown && !dressed.has(item)).map(({ item }) => item);
  const dressGroups = (list) => inPieces(list.flatMap(cardsOf), dress);
  const watcher = new IntersectionObserver((changes) => {
    for (const { target, isIntersecting } of changes) if (isIntersecting) near.add(target); else near.delete(target);
    if (root.classList.contains("searching") && !asking) dressGroups([...near]);
  }, { rootMargin: "300px" });
  for (const [group, [{ one, item }]] of groups) if (one === item.card) watcher.observe(group);

  // ---- The list of results, the best first.
  const results = byId("ui_results"), lines = results.querySelector("ol"), more = results.querySelector("button");
  const FEW_GROUPS = 100, FIRST = 12, LONGEST_TITLE = 90;
  const cut = (text) => (text.length > LONGEST_TITLE ? `${text.slice(0, LONGEST_TITLE - 1)}…` : text);
  const anchorOf = (at) => {
    const { row, item } = index.places[at];
    return row?.id || row?.closest("[id]:not(main)")?.id || item.card.id || item.card.querySelector("[id]")?.id || "";
  };
  const result = (one) => {
    const { at } = one;
    const target = index.places[at], line = element("li"), link = element("a");
    link.href = target.href ?? `#${anchorOf(at)}`;
    const title = titleOf(target);
    link.append(element("b", target.href ? title : target.item.title));
    if (target.row && title !== target.item.title) link.append(` › ${cut(title)}`);
    // A row without an address of its own is reached from the list all the same.
    if (target.row && !target.row.id) {
      link.className = "inside";
      link.addEventListener("click", (event) => {
        if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
        event.preventDefault();
        event.stopPropagation();
        try { history.pushState(null, "", link.hash); } catch { /* not allowed everywhere */ }
        settle(target.row);
      });
    }
    line.append(link);
    const note = target.href ? target.label : words[target.kind] ?? "";
    const places = index.placesOf(one, found).length;
    line.append(" ", element("small", places > 1 ? `${note} (${places})` : note));
    return line;
  };
  const list = (limit) => {
    lines.replaceChildren(...hits.slice(0, limit).map(result));
    more.textContent = `${hits.length - limit} ${words.more}`;
    show(more, hits.length > limit);
  };
  more.addEventListener("click", () => list(Infinity));

  // Where many places are asked, an answer is found in slices, so that the next letter need not wait: the last answer stays until the next one is whole.
  const SLICE = 3;
  let asking = null;
  const answer = ({ finish }, value) => {
    asking = null;
    finish(value);
  };
  const later = new MessageChannel();
  const goOn = () => {
    if (!asking) return;
    const start = performance.now();
    let step;
    do step = asking.work.next(); while (!step.done && performance.now() < start + SLICE);
    if (!step.done) later.port2.postMessage(null);
    else if (asking.isFound || performance.now() < start + SLICE / 2) answer(asking, step.value);
    else {
      // What is shown then is a slice of its own.
      asking.work = answered(step.value);
      asking.isFound = true;
      later.port2.postMessage(null);
    }
    performance.measure("search-piece", { start });
  };
  later.port1.onmessage = goOn;
  const answered = function* (value) { return value; };
  // Who wants to go to the first result does not wait for a slice.
  const finishAsking = () => { if (asking) answer(asking, atOnce(asking.work)); };

  const ask = () => {
    performance.clearMeasures();
    const start = performance.now();
    apply(index.places.length > MANY_PLACES);
    performance.measure("search-piece", { start });
  };
  // What waits until the page is read is forgotten when something else is asked; `after` is done when the answer is shown.
  let waiting = 0;
  const apply = (isSliced = false, after = () => {}) => {
    performance.mark("search");
    const asked = wanted(), text = search.value.trim(), isAsked = text !== "", begun = waiting += 1;
    if (fold) fold.textContent = asked.length > 0 ? `${foldName} (${asked.length})` : foldName;
    if (isAsked && !read(100)) { whenIdle(() => { if (begun === waiting) apply(false, after); }); return; }
    round += 1;
    if (asked.length > 0) for (const item of items) item.fits = rowsOf(item).some((facts) => fitsEntry(asked, facts));
    const named = isAsked ? addressed(text) : null, allowed = asked.length === 0 ? null
      : ({ item, facts }) => !item || (item.fits && (!facts || fitsEntry(asked, facts)));
    const work = isAsked ? index.search(named ? named.slice(0, 4) : text, allowed) : answered(null);
    asking = { work, finish: (value) => { display(value, asked, isAsked, named); after(); } };
    if (isSliced) goOn(); else finishAsking();
  };

  const display = (value, asked, isAsked, named) => {
    dressed = new Set();
    aimed = null;
    found = value;
    if (found && named) {
      // An entry by its address comes first, before anything else of its card.
      const target = targetOf(named), row = target?.closest("tr") ?? target, card = target?.closest("article");
      const first = found.cards.find(({ number }) => card && index.cards[number].card === card);
      if (first) {
        first.at = Math.max(index.places.findIndex((place) => place.row && place.row === row), index.cards[first.number].first);
        found.cards = [first, ...found.cards.filter((one) => one !== first)];
      }
    }
    marked = found && WordIndex.marked(found.meanings);
    hits = found?.cards ?? [];
    for (const one of hits) {
      const item = index.cards[one.number];
      if (item.page) continue;
      item.found = one;
      item.round = round;
    }
    let shown = 0, shownObjects = 0;
    for (const item of items) {
      if (item.round !== round) item.found = null;
      item.shown = (asked.length === 0 || item.fits) && (!found || item.found !== null);
      if (item.shown) shown += 1;
      if (item.shown && item.isObject) shownObjects += 1;
    }
    const searching = isAsked || asked.length > 0;
    root.classList.toggle("searching", searching);
    show(results, found !== null && found.cards.length > 0);
    show(byId("ui_similar"), found?.similar === true);
    show(byId("ui_partial"), found?.partial === true);
    byId("ui_unknown").lastElementChild.textContent = found?.unknown.join(", ");
    show(byId("ui_unknown"), found?.unknown.length > 0);
    if (found) list(FIRST);
    count.textContent = searching ? counts(shown, shownObjects) : "";
    show(byId("ui_nothing"), searching && shown === 0);
    landing += 1;
    // On a large page the list of results comes first, and the cards follow. What was marked for the last question is corrected with them.
    const begun = round, follow = () => {
      if (begun !== round) return;
      inPieces([...groups], place);
      inPieces([...worn], (item) => (dressed.has(item) ? null : undress(item, () => dressed.has(item))));
    };
    if (groups.size > FEW_GROUPS) requestAnimationFrame(follow); else follow();
    keep();
    performance.measure("search", "search");
    markSoon();
    if (searching) {
      scrollTo(0, 0);
      requestAnimationFrame(() => dressGroups([...near]));
    }
  };
  const rowsOf = (item) => {
    item.facts ??= [...item.card.querySelectorAll("tr[data-entry]")].map(factsOf);
    return item.facts;
  };
  // How many of what: objects of all, then places by their kind.
  const counts = (shown, shownObjects) => {
    const first = isDevice ? `${words.object} ${shownObjects} / ${objects.length}` : `${shown} / ${items.length}`;
    const kinds = KINDS.filter((kind) => found?.kinds.has(kind)).map((kind) => `${words[kind]} ${found.kinds.get(kind)}`);
    return [first, ...kinds].join(", ");
  };
  const KINDS = ["entry", "bit", "value", "error", "pdo", "table", "erratum"];

  // ---- The question is in the address, so that it can be sent, kept and gone back to.
  let keeping = 0;
  const asAddress = () => {
    const parts = new URLSearchParams();
    if (search.value.trim()) parts.set("q", search.value);
    for (const [key, value] of wanted()) parts.set(key, value);
    return parts.size > 0 ? `?${parts}` : "";
  };
  const keep = (now = false) => {
    clearTimeout(keeping);
    if (!now) { keeping = setTimeout(keep, 250, true); return; }
    const address = asAddress();
    if (address === location.search) return;
    // From no question to the first one there is a step back.
    const step = location.search === "" && address !== "" ? "pushState" : "replaceState";
    try { history[step](null, "", `${location.pathname}${address}${location.hash}`); } catch { /* not allowed everywhere */ }
  };
  const fromAddress = (after) => {
    const parts = new URLSearchParams(location.search);
    search.value = parts.get("q") ?? "";
    for (const filter of filters) {
      filter.value = parts.get(filter.dataset.filter) ?? "";
      if (filter.selectedIndex < 0) filter.value = "";
    }
    apply(false, after);
  };
  const clear = () => {
    search.value = "";
    for (const filter of filters) filter.value = "";
    apply();
  };
  search.addEventListener("input", ask);
  for (const filter of filters) filter.addEventListener("change", ask);

  // ---- Keys.
  search.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      finishAsking();
      keep(true);
      results.querySelector("a")?.click();
    } else if (event.key === "ArrowDown") {
      event.preventDefault();
      finishAsking();
      (results.querySelector("a") ?? [...contents.querySelectorAll("a")].find((link) => link.checkVisibility()))?.focus();
    }
  });
  for (const box of [results, contents]) {
    box.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step || event.target.tagName !== "A") return;
      event.preventDefault();
      const all = [...box.querySelectorAll("a")].filter((link) => link.checkVisibility?.() ?? link.offsetParent);
      const next = all.indexOf(event.target) + step;
      if (next < 0) search.focus(); else all[next]?.focus();
    });
  }
  document.addEventListener("keydown", (event) => {
    const typing = event.target.matches?.("input, select, textarea");
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey) { event.preventDefault(); search.focus(); search.select(); }
    if (event.key === "?" && !typing && !keys.open) { event.preventDefault(); keys.showModal(); }
    if (event.key === "Escape" && !isOver() && !keys.open && (typing || root.classList.contains("searching"))) { clear(); search.focus(); }
  });

  // ---- The contents: they mark where the reader is. What is below the bar is asked for, so that no card has to be watched.
  const isOver = () => "popover" in contents && contents.matches(":popover-open");
  const below = () => (getComputedStyle(bar).position === "sticky" ? Math.max(bar.getBoundingClientRect().bottom, 0) : 0);
  let here = null, opened = null, isAsking = false, retries = 0;
  const showLine = () => {
    const frame = contents.getBoundingClientRect(), line = here.getBoundingClientRect();
    if (line.top < frame.top || line.bottom > frame.bottom) contents.scrollTop += line.top - frame.top - frame.height / 3;
  };
  const mark = () => {
    isAsking = false;
    const { left, width } = main.getBoundingClientRect(), top = below();
    // Between two cards there is a gap; on a phone the contents may lie over them.
    const cards = [12, 40, 80].flatMap((down) => document.elementsFromPoint(left + width / 2, top + down).map((one) => one.closest("article.object, .part, .intro")));
    const card = cards.find((one) => one);
    // What has just come into sight is not laid out yet, and is nowhere.
    if (!card) {
      if (retries > 0) { retries -= 1; markOnNextFrame(); }
      return;
    }
    const link = links.get(card.id)?.querySelector("a") ?? null;
    if (link === here) return;
    here?.removeAttribute("aria-current");
    here = link;
    if (!here) return;
    here.setAttribute("aria-current", "location");
    const group = here.closest("details");
    // Of the groups only that of the place stays open; those that the reader opened do, too.
    if (opened && opened !== group) { opened.open = false; opened = null; }
    if (group && !group.open) { group.open = true; opened = group; }
    if (here.checkVisibility()) showLine();
  };
  const markOnNextFrame = () => {
    if (isAsking) return;
    isAsking = true;
    requestAnimationFrame(mark);
  };
  const markSoon = () => { retries = 12; markOnNextFrame(); };
  for (const kind of ["scroll", "scrollend"]) addEventListener(kind, markSoon, { passive: true });
  addEventListener("resize", markSoon);
  contents.addEventListener("click", (event) => {
    // What the reader opens or closes is the reader's.
    if (event.target.closest("summary")) opened = null;
    if (event.target.closest("a") && isOver()) contents.hidePopover();
  });
  contents.addEventListener("toggle", (event) => {
    if (event.target !== contents || !isOver() || !here) return;
    showLine();
    here.focus({ preventScroll: true });
  });

  // ---- Links that land: what is laid out on the way moves the target, so it is followed until it stays below the bar.
  const GAP = 4, STILL = 12, LONGEST = 180;
  // Where the last link landed. Its target stays there until the reader goes elsewhere, also when a table above it changes its height later.
  let landed = null;
  const offOf = (target) => target.getBoundingClientRect().top - below() - GAP;
  const staying = () => (landed?.begun === landing && Math.abs(offOf(landed.target)) <= 1 ? landed.target : null);
  // What a link leads into stays laid out until the next one: as long as the browser has only an estimate of a part, it may end before its own rows do, and no
  // scrolling reaches them.
  const LAZY = ".chunk, .object, .part";
  let held = [];
  const hold = (target) => {
    const around = [];
    for (let part = target.closest(LAZY); part; part = part.parentElement.closest(LAZY)) around.push(part);
    for (const part of held) if (!around.includes(part)) part.style.contentVisibility = "";
    for (const part of around) part.style.contentVisibility = "visible";
    held = around;
  };
  const settle = (target) => {
    const begun = landing += 1;
    landed = null;
    if (target.closest("details")) target.closest("details").open = true;
    hold(target);
    landed = { target, begun };
    let still = 0, frames = 0;
    const step = () => {
      if (begun !== landing) return;
      const off = offOf(target);
      if (Math.abs(off) > 1) { scrollBy({ top: off, behavior: "instant" }); still = 0; } else still = working > 0 ? 0 : still + 1;
      frames += 1;
      if (still < STILL && frames < LONGEST) requestAnimationFrame(step);
    };
    step();
  };
  // A reader who scrolls is not held.
  for (const kind of ["wheel", "touchmove", "pointerdown"]) addEventListener(kind, () => { landing += 1; }, { passive: true });
  addEventListener("keydown", (event) => { if (/^(Page|Arrow|Home|End| )/.test(event.key)) landing += 1; });

  const reveal = () => {
    let name = location.hash.slice(1);
    try { name = decodeURIComponent(name); } catch { /* a `%` of its own */ }
    const named = targetOf(name), target = named?.matches("td > i") ? named.closest("tr") : named;
    // On the way back the browser would put the reader where he was, at any time, also after this has landed.
    history.scrollRestoration = name && target ? "manual" : "auto";
    if (!name || !target) return;
    const item = itemOf.get(target.closest("article.object, .intro, .part"));
    // What the search has put away is shown again: the row, or the card with everything.
    if (item && !item.shown) clear();
    aimed = target.closest("tr");
    if (target.closest(".off")) showRows(item);
    settle(target);
  };
  addEventListener("popstate", () => {
    if (asAddress() !== location.search) fromAddress(reveal); else reveal();
  });
  document.addEventListener("click", (event) => {
    const elsewhere = event.ctrlKey || event.metaKey || event.shiftKey || event.altKey;
    const link = event.target.closest?.("a[href^='#']");
    // A link to where one is already changes no address.
    if (!elsewhere && link) setTimeout(reveal);
  });
  // ---- On a phone the cells of a row are below one another, each after the title of its column; what a row is called comes first, as a line. What is no longer a
  // table to a browser's layout is not a table to some screen readers either, so that it says what it is. At other widths this is not needed, and it would make a
  // page half as large again.
  const phone = matchMedia("(max-width: 37.5rem)"), PIECE = 50;
  const CALLED = ["sub", "index", "bit", "value", "code", "number", "mnemonic", "name"];
  const notStacked = [...document.querySelectorAll(".stack")].reverse();
  const stack = (table) => {
    table.setAttribute("role", "table");
    const titles = [...table.tHead.rows[0].cells], columns = table.dataset.columns.split(" ");
    const other = columns.findIndex((column) => !CALLED.includes(column));
    for (const part of [table.tHead, ...table.tBodies]) part.setAttribute("role", "rowgroup");
    for (const row of table.rows) {
      row.setAttribute("role", "row");
      for (const [at, cell] of [...row.cells].entries()) {
        cell.setAttribute("role", cell.localName === "th" ? "columnheader" : "cell");
        if (cell.parentNode.parentNode === table.tHead) continue;
        if (at < other) { cell.dataset.called = ""; continue; }
        cell.dataset.label = titles[at].textContent;
        if (titles[at].matches(".text")) cell.dataset.text = "";
        // Of a cell that has nothing but hidden marks, the title would be left alone.
        if (cell.childNodes.length > 0 && [...cell.childNodes].every((node) => node.matches?.(".mark") ?? !node.data.trim())) cell.dataset.bare = "";
      }
    }
    table.classList.add("stacked");
  };
  let isStacking = false;
  const stackTables = () => {
    const end = performance.now() + PIECE;
    while (phone.matches && notStacked.length > 0 && performance.now() < end) stack(notStacked.pop());
    const goesOn = phone.matches && notStacked.length > 0;
    if (goesOn !== isStacking) working += goesOn ? 1 : -1;
    isStacking = goesOn;
    if (goesOn) setTimeout(stackTables);
  };
  phone.addEventListener("change", () => { if (!isStacking) stackTables(); });
  stackTables();

  // What is wider than its place says so, and is reached by the keyboard; what fits is not.
  const places = new ResizeObserver((changes) => {
    const target = staying();
    let isOther = false;
    for (const box of new Set(changes.map((change) => change.target.closest(".scroll")))) {
      const isWide = box.scrollWidth > box.clientWidth + 1;
      isOther ||= isWide !== box.matches(".scrolls");
      box.classList.toggle("scrolls", isWide);
      if (isWide) box.tabIndex = 0; else box.removeAttribute("tabindex");
    }
    // A busy browser reports what it has laid out after a link has landed.
    if (target && isOther) settle(target);
  });
  for (const box of document.querySelectorAll(".scroll")) for (const one of [box, ...box.children]) places.observe(one);

  if (location.search) fromAddress(reveal); else reveal();
  markSoon();
  addEventListener("load", () => reveal());

  const copy = async (text) => {
    try { await navigator.clipboard.writeText(text); }
    catch {
      const area = Object.assign(document.createElement("textarea"), { value: text });
      document.body.append(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
  };
  document.addEventListener("click", async (event) => {
    const button = event.target.closest?.("[data-copy]");
    if (!button) return;
    await copy(button.dataset.copy);
    byId("ui_said").textContent = `${button.dataset.copy} ${byId("ui_said").dataset.copied}`;
    button.classList.add("copied");
    setTimeout(() => button.classList.remove("copied"), 900);
  });
})();
