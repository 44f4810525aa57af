//! The work that a specification makes, and the memory that it takes, grow with its size, whatever is in it many times. The
//! bytes that are asked for count it: they are the same in every run. Comparisons ask for none; `tests/bench/instructions.py`
//! counts these.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use allocation_counter::{AllocationInfo, measure};
use od_formats::{eds, findings, json};
use od_spec::diag::render::{Format, render};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, add_source, compile};
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
    assert_eq!(growing(WRONG, if od_tests::is_long() { 1 } else { 8 }), [""; 0]);
}

#[test]
fn twice_as_much_is_twice_the_work() {
    assert_eq!(growing(RIGHT, if od_tests::is_long() { 1 } else { 4 }), [""; 0]);
}

/// A few lines that describe more than any device has: each is refused before it takes much memory.
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

/// What a file of a name takes from its bytes to its messages, and these messages.
fn said(name: &str, text: &str) -> (AllocationInfo, String) {
    let mut said = String::new();
    let used = measure(|| {
        let mut sources = SourceMap::new();
        let root = add_source(&mut sources, name, text.into()).unwrap();
        let Compiled { diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
        said = render(&diagnostics, &sources, Format::Short, false);
    });
    (used, said)
}

/// Lines without anything are no more than their text and a few bytes each.
#[test]
fn line_breaks_take_little_memory() {
    const LINES: usize = 500_000;
    for line_break in ["\n", "\r\n"] {
        let text = format!("[FileInfo]{line_break}FileVersion=1") + &line_break.repeat(LINES) + "[2000]";
        let (used, said) = said("a.eds", &text);
        let beside = used.bytes_max.saturating_sub(text.len() as u64);
        assert!(beside < 10 * LINES as u64, "{beside} bytes compared with {}", text.len());
        // A place after them is right.
        assert!(said.contains(&format!("a.eds:{}:2: ", LINES + 2)) && !said.contains("EDS123"), "{said}");
    }
}

/// An element has a few attributes; the parser would compare each with all others.
#[test]
fn attributes_of_an_element_have_a_limit() {
    let file = |number: usize| {
        let more = (0..number).map(|at| format!(" a{at}='>\"'")).collect::<Vec<_>>().concat();
        format!(
            "<?xml version=\"1.0\"?><!-- <a '> --><x><CANopenObjectList><![CDATA[<b \"]]>\n<CANopenObject{more} index=\"2000\" name=\"level\" \
             objectType=\"7\" dataType=\"0005\" accessType=\"ro\"/></CANopenObjectList></x>"
        )
    };
    let few = said("a.xdd", &file(200)).1;
    assert!(!few.contains("OD0116") && !few.contains("XDD1"), "{few}");
    for many in [300, 500_000] {
        let (used, said) = said("a.xdd", &file(many));
        assert!(said.contains("a.xdd:2:1: error[OD0116]: an element has more than 256 attributes"), "{said}");
        assert!(used.bytes_max < 20 << 20, "{}", used.bytes_max);
    }
}

/// Any number of objects can refer to one parameter, with all its texts.
#[test]
fn texts_that_objects_share_take_limited_memory() {
    let objects = (0x2000..0x5000).map(|index| {
        format!("<CANopenObject index=\"{index:X}\" name=\"o{index}\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" uniqueIDRef=\"p\"/>")
    });
    let text = format!(
        "<x><parameter uniqueID=\"p\"><description lang=\"en\">{}</description></parameter><CANopenObjectList>{}</CANopenObjectList></x>",
        "long text ".repeat(10_000),
        objects.collect::<String>()
    );
    let (used, said) = said("a.xdd", &text);
    assert!(said.contains("error[OD0116]: more than 64 MiB of repeated text"), "{said}");
    assert!(used.bytes_max < 600 << 20, "{}", used.bytes_max);
}

/// However many mistakes there are, what is written about them is limited.
#[test]
fn messages_do_not_flood() {
    let objects = (0x2000..0x5000).map(|index| {
        format!("[{index:X}]\nParameterName=o{index}\nObjectType=7\nDataType=6\nAccessType=often\nDefaultValue=+1\nPDOMapping=0\n")
    });
    let text = objects.collect::<String>();
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, "a.eds", text.into()).unwrap();
    let Compiled { diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
    let codes: BTreeSet<&str> = diagnostics.iter().map(|one| one.code.id).collect();
    assert!(diagnostics.iter().count() > 24_000 && codes.contains("EDS406"));
    let files = [findings::Findings { name: "a.eds", diagnostics: &diagnostics, sources: &sources }];
    for (text, most, rest) in [
        (render(&diagnostics, &sources, Format::Human, false), 100, "and 12188 more like these (EDS406)"),
        (render(&diagnostics, &sources, Format::Short, false), 1_000, "and 11288 more like these (EDS406)"),
        (
            findings::json(&diagnostics, &sources),
            10_000,
            "\"message\":\"2288 more messages of this code are left out\"",
        ),
        (findings::github(&diagnostics, &sources), 10_000, "2288 more messages of this code are left out"),
        (
            findings::sarif("1", |_| String::new(), &files),
            10_000,
            "2288 more messages of this code are left out",
        ),
    ] {
        assert!(text.contains(rest), "{rest}");
        assert_eq!(text.matches("there is no access type `often`").count(), most);
    }
}
