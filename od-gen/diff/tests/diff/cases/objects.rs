//! Objects and entries: whether they are there, what they are called, type, access.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "an object comes",
        at: "  0x3068:",
        find: "    devices: pmm",
        replace: "    devices: [pmm, pmc]",
        expected: &["pmc: + 3068h battery test voltage: unsigned16 ro [addition]"],
    },
    Case {
        name: "an object goes",
        at: "  0x2030:",
        find: "    devices: [pmm, pmc]",
        replace: "    devices: pmc",
        expected: &["pmm: - 2030h error field time stamp: ARRAY with 2 entries [plc, firmware]"],
    },
    Case {
        name: "a stored member comes",
        at: "  0x30F0:",
        find: "Limit of the PWM control value.}\n",
        replace: "Limit of the PWM control value.}\n        7: {name: reserve gain, default: 1}\n",
        expected: &[
            "pmm: + 30F0h.7 supply controller parameter set.reserve gain: unsigned16 rw locked [stored, addition]",
        ],
    },
    Case {
        name: "elements come, in one line",
        at: "  0x301F:",
        find: "      count: 8",
        replace: "      count: 10",
        expected: &["pmm: + 301Fh.9 to 301Fh.10 battery temperature.bloc 9 …: integer16 ro [addition]"],
    },
    Case {
        name: "an element goes",
        at: "  0x5664:",
        find: "{count: 2,",
        replace: "{count: 1,",
        expected: &["pmc: - 5664h.2 capture values.capture value 2: integer32 ro [plc, firmware]"],
    },
    Case {
        name: "an object is renamed",
        at: "  0x3011:",
        find: "name: actual heat sink temperature",
        replace: "name: present heat sink temperature",
        expected: &[
            "pmm: ~ 3011h present heat sink temperature: name: actual heat sink temperature -> present heat sink temperature [plc, firmware]",
        ],
    },
    Case {
        name: "an object is spelt otherwise",
        at: "  0x3011:",
        find: "name: actual heat sink temperature",
        replace: "name: Actual heat-sink temperature",
        expected: &[
            "pmm: ~ 3011h Actual heat-sink temperature: name: actual heat sink temperature -> Actual heat-sink temperature [documents]",
        ],
    },
    Case {
        name: "a member is renamed",
        at: "  0x3020:",
        find: "name: nominal capacity",
        replace: "name: rated capacity",
        expected: &[
            "pmm: ~ 3020h.2 battery parameter.rated capacity: name: nominal capacity -> rated capacity [plc, firmware]",
        ],
    },
    Case {
        name: "an object gets an identifier",
        at: "  0x3001:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    identifier: charger\n",
        expected: &["pmm: ~ 3001h charger status: identifier: none -> charger [firmware]"],
    },
    Case {
        name: "an identifier that changes nothing",
        at: "  0x3001:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    identifier: charger_status\n",
        expected: &["pmm: ~ 3001h charger status: identifier: none -> charger_status [documents]"],
    },
    Case {
        name: "an array becomes a record",
        at: "  0x5664:",
        find: "array: {count: 2, name: \"capture value {n}\", type: integer32, unit: position unit, access: ro}",
        replace: "type: integer32\n    unit: position unit\n    access: ro\n    record: {1: {name: capture value 1}, 2: {name: capture value 2}}",
        expected: &["pmc: ~ 5664h capture values: object-type: ARRAY -> RECORD [documents]"],
    },
    Case {
        name: "a wider type in a stored object",
        at: "  0x60C2:",
        find: "type: unsigned8",
        replace: "type: unsigned16",
        expected: &[
            "pmc: ~ 60C2h.1 Interpolation time period.time period value: type: unsigned8 -> unsigned16 [plc, stored, firmware]",
        ],
    },
    Case {
        name: "another sign",
        at: "  0x3010:",
        find: "type: integer16",
        replace: "type: unsigned16",
        expected: &["pmm: ~ 3010h actual battery temperature: type: integer16 -> unsigned16 [plc, firmware]"],
    },
    Case {
        name: "writing is not possible any more",
        at: "  0x567A:",
        find: "access: rw",
        replace: "access: ro",
        expected: &["pmc: ~ 567Ah EFC target position: access: rw -> ro [plc]"],
    },
    Case {
        name: "writing becomes possible",
        at: "  0x3068:",
        find: "access: ro",
        replace: "access: rw",
        expected: &["pmm: ~ 3068h battery test voltage: access: ro -> rw [addition]"],
    },
    Case {
        name: "reading is not possible any more",
        at: "  0x5681:",
        find: "access: rw",
        replace: "access: wo",
        expected: &["pmc: ~ 5681h EFC profile velocity: access: rw -> wo [plc]"],
    },
    Case {
        name: "a lock comes",
        at: "  0x3020:",
        find: "unit: milliampere hour\n        access: rw\n",
        replace: "unit: milliampere hour\n        access: rw locked\n",
        expected: &["pmm: ~ 3020h.2 battery parameter.nominal capacity: access: rw -> rw locked [plc]"],
    },
    Case {
        name: "a lock goes",
        at: "  0x30F1:",
        find: "access: rw locked",
        replace: "access: rw",
        expected: &[
            "pmm: ~ 30F1h.1 charge controller parameter set.current gain: access: rw locked -> rw [addition]",
        ],
    },
    Case {
        name: "it cannot be mapped any more",
        at: "  0x3068:",
        find: "    pdo: transmit\n",
        replace: "",
        expected: &["pmm: ~ 3068h battery test voltage: pdo: transmit -> none [plc]"],
    },
    Case {
        name: "it can be mapped in the other direction, too",
        at: "  0x3040:",
        find: "pdo: receive",
        replace: "pdo: both",
        expected: &["pmm: ~ 3040h PMM controlword: pdo: receive -> both [addition]"],
    },
    Case {
        name: "another direction of mapping",
        at: "  0x5040:",
        find: "pdo: receive",
        replace: "pdo: transmit",
        expected: &[
            "pmm: ~ 5040h manual control: pdo: receive -> transmit [plc]",
            "pmc: ~ 5040h manual control: pdo: receive -> transmit [plc]",
        ],
    },
    Case {
        name: "a standard demands it",
        at: "  0x3005:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    category: optional\n",
        expected: &["pmm: ~ 3005h test status: category: none -> optional [documents]"],
    },
    Case {
        name: "the issue that brought it",
        at: "  0x3005:",
        find: "since: \"1.08\"",
        replace: "since: \"1.09\"",
        expected: &["pmm: ~ 3005h test status: since: 1.08 -> 1.09 [documents]"],
    },
    Case {
        name: "objects that belong together",
        at: "  0x3005:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    links: [0x3001, 0x3006]\n",
        expected: &["pmm: ~ 3005h test status: links: none -> 3001h, 3006h [documents]"],
    },
    Case {
        name: "a description",
        at: "  0x3000:",
        find: "poll it cyclically",
        replace: "read it cyclically",
        expected: &[
            "pmm: ~ 3000h PMM status: about: …status of the unit; poll it cyclically. Faults are acknowled… -> …status of the unit; read it cyclically. Faults are acknowled… [documents]",
        ],
    },
    Case {
        name: "what the manual leaves open",
        at: "  0x6865:",
        find: "What the default 0 means is not stated",
        replace: "What 0 means is not stated",
        expected: &[
            "pmc: ~ 6865h difference error window: gap: What the default 0 means is not stated: no monitoring, or an… -> What 0 means is not stated: no monitoring, or an error at on… [documents]",
        ],
    },
    Case {
        name: "words to look for",
        at: "  0x3000:",
        find: "collective fault, group fault",
        replace: "collective fault",
        expected: &[
            "pmm: ~ 3000h PMM status: search: …, collective fault, group fault, state of the supply -> …, collective fault, state of the supply [documents]",
        ],
    },
    Case {
        name: "a warning",
        at: "  0x30E0:",
        find: "only after this time",
        replace: "after this time only",
        expected: &[
            "pmm: ~ 30E0h max time of power failure: warning: The emergency drive starts only after this time. -> The emergency drive starts after this time only. [documents]",
        ],
    },
    Case {
        name: "error codes of bits",
        at: "  0x3006:",
        find: ", 5: 0x4410}",
        replace: "}",
        expected: &["pmm: ~ 3006h battery temperature status, bit 5: bit-errors: 4410h -> none [documents]"],
    },
];
