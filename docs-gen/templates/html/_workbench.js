"use strict";
(() => {
{% include "_values.js" %}

  // The workbench: a button at each entry and PDO opens a panel that copies names, converts values and shows frames. The page has neither without this script.
  const source = document.getElementById("ui_workbench");
  if (!source || !("popover" in HTMLElement.prototype)) return;
  // Read when they are needed for the first time: a large device has many.
  let values = null;
  const phrase = (...parts) => values.phrase(...parts);
  const element = (name, properties = {}, ...children) => {
    const one = Object.assign(document.createElement(name), properties);
    one.append(...children);
    return one;
  };
  const button = (text, properties = {}) => element("button", { type: "button", textContent: text, ...properties });

  // ---- The node-ID, typed once for the page.
  const NODE = `od-node ${location.pathname}`;
  let node = null;
  const nodeOf = (text) => (/^\s*\d+\s*$/.test(text) && Number(text) >= 1 && Number(text) <= 127 ? Number(text) : null);
  try { node = nodeOf(localStorage.getItem(NODE) ?? ""); } catch { /* not from file:// everywhere */ }
  const identifier = (base) => (node === null ? `${hex(base)}h+${phrase("node_short")}` : hex(base + node, 3));

  // ---- What entries are called on the page.
  const number = (index) => `${hex(index, 4)}h`;
  const cardOf = (index) => document.getElementById(hex(index, 4));
  const rowsOf = (card) => [...card.querySelectorAll(":scope > .scroll > table > tbody > tr[data-entry]")];
  const objectName = (index) => cardOf(index)?.getAttribute("aria-label").slice(number(index).length + 1) ?? "";
  const isStructured = (index) => cardOf(index)?.querySelector("tr[data-entry]").closest("table").dataset.columns.startsWith("sub");
  const addressOf = (index, sub) => (isStructured(index) ? `${number(index)}.${sub}` : number(index));
  const nameOf = (index, sub) => {
    if (!isStructured(index)) return objectName(index);
    const row = rowsOf(cardOf(index))[values.entriesOf(index).findIndex((entry) => entry.sub === sub)];
    const column = row.closest("table").dataset.columns.split(" ").indexOf("name");
    return `${objectName(index)}: ${row.cells[column].textContent.trim()}`;
  };
  const titleOf = (index, sub) => `${addressOf(index, sub)} ${nameOf(index, sub)}`;

  // ---- The panel, made when it is opened for the first time.
  let panel = null, body = null, title = null, refresh = () => {};
  const make = () => {
    title = element("h2", { id: "ui_bench_title" });
    body = element("div");
    const close = button("×", { className: "close", ariaLabel: phrase("close"), onclick: () => panel.hidePopover() });
    const field = element("input", { id: "ui_bench_node", inputMode: "numeric", autocomplete: "off", value: node ?? "", placeholder: "1–127" });
    field.addEventListener("input", () => {
      const typed = nodeOf(field.value);
      mark(field, field.value.trim() !== "" && typed === null ? phrase("no_node") : "");
      node = typed;
      try { if (node === null) localStorage.removeItem(NODE); else localStorage.setItem(NODE, node); } catch { /* the same */ }
      refresh();
    });
    panel = element("section", { id: "ui_bench", popover: "auto" }, close, title, labelled(phrase("node"), field), body);
    panel.setAttribute("role", "dialog");
    panel.setAttribute("aria-labelledby", title.id);
    // Keys of the page, such as `/`, mean nothing here; Escape closes only the panel.
    panel.addEventListener("keydown", (event) => event.stopPropagation());
    document.body.append(panel);
  };
  // Two labels of one text must not be one name of two elements.
  let labels = 0;
  const labelled = (text, input) => {
    input.id ||= `ui_bench_${labels += 1}`;
    return element("p", { className: "line" }, element("label", { htmlFor: input.id, textContent: text }), input);
  };
  // What is wrong with a field, next to it; nothing is wrong with an empty text.
  const mark = (field, text) => {
    let note = field.parentElement.querySelector(".wrong");
    if (!note && text) field.after(note = element("small", { className: "wrong", id: `${field.id}_wrong` }));
    if (note) note.textContent = text;
    field.setAttribute("aria-invalid", Boolean(text));
    if (text) field.setAttribute("aria-describedby", note.id); else field.removeAttribute("aria-describedby");
  };
  const open = (show) => {
    values ??= new Values(JSON.parse(source.textContent));
    if (!panel) make();
    refresh = () => {};
    body.replaceChildren();
    title.textContent = show();
    if (!panel.matches(":popover-open")) panel.showPopover();
    panel.scrollTop = 0;
    (body.querySelector("button, input, select") ?? panel).focus({ preventScroll: true });
  };
  // A text that a click copies; the script of the page does that for everything with `data-copy`.
  const copying = (text, label = "", shown = text) => {
    const one = button("", { className: "copy" });
    one.dataset.copy = text;
    if (label) one.append(element("small", { textContent: label }), " ");
    one.append(element("code", { textContent: shown }));
    return one;
  };
  const list = (pairs) => element("dl", {}, ...pairs.flatMap(([name, ...parts]) => [element("dt", { textContent: name }), element("dd", {}, ...parts)]));

  // ---- Names to copy.
  const copies = ({ index, sub, names, type, isMappable }) => {
    const path = `0x${hex(index, 4)}`, inPython = isStructured(index) ? `node.sdo[${path}][${sub}].raw` : `node.sdo[${path}].raw`;
    return [
      [addressOf(index, sub)], [`${path}:${hex(sub, 2)}`], [String(index), phrase("decimal")], [`16#${hex(index, 4)}`, "ST"],
      ...(isMappable ? [[`${hex(index, 4)}${hex(sub, 2)}${hex(type.bits, 2)}h`, phrase("mapping_parameter")]] : []),
      ...(names.rust ? [[`.${names.rust}`, "Rust"]] : []), ...(names.c ? [[names.c, "C"]] : []), ...(names.st ? [[names.st, "ST"]] : []),
      [inPython, "python-canopen"],
    ].map(([text, label]) => copying(text, label));
  };

  // ---- Frames of SDO (CiA 301 7.2.4.3).
  const multiplexer = ({ index, sub }) => [...bytesOf(BigInt(index), 2), sub];
  const frame = (base, bytes) => `${identifier(base)} ${hexBytes([...bytes, ...Array(8 - bytes.length).fill(0)])}`;
  const SEGMENT = 7;
  const segments = (bytes) => Array.from({ length: Math.max(Math.ceil(bytes.length / SEGMENT), 1) }, (_, at) => {
    const part = bytes.slice(at * SEGMENT, (at + 1) * SEGMENT), isLast = (at + 1) * SEGMENT >= bytes.length;
    return frame(0x600, [at % 2 << 4 | SEGMENT - part.length << 1 | Number(isLast), ...part]);
  });
  const isExpedited = (bytes) => bytes.length >= 1 && bytes.length <= 4;
  const begin = (expedited, long, entry, bytes) => (isExpedited(bytes)
    ? [expedited | 4 - bytes.length << 2, ...multiplexer(entry), ...bytes]
    : [long, ...multiplexer(entry), ...bytesOf(BigInt(bytes.length), 4)]);
  const writing = (entry, bytes) => [frame(0x600, begin(0x23, 0x21, entry, bytes)), ...(isExpedited(bytes) ? [] : segments(bytes))];
  const MOST_LINES = 8;
  const frames = (lines) => {
    const rest = lines.length - MOST_LINES;
    const shown = rest > 0 ? [...lines.slice(0, MOST_LINES), phrase("more_frames", rest)] : lines;
    return copying(lines.join("\n"), "", shown.join("\n"));
  };
  const transfers = (entry, bytes, refusal) => {
    const { isReadable, isWritable, isLocked, isConditional } = entry, pairs = [];
    if (isReadable) {
      pairs.push([phrase("read"), frames([frame(0x600, [0x40, ...multiplexer(entry)])])]);
      const readOn = bytes && !isExpedited(bytes) ? [" ", phrase("read_on", frame(0x600, [0x60]), frame(0x600, [0x70]))] : [];
      if (bytes) pairs.push([phrase("answer"), frames([frame(0x580, begin(0x43, 0x41, entry, bytes))]), ...readOn]);
    }
    if (!isWritable) return [...pairs, [phrase("write"), phrase("not_writable")]];
    if (!bytes) return pairs;
    if (refusal) return [...pairs, [phrase("write"), refusal]];
    const notes = [...(isLocked ? [phrase("locked")] : []), ...(isConditional ? [phrase("conditional")] : [])];
    const answer = [phrase("answer"), frames([frame(0x580, [0x60, ...multiplexer(entry)])])];
    return [...pairs, [phrase("write"), frames(writing(entry, bytes)), ...notes.flatMap((note) => [" ", note])], answer];
  };

  // ---- What a number of an entry says beyond the number.
  const mappingLines = (raw) => {
    if (raw === 0n) return [phrase("mapping_empty")];
    const index = Number(raw >> 16n & 0xFFFFn), sub = Number(raw >> 8n & 0xFFn), bits = Number(raw & 0xFFn), type = sub === 0 ? TYPES.get(index) : undefined;
    if (type) return [phrase("mapping_dummy", type.name, bits)];
    const entry = values.entry(index, sub);
    if (!entry) return [phrase("mapping_unknown", `${number(index)}.${sub}`)];
    const lines = [phrase("mapped", titleOf(index, sub), bits)];
    if (entry.type.bits !== bits) lines.push(phrase("mapping_width", entry.type.bits || entry.type.name));
    if (!entry.isMappable) lines.push(phrase("mapping_refused"));
    return lines;
  };
  const lines = (entry, raw) => {
    if (raw === null) return [];
    const { part } = entry;
    return [...values.machineLines(entry, raw), ...(part === "mapping" ? mappingLines(raw) : part ? values.cobIdLines(entry, raw) : [])];
  };

  // ---- An entry: its value in all forms, its bits, its frames.
  const choice = (all, raw) => {
    const label = ({ name, isSupported }) => (isSupported ? name : `${name} (${phrase("not_supported")})`);
    const options = all.map((value) => element("option", { value: String(value.raw), textContent: label(value) }));
    const one = element("select", {}, element("option", { value: "", textContent: "–" }), ...options);
    one.value = all.some((value) => value.raw === raw) ? String(raw) : "";
    return one;
  };
  const bitLine = (field, raw, change) => {
    const value = values.fieldValue(field, raw), width = field.last - field.first + 1;
    const input = width === 1 ? element("input", { type: "checkbox", checked: value === 1n })
      : field.values.length > 0 ? choice(field.values, value) : element("input", { value: String(value), inputMode: "numeric", autocomplete: "off" });
    input.addEventListener("change", () => {
      const digits = input.value.trim(), typed = width === 1 ? BigInt(input.checked) : /^\d+$/.test(digits) ? BigInt(digits) : null;
      if (typed === null || typed >> BigInt(width)) { mark(input, phrase("no_number")); return; }
      const mask = (1n << BigInt(width)) - 1n;
      change(raw & ~(mask << BigInt(field.first)) | typed << BigInt(field.first));
    });
    const place = width === 1 ? `${field.first}` : `${field.last}..${field.first}`;
    const notes = [...(field.isActiveAt0 ? [phrase("active_at_0")] : []), ...field.modes.map(([mode, name]) => `${mode}: ${name}`)];
    const line = labelled(`${place} ${field.name || (field.usage === "used" ? "" : phrase(field.usage))}`.trim(), input);
    if (notes.length > 0) line.append(element("small", { textContent: notes.join("; ") }));
    line.classList.toggle("set", value !== 0n);
    return line;
  };

  const showEntry = (index, sub) => {
    const entry = values.entry(index, sub), { type, unit } = entry, fields = [];
    // Nothing is in the fields yet, or something that is no value.
    let bytes = null, isTyped = false;
    const result = element("output", { className: "result", ariaLive: "polite" }), bits = element("div", { className: "bits" }), access = element("div");
    const field = (name, parse, format) => {
      const input = element("input", { autocomplete: "off", spellcheck: false });
      input.addEventListener("input", () => {
        isTyped = true;
        try {
          const text = input.value.trim() === "" && type.bits ? null : parse(input.value);
          mark(input, "");
          set(text, input);
        } catch (mistake) {
          if (!(mistake instanceof Mistake)) throw mistake;
          set(null, input);
          mark(input, mistake.message);
        }
      });
      fields.push({ input, format, line: labelled(name, input) });
    };
    const set = (given, typedIn = null) => {
      bytes = given;
      for (const { input, format } of fields) {
        if (input === typedIn) continue;
        input.value = bytes ? format(bytes) : "";
        mark(input, "");
      }
      show();
    };
    const show = () => {
      const raw = bytes && values.raw(entry, bytes), refusal = bytes ? values.refusal(entry, bytes) : "";
      const text = bytes && values.text(entry, bytes);
      const needsNode = bytes === null && !isTyped && node === null && String(entry.initial).startsWith("$");
      const notes = [...(bytes ? lines(entry, raw) : []), ...(needsNode ? [phrase("default_of_node")] : [])];
      result.replaceChildren(...(text === null ? [] : [element("b", { textContent: text })]), ...notes.map((line) => element("span", { textContent: line })),
        ...(refusal ? [element("span", { className: "wrong", textContent: refusal })] : []));
      if (names) names.value = bytes && named.some((value) => value.raw === raw) ? String(raw) : "";
      if (entry.fields) {
        // The one that was changed keeps the focus.
        const at = [...bits.querySelectorAll("input, select")].indexOf(document.activeElement);
        const change = (changed) => { isTyped = true; set(bytesOf(changed, values.size(entry))); };
        bits.replaceChildren(...entry.fields.map((one) => bitLine(one, raw ?? 0n, change)));
        if (at >= 0) bits.querySelectorAll("input, select")[at].focus();
      }
      access.replaceChildren(list(transfers(entry, bytes, refusal)));
    };
    const isRaw = ["octet-string", "domain"].includes(type.family), isTime = type.family.startsWith("time");
    if (!isRaw) field(phrase(isTime ? type.family.replace(/-/g, "_") : "value"), (text) => values.parse(entry, text), (all) => values.written(entry, all));
    if (type.isWhole) {
      if (type.bits > 1) field(phrase("hexadecimal"), (text) => values.parsePattern(entry, text), (all) => pattern(numberOf(all), type.bits));
      if (unit && !values.isPlain(unit)) field(phrase("quantity", unit.symbol), (text) => values.parseQuantity(entry, text), (all) => values.amount(unit, values.raw(entry, all)));
    }
    field(phrase("bytes"), (text) => values.parseBytes(entry, text), hexBytes);
    const named = [...entry.special, ...entry.values ?? []], names = named.length > 0 ? choice(named, null) : null;
    names?.addEventListener("change", () => { isTyped = true; set(names.value === "" ? null : bytesOf(BigInt(names.value), values.size(entry))); });
    const all = [...fields.map(({ line }) => line), ...(names ? [labelled(phrase("name"), names)] : []), result, access, ...(entry.fields ? [bits] : [])];
    body.append(element("p", { className: "copies" }, ...copies(entry)), ...all);
    refresh = () => {
      if (isTyped) show(); else set(values.initial(entry, node));
    };
    refresh();
    return titleOf(index, sub);
  };

  // ---- A PDO: the bytes of its frame and the values in it.
  const showPdo = (at) => {
    const [name, communication, map] = values.frames[at];
    let start = 0;
    const parts = map.map(([index, sub, width]) => {
      const entry = values.entry(index, sub), first = start;
      start += width;
      // What is mapped in part has no value of its own.
      return { index, sub, width, first, entry: entry?.type.bits === width ? entry : null };
    });
    const size = Math.ceil(start / 8), isReceived = communication < 0x1800;
    let frameBits = 0n, isTyped = false;
    const of = ({ first, width }) => bytesOf(BigInt.asUintN(width, frameBits >> BigInt(first)), Math.ceil(width / 8));
    const id = element("dd"), bytesField = element("input", { autocomplete: "off", spellcheck: false });
    const outputs = [];
    const put = ({ first, width }, bytes) => {
      const mask = (1n << BigInt(width)) - 1n << BigInt(first);
      frameBits = frameBits & ~mask | numberOf(bytes) << BigInt(first);
    };
    const show = (typedIn = null) => {
      for (const { part, input, output } of outputs) {
        const { entry } = part, bytes = of(part);
        if (input && input !== typedIn) { input.value = entry ? values.written(entry, bytes) : ""; mark(input, ""); }
        const refusal = entry && isReceived ? values.refusal(entry, bytes) : "";
        const set = entry?.fields ? values.setFields(entry, numberOf(bytes)) : [], text = entry ? values.text(entry, bytes) ?? phrase("no_value", entry.type.name) : hexBytes(bytes);
        output.textContent = [text, ...(refusal ? [refusal] : []), ...set, ...(entry ? lines(entry, values.raw(entry, bytes)) : [])].join("; ");
      }
      if (typedIn !== bytesField) { bytesField.value = hexBytes(bytesOf(frameBits, size)); mark(bytesField, ""); }
      const cob = values.entry(communication, 1), raw = cob && values.initial(cob, node), canId = raw && values.raw(cob, raw);
      const isOff = canId && canId >> 31n & 1n, isKnown = canId !== null && canId !== undefined;
      id.replaceChildren(isKnown ? frames([`${canIdText(canId)} ${hexBytes(bytesOf(frameBits, size))}`]) : phrase("unknown_can_id"), ...(isOff ? [" ", phrase("off")] : []));
    };
    bytesField.addEventListener("input", () => {
      isTyped = true;
      try {
        const bytes = values.parseBytes({ type: { bits: 8 * size } }, bytesField.value);
        mark(bytesField, "");
        frameBits = numberOf(bytes);
        show(bytesField);
      } catch (mistake) {
        if (!(mistake instanceof Mistake)) throw mistake;
        mark(bytesField, mistake.message);
      }
    });
    body.append(element("dl", {}, element("dt", { textContent: phrase("frame") }), id), labelled(phrase("bytes"), bytesField));
    for (const part of parts) {
      const { index, sub, width, entry } = part, dummy = sub === 0 ? TYPES.get(index) : undefined, output = element("output", { className: "result" });
      const label = `${dummy ? phrase("placeholder", dummy.name) : titleOf(index, sub)} (${phrase("bit_range", part.first, part.first + width - 1)})`;
      if (dummy) { body.append(element("p", { textContent: label })); continue; }
      const input = entry ? element("input", { autocomplete: "off", spellcheck: false }) : null;
      input?.addEventListener("input", () => {
        isTyped = true;
        try {
          put(part, values.parse(entry, input.value));
          mark(input, "");
          show(input);
        } catch (mistake) {
          if (!(mistake instanceof Mistake)) throw mistake;
          mark(input, mistake.message);
        }
      });
      outputs.push({ part, input, output });
      body.append(input ? labelled(label, input) : element("p", { textContent: label }), output);
    }
    refresh = () => {
      if (!isTyped) {
        frameBits = 0n;
        for (const part of parts.filter(({ entry }) => entry)) {
          const bytes = values.initial(part.entry, node);
          if (bytes) put(part, bytes);
        }
      }
      show();
    };
    refresh();
    return name;
  };
  const canIdText = (raw) => (raw >> 29n & 1n ? hex(raw & 0x1FFFFFFFn, 8) : hex(raw & 0x7FFn, 3));

  // ---- The node: its CAN-IDs, and what codes and frames say.
  const canIds = () => {
    const ofEntry = (index, sub) => {
      const entry = values.entry(index, sub);
      if (!entry) return null;
      const { initial } = entry, bytes = values.initial(entry, node), raw = bytes && values.raw(entry, bytes);
      if (raw !== null) return { text: canIdText(raw), isOff: raw >> 31n & 1n };
      // Without a node the formula counts, with its flags.
      const offset = initial === 0 ? null : BigInt(`0x${initial.slice(1)}`);
      return offset === null ? null : { text: `${canIdText(offset).replace(/^0+(?=.)/, "")}h+${phrase("node_short")}`, isOff: offset >> 31n & 1n };
    };
    const stated = [["SYNC", 0x1005, 0], ["TIME", 0x1012, 0], ["EMCY", 0x1014, 0], ...values.frames.map(([name, communication]) => [name, communication, 1])];
    const of = ([name, index, sub]) => {
      const id = ofEntry(index, sub), isMessage = !["SYNC", "TIME"].includes(name);
      return id ? [[`${name} (${addressOf(index, sub)})`, copying(id.text), ...(isMessage && id.isOff ? [" ", phrase("off")] : [])]] : [];
    };
    const fixed = [["sdo_request", 0x600], ["sdo_answer", 0x580], ["heartbeat", 0x700]].map(([key, base]) => [phrase(key), copying(identifier(base))]);
    return list([["NMT", copying("000")], ...stated.flatMap(of), ...fixed]);
  };
  const abortText = (code) => {
    const text = values.abortTexts.get(hex(code, 8));
    return text ? `${hex(code >> 16, 4)} ${hex(code & 0xFFFF, 4)}h: ${text}` : null;
  };
  // What a code of eight hexadecimal digits or a frame of SDO says.
  const decode = (text) => {
    const digits = text.replace(/[\s_]/g, "").replace(/^0x|h$/gi, "");
    if (/^[0-9a-f]{8}$/i.test(digits)) {
      const code = parseInt(digits, 16), abort = abortText(code), mapped = values.entry(code >>> 16, code >> 8 & 0xFF);
      const found = [...(abort ? [`${phrase("abort")} ${abort}`] : []), ...(mapped || TYPES.has(code >>> 16) ? [mappingLines(BigInt(code)).join("; ")] : [])];
      return found.length > 0 ? found : [phrase("unknown_code")];
    }
    const parts = /^\s*(?:(?:0x)?([0-7][0-9a-f]{2})h?[\s:#]+)?((?:[0-9a-f]{2}\s*){8})$/i.exec(text);
    return parts ? sdo(parts[1] ? parseInt(parts[1], 16) : null, parts[2].match(/[0-9a-f]{2}/gi).map((byte) => parseInt(byte, 16))) : [phrase("unknown_code")];
  };
  const sdo = (id, [command, ...rest]) => {
    const index = rest[0] | rest[1] << 8, sub = rest[2], data = rest.slice(3), entry = values.entry(index, sub), service = id === null ? null : id & 0x780;
    if (service !== null && service !== 0x600 && service !== 0x580) return [phrase("no_sdo")];
    const place = entry ? titleOf(index, sub) : phrase("no_entry", `${number(index)}.${sub}`), from = id === null ? [] : [`${phrase("node")} ${id & 0x7F}`];
    const value = (bytes) => (entry ? values.text(entry, bytes) ?? hexBytes(bytes) : hexBytes(bytes));
    const sized = command & 1 ? data.slice(0, 4 - (command >> 2 & 3)) : data.slice(0, values.size(entry ?? { type: {} }) ?? 4);
    const length = Number(numberOf(data) & 0xFFFFFFFFn), isRequest = service !== 0x580, isAnswer = service !== 0x600;
    if (command === 0x80) return [...from, place, `${phrase("abort")} ${abortText(Number(numberOf(data))) ?? `${hex(numberOf(data), 8)}h`}`];
    if (command === 0x40 && isRequest) return [...from, `${phrase("read")} ${place}`];
    if (command === 0x60 && isAnswer) return [...from, `${phrase("written")} ${place}`];
    if ((command & 0xF2) === 0x22 && isRequest) return [...from, `${phrase("write")} ${place} = ${value(sized)}`];
    if ((command & 0xF2) === 0x42 && isAnswer) return [...from, `${phrase("answer")} ${place} = ${value(sized)}`];
    if ([0x20, 0x21].includes(command) && isRequest) return [...from, `${phrase("write")} ${place}: ${phrase("long", length)}`];
    if ([0x40, 0x41].includes(command) && isAnswer) return [...from, `${phrase("answer")} ${place}: ${phrase("long", length)}`];
    return [...from, phrase("segment")];
  };
  const showNode = () => {
    const field = element("input", { autocomplete: "off", spellcheck: false, placeholder: "0609 0030" }), result = element("output", { className: "result", ariaLive: "polite" }), ids = element("div");
    const spans = (texts) => result.replaceChildren(...texts.map((text) => element("span", { textContent: text })));
    field.addEventListener("input", () => spans(field.value.trim() === "" ? [] : decode(field.value)));
    body.append(labelled(phrase("decode"), field), result, element("h3", { textContent: phrase("can_ids") }), ids);
    refresh = () => ids.replaceChildren(canIds());
    refresh();
    return source.dataset.bus;
  };

  // ---- The buttons. Cards get theirs when their part of the page comes near: it may have many thousands of rows.
  const opener = (place, show) => {
    const label = source.dataset.open.replace("{1}", place);
    return button("", { className: "bench", ariaLabel: label, title: label, onclick: () => open(show) });
  };
  const equip = (card) => {
    const index = parseInt(card.id, 16);
    for (const row of rowsOf(card)) {
      const [cell] = row.cells, sub = isStructured(index) ? parseInt(cell.textContent, 10) : 0;
      cell.append(opener(addressOf(index, sub), () => showEntry(index, sub)));
    }
  };
  const watcher = new IntersectionObserver((changes) => {
    for (const { target, isIntersecting } of changes) {
      if (!isIntersecting) continue;
      watcher.unobserve(target);
      for (const card of target.querySelectorAll("article.object")) equip(card);
    }
  }, { rootMargin: "100%" });
  for (const chunk of document.querySelectorAll("main .chunk")) watcher.observe(chunk);
  for (const [at, heading] of document.querySelectorAll(".pdo h3").entries()) heading.append(" ", opener(heading.textContent, () => showPdo(at)));
  document.querySelector(".tools")?.append(button(source.dataset.bus, { id: "ui_bus", onclick: () => open(showNode) }));
})();
