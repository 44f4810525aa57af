//! All outputs say the same about every entry: each is reduced to facts and compared with the model.
//!
//! The readers here know the notations, not the code that writes them: a number is read back in whatever way it is written,
//! and what is said twice in one place has to agree with itself.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::BTreeMap;

use od_documents::Format;
use od_spec::model::{Dictionary, Entry, EntryId, Index, Role, SubIndex, System};
use od_tests::{compile_clean, root};

mod documents;
mod dump;
mod eds;
mod facts;
mod manuals;
#[path = "../../../shared/markdown.rs"]
#[expect(dead_code, reason = "the documents' own tests use more of it")]
mod markdown;
mod read;
mod rust_docs;

use facts::{Facts, disagreements};

const SYSTEMS: [&str; 2] = ["pitch-control-system", "fullmo-drive"];

/// What one output says about the entries of a device.
struct Output<'a> {
    device: &'a Dictionary,
    facts: BTreeMap<EntryId, Facts>,
}

impl<'a> Output<'a> {
    fn new(device: &'a Dictionary) -> Self {
        Self { device, facts: BTreeMap::new() }
    }

    /// Takes what is said about an entry, which the device has and nothing was said about before.
    fn report(&mut self, index: u16, sub: u8, facts: impl FnOnce(&Entry) -> Facts) {
        let id = EntryId { index: Index(index), sub: SubIndex(sub) };
        let entry = self.device.entry(id).unwrap_or_else(|| panic!("{} has no {id}", self.device.key));
        assert!(self.facts.insert(id, facts(entry)).is_none(), "{} {id} is stated twice", self.device.key);
    }

    /// Entries that nothing is said about.
    fn silent(&self) -> Vec<EntryId> {
        self.device.entries().map(|(id, ..)| id).filter(|id| !self.facts.contains_key(id)).collect()
    }

    /// Where it says something else than the model.
    fn wrong(&self, name: &str) -> Vec<String> {
        let reported = self.facts.iter().flat_map(|(id, facts)| {
            let list = disagreements(facts, self.device.entry(*id).unwrap());
            list.into_iter().map(move |text| format!("{name} {} {id}: {text}", self.device.key))
        });
        reported.collect()
    }
}

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The devices of all systems with the name of their system.
fn for_each_device(mut check: impl FnMut(&str, &System, &Dictionary)) {
    let mut keys = Vec::new();
    for name in SYSTEMS {
        let system = compile_clean(&format!("od-spec/devices/{name}.od.yaml")).unwrap();
        for device in &system.devices {
            keys.push(device.key.clone());
            check(name, &system, device);
        }
    }
    assert_eq!(keys, ["pmm", "pmc", "fullmo"]);
}

