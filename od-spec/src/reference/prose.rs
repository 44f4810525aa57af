//! The paragraphs and word tables of the language reference.

pub(super) const INTRODUCTION: &str = r#"# The specification language

<!-- Printed by `cargo xtask generate` from the tables by which the compiler reads specifications. Do not edit. -->

A specification is one YAML file, `NAME.od.yaml`, that describes the CANopen object dictionaries of one device or of several that
belong together: their objects with types, units, limits and defaults, their PDOs and error codes, the state machines behind control
and status words, and, if wanted, the printed manual's tables. The compiler reads it, checks it, and makes EDS, DCF, JSON and Rust files
from it.

This is a complete specification of a small I/O module:

```yaml
od-spec: 1
title: I/O module
vendor: {name: Example Ltd}
uses: [cia301]                                  # the library of the standard objects, 1000h to 1FFFh
devices:
  io:
    name: I/O module
    bit-rates: [125, 250, 500, 1000]
    features: [heartbeat producer, emergency, store parameters]
units:
  decivolt: {symbol: V, scale: 1/10}            # one raw step is 0.1 V
types:
  output mode: {base: unsigned8, values: {0: off, 1: on, 2: automatic}}
  module status: {base: unsigned8, bits: {0: ready, 1: overload, 2..7: reserved}}
objects:
  0x2000: {name: status, type: module status, access: ro, pdo: transmit}
  0x2001: {name: mode, type: output mode, access: rw, pdo: receive, default: automatic}
  0x2010:                                       # an ARRAY: sub-indices 1 to 4 are `input 1` to `input 4`
    name: input voltage
    array: {count: 4, name: "input {n}", type: integer32, unit: decivolt, access: ro}
  0x2020:                                       # a RECORD: the members take what stands at the object
    name: supply
    type: unsigned16
    unit: decivolt
    access: rw
    stored: application
    record:
      1: {name: lower limit, default: 18.0 V}
      2: {name: upper limit, default: 30.0 V, max: 36.0 V}
  0x2030: {name: first input, alias: 0x2010.1, type: integer16, pdo: transmit}   # 2010h.1 in 16 bits
pdos:
  io:
    receive: {1: {map: [mode]}}
    transmit: {1: {map: [status, first input]}}
constraints:
  limits in order: {require: "0x2020.1 < 0x2020.2"}
```

The dictionary of this device holds more than is written. The library adds 1000h, 1001h and 1018h, which every device has, and the
objects of the named features. Sub-index 0 of 2010h and 2020h follows from what stands below it, and 1400h, 1600h, 1800h and 1A00h follow
from `pdos:`. Defaults are written as people read them, in volts or by name, and are checked: against their type, their limits, and the
constraint at the end.
"#;

pub(super) const READING: &str = r#"
A specification is one YAML document in UTF-8. The compiler reports every mistake of a file in one run, each with its place and a code;
`odgen explain OD0201` says more about a code. A key that the language does not have at a place is a mistake, and so is a key that stands
twice.

Every scalar is a text until the place where it stands says what it is. `name: no` is a name of two letters, `number: 1.10` keeps its
zero, `0x10` is a number where a number is expected and a text where a text is. Quotes change nothing about that; they are needed only where
YAML itself would misread a text: one that holds `: ` or ` #`, or starts with a sign such as `%`, `*`, `&`, `{`, `[`, `>` or a quote.

Names of objects, entries, bits, values and error codes are the same in every language, as other parts of the specification, EDS files
and generated code refer to them; descriptions are told by language.

