//! The device as a whole: identity, abilities, PDOs.

use crate::Case;

pub(crate) const CASES: &[Case] = &[
    Case {
        name: "a bit rate goes",
        at: "  pmm:",
        find: "bit-rates: [10, 20,",
        replace: "bit-rates: [10,",
        expected: &[
            "pmm: ~ device: bit-rates: 10, 20, 50, 125, 250, 500, 800, 1000 kbit/s -> 10, 50, 125, 250, 500, 800, 1000 kbit/s [plc]",
        ],
    },
    Case {
        name: "a coarser granularity",
        at: "  pmm:",
        find: "    order-code: PMM\n",
        replace: "    order-code: PMM\n    granularity: 16\n",
        expected: &[
            "pmm: ~ device: granularity: 8 -> 16 [plc]",
            "pmm: - 1600h.5 to 1600h.8 RPDO 1 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1601h.5 to 1601h.8 RPDO 2 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1602h.5 to 1602h.8 RPDO 3 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1603h.5 to 1603h.8 RPDO 4 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1A00h.5 to 1A00h.8 TPDO 1 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1A01h.5 to 1A01h.8 TPDO 2 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1A02h.5 to 1A02h.8 TPDO 3 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
            "pmm: - 1A03h.5 to 1A03h.8 TPDO 4 mapping parameter.mapped entry 5 …: unsigned32 rw [plc, stored, firmware]",
        ],
    },
    Case {
        name: "abilities come",
        at: "  pmm:",
        find: "    order-code: PMM\n",
        replace: "    order-code: PMM\n    boot-up-master: yes\n    group-messaging: yes\n    lss: yes\n    dummies: [unsigned8]\n",
        expected: &[
            "pmm: ~ device, master: boot-up: no -> yes [addition]",
            "pmm: ~ device: group-messaging: no -> yes [addition]",
            "pmm: ~ device: lss: no -> yes [addition]",
            "pmm: ~ device: dummies: none -> unsigned8 [addition]",
        ],
    },
    Case {
        name: "network variables",
        at: "  pmm:",
        find: "    order-code: PMM\n",
        replace: "    order-code: PMM\n    dynamic-channels: {0xA080..0xA0BF: {type: boolean, access: ro, offset: 64, difference: 1}}\n",
        expected: &[
            "pmm: ~ device: dynamic-channels: none -> A080h to A0BFh boolean ro at 64 by 1 [addition]",
        ],
    },
    Case {
        name: "what holds for every error",
        at: "  pmc:",
        find: "      shown: \"bit 3 of 6041h for a fault, bit 7 of 6041h for a warning; the code in 603Fh\"\n      reaction: The watchdog contact opens.\n",
        replace: "      shown: a lamp\n      reaction: A horn sounds.\n",
        expected: &[
            "pmc: ~ device, any error: reaction: The watchdog contact opens. -> A horn sounds. [behaviour]",
            "pmc: ~ device, any error: shown: bit 3 of 6041h for a fault, bit 7 of 6041h for a warning; th… -> a lamp [behaviour]",
        ],
    },
    Case {
        name: "what resets every error",
        at: "  pmc:",
        find: "once no error is pending\"",
        replace: "at any time\"",
        expected: &[
            "pmc: ~ device, any error: reset: bit 7 of 6040h from 0 to 1 once no error is pending -> bit 7 of 6040h from 0 to 1 at any time [behaviour]",
        ],
    },
    Case {
        name: "the product code",
        at: "  pmm:",
        find: "product: 0\n",
        replace: "product: 7\n",
        expected: &["pmm: ~ device, code: product: 0x00000000 -> 0x00000007 [plc]"],
    },
    Case {
        name: "the product's revision",
        at: "  pmm:",
        find: "product-revision: 0\n",
        replace: "product-revision: 0x0001_0000\n",
        expected: &["pmm: ~ device, 1018h.3: product-revision: 0x00000000 -> 0x00010000 [addition]"],
    },
    Case {
        name: "the product's name",
        at: "  pmm:",
        find: "product-name: PMM\n",
        replace: "product-name: PMM 2\n",
        expected: &[
            "pmm: ~ device, name: product: PMM -> PMM 2 [documents]",
            "pmm: ~ 1008h Manufacturer device name: default: PMM -> PMM 2 [behaviour]",
        ],
    },
    Case {
        name: "the device type",
        at: "  pmc:",
        find: "device-type: 0x00020192",
        replace: "device-type: 0x00030192",
        expected: &["pmc: ~ device, 1000h: device-type: 0x00020192 -> 0x00030192 [plc]"],
    },
    Case {
        name: "the device's name",
        at: "  pmm:",
        find: "name: Pitch Management Module",
        replace: "name: Pitch management unit",
        expected: &["pmm: ~ device: name: Pitch Management Module -> Pitch management unit [documents]"],
    },
    Case {
        name: "what the EDS says about itself",
        at: "  pmm:",
        find: "created: 2009-05-27 09:00",
        replace: "created: 2009-05-28 09:00",
        expected: &[
            "pmm: ~ device, created: eds: 2009-05-27 09:00 -> 2009-05-28 09:00 [documents]",
            "pmm: ~ device, modified: eds: 2009-05-27 09:00 -> 2009-05-28 09:00 [documents]",
        ],
    },
    Case {
        name: "the maker's number",
        at: "vendor:",
        find: "number: 0}",
        replace: "number: 0x123}",
        expected: &["*: ~ system, number: vendor: 0x00000000 -> 0x00000123 [plc]"],
    },
    Case {
        name: "the maker's name",
        at: "vendor:",
        find: "name: OAT Osterholz AntriebsTechnik GmbH",
        replace: "name: OAT GmbH",
        expected: &["*: ~ system, name: vendor: OAT Osterholz AntriebsTechnik GmbH -> OAT GmbH [documents]"],
    },
    Case {
        name: "a PDO carries something else",
        at: "pdos:",
        find: "map: [0x6040, 0x60FF]",
        replace: "map: [0x60FF]",
        expected: &[
            "pmc: ~ 1602h RPDO 3 mapping parameter: map: 6040h Controlword (16), 60FFh target velocity (32) -> 60FFh target velocity (32) [plc, firmware]",
        ],
    },
    Case {
        name: "a PDO carries more",
        at: "pdos:",
        find: "map: [0x6040]",
        replace: "map: [0x6040, 0x6060]",
        expected: &[
            "pmc: ~ 1600h RPDO 1 mapping parameter: map: 6040h Controlword (16) -> 6040h Controlword (16), 6060h modes of operation (8) [plc]",
        ],
    },
    Case {
        name: "a PDO exists from the start",
        at: "  pmc:\n    receive:",
        find: "$NODEID + 0x300, valid: no",
        replace: "$NODEID + 0x300",
        expected: &[
            "pmc: ~ 1401h.1 RPDO 2 communication parameter.COB-ID used by RPDO: default: $NODEID+0x80000300 -> $NODEID+0x300 [plc]",
        ],
    },
    Case {
        name: "a TPDO answers remote frames",
        at: "  pmc:\n    receive:",
        find: "no-rtr: yes, map: [0x6041]}",
        replace: "map: [0x6041]}",
        expected: &[
            "pmc: ~ 1800h.1 TPDO 1 communication parameter.COB-ID used by TPDO: default: $NODEID+0x40000180 -> $NODEID+0x180 [plc]",
        ],
    },
    Case {
        name: "another transmission type",
        at: "  pmc:\n    receive:",
        find: "$NODEID + 0x280,",
        replace: "$NODEID + 0x280, transmission: 1,",
        expected: &[
            "pmc: ~ 1801h.2 TPDO 2 communication parameter.transmission type: default: 255 -> 1 [behaviour]",
        ],
    },
    Case {
        name: "a PDO comes",
        at: "  pmc:\n    receive:",
        find: "map: [0x6064, 0x606C]}\n",
        replace: "map: [0x6064, 0x606C]}\n      5: {cob-id: 0x190, valid: no, map: [0x606C]}\n",
        expected: &[
            "pmc: ~ device, TPDOs: pdos: 4 -> 5 [addition]",
            "pmc: + 1804h TPDO 5 communication parameter: RECORD with 3 entries [stored, addition]",
            "pmc: + 1A04h TPDO 5 mapping parameter: RECORD with 9 entries [stored, addition]",
        ],
    },
    Case {
        name: "a description of a PDO",
        at: "pdos:",
        find: "1: {cob-id: $NODEID + 0x200, map: [0x6040]}",
        replace: "1: {cob-id: $NODEID + 0x200, map: [0x6040], about: The commands.}",
        expected: &["pmc: ~ 1400h RPDO 1: about: none -> The commands. [documents]"],
    },
];
