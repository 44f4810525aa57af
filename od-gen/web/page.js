// The page: files that were dropped, and what the command odgen makes of them. Texts of files and of the command become text nodes, never markup.
"use strict";

const byId = (id) => document.getElementById(id);
let language = /^de\b/.test(navigator.language) ? "de" : "en";
const say = (key, ...values) => values.reduce((text, value) => text.replace("{}", () => value), TEXTS[language][key]);

// An element with its properties and what is in it.
const element = (name, properties = {}, ...inside) => {
  const one = Object.assign(document.createElement(name), properties.on ?? {});
  for (const [key, value] of Object.entries(properties)) {
    const isAria = key.startsWith("aria-");
    if (key === "on" || value === undefined || value === false && !isAria) continue;
    one.setAttribute(key, value === true && !isAria ? "" : value);
  }
  one.append(...inside.filter((part) => part !== undefined));
  return one;
};
const button = (text, onclick, properties = {}) => element("button", { type: "button", on: { onclick }, ...properties }, text);

// ---- The command, in a worker ----

const fromBase64 = (text) => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let at = 0; at < bytes.length; at++) bytes[at] = letters.charCodeAt(at);
  return bytes;
};
const packed = fromBase64(byId("program").textContent);
const source = URL.createObjectURL(new Blob([byId("worker").textContent], { type: "text/javascript" }));
let worker, waiting = [];

const start = () => {
  worker = new Worker(source);
  worker.onmessage = ({ data }) => {
    waiting.shift().done(data);
    next();
  };
  worker.postMessage({ packed });
};
const next = () => {
  const [first] = waiting;
  if (first) {
    first.since = performance.now();
    worker.postMessage(first.job);
  }
  showBusy();
};
// Runs the command with all files: its exit code, what it printed, and what it made. Nothing, if it is cancelled.
const odgen = (...parameters) => new Promise((done) => {
  const inputs = files.map(({ name, bytes }) => [name, bytes]);
  waiting.push({ job: { parameters, inputs }, done });
  if (waiting.length === 1) next();
});
const cancel = () => {
  // What it had sent already is not waited for any more.
  worker.onmessage = null;
  worker.terminate();
  const cancelled = waiting;
  waiting = [];
  start();
  for (const { done } of cancelled) done(undefined);
  showBusy();
  announce(say("cancelled"));
};
const showBusy = () => {
  const [first] = waiting;
  const seconds = first ? (performance.now() - first.since) / 1000 : 0;
  // What is done at once does not flicker.
  byId("busy").hidden = !first || seconds < 0.4;
  if (first) byId("busy_text").textContent = say("busy", first.job.parameters[0], seconds.toFixed(0));
};
setInterval(showBusy, 250);
const announce = (text) => { byId("said").textContent = text; };

// ---- Files ----

// Name, bytes, kind; the findings of its check, once there are any.
let files = [], state = 0, active, view = "check";
const KINDS = [[/\.(eds|dcf)$/i, "eds"], [/\.(xdd|xdc|xpd)$/i, "xdd"], [/\.ya?ml$/i, "spec"]];
const kindOf = (name) => KINDS.find(([pattern]) => pattern.test(name))?.[1] ?? "other";
const isDictionary = ({ kind }) => kind !== "other";

const add = (name, bytes) => {
  // A name is an argument of the command, which begins options with a hyphen.
  name = name.replace(/^-/, "_").replace(/[/\\]/g, "_");
  const old = files.findIndex((file) => file.name === name);
  announce(say(old < 0 ? "added" : "replaced", name));
  const file = { name, bytes, kind: kindOf(name) };
  if (old < 0) files.push(file); else files[old] = file;
  return file;
};
// Files may be parts of each other: all are checked again.
const changed = () => {
  state += 1;
  for (const file of files) {
    file.check = undefined;
    file.shown = {};
  }
  byId("work").hidden = !files.length;
};
const take = async (list) => {
  const added = [];
  for (const file of list) added.push(add(file.name, new Uint8Array(await file.arrayBuffer())));
  changed();
  activate(added.find(isDictionary) ?? added[0] ?? active);
  for (const file of added) if (isDictionary(file)) await check(file);
};
const activate = (file) => {
  active = file;
  if (file && !isDictionary(file)) view = "check";
  showFiles();
  showViews();
  show();
};
const remove = (file) => {
  files = files.filter((one) => one !== file);
  changed();
  activate(active === file ? files[0] : active);
};

