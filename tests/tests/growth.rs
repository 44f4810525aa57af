//! The work that a specification makes, and the memory that it takes, grow with its size, whatever is in it many times. The
//! bytes that are asked for count it: they are the same in every run. Comparisons ask for none; `tests/bench/instructions.py`
//! counts these.

use allocation_counter::{AllocationInfo, measure};
use od_formats::{eds, findings, json};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};
use od_tests::patterns::{Pattern, RIGHT, WRONG};

/// What a text takes from its bytes to its messages or, where it has none, its EDS and JSON files.
fn work(text: &str) -> AllocationInfo {
    measure(|| {
        let mut sources = SourceMap::new();
        let root = sources.add("a.od.yaml", text);
        let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
        match system {
            Some(system) => {
                drop(json::dump(&system, &[]));
                for device in &system.devices {
                    drop(eds::write_eds(&system, device));
                }
            }
            None => drop(findings::json(&diagnostics, &sources)),
        }
    })
}

fn growing(patterns: &[Pattern], step: usize) -> Vec<String> {
    // What is made once for all texts, such as the list of the features that are built in.
    work("od-spec: 1\ntitle: Lamp\ndevices: {lamp: {name: Lamp, bit-rates: [125], features: [lamp]}}\n");
    let mut wrong = Vec::new();
    for Pattern { name, make } in patterns.iter().step_by(step) {
        // The first of a kind reads the library.
        work(&make(10));
        let [one, two, four] = [200, 400, 800].map(|n| work(&make(n)).bytes_total);
        let (first, second) = (two.saturating_sub(one), four.saturating_sub(two));
        // Lists and maps grow in leaps: a third and a little is for them.
        if second * 10 > first * 27 + 8_000_000 {
            wrong.push(format!("{name}: {one}, {two}, {four} bytes"));
        }
    }
    wrong
}

#[test]
fn twice_as_many_mistakes_are_twice_the_work() {
    // Messages about so many places take a minute in all.
    assert_eq!(growing(WRONG, if od_tests::is_long() { 1 } else { 4 }), [""; 0]);
}

#[test]
fn twice_as_much_is_twice_the_work() {
    assert_eq!(growing(RIGHT, if od_tests::is_long() { 1 } else { 2 }), [""; 0]);
}

/// A few lines that stand for more than any device has: each is refused before it takes much memory.
#[test]
fn little_text_takes_little_memory() {
    const MOST: u64 = 300 << 20;
    let array = |count: u32, about: &str| {
        format!("array: {{count: {count}, name: \"{{n}}\", type: unsigned8, access: ro, about: {about}}}")
    };
    let file = |devices: &str, objects: &str| {
        format!("od-spec: 1\ntitle: t\ndevices:\n{devices}objects:\n{objects}")
    };
    let one = "  d: {name: d, bit-rates: [125]}\n";
    let many = |n: u32| (0..n).map(|at| format!("  d{at}: {{name: d}}\n")).collect::<Vec<_>>().concat();
    let long = "long text ".repeat(20_000);
    let member = |sub: u8| format!("{sub}: {{name: m{sub}, type: unsigned8, access: ro}}, ");
    let record = (1..=254).map(member).collect::<Vec<_>>().concat();
    let cases = [
        (
            "runs of arrays",
            file(one, &format!("  0x2000..0xFFFF: {{name: \"a {{n}}\", {}}}\n", array(254, "x"))),
        ),
        (
            "runs of records",
            file(one, &format!("  0x2000..0xFFFF: {{name: \"a {{n}}\", record: {{{record}}}}}\n")),
        ),
        (
            "a run with a long text",
            file(
                one,
                &format!(
                    "  0x2000..0x9FFF: {{name: \"a {{n}}\", type: unsigned8, access: ro, about: {long}}}\n"
                ),
            ),
        ),
        ("an array with a long text", file(one, &format!("  0x2000: {{name: a, {}}}\n", array(254, &long)))),
        (
            "devices with a long text",
            file(&many(900), &format!("  0x2000: {{name: a, type: unsigned8, access: ro, about: {long}}}\n")),
        ),
        (
            "devices with arrays",
            file(&many(900), &format!("  0x2000..0x2100: {{name: \"a {{n}}\", {}}}\n", array(254, "x"))),
        ),
        ("devices", file(&many(5_000), "  0x2000: {name: a, type: unsigned8, access: ro}\n")),
        (
            "aliases of a text",
            format!("od-spec: 1\ntitle: &a \"{long}\"\nhistory: [{}]\n", "*a, ".repeat(20_000)),
        ),
        (
            "anchors in anchors",
            format!("od-spec: 1\nhistory: {}\"{long}\"{}\n", "&a [".repeat(60), "]".repeat(60)),
        ),
        (
            "tables",
            format!(
                "{}errata:\n  - {{at: 0x2000, kind: name, place: Tables 1 to 4294967295, prints: a, reads: b, because: c}}\n",
                file(one, "  0x2000: {name: a, type: unsigned8, access: ro}\n")
            ),
        ),
    ];
    for (name, text) in cases {
        let used = work(&text);
        assert!(used.bytes_max < MOST, "{name}: {} bytes at one time for {}", used.bytes_max, text.len());
    }
}
