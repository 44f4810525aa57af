//! How every access ends: the cases of the Rust dictionary, through the interface's reading and writing.

use std::collections::BTreeMap;

use od_tests::access_cases;
use serde_json::Value;

use crate::canopennode::project::{Project, of_workspace};

/// One case, as its bytes have it.
struct Case {
    kind: u8,
    index: u16,
    sub: u8,
    data: Vec<u8>,
    code: u32,
    /// What is read afterwards, where that is compared.
    after: Option<Vec<u8>>,
}

/// An abort code, and what is read then, where that is compared.
type Answer = (u32, Option<Vec<u8>>);

/// Where the stack itself decides otherwise than the Rust dictionary, and what it gives instead.
struct Difference {
    reason: &'static str,
    is_about: fn(&Case, &Entries<'_>) -> bool,
    expected: fn(&Case) -> Answer,
}

const TOO_SHORT: u32 = 0x0607_0013;
const TOO_LONG: u32 = 0x0607_0012;
const NO_SUB_INDEX: u32 = 0x0609_0011;
const DEVICE_STATE: u32 = 0x0800_0022;

const DIFFERENCES: [Difference; 5] = [
    Difference {
        reason: "the stack has the history of errors, and no memory of the dictionary",
        is_about: |case, entries| case.index == 0x1003 && entries.of(case).is_some() && reaches_memory(case),
        expected: |_| (NO_SUB_INDEX, None),
    },
    Difference {
        reason: "the stack adds the node-ID itself where an identifier is a base of the pre-defined connection set",
        is_about: |case, entries| case.kind == 0 && is_base(case, entries),
        expected: |case| {
            let of_node = case.after.clone().unwrap_or_default();
            let number = u32::from_le_bytes(of_node.try_into().unwrap());
            (0, Some((number - 5).to_le_bytes().to_vec()))
        },
    },
    Difference {
        reason: "the stack's server looks at the length before it asks whether the entry is locked",
        is_about: |case, entries| {
            let is_text =
                entries.of(case).is_some_and(|entry| entry["type"].as_str().unwrap().ends_with("-string"));
            case.code == DEVICE_STATE && case.data.is_empty() && !is_text
        },
        expected: |_| (TOO_SHORT, None),
    },
    Difference {
        reason: "a lock is asked before it is known that the application has nothing for a DOMAIN",
        is_about: |case, entries| {
            case.kind == 1
                && entries.of(case).is_some_and(|entry| entry["type"] == "domain" && entry["locked"] == true)
        },
        expected: |_| (DEVICE_STATE, None),
    },
    Difference {
        reason: "a command that stores something says so, as the stack stores it",
        is_about: |case, entries| {
            let is_command = matches!(case.index, 0x1010 | 0x1011) && case.sub > 0;
            is_command && case.kind == 0 && entries.of(case).is_some()
        },
        expected: |_| (0, None),
    },
];

/// The stack's server refuses an access or a length before it asks for the value.
fn reaches_memory(case: &Case) -> bool {
    case.kind == 0 || !matches!(case.code, 0x0601_0002 | TOO_LONG | TOO_SHORT)
}

/// The entries of a device by index and sub-index.
struct Entries<'p>(BTreeMap<(u16, u8), &'p Value>);

impl<'p> Entries<'p> {
    fn of_device(project: &'p Project) -> Self {
        let entries = project.device["objects"].as_array().unwrap().iter().flat_map(|object| {
            let index = object["index"].as_str().unwrap().trim_start_matches("0x");
            let index = u16::from_str_radix(index, 16).unwrap();
            let entries = object["entries"].as_array().unwrap().iter();
            entries.map(move |entry| ((index, entry["sub"].as_u64().unwrap().try_into().unwrap()), entry))
        });
        Self(entries.collect())
    }

    fn of(&self, case: &Case) -> Option<&'p Value> {
        self.0.get(&(case.index, case.sub)).copied()
    }
}

