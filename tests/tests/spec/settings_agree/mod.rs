//! Settings by chance: what `odgen dcf` accepts, a device takes, step by step in the order of a download. The device is the
//! generated dictionary, locked, with all its conditions.
//!
//! What odgen refuses and the device would take is not a mistake of its user, but a decision: each code has its reason
//! here, and some case that needs it.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod chance;
mod devices;
mod policy;

use std::collections::{BTreeMap, BTreeSet};

use firmware_glue::AbortCode;
use od_spec::assign;
use od_spec::diag::{Diagnostics, Severity};
use od_spec::model::{EntryId, System, Value, download};
use od_spec::source::{SourceMap, Spanned};
use od_tests::fuzz::Random;

use chance::Setting;
use devices::{DEVICES, Device, Node};
use policy::{ACCEPTED_IN_SOME_STATE, Difference, REFUSED_BY_BOTH, REFUSED_BY_POLICY};

/// The node that is configured.
const NODE: u8 = 5;
/// What odgen says about a configuration: errors, warnings, and the values that it takes.
struct Said {
    errors: BTreeSet<&'static str>,
    warnings: BTreeSet<&'static str>,
    messages: String,
    values: BTreeMap<EntryId, Value>,
}

fn said(system: &System, device: &Device, settings: &[Setting]) -> Said {
    let mut sources = SourceMap::new();
    let assignments: Vec<_> = settings
        .iter()
        .map(|setting| {
            let file = sources.add("--set", setting.text.as_str());
            Spanned::new(setting.text.clone(), sources.whole(file))
        })
        .collect();
    let mut diagnostics = Diagnostics::new();
    let dictionary = system.device(device.key).unwrap();
    let values = assign(system, dictionary, NODE, &assignments, &mut diagnostics);
    let codes = |severity: Severity| {
        diagnostics.iter().filter(|one| one.severity() == severity).map(|one| one.code.id).collect()
    };
    let messages: Vec<String> =
        diagnostics.iter().map(|one| format!("{}: {}", one.code.id, one.message)).collect();
    Said {
        errors: codes(Severity::Error),
        warnings: codes(Severity::Warning),
        messages: messages.join("\n    "),
        values,
    }
}

/// A node after the download of some values, or the entry that it refuses first.
fn downloaded(
    system: &System,
    device: &Device,
    values: &BTreeMap<EntryId, Value>,
) -> Result<Box<dyn Node>, (EntryId, Option<AbortCode>)> {
    let dictionary = system.device(device.key).unwrap();
    // A value that its type does not have is too long for the device.
    let writes = download(system, dictionary, values, NODE).map_err(|misfit| (misfit.0, None))?;
    let mut node = (device.new)(NODE);
    for write in writes {
        node.write(write.id, &write.bytes).map_err(|abort| (write.id, Some(abort)))?;
    }
    Ok(node)
}

/// The first entry that does not hold its value.
fn lost(
    system: &System,
    device: &Device,
    node: &dyn Node,
    values: &BTreeMap<EntryId, Value>,
) -> Option<EntryId> {
    let dictionary = system.device(device.key).unwrap();
    let is_lost = |(id, value): (&EntryId, &Value)| {
        let entry = dictionary.entry(*id).unwrap();
        let expected = value.bytes_for(entry.data_type, NODE).unwrap();
        (entry.access.is_readable() && node.read(*id) != Ok(expected)).then_some(*id)
    };
    values.iter().find_map(is_lost)
}