// `1 error, 3 warnings`.
const counted = (...counts) => counts.filter(([number]) => number).map(([number, one]) => `${number} ${say(number === 1 ? one : `${one}s`)}`).join(", ");
const verdict = ({ check: found, kind }) => {
  if (kind === "other") return "";
  if (!found) return say("checking");
  const count = (severity) => found.findings.filter((one) => one.severity === severity).length;
  return counted([count("error"), "error"], [count("warning"), "warning"]) || say("fine");
};
const showFiles = () => {
  byId("files").replaceChildren(...files.map((file) => element("li", {},
    button(element("span", {}, `${file.name} `, element("small", {}, verdict(file))), () => activate(file), { "aria-current": file === active }),
    button("×", () => remove(file), { "aria-label": say("remove", file.name) }))));
};

// ---- Views ----

const VIEWS = ["check", "fix", "convert", "look", "compare", "decode", "edit"];
const choose = (name, focuses) => {
  view = name;
  showViews();
  show();
  if (focuses) byId(`tab_${name}`).focus();
};
const showViews = () => {
  byId("views").replaceChildren(...VIEWS.map((name, at) => {
    const isChosen = name === view;
    const tab = button(say(`view_${name}`), () => choose(name), { role: "tab", id: `tab_${name}`, "aria-selected": isChosen, "aria-controls": "view", tabindex: isChosen ? 0 : -1 });
    tab.onkeydown = ({ key }) => {
      const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: VIEWS.length - 1 }[key];
      if (to !== undefined) choose(VIEWS[(to + VIEWS.length) % VIEWS.length], true);
    };
    return tab;
  }));
};
// Shows the view of the active file. What a view shows stays with the file until a file changes; a view that comes too late is not shown.
let turn = 0;
const show = async () => {
  const mine = ++turn, place = byId("view"), file = active, name = view;
  place.setAttribute("aria-labelledby", `tab_${name}`);
  place.replaceChildren();
  if (!file) return;
  const draw = (...parts) => { if (mine === turn) place.replaceChildren(...parts.filter((part) => part !== undefined)); };
  await { check: showCheck, fix: showFix, convert: showConvert, look: showLook, compare: showCompare, decode: showDecode, edit: showEdit }[name](file, draw);
};
// The result of a run that a view of a file begins with; kept.
const once = (file, key, make) => (file.shown[key] ??= make().then((result) => {
  if (!result) delete file.shown[key];
  return result;
}));

// `odgen check --notes "my drive.eds"`, as one would type it.
const typed = (parameters) => ["odgen", ...parameters].map((one) => (/^[\w./:=+@%,-]+$/.test(one) ? one : `"${one.replace(/["\\$\x60]/g, "\\$&")}"`)).join(" ");
const command = (...parameters) => element("p", { class: "command" }, `${say("same_as")} `, element("code", {}, typed(parameters)));
const broken = ({ failed, err }) => element("div", { class: "wrong" }, element("p", {}, say("failed")), element("pre", { class: "wrap" }, `${err}${failed}`));
const messages = (text) => (text.trim() ? element("pre", { class: "wrap" }, text) : undefined);
const paragraph = (...parts) => element("p", {}, ...parts);

// ---- Check ----

// The text of a file for showing lines of it; the command says which encodings it reads.
const textOf = (bytes) => {
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return new TextDecoder("utf-16le").decode(bytes);
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return new TextDecoder("utf-16be").decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
};
const linesOf = (file) => (file.shown.lines ??= textOf(file.bytes).split(/\r\n|\r|\n/));

const PARAMETERS_OF_CHECK = ["check", "--notes", "--format", "json"];
// The findings of a file: what the command prints, one JSON object a line.
const check = (file) => (file.running ??= (async () => {
  let result, before;
  do {
    before = state;
    result = await odgen(...PARAMETERS_OF_CHECK, file.name);
  } while (result && before !== state);
  file.running = undefined;
  if (!result) return undefined;
  const findings = [], others = [];
  for (const line of result.err.split("\n").filter(Boolean)) {
    try { findings.push(JSON.parse(line)); } catch { others.push(line); }
  }
  file.check = { ...result, findings, others };
  showFiles();
  return file.check;
})());

// What the first ones refuse is known from their sources; of the others only what their users have reported.
const TESTED = ["python-canopen", "dcfchk", "eds-utils", "node-canopen", "canopen-host"], REPORTED = ["CODESYS", "CANopenEditor", "CANeds"];
const MOST = 100;

