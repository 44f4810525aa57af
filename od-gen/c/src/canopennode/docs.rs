//! What comments say about objects and entries: the same facts as the documentation of generated Rust.

use od_gen::facts;
use od_gen::plan::Plan;
use od_spec::model::{Entry, TypeKind};

use super::super::page::WORDING;
use super::super::relations::relations;
use super::objects::{Memory, Shape, Slot, StackObject};

/// Words about a device.
#[derive(Clone, Copy)]
pub(super) struct Docs<'p, 'a> {
    pub plan: &'p Plan<'a>,
}

impl Docs<'_, '_> {
    /// All about an object: of a VAR its facts, of an ARRAY those of its elements. Members of a RECORD have comments of their own.
    pub(super) fn object(self, object: &StackObject<'_>) -> String {
        let what =
            self.heading(&format!("{}", object.object.index), &object.object.name, &object.object.about);
        match &object.shape {
            Shape::Var(slot) => join(&what, &self.warning(&slot.entry.warning), &self.facts(slot)),
            Shape::Array { elements, .. } => {
                join(&what, &self.warning(&object.object.warning), &self.elements(elements))
            }
            Shape::Record(_) => join(&what, &self.warning(&object.object.warning), ""),
        }
    }

    /// All about a member of a RECORD.
    pub(super) fn member(self, slot: &Slot<'_>) -> String {
        let what = self.heading(&slot.id.to_string(), &slot.entry.name, &slot.entry.about);
        join(&what, &self.warning(&slot.entry.warning), &self.facts(slot))
    }

    /// Elements, as many as are alike in one line.
    fn elements(self, elements: &[Slot<'_>]) -> String {
        let mut runs: Vec<(u8, u8, String)> = Vec::new();
        for slot in elements {
            let (sub, name) = (slot.id.sub.0, &slot.entry.name);
            let about = self.words(&slot.entry.about);
            let about = if about.is_empty() { String::new() } else { format!(" {about}") };
            let pattern = name.replacen(&sub.to_string(), "{n}", 1);
            let text = format!(
                "{}.{about} {}{}",
                pattern.trim_end_matches('.'),
                self.facts(slot),
                self.warning(&slot.entry.warning)
            );
            match runs.last_mut() {
                Some((_, last, same)) if *same == text => *last = sub,
                _ => runs.push((sub, sub, text)),
            }
        }
        let line = |(first, last, text): (u8, u8, String)| {
            if first == last {
                format!("- {first}: {}", text.replacen("{n}", &first.to_string(), 1))
            } else {
                format!("- {first} to {last}: {}", text.replacen("{n}", "n", 1))
            }
        };
        runs.into_iter().map(line).collect::<Vec<_>>().join("\n")
    }

    fn heading(self, place: &str, name: &str, about: &od_spec::model::Text) -> String {
        match self.words(about) {
            "" => format!("{place} {}.", name.trim_end_matches('.')),
            about => format!("{place} {name}: {about}"),
        }
    }

    fn words(self, text: &od_spec::model::Text) -> &str {
        text.get(self.plan.system.language()).unwrap_or_default()
    }

    fn warning(self, warning: &od_spec::model::Text) -> String {
        match self.words(warning) {
            "" => String::new(),
            warning => format!("\nWarning: {warning}"),
        }
    }

    /// Facts of an entry, and its relations to others, in sentences.
    fn facts(self, slot: &Slot<'_>) -> String {
        let planned = self.plan.row(slot.id).and_then(|row| self.plan.entry(row));
        let facts = planned.map(|planned| facts::facts(planned, WORDING, str::to_owned)).unwrap_or_default();
        let mut text = facts.join(", ") + ".";
        for sentence in [values(slot.entry), memory(slot)].into_iter().flatten() {
            text.push(' ');
            text.push_str(&sentence);
        }
        text.push_str(&planned.map(|planned| relations(self.plan, planned)).unwrap_or_default());
        text
    }
}

/// Names of values and bits; `OD_types.h` says more about each.
fn values(entry: &Entry) -> Option<String> {
    let named = entry.named_type.as_ref()?;
    let list: Vec<String> = match &named.kind {
        TypeKind::Enum(values) => {
            let supported = values.iter().filter(|value| value.supported);
            supported.map(|value| format!("{} {}", value.value, value.name)).collect()
        }
        TypeKind::Bits(fields) => {
            let used = fields.iter().filter(|field| !field.name.is_empty());
            used.map(|field| {
                let to =
                    if field.first == field.last { String::new() } else { format!(" to {}", field.last) };
                format!("{}{to} {}", field.first, field.name)
            })
            .collect()
        }
    };
    let kind = match &named.kind {
        TypeKind::Enum(_) => "Values",
        TypeKind::Bits(_) => "Bits",
    };
    (!list.is_empty()).then(|| format!("{kind} ({}): {}.", named.name, list.join(", ")))
}

fn join(heading: &str, warning: &str, facts: &str) -> String {
    let facts = if facts.is_empty() { String::new() } else { format!("\n{facts}") };
    format!("{heading}{warning}{facts}")
}

/// Who has the value, where it does not lie in memory.
fn memory(slot: &Slot<'_>) -> Option<String> {
    match (&slot.memory, &slot.entry.alias) {
        (Memory::Variable { .. }, _) => None,
        (Memory::View, Some(alias)) => Some(format!(
            "Another view of {}, which the extension of OD_extension.h gives: {}.",
            alias.target,
            WORDING.conversion(alias)
        )),
        (Memory::View | Memory::Stack, _) if slot.id.index.0 == 0x1003 => {
            Some("The stack has the errors.".to_owned())
        }
        (Memory::View | Memory::Stack, _) => {
            Some("No memory: an extension of the application has it.".to_owned())
        }
    }
}
