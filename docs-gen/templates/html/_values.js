// Values of entries: as a reader writes them, as bytes on the bus, as quantities and in words. Whole numbers are BigInt and quantities are fractions, so that nothing is
// rounded.

// What is wrong with something that a reader wrote, in words.
class Mistake extends Error {}

const TYPES = new Map([[0x01, "boolean", 1], [0x09, "visible-string"], [0x0A, "octet-string"], [0x0B, "unicode-string"], [0x0C, "time-of-day", 48], [0x0D, "time-difference", 48], [0x0F, "domain"],
  ...[0x02, 0x03, 0x10, 0x04, 0x12, 0x13, 0x14, 0x15].map((code, at) => [code, "integer", 8 * (at + 1)]),
  ...[0x05, 0x06, 0x16, 0x07, 0x18, 0x19, 0x1A, 0x1B].map((code, at) => [code, "unsigned", 8 * (at + 1)]),
  [0x08, "real", 32], [0x11, "real", 64],
].map(([code, family, bits = 0]) => {
  const isNumbered = ["integer", "unsigned", "real"].includes(family);
  return [code, { family, bits, name: isNumbered ? `${family}${bits}` : family, isWhole: ["boolean", "integer", "unsigned"].includes(family) }];
}));

const hex = (number, digits = 1) => number.toString(16).toUpperCase().padStart(digits, "0");
const hexBytes = (bytes) => bytes.map((byte) => hex(byte, 2)).join(" ");
// Bytes least significant first, as they are on the bus.
const bytesOf = (raw, size) => Array.from({ length: size }, (_, at) => Number(BigInt.asUintN(8, raw >> BigInt(8 * at))));
const numberOf = (bytes) => bytes.reduceRight((sum, byte) => sum << 8n | BigInt(byte), 0n);
// The digits that a type of so many bits has.
const pattern = (raw, bits) => `${hex(BigInt.asUintN(bits, raw), Math.ceil(bits / 4))}h`;

// ---- Fractions: a numerator and a positive denominator.
const divisor = (a, b) => (b === 0n ? a : divisor(b, a % b));
const fraction = (upper, lower) => {
  const [up, low] = lower < 0n ? [-upper, -lower] : [upper, lower], common = divisor(up < 0n ? -up : up, low);
  return [up / common, low / common];
};
const plus = ([a, b], [c, d]) => fraction(a * d + c * b, b * d);
const minus = (one, [c, d]) => plus(one, [-c, d]);
const times = ([a, b], [c, d]) => fraction(a * c, b * d);
const over = ([a, b], [c, d]) => fraction(a * d, b * c);
const isSame = ([a, b], [c, d]) => a === c && b === d;
const ONE = [1n, 1n], ZERO = [0n, 1n], MOST_PLACES = 12;
// How many decimal places write a fraction exactly; -1 where none do, such as of a third.
const placesOf = ([, lower]) => Array.from({ length: MOST_PLACES + 1 }, (_, places) => places).find((places) => 10n ** BigInt(places) % lower === 0n) ?? -1;
const decimal = (one, places) => {
  const [scaled] = times(one, [10n ** BigInt(places), 1n]), sign = scaled < 0n ? "-" : "", digits = String(scaled < 0n ? -scaled : scaled).padStart(places + 1, "0");
  return sign + digits.slice(0, digits.length - places) + (places > 0 ? `.${digits.slice(-places)}` : "");
};
const fractionText = (one) => (placesOf(one) < 0 ? `${one[0]}/${one[1]}` : decimal(one, placesOf(one)));
// The fraction that a decimal number is, with or without an exponent.
const fractionOf = (text) => {
  const parts = /^([-+]?)(\d+)(?:\.(\d+))?(?:e([-+]?\d{1,3}))?$/i.exec(text);
  if (!parts) return null;
  const [, sign, digits, places = "", power = "0"] = parts, exponent = Number(power) - places.length;
  const whole = BigInt(digits + places) * (sign === "-" ? -1n : 1n);
  return exponent < 0 ? fraction(whole, 10n ** BigInt(-exponent)) : [whole * 10n ** BigInt(exponent), 1n];
};

