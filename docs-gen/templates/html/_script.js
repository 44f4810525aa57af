"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const root = document.documentElement, search = byId("ui_search"), count = byId("ui_count");

  // Light or dark: as the system says, until the button is used.
  const remember = (theme) => { try { localStorage.setItem("od-theme", theme); } catch { /* not from file:// everywhere */ } };
  try { const theme = localStorage.getItem("od-theme"); if (theme) root.dataset.theme = theme; } catch { /* the same */ }
  byId("ui_theme").addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    remember(root.dataset.theme);
  });

  // What is linked to stops below the bar, which is as high as its lines.
  const measure = () => root.style.setProperty("--bar", `${document.querySelector(".bar").offsetHeight}px`);
  measure();
  addEventListener("resize", measure);

  // Every card or section with its line of the contents; texts are read once.
  const cards = [...document.querySelectorAll("[data-search], .part")];
  const links = new Map([...document.querySelectorAll("#ui_contents a")].map((link) => [link.hash.slice(1), link.parentElement]));
  const items = cards.map((card) => ({
    card,
    link: links.get(card.id),
    text: (card.dataset.search ?? card.textContent).toLowerCase(),
    name: (card.querySelector("h2, h3, h4, h5, h6")?.textContent ?? "").toLowerCase().replace(/\s+/g, " ").trim(),
    facts: Object.fromEntries(["access", "type", "pdo", "stored", "unit"].map((key) => [key, (card.dataset[key] ?? "").split("|")])),
    shown: true,
  }));
  const chunks = new Map();
  for (const item of items) {
    for (const chunk of [item.card.parentElement, item.link?.parentElement]) {
      if (chunk?.classList.contains("chunk")) chunks.get(chunk)?.push(item) ?? chunks.set(chunk, [item]);
    }
  }
  const filters = [...document.querySelectorAll("select[data-filter]")];

  // `3020.5`, `3020:05` and `0x3020/0x05` name an entry; its card is found by the index. Behind `:` and `0x` digits are hexadecimal.
  const entry = (text) => {
    const parts = /^(?:0x)?([0-9a-f]{4})h?([.:/])(0x)?([0-9a-f]{1,3})(h?)$/i.exec(text.trim());
    if (!parts) return null;
    const [, index, mark, prefix, digits, suffix] = parts;
    const sub = parseInt(digits, mark === ":" || prefix || suffix ? 16 : 10);
    return Number.isNaN(sub) ? null : `${index.toUpperCase()}.${sub}`;
  };

  // The best of what is shown: the index itself, the name itself, a name that begins so, a name that holds it, anything.
  const best = () => {
    const text = search.value.toLowerCase().replace(/\s+/g, " ").trim();
    const index = /^(?:0x)?([0-9a-f]{4})h?$/.exec(text)?.[1].toUpperCase();
    const rank = ({ card, name }) => {
      const own = name.replace(/^[0-9a-f]{4}h /, "").replace(/ (var|array|record|domain)$/, "");
      return card.id === index ? 0 : own === text ? 1 : own.startsWith(text) ? 2 : name.includes(text) ? 3 : 4;
    };
    return items.filter((item) => item.shown).reduce((one, other) => (one && rank(one) <= rank(other) ? one : other), null);
  };

  const apply = () => {
    performance.clearMeasures("search");
    performance.mark("search");
    const named = entry(search.value);
    const text = named ? named.slice(0, 4) : search.value;
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted = filters.filter((filter) => filter.value).map((filter) => [filter.dataset.filter, filter.value]);
    let found = 0;
    for (const item of items) {
      const fits = words.every((word) => item.text.includes(word))
        && wanted.every(([key, value]) => item.facts[key].includes(value));
      if (fits) found += 1;
      if (fits !== item.shown) {
        item.shown = fits;
        item.card.hidden = !fits;
        if (item.link) item.link.hidden = !fits;
      }
    }
    // Whole groups that show nothing cost the browser nothing.
    for (const [chunk, members] of chunks) {
      const none = !members.some((item) => item.shown);
      if (chunk.hidden !== none) chunk.hidden = none;
    }
    const searching = words.length > 0 || wanted.length > 0;
    root.classList.toggle("searching", searching);
    if (searching) scrollTo(0, 0);
    count.textContent = searching ? `${found} / ${items.length}` : "";
    byId("ui_nothing").hidden = found > 0;
    performance.measure("search", "search");
  };
  const clear = () => {
    search.value = "";
    for (const filter of filters) filter.value = "";
    apply();
  };
  search.addEventListener("input", apply);
  for (const filter of filters) filter.addEventListener("change", apply);

  const visible = () => items.filter((item) => item.shown && item.link).map((item) => item.link.firstElementChild);
  search.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      const named = entry(search.value), found = best();
      const target = named && byId(named) ? named : found && (!named || found.card.id === named.slice(0, 4)) ? found.card.id : "";
      if (target) { location.hash = target; reveal(true); }
    } else if (event.key === "ArrowDown") {
      event.preventDefault();
      visible()[0]?.focus();
    }
  });
  byId("ui_contents").addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step || event.target.tagName !== "A") return;
    event.preventDefault();
    const list = visible(), next = list.indexOf(event.target) + step;
    if (next < 0) search.focus(); else list[next]?.focus();
  });
  document.addEventListener("keydown", (event) => {
    const typing = event.target.matches?.("input, select, textarea");
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey) { event.preventDefault(); search.focus(); search.select(); }
    if (event.key === "Escape" && (typing || root.classList.contains("searching"))) { clear(); search.focus(); }
  });

  // What is laid out on the way to the target moves it, so a jump is repeated for some frames.
  const settle = (target, frames) => {
    target.scrollIntoView();
    if (frames > 1) requestAnimationFrame(() => settle(target, frames - 1));
  };
  // A link into something that the search has hidden shows it again. Going back returns to where the reader was.
  const reveal = (jump) => {
    let name = location.hash.slice(1);
    try { name = decodeURIComponent(name); } catch { /* a `%` of its own */ }
    const target = byId(name) ?? byId(name.toUpperCase());
    if (!target) return;
    const card = target.closest("[data-search], .part");
    if (card?.hidden) clear();
    if (card?.hidden !== true && (jump || target.id !== name || root.classList.contains("searching"))) settle(target, 6);
  };
  addEventListener("hashchange", () => reveal(false));
  if (location.hash) reveal(false);
  addEventListener("load", () => { if (location.hash && performance.getEntriesByType("navigation")[0]?.type === "navigate") reveal(true); });
  // On paper, everything.
  addEventListener("beforeprint", clear);
  document.addEventListener("click", (event) => {
    const elsewhere = event.ctrlKey || event.metaKey || event.shiftKey || event.altKey;
    if (!elsewhere && event.target.closest?.("a[href^='#']")) setTimeout(() => reveal(true));
  });

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