const showCheck = async (file, draw) => {
  if (!isDictionary(file)) return draw(paragraph(say("trace_here")));
  draw(paragraph(say("checking")));
  const found = file.check ?? await check(file);
  if (!found) return draw(paragraph(say("cancelled")));
  draw(...checked(file, found));
};
const checked = (file, found) => {
  if (found.failed) return [broken(found)];
  const of = (severity) => found.findings.filter((one) => one.severity === severity);
  const [errors, warnings, notes] = [of("error"), of("warning"), of("note")];
  const parts = [
    command(...PARAMETERS_OF_CHECK, file.name),
    found.others.length ? element("div", {}, paragraph(say("unreadable")), messages(found.others.join("\n"))) : undefined,
    paragraph(counted([errors.length, "error"], [warnings.length, "warning"]) || say("nothing_found")),
  ];
  // A file that cannot be read is an error without a place, and what is cut off ends with one: then nothing is known of programs.
  if (file.kind === "eds" && found.findings.every(({ labels }) => labels.length)) parts.push(programs(found.findings));
  parts.push(list(file, [...errors, ...warnings]));
  if (notes.length) {
    const folded = element("details", {}, element("summary", {}, say("notes", notes.length)));
    folded.ontoggle = () => { if (folded.children.length === 1) folded.append(list(file, notes)); };
    parts.push(folded);
  }
  return parts.filter(Boolean);
};
const programs = (findings) => {
  const row = (refuses, takes) => (reader) => {
    const codes = [...new Set(findings.filter((one) => one["minded-by"]?.includes(reader)).map((one) => one.code))];
    return element("tr", {}, element("th", { scope: "row" }, reader), element("td", {}, codes.length ? say(refuses, codes.join(", ")) : say(takes)));
  };
  return element("div", {}, element("h2", {}, say("programs")), paragraph(say("programs_what")),
    element("table", { id: "programs" }, element("thead", {}, element("tr", {}, element("th", { scope: "col" }, say("program")), element("th", { scope: "col" }, say("verdict")))),
      element("tbody", {}, ...TESTED.map(row("refuses", "takes")), ...REPORTED.map(row("reported", "unreported")))));
};
// The first findings, and a button for the next ones.
const list = (file, findings) => {
  const place = element("div");
  const more = (from) => {
    place.append(...findings.slice(from, from + MOST).map((one) => article(file, one)));
    const left = findings.length - from - MOST;
    if (left <= 0) return;
    const rest = button(say("more", Math.min(left, MOST)), () => { rest.remove(); more(from + MOST); });
    place.append(rest);
  };
  more(0);
  return place;
};
const article = (file, finding) => {
  const [first, ...others] = finding.labels;
  const place = ({ file: name, line, column }) => `${name}:${line}:${column}`;
  const one = element("article", { class: "finding", "data-severity": finding.severity },
    element("h3", {}, element("span", { class: "severity" }, say(finding.severity)), ` ${finding.code} `, finding.message, " ", first ? element("small", {}, place(first)) : ""));
  if (first) one.append(...[excerpt(first)].filter(Boolean));
  for (const label of others) one.append(element("p", {}, element("small", {}, `${place(label)}: ${label.text}`)), ...[excerpt(label, true)].filter(Boolean));
  for (const note of finding.notes) one.append(paragraph(note));
  if (finding.help) one.append(paragraph(finding.help));
  const meaning = element("details", {}, element("summary", {}, say("explain", finding.code)));
  meaning.ontoggle = async () => {
    if (meaning.children.length > 1) return;
    const text = element("pre", { class: "wrap" });
    meaning.append(text);
    text.textContent = (await odgen("explain", finding.code))?.out ?? say("cancelled");
  };
  one.append(meaning);
  return one;
};
// The line of a place with what is meant marked in it.
const excerpt = ({ file: name, line, column, "end-line": endLine, "end-column": endColumn, text }, isTold) => {
  const file = files.find((one) => one.name === name);
  const source = file && linesOf(file)[line - 1];
  if (source === undefined) return text && !isTold ? paragraph(text) : undefined;
  // Columns count characters.
  const letters = Array.from(source);
  const end = endLine === line ? Math.max(endColumn - 1, column) : letters.length;
  const part = (from, to) => letters.slice(from, to).join("");
  return element("pre", {}, element("span", { class: "number" }, `${line} │ `), part(0, column - 1), element("mark", {}, part(column - 1, end)), part(end), text && !isTold ? `\n${" ".repeat(String(line).length)} │ ${text}` : "");
};