// ---- Numbers in IEEE 754.
const realBytes = (number, bits) => {
  const view = new DataView(new ArrayBuffer(bits / 8));
  if (bits === 32) view.setFloat32(0, number, true); else view.setFloat64(0, number, true);
  return [...new Uint8Array(view.buffer)];
};
const realOf = (bytes) => {
  const view = new DataView(Uint8Array.from(bytes).buffer);
  return bytes.length === 4 ? view.getFloat32(0, true) : view.getFloat64(0, true);
};
// The fewest digits that name the number, with a point also where it is whole.
const realText = (number, bits) => {
  const digitsOf = (precision) => number.toExponential(precision);
  const enough = bits === 32 ? Array.from({ length: 9 }, (_, at) => digitsOf(at)).find((text) => Math.fround(Number(text)) === number) ?? digitsOf(8) : number.toExponential();
  const [digits, exponent] = enough.split("e"), power = Number(exponent), size = Math.abs(number);
  if (size >= 1e16 || (size !== 0 && size < 1e-4)) return `${digits}e${power}`;
  const sign = Object.is(number, -0) || number < 0 ? "-" : "", all = digits.replace(/[-.]/g, "");
  const whole = power < 0 ? "0" : all.slice(0, power + 1).padEnd(power + 1, "0"), rest = power < 0 ? "0".repeat(-power - 1) + all : all.slice(power + 1);
  return `${sign}${whole}.${rest || "0"}`;
};

// ---- Times: milliseconds since midnight in 28 bits, and days from the 17th byte on, counted from 1 January 1984 for a TIME_OF_DAY.
const DAY = 86400000, FIRST_DAY = Date.UTC(1984, 0, 1);
const timeText = (bytes, family) => {
  const milliseconds = Number(numberOf(bytes.slice(0, 4)) & 0xFFFFFFFn), days = Number(numberOf(bytes.slice(4)));
  const two = (number) => String(number).padStart(2, "0");
  const clock = `${two(Math.floor(milliseconds / 3600000))}:${two(Math.floor(milliseconds / 60000) % 60)}:${two(Math.floor(milliseconds / 1000) % 60)}.${String(milliseconds % 1000).padStart(3, "0")}`;
  return family === "time-of-day" ? `${new Date(FIRST_DAY + days * DAY).toISOString().slice(0, 10)} ${clock}` : `${days} d ${clock}`;
};
const timeBytes = (text, family) => {
  const parts = /^(?:(\d{4}-\d\d-\d\d)|(\d{1,5}) ?d) +(\d\d):(\d\d)(?::(\d\d)(?:\.(\d{1,3}))?)?$/.exec(text.trim());
  if (!parts || (family === "time-of-day") !== (parts[1] !== undefined)) return null;
  const [, date, count, hours, minutes, seconds = "0", rest = "0"] = parts;
  const days = date ? (Date.parse(`${date}T00:00:00Z`) - FIRST_DAY) / DAY : Number(count);
  // A day that its month does not have is another one to the script.
  if (date && new Date(FIRST_DAY + days * DAY).toISOString().slice(0, 10) !== date) return null;
  if (!(days >= 0 && days <= 0xFFFF && Number(hours) < 24 && Number(minutes) < 60 && Number(seconds) < 60)) return null;
  const milliseconds = ((Number(hours) * 60 + Number(minutes)) * 60 + Number(seconds)) * 1000 + Number(rest.padEnd(3, "0"));
  return [...bytesOf(BigInt(milliseconds), 4), ...bytesOf(BigInt(days), 2)];
};

// A number with the symbol of its unit; signs of plane angle follow it directly.
const withSymbol = (amount, { symbol }) => `${amount}${/^[°′″]$/.test(symbol) ? "" : " "}${symbol}`;

