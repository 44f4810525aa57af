//! What generated code says about entries, bits and errors, in any language; `escape` writes what a specification says as text of the place.

use std::fmt::Write as _;

use od_spec::model::{Edge, ErrorCode, Text};
use od_spec::wording::Wording;

use crate::plan::{Place, Plan, PlannedBits, PlannedEntry};

/// Type, access, mapping, unit, range, special values, default, storage.
pub fn facts(planned: &PlannedEntry<'_>, wording: Wording, escape: impl Fn(&str) -> String) -> Vec<String> {
    let (index, entry) = (planned.id.index, planned.entry);
    let mut facts = vec![entry.data_type.to_string(), wording.access(entry)];
    facts.extend(stated(wording.mapping(entry.pdo)));
    facts.extend(entry.unit.as_ref().map(|unit| format!("in {}", escape(&wording.step(unit)))));
    facts.extend(wording.range(index, entry).map(|range| escape(&range)));
    facts.extend(entry.special.iter().map(|special| escape(&wording.special(entry, special))));
    if planned.place != Place::Alias {
        let default = |value| format!("default {}", escape(&wording.value(Some(index), entry, value)));
        facts.extend(entry.default.as_ref().map(default));
    }
    facts.extend(stated(wording.storage(entry.stored)));
    facts
}

fn stated(words: &str) -> Option<String> {
    (!words.is_empty()).then(|| words.to_owned())
}

/// Place, name and meaning of bits, and how they act.
pub fn bits(plan: &Plan<'_>, bits: &PlannedBits<'_>, escape: impl Fn(&str) -> String) -> String {
    let place = if bits.first == bits.last {
        format!("Bit {}", bits.first)
    } else {
        format!("Bits {} to {}", bits.first, bits.last)
    };
    let about = words(plan, bits.about, &escape);
    let mut text =
        format!("{place}, {}{}{about}", escape(&bits.label), if about.is_empty() { "." } else { ": " });
    let field = bits.field;
    if field.active == 0 {
        text.push_str(" Active at 0.");
    }
    if let Some(edge) = field.edge {
        text.push_str(match edge {
            Edge::Rising => " Acts on a change to 1.",
            Edge::Falling => " Acts on a change to 0.",
            Edge::Both => " Acts on every change.",
        });
    }
    if let Some(clamp) = &field.clamp {
        let _ = write!(text, " Clamp {}.", escape(clamp));
    }
    if !field.errors.is_empty() {
        let codes: Vec<String> = field.error_codes().map(|code| format!("{code:04X}h")).collect();
        let _ = write!(text, " Error {}.", codes.join(", "));
    }
    text
}

/// Name and meaning of an error, and what the device does about it, if it treats it.
pub fn error(plan: &Plan<'_>, error: &ErrorCode, escape: impl Fn(&str) -> String) -> String {
    let is_treated = plan.treats(error);
    let mut rest = String::new();
    let reaction = Some(&error.reaction).filter(|_| is_treated);
    for text in [Some(&error.about), reaction].into_iter().flatten().map(|text| words(plan, text, &escape)) {
        if !text.is_empty() {
            rest.push(' ');
            rest.push_str(&text);
        }
    }
    if let Some(id) = error.option_code.filter(|_| is_treated) {
        let _ = write!(rest, " {id} chooses the reaction.");
    }
    let reset = words(plan, &error.reset, &escape);
    if !reset.is_empty() {
        let _ = write!(rest, " Reset by: {reset}");
    }
    let priority = error.priority.as_ref().filter(|_| is_treated);
    let priority = priority.map(|priority| format!(" Priority {}.", escape(priority)));
    format!("{}.{rest}{}", escape(error.name.trim_end_matches('.')), priority.unwrap_or_default())
}

impl Plan<'_> {
    /// Whether the device treats the error as priority, reaction and option code say.
    pub fn treats(&self, error: &ErrorCode) -> bool {
        error.treated_by.includes(&self.device.key)
    }
}

/// A text in the language of the specification.
fn words(plan: &Plan<'_>, text: &Text, escape: impl Fn(&str) -> String) -> String {
    text.get(plan.system.language()).map(escape).unwrap_or_default()
}
