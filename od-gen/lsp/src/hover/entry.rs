//! What an entry is: its facts as the model has them, in the words of the documents.

use od_spec::model::{
    Dictionary, Entry, EntryId, Erratum, ErratumPlace, Fact, Object, Part, PdoMapping, Storage, System,
    TypeKind,
};

use super::definition::type_members;
use super::{Words, code, escaped, joined};
use crate::library;

/// An entry on some devices; where it is the same on several, once.
pub(super) fn of_entry(system: &System, id: EntryId, devices: &[&str], words: Words<'_>) -> Option<String> {
    let is_for = |device: &&Dictionary| devices.is_empty() || devices.contains(&device.key.as_str());
    let described = system.devices.iter().filter(is_for).filter_map(|device| {
        let object = device.objects.get(&id.index)?;
        let entry = object.entry(id.sub)?;
        let described = Described { system, device, object, entry, id, words };
        Some((device.key.as_str(), described.text()))
    });
    let mut variants: Vec<(Vec<&str>, String)> = Vec::new();
    for (key, text) in described {
        match variants.iter_mut().find(|(_, known)| *known == text) {
            Some((keys, _)) => keys.push(key),
            None => variants.push((vec![key], text)),
        }
    }
    let is_everywhere = variants.len() == 1 && variants[0].0.len() == system.devices.len();
    joined(variants.into_iter().map(|(keys, text)| {
        if is_everywhere { text } else { format!("{text}\n\n*{}*", escaped(&keys.join(", "))) }
    }))
}

struct Described<'a> {
    system: &'a System,
    device: &'a Dictionary,
    object: &'a Object,
    entry: &'a Entry,
    id: EntryId,
    words: Words<'a>,
}

