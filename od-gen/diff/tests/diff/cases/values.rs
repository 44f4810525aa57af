//! Values: defaults, limits, units, special values, storage, views, conditions, what the EDS shows.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "a default",
        at: "  0x3020:",
        find: "default: 3000 mAh",
        replace: "default: 3100 mAh",
        expected: &[
            "pmm: ~ 3020h.2 battery parameter.nominal capacity: default: 3000 mAh -> 3100 mAh [behaviour]",
        ],
    },
    Case {
        name: "the same default in another notation",
        at: "  0x3020:",
        find: "default: 3000 mAh",
        replace: "default: 3.0 Ah",
        expected: &[],
    },
    Case {
        name: "a default that is an identifier",
        at: "  pmc:\n    receive:",
        find: "$NODEID + 0x300",
        replace: "$NODEID + 0x310",
        expected: &[
            "pmc: ~ 1401h.1 RPDO 2 communication parameter.COB-ID used by RPDO: default: $NODEID+0x80000300 -> $NODEID+0x80000310 [plc]",
        ],
    },
    Case {
        name: "a narrower limit",
        at: "  0x30E3:",
        find: "min: 60 min",
        replace: "min: 90 min",
        expected: &["pmm: ~ 30E3h selftest time: min: 60 min -> 90 min [plc]"],
    },
    Case {
        name: "a wider limit",
        at: "  0x30E3:",
        find: "min: 60 min",
        replace: "min: 30 min",
        expected: &["pmm: ~ 30E3h selftest time: min: 60 min -> 30 min [addition]"],
    },
    Case {
        name: "a limit where there was no limit",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    max: 50.00 °/s\n",
        expected: &["pmc: ~ 5681h EFC profile velocity: max: none -> 5000 PU/s [plc]"],
    },
    Case {
        name: "the limit of the type",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    min: 0\n",
        expected: &["pmc: ~ 5681h EFC profile velocity: min: none -> 0 PU/s [documents]"],
    },
    Case {
        name: "a narrower limit of what is only read",
        at: "  0x3068:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    max: 300 V\n",
        expected: &["pmm: ~ 3068h battery test voltage: max: none -> 300 V [documents]"],
    },
    Case {
        name: "another unit at an entry",
        at: "  0x3060:",
        find: "unit: volt",
        replace: "unit: decivolt",
        expected: &["pmm: ~ 3060h actual battery voltage: unit: 1 V -> 0.1 V [plc, firmware]"],
    },
    Case {
        name: "no unit any more",
        at: "  0x3068:",
        find: "    unit: volt\n",
        replace: "",
        expected: &["pmm: ~ 3068h battery test voltage: unit: 1 V -> none [firmware]"],
    },
    Case {
        name: "another scale of a unit",
        at: "units:",
        find: "decihertz: {symbol: Hz, scale: 1/10",
        replace: "decihertz: {symbol: Hz, scale: 1/5",
        expected: &[
            "pmc: ~ 6410h.6 motor data.nominal frequency: default: 50.0 Hz (500) -> 50.0 Hz (250) [behaviour]",
            "pmc: ~ unit `decihertz` (6410h.6): unit: 0.1 Hz -> 0.2 Hz [plc]",
        ],
    },
    Case {
        name: "another offset of a unit",
        at: "units:",
        find: "decihertz: {symbol: Hz, scale: 1/10",
        replace: "decihertz: {symbol: Hz, scale: 1/10, offset: -10",
        expected: &[
            "pmc: ~ 6410h.6 motor data.nominal frequency: default: 50.0 Hz (500) -> 50.0 Hz (600) [behaviour]",
            "pmc: ~ unit `decihertz` (6410h.6): unit: 0.1 Hz -> 0.1 Hz from -10 Hz [plc]",
        ],
    },
    Case {
        name: "another quantity of a unit",
        at: "units:",
        find: "encoder increment: {symbol: inc}",
        replace: "encoder increment: {symbol: steps}",
        expected: &[
            "pmc: ~ unit `encoder increment` (608Fh.1, 6410h.2, 688Fh.1): unit: 1 inc -> 1 steps [plc]",
        ],
    },
    Case {
        name: "a description of a unit",
        at: "units:",
        find: "milliohm: {symbol: mOhm,",
        replace: "milliohm: {about: A thousandth., symbol: mOhm,",
        expected: &[
            "pmm: ~ unit `milliohm` (3020h.7, 3020h.8, 30B4h): about: none -> A thousandth. [documents]",
        ],
    },
    Case {
        name: "a special value where there was an ordinary one",
        at: "  0x3020:",
        find: "unit: milliampere\n        access: rw\n",
        replace: "unit: milliampere\n        access: rw\n        special: {65535: not known}\n",
        expected: &[
            "pmm: + 3020h.3 battery parameter.charging current, special value 0xFFFF: not known [firmware, behaviour]",
        ],
    },
    Case {
        name: "a special value outside the limits",
        at: "  0x30E3:",
        find: "{0: automatic test off}",
        replace: "{0: automatic test off, 1: test at once}",
        expected: &["pmm: + 30E3h selftest time, special value 1: test at once [firmware, addition]"],
    },
    Case {
        name: "another name of a special value",
        at: "  0x30E3:",
        find: "{0: automatic test off}",
        replace: "{0: no automatic test}",
        expected: &[
            "pmm: ~ 30E3h selftest time, special value 0: special: automatic test off -> no automatic test [firmware, behaviour]",
        ],
    },
    Case {
        name: "a special value goes",
        at: "  0x6065:",
        find: "    special: {0xFFFFFFFF: {name: monitoring off, about: The following error is not monitored.}}",
        replace: "    special: {}",
        expected: &[
            "pmc: - 6065h following error window, special value 0xFFFFFFFF: monitoring off [plc, firmware]",
        ],
    },
    Case {
        name: "another group of storage",
        at: "  0x5681:",
        find: "stored: application",
        replace: "stored: manufacturer",
        expected: &[
            "pmc: ~ 5681h EFC profile velocity: stored: application -> manufacturer [stored, behaviour]",
        ],
    },
    Case {
        name: "kept no more",
        at: "  0x3050:",
        find: "    stored: remanent\n",
        replace: "",
        expected: &["pmm: ~ 3050h cumulative total Ah charge: stored: remanent -> no [stored, behaviour]"],
    },
    Case {
        name: "kept from now on",
        at: "  0x3040:",
        find: "    devices: pmm\n",
        replace: "    devices: pmm\n    stored: manufacturer\n",
        expected: &["pmm: ~ 3040h PMM controlword: stored: no -> manufacturer [behaviour]"],
    },
    Case {
        name: "a write condition comes",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    writable-when: \"bit(0x6041, 2) == 0\"\n",
        expected: &["pmc: ~ 5681h EFC profile velocity: writable-when: none -> bit(0x6041, 2) == 0 [plc]"],
    },
    Case {
        name: "a write condition goes",
        at: "  0x606A:",
        find: "    writable-when: \"bit(0x6041, 2) == 0\"\n",
        replace: "",
        expected: &[
            "pmc: ~ 606Ah sensor selection code: writable-when: bit(0x6041, 2) == 0 -> none [addition]",
        ],
    },
    Case {
        name: "another write condition",
        at: "  0x606A:",
        find: "bit(0x6041, 2) == 0",
        replace: "bit(0x6041, 1) == 0",
        expected: &[
            "pmc: ~ 606Ah sensor selection code: writable-when: bit(0x6041, 2) == 0 -> bit(0x6041, 1) == 0 [plc]",
        ],
    },
    Case {
        name: "the same write condition with other spaces",
        at: "  0x606A:",
        find: "bit(0x6041, 2) == 0",
        replace: "bit(0x6041,2)==0",
        expected: &[],
    },
    Case {
        name: "a view of another entry",
        at: "  0x506C:",
        find: "alias: 0x606C\n",
        replace: "alias: 0x6064\n    name: velocity actual value 16bit\n",
        expected: &[
            "pmc: ~ 506Ch velocity actual value 16bit: name: actual velocity 16bit -> velocity actual value 16bit [plc, firmware]",
            "pmc: ~ 506Ch velocity actual value 16bit: unit: 1 PU/s, 1 PU/s is 0.01 °/s -> 1 PU, 1 PU is 0.01 ° [plc, firmware]",
            "pmc: ~ 506Ch velocity actual value 16bit: alias: 606Ch × 1, rounding down, outside saturate -> 6064h × 1, rounding down, outside saturate [plc]",
        ],
    },
    Case {
        name: "a view that rounds otherwise",
        at: "  0x5079:",
        find: "rounding: down",
        replace: "rounding: nearest",
        expected: &[
            "pmc: ~ 5079h DC link circuit voltage 16bit: alias: 6079h × 0.001, rounding down, outside saturate -> 6079h × 0.001, rounding nearest, outside saturate [behaviour]",
        ],
    },
    Case {
        name: "the EDS shows a default",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    eds: {default: written}\n",
        expected: &[
            "pmc: ~ 5681h EFC profile velocity: eds: access rw, default withheld, flags 0 -> access rw, default written, flags 0 [behaviour]",
        ],
    },
    Case {
        name: "the EDS shows a flag",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    eds: {flags: [no-scan]}\n",
        expected: &[
            "pmc: ~ 5681h EFC profile velocity: eds: access rw, default withheld, flags 0 -> access rw, default withheld, flags 2 [behaviour]",
        ],
    },
    Case {
        name: "the EDS shows another access",
        at: "  0x5681:",
        find: "    devices: pmc\n",
        replace: "    devices: pmc\n    eds: {access: ro}\n",
        expected: &[
            "pmc: ~ 5681h EFC profile velocity: eds: access rw, default withheld, flags 0 -> access ro, default withheld, flags 0 [plc]",
        ],
    },
];
