//! Enums and bit fields.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "a value of an enum comes",
        at: "  encoder code:",
        find: "      2: HyperFace\n",
        replace: "      2: HyperFace\n      3: EnDat 2.2\n",
        expected: &["pmc: + type `encoder code` (5094h), value 3: EnDat 2.2 [addition]"],
    },
    Case {
        name: "a value of an enum goes",
        at: "  encoder code:",
        find: "      2: HyperFace\n",
        replace: "",
        expected: &["pmc: - type `encoder code` (5094h), value 2: HyperFace [plc, firmware]"],
    },
    Case {
        name: "a value of an enum is called otherwise",
        at: "  encoder code:",
        find: "2: HyperFace",
        replace: "2: Hiperface DSL",
        expected: &[
            "pmc: ~ type `encoder code` (5094h), value 2: meaning: HyperFace -> Hiperface DSL [firmware, behaviour]",
        ],
    },
    Case {
        name: "a value of an enum is spelt otherwise",
        at: "  encoder code:",
        find: "2: HyperFace",
        replace: "2: Hyperface",
        expected: &[
            "pmc: ~ type `encoder code` (5094h), value 2: meaning: HyperFace -> Hyperface [documents]",
        ],
    },
    Case {
        name: "two values change places",
        at: "  encoder code:",
        find: "      0: ENDAT\n      2: HyperFace",
        replace: "      0: HyperFace\n      2: ENDAT",
        expected: &[
            "pmc: ~ 5094h encoder code: default: 0: ENDAT -> 2: ENDAT [behaviour]",
            "pmc: ~ type `encoder code` (5094h), value 0: meaning: ENDAT -> HyperFace [plc]",
            "pmc: ~ type `encoder code` (5094h), value 2: meaning: HyperFace -> ENDAT [plc]",
        ],
    },
    Case {
        name: "a value is supported",
        at: "  battery type:",
        find: "{name: lead AGM, supported: no}",
        replace: "{name: lead AGM}",
        expected: &[
            "pmm: ~ type `battery type` (3020h.1), value 24 supported: meaning: no -> yes [addition]",
        ],
    },
    Case {
        name: "a value that was not supported goes",
        at: "  battery type:",
        find: "      0x1A: {name: lead hybrid, supported: no}\n",
        replace: "",
        expected: &["pmm: - type `battery type` (3020h.1), value 26: lead hybrid [firmware]"],
    },
    Case {
        name: "a bit comes",
        at: "  charger status:",
        find: "      5: unused",
        replace: "      5: {name: fuse}",
        expected: &["pmm: + type `charger status` (3001h), bit 5: fuse [addition]"],
    },
    Case {
        name: "a bit goes",
        at: "  test status:",
        find: "      3:\n        name: test active\n        about: 1 = the test is running.\n        search: {en: [battery test running, test in progress], de: Batterietest läuft}\n",
        replace: "      3: unused\n",
        expected: &["pmm: - type `test status` (3005h), bit 3: test active [plc, firmware]"],
    },
    Case {
        name: "a bit is called otherwise",
        at: "  test status:",
        find: "name: test active",
        replace: "name: test running",
        expected: &[
            "pmm: ~ type `test status` (3005h), bit 3: meaning: test active -> test running [firmware, behaviour]",
        ],
    },
    Case {
        name: "a description of a bit",
        at: "  test status:",
        find: "1 = the test is running.",
        replace: "1 = the battery is tested.",
        expected: &[
            "pmm: ~ type `test status` (3005h), bit 3: about: 1 = the test is running. -> 1 = the battery is tested. [documents]",
        ],
    },
    Case {
        name: "bits without a meaning",
        at: "  charger status:",
        find: "      6: unused",
        replace: "      6: reserved",
        expected: &["pmm: ~ type `charger status` (3001h), bit 6: meaning: unused -> reserved [documents]"],
    },
    Case {
        name: "another edge",
        at: "  PMM controlword:",
        find: "edge: rising",
        replace: "edge: both",
        expected: &["pmm: ~ type `PMM controlword` (3040h), bit 0 edge: meaning: rising -> both [behaviour]"],
    },
    Case {
        name: "another active level",
        at: "  PMM digital inputs:",
        find: "clamp: X14.12,",
        replace: "clamp: X14.12, active: 0,",
        expected: &["pmm: ~ type `PMM digital inputs` (30FDh), bit 8 active level: meaning: 1 -> 0 [plc]"],
    },
    Case {
        name: "another mnemonic",
        at: "  statusword:",
        find: "mnemonic: rtso\n",
        replace: "mnemonic: rso\n",
        expected: &["pmc: ~ type `statusword` (6041h), bit 0 mnemonic: meaning: rtso -> rso [documents]"],
    },
    Case {
        name: "another clamp",
        at: "  PMM digital inputs:",
        find: "clamp: X14.12,",
        replace: "clamp: X14.13,",
        expected: &[
            "pmm: ~ type `PMM digital inputs` (30FDh), bit 8 clamp: meaning: X14.12 -> X14.13 [documents]",
        ],
    },
    Case {
        name: "another error code of a bit",
        at: "  charger status:",
        find: "error: 0x2250",
        replace: "error: 0x2260",
        expected: &["pmm: ~ type `charger status` (3001h), bit 4: bit-errors: 2250h -> 2260h [documents]"],
    },
    Case {
        name: "another type of an entry",
        at: "  0x3001:",
        find: "type: charger status",
        replace: "type: chopper status",
        expected: &[
            "pmm: ~ 3001h charger status: meaning: charger status -> chopper status [plc, firmware, behaviour]",
        ],
    },
    Case {
        name: "an entry has no type any more",
        at: "  0x5094:",
        find: "    type: encoder code\n    access: rw\n    default: ENDAT",
        replace: "    type: unsigned16\n    access: rw\n    default: 0",
        expected: &["pmc: ~ 5094h encoder code: meaning: encoder code -> none [firmware, addition]"],
    },
    Case {
        name: "another name of a value that is not supported",
        at: "  battery type:",
        find: "name: sealed lead,",
        replace: "name: lead gel,",
        expected: &[
            "pmm: ~ type `battery type` (3020h.1), value 25: meaning: sealed lead -> lead gel [firmware]",
        ],
    },
];