// ---- Fix ----

const showFix = async (file, draw) => {
  if (file.kind !== "eds") return draw(paragraph(say("fix_only")));
  const parameters = ["fix", "--write", "--diff", file.name];
  draw(command(...parameters));
  const result = await once(file, "fix", () => odgen(...parameters));
  if (!result) return draw(paragraph(say("cancelled")));
  if (result.failed) return draw(broken(result));
  const [fixed] = result.made;
  const buttons = fixed && element("p", { class: "row" },
    button(say("fix_save"), () => save(file.name, fixed[1]), { class: "main", id: "fix_save" }),
    button(say("fix_take"), () => { const added = add(file.name, fixed[1]); changed(); view = "check"; activate(added); }, { id: "fix_take" }));
  draw(command(...parameters), buttons, fixed ? difference(result.out) : result.code === 0 ? paragraph(say("fix_nothing")) : undefined, element("h2", {}, say("says")), messages(result.err));
};
const difference = (text) => {
  const shown = element("pre", { id: "difference", tabindex: 0 });
  for (const line of text.split("\n")) {
    const kind = /^(---|\+\+\+|@@)/.test(line) ? "b" : line.startsWith("+") ? "ins" : line.startsWith("-") ? "del" : "span";
    shown.append(element(kind, {}, line), "\n");
  }
  return shown;
};

// ---- Convert ----

// What each format is made with, and which of the files are of it. `build` makes an EDS and the dump in any case.
const dcf = (file, { device, node, rate, name, values }, ...further) => ["dcf", file,
  ...(device ? ["--device", device] : []), ...(node ? ["--node", node] : []), ...(rate ? ["--bit-rate", rate] : []), ...(name ? ["--node-name", name] : []),
  ...values.flatMap((value) => ["--set", value]), ...further];