/// Whether an entry holds a base of the pre-defined connection set: by the number of the PDO, as the devices here have no gaps.
fn is_base(case: &Case, entries: &Entries<'_>) -> bool {
    let has_node = entries.of(case).is_some_and(|entry| entry["default"].get("formula").is_some());
    let number = case.index & 0xFF;
    let base = match (case.index & 0xFF00, case.sub) {
        (0x1000, 0) if case.index == 0x1014 => 0x80,
        (0x1200, 1) => 0x600,
        (0x1200, 2) => 0x580,
        (0x1400, 1) if number < 4 => 0x200 + 0x100 * u64::from(number),
        (0x1800, 1) if number < 4 => 0x180 + 0x100 * u64::from(number),
        _ => return false,
    };
    has_node
        && entries
            .of(case)
            .and_then(|entry| entry["default"]["raw"].as_u64())
            .is_some_and(|raw| raw & 0x7FF == base)
}

fn cases(mut bytes: &[u8]) -> Vec<Case> {
    fn take(bytes: &mut &[u8], count: usize) -> Vec<u8> {
        let (head, rest) = bytes.split_at(count);
        *bytes = rest;
        head.to_vec()
    }
    let mut cases = Vec::new();
    while !bytes.is_empty() {
        let head = take(&mut bytes, 5);
        let data = take(&mut bytes, head[4].into());
        let code = u32::from_le_bytes(take(&mut bytes, 4).try_into().unwrap());
        let length = take(&mut bytes, 1)[0];
        let after = (length != 0xFF).then(|| take(&mut bytes, length.into()));
        cases.push(Case {
            kind: head[0],
            index: u16::from_le_bytes([head[1], head[2]]),
            sub: head[3],
            data,
            code,
            after,
        });
    }
    cases
}

fn try_all(project: &Project, least: usize) -> [usize; DIFFERENCES.len()] {
    let made = access_cases::of_device(&project.dump, project.key()).unwrap();
    let path = project.beside("cases.bin", &made.bytes);
    let answers = project.run("try_accesses.c", &[&path]);
    let cases = cases(&made.bytes);
    assert_eq!((answers.lines().count(), cases.len()), (made.count, made.count));
    assert!(made.count >= least, "{} cases only", made.count);
    let entries = Entries::of_device(project);
    let mut used = [0; DIFFERENCES.len()];
    for (number, (case, answer)) in cases.iter().zip(answers.lines()).enumerate() {
        // A case has no room for a longer text.
        if case.data.len() >= 254 {
            continue;
        }
        let difference = DIFFERENCES.iter().position(|difference| (difference.is_about)(case, &entries));
        let (code, after) = match difference {
            Some(at) => {
                used[at] += 1;
                (DIFFERENCES[at].expected)(case)
            }
            None => (case.code, case.after.clone()),
        };
        let reason = difference.map_or("", |at| DIFFERENCES[at].reason);
        let mut words = answer.split(' ');
        let found = u32::from_str_radix(words.next().unwrap(), 16).unwrap();
        let what = format!(
            "{}: case {number}, kind {} at {:04X}h.{} with {:02X?} {reason}",
            project.key(),
            case.kind,
            case.index,
            case.sub,
            case.data
        );
        assert_eq!(format!("{found:08X}"), format!("{code:08X}"), "{what}");
        let bytes: Vec<&str> = words.collect();
        assert!(bytes != ["changed"], "{what}: a refused write changed something");
        if let Some(after) = after {
            let after: Vec<String> = after.iter().map(|byte| format!("{byte:02X}")).collect();
            assert_eq!(bytes, after, "{what}");
        }
    }
    used
}

#[test]
fn every_access_to_the_shipped_devices_ends_as_in_rust() {
    for (stem, least) in [("pitch-control-system", 50_000), ("fullmo-drive", 10_000)] {
        for project in of_workspace(&format!("od-spec/devices/{stem}.od.yaml")) {
            let [history, bases, locked, domains, _] = try_all(&project, least);
            let (has_history, has_locked) = (project.key() != "fullmo", project.key() != "pmc");
            assert_eq!(
                (history > 0, bases > 4, locked > 0, domains),
                (has_history, true, has_locked, 0),
                "{}",
                project.key()
            );
        }
    }
}

#[test]
fn every_access_to_values_of_every_width_ends_as_in_rust() {
    for stem in ["limits", "everything"] {
        for project in of_workspace(&format!("tests/readers/{stem}.od.yaml")) {
            let [history, bases, _, domains, _] = try_all(&project, 10_000);
            let is_everything = stem == "everything";
            assert_eq!([history > 0, bases > 3, domains > 0], [is_everything; 3], "{stem}");
        }
    }
}
