//! The messages about texts, names and files: what reading, looking up and writing can say. The code of a rule over the
//! model is with the rule, in `check`.

use super::{Code, Example, Severity};

macro_rules! codes {
    ($($name:ident $severity:ident $(/ $foreign:ident)? $id:literal $title:literal: $explanation:literal $([$example:expr])?)+) => {
        /// Every code; which of them other crates see is listed below.
        #[allow(unreachable_pub, reason = "the list below says which are public")]
        mod every {
            use super::*;

            $(
                #[doc = $title]
                pub const $name: &Code = &Code {
                    id: $id,
                    severity: Severity::$severity,
                    foreign: codes!(@foreign $severity $($foreign)?),
                    title: $title,
                    explanation: $explanation,
                    clause: None,
                    example: codes!(@example $($example)?),
                };
            )+
        }

        pub(crate) use every::*;

        /// All of them, ascending.
        pub(crate) const ALL: &[&Code] = &[$($name,)+];
    };
    (@example) => { None };
    (@example $example:expr) => { Some($example) };
    (@foreign $severity:ident) => { Severity::$severity };
    (@foreign $severity:ident $foreign:ident) => { Severity::$foreign };
}

codes! {
    UNREADABLE Error "OD0101" "a file cannot be read":
        "The file does not exist, is a directory, or may not be read by this user. Nothing was compiled."
    NOT_UTF8 Error "OD0102" "a file is not UTF-8":
        "Specifications are UTF-8 text. The message names the first byte that is not. Convert the file, for example with `iconv -f latin1 -t utf-8`."
    TOO_LARGE Error "OD0103" "a file is too large":
        "Specifications of more than 64 MiB are refused before they are read: the largest real one has a few megabytes, so this is probably the wrong file."
    YAML_SYNTAX Error "OD0104" "a file is not YAML":
        "The YAML reader stopped at the marked place. Frequent causes: a tab in the indentation, a text that holds `: ` or ` #` without quotes, a bracket that is not closed. Everything before the place was understood, nothing after it was read."
    DUPLICATE_KEY Error "OD0105" "a key is written twice in a map":
        "YAML readers disagree about which of two equal keys wins; in an object dictionary a silently dropped entry is the worst of mistakes. Remove one of the two or join their values."
    UNKNOWN_ANCHOR Error "OD0106" "an alias refers to nothing":
        "A YAML alias `*name` repeats the value that carries the anchor `&name` before it. There is no such anchor, or the alias is inside the very value it would repeat."
    ALIAS_BOMB Error "OD0107" "aliases expand to too much":
        "Aliases of aliases multiply: a few lines can expand to billions of values. Expansion stops at 1 MiB and 256 bytes for each byte of the file, but at 16 MiB at the latest, where each value counts 64 bytes in addition to its text. Name a type once under `types:` instead of repeating values by alias."
    TOO_DEEP Error "OD0108" "lists and maps are nested too deep":
        "More than 64 levels of nesting. No specification needs that depth; usually a bracket is missing."
    YAML_TAG Error "OD0109" "a YAML tag":
        "Tags such as `!hex` or `!!str` have no meaning in a specification: the place decides how a value is read. Remove the tag."
    EMPTY_DOCUMENT Error "OD0110" "a file holds no specification":
        "The file is empty or holds nothing but comments. The smallest specification is:\n\n    od-spec: 1\n    title: My device\n    devices:\n      dev: {name: My device, bit-rates: [125]}"
    SEVERAL_DOCUMENTS Error "OD0111" "a file holds several YAML documents":
        "A specification is one YAML document. Remove the `---` that starts the second one, or put it into a file of its own."
    BAD_KEY Error "OD0112" "a key that cannot be one":
        "The keys of this map have a fixed form: indices under `objects:`, bits under `bits:`, and so on; YAML merge keys (`<<`) and lists or maps as keys are not part of the language."
    MISSING_LIBRARY Error "OD0113" "a used library cannot be read":
        "`uses:` names a built-in library (`odgen library` lists them) or the path of a library file, relative to the file that names it. There is no such library."
    NOT_A_LIBRARY Error "OD0114" "a used file is not a library":
        "A file named in `uses:` needs `profile: NAME` at its top level, which gives the name that `from:` uses. Libraries cannot use other libraries."
    TURNED_TEXT Error "OD0115" "a character that hides what a text says":
        "Some characters of Unicode change the direction in which the text around them is shown (U+202A to U+202E, U+2066 to U+2069, U+061C, U+200E, U+200F). What a person reads is then not what is written: an access right or a limit can look like another. No specification needs them; letters of every script have a direction of their own. Remove the character, also where it is written as an escape. A setting of a node has no escapes, and holds no control character either."
    TOO_MUCH Error "OD0116" "a file describes too much":
        "A few lines can describe millions of entries: a run of indices, arrays in it, objects that many devices have. A file describes at most 1,000 devices and 200,000 entries, a device has at most 100,000, a state machine 256 states, the places of errata name at most 20,000 tables, a sequence of events has 64 steps and 32 signals, a picture of switches 32 of them, and what is written once and repeated may not be more than 64 MiB of text. The largest devices are far below these limits: is a run, a `count:` or a list of devices wrong? A family of devices that is really larger goes into several files."
    MISSING_PART Error "OD0117" "a part cannot be read":
        "`parts:` names files that hold more of the specification, each relative to the file that names it. There is no such file, or it may not be read."
    NOT_A_PART Error "OD0118" "a file that is not part of the specification":
        "A file named under `parts:` has `part-of:` at its top level, with the name of the specification. This line shows readers and tools that it is not whole, and where the rest is. A file of objects for several specifications is a library and is named under `uses:`."
    PART_ALONE Error "OD0119" "a part without its specification":
        "A file with `part-of:` holds sections of another file; units, types and devices that it refers to may be in that file. Compile that file, which names its parts under `parts:`. `odgen` does so by itself when it is given a part and finds the specification."
    NO_SPECIFICATION Error "OD0120" "a parameter or plant file in the place of a specification":
        "A file that begins with `od-parameters:` says how one device is set up, one that begins with `od-plant:` which nodes a plant has. Neither describes a device: both are read together with the specification that does. `odgen check FILE` checks a parameter file that names its specification (`spec:`), `odgen dcf SPEC --params FILE --explain` any other one, `odgen plant check FILE` a plant. `odgen fmt` lays out all three."
    OTHER_BUS Error "OD0121" "a file of something else than CANopen":
        "Other fieldbuses have files of the same names: an EDS of EtherNet/IP or DeviceNet has the sections [File] and [Device], an XDD of POWERLINK a body for its own network. Nothing is read of them, written from them or fixed in them. A file that is named as an EDS but has no section is not an EDS either."
    NO_TABLE Error "OD0122" "no table of objects":
        "`odgen import` looks for rows of titles such as `Index`, `Sub-index`, `Name`, `Type`, `Access`, `PDO`, `Default`, `Min`, `Max` and `Unit`, or the German words for them. One row has to name the index or the sub-index, and the name or the type. Where the titles are other ones, `--columns \"Index=A, Name=C\"` says what the columns hold."
    UNKNOWN_KEY Error "OD0201" "an unknown key":
        "A key that the language does not have at this place. Nothing is ignored silently: a misspelt `acces: ro` would otherwise change an access right. `odgen reference` lists all keys."
    WRONG_KIND Error "OD0202" "a value of the wrong kind":
        "A list is where one value is expected, a text where a map is expected, or the like."
    MISSING_KEY Error "OD0203" "a missing key":
        "The map cannot be understood without this key."
    BAD_NUMBER Error "OD0204" "not a number":
        "Numbers are decimal, or hexadecimal (`0x`), binary (`0b`) or octal (`0o`), with `_` between digits if you like. A decimal number must not start with `0`, because files of CiA 306 read such a number as octal."
    NUMBER_OUT_OF_RANGE Error "OD0205" "a number outside its range":
        "The key takes numbers from a fixed range only."
    BAD_NOTATION Error "OD0206" "a value that is not written as it should be":
        "Dates are `2009-05-27`, indices `0x6040`, entries `0x30FA.3`, ratios `1/10`, conditions `0x607D.1 < 0x607D.2`. The message states which notation the place expects."
    UNKNOWN_WORD Error "OD0207" "an unknown word":
        "The key takes one of a few words."
    CONFLICTING_KEYS Error "OD0208" "keys that exclude each other":
        "Only one of these keys can be true of one thing: an object is an array or a record, a type an enum or a bit field, a table has one content."
    DUPLICATE_INDEX Error "OD0301" "an index is defined twice":
        "Two objects have one index, perhaps in two notations (`0x1A00` and `0x1a00`), in a run, or in two files, or one device has two of the objects that are listed under an index for different devices. Readers of YAML that keep the last one would silently lose the first."
    DUPLICATE_SUB_INDEX Error "OD0302" "a sub-index is defined twice":
        "Two entries of one object have one sub-index, perhaps in two notations (`10` and `0x0A`)."
    DUPLICATE_VALUE Error "OD0304" "a number has two meanings":
        "Two values of an enum, two special values, two transitions, two error codes, two tables or two figures have one number, or a bit reports one error code twice."
    NO_DEVICE Error "OD0305" "no device":
        "Without a device there is no dictionary to build. Add `devices:`; a file that is meant to be used by others needs `profile:` instead."
    UNKNOWN_DEVICE Error "OD0306" "an unknown device":
        "Objects, errors, errata, PDOs, conditions and defaults by device name devices by their key under the `devices:` of the file."
    UNKNOWN_LIBRARY Error "OD0307" "an unknown library":
        "`from:` names a library by its `profile:` name; the library must be in `uses:`."
    UNKNOWN_FEATURE Error "OD0308" "an unknown feature":
        "`features:` of a device names groups of objects that the used libraries offer."
    NOT_IN_LIBRARY Error "OD0309" "an object that the library does not define":
        "`from:` takes an object's definition from a library, and a feature names objects of its library. This one is not there."
    UNKNOWN_ENTRY Error "OD0310" "an unknown entry":
        "A reference by index or by name leads to no object or sub-index of the device."
    UNKNOWN_REFERENCE Error "OD0311" "a reference to nothing":
        "A table or a bit refers to a type, a state machine, a constraint or an error code that the specification does not have."
    UNKNOWN_STATE Error "OD0312" "an unknown state or transition":
        "Transitions name states, and commands name transitions, of the same state machine."
    PDO_DESCRIBED_TWICE Error "OD0317" "a PDO that is described twice":
        "The parameter objects of a PDO, 1400h to 1BFFh, are made from `pdos:`, or one or both of them are written in full under `objects:`. A PDO that is in both places would have two descriptions."
    LIKE_ITSELF Error "OD0324" "an object that is like itself":
        "`like:` takes what is not written from another object. Objects that are like each other in a circle, or one that is like itself, would leave their type undefined. Describe one of them in full."
    DIFFERENT_OBJECTS Error "OD0325" "a reference to different objects":
        "Devices of one file may have different objects at one index. What names the index for several of these devices, a condition, an erratum or a state machine, would mean another object on each. Say for which device it is."
    WRONG_CAUSE Error "OD0326" "a step that answers no earlier one":
        "`cause:` of a step names the earlier step that it answers, and the picture draws an arrow from what changes there to what changes here. A cause is earlier than its effect, and at both steps at least one signal changes. Correct the number or the levels, or leave `cause:` out: steps follow each other without it."
    NO_HYSTERESIS Error "OD0327" "a switch without a hysteresis":
        "What goes on below a threshold goes off at a higher value, and what goes on above one at a lower value; a heater is off before a cooler goes on. The values are those of the entries' defaults, so that each of them has a whole number in a unit as its default. Correct the defaults, or name other entries."
    LOOSE_PART Error "OD0328" "a part of a picture that hangs in the air":
        "A block of `flow:` takes what it needs from earlier blocks, so that the picture has a direction, names each of them once, and gives something to another or takes something from one. A span of `axis:` begins and ends at different marks; it may lack one of the two ends. Blocks of one picture have different names, and so have marks, because they are named by them."
    NO_COMMON_DEVICE Error "OD0329" "a picture across devices":
        "The entries that a picture names are those of one device: a reader finds them in its tables. Name entries that one device has, or draw two pictures."
    FOLLOWS Error "OD0330" "a key of the EDS that follows from the specification":
        "`sections:` of a device's `eds:` holds keys and sections that do not follow from the specification, such as `SRDOMapping`, keys of a maker, and modules. This key or section follows from the specification, and the EDS could contradict it. Remove it, and use the key that the help names."
    BAD_VALUE Error "OD0401" "a value that the type cannot read":
        "The text is not a value of the entry's type. Integers are raw numbers, physical values with the unit's symbol (`50.0 °C`), or the names of an enum; strings are text, octet strings hexadecimal digits."
    BAD_FORMULA Error "OD0402" "a node-ID formula that is not valid":
        "CiA 306 knows `$NODEID` and at most one number added to it, nothing else. Tools read any other form as an ordinary number or refuse the file."
    WRONG_SYMBOL Error "OD0405" "a physical value in a foreign unit":
        "A physical value carries the symbol of the entry's unit, or of the unit's base."
    INEXACT_VALUE Error "OD0412" "a physical value between two steps":
        "The value cannot be expressed in whole steps of the unit's scale: 5.05 °C is 50.5 steps of 0.1 °C. Nothing is rounded silently. Write one of the values next to it (5.0 °C or 5.1 °C), the raw number, or give the unit a finer `scale:`."
    LIMIT_ON_TYPE Error "OD0408" "a limit on a type without order":
        "Only numbers have limits: strings, domains and BOOLEAN have none. Special values are those of integers."
    BAD_BASE_TYPE Error "OD0409" "a type that cannot carry values or bits":
        "Enums and bit fields are carried by an INTEGERn or UNSIGNEDn type."
    OVERLAPPING_BITS Error "OD0410" "overlapping bits":
        "Two fields of a bit field claim one bit."
    BITS_MISSING Error "OD0411" "bits without a meaning":
        "A bit field describes every bit, at least as `reserved` or `unused`; otherwise a forgotten row of the manual would go unnoticed. `rest: reserved` covers what is not listed."
    UNKNOWN_BIT Error "OD0413" "a bit that does not exist":
        "`bit-errors:` and a `default:` that is a list name bits of the entry's bit field type, and so does a condition; a signal of `timing:` names one of its `type:`."
    BAD_ALIAS Error "OD0418" "an alias that cannot show its target":
        "An alias is a second view of an integer entry: in a narrower type of the same sign, or in another unit of the same base."
    ALIAS_OF_ALIAS Error "OD0419" "an alias of an alias":
        "An alias refers to the entry that holds the value, not to another view of it."
    DUPLICATE_PDO Error "OD0501" "a PDO is defined twice":
        "Two PDOs of one device and direction have one number."
    PATTERN_WIDTH Error "OD0603" "a bit pattern of the wrong width":
        "A state or command pattern has one place for each bit of the entry it describes, which is of an integer type: the bits of a text, a REAL or a time are not states."
    COMMAND_MISMATCH Error "OD0604" "a command code against its pattern":
        "The value under `send:` does not have the bits that `pattern:` demands."
    AMBIGUOUS_STATES Error "OD0605" "states that look the same":
        "One value of the status entry would show two states at once."
    WRONG_TRANSITION Error "OD0612" "a transition whose cause cannot be":
        "`by-device:` says how the device makes a transition without a command. The start has no other cause; a transition that is made by itself and leaves the state that it enters would never end; and one that the device never makes needs a command."
    REGISTER_OF_NO_ERROR Error "OD0613" "bits of the error register without an error":
        "Codes 00xxh say that an error is gone, or that there is none. The error register (1001h) has the bits of the errors that are present."
    CONSTRAINT_DEVICES Error "OD0607" "a constraint across devices":
        "No single device has all the entries that the condition names without a device. Write `device:` before them."
    UNITS_DIFFER Error "OD0610" "a comparison of different units":
        "A condition compares an entry in volts with one in degrees, or the like. Values are compared in the base of their units; entries that are compared directly need the same base."
    UNKNOWN_UNIT Error "OD0608" "an unknown unit":
        "`unit:` names a unit that is defined under `units:` of the specification or of a used library."
    UNKNOWN_TYPE Error "OD0609" "an unknown type":
        "`type:` names a data type of CiA 301 in lower case, such as `unsigned16`, or a type defined under `types:`."
    BAD_NODE_ID Error "OD0701" "not a node-ID":
        "Node-IDs are 1 to 127."
    BAD_ASSIGNMENT Error "OD0702" "a parameter setting that cannot be understood":
        "A setting is `ENTRY=VALUE`: the entry by index (`607D.2`, or as in an EDS `607Dsub2`; the index is hexadecimal) or by name, the value as the specification writes it. After a colon (`607D:2`) some tools count in decimal and others in hexadecimal: a sub-index that is not the same in both is refused there."
        [Example::parameters(
            "parameters:\n  2004: 7",
            "parameters:\n  2004.1: 7"
        )]
    BIT_RATE_UNSUPPORTED Error "OD0706" "a bit rate that the device does not support":
        "The device's `bit-rates:` do not list the requested one."
        [Example::parameters(
            "bit-rate: 333",
            "bit-rate: 125"
        )]
    SET_TWICE Error "OD0708" "a parameter that is set twice":
        "Two settings name one entry, perhaps once by index and once by name."
        [Example::parameters(
            "parameters:\n  2004.1: 7\n  ramps: {up: 8}",
            "parameters:\n  2004.1: 7\n  ramps: {down: 8}"
        )]
    WRITE_FAILED Error "OD0709" "an output that cannot be written":
        "A file could not be created, written or renamed. The message names the files that were written before it; all others are as they were, and every file is whole. The next run writes what is missing."
    BAD_TEMPLATE Error "OD0711" "a template that cannot be printed":
        "A documentation template has a syntax error, or asks for something that `odgen docs --dump-context` does not show. Nothing was written."
    CONCISE_CUT_OFF Error "OD0712" "a concise DCF that ends too early":
        "A concise DCF (CiA 302-3, object 1F22h) is the number of its records, 4 bytes, and then the records: index, sub-index, number of bytes, the bytes. The file ends within its number, within the head of a record or within a value; or it has fewer records than it says. A master stops at such a place, after it has written what comes before. Make the file again; a frequent cause is a generator that writes values of 24, 40, 48 or 56 bits with more bytes than it counts."
        [Example::concise(
            "01 00 00 00              # one record\n04 20 01  02 00 00 00    # 2004h.1, two bytes\n07                       # there is one",
            "01 00 00 00              # one record\n04 20 01  02 00 00 00    # 2004h.1, two bytes\n07 00"
        )]
    CONCISE_TOO_LONG Error "OD0713" "a concise DCF with more than its records":
        "The file goes on after as many records as it says it has. A master never sees that part. Either the number at the beginning is too small, or the file is not a concise DCF."
        [Example::concise(
            "00 00 00 00                    # no record\n04 20 01  02 00 00 00  07 00   # but there is one",
            "01 00 00 00                    # one record\n04 20 01  02 00 00 00  07 00"
        )]
    BAD_TRACE_LINE Error "OD0714" "a line of a trace that cannot be read":
        "A trace has a frame on each line: as `candump -L` logs it, `(1700000000.123456) can0 181#0102`; as `candump` prints it, `can0  181   [2]  01 02`; as an adapter with SLCAN sends it, `t18120102`; or, after the first lines of such a file, as a `.trc` of PCAN-View (1.0 to 1.3, 2.0, 2.1) or an `.asc` of CANalyzer has it. Empty lines, those that begin with `#` or `;`, and what a `.trc` or `.asc` says about the tool and the state of its adapter are left out. Every other line is read or reported, so that no frame is missed in silence; the lines after it are still read."
    NO_CONNECTION Error "OD0715" "a way to a bus that cannot be used":
        "`odgen serve` listens at an address of this machine, to which clients connect: the address is that of another machine, another program listens at the port, or the user may not use it; or the link to its pseudo-terminal cannot be made where it is to be. `odgen node` connects to an address or a serial port at which a CAN adapter speaks SLCAN: nothing answers there, or it is not such an adapter, or the adapter refuses to open its channel at the bit rate. A CAN interface (`--socketcan`) has to be there and up: `ip link set can0 up type can bitrate 125000`, as root. Pseudo-terminals and CAN interfaces are those of Linux; elsewhere there is SLCAN over TCP."
    ACCESS_FAILED Error "OD0716" "an access to a node that failed":
        "`odgen node` asked a node on a bus to read or write an entry. Either the node refused: the message has its abort code, in numbers and in words. A value may be right by itself and refused in the present state of the device, as while it is locked, or because of what another entry holds. Or it did not answer: it is switched off or stopped, has another node-ID, or the bus has another bit rate. Or it took the value, and has another one when it is read back. What was written before is written; the message says what was not."
    OTHER_DEVICE Error "OD0717" "a node that is another device":
        "`odgen node` asks a node first what it is: its device type (1000h), vendor (1018h.1), product code (1018h.2) and revision (1018h.3), as far as the specification states them, and its serial number (1018h.4), where the plant or the parameter file does. This node reports another value. A higher minor revision (the lower 16 bits) is compatible by CiA 301 and accepted. On another device the same indices can mean other things, with other units and limits, so that nothing is read from it or written to it under the names of this one. Name the specification and the device of the node, or the right node-ID. `--any-serial` accepts another serial number, such as that of a spare part, `--any-revision` another revision; `--any-device` asks nothing."
    NO_TERMINAL Error "OD0718" "something that needs a terminal":
        "`odgen serve --watch` draws on the terminal and takes its keys. Standard input and output have to be that terminal, and no file or pipe; a script comes from a file then, and not from standard input. `odgen serve --log` prints every frame in words without a terminal, and `odgen node monitor` prints what changes on any bus. Commands of `odgen node` that change a node show the changes first and ask at the terminal. Scripts use `--yes`, or `--dry-run` to see the changes only."
    NOTHING_TO_UNLOCK Error "OD0720" "an unlock of what is not locked":
        "`unlock:` of a parameter file and `--unlock` name locked entries that are to be set anyway, so that factory data is not overwritten by accident. This entry has no lock: if the name is wrong, the lock of the entry that was meant stays. Remove it, or name the entry that is locked."
        [Example::parameters(
            "parameters: {calibration: 101}\nunlock: [calibration, lowest voltage]",
            "parameters: {calibration: 101}\nunlock: [calibration]"
        )]
    UNKNOWN_IN_PLANT Error "OD0730" "a name that the plant does not have":
        "What a plant states about a type, a position or a device at a position has to be about one that exists: on a machine that has no such type, position or device, nothing would happen, and the mistake would go unnoticed. Types are under `types:`; the positions of a machine and the devices there are those of its type. A machine with other devices is of another type."
        [Example::plant(
            "sites:\n  Hall: {type: P2, machines: {1..3: {}}}",
            "sites:\n  Hall: {type: P1, machines: {1..3: {}}}"
        )]
    OVERLAPPING_RUNS Error "OD0731" "runs of machines that cross":
        "Of two runs of machines, one contains the other or they have no machine in common: what is stated for the smaller run overrides what is stated for the larger one. Here some machines are in both and neither contains the other, so that it is not defined what holds for them. Split one of the runs."
        [Example::plant(
            "sites:\n  Hall: {type: P1, machines: {1..5: {comment: old}, 4..8: {comment: new}}}",
            "sites:\n  Hall: {type: P1, machines: {1..3: {comment: old}, 4..8: {comment: new}}}"
        )]
    TOO_MANY_NODES Error "OD0733" "a plant with too many nodes":
        "A few lines can describe millions of nodes. A plant may have 100,000 of them; the largest have some thousands. Correct the run, or make a plant file for each site."
        [Example::plant(
            "sites:\n  Hall: {type: P1, machines: {1..60000: {}}}",
            "sites:\n  Hall: {type: P1, machines: {1..60: {}}}"
        )]
    DEPARTURE Note "OD0811" "a departure from a standard":
        "The specification takes the object from a library of a standard and states something different about it. That is allowed: the maker's word takes precedence over the standard's. `odgen check --notes` lists these objects, and the documentation shows what differs."
    OPEN_GAP Warning "OD0841" "a gap that is not filled":
        "`odgen new` writes examples where only the author knows the value, such as the vendor-ID, and marks them with the comment `# <--`. A device must not be delivered with them. Write the value and remove the comment."
    REGISTER_AGAINST_CLASS Warning "OD0845" "an error register against the class of the error":
        "The first digits of an error code are its class (CiA 301 table 21): current, voltage, temperature, communication, or the manufacturer's own. A master that reads the error register (1001h) expects the bit of that class. `register:` names other bits and not this one: add it, or give the error a code of the class that is meant."
    MACHINE_BESIDE_RUNS Warning "OD0850" "a machine outside the runs":
        "The site counts its machines in runs, and this number is in none of them: it makes one more machine. If one of the others was meant, correct the number; if there is such a machine, make a run longer, or write it as a run of its own, `17..17`."
        [Example::plant(
            "sites:\n  Hall: {type: P1, machines: {1..10: {}, 11: {}}}",
            "sites:\n  Hall: {type: P1, machines: {1..11: {}}}"
        )]
    NO_TRANSLATION Warning "OD0862" "a text without its translation":
        "`languages:` lists the languages of the texts, and a text that is written by language lacks one of them, or is empty in it. Documents in this language then show the text in another one. Write it; `odgen check --translations` lists every text that lacks a language."
        [Example::new(
            "languages: [en, de]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: {en: Level of the tank.}}",
            "languages: [en, de]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: {en: Level of the tank., de: Füllstand des Behälters.}}"
        )]
    ONE_LANGUAGE Note "OD0863" "texts in one language":
        "A text that is not written by language is in the first language of `languages:`. Documents in another one show it as it is. `odgen check --translations` lists these texts, for translators."
        [Example::new(
            "languages: [en, de]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: Level of the tank.}",
            "languages: [en, de]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: {en: Level of the tank., de: Füllstand des Behälters.}}"
        )]
    NAMED_IN_TEXT Warning "OD0864" "a text names what is not there":
        "A text names an object that no device has, or a table, figure or section that `document:` does not have. It leads the reader nowhere: a wrong digit, or something that was renamed or removed? Numbers of other documents count where the sentence names them: `CiA 301, section 7.5`. Texts of errata and of the history are about other issues, and are not looked at. `since:` names an issue that `history:` lists."
        [Example::new(
            "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: The limit is object 2010h.}\n  0x2001: {name: limit, type: unsigned8, access: ro}",
            "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, about: The limit is object 2001h.}\n  0x2001: {name: limit, type: unsigned8, access: ro}"
        )]
    NO_CHANGE Warning "OD0865" "an erratum that changes nothing":
        "An erratum says what the manual prints and how it is read. Here both are equal, so the erratum does not show what is wrong with the manual. Correct one of them, or remove the erratum."
    DISGUISED Warning "OD0866" "a word that is not what it looks like":
        "Letters of the Cyrillic and the Greek script look like Latin ones, and some characters have no width. A word with one of them looks as it should, but it is another word: a search does not find it, a reference to it does not match, and an EDS, which is ASCII, has other letters. They come from texts that were copied, or from a keyboard that was switched. An editor with the language server offers the word with the Latin letters. Words that are Cyrillic or Greek as a whole are not meant."
        [Example::new(
            "objects:\n  0x2000: {name: sp\u{435}ed, type: unsigned8, access: ro}",
            "objects:\n  0x2000: {name: speed, type: unsigned8, access: ro}"
        )]
    ISSUE_ORDER Warning "OD0867" "an issue of the manual out of order":
        "`history:` lists the issues of the manual from the first to the last, or the other way round, and `revision:` says which one the specification is of. Where a date goes back, a digit is wrong or the issue is in the wrong place."
    TABLE_CELL Warning "OD0868" "a cell of a table that is not understood":
        "`odgen import` guesses nothing: a cell that cannot be read in exactly one way is left out, and a comment in the specification says where it is and what it holds. The same happens to what the language refuses. Correct the table and import it again, or complete the specification."
        [Example::new(
            "revision: {number: \"1.1\", date: 2020-05-27}\nhistory: [{number: \"1.0\", date: 2021-02-01}, {number: \"1.1\", date: 2020-05-27}]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro}",
            "revision: {number: \"1.1\", date: 2020-05-27}\nhistory: [{number: \"1.0\", date: 2019-02-01}, {number: \"1.1\", date: 2020-05-27}]\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro}"
        )]
    STACK_DIFFERS Warning "OD0860" "something that the stack wants set up":
        "CANopenNode treats some things differently from the dictionary. The files are made and compile, with the configuration in `CO_driver_custom.h`; the message says what to do in the project that takes them, or what is different on the bus. What is the same for several entries is reported once, at the first."
    COB_ID_OF_OTHER_NODE Warning "OD0861" "a COB-ID of the node-ID that a file is for":
        "A DCF or XDC is the configuration of one node, and a command uses it for another node-ID. Values that the node-ID formula of their default gives follow the node-ID. This COB-ID does not: the file has a number without a formula, and it is one of those that CiA 301 reserves for the first node-ID (table 34). If both nodes are on one bus, both send the same message, or receive what is meant for the other. Many tools resolve `$NODEID` when they write a DCF, so that its defaults are numbers as well: make the file of another node from the EDS or the specification. A COB-ID that is meant like this can be set on purpose."
    NAMED_TWICE Warning "OD0894" "a name that is listed twice":
        "A list of devices, features, languages or the like names something twice. Once is enough: probably another name was meant, which is missing now. Remove one of the two, or name what was meant."
    NAMES_ALIKE Warning "OD0899" "names in C that begin alike":
        "C99 lets a compiler distinguish only the first 63 characters of names and macros, and MISRA C:2012 (rules 5.2 and 5.4) wants names that differ in them. Common compilers compare whole names, so that the files compile there. Write a shorter `identifier:` at one of the two entries, or a shorter name of a type, value or bit; the key of the device begins every name, too."
    IDENTIFIER_CLASH Error "OD0901" "two things with one identifier":
        "Generated code makes identifiers from names: letters and digits stay, everything else becomes `_`. Two names that differ only in other characters cannot both be in it, nor a name and what is made for another one: `set level` and the setter of `level`. Nothing is renamed silently, because firmware would come to depend on it; only a word that the language or generated code needs itself gets a `_` after it. Write `identifier:` at one of the two objects or entries, or change the name of a type, unit or value."
    NO_IDENTIFIER Error "OD0902" "a name without an identifier":
        "Generated code makes identifiers from the letters and digits of a name, and this one has none. Write `identifier:`."
    NO_CAPACITY Error "OD0903" "a string without a capacity":
        "Generated firmware sets aside memory for every string that can change. Write `capacity:`, the most bytes that the device can hold."
    NOT_IN_FIRMWARE Error "OD0904" "something that generated code cannot do":
        "Generated code computes with 64-bit integers, addresses entries with 16-bit numbers and their values with 24 bits, and is about at least one object. The message names the part of the specification that needs more."
    STACK_REFUSES Error "OD0905" "a device that the stack does not take":
        "CANopenNode does not compile, does not start, or does not do what the dictionary says, without certain objects: 1000h, 1001h and 1017h, 1200h where there are more SDO servers, and a mapping parameter object for each communication parameter object of a PDO, beginning with PDO 1. It also starts only if the objects that it reads have the types of CiA 301. A dictionary without them would fail somewhere in the stack's own files; so none is made. Add the object, for example with `features:` of the library `cia301`."
    XDD_SYNTAX Error "XDD101" "a file is not well-formed XML":
        "The XML reader stopped at the marked place; nothing of the file was read. Frequent causes: an element that is not closed, `&` or `<` in a text where `&amp;` or `&lt;` belongs, a file that is cut off."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"up & down\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"up &amp; down\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_DTD Error "XDD102" "a document type in an XDD":
        "A document type (`<!DOCTYPE …>`) can define entities that expand to any amount of text, or to files of the reader's machine. An XDD needs none, so that such a file is refused as a whole. Remove the document type."
        [Example::xdd(
            "<!DOCTYPE list [<!ENTITY name \"level\">]>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"&name;\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_NONE Error "XDD103" "XML that is no XDD":
        "An XDD or XDC (CiA 311) lists the objects of a device in a `CANopenObjectList`. The file is XML and has none."
        [Example::xdd(
            "<Objects>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</Objects>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_NO_PLACE Error "XDD201" "an object that cannot be placed":
        "An object is known by its `index`, a sub-object by its `subIndex`, in hexadecimal digits and each once. One without it is left out, as is the second of two: readers disagree about which of them counts."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"level\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_ATTRIBUTE Error / Warning "XDD202" "an attribute that cannot be understood":
        "The attribute is missing, or has another value than CiA 311 knows. The message says what is taken instead. Words that leave no doubt (`UNSIGNED16`, `readWrite`, `VAR`) are read as what they say; otherwise an access is read-only, a mapping none, a bit rate not stated, and an object what its sub-objects make of it."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"readable\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\"/>\n</CANopenObjectList>"
        )]
    XDD_NO_TYPE Error "XDD203" "an entry without a data type":
        "Neither the object nor the parameter that it refers to states a data type of CiA 301. The entry has the type that CiA 301 defines for it; any other is taken as a DOMAIN, a block of unknown length. Types of 24, 40, 48 and 56 bits have no element of their own, so that `dataType` of the object has to name them."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" accessType=\"rw\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_NO_ACCESS Error "XDD204" "an entry without access":
        "Neither the object nor a parameter states how the entry may be read and written. It is taken as read-only until an access type is written."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_REFERENCE Error / Warning "XDD205" "a reference to no parameter":
        "`uniqueIDRef` names the parameter that says type, access, default and meaning of an entry. There is none of this name, so that only what the object itself says is known."
        [Example::xdd(
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_2\"/>\n</CANopenObjectList>",
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_1\"/>\n</CANopenObjectList>"
        )]
    XDD_CONTRADICTION Error / Warning "XDD206" "a mapping against the access":
        "A TPDO carries what can be read, an RPDO what can be written; `PDOmapping` says the opposite of the access. The access counts, and the mapping goes in its direction."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" PDOmapping=\"RPDO\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" PDOmapping=\"TPDO\"/>\n</CANopenObjectList>"
        )]
    XDD_DISABLED Warning "XDD208" "objects that are switched off":
        "CANopenEditor can switch objects off (`CO_disabled`): neither its EDS nor its code has them, so they are not objects of the device. `--disabled` reads them anyway."
        [Example::xdd(
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/><property name=\"CO_disabled\" value=\"true\"/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_1\"/>\n</CANopenObjectList>",
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_1\"/>\n</CANopenObjectList>",
        )]
    XDD_VALUES Warning "XDD209" "values of a node in an XDD":
        "An XDD describes a type of device: `actualValue` is the value of one node, and belongs in an XDC. In an XDD it is left out of everything that is made from the file."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" defaultValue=\"0\" actualValue=\"5\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" defaultValue=\"0\"/>\n</CANopenObjectList>"
        )]
    XDD_COUNT Warning "XDD210" "a number of sub-objects that is not theirs":
        "`subNumber` is the number of sub-objects, sub-index 0 among them. The sub-objects that are there count. Is one of them missing?"
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"levels\" objectType=\"9\" subNumber=\"3\">\n    <CANopenSubObject subIndex=\"00\" name=\"number\" objectType=\"7\" dataType=\"0005\" accessType=\"const\" defaultValue=\"1\"/>\n    <CANopenSubObject subIndex=\"01\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n  </CANopenObject>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"levels\" objectType=\"9\" subNumber=\"2\">\n    <CANopenSubObject subIndex=\"00\" name=\"number\" objectType=\"7\" dataType=\"0005\" accessType=\"const\" defaultValue=\"1\"/>\n    <CANopenSubObject subIndex=\"01\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n  </CANopenObject>\n</CANopenObjectList>"
        )]
    XDD_LISTS Warning "XDD211" "a second list of objects":
        "A device has one `CANopenObjectList`. The first one is read; what a further one holds is left out of everything that is made from the file."
        [Example::xdd(
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>\n<CANopenObjectList>\n  <CANopenObject index=\"2001\" name=\"limit\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>",
            "<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n  <CANopenObject index=\"2001\" name=\"limit\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\"/>\n</CANopenObjectList>"
        )]
    XDD_LEFT_OUT Note "XDD207" "something that has no place":
        "A dictionary has no place for it, or it can be understood in more than one way: what other programs keep in `property`, modules, templates, and units whose raw values count from an `offset`."
        [Example::xdd(
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/><property name=\"colour\" value=\"red\"/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_1\"/>\n</CANopenObjectList>",
            "<parameterList>\n  <parameter uniqueID=\"UID_1\"><USINT/></parameter>\n</parameterList>\n<CANopenObjectList>\n  <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" uniqueIDRef=\"UID_1\"/>\n</CANopenObjectList>"
        )]
}

// The codes that backends, commands and tests name.
pub use every::{
    ACCESS_FAILED, BAD_ASSIGNMENT, BAD_NODE_ID, BAD_NOTATION, BAD_TEMPLATE, BAD_TRACE_LINE, BAD_VALUE,
    CONCISE_CUT_OFF, CONCISE_TOO_LONG, DEPARTURE, IDENTIFIER_CLASH, NAMES_ALIKE, NO_CAPACITY, NO_CONNECTION,
    NO_IDENTIFIER, NO_TABLE, NO_TERMINAL, NOT_A_LIBRARY, NOT_A_PART, NOT_IN_FIRMWARE, NOT_UTF8, OTHER_BUS,
    OTHER_DEVICE, SET_TWICE, STACK_DIFFERS, STACK_REFUSES, TABLE_CELL, TOO_LARGE, TURNED_TEXT,
    UNKNOWN_DEVICE, UNKNOWN_ENTRY, UNKNOWN_KEY, UNKNOWN_WORD, UNREADABLE, WRITE_FAILED, XDD_DISABLED,
    XDD_LEFT_OUT,
};
