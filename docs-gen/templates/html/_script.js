"use strict";
(() => {
  const byId = (id) => document.getElementById(id);
  const root = document.documentElement, search = byId("search"), count = byId("count");

  // Light or dark: as the system says, until the button is used.
  const remember = (theme) => { try { localStorage.setItem("od-theme", theme); } catch { /* not from file:// everywhere */ } };
  try { const theme = localStorage.getItem("od-theme"); if (theme) root.dataset.theme = theme; } catch { /* the same */ }
  byId("theme").addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    remember(root.dataset.theme);
  });

  // Every card or section with its line of the contents; texts are read once.
  const cards = [...document.querySelectorAll("[data-search], .part")];
  const links = new Map([...document.querySelectorAll("#contents a")].map((link) => [link.hash.slice(1), link.parentElement]));
  const items = cards.map((card) => ({
    card,
    link: links.get(card.id),
    text: (card.dataset.search ?? card.textContent).toLowerCase(),
    facts: Object.fromEntries(["access", "type", "pdo", "stored", "unit"].map((key) => [key, (card.dataset[key] ?? "").split("|")])),
    shown: true,
  }));
  const filters = [...document.querySelectorAll("select[data-filter]")];

  // `3020.5`, `3020:05` and `0x3020/5` name an entry; its card is found by the index.
  const entry = (text) => {
    const parts = /^(?:0x)?([0-9a-f]{4})h?[.:/](?:0x)?([0-9a-f]{1,2})h?$/i.exec(text.trim());
    return parts && `${parts[1].toUpperCase()}.${text.includes(":") ? parseInt(parts[2], 16) : Number(parts[2])}`;
  };

  const apply = () => {
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
    const searching = words.length > 0 || wanted.length > 0;
    root.classList.toggle("searching", searching);
    count.textContent = searching ? `${found} / ${items.length}` : "";
    byId("nothing").hidden = found > 0;
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
      const named = entry(search.value), first = items.find((item) => item.shown);
      if (named && byId(named)) location.hash = named;
      else if (first) location.hash = first.card.id;
    } else if (event.key === "ArrowDown") {
      event.preventDefault();
      visible()[0]?.focus();
    }
  });
  byId("contents").addEventListener("keydown", (event) => {
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

  // A link into something that the search has hidden shows it again.
  const reveal = () => {
    const target = byId(decodeURIComponent(location.hash.slice(1)));
    const card = target?.closest("[data-search], .part");
    if (card?.hidden) { clear(); target.scrollIntoView(); }
  };
  addEventListener("hashchange", reveal);
  document.addEventListener("click", (event) => { if (event.target.closest?.("a[href^='#']")) setTimeout(reveal); });

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
    byId("said").textContent = `${button.dataset.copy} ${byId("said").dataset.copied}`;
    const before = button.textContent;
    button.textContent = "✓";
    setTimeout(() => { button.textContent = before; }, 900);
  });
})();