// ---- The entries of a device.
class Values {
  constructor(data) {
    Object.assign(this, data);
    this.words = Object.fromEntries(data.phrases);
    this.abortTexts = new Map(data.aborts);
    this.units = data.scales.map(([symbol, [scale, scaleLower, offset, offsetLower]]) => ({
      symbol, scale: [BigInt(scale), BigInt(scaleLower)], offset: [BigInt(offset), BigInt(offsetLower)],
    }));
    this.objects = new Map(data.lines.filter(Boolean).map(([index, list]) => [index, list]));
  }

  phrase(key, ...parts) {
    return this.words[key].replace(/\{(\d)\}/g, (_, number) => parts[number - 1]);
  }

  entriesOf(index) {
    return (this.objects.get(index) ?? []).map((line) => this.read(index, line));
  }

  entry(index, sub) {
    const line = this.objects.get(index)?.find(([number]) => number === sub);
    return line ? this.read(index, line) : null;
  }

  read(index, [sub, code, rights = 0, rust = "", c = "", st = "", unit = 0, named = 0, initial = 0, low = "", high = "", special = [], part = ""]) {
    const type = TYPES.get(code), value = ([raw, name = "", unsupported = 0]) => ({ raw: BigInt(raw), name, isSupported: !unsupported });
    const { bits = null, values = null } = this.named_types[named - 1] ?? {};
    return {
      index, sub, type, part, initial, names: { rust, c, st }, unit: this.units[unit - 1] ?? null, low, high, special: special.map(value),
      isReadable: Boolean(rights & 1), isWritable: Boolean(rights & 2), isMappable: Boolean(rights & 12), isLocked: Boolean(rights & 16), isConditional: Boolean(rights & 32),
      values: values?.map(value) ?? null,
      fields: bits?.map(([first = 0, last = 0, name = "", usage = "used", inverted = 0, known = [], modes = []]) => ({
        first, last, name, usage: usage || "used", isActiveAt0: Boolean(inverted), values: known.map(value), modes,
      })) ?? null,
    };
  }

  size({ type }) {
    return type.bits ? Math.ceil(type.bits / 8) : null;
  }

  // The default of an entry, for a node where it depends on one; nothing where there is none.
  initial({ initial, type }, node) {
    if (initial === 0) return null;
    if (!initial.startsWith("$")) return initial.match(/../g)?.map((digits) => parseInt(digits, 16)) ?? [];
    return node === null ? null : bytesOf(BigInt(`0x${initial.slice(1)}`) + BigInt(node), Math.ceil(type.bits / 8));
  }

  // The raw number of bytes; nothing where the type has no number of these.
  raw({ type }, bytes) {
    if (!type.isWhole || bytes.length !== Math.ceil(type.bits / 8)) return null;
    const number = numberOf(bytes);
    if (type.family === "boolean") return number > 1n ? null : number;
    return type.family === "integer" ? BigInt.asIntN(type.bits, number) : number;
  }

  isHexadecimal({ index, type, fields, values, unit }) {
    return fields !== null || (values === null && type.name === "unsigned32" && unit === null && index >= 0x1000 && index <= 0x1FFF);
  }

  // As the page writes a number with a decimal point.
  pointed(text) {
    return text.replace(".", this.decimal_sign);
  }

  // The amount of a raw number in its unit; where no decimal writes it, the formula.
  amount({ scale, offset }, raw) {
    const places = [scale, offset].map(placesOf);
    if (places.includes(-1)) return this.pointed(`${raw} × ${fractionText(scale)}${isSame(offset, ZERO) ? "" : ` + ${fractionText(offset)}`}`);
    return this.pointed(decimal(plus(times([raw, 1n], scale), offset), Math.max(...places)));
  }

  isPlain({ scale, offset }) {
    return isSame(scale, ONE) && isSame(offset, ZERO);
  }

  numberText({ type }, raw, isPattern) {
    return isPattern ? pattern(raw, type.bits) : String(raw);
  }