| Value | Written as |
| --- | --- |
| text | any scalar, except an empty one, `~` and `null`, unless they are quoted |
| text by language | a map such as `{en: speed, de: Drehzahl}`; a plain text is in the first of the file's `languages:` |
| integer | decimal, or `0x`, `0b` or `0o` and digits, with `_` between digits and a sign if need be: `-40`, `0x1F`, `100_000`. A decimal number does not start with `0` |
| date; date and time | `2009-05-27`; `2009-05-27 09:00` |
| index or indices | an integer from 1 to 0xFFFF, or a run: `0x6040`, `0x3511..0x3519` |
| bit or bits | an integer from 0 to 63, or a run: `4`, `0..3` |
| error code or codes | a 16-bit integer, or a run: `0x3210`, `0x3281..0x3288` |
| entry | see [how entries are named](#how-entries-are-named) |
| access, type, value | see [an entry](#entry) |
| fraction | a positive number, or two with `/` between them: `1/10`, `0.01`, `5` |
| fraction and symbol | a fraction without blanks, a blank, a symbol: `1/1000 V` |
| condition | see [constraints](#constraint) |
| formula | one side of a comparison of a condition: `0x6092.1 / 0x6092.2` |
| bit pattern | 8, 16 or 32 places, most significant bit first: `0`, `1`, `x` (either), `r` (rising edge) or `f` (falling edge). Blanks are free: `xxxx xxxx x01x 0001` |

A list has to be a list even if it has one item, except where the tables say "or a list of such". A map whose keys are data, such as
`objects:`, may be left empty. Where keys are numbers, two spellings of one number are one key: `10` and `0x0A` cannot stand side by
side. YAML anchors and aliases (`&name`, `*name`) may repeat a value; merge keys (`<<`) and tags (`!name`) are refused.

Editors that know JSON Schema complete keys, show what they mean, and mark most misshapen values while a file is typed. The schema is
`od-spec/schema/od.schema.json`; for the language server of YAML, name it in the first line of the file:
`# yaml-language-server: $schema=PATH/od.schema.json`.
"#;

pub(super) const NAMING: &str = r"
Other parts of a specification refer to an entry by its index or by its name.

By index: `0x6064`, or `0x30FA.3` with a sub-index, which is decimal unless it starts with `0x`. Without a sub-index, sub-index 0 is
meant: the value of a VAR. An index may be decimal as well, so that hexadecimal ones need their `0x`: `6064` is 17B0h.

By name: `controlword` for an object, `dc-link voltage.nominal value` for an element or member: the object's name, a dot, its own name.
Case and blanks count. A text that starts with `0x`, or that consists of digits, dots and `_` only, is always an index.

[Conditions](#constraint) refer to entries by hexadecimal index only and may name another device before it: `pmc:0x6510.4`. At an
[erratum](#erratum), an index without sub-index means the whole object.
";

pub(super) const TOP: &str = r"
The keys may stand in any order. Lists, and the maps of devices and constraints, keep theirs.
";

pub(super) const DEVICES: &str = r"
A device supports at least one bit rate.

What is said here fills the objects that show it, unless these have a `default:` of their own: `device-type` 1000h, `product-name` 1008h,
the vendor's `number` 1018h.1, `product` 1018h.2 and `product-revision` 1018h.3. A number that is not given is 0. Only objects that the
device has are filled; see [features](#feature).

Placeholders (`dummies:`) are of the types `boolean`, `integer8`, `integer16`, `integer32`, `unsigned8`, `unsigned16` and `unsigned32`.
";

pub(super) const FILES: &str = r"
The dates of an EDS are these and never the day on which it is made, so that the same specification always gives the same file. Without
`eds:`, they are 2000-01-01 00:00.
";

pub(super) const UNITS: &str = r"
A unit says what a raw value means. With `decicelsius: {symbol: °C, scale: 1/10}`, the raw value 500 is 50.0 °C. With
`millivolt: {symbol: mV, base: 1/1000 V}`, 41000 mV may also be written as `41 V`. Units whose bases have one symbol convert into each
other, in [aliases](#aliases) and in [conditions](#constraint); a unit without `base:` has its own symbol as base. A physical value that
falls between two raw steps is refused, not rounded.

A raw step may be more than one: with `{symbol: mV, scale: 10, base: 1/1000 V}`, the raw value 3 is 30 mV.

A unit that the user sets up, such as a position unit made by gear and feed, has a `formula:` that tells how. Values in it are raw numbers all the same;
the documentation shows the formula with the names of its entries.
";

pub(super) const TYPES: &str = r"
A type has either `values:` or `bits:`, and an INTEGERn or UNSIGNEDn as base. Names are unique in a type. An entry whose type is an enum
has no other defaults and limits than the listed values.

A bit field says something about every bit of its base: bits that are neither listed nor covered by `rest:` are an error, and so are bits
that are listed twice.
";

pub(super) const BITS: &str = r"
A number as key of a run's `values:` is the value of the run, counted from its lowest bit.
";

pub(super) const OBJECTS: &str = r"
An object with `array:` is an ARRAY, one with `record:` a RECORD, one with `alias:` a view of another entry, and any other a VAR, or a
DOMAIN if it is of type `domain`. In a VAR the keys of the entry stand at the object itself.

Objects lie from 1000h to BFFFh. The PDO parameters, 1400h to 1BFFh, cannot be written here; they are made from [`pdos:`](#pdo).
The objects of a device have names of their own, and so have the entries of an object. As names go into EDS files, they have at most 241
characters and hold no `;`, `#` or `=`; characters outside ASCII are transliterated there. Default texts that an EDS shows and the texts of
its header hold none of these signs either.
";

pub(super) const INHERITANCE: &str = r"
Keys go down from the object to its elements and members: `type`, `unit`, `access`, `pdo`, `stored`, `writable-when` and `eds`. What stands
at `array:` goes before what stands at the object, and what stands at the single element or member goes before both. The elements of an
array also take every other key that stands at `array:`; its `name` is a pattern for theirs. A map, such as `eds:` or `special:`, is
taken as a whole.

`default`, `min` and `max` are about one value and are refused beside `array:` or `record:`. The other keys of an entry that do not go down
(`special`, `bit-errors`, `capacity`) have a meaning at a VAR only; `category`, `since` and `about` are about the object itself.

An array needs `count:` or `elements:`, and its elements are of one type.

Objects that are alike but for their number are written once, as a run of indices: `0x3511..0x3519: {name: 'input functions {n}', …}` makes nine
objects; in their `name` and `identifier`, and nowhere else, `{n}` stands for 1, 2, and so on, whatever the first index is. A run needs `{n}` in
its name.
";

pub(super) const SUB0: &str = r"
Sub-index 0 of an array or record is an UNSIGNED8. It takes nothing from its object.
";

pub(super) const ENTRIES: &str = r"
Every entry needs a name, a type and an access, of its own or from where it inherits.

The **type** is one of the data types {TYPES}, or the name of one of the [types](#type) of the file or its libraries.

The **access** is seen from the bus. `const` and `ro` can be read, `wo` can be written, `rw`, `rwr` and `rww` both. An entry that is `ro`,
`const` or `rwr` can be mapped with `pdo: transmit`, one that is `wo` or `rww` with `pdo: receive`, and one that is `rw` with any word.
Strings and domains cannot be mapped. `locked` follows the word of an access that allows writing: the device refuses a write unless it was
unlocked for service.

A **value**, of `default`, `min` or `max`, is written by the type of its entry:

| Type | Written as |
| --- | --- |
| INTEGERn, UNSIGNEDn | a raw number: `80`, `0x50`; negative ones as decimals, not as bit patterns |
| the same, with a unit | also a physical value: `50.0 °C`, in the unit's symbol or its base's |
| the same, of an enum | also a value's name: `automatic`; raw numbers have to be among the values |
| the same | also `$NODEID`, or `$NODEID + 0x180`: the node-ID and at most one number added to it, which has to fit for every node-ID |
| BOOLEAN | `yes`, `no`, `true`, `false`, `1` or `0` |
| REAL32, REAL64 | a decimal number |
| VISIBLE_STRING, UNICODE_STRING | the text; a VISIBLE_STRING holds printable ASCII characters |
| OCTET_STRING | pairs of hexadecimal digits, with or without blanks: `01 A1 05` |
| TIME_OF_DAY, TIME_DIFFERENCE, DOMAIN | nothing; there is no way to write such a value |

Only integers have limits. A default lies within them or is a special value.

How an entry is **stored**:

{STORAGE}

A `const` entry is not stored.

A string has the **capacity** that `capacity:` says, in bytes; an EDS does not show it. A constant needs none, as its length is that of its
default. Firmware that is generated from the specification needs the capacity of every other string, to set the memory aside.

Generated code takes its **identifiers** from the names: `actual velocity 16bit` becomes `actual_velocity_16bit`. Where that gives one name
to two things, or a name that the generated code needs itself, `identifier:` gives another; nothing is renamed silently.
";

pub(super) const STORAGE: &[(&str, &str)] = &[
    ("no", "it is lost at power-off"),
    ("communication", "saved with the communication parameters, 1010h.2"),
    ("application", "saved with the application parameters, 1010h.3"),
    ("manufacturer", "saved with parameters of the manufacturer's choice, 1010h.4 and above"),
    ("remanent", "kept over power-off by the device itself, without a command"),
];

pub(super) const SPECIAL: &str = r"
Special values stand beside the limits and do not move them: with `min: 0`, `max: 100` and `special: {255: off}`, the device takes 0 to
100 and 255. An EDS has no words for this; the limits written there are widened so far that they include the special values.
";

pub(super) const EDS: &str = r"
Without these keys, an EDS shows of an entry:

- its access; but a locked entry as `ro`, and an `rw` entry with `pdo: receive` or `pdo: transmit` as `rww` or `rwr`.
- its default; but the [device's policy](#device) `safe` withholds it from entries that can be written and are locked or stored as
  `application`, `manufacturer` or `remanent`. Some PLCs write every writable entry that has a default each time they start the device,
  and would undo what was set and stored in service. The policy `all` writes every default.
- the flag `no-write` if it is locked, else none. Flags given here are added to that.
";

pub(super) const ALIASES: &str = r"
An alias is a second view of an integer entry and has no storage of its own: `0x5064: {alias: 0x6064, type: integer16}` shows a 32-bit
position in 16 bits, so that more fits into a PDO. The view is a VAR of a narrower type with the same sign, or of a type that is no wider
but in another unit of the same base. The target is not an alias itself.

Access (with its lock), PDO mapping, unit and write condition are the target's unless given; limits are not. The name is the target's
with `16bit` behind it, unless given. With another `unit:`, values are rescaled.

`rounding:` says what a value between two steps becomes:

{ROUNDING}

`outside:` says what one becomes that the alias' type cannot hold:

{OUTSIDE}

An alias has neither `default:` nor `stored:`; its default is the target's, converted, if that is a number. In the EDS it is treated as
its target is: a view of a locked or stored entry keeps its default out of a `safe` EDS, and a view of an entry that tools must not write
carries `no-write`.
";

pub(super) const ROUNDING: &[(&str, &str)] = &[
    ("down", "the step below"),
    ("up", "the step above"),
    ("nearest", "the nearest step, halves away from zero"),
    ("zero", "the step nearer to zero"),
];

pub(super) const OUTSIDE: &[(&str, &str)] = &[
    ("saturate", "the nearest value that the alias can show"),
    ("wrap", "its low bits"),
    ("abort", "an SDO abort"),
];

pub(super) const USES: &str = r"
A library is a specification with `profile:` and without `uses:`. Two come with the compiler: `cia301` holds the objects of the
communication profile, `cia402` those of drives. Others are files, named by a path relative to the file that uses them. What a library gives are
its units, its types, its objects, its error codes and its state machines. A type is defined once in a file and its libraries; a unit may be
defined again if it is the same.

Objects of a library come into a device in two ways. A feature brings its objects just as the library defines them. An object of the
file's own with `from:` takes the library's object of the same index and changes it: each key that is written goes before the library's,
key by key also in `array:`, `sub0:` and the single elements and members; members that the library does not have are added, and those
under `omit:` are dropped. An object that names another shape (`record:` over an ARRAY) has that shape.

```yaml
objects:
  0x1003:
    from: cia301
    array: {count: 8}
  0x1018:
    from: cia301
    omit: [4]                                   # no serial number
```

An object of the file's own always goes before that of a feature, with `from:` or without.

What is written is the maker's word, what is taken from the library the standard's: the documentation tells the two apart, and
`odgen check --notes` lists the objects whose own facts depart from the library's. So a fact that a manual states is worth writing even where the
library says the same.

An error code with `from:` takes its name, priority, reaction and description from the library, as far as it does not give its own. A state
machine with `from:` takes the library's machine of the same name; its own states, transitions and commands go before the library's of the
same name or number, key by key.

```yaml
errors:
  0x2310: {from: cia402, about: The current at the output was too high for too long.}
state-machines:
  power drive system: {from: cia402}
```
";

pub(super) const FEATURES: &str = r"
A device has the features that its `features:` names, those they need, and those that are implied.

{FEATURES}

`odgen library cia301` prints a library, with the sub-indices, types, access and defaults of its objects. Which parameters outlive a power-off is
for the device to say: the libraries set no `stored:`, so that `0x1017: {from: cia301, stored: communication}` is yours to write where 1010h.2 saves
the heartbeat time; only the PDO parameters are stored without a word. Objects of profiles that have no library, such as CiA 401, are
written like objects of your own.
";

pub(super) const AXES: &str = r"
The objects between `first:` and `last:` are those of axis 1; axis 2 begins behind `last:`, and so on. `0x6864: {from: cia402}` takes 6064h for axis
2; without a name of its own it is called `Position actual value axis 2`. A feature of a further axis has the axis behind its name:
`features: [drive, homing mode, drive axis 2, homing mode axis 2]`.
";

pub(super) const PDOS: &str = r"
Mapped entries allow the direction with their `pdo:`, and have 64 bits or less together. A data type in `map:` is a placeholder; the device
lists it under `dummies:`, and only RPDOs have such.

Times are raw: `inhibit-time: 100` is 10 ms, `event-timer: 100` is 100 ms.

The parameter objects follow from this. RPDO *n* has its communication parameters at 1400h + *n* − 1 and its mapping at 1600h + *n* − 1,
TPDO *n* at 1800h and 1A00h. The communication parameters are sub-indices 1 (COB-ID) and 2 (transmission type), and 3 (inhibit time),
5 (event timer) and 6 (SYNC start value) if given. The COB-ID carries bit 31 if the PDO is not valid, and bit 30 with `no-rtr`. The mapping
has a sub-index for each entry that the device offers; those beyond `map:` are 0. Entries that can be written are stored with the
communication parameters; the entries of a fixed mapping cannot.

Without `cob-id:`, RPDOs 1 to 4 have $NODEID + 200h, 300h, 400h and 500h, TPDOs 1 to 4 $NODEID + 180h, 280h, 380h and 480h. A PDO from 5
on needs the key, unless it is not valid. Two valid PDOs of a device do not share a COB-ID, and identifiers that CiA 301 keeps for other
services are refused, for every node-ID.

Transmission types 241 to 251 are reserved, 252 and 253 are for TPDOs only. A device with granularity 0 has fixed mappings only, any
other that has PDOs has at least one that is variable.
";

pub(super) const ERRORS: &str = r"
A code has one meaning. Under a run such as `0x3281..0x3288`, every code gets the same facts; `{n}` in the name tells them apart.
";

pub(super) const MACHINES: &str = r"
A state machine gives names to patterns of a status word and of a control word. Patterns have as many places as the entry has bits, and
no value of the status entry shows two states at once. In a command, `r` and `f` stand for an edge and count as the level after it; the
value under `send:` has the bits that the pattern demands.
";

pub(super) const CONSTRAINTS: &str = r#"
A condition compares values; several comparisons are joined by `and` or chained:

```text
condition  = comparison { "and" comparison }
comparison = sum op sum { op sum }            op = "<" | "<=" | "==" | "!=" | ">=" | ">"
sum        = product { ("+" | "-") product }
product    = factor { ("*" | "/") factor }
factor     = number | reference | "bit" "(" reference "," number ")" | "(" sum ")" | "-" factor
reference  = [ device ":" ] "0x" hex digits [ "." sub-index ]
```

Numbers are decimal (`750`, `0.5`); what starts with `0x` is an entry. Values are compared exactly and in physical units: raw value ×
scale, in the symbol of the unit's base, so that entries in mV and in V can stand in one condition. `bit` looks at the raw value.

A constraint is tried on the defaults of each device (of those under `on:`, if given) that has all the entries it names without a device,
and again on the values of a configuration. A condition that needs a value which is not known (an entry without default, or with a
node-ID formula) is not decided, and breaks nothing; neither does one whose `when:` does not hold or is not decided.

`writable-when:` of [an entry](#entry) is a condition of the same form.
"#;

pub(super) const MANUAL: &str = r"
A specification can stand for a printed manual: `source:`, `revision:` and `history:` say which one, `document:` lists its sections and
tables in order, and `errata:` lists the places where the specification departs from what is printed.
";

pub(super) const ERRATUM_RULES: &str = "\
What kinds of fact there are:

{ERRATA}

The words of `place:` also say which tables of the `document:` the erratum is about, so that the documentation can show it with them. A
number behind `Table`, `Tables`, `Tabelle` or `Tabellen` is that of a numbered table, which has to exist: `5.1.1.1, Table 38`,
`Tables 12 to 15`; behind `below` or `unter` it is only near. The number of a section means its tables without a number that show an object
of `at:`, if it stands alone or with `detail table`, `overview`, `Objekttabelle` or `Übersicht`: `4.3.1.1, detail table`. Other words, such
as `heading` or `text`, mean no table.";

pub(super) const ERRATA: &[(&str, &str)] = &[
    ("index", "an index"),
    ("name", "a name"),
    ("type", "a data type"),
    ("sign", "the sign of a type or value"),
    ("access", "an access right"),
    ("object-type", "VAR, ARRAY or RECORD"),
    ("sub-index", "a sub-index, or the number of them"),
    ("count", "the number of elements or rows"),
    ("default", "a default value"),
    ("limit", "a limit"),
    ("unit", "a unit or scale"),
    ("pdo", "PDO mapping, or its direction"),
    ("stored", "whether a value is stored"),
    ("bits", "a bit table"),
    ("values", "a value table"),
    ("table", "a table's number, caption or headings"),
    ("text", "running text"),
    ("gap", "the manual is silent, and something had to be chosen"),
    ("profile", "the manual departs from a CiA profile; what the manual says is kept"),
];

pub(super) const TABLES: &str = r"
Beside `number:` and `title:`, a table has exactly one key, which says what fills it. Numbers are unique in a manual.
";