/// That an output describes every entry, and correctly.
fn assert_complete_and_right(name: &str, output: &Output<'_>) {
    assert_eq!(output.silent(), [], "{name} {}", output.device.key);
    let wrong = output.wrong(name);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_dump_says_what_the_model_says() {
    for_each_device(|name, _, device| {
        let dump = serde_json::from_str(&text(&format!("generated/{name}.json"))).unwrap();
        let mut output = Output::new(device);
        dump::read(&dump, &mut output);
        assert_complete_and_right("JSON", &output);
    });
}

#[test]
fn the_eds_says_what_the_model_says() {
    for_each_device(|_, system, device| {
        let mut output = Output::new(device);
        eds::read(&text(&format!("generated/eds/{}.eds", device.key)), system.language(), &mut output);
        assert_complete_and_right("EDS", &output);
    });
}

#[test]
fn the_documents_say_what_the_model_says_in_every_language() {
    for_each_device(|name, _, device| {
        for titles in [documents::ENGLISH, documents::GERMAN] {
            let spec = format!("od-spec/devices/{name}.od.yaml");
            let pages = od_tests::documents::pages(&spec, Format::Markdown, titles.language).unwrap();
            let page = markdown::read(&pages[&format!("{}.md", device.key)]);
            let mut output = Output::new(device);
            documents::read(&page, &titles, &mut output);
            assert_complete_and_right(&format!("documents ({})", titles.language), &output);
        }
    });
}

#[test]
fn the_rust_documentation_says_what_the_model_says() {
    for_each_device(|_, _, device| {
        let mut output = Output::new(device);
        rust_docs::read(&text(&format!("generated/src/{}.rs", device.key)), &mut output);
        // A count has no accessor of its own, and mapping parameters share one whose defaults differ.
        let is_silent_on_purpose = |id: &EntryId| {
            let is_count = id.sub == SubIndex(0) && device.objects[&id.index].is_structured();
            is_count || Role::of(id.index) == Role::PdoMapping
        };
        let silent: Vec<EntryId> =
            output.silent().into_iter().filter(|id| !is_silent_on_purpose(id)).collect();
        assert_eq!(silent, [], "{}", device.key);
        let wrong = output.wrong("Rust");
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    });
}

/// What one output says about the pitch controller with `altered` instead of `written`.
fn altered<'a>(
    device: &'a Dictionary,
    path: &str,
    written: &str,
    altered: &str,
    read: impl Fn(&str, &mut Output<'a>),
) -> Vec<String> {
    let text = text(path);
    assert!(text.contains(written), "{path} does not say {written:?}");
    let mut output = Output::new(device);
    read(&text.replacen(written, altered, 1), &mut output);
    output.wrong("altered")
}

#[test]
fn another_word_is_seen() {
    let system = compile_clean("od-spec/devices/pitch-control-system.od.yaml").unwrap();
    let (pmm, pmc) = (system.device("pmm").unwrap(), system.device("pmc").unwrap());
    let eds = |text: &str, output: &mut Output<'_>| eds::read(text, system.language(), output);
    let dump = |text: &str, output: &mut Output<'_>| {
        dump::read(&serde_json::from_str(text).unwrap(), output);
    };
    let cases = [
        ("special", "; 0xFFFFFFFF: monitoring off", "; 0xFFFFFFFE: monitoring off"),
        ("storage", "stored with the application parameters", "stored with the manufacturer parameters"),
        ("default", "factory default 0 (automatic test off)", "factory default 60 min"),
        ("unit", "; unit 0.1 degC", "; unit 0.01 degC"),
        ("limits", "range at least 60 min", "range at least 61 min"),
        ("access", "writable only when unlocked for service", "view of nothing"),
        ("mapping", "AccessType=rww", "AccessType=rwr"),
    ];
    for (fact, written, instead) in cases {
        let device = if fact == "special" { pmc } else { pmm };
        let written = written.replace("factory default 0 ", "factory default\r\n;   0 ");
        let path = format!("generated/eds/{}.eds", device.key);
        let wrong = altered(device, &path, &written, instead, eds);
        assert!(wrong.iter().any(|text| text.contains(fact)), "{fact}: {wrong:?}");
    }
    for (fact, written, instead) in [
        ("special", "32767: wire break", "32766: wire break"),
        ("limits", "≥ 60 min", "≤ 60 min"),
        ("default", "default 0 (automatic test off)", "default 60 min"),
        ("access", "rw locked", "rw"),
        ("mapping", "INTEGER16, ro, TPDO", "INTEGER16, ro, RPDO"),
        ("unit", "in 0.1 °C", "in 0.1 K"),
        ("storage", ", kept over power-off", ""),
    ] {
        let wrong = altered(pmm, "generated/src/pmm.rs", written, instead, rust_docs::read);
        assert!(wrong.iter().any(|text| text.contains(fact)), "{fact}: {wrong:?}");
    }
    for (fact, written, instead) in [
        ("storage", "\"stored\": \"application\"", "\"stored\": \"no\""),
        ("access", "\"locked\": true", "\"locked\": false"),
        ("limits", "\"min\": 60", "\"min\": 61"),
        ("mapping", "\"pdo\": \"transmit\"", "\"pdo\": \"both\""),
    ] {
        let wrong = altered(pmm, "generated/pitch-control-system.json", written, instead, dump);
        assert!(wrong.iter().any(|text| text.contains(fact)), "{fact}: {wrong:?}");
    }
}