  specialText(entry, { raw, name }) {
    const { type, fields } = entry, isFull = type.bits >= 8 && raw >> BigInt(type.bits - 8) === 0xFFn;
    return `${this.numberText(entry, raw, fields !== null || (type.family === "unsigned" && (raw > 0xFFFFn || isFull)))} (${name})`;
  }

  enumText(entry, raw) {
    const { type, values } = entry, readsAlike = (raw >= 0n && raw < 10n) || (type.family === "integer" && raw >= 0n);
    const number = readsAlike ? String(raw) : `${raw} (${pattern(raw, type.bits)})`, known = values.find((value) => value.raw === raw);
    return known ? `${number}: ${known.name}` : number;
  }

  realWords({ type, unit }, number) {
    const text = realText(number, type.bits), shown = this.pointed(text);
    if (!unit) return shown;
    if (this.isPlain(unit)) return withSymbol(shown, unit);
    const exact = plus(times(fractionOf(text), unit.scale), unit.offset), places = placesOf(exact);
    return places < 0 ? shown : `${withSymbol(this.pointed(decimal(exact, Math.max(places, 1))), unit)} (${shown})`;
  }

  // Bytes in words, as the tables of the page have them; nothing where they are no value of the type.
  text(entry, bytes) {
    const { type, unit } = entry, raw = this.raw(entry, bytes);
    if (raw !== null) {
      const special = entry.special.find((value) => value.raw === raw);
      if (special) return this.specialText(entry, special);
      if (type.family === "boolean") return String(raw);
      if (entry.values) return this.enumText(entry, raw);
      if (unit && !this.isHexadecimal(entry)) return withSymbol(this.amount(unit, raw), unit) + (this.isPlain(unit) ? "" : ` (${raw})`);
      if (entry.part === "mapping" && type.bits === 32) return `${hex(raw >> 16n, 4)} ${hex(raw >> 8n & 0xFFn, 2)} ${hex(raw & 0xFFn, 2)}h`;
      return this.numberText(entry, raw, this.isHexadecimal(entry));
    }
    if (type.isWhole || (type.bits && bytes.length !== type.bits / 8)) return null;
    if (type.family === "real") return Number.isFinite(realOf(bytes)) ? this.realWords(entry, realOf(bytes)) : null;
    if (type.family.startsWith("time")) return timeText(bytes, type.family);
    // An empty text is shown by its quotation marks.
    return this.isText(type) ? this.string(type, bytes) || (bytes.length === 0 ? '""' : null) : hexBytes(bytes);
  }

  isText({ family }) {
    return family === "visible-string" || family === "unicode-string";
  }

  string({ family }, bytes) {
    if (family === "unicode-string" && bytes.length % 2) return null;
    try { return new TextDecoder(family === "visible-string" ? "utf-8" : "utf-16le", { fatal: true, ignoreBOM: true }).decode(Uint8Array.from(bytes)); }
    catch { return null; }
  }

  // Why the device would not take bytes; nothing where it does.
  refusal(entry, bytes) {
    const { type, low, high } = entry, raw = this.raw(entry, bytes);
    if (this.text(entry, bytes) === null) return this.phrase("no_value", type.name);
    if (type.family === "visible-string" && /[^ -~]/.test(this.string(type, bytes).replace(/\0+$/, ""))) return this.phrase("not_visible");
    if (type.family.endsWith("string")) return high !== "" && bytes.length > Number(high) ? this.phrase("too_long", high) : "";
    const isReal = type.family === "real", isListed = raw !== null && entry.special.some((value) => value.raw === raw);
    if ((!isReal && raw === null) || isListed) return "";
    const number = isReal ? realOf(bytes) : raw, kept = (limit) => (isReal ? realOf(realBytes(Number(limit), type.bits)) : BigInt(limit));
    if (low !== "" && number < kept(low)) return this.phrase("too_low", this.limitText(entry, low));
    if (high !== "" && number > kept(high)) return this.phrase("too_high", this.limitText(entry, high));
    return entry.values && !entry.values.some((value) => value.raw === raw && value.isSupported) ? this.phrase("not_listed") : "";
  }