impl Described<'_> {
    fn text(&self) -> String {
        let name = self.device.entry_name(self.id).unwrap_or_default();
        let mut text = format!("{} **{}**", code(&self.id.to_string()), escaped(&name));
        for fact in self.facts() {
            text.push_str("\n- ");
            text.push_str(&fact);
        }
        let about =
            [&self.entry.about, &self.object.about].into_iter().find_map(|about| self.words.text(about));
        let warning = self
            .words
            .text(&self.entry.warning)
            .map(|warning| format!("**{}:** {warning}", self.words.wording.fact(Fact::Warning)));
        for paragraph in [about, warning].into_iter().flatten() {
            text.push_str("\n\n");
            text.push_str(&paragraph);
        }
        text
    }

    /// Facts, a line each.
    fn facts(&self) -> Vec<String> {
        let (entry, words) = (self.entry, self.words.wording);
        let line = |fact: Fact, text: String| format!("{}: {text}", words.fact(fact));
        let mut lines = vec![line(Fact::Type, self.data_type())];
        if let Some(unit) = &entry.unit {
            // A unit that no specification names is called by its step.
            let step = words.counted_step(unit);
            let name = Some(code(&unit.name)).filter(|_| unit.name != step);
            let parts: Vec<String> = name.into_iter().chain([escaped(&step)]).collect();
            lines.push(line(Fact::Unit, parts.join(", ")));
        }
        lines.push(line(Fact::Access, words.access(entry)));
        lines.extend(self.values(entry));
        if entry.pdo != PdoMapping::None {
            lines.push(line(Fact::Mapping, words.mapping(entry.pdo).to_owned()));
        }
        lines.extend(self.carriers());
        if entry.stored != Storage::No {
            let group = words.storage_group_of(entry.stored, self.device);
            lines.push(line(Fact::Storage, group.to_owned()));
        }
        if let Some(condition) = &entry.writable_when {
            lines.push(line(Fact::WriteCondition, code(&condition.text)));
        }
        lines.extend(self.views());
        lines.extend(self.constraints());
        lines.extend(self.standard());
        if let Some(since) = entry.since.as_ref().or(self.object.since.as_ref()) {
            lines.push(line(Fact::Since, escaped(since)));
        }
        lines.extend(self.errata());
        lines
    }

    fn data_type(&self) -> String {
        let data_type = self.entry.data_type.to_string();
        let Some(named) = &self.entry.named_type else { return data_type };
        let members = match &named.kind {
            TypeKind::Enum(_) | TypeKind::Bits(_) => type_members(named, self.words),
        };
        format!("{}, {data_type}{members}", code(&named.name))
    }

    /// Default, limits and special values, physical ones with their raw values.
    fn values(&self, entry: &Entry) -> Vec<String> {
        let words = self.words.wording;
        let mut lines = Vec::new();
        if let Some(default) = &entry.default {
            let value = words.value(Some(self.id.index), entry, default);
            lines.push(format!("{}: {}", words.fact(Fact::Default), escaped(&value)));
        }
        if let Some(range) = words.range(self.id.index, entry) {
            let (low, high) = (words.fact(Fact::LowLimit), words.fact(Fact::HighLimit));
            lines.push(format!("{low}, {high}: {}", escaped(&range)));
        }
        if !entry.special.is_empty() {
            let special: Vec<String> =
                entry.special.iter().map(|one| escaped(&words.special(entry, one))).collect();
            lines.push(format!("{}: {}", words.fact(Fact::Special), special.join(", ")));
        }
        lines
    }

    /// The PDOs that carry it, with its place in them.
    fn carriers(&self) -> Vec<String> {
        let carriers = self.device.pdos_with(self.id);
        let line = |carrier: od_spec::model::Carrier<'_>| {
            let (pdo, field) = (carrier.pdo, carrier.field);
            let bit = if field.bit() == 0 { String::new() } else { format!(", bit {}", field.bit()) };
            let id = pdo.cob_id.as_ref().map(|id| format!(", {}", self.words.wording.can_id(id)));
            let (name, id) = (pdo.direction.pdo(), id.unwrap_or_default());
            format!("{name} {}: byte {}{bit}, {} bit{id}", pdo.number, field.byte(), field.mapped.bits)
        };
        carriers.map(line).collect()
    }

    /// What it shows, and what shows it.
    fn views(&self) -> Vec<String> {
        let words = self.words.wording;
        let named = |id: EntryId| {
            format!("{} {}", code(&id.to_string()), escaped(&self.device.entry_name(id).unwrap_or_default()))
        };
        let label = words.fact(Fact::Alias);
        let shows =
            self.entry.alias.as_ref().map(|alias| {
                format!("{label} → {}, {}", named(alias.target), escaped(&words.conversion(alias)))
            });
        let shown = self
            .device
            .views_of(self.id)
            .map(|view| format!("{label} ← {}, {}", named(view.id), escaped(&words.conversion(view.alias))));
        shows.into_iter().chain(shown).collect()
    }

    fn constraints(&self) -> Vec<String> {
        let key = self.device.key.as_str();
        let about = self.system.constraints_about(key).filter(|constraint| {
            let named = constraint.require.entries().into_iter();
            let when = constraint.when.iter().flat_map(|when| when.entries());
            named.chain(when).any(|entry| {
                let is_here = match entry.device.as_deref() {
                    Some(device) => device == key,
                    None => constraint.seen_from.iter().any(|from| from == key),
                };
                entry.id == self.id && is_here
            })
        });
        let label = self.words.wording.fact(Fact::Requirement);
        let line = |constraint: &od_spec::model::Constraint| {
            let when = constraint.when.as_ref().map(|when| format!(" ({})", code(&when.text)));
            let (name, require) = (escaped(&constraint.name), code(&constraint.require.text));
            format!("{label}: {name}, {require}{}", when.unwrap_or_default())
        };
        about.map(line).collect()
    }

    /// What a standard says where the device says something else.
    fn standard(&self) -> Vec<String> {
        let Some(profile) = &self.object.profile else { return Vec::new() };
        let words = self.words.wording;
        let is_about = |part: Part| match part {
            Part::Object => true,
            Part::Elements => self.id.sub.0 > 0,
            Part::Entry(sub) => sub == self.id.sub,
            Part::Entries { first, last } => (first..=last).contains(&self.id.sub),
            _ => false,
        };
        let departures = self.object.departures.iter().filter(|departure| is_about(departure.part));
        let departures: Vec<String> = departures.map(|departure| words.departure(*departure)).collect();
        if departures.is_empty() {
            return vec![escaped(profile)];
        }
        let mut said = Vec::new();
        if let Some(entry) = library::entry(profile, self.id) {
            said.push(entry.data_type.to_string());
            said.push(words.access(entry));
            said.extend(self.values(entry));
        }
        let said = if said.is_empty() { String::new() } else { format!(" ({})", said.join("; ")) };
        vec![format!("{}{said} ≠ {}", escaped(profile), departures.join(", "))]
    }

    fn errata(&self) -> Vec<String> {
        let is_about = |place: &ErratumPlace| match place {
            ErratumPlace::Object(index) => *index == self.id.index,
            ErratumPlace::Entry(id) => *id == self.id,
        };
        let about =
            self.system.errata.iter().filter(|erratum| {
                erratum.devices.includes(&self.device.key) && erratum.at.iter().any(is_about)
            });
        let words = self.words;
        let label = words.wording.fact(Fact::Errata);
        let line = |erratum: &Erratum| {
            let text = |text| words.text(text).unwrap_or_default();
            let kind = words.wording.erratum_kind(erratum.kind);
            let (prints, reads) = (text(&erratum.prints), text(&erratum.reads));
            format!(
                "{label}: {kind}, {}: {prints} → {reads}. {}",
                text(&erratum.place),
                text(&erratum.because)
            )
        };
        about.map(line).collect()
    }
}
