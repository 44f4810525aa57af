//! Specifications with many mistakes, or with one that represents many.

use super::{Pattern, device_with, each, index, list, objects, pattern, spec};

/// The patterns.
pub const WRONG: &[Pattern] = &[
    pattern("objects that are like none", |n| {
        spec("", &each(n, |at| format!("  0x{:X}: {{name: o{at}, like: 0x9FFF}}\n", index(at))))
    }),
    pattern("objects that are like themselves", |n| {
        let like =
            |at: usize| format!("  0x{:X}: {{name: o{at}, like: 0x{:X}}}\n", index(at), index((at + 1) % n));
        spec("", &each(n, like))
    }),
    pattern("a run of arrays", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", array: {{count: 254, name: \"{{n}}\", type: unsigned8, access: ro}}}}\n",
                index(n)
            ),
        )
    }),
    pattern("a run of records", |n| {
        let members = list(250, |at| format!("{}: {{name: m{at}, type: unsigned8, access: ro}}", at + 1));
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", record: {{{members}}}}}\n", index(n)))
    }),
    pattern("an array with a long text", |n| {
        let text = "long ".repeat(20 * n);
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, array: {{count: 254, name: \"{{n}}\", type: unsigned8, access: ro, about: {text}}}}}\n"
            ),
        )
    }),
    pattern("a run of an unknown type", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned9, access: ro}}\n", index(n)))
    }),
    pattern("a run of an unknown unit", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8, unit: volt, access: ro}}\n",
                index(n)
            ),
        )
    }),
    pattern("a run of aliases of nothing", |n| {
        let run = format!(
            "  0x6000..0x{:X}: {{name: \"b {{n}}\", type: unsigned8, alias: objekt 1}}\n",
            0x6000 + n
        );
        spec("", &(objects(n, |_| String::new()) + &run))
    }),
    pattern("a run from no library", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", from: cia310}}\n", index(n)))
    }),
    pattern("a run from a library without it", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", from: cia301}}\n", index(n)))
    }),
    pattern("a run with a bad default", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8, access: ro, default: 300}}\n",
                index(n)
            ),
        )
    }),
    pattern("a run on an unknown device", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", devices: e, type: unsigned8, access: ro}}\n",
                index(n)
            ),
        )
    }),
    pattern("a run without an access", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8}}\n", index(n)))
    }),
    pattern("a run with one name", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: a, type: unsigned8, access: ro}}\n", index(n)))
    }),
    pattern("a run with a condition about nothing", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8, access: rw, writable-when: \"0x1FFF == 1\"}}\n",
                index(n)
            ),
        )
    }),
    pattern("unknown keys in one line", |n| {
        spec("", &format!("  0x2000: {{{}}}\n", list(n, |at| format!("key{at}: 1"))))
    }),
    pattern("unknown keys", |n| {
        spec("", &format!("  0x2000:\n{}", each(n, |at| format!("    key{at}: 1\n"))))
    }),
    pattern("keys with a slip", |n| {
        spec("", &each(n, |at| format!("  0x{:X}: {{name: a, tpye: unsigned8, acess: ro}}\n", index(at))))
    }),
    pattern("unknown keys in one foreign line", |n| {
        spec("", &format!("  0x2000: {{{}}}\n", list(n, |at| format!("größe{at}: 1"))))
    }),
    pattern("wrong keys of a section", |n| {
        spec(
            &format!("types:\n  t: {{base: unsigned8, values: {{{}}}}}\n", list(n, |at| format!("v{at}: a"))),
            "",
        )
    }),
    pattern("unknown devices in a list", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned8, access: ro, devices: [{}]}}\n",
                list(n, |at| format!("e{at}"))
            ),
        )
    }),
    pattern("unknown features", |n| {
        device_with(
            &format!(
                ", about: x\n    }}\n  e: {{name: e, features: [{}]",
                list(n, |at| format!("feature {at}"))
            ),
            "",
            "",
        )
    }),
    pattern("one feature many times", |n| {
        format!(
            "od-spec: 1\nuses: [cia301]\ndevices:\n  e: {{name: e, features: [{}]}}\n",
            "heartbeat producr, ".repeat(n)
        )
    }),
    pattern("unknown libraries", |n| {
        format!("od-spec: 1\ntitle: t\nuses: [{}]\n", list(n, |at| format!("cia{at}")))
    }),
    pattern("one library many times", |n| {
        format!("od-spec: 1\ntitle: t\nuses: [{}]\n", "cia301, ".repeat(n))
    }),
    pattern("unknown types", |n| {
        spec(
            "",
            &each(n, |at| format!("  0x{:X}: {{name: o{at}, type: kind {at}, access: ro}}\n", index(at))),
        )
    }),
    pattern("unknown types among types", |n| {
        let types = each(n, |at| format!("  sort {at}: {{base: unsigned8, values: {{0: a}}}}\n"));
        spec(
            &format!("types:\n{types}"),
            &each(n, |at| format!("  0x{:X}: {{name: o{at}, type: srt {at}, access: ro}}\n", index(at))),
        )
    }),
    pattern("unknown units among units", |n| {
        let units = each(n, |at| format!("  unit {at}: {{symbol: u{at}}}\n"));
        spec(&format!("units:\n{units}"), &objects(n, |at| format!(", unit: unti {at}")))
    }),
    pattern("broken types", |n| {
        let types = each(n, |at| format!("  sort {at}: {{base: real32, values: {{0: a}}}}\n"));
        spec(
            &format!("types:\n{types}"),
            &each(n, |at| format!("  0x{:X}: {{name: o{at}, type: sort {at}, access: ro}}\n", index(at))),
        )
    }),
    pattern("broken units", |n| {
        let units = each(n, |at| format!("  unit {at}: {{symbol: u{at}, scale: x}}\n"));
        spec(&format!("units:\n{units}"), &objects(n, |at| format!(", unit: unit {at}")))
    }),
    pattern("unknown values of an enum", |n| {
        let types = format!(
            "types:\n  t: {{base: unsigned32, values: {{{}}}}}\n",
            list(n, |at| format!("{at}: value {at}"))
        );
        spec(
            &types,
            &each(n, |at| {
                format!("  0x{:X}: {{name: o{at}, type: t, access: ro, default: vlaue {at}}}\n", index(at))
            }),
        )
    }),
    pattern("aliases of nothing", |n| {
        let aliases = each(n, |at| {
            format!("  0x{:X}: {{name: alias {at}, type: unsigned8, alias: objekt {at}}}\n", 0x6000 + at)
        });
        spec("", &(objects(n, |_| String::new()) + &aliases))
    }),
    pattern("aliases of aliases", |n| {
        let aliases = each(n, |at| {
            format!("  0x{:X}: {{name: alias {at}, type: unsigned8, alias: alias {at}}}\n", 0x6000 + at)
        });
        spec("", &(objects(n, |_| String::new()) + &aliases))
    }),
    pattern("aliases of broken objects", |n| {
        let broken = each(n, |at| {
            format!("  0x{:X}: {{name: broken {at}, type: unsigned9, access: ro}}\n", index(at))
        });
        let aliases = each(n, |at| {
            format!("  0x{:X}: {{name: alias {at}, type: unsigned8, alias: broken {at}}}\n", 0x6000 + at)
        });
        spec("", &(broken + &aliases))
    }),
    pattern("a PDO that maps nothing", |n| {
        let pdos = format!(
            "pdos:\n  d:\n    transmit:\n      1: {{map: [{}]}}\n",
            list(n, |at| format!("objekt {at}"))
        );
        spec(&pdos, &objects(n, |_| String::new()))
    }),
    pattern("PDOs of no device", |n| {
        spec(&format!("pdos:\n{}", each(n, |at| format!("  e{at}: {{}}\n"))), "")
    }),
    pattern("errata of nothing", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |at| format!(
                "  - {{at: objekt {at}, kind: name, place: p, prints: a, reads: b, because: c}}\n"
            ))
        );
        spec(&errata, &objects(n, |_| String::new()))
    }),
    pattern("an erratum of many things", |n| {
        let errata = format!(
            "errata:\n  - {{at: [{}], kind: name, place: p, prints: a, reads: b, because: c}}\n",
            list(n, |at| format!("objekt {at}"))
        );
        spec(&errata, &objects(n, |_| String::new()))
    }),
    pattern("errata of no table", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |at| format!(
                "  - {{at: object {at}, kind: name, place: Table {at}, prints: a, reads: b, because: c}}\n"
            ))
        );
        spec(
            &(errata + "document:\n  - {section: \"1\", title: a, content: [{glossary: yes}]}\n"),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("tables of nothing", |n| {
        let tables = list(n, |at| {
            format!(
                "{{number: 1, bits: sort {at}}}, {{states: m{at}}}, {{ladder: l{at}}}, {{overview: [0x5FFF]}}, {{errors: 0x1000}}"
            )
        });
        let types = each(n, |at| format!("  sorts {at}: {{base: unsigned8, values: {{0: a}}}}\n"));
        spec(
            &format!("types:\n{types}document:\n  - {{section: \"1\", title: a, content: [{tables}]}}\n"),
            "",
        )
    }),
    pattern("constraints by a name that all objects have", |n| {
        let constraints = each(n, |at| format!("  c{at}: {{require: \"same <= {at}\"}}\n"));
        let object = |at: usize| {
            let index = index(at);
            format!("  0x{index:X}: {{name: same, identifier: s{at}, type: unsigned8, access: rw}}\n")
        };
        spec(&format!("constraints:\n{constraints}"), &each(n, object))
    }),
    pattern("constraints about nothing", |n| {
        let list = each(n, |at| format!("  c{at}: {{require: \"0x{:X} < e{at}:0x2000\"}}\n", 0x6000 + at));
        spec(&format!("constraints:\n{list}"), &objects(10, |_| String::new()))
    }),
    pattern("constraints that do not hold", |n| {
        let list = each(n, |at| format!("  c{at}: {{require: \"0x{:X} > 5\"}}\n", index(at)));
        spec(&format!("constraints:\n{list}"), &objects(n, |_| ", default: 1".to_owned()))
    }),
    pattern("states of nothing", |n| {
        let states = each(n, |at| format!("      s{at}: {{pattern: \"xxxx xxxx xxxx xxx{}\"}}\n", at % 2));
        let transitions = list(256, |at| format!("{at}: {{from: t{at}, to: u{at}, event: e}}"));
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states:\n{states}    transitions: {{{transitions}}}\n"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("overlapping states", |n| {
        let states = each(n, |at| format!("      s{at}: {{pattern: \"xxxx xxxx xxxx xxx{}\"}}\n", at % 2));
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states:\n{states}"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("overlapping commands", |n| {
        let commands = each(n, |at| {
            format!(
                "      s{at}: {{pattern: \"xxxx xxxx xxxx xxx{}\", send: 70000, transitions: [9]}}\n",
                at % 2
            )
        });
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states: {{a: {{pattern: \"xxxx xxxx xxxx xxx0\"}}}}\n    commands:\n{commands}"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("machines of nothing", |n| {
        spec(
            &format!(
                "state-machines:\n{}",
                each(n, |at| format!(
                    "  m{at}: {{status: objekt {at}, command: objekt {at}, states: {{a: {{pattern: xxxxxxx1}}}}}}\n"
                ))
            ),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("transitions from unknown states", |n| {
        let from = list(n, |at| format!("sta {at}"));
        let states = each(n, |at| format!("      state {at}: {{pattern: xxxxxxx1}}\n"));
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states:\n{states}    transitions: {{0: {{from: [{from}], to: state 1, event: e}}}}\n"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("one index", |n| {
        spec("", &each(n, |_| "  0x2000: {name: a, type: unsigned8, access: ro}\n".to_owned()))
    }),
    pattern("one index in several spellings", |n| {
        spec(
            "",
            &each(n, |at| {
                format!("  0x{}2000: {{name: a, type: unsigned8, access: ro}}\n", "0".repeat(at % 50))
            }),
        )
    }),
    pattern("objects of one name", |n| {
        spec("", &each(n, |at| format!("  0x{:X}: {{name: a, type: unsigned8, access: ro}}\n", index(at))))
    }),
    pattern("values of one name", |n| {
        spec(
            &format!(
                "types:\n  t: {{base: unsigned32, values: {{{}}}}}\n",
                list(n, |at| format!("{at}: same"))
            ),
            "",
        )
    }),
    pattern("values of one number", |n| {
        spec(
            &format!(
                "types:\n  t: {{base: unsigned32, values: {{{}}}}}\n",
                list(n, |at| format!("0{}x1: n{at}", "0".repeat(at % 9)))
            ),
            "",
        )
    }),
    pattern("channels of one index", |n| {
        device_with(
            &format!(
                ", dynamic-channels: {{{}}}",
                list(n, |at| format!(
                    "0xA000..0x{:X}: {{type: unsigned8, access: ro, offset: 0}}",
                    0xA000 + at
                ))
            ),
            "",
            "",
        )
    }),
    pattern("allowed codes of nothing", |n| {
        spec(&format!("allow: {{{}}}\n", list(n, |at| format!("OD{at}: x"))), "")
    }),
    pattern("allowed at objects of nothing", |n| {
        spec(
            &format!(
                "allow: {{OD0801: {{about: x, at: [{}]}}}}\n",
                list(n, |at| format!("0x{:X}", index(at)))
            ),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("allowed at no object", |n| {
        spec(
            &format!(
                "allow: {{OD0801: {{about: x, at: [{}]}}}}\n",
                list(n, |at| format!("0x{:X}", 0x6000 + at))
            ),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("unknown languages", |n| {
        spec(
            &format!("title: x\nglossary: {{a: {{{}}}}}\n", list(n, |at| format!("l{at}: x"))).replacen(
                "title: x\n",
                "",
                1,
            ),
            "",
        )
    }),
    pattern("links to nothing", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned8, access: ro, links: [{}]}}\n",
                list(n, |at| format!("0x{:X}", 0x2001 + at % 0x3000))
            ),
        )
    }),
    pattern("omitted entries that are not there", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, omit: [{}], array: {{count: 3, name: \"{{n}}\", type: unsigned8, access: ro}}}}\n",
                list(n, |at| format!("{}", 9 + at))
            ),
        )
    }),
    pattern("bit errors of no bits", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned8, access: ro, bit-errors: {{{}}}}}\n",
                list(n, |at| format!("{}..{}: {at}", at % 64, 63))
            ),
        )
    }),
    pattern("devices with nothing", |n| {
        format!("od-spec: 1\ndevices:\n{}", each(n, |at| format!("  d{at}: {{name: d{at}}}\n")))
    }),
    pattern("devices with one unknown type", |n| {
        format!(
            "od-spec: 1\ndevices:\n{}objects:\n  0x2000: {{name: a, type: unsigned9, access: ro}}\n",
            each(n, |at| format!("  d{at}: {{name: d{at}}}\n"))
        )
    }),
    pattern("devices with broken objects", |n| {
        format!(
            "od-spec: 1\ndevices:\n{}objects:\n{}",
            each(n, |at| format!("  d{at}: {{name: d{at}}}\n")),
            each(n, |at| format!(
                "  0x{:X}: {{name: o{at}, type: unsigned9, access: ro, devices: d{at}}}\n",
                index(at)
            ))
        )
    }),
    pattern("a run of objects without a name", |n| spec("", &format!("  0x2000..0x{:X}: {{}}\n", index(n)))),
    pattern("a run of objects without a type", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", access: ro}}\n", index(n)))
    }),
    pattern("a run of objects with values that do not fit", |n| {
        spec(
            "",
            &format!(
                "  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8, access: rw, default: 300, min: 400}}\n",
                index(n)
            ),
        )
    }),
    pattern("objects without keys", |n| spec("", &each(n, |at| format!("  0x{:X}: {{}}\n", index(at))))),
    pattern("placeholders of no type", |n| {
        device_with(&format!(", dummies: [{}]", list(n, |at| format!("unsignd{at}"))), "", "")
    }),
    pattern("bit rates of no device", |n| {
        device_with(&format!(" , bit-rates: [{}]", "11, ".repeat(n)), "", "").replacen(
            "bit-rates: [125], ",
            "",
            1,
        )
    }),
    pattern("tabs and quotes", |n| spec("", &each(n, |_| "  \"0x2000\\n\": \"\\t\"\n".to_owned()))),
    pattern("long broken condition", |n| {
        spec(
            &format!(
                "constraints:\n  c: {{require: \"{}\"}}\n",
                list(n, |at| format!("0x2000 < {at}")).replace(", ", " and ")
            ),
            &objects(2, |_| String::new()),
        )
    }),
];