  limitText(entry, limit) {
    return this.text({ ...entry, special: [] }, entry.type.family === "real" ? realBytes(Number(limit), entry.type.bits) : bytesOf(BigInt(limit), this.size(entry)));
  }

  // ---- From what a reader writes to bytes.
  // `569`, `0x239`, `239h`, `16#239`, `0b10`, `2#10`, or the name of a value.
  parseWhole(entry, text) {
    const { type } = entry, name = text.trim().toLowerCase(), known = [...entry.special, ...entry.values ?? []].filter((value) => value.name.toLowerCase() === name);
    if (known.length === 1) return bytesOf(known[0].raw, this.size(entry));
    const digits = text.replace(/[\s_]/g, "").replace(/^\u2212/, "-");
    const [, hexadecimal] = /^(?:0x|16#)([0-9a-f]+)$/i.exec(digits) ?? /^([0-9a-f]+)h$/i.exec(digits) ?? [], [, binary] = /^(?:0b|2#)([01]+)$/i.exec(digits) ?? [];
    if (hexadecimal) return this.parsePattern(entry, hexadecimal);
    if (binary) return this.fitting(entry, BigInt(`0b${binary}`), true);
    if (!/^[-+]?\d+$/.test(digits)) throw new Mistake(this.phrase("no_number"));
    return this.fitting(entry, BigInt(digits.replace("+", "")), false, type);
  }

  // Hexadecimal digits are the bits of the value: of a signed type the highest one is the sign.
  parsePattern(entry, text) {
    const digits = text.replace(/[\s_]/g, "").replace(/^0x|h$/gi, "");
    if (!/^[0-9a-f]+$/i.test(digits)) throw new Mistake(this.phrase("no_number"));
    return this.fitting(entry, BigInt(`0x${digits}`), true);
  }

  fitting({ type }, number, isPattern) {
    const whole = BigInt(type.bits), isSigned = type.family === "integer" && !isPattern;
    const [low, high] = isSigned ? [-(1n << (whole - 1n)), (1n << (whole - 1n)) - 1n] : [0n, (1n << whole) - 1n];
    if (number < low || number > high) throw new Mistake(this.phrase("no_value", type.name));
    return bytesOf(number, Math.ceil(type.bits / 8));
  }

  // A number as the page writes it: no other decimal sign, as it could mean thousands.
  parseDecimal(text) {
    const sign = this.decimal_sign, other = sign === "." ? "," : ".", digits = text.trim().replace(/^\u2212/, "-");
    if (digits.includes(other)) throw new Mistake(this.phrase("decimal_sign", sign));
    const number = fractionOf(digits.replace(sign, "."));
    if (!number) throw new Mistake(this.phrase("no_number"));
    return number;
  }

  parseReal({ type }, text) {
    this.parseDecimal(text);
    const number = Number(text.trim().replace(/^\u2212/, "-").replace(this.decimal_sign, ".")), bytes = realBytes(number, type.bits);
    if (!Number.isFinite(realOf(bytes))) throw new Mistake(this.phrase("no_value", type.name));
    return bytes;
  }

  parseQuantity(entry, text) {
    const { unit } = entry, number = text.trim().endsWith(unit.symbol) ? text.trim().slice(0, -unit.symbol.length) : text;
    const [steps, part] = over(minus(this.parseDecimal(number), unit.offset), unit.scale);
    if (part === 1n) return this.fitting(entry, steps, false);
    const below = steps / part - (steps < 0n ? 1n : 0n), nearest = [below, below + 1n].map((raw) => this.amount(unit, raw));
    throw new Mistake(this.phrase("between_steps", ...nearest.map((amount) => withSymbol(amount, unit))));
  }

  parseBytes(entry, text) {
    const digits = text.replace(/[\s,;]|0x/gi, ""), size = this.size(entry);
    if (!/^([0-9a-f]{2})*$/i.test(digits)) throw new Mistake(this.phrase("no_bytes"));
    const bytes = digits.match(/../g)?.map((byte) => parseInt(byte, 16)) ?? [];
    if (size !== null && bytes.length !== size) throw new Mistake(this.phrase("bytes_needed", size));
    return bytes;
  }

  // What a reader writes as a value.
  parse(entry, text) {
    const { family, name } = entry.type;
    if (entry.type.isWhole) return this.parseWhole(entry, text);
    if (family === "real") return this.parseReal(entry, text);
    if (family === "visible-string") return [...new TextEncoder().encode(text)];
    if (family === "unicode-string") return [...text].flatMap((sign) => Array.from({ length: sign.length }, (_, at) => bytesOf(BigInt(sign.charCodeAt(at)), 2))).flat();
    const time = timeBytes(text, family);
    if (!time) throw new Mistake(this.phrase("no_value", name));
    return time;
  }

  // The value as it is written in its own field.
  written(entry, bytes) {
    const { family, bits } = entry.type;
    if (entry.type.isWhole) return String(this.raw(entry, bytes) ?? "");
    if (family === "real") return Number.isFinite(realOf(bytes)) ? this.pointed(realText(realOf(bytes), bits)) : "";
    return (this.isText(entry.type) ? this.string(entry.type, bytes) : this.text(entry, bytes)) ?? "";
  }

  // ---- What else a number says.
  fieldName({ name, first, last }) {
    if (name) return name;
    return first === last ? this.phrase("bit", first) : this.phrase("bit_range", first, last);
  }

  fieldValue({ first, last }, raw) {
    return BigInt.asUintN(last - first + 1, raw >> BigInt(first));
  }

  // The fields that are not 0, each with the name of its value.
  setFields({ fields }, raw) {
    return fields.filter((field) => this.fieldValue(field, raw) !== 0n).map((field) => {
      const value = this.fieldValue(field, raw), known = field.values.find((one) => one.raw === value);
      return field.first === field.last ? this.fieldName(field) : `${this.fieldName(field)} = ${value}${known ? ` ${known.name}` : ""}`;
    });
  }

  // States that the bits show, and commands that they give; a bit that has to change is meant as it is then.
  machineLines({ index, sub, type }, raw) {
    const isAt = ([one, other]) => one === index && other === sub, bits = BigInt.asUintN(type.bits, raw);
    const fits = ([signs]) => [...signs].reverse().every((sign, at) => sign === "x" || (bits >> BigInt(at) & 1n) === BigInt(sign === "1" || sign === "r"));
    const edges = ([signs]) => [...signs].reverse().flatMap((sign, at) => ({ r: [this.phrase("edge", at, "0→1")], f: [this.phrase("edge", at, "1→0")] })[sign] ?? []);
    return this.machines.flatMap(({ status, command, states, commands }) => [
      ...(isAt(status) ? states.filter(fits).map(([, name]) => this.phrase("state", name)) : []),
      ...(isAt(command) ? commands.filter(fits).map((one) => [this.phrase("command", one[1]), ...edges(one)].join(", ")) : []),
    ]);
  }

  // The parts of a COB-ID (CiA 301 7.5.2).
  cobIdLines({ part }, raw) {
    const has = (bit) => (raw >> BigInt(bit) & 1n) === 1n, id = has(29) ? pattern(raw & 0x1FFFFFFFn, 32) : `${hex(raw & 0x7FFn, 3)}h`;
    const lines = [this.phrase(has(29) ? "can_id_29" : "can_id", id)];
    if (part === "sync") lines.push(this.phrase(has(30) ? "produces" : "produces_not"));
    else if (part === "time") lines.push(this.phrase(has(31) ? "consumes" : "consumes_not"), this.phrase(has(30) ? "produces" : "produces_not"));
    else lines.push(this.phrase(has(31) ? "off" : "valid"));
    if (part === "tpdo") lines.push(this.phrase(has(30) ? "no_remote" : "remote"));
    return lines;
  }
}
