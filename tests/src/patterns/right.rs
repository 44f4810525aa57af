//! Specifications without a mistake.

use super::{Pattern, device_with, each, index, list, objects, pattern, spec};

/// The patterns.
pub const RIGHT: &[Pattern] = &[
    pattern("objects", |n| spec("", &objects(n, |_| String::new()))),
    pattern("objects with texts", |n| {
        spec("", &objects(n, |at| format!(", default: {at}, about: object number {at}")))
    }),
    pattern("a run of objects", |n| {
        spec("", &format!("  0x2000..0x{:X}: {{name: \"a {{n}}\", type: unsigned8, access: ro}}\n", index(n)))
    }),
    pattern("objects that are like one another", |n| {
        let like = |at: usize| {
            format!(
                "  0x{:X}: {{name: o{at}, like: 0x{:X}, default: {}}}\n",
                index(at),
                index(at + 1),
                at % 200
            )
        };
        let last = format!("  0x{:X}: {{name: last, type: unsigned8, access: rw}}\n", index(n));
        spec("", &format!("{}{last}", each(n, like)))
    }),
    pattern("records", |n| {
        spec(
            "",
            &each(n, |at| {
                format!(
                    "  0x{:X}: {{name: o{at}, record: {{1: {{name: a, type: unsigned8, access: ro}}, 2: {{name: b, type: integer16, access: rw, stored: application}}}}}}\n",
                    index(at)
                )
            }),
        )
    }),
    pattern("errata by name", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |at| format!(
                "  - {{at: object {at}, kind: name, place: page {at}, prints: a, reads: b, because: c}}\n"
            ))
        );
        spec(&errata, &objects(n, |_| String::new()))
    }),
    pattern("errata by index", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |at| format!(
                "  - {{at: 0x{:X}, kind: name, place: page {at}, prints: a, reads: b, because: c}}\n",
                index(at)
            ))
        );
        spec(&errata, &objects(n, |_| String::new()))
    }),
    pattern("errata of tables", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |at| format!(
                "  - {{at: 0x{:X}, kind: name, place: \"1.{at}, Table {at}\", prints: a, reads: b, because: c}}\n",
                index(at)
            ))
        );
        let sections = each(n, |at| {
            format!(
                "  - {{section: \"1.{at}\", title: s, content: [{{number: {at}, title: t, objects: [0x{:X}]}}]}}\n",
                index(at)
            )
        });
        spec(
            &format!("{errata}document:\n{}", sections.replacen("number: 0,", "", 1)),
            &objects(n, |_| String::new()),
        )
        .replace("Table 0\"", "page 0\"")
    }),
    pattern("errata of all tables", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |_| format!(
                "  - {{at: 0x2000, kind: name, place: Tables 1 to {n}, prints: a, reads: b, because: c}}\n"
            ))
        );
        let tables = list(n, |at| format!("{{number: {}, title: t, objects: [0x2000]}}", at + 1));
        spec(
            &format!("{errata}document:\n  - {{section: \"1.1\", title: s, content: [{tables}]}}\n"),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("errata of all sections", |n| {
        let errata = format!(
            "errata:\n{}",
            each(n, |_| format!(
                "  - {{at: 0x2000, kind: name, place: 1.0 to 1.{}, prints: a, reads: b, because: c}}\n",
                n - 1
            ))
        );
        let sections = each(n, |at| {
            format!("  - {{section: \"1.{at}\", title: s, content: [{{overview: [0x2000]}}]}}\n")
        });
        spec(&format!("{errata}document:\n{sections}"), &objects(2, |_| String::new()))
    }),
    pattern("a list with an anchor", |n| {
        let rows = list(n, |at| format!("[a{at}, b]"));
        let tables = list(n, |_| "{rows: {columns: [x, y], rows: *rows}}".to_owned());
        spec(
            &format!(
                "document:\n  - {{section: \"1\", title: s, content: [{{rows: {{columns: [x, y], rows: &rows [{rows}]}}}}, {tables}]}}\n"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("aliases", |n| {
        let aliases = each(n, |at| {
            format!("  0x{:X}: {{name: alias {at}, type: unsigned8, alias: object {at}}}\n", 0x6000 + at)
        });
        spec("", &(objects(n, |_| String::new()) + &aliases))
    }),
    pattern("aliases by index", |n| {
        let aliases = each(n, |at| {
            format!(
                "  0x{:X}: {{name: alias {at}, type: unsigned8, alias: 0x{:X}}}\n",
                0x6000 + at,
                index(at)
            )
        });
        spec("", &(objects(n, |_| String::new()) + &aliases))
    }),
    pattern("aliases of one object", |n| {
        let aliases = each(n, |at| {
            format!("  0x{:X}: {{name: alias {at}, type: unsigned8, alias: object 0}}\n", 0x6000 + at)
        });
        spec("", &(objects(n, |_| String::new()) + &aliases))
    }),
    pattern("devices with objects of their own", |n| {
        let devices = each(n, |at| {
            format!("  d{at}: {{name: device {at}, bit-rates: [125], eds: {{created: 2024-02-29 12:00}}}}\n")
        });
        let objects = each(n, |at| {
            format!(
                "  0x{:X}: {{name: object {at}, devices: d{at}, type: unsigned8, access: ro}}\n",
                index(at)
            )
        });
        format!("od-spec: 1\ntitle: t\ndevices:\n{devices}objects:\n{objects}")
    }),
    pattern("devices with different objects at one index", |n| {
        let devices = each(n, |at| {
            format!("  d{at}: {{name: device {at}, bit-rates: [125], eds: {{created: 2024-02-29 12:00}}}}\n")
        });
        let objects = each(n, |at| {
            format!("    - {{devices: d{at}, name: object {at}, type: unsigned8, access: ro}}\n")
        });
        format!("od-spec: 1\ntitle: t\ndevices:\n{devices}objects:\n  0x2000:\n{objects}")
    }),
    pattern("devices with conditions of their own", |n| {
        let devices = each(n, |at| {
            format!("  d{at}: {{name: device {at}, bit-rates: [125], eds: {{created: 2024-02-29 12:00}}}}\n")
        });
        let objects = each(n, |at| {
            format!(
                "  0x{:X}: {{name: object {at}, devices: d{at}, type: unsigned8, access: rw, writable-when: \"0x{:X} == 0\"}}\n",
                index(at),
                index(at)
            )
        });
        let constraints =
            each(n, |at| format!("  c{at}: {{devices: d{at}, require: \"d{at}:0x{:X} < 9\"}}\n", index(at)));
        format!("od-spec: 1\ntitle: t\ndevices:\n{devices}objects:\n{objects}constraints:\n{constraints}")
    }),
    pattern("devices with machines, PDOs and errata of their own", |n| {
        let devices = each(n, |at| {
            format!("  d{at}: {{name: device {at}, bit-rates: [125], eds: {{created: 2024-02-29 12:00}}}}\n")
        });
        let objects = each(n, |at| {
            format!(
                "  0x{:X}: {{name: object {at}, devices: d{at}, type: unsigned8, access: rw, pdo: both}}\n",
                index(at)
            )
        });
        let pdos = each(n, |at| format!("  d{at}: {{transmit: {{1: {{map: [object {at}]}}}}}}\n"));
        let machines = each(n, |at| {
            format!(
                "  m{at}: {{devices: d{at}, status: object {at}, command: object {at}, states: {{a: {{pattern: xxxxxxx1}}}}}}\n"
            )
        });
        let errata = each(n, |at| {
            format!(
                "  - {{at: object {at}, devices: d{at}, kind: name, place: page, prints: a, reads: b, because: c}}\n"
            )
        });
        let errors = each(n, |at| format!("  0x{at:04X}: {{name: error {at}, devices: d{at}}}\n"));
        format!(
            "od-spec: 1\ntitle: t\nuses: [cia301]\ndevices:\n{devices}objects:\n{objects}pdos:\n{pdos}state-machines:\n{machines}errata:\n{errata}errors:\n{errors}"
        )
    }),
    pattern("units", |n| {
        let units = each(n, |at| format!("  unit {at}: {{symbol: u{at}, base: 1/1000 V}}\n"));
        spec(&format!("units:\n{units}"), &objects(n, |at| format!(", unit: unit {at}, default: {at} u{at}")))
    }),
    pattern("unused units", |n| {
        let units = each(n, |at| format!("  unit {at}: {{symbol: u{at}}}\n"));
        spec(&format!("units:\n{units}"), &objects(n, |_| String::new()))
    }),
    pattern("types", |n| {
        let types = each(n, |at| format!("  sort {at}: {{base: unsigned8, values: {{0: off, 1: on}}}}\n"));
        spec(
            &format!("types:\n{types}"),
            &each(n, |at| {
                format!("  0x{:X}: {{name: o{at}, type: sort {at}, access: ro, default: off}}\n", index(at))
            }),
        )
    }),
    pattern("unused types", |n| {
        let types = each(n, |at| format!("  sort {at}: {{base: unsigned8, values: {{0: off, 1: on}}}}\n"));
        spec(&format!("types:\n{types}"), &objects(n, |_| String::new()))
    }),
    pattern("types in tables", |n| {
        let types = each(n, |at| format!("  sort {at}: {{base: unsigned8, values: {{0: off, 1: on}}}}\n"));
        let tables = list(n, |at| format!("{{values: sort {at}}}"));
        spec(
            &format!("types:\n{types}document:\n  - {{section: \"1\", title: a, content: [{tables}]}}\n"),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("values of an enum", |n| {
        let types = format!(
            "types:\n  t: {{base: unsigned32, values: {{{}}}}}\n",
            list(n, |at| format!("{at}: value {at}"))
        );
        spec(
            &types,
            &each(n, |at| {
                format!("  0x{:X}: {{name: o{at}, type: t, access: ro, default: value {at}}}\n", index(at))
            }),
        )
    }),
    pattern("special values", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned32, access: ro, special: {{{}}}}}\n",
                list(n, |at| format!("{at}: value {at}"))
            ),
        )
    }),
    pattern("errors", |n| {
        let errors = each(n, |at| format!("  0x{at:04X}: {{name: error {at}}}\n"));
        spec(
            &format!(
                "errors:\n{errors}document:\n  - {{section: \"1\", title: a, content: [{{errors: all}}]}}\n"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("errors of bits", |n| {
        let errors = each(n, |at| format!("  0x{at:04X}: {{name: error {at}}}\n"));
        let types = each(n, |at| {
            format!("  t{at}: {{base: unsigned8, bits: {{0: {{name: a, error: {at}}}}}, rest: reserved}}\n")
        });
        spec(
            &format!("errors:\n{errors}types:\n{types}"),
            &each(n, |at| format!("  0x{:X}: {{name: o{at}, type: t{at}, access: ro}}\n", index(at))),
        )
    }),
    pattern("a run of errors", |n| {
        spec(
            &format!("errors:\n  0x0001..0x{n:04X}: {{name: \"error {{n}}\"}}\n"),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("states", |n| {
        let states = each(n, |at| {
            let bits = format!("{at:016b}");
            format!("      s{at}: {{pattern: \"{bits}\"}}\n")
        });
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states:\n{states}"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("commands", |n| {
        let commands =
            each(n, |at| format!("      c{at}: {{pattern: \"{at:016b}\", send: {at}, transitions: [0]}}\n"));
        spec(
            &format!(
                "state-machines:\n  m:\n    status: object 0\n    command: object 1\n    states: {{a: {{pattern: \"xxxx xxxx xxxx xxx0\"}}}}\n    transitions: {{0: {{from: start, to: a, event: e}}}}\n    commands:\n{commands}"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("machines", |n| {
        spec(
            &format!(
                "state-machines:\n{}",
                each(n, |at| format!(
                    "  m{at}: {{status: object {at}, command: object {at}, states: {{a: {{pattern: \"xxxx xxxx xxxx xxx1\"}}}}}}\n"
                ))
            ),
            &objects(n, |_| String::new()),
        )
    }),
    pattern("constraints", |n| {
        let constraints = each(n, |at| format!("  c{at}: {{require: \"0x{:X} < 9\"}}\n", index(at)));
        spec(&format!("constraints:\n{constraints}"), &objects(n, |_| ", default: 1".to_owned()))
    }),
    pattern("a long constraint", |n| {
        let terms = (0..n).map(|at| format!("0x{:X}", index(at))).collect::<Vec<_>>().join(" <= ");
        spec(
            &format!("constraints:\n  c: {{require: \"{terms}\"}}\n"),
            &objects(n, |_| ", default: 1".to_owned()),
        )
    }),
    pattern("write conditions", |n| {
        spec("", &objects(n, |at| format!(", writable-when: \"0x{:X} == 0\"", index(at / 2))))
    }),
    pattern("formulas", |n| {
        let units =
            each(n, |at| format!("  unit {at}: {{symbol: u{at}, formula: \"0x{:X} / 2\"}}\n", index(at)));
        spec(&format!("units:\n{units}"), &objects(n, |at| format!(", unit: unit {at}")))
    }),
    pattern("sections and tables", |n| {
        let sections = each(n, |at| {
            format!(
                "  - {{section: \"1.{at}\", title: s, content: [{{title: t, objects: [0x{:X}]}}, {{overview: [0x{:X}]}}]}}\n",
                index(at),
                index(at)
            )
        });
        spec(&format!("document:\n{sections}"), &objects(n, |_| String::new()))
    }),
    pattern("a table of text", |n| {
        let rows = list(n, |at| format!("[a{at}, b]"));
        spec(
            &format!(
                "document:\n  - {{section: \"1\", title: s, content: [{{rows: {{columns: [x, y], rows: [{rows}]}}}}]}}\n"
            ),
            &objects(2, |_| String::new()),
        )
    }),
    pattern("a glossary and a history", |n| {
        let glossary = each(n, |at| format!("  G{at}: word {at}\n"));
        let history =
            each(n, |at| format!("  - {{number: \"{at}\", date: 2024-01-01, about: issue {at}}}\n"));
        spec(&format!("glossary:\n{glossary}history:\n{history}"), &objects(2, |_| String::new()))
    }),
    pattern("links", |n| spec("", &objects(n, |at| format!(", links: [0x{:X}]", index(n - 1 - at))))),
    pattern("links of one object", |n| {
        spec(
            "",
            &(objects(n, |_| String::new())
                + &format!(
                    "  0x6000: {{name: all, type: unsigned8, access: ro, links: [{}]}}\n",
                    list(n, |at| format!("0x{:X}", index(at)))
                )),
        )
    }),
    pattern("mapped objects", |n| {
        let pdos = (n / 4).min(512);
        let list = each(pdos, |at| {
            format!(
                "      {}: {{map: [object {}, object {}, object {}, object {}], valid: no}}\n",
                at + 1,
                4 * at,
                4 * at + 1,
                4 * at + 2,
                4 * at + 3
            )
        });
        spec(&format!("pdos:\n  d:\n    transmit:\n{list}"), &objects(n, |_| ", pdo: transmit".to_owned()))
    }),
    pattern("channels", |n| {
        device_with(
            &format!(
                ", dynamic-channels: {{{}}}",
                list(n.min(0x1000), |at| format!(
                    "0x{:X}: {{type: unsigned8, access: ro, offset: {at}}}",
                    0xA000 + at
                ))
            ),
            "",
            &objects(2, |_| String::new()),
        )
    }),
    pattern("languages", |n| {
        let languages = list(n, |at| format!("l{at}"));
        let about = list(n, |at| format!("l{at}: text"));
        format!("languages: [{languages}]\n")
            + &spec("", &format!("  0x2000: {{name: a, type: unsigned8, access: ro, about: {{{about}}}}}\n"))
    }),
    pattern("findings that are allowed", |n| {
        let at = list(n, |at| format!("0x{:X}", index(at)));
        spec(
            &format!("allow: {{OD0802: {{about: x, at: [{at}]}}}}\n"),
            &objects(n, |_| ", pdo: transmit".to_owned()),
        )
    }),
    pattern("a long text", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned8, access: ro, about: {}}}\n",
                "long ".repeat(20 * n)
            ),
        )
    }),
    pattern("a long foreign text", |n| {
        spec(
            "",
            &format!(
                "  0x2000: {{name: a, type: unsigned8, access: ro, about: {}}}\n",
                "größer ".repeat(20 * n)
            ),
        )
    }),
    pattern("everything in one line", |n| {
        format!(
            "{{od-spec: 1, title: t, devices: {{d: {{name: größe, bit-rates: [125], eds: {{created: 2024-02-29 12:00}}}}}}, objects: {{{}}}}}",
            list(n, |at| format!("0x{:X}: {{name: größe {at}, type: unsigned16, access: rw}}", index(at)))
        )
    }),
];