const build = (...flags) => (file, { device }) => ["build", file, ...flags, ...(device ? ["--device", device] : [])];
const FORMATS = {
  eds: { make: build(), is: /^generated\/eds\// },
  dcf: { make: dcf, is: /\.dcf$/ },
  xdd: { make: build("--xdd"), is: /^generated\/xdd\// },
  xdc: { make: (file, options) => dcf(file, options, "--xdc"), is: /\.xdc$/ },
  concise: { make: (file, options) => dcf(file, options, "--concise"), is: /\.bin$/ },
  dbc: { make: (file, { device, node }) => ["dbc", file, ...(node ? ["--node", device ? `${node}=${device}` : node] : [])], is: /\.dbc$/ },
  c: { make: build("--c", "plain"), is: /^generated\/c\// },
  canopennode: { make: build("--c", "canopennode"), is: /^generated\/c\// },
  st: { make: (file, { device, node, words }) => ["st", file, ...(device ? ["--device", device] : []), ...(node ? ["--node", node] : []), ...(words ? ["--lang", words] : [])], is: /./ },
  rust: { make: build("--rust"), is: /^generated\/src\// },
  json: { make: build(), is: /\.json$/ },
  spec: { make: (file) => ["import", file], is: /\.yaml$/ },
  html: { make: (file, options) => documents("html", file, options), is: /./ },
  md: { make: (file, options) => documents("md", file, options), is: /./ },
};
const documents = (format, file, { device, words }) => ["docs", file, "--format", format, ...(device ? ["--device", device] : []), ...(words ? ["--lang", words] : [])];

// The keys of the devices of a specification; any other file has one.
const devicesOf = (file) => once(file, "devices", async () => {
  if (file.kind !== "spec") return [];
  const result = await odgen("dump", file.name);
  try { return result && JSON.parse(result.out).devices.map(({ key }) => key); } catch { return []; }
});

const field = (label, input) => element("label", {}, element("span", {}, label), input);
const showConvert = async (file, draw) => {
  if (!isDictionary(file)) return draw(paragraph(say("not_here")));
  if (file.shown.convert) return draw(...file.shown.convert);
  const devices = await devicesOf(file) ?? [];
  const device = element("select", { id: "device" }, element("option", { value: "" }, say("all_devices")), ...devices.map((key) => element("option", { value: key }, key)));
  const formats = Object.keys(FORMATS).filter((name) => name !== "spec" || file.kind !== "spec");
  const boxes = formats.map((name) => element("input", { type: "checkbox", id: `format_${name}`, value: name }));
  const [node, rate, name] = ["node", "rate", "name"].map((id) => element("input", { id, autocomplete: "off", ...(id === "name" ? {} : { inputmode: "numeric" }), ...(id === "node" ? { "aria-describedby": "node_help" } : {}) }));
  const values = element("textarea", { id: "values", spellcheck: "false" });
  const words = element("select", { id: "words" }, ...["en", "de"].map((code) => element("option", { value: code, lang: code, selected: code === language }, { en: "English", de: "Deutsch" }[code])));
  const results = element("div", { id: "made" });
  const make = async () => {
    const wanted = boxes.filter((box) => box.checked).map((box) => box.value);
    if (!wanted.length) return results.replaceChildren(paragraph(say("choose_format")));
    const options = { device: device.value, node: node.value.trim(), rate: rate.value.trim(), name: name.value.trim(), values: values.value.split("\n").map((line) => line.trim()).filter(Boolean), words: words.value };
    results.replaceChildren();
    const made = new Map();
    for (const format of wanted) {
      const parameters = FORMATS[format].make(file.name, options);
      const result = await odgen(...parameters);
      if (!result) return results.append(paragraph(say("cancelled")));
      // The list of what it made is for the next run of the command in the same folder.
      const own = result.made.filter(([path]) => FORMATS[format].is.test(path) && !/(^|\/)\.odgen-/.test(path));
      for (const [path, bytes] of own) made.set(path, bytes);
      results.append(...result.failed ? [broken(result)] : section(format, parameters, result, own));
    }
    if (made.size > 1) results.prepend(element("p", {}, button(say("download_all"), () => save(`${file.name.replace(/\.[^.]*$/, "")}.zip`, zip([...made])), { class: "main", id: "zip" })));
  };
  file.shown.convert = [
    element("fieldset", {}, element("legend", {}, say("formats")), element("div", { class: "choices" }, ...formats.map((one, at) => element("label", {}, boxes[at], say(`format_${one}`))))),
    element("div", { class: "fields" }, devices.length > 1 ? field(say("devices"), device) : undefined,
      field(say("node"), node), field(say("bit_rate"), rate), field(say("node_name"), name), field(say("documents_language"), words)),
    element("p", { id: "node_help", class: "command" }, say("node_help")),
    field(say("values"), values),
    element("p", {}, button(say("make"), make, { class: "main", id: "make" })),
    results,
  ];
  draw(...file.shown.convert);
};
const section = (format, parameters, result, own) => [
  element("h2", {}, say(`format_${format}`)),
  command(...parameters),
  own.length ? element("table", {},
    element("thead", {}, element("tr", {}, element("th", { scope: "col" }, say("file")), element("th", { scope: "col", class: "number-column" }, say("size")), element("td"))),
    element("tbody", {}, ...own.map(([path, bytes]) => element("tr", {}, element("td", {}, path), element("td", { class: "number-column" }, bytes.length < 1024 ? `${bytes.length} B` : `${(bytes.length / 1024).toFixed(1)} kB`),
      element("td", {}, button(say("download"), () => save(path.split("/").at(-1), bytes), { "aria-label": `${say("download")}: ${path}` })))))) : paragraph(say("nothing_made")),
  ...[messages(result.err)].filter(Boolean),
];

const save = (name, contents) => {
  const url = URL.createObjectURL(new Blob([contents]));
  element("a", { href: url, download: name }).click();
  // The browser reads it after this.
  setTimeout(() => URL.revokeObjectURL(url), 60000);
};

// An archive that stores files as they are, in the form of the first ZIP: a header before each file, and a list of all at the end.
const zip = (entries) => {
  const table = Uint32Array.from({ length: 256 }, (_, byte) => { for (let bit = 0; bit < 8; bit++) byte = byte & 1 ? (byte >>> 1) ^ 0xedb88320 : byte >>> 1; return byte; });
  const checksum = (bytes) => { let sum = ~0; for (const byte of bytes) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8); return ~sum >>> 0; };
  const header = (...fields) => {
    const view = new DataView(new ArrayBuffer(fields.reduce((sum, [size]) => sum + size, 0)));
    let at = 0;
    for (const [size, value] of fields) {
      if (size === 2) view.setUint16(at, value, true); else view.setUint32(at, value, true);
      at += size;
    }
    return new Uint8Array(view.buffer);
  };
  const parts = [], directory = [];
  let at = 0, ofDirectory = 0;
  const push = (list, ...all) => { list.push(...all); return all.reduce((sum, one) => sum + one.length, 0); };
  for (const [path, bytes] of entries) {
    const name = new TextEncoder().encode(path);
    // Version 2.0, names in UTF-8, stored, and the first day that a ZIP can name.
    const common = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, 0x21], [4, checksum(bytes)], [4, bytes.length], [4, bytes.length], [2, name.length], [2, 0]];
    ofDirectory += push(directory, header([4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), name);
    at += push(parts, header([4, 0x04034b50], ...common), name, bytes);
  }
  const end = header([4, 0x06054b50], [2, 0], [2, 0], [2, entries.length], [2, entries.length], [4, ofDirectory], [4, at], [2, 0]);
  return new Blob([...parts, ...directory, end]);
};

// ---- Look ----

// A page of a reference in a frame of its own, which asks for the pages that its links lead to.
const FOLLOW = `<script>
addEventListener("click", (event) => {
  const [, page, place] = /^([\\w.-]+\\.html)(#.*)?$/.exec(event.target.closest?.("a")?.getAttribute("href") ?? "") ?? [];
  if (!page) return;
  event.preventDefault();
  parent.postMessage({ page, place: place ?? "" }, "*");
});
<\/script>`;
const showLook = async (file, draw) => {
  if (!isDictionary(file)) return draw(paragraph(say("not_here")));
  const parameters = documents("html", file.name, { words: language });
  draw(command(...parameters));
  const result = await once(file, `look_${language}`, () => odgen(...parameters));
  if (!result) return draw(paragraph(say("cancelled")));
  if (result.failed) return draw(broken(result));
  const pages = new Map(result.made.map(([path, bytes]) => [path.split("/").at(-1), new TextDecoder().decode(bytes)]));
  if (!pages.size) return draw(command(...parameters), messages(result.err));
  const frame = element("iframe", { id: "look", title: say("look_title", file.name), sandbox: "allow-scripts", allow: "clipboard-write" });
  const select = element("select", { id: "look_page" }, ...[...pages.keys()].map((name) => element("option", {}, name)));
  const open = (name, place = "") => {
    select.value = name;
    const at = place ? `<script>addEventListener("load", () => { location.hash = ${JSON.stringify(place).replace(/</g, "\\u003c")}; });<\/script>` : "";
    frame.srcdoc = pages.get(name).replace(/<\/body>/, () => `${FOLLOW}${at}</body>`);
  };
  select.onchange = () => open(select.value);
  onmessage = ({ source: from, data }) => { if (from === frame.contentWindow && pages.has(data?.page)) open(data.page, data.place); };
  // The device, where there is one, is what one looks for.
  open([...pages.keys()].find((name) => name !== "index.html") ?? "index.html");
  draw(command(...parameters), element("p", { class: "row" }, element("label", {}, `${say("page")} `, select)), frame, messages(result.err));
};

// ---- Compare ----

const showCompare = async (file, draw) => {
  const others = files.filter((one) => one !== file && isDictionary(one));
  if (!isDictionary(file)) return draw(paragraph(say("not_here")));
  if (!others.length) return draw(paragraph(say("compare_first")));
  const other = element("select", { id: "other" }, ...others.map(({ name }) => element("option", {}, name)));
  const older = element("input", { type: "checkbox", id: "older", checked: true });
  const results = element("div", { id: "compared" });
  const compare = async () => {
    const pair = older.checked ? [other.value, file.name] : [file.name, other.value];
    results.replaceChildren(command("diff", ...pair));
    const result = await odgen("diff", ...pair);
    if (!result) return results.append(paragraph(say("cancelled")));
    if (result.failed) return results.append(broken(result));
    const markdown = async () => {
      const written = await odgen("diff", ...pair, "--format", "markdown");
      if (written) save(`${pair.join("-").replace(/[^\w-]+/g, "-")}.md`, written.out);
    };
    if (result.out) results.append(element("p", {}, button(say("markdown"), markdown)), element("pre", { class: "wrap", id: "changes" }, result.out));
    results.append(...[messages(result.err)].filter(Boolean));
  };
  draw(element("div", { class: "fields" }, field(say("compare_with"), other)),
    element("p", { class: "choices" }, element("label", {}, older, say("older"))),
    element("p", {}, button(say("compare"), compare, { class: "main", id: "compare" })), results);
};

// ---- Decode ----

const MOST_LINES = 5000;
const showDecode = async (file, draw) => {
  const traces = files.filter((one) => !isDictionary(one));
  if (!isDictionary(file)) return draw(paragraph(say("trace_here")));
  if (!traces.length) return draw(paragraph(say("decode_first")));
  const trace = element("select", { id: "trace" }, ...traces.map(({ name }) => element("option", {}, name)));
  const nodes = element("input", { id: "nodes", autocomplete: "off" });
  const results = element("div", { id: "decoded" });
  const decode = async () => {
    const parameters = ["decode", file.name, ...nodes.value.split(/[\s,;]+/).filter(Boolean).flatMap((node) => ["--node", node]), "--trace", trace.value];
    results.replaceChildren(command(...parameters));
    const result = await odgen(...parameters);
    if (!result) return results.append(paragraph(say("cancelled")));
    if (result.failed) return results.append(broken(result));
    const lines = result.out.split("\n");
    if (result.out) results.append(element("p", {}, button(say("download_text"), () => save(`${trace.value}.txt`, result.out), { id: "decode_save" })));
    if (lines.length > MOST_LINES) results.append(paragraph(say("shortened", MOST_LINES, lines.length - 1)));
    if (result.out) results.append(element("pre", { id: "frames", tabindex: 0 }, lines.slice(0, MOST_LINES).join("\n")));
    results.append(...[messages(result.err)].filter(Boolean));
  };
  draw(element("div", { class: "fields" }, field(say("trace"), trace), field(say("nodes"), nodes)),
    element("p", {}, button(say("decode"), decode, { class: "main", id: "decode" })), results);
};

// ---- Text ----

const PAUSE = 400;
const showEdit = async (file, draw) => {
  const bytes = file.bytes, text = new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes);
  // A text field has one kind of line ends.
  const isWindows = text.includes("\r\n"), plain = text.replaceAll("\r\n", "\n");
  const back = (one) => new TextEncoder().encode(isWindows ? one.replaceAll("\n", "\r\n") : one);
  const isKept = back(plain).length === bytes.length && back(plain).every((byte, at) => byte === bytes[at]);
  const download = element("p", {}, button(say("save"), () => save(file.name, file.bytes)));
  if (!isKept) return draw(paragraph(say("edit_encoding")), download, element("pre", { tabindex: 0 }, textOf(bytes)));
  const found = element("div", { id: "edit_findings" });
  const area = element("textarea", { class: "editor", id: "editor", "aria-label": say("text_of", file.name), spellcheck: "false", on: { value: plain } });
  const showFound = async () => {
    if (!isDictionary(file)) return;
    const result = file.check ?? await check(file);
    if (result) found.replaceChildren(...checked(file, result));
  };
  let timer;
  area.oninput = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      file.bytes = back(area.value);
      changed();
      showFound();
    }, PAUSE);
  };
  draw(paragraph(say("edit_what")), area, download, found);
  showFound();
};

