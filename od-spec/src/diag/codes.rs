//! The messages about texts, names and files: what reading, looking up and writing can say. The code of a rule over the
//! model stands with the rule, in `check`.

use super::{Code, Severity};

macro_rules! codes {
    ($($name:ident $severity:ident $id:literal $title:literal: $explanation:literal)+) => {
        $(
            #[doc = $title]
            pub const $name: &Code = &Code {
                id: $id,
                severity: Severity::$severity,
                title: $title,
                explanation: $explanation,
                clause: None,
                example: None,
            };
        )+

        /// All of them, ascending.
        pub(crate) const ALL: &[&Code] = &[$($name,)+];
    };
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
    DUPLICATE_KEY Error "OD0105" "a key stands twice in a map":
        "YAML readers disagree about which of two equal keys wins; in an object dictionary a silently dropped entry is the worst of mistakes. Remove one of the two or join their values."
    UNKNOWN_ANCHOR Error "OD0106" "an alias refers to nothing":
        "A YAML alias `*name` repeats the value that carries the anchor `&name` before it. There is no such anchor, or the alias stands inside the very value it would repeat."
    ALIAS_BOMB Error "OD0107" "aliases expand to too much":
        "Aliases of aliases multiply: a few lines can stand for billions of values. Expansion stops at 200,000 values. Name a type once under `types:` instead of repeating values by alias."
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
        "`uses:` names a built-in library (`cia301`, `cia402`) or the path of a library file, relative to the file that names it. There is no such library."
    NOT_A_LIBRARY Error "OD0114" "a used file is no library":
        "A file named in `uses:` needs `profile: NAME` at its top level, which gives the name that `from:` uses. Libraries cannot use other libraries."
    UNKNOWN_KEY Error "OD0201" "an unknown key":
        "A key that the language does not have at this place. Nothing is ignored silently: a misspelt `acces: ro` would otherwise change an access right. `odgen reference` lists all keys."
    WRONG_KIND Error "OD0202" "a value of the wrong kind":
        "A list stands where one value is expected, a text where a map is, or the like."
    MISSING_KEY Error "OD0203" "a missing key":
        "The map cannot be understood without this key."
    BAD_NUMBER Error "OD0204" "not a number":
        "Numbers are decimal, or hexadecimal (`0x`), binary (`0b`) or octal (`0o`), with `_` between digits if you like. A decimal number must not start with `0`, because CiA 306 files read such a number as octal."
    NUMBER_OUT_OF_RANGE Error "OD0205" "a number outside its range":
        "The key takes numbers from a fixed range only."
    BAD_NOTATION Error "OD0206" "a value that is not written as it should be":
        "Dates are `2009-05-27`, indices `0x6040`, entries `0x30FA.3`, ratios `1/10`, conditions `0x607D.1 < 0x607D.2`. The message tells which notation the place expects."
    UNKNOWN_WORD Error "OD0207" "an unknown word":
        "The key takes one of a few words."
    CONFLICTING_KEYS Error "OD0208" "keys that exclude each other":
        "Only one of these keys can be true of one thing: an object is an array or a record, a type an enum or a bit field, a table has one content."
    DUPLICATE_INDEX Error "OD0301" "an index is defined twice":
        "Two objects have one index, perhaps in two notations (`0x1018` and `4120`). Readers of YAML that keep the last one would lose the first without a word."
    DUPLICATE_SUB_INDEX Error "OD0302" "a sub-index is defined twice":
        "Two entries of one object have one sub-index, perhaps in two notations (`10` and `0x0A`)."
    DUPLICATE_NAME Error "OD0303" "a name stands for two things":
        "Names are how people, PDO mappings and generated code refer to things: objects of one device, entries of one object, values and bits of one type, units and types each need a name of their own."
    DUPLICATE_VALUE Error "OD0304" "a number stands for two things":
        "Two values of an enum, two special values, two transitions, two error codes or two tables have one number."
    NO_DEVICE Error "OD0305" "no device":
        "Without a device there is no dictionary to build. Add `devices:`; a file that is meant to be used by others needs `profile:` instead."
    UNKNOWN_DEVICE Error "OD0306" "an unknown device":
        "`on:`, `pdos:` and conditions name devices by their key under `devices:`."
    UNKNOWN_LIBRARY Error "OD0307" "an unknown library":
        "`from:` names a library by its `profile:` name; the library must stand in `uses:`."
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
    COUNT_MISMATCH Error "OD0313" "two counts disagree":
        "An array has an element beyond its `count`, or a table row has more or fewer cells than the table has columns."
    EMPTY_OBJECT Error "OD0314" "an array or record without entries":
        "An ARRAY or RECORD has at least one element or member beside sub-index 0."
    MIXED_ARRAY Error "OD0315" "an array of several types":
        "All elements of an ARRAY have one data type (CiA 301 table 37). Make the object a RECORD."
    INDEX_AREA Error "OD0316" "an index outside the areas for objects":
        "Objects lie from 1000h to BFFFh. 0001h to 0FFFh are data types, C000h and above are reserved (CiA 301 table 1). Configuration tools refuse a file with such an object."
    PDO_BY_HAND Error "OD0317" "a PDO parameter object written by hand":
        "The objects 1400h to 1BFFh are made from `pdos:`, where entries are named and lengths, directions and counts are worked out and checked."
    NOT_FOR_EDS Error "OD0318" "a text that an EDS cannot hold":
        "An EDS line has at most 255 characters, which leaves 241 for a name. `;`, `#` and `=` in names and texts are read as comments or keys by several PLC tools, so they are refused; blanks at the ends of a string are lost. Characters outside ASCII are transliterated."
    BAD_VALUE Error "OD0401" "a value that the type cannot read":
        "The text is not a value of the entry's type. Integers are raw numbers, physical values with the unit's symbol (`50.0 °C`), or the names of an enum; strings are text, octet strings hexadecimal digits."
    BAD_FORMULA Error "OD0402" "a node-ID formula that is none":
        "CiA 306 knows `$NODEID` and at most one number added to it, nothing else. Tools read any other form as an ordinary number or refuse the file."
    UNKNOWN_ENUM_VALUE Error "OD0403" "not a value of the enum":
        "The entry's type lists its values; this one is not among them."
    VALUE_DOES_NOT_FIT Error "OD0404" "a value that does not fit the type":
        "The value lies outside what the data type can carry, for the formula `$NODEID + n` also for the largest node-ID 127. Signed values are written in decimal, not as bit patterns."
    WRONG_SYMBOL Error "OD0405" "a physical value in a foreign unit":
        "A physical value carries the symbol of the entry's unit, or of the unit's base."
    INEXACT_VALUE Error "OD0412" "a physical value between two steps":
        "The value cannot be expressed in whole steps of the unit's scale: 5.05 °C is 50.5 steps of 0.1 °C. Nothing is rounded silently."
    DEFAULT_OUTSIDE_LIMITS Error "OD0406" "a default outside the limits":
        "The default must lie between `min` and `max` or be one of the `special` values; for a node-ID formula this holds for every node-ID."
    LIMITS_SWAPPED Error "OD0407" "limits in the wrong order":
        "The low limit is above the high limit, so that no value would be allowed."
    LIMIT_ON_TYPE Error "OD0408" "a limit on a type without order":
        "Only integers have limits: strings, domains and BOOLEAN have none, and limits of REAL types are read differently by every tool."
    BAD_BASE_TYPE Error "OD0409" "a type that cannot carry values or bits":
        "Enums and bit fields are carried by an INTEGERn or UNSIGNEDn type."
    OVERLAPPING_BITS Error "OD0410" "overlapping bits":
        "Two fields of a bit field claim one bit."
    BITS_MISSING Error "OD0411" "bits without a meaning":
        "A bit field says something about every bit, and be it `reserved` or `unused`; otherwise a forgotten row of the manual would go unnoticed. `rest: reserved` covers what is not listed."
    UNKNOWN_BIT Error "OD0413" "errors of a bit that does not exist":
        "`bit-errors:` names bits of the entry's bit field type."
    LOCKED_READ_ONLY Error "OD0414" "a lock on something nobody can write":
        "`locked` means that the entry can be written only after the device was unlocked for service. An entry that is never writable needs no lock."
    CONST_STORED Error "OD0415" "a stored constant":
        "`const` means that the value never changes, so there is nothing to store."
    TYPE_NOT_MAPPABLE Error "OD0416" "a type that cannot travel in a PDO":
        "Strings and DOMAINs have no fixed length and cannot be mapped (CiA 301 table 39)."
    MAPPING_AGAINST_ACCESS Error "OD0417" "mapping against the access":
        "What is mapped into a TPDO is read from the device, what is mapped into an RPDO is written to it. `ro`, `const` and `rwr` go with `transmit`, `wo` and `rww` with `receive`; only `rw` leaves the choice."
    BAD_ALIAS Error "OD0418" "an alias that cannot show its target":
        "An alias is a second view of an integer entry: in a narrower type of the same sign, or in another unit of the same base."
    ALIAS_OF_ALIAS Error "OD0419" "an alias of an alias":
        "An alias refers to the entry that holds the value, not to another view of it."
    DUPLICATE_PDO Error "OD0501" "a PDO is defined twice":
        "Two PDOs of one device and direction have one number."
    NOT_MAPPABLE Error "OD0502" "an entry that cannot be mapped into this PDO":
        "The entry's `pdo:` does not allow this direction, or none at all. A device answers such a mapping with abort code 0604 0041h."
    BAD_COB_ID Error "OD0503" "an unusable COB-ID":
        "The identifier has more than 11 bits or is kept for NMT, SDO, heartbeat or LSS (CiA 301 table 35). `cob-id:` is the identifier alone; the flag bits follow from `valid:` and `no-rtr:`."
    COB_ID_CLASH Error "OD0504" "two PDOs with one COB-ID":
        "Two PDOs that are valid after start-up use one identifier; the device would disturb its own traffic."
    BAD_TRANSMISSION Error "OD0505" "a reserved transmission type":
        "0 to 240 are synchronous, 254 and 255 event-driven, 252 and 253 answer remote frames (TPDOs only); 241 to 251 are reserved (CiA 301 table 56)."
    BAD_DUMMY Error "OD0506" "a placeholder that the device does not take":
        "RPDOs may hold placeholders of the types that the device lists in `dummies:`; TPDOs may not."
    PDO_TOO_LONG Error "OD0507" "a PDO over 64 bits":
        "A PDO is one CAN frame and holds 64 bits. Map fewer entries, or 16-bit aliases of 32-bit entries."
    BAD_PDO_KEY Error "OD0508" "PDO settings that contradict each other":
        "More entries are mapped than the device offers, a fixed mapping is empty, or a key belongs to the other direction."
    GRANULARITY_MISMATCH Error "OD0509" "granularity against mapping":
        "A granularity of 0 tells tools that no mapping can be changed; any other value that at least one can. The PDOs say the opposite."
    BAD_BIT_RATE Error "OD0601" "not a CANopen bit rate":
        "CiA 301 defines 10, 20, 50, 125, 250, 500, 800 and 1000 kbit/s; an EDS has keys for these only."
    NO_BIT_RATE Error "OD0602" "no bit rate":
        "An EDS without a supported bit rate is refused by configuration tools."
    PATTERN_WIDTH Error "OD0603" "a bit pattern of the wrong width":
        "A state or command pattern has one place for each bit of the entry it describes."
    COMMAND_MISMATCH Error "OD0604" "a command code against its pattern":
        "The value under `send:` does not have the bits that `pattern:` demands."
    AMBIGUOUS_STATES Error "OD0605" "states that look the same":
        "One value of the status entry would show two states at once."
    CONSTRAINT_BROKEN Error "OD0606" "a constraint that is broken":
        "The values at hand do not meet a condition of the specification. They are compared exactly, in physical units."
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
        "A setting is `ENTRY=VALUE`: the entry by index (`607D.2`, hexadecimal) or by name, the value as the specification writes it."
    NOT_WRITABLE Error "OD0703" "a parameter that cannot be written":
        "A DCF sets parameters by SDO download; this entry is read-only over the bus."
    LOCKED_PARAMETER Error "OD0704" "a parameter that is locked":
        "The entry is writable only after the device was unlocked for service, which a PLC does not do at boot. The default of a locked parameter was set in the factory."
    VALUE_OUTSIDE_LIMITS Error "OD0705" "a parameter value outside the limits":
        "The value lies outside `min` and `max` and is no special value. The device would refuse it with abort code 0609 0031h or 0609 0032h."
    BIT_RATE_UNSUPPORTED Error "OD0706" "a bit rate that the device does not support":
        "The device's `bit-rates:` do not list the requested one."
    NOT_FOR_DOWNLOAD Error "OD0707" "an entry that tools must not write":
        "The entry carries `flags: [no-write]`: it triggers a command, such as storing parameters, and must not be written as part of a configuration."
    SET_TWICE Error "OD0708" "a parameter that is set twice":
        "Two settings name one entry, perhaps once by index and once by name."
    WRITE_FAILED Error "OD0709" "an output that cannot be written":
        "A file could not be created, written or renamed. Nothing was changed: the old files are all still there."
    BAD_TEMPLATE Error "OD0711" "a template that cannot be printed":
        "A documentation template has a syntax error, or asks for something that `odgen docs --dump-context` does not show. Nothing was written."
    CONDITION_UNMET Warning "OD0710" "a parameter that the device accepts only in some state":
        "The entry has a `writable-when` condition that the configured values do not meet. A PLC that downloads the DCF at boot will get an SDO abort for it."
    MANDATORY_MISSING Warning "OD0801" "a mandatory object is missing":
        "Every CANopen device has 1000h, 1001h and 1018h (CiA 301). `uses: [cia301]` brings them."
    NO_PDO Warning "OD0802" "mappable, but no PDO":
        "Entries of the device can be mapped in a direction in which it has no PDO; a strict checker calls the EDS faulty. Describe the PDOs under `pdos:`."
    NO_ERROR_CONTROL Warning "OD0803" "neither heartbeat nor node guarding":
        "CiA 301 demands one of the two. Add the feature `heartbeat producer`."
    LSS_WITHOUT_SERIAL Warning "OD0804" "LSS without a serial number":
        "An LSS address consists of vendor, product, revision and serial number: 1018h needs sub-index 4."
    CONST_WITHOUT_DEFAULT Warning "OD0805" "a constant without a value":
        "A `const` entry has one value for ever; state it as `default`."
    UNUSED Warning "OD0806" "a definition that nothing uses":
        "A unit or type is defined but no entry refers to it. A leftover, or an entry lost its `unit:` or `type:`?"
    REAL_DEFAULT Warning "OD0807" "a default of a REAL type":
        "Tools read `DefaultValue` of REAL32 and REAL64 differently: some as decimal text, some as the bit pattern of IEEE 754. It is written as decimal text."
    STORED_WITHOUT_STORE Warning "OD0809" "stored, but nothing stores":
        "An entry is saved by a \"store parameters\" command that the device does not have: 1010h lacks the sub-index of its group (2 communication, 3 application, 4 manufacturer). Add the feature `store parameters`, or correct `stored:`."
    RESERVED_BIT_SET Warning "OD0810" "a default sets reserved bits":
        "Reserved bits are written as 0. Correct the default, or say what the bits mean."
    UNLISTED_ERROR_CODE Warning "OD0808" "an error code that is not listed":
        "A bit refers to an error code that `errors:` does not have."
    DEPARTURE Note "OD0811" "a departure from a standard":
        "The specification takes the object from a library of a standard and says something else about it. That is its right: the maker's word goes before the standard's. `odgen check --notes` lists these objects, and the documentation shows what differs."
    IDENTIFIER_CLASH Error "OD0901" "two things with one identifier":
        "Generated code makes identifiers from names: letters and digits stay, everything else becomes `_`. Two names that differ in other characters only, or a name that generated code needs itself, cannot both stand in it. Nothing is renamed silently, as firmware would come to depend on it: write `identifier:` at one of the two objects or entries, or change the name of a type, unit or value."
    NO_IDENTIFIER Error "OD0902" "a name without an identifier":
        "Generated code makes identifiers from the letters and digits of a name, and this one has none. Write `identifier:`."
    NO_CAPACITY Error "OD0903" "a string without a capacity":
        "Generated firmware sets aside memory for every string that can change. Write `capacity:`, the most bytes that the device can hold."
    NOT_IN_FIRMWARE Error "OD0904" "something that generated code cannot do":
        "Generated code computes with 64-bit integers and addresses entries with 16-bit numbers. The message tells which part of the specification needs more."
}
