// Runs the command odgen, compiled to WebAssembly, on files in memory: it asks for files, arguments and output as programs do everywhere (WASI preview 1), and gets
// them from here. Each run starts anew, so that one that fails or is cancelled leaves nothing.

// Numbers of WASI.
const OK = 0, BAD_FILE = 8, EXISTS = 20, INVALID = 28, IS_FOLDER = 31, NOT_THERE = 44, NOT_KNOWN = 52, NO_FOLDER = 54, NOT_EMPTY = 55;
const FOLDER = 3, FILE = 4;
const CREATE = 1, MUST_BE_FOLDER = 2, MUST_BE_NEW = 4, EMPTIED = 8, APPEND = 1;

// How a run ends that says so itself.
class Exit { constructor(code) { this.code = code; } }

// A file grows by doubling the room that it has.
class Contents {
  constructor(bytes) { this.room = bytes; this.size = bytes.length; }
  bytes() { return this.room.subarray(0, this.size); }
  write(at, bytes) {
    const end = at + bytes.length;
    if (end > this.room.length) {
      const room = new Uint8Array(Math.max(end, 2 * this.room.length, 4096));
      room.set(this.bytes());
      this.room = room;
    }
    this.room.set(bytes, at);
    this.size = Math.max(this.size, end);
  }
}