// ---- The page ----

const applyLanguage = () => {
  document.documentElement.lang = language;
  byId("language").value = language;
  for (const one of document.querySelectorAll("[data-text]")) one.textContent = say(one.dataset.text);
  for (const one of document.querySelectorAll("[data-label]")) one.setAttribute("aria-label", say(one.dataset.label));
};
byId("language").onchange = ({ target }) => {
  language = target.value;
  for (const file of files) delete file.shown.convert;
  applyLanguage();
  showFiles();
  showViews();
  show();
};
byId("theme").onclick = () => {
  const { dataset } = document.documentElement;
  const isDark = dataset.theme ? dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  dataset.theme = isDark ? "light" : "dark";
};
byId("cancel").onclick = cancel;
byId("choose").onchange = ({ target }) => {
  take([...target.files]);
  target.value = "";
};
byId("new").onclick = async () => {
  const result = await odgen("new", "device");
  if (!result?.made.length) return;
  view = "edit";
  take(result.made.map(([path, bytes]) => new File([bytes], path)));
};
for (const kind of ["dragenter", "dragover"]) addEventListener(kind, (event) => { event.preventDefault(); byId("drop").classList.add("over"); });
for (const kind of ["dragleave", "drop"]) addEventListener(kind, () => byId("drop").classList.remove("over"));
addEventListener("drop", (event) => { event.preventDefault(); take([...event.dataTransfer.files]); });
applyLanguage();
start();
