//! Error codes, conditions between entries, state machines.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "an error code goes",
        at: "errors:",
        find: "  0x3110: {name: Grid over voltage, devices: pmm, search: {en: [mains too high, mains overvoltage], de: [Netzspannung zu hoch, Netzüberspannung]}}\n",
        replace: "",
        expected: &["pmm: - error 3110h Grid over voltage: Grid over voltage [plc, firmware]"],
    },
    Case {
        name: "an error code comes",
        at: "errors:",
        find: "  0x3110: {",
        replace: "  0x3121: {name: Grid missing, devices: pmm}\n  0x3110: {",
        expected: &["pmm: + error 3121h Grid missing: Grid missing [addition]"],
    },
    Case {
        name: "an error code is called otherwise",
        at: "errors:",
        find: "name: Grid under voltage",
        replace: "name: Mains under voltage",
        expected: &[
            "pmm: ~ error 3120h Mains under voltage: name: Grid under voltage -> Mains under voltage [firmware]",
        ],
    },
    Case {
        name: "another reaction to an error",
        at: "errors:",
        find: "priority: A, reaction: The motor is switched off.",
        replace: "priority: B, reaction: The motor runs on.",
        expected: &[
            "pmc: ~ error 6080h Software trap, Firmware error: reaction: The motor is switched off. -> The motor runs on. [behaviour]",
            "pmc: ~ error 6080h Software trap, Firmware error: priority: A -> B [behaviour]",
        ],
    },
    Case {
        name: "another option code chooses the reaction to an error",
        at: "errors:",
        find: "option-code: 0x605E",
        replace: "option-code: 0x6007",
        expected: &[
            "pmc: ~ error 7305h Encoder error (motor), sine/cosine: option-code: 605Eh -> 6007h [behaviour]",
        ],
    },
    Case {
        name: "an error gets a reset of its own",
        at: "errors:",
        find: "  0x3120:\n    name: Grid under voltage\n",
        replace: "  0x3120:\n    name: Grid under voltage\n    reset: power-off\n",
        expected: &[
            "pmm: ~ error 3120h Grid under voltage: reset: bit 7 of 3040h from 0 to 1, or an NMT reset command -> power-off [behaviour]",
        ],
    },
    Case {
        name: "another condition",
        at: "  shutdown after ride-through:",
        find: "0x30E0 < 0x30E1",
        replace: "0x30E0 <= 0x30E1",
        expected: &[
            "pmm: ~ condition `shutdown after ride-through`: require: 0x30E0 < 0x30E1 -> 0x30E0 <= 0x30E1 [plc]",
        ],
    },
    Case {
        name: "the same condition with other spaces",
        at: "  shutdown after ride-through:",
        find: "0x30E0 < 0x30E1",
        replace: "0x30E0<0x30E1",
        expected: &[],
    },
    Case {
        name: "a condition under another name",
        at: "  shutdown after ride-through:",
        find: "  shutdown after ride-through:",
        replace: "  ride-through before shutdown:",
        expected: &[
            "pmm: + condition `ride-through before shutdown`: 0x30E0 < 0x30E1 [documents]",
            "pmm: - condition `shutdown after ride-through`: 0x30E0 < 0x30E1 [firmware]",
        ],
    },
    Case {
        name: "a condition goes",
        at: "constraints:",
        find: "  shutdown after ride-through:\n    devices: pmm\n    about: The time to the shutdown has to cover the bridged power failure and, after it, the travel to the feather position.\n    require: \"0x30E0 < 0x30E1\"\n",
        replace: "",
        expected: &["pmm: - condition `shutdown after ride-through`: 0x30E0 < 0x30E1 [firmware, addition]"],
    },
    Case {
        name: "a state has another pattern",
        at: "state-machines:",
        find: "Fault: {pattern: \"xxxx xxxx x0xx 1000\"",
        replace: "Fault: {pattern: \"xxxx xxxx xxxx 1000\"",
        expected: &[
            "pmc: ~ state machine `power drive`, state Fault: meaning: xxxxxxxxx0xx1000 -> xxxxxxxxxxxx1000 [plc]",
        ],
    },
    Case {
        name: "a command goes",
        at: "state-machines:",
        find: "      Disable operation: {pattern: \"xxxx xxx1 0xx0 0111\", send: 0x0107, transitions: [5], about: The axis stops and stays switched on.}\n",
        replace: "",
        expected: &[
            "pmc: - state machine `power drive`, command Disable operation: xxxxxxx10xx00111, sent as 0x107 [plc, firmware]",
        ],
    },
    Case {
        name: "a command causes more",
        at: "state-machines:",
        find: "transitions: [5],",
        replace: "transitions: [5, 7],",
        expected: &[
            "pmc: ~ state machine `power drive`, command Disable operation, transitions: reaction: 5 -> 5, 7 [behaviour]",
        ],
    },
    Case {
        name: "a transition leads elsewhere",
        at: "state-machines:",
        find: "        from: Fault reaction active\n        to: Fault\n",
        replace: "        from: Fault reaction active\n        to: Switch-on disabled\n",
        expected: &[
            "pmc: ~ state machine `power drive`, transition 14: meaning: from Fault reaction active to Fault -> from Fault reaction active to Switch-on disabled [plc]",
        ],
    },
    Case {
        name: "a transition has another action",
        at: "state-machines:",
        find: "action: The watchdog contact closes.",
        replace: "action: The watchdog contact stays closed.",
        expected: &[
            "pmc: ~ state machine `power drive`, transition 15, action: reaction: The watchdog contact closes. -> The watchdog contact stays closed. [behaviour]",
        ],
    },
    Case {
        name: "the device no longer makes a transition by itself",
        at: "state-machines:",
        find: "        by-device: event\n        event: Disable Voltage commanded, or enable input off.",
        replace: "        event: Disable Voltage commanded, or enable input off.",
        expected: &[
            "pmc: ~ state machine `power drive`, transition 9, by-device: reaction: event -> never [behaviour]",
        ],
    },
    Case {
        name: "an error is reported as another kind, too",
        at: "errors:",
        find: "  0x3120:\n    name: Grid under voltage\n",
        replace: "  0x3120:\n    name: Grid under voltage\n    register: [voltage, manufacturer]\n",
        expected: &["pmm: ~ error 3120h Grid under voltage: register: 0x05 -> 0x85 [plc]"],
    },
    Case {
        name: "an error is reported as the kind of its class",
        at: "errors:",
        find: "  0x3120:\n    name: Grid under voltage\n",
        replace: "  0x3120:\n    name: Grid under voltage\n    register: voltage\n",
        expected: &[],
    },
    Case {
        name: "another device treats an error",
        at: "errors:",
        find: "    treated-by: pmc\n    priority: A",
        replace: "    priority: A",
        expected: &[
            "pmm: ~ error 6010h Watchdog-Reset, treated-by: reaction: otherwise -> as stated [behaviour]",
        ],
    },
    Case {
        name: "a priority comes",
        at: "errors:",
        find: "  0x3120:\n    name: Grid under voltage\n",
        replace: "  0x3120:\n    name: Grid under voltage\n    priority: B\n",
        expected: &["pmm: ~ error 3120h Grid under voltage: priority: none -> B [behaviour]"],
    },
];