// A run of the program with these arguments, in a folder with these files: its exit code, what it printed, and the files that it made or changed.
const run = (program, parameters, inputs) => {
  const files = new Map(inputs.map(([name, bytes]) => [name, new Contents(bytes)])), folders = new Set([""]);
  const written = new Set(), out = new Contents(new Uint8Array()), err = new Contents(new Uint8Array());
  const open = new Map([[0, { contents: new Contents(new Uint8Array()), at: 0 }], [1, { contents: out, at: 0 }], [2, { contents: err, at: 0 }], [3, { folder: "" }]]);
  let next = 4, memory;
  const view = () => new DataView(memory.buffer);
  const bytesAt = (at, length) => new Uint8Array(memory.buffer, at, length);
  const encoder = new TextEncoder(), decoder = new TextDecoder();

  // A path from the root, without steps that lead nowhere.
  const path = (file, at, length) => {
    const parts = open.get(file).folder.split("/");
    for (const part of decoder.decode(bytesAt(at, length)).split("/")) {
      if (part === "..") parts.pop(); else if (part !== ".") parts.push(part);
    }
    return parts.filter(Boolean).join("/");
  };
  const parent = (name) => name.slice(0, Math.max(name.lastIndexOf("/"), 0));
  const inside = (folder) => [...folders, ...files.keys()].filter((name) => name !== "" && parent(name) === folder);
  const kind = (name) => (folders.has(name) ? FOLDER : files.has(name) ? FILE : undefined);
  const describe = (at, type, size) => {
    bytesAt(at, 64).fill(0);
    view().setUint8(at + 16, type);
    view().setBigUint64(at + 24, 1n, true);
    view().setBigUint64(at + 32, BigInt(size), true);
    return OK;
  };
  const pieces = (at, count) => Array.from({ length: count }, (_, one) => bytesAt(view().getUint32(at + 8 * one, true), view().getUint32(at + 8 * one + 4, true)));
  const list = (texts) => texts.map((text) => encoder.encode(`${text}\0`));
  const args = list(["odgen", ...parameters]);
  const size = (texts, count, total) => {
    view().setUint32(count, texts.length, true);
    view().setUint32(total, texts.reduce((sum, one) => sum + one.length, 0), true);
    return OK;
  };

  const known = {
    args_sizes_get: (count, total) => size(args, count, total),
    args_get: (places, at) => {
      args.forEach((text, one) => {
        view().setUint32(places + 4 * one, at, true);
        bytesAt(at, text.length).set(text);
        at += text.length;
      });
      return OK;
    },
    environ_sizes_get: (count, total) => size([], count, total),
    environ_get: () => OK,
    random_get: (at, length) => {
      for (let done = 0; done < length; done += 65536) crypto.getRandomValues(bytesAt(at + done, Math.min(65536, length - done)));
      return OK;
    },
    clock_time_get: (_, _precision, at) => { view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true); return OK; },
    sched_yield: () => OK,
    proc_exit: (code) => { throw new Exit(code); },

    fd_prestat_get: (file, at) => {
      if (file !== 3) return BAD_FILE;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return OK;
    },
    fd_prestat_dir_name: (_, at) => { bytesAt(at, 1)[0] = 0x2f; return OK; },
    fd_fdstat_get: (file, at) => {
      const one = open.get(file);
      if (!one) return BAD_FILE;
      bytesAt(at, 24).fill(0);
      view().setUint8(at, one.contents ? FILE : FOLDER);
      // All rights.
      view().setBigUint64(at + 8, 0x1fffffffn, true);
      view().setBigUint64(at + 16, 0x1fffffffn, true);
      return OK;
    },
    fd_filestat_get: (file, at) => {
      const one = open.get(file);
      return one ? describe(at, one.contents ? FILE : FOLDER, one.contents?.size ?? 0) : BAD_FILE;
    },
    fd_close: (file) => (open.delete(file) ? OK : BAD_FILE),
    fd_sync: () => OK,
    fd_read: (file, at, count, done) => {
      const one = open.get(file);
      if (!one?.contents) return BAD_FILE;
      let read = 0;
      for (const piece of pieces(at, count)) {
        const part = one.contents.bytes().subarray(one.at, one.at + piece.length);
        piece.set(part);
        one.at += part.length;
        read += part.length;
      }
      view().setUint32(done, read, true);
      return OK;
    },
    fd_write: (file, at, count, done) => {
      const one = open.get(file);
      if (!one?.contents) return BAD_FILE;
      let wrote = 0;
      if (one.name) written.add(one.name);
      for (const piece of pieces(at, count)) {
        if (one.appends) one.at = one.contents.size;
        one.contents.write(one.at, piece);
        one.at += piece.length;
        wrote += piece.length;
      }
      view().setUint32(done, wrote, true);
      return OK;
    },
    fd_seek: (file, by, from, at) => {
      const one = open.get(file);
      if (!one?.contents) return BAD_FILE;
      const to = [0, one.at, one.contents.size][from] + Number(by);
      if (!(to >= 0)) return INVALID;
      one.at = to;
      view().setBigUint64(at, BigInt(to), true);
      return OK;
    },
    fd_readdir: (file, at, room, cookie, used) => {
      const { folder } = open.get(file) ?? {};
      if (folder === undefined) return NO_FOLDER;
      let filled = 0;
      for (const [one, name] of [...inside(folder).entries()].slice(Number(cookie))) {
        const text = encoder.encode(name.slice(folder && folder.length + 1)), entry = new Uint8Array(24 + text.length), fields = new DataView(entry.buffer);
        fields.setBigUint64(0, BigInt(one + 1), true);
        fields.setUint32(16, text.length, true);
        fields.setUint8(20, kind(name));
        entry.set(text, 24);
        const part = entry.subarray(0, room - filled);
        bytesAt(at + filled, part.length).set(part);
        filled += part.length;
        if (filled === room) break;
      }
      view().setUint32(used, filled, true);
      return OK;
    },

    path_open: (from, _, at, length, how, _rights, _inherited, flags, opened) => {
      const name = path(from, at, length);
      const is = kind(name);
      if (is === undefined && !(how & CREATE)) return NOT_THERE;
      if (is !== undefined && how & MUST_BE_NEW) return EXISTS;
      if (is === FILE && how & MUST_BE_FOLDER) return NO_FOLDER;
      if (is === FOLDER && how & (CREATE | EMPTIED)) return IS_FOLDER;
      if (is === undefined && kind(parent(name)) !== FOLDER) return NOT_THERE;
      if (is === undefined || how & EMPTIED) {
        files.set(name, new Contents(new Uint8Array()));
        written.add(name);
      }
      open.set(next, is === FOLDER ? { folder: name } : { name, contents: files.get(name), at: 0, appends: flags & APPEND });
      view().setUint32(opened, next++, true);
      return OK;
    },
    path_filestat_get: (from, _, at, length, to) => {
      const name = path(from, at, length), is = kind(name);
      return is === undefined ? NOT_THERE : describe(to, is, files.get(name)?.size ?? 0);
    },
    // There are no links.
    path_readlink: (from, at, length) => (kind(path(from, at, length)) === undefined ? NOT_THERE : INVALID),
    path_create_directory: (from, at, length) => {
      const name = path(from, at, length);
      if (kind(name) !== undefined) return EXISTS;
      if (kind(parent(name)) !== FOLDER) return NOT_THERE;
      folders.add(name);
      return OK;
    },
    path_remove_directory: (from, at, length) => {
      const name = path(from, at, length);
      if (inside(name).length) return NOT_EMPTY;
      return folders.delete(name) ? OK : NOT_THERE;
    },
    path_unlink_file: (from, at, length) => {
      const name = path(from, at, length);
      written.delete(name);
      return files.delete(name) ? OK : NOT_THERE;
    },
    path_rename: (from, at, length, to, newAt, newLength) => {
      const name = path(from, at, length), renamed = path(to, newAt, newLength);
      if (kind(name) !== FILE) return NOT_THERE;
      if (kind(renamed) === FOLDER) return IS_FOLDER;
      files.set(renamed, files.get(name));
      files.delete(name);
      written.delete(name);
      written.add(renamed);
      return OK;
    },
  };
  const imports = Object.fromEntries(WebAssembly.Module.imports(program).map(({ name }) => [name, known[name] ?? (() => NOT_KNOWN)]));
  const { exports } = new WebAssembly.Instance(program, { wasi_snapshot_preview1: imports });
  memory = exports.memory;
  const result = { code: 0, failed: "" };
  try {
    exports._start();
  } catch (error) {
    if (error instanceof Exit) result.code = error.code; else result.failed = String(error);
  }
  const text = (contents) => decoder.decode(contents.bytes());
  const made = [...written].filter((name) => files.has(name)).sort().map((name) => [name, files.get(name).bytes().slice()]);
  return { ...result, out: text(out), err: text(err), made };
};

let program;
addEventListener("message", async ({ data }) => {
  if (data.packed) {
    const unpacked = new Response(new Blob([data.packed]).stream().pipeThrough(new DecompressionStream("gzip")));
    program = unpacked.arrayBuffer().then((bytes) => WebAssembly.compile(bytes));
    program.catch(() => {});
    return;
  }
  let result;
  try {
    result = run(await program, data.parameters, data.inputs);
  } catch (error) {
    result = { code: 0, failed: String(error), out: "", err: "", made: [] };
  }
  postMessage(result);
});