/// What was found about one configuration.
enum Outcome {
    /// Both take it.
    Accepted,
    /// Both refuse it; odgen with these codes.
    Refused(BTreeSet<&'static str>),
    /// odgen alone refuses it, with these codes.
    Policy(BTreeSet<&'static str>),
    /// odgen warns that the device may refuse it, as it does.
    Warned(BTreeSet<&'static str>),
    /// The device alone refuses it.
    Wrong(String),
}

fn outcome(system: &System, device: &Device, settings: &[Setting]) -> Outcome {
    let said = said(system, device, settings);
    if !said.errors.is_empty() {
        let values: BTreeMap<EntryId, Value> =
            settings.iter().map(|setting| (setting.id, setting.value.clone())).collect();
        return match downloaded(system, device, &values) {
            Ok(_) => Outcome::Policy(said.errors),
            Err(_) => Outcome::Refused(said.errors),
        };
    }
    let set = || settings.iter().map(|setting| setting.text.as_str()).collect::<Vec<_>>().join(" ");
    match downloaded(system, device, &said.values) {
        Ok(node) => match lost(system, device, &*node, &said.values) {
            Some(id) => Outcome::Wrong(format!("{}: {}\n    {id} has another value then", device.key, set())),
            None => Outcome::Accepted,
        },
        Err((id, abort)) => {
            let warned: BTreeSet<_> = said
                .warnings
                .into_iter()
                .filter(|code| ACCEPTED_IN_SOME_STATE.iter().any(|known| known.code == *code))
                .collect();
            if warned.is_empty() {
                Outcome::Wrong(format!(
                    "{}: {}\n    the device refuses {id}: {abort:?}\n    {}",
                    device.key,
                    set(),
                    said.messages
                ))
            } else {
                Outcome::Warned(warned)
            }
        }
    }
}

/// The configurations of all devices, with what was found about each.
fn each(mut seen: impl FnMut(&Device, &[Setting], Outcome)) {
    for (at, device) in (0u64..).zip(DEVICES) {
        let system = od_tests::compile_clean(device.specification).unwrap();
        let dictionary = system.device(device.key).unwrap();
        for round in 0..device.rounds {
            let mut random = Random::new(at << 32 | round);
            let settings = chance::settings(dictionary, &mut random);
            let outcome = outcome(&system, device, &settings);
            seen(device, &settings, outcome);
        }
    }
}

/// Whether one of some codes is that of a difference that is meant.
fn is_meant(codes: &BTreeSet<&'static str>, differences: &[Difference]) -> bool {
    differences.iter().any(|difference| codes.contains(difference.code))
}

#[test]
fn what_odgen_accepts_the_device_takes() {
    let mut wrong = BTreeSet::new();
    let mut refused = BTreeMap::new();
    let mut by_both = BTreeSet::new();
    let mut accepted = 0;
    each(|device, settings, outcome| match outcome {
        Outcome::Accepted => accepted += 1,
        Outcome::Refused(codes) if codes.len() == 1 => by_both.extend(codes),
        Outcome::Refused(_) | Outcome::Warned(_) => {}
        Outcome::Wrong(text) => drop(wrong.insert(text)),
        // Where several codes are said, one of them is the reason.
        Outcome::Policy(codes) if is_meant(&codes, REFUSED_BY_POLICY) => {}
        Outcome::Policy(codes) => {
            let set: Vec<&str> = settings.iter().map(|setting| setting.text.as_str()).collect();
            refused.entry(codes).or_insert_with(|| format!("{}: {}", device.key, set.join(" ")));
        }
    });
    let wrong: Vec<String> = wrong.into_iter().collect();
    assert!(
        wrong.is_empty() && refused.is_empty(),
        "the device refuses {} configurations that odgen accepts; the first are:\n{}\n\nrefused without a reason:\n{refused:#?}",
        wrong.len(),
        wrong[..wrong.len().min(25)].join("\n"),
    );
    // The settings reach what they are to try.
    let missed: Vec<_> = REFUSED_BY_BOTH.iter().filter(|code| !by_both.contains(*code)).collect();
    assert!(missed.is_empty(), "no configuration was refused by {missed:?} alone, but by {by_both:?}");
    assert!(accepted > 300, "{accepted} configurations were accepted");
}

/// Each difference that is meant has settings that need it: odgen and the device do differ there.
#[test]
fn every_reason_is_needed() {
    let tried = |difference: &Difference| {
        let device = DEVICES.iter().find(|device| device.key == difference.device).unwrap();
        let system = od_tests::compile_clean(device.specification).unwrap();
        outcome(&system, device, &(difference.settings)())
    };
    for difference in REFUSED_BY_POLICY {
        let (code, reason) = (difference.code, difference.reason);
        assert!(
            matches!(tried(difference), Outcome::Policy(codes) if codes.iter().eq([&code])),
            "{code}: {reason}"
        );
    }
    for difference in ACCEPTED_IN_SOME_STATE {
        let (code, reason) = (difference.code, difference.reason);
        assert!(
            matches!(tried(difference), Outcome::Warned(codes) if codes.iter().eq([&code])),
            "{code}: {reason}"
        );
    }
}
