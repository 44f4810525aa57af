//! A device as the files show it: its names, and the comments that its facts make.

use std::collections::BTreeMap;

use od_gen::plan::Words;
use od_spec::model::{Dictionary, Entry, EntryId, Fact, NamedType, Object, StateMachine, System, TypeKind};
use od_spec::wording::{Language, Word, Wording};

use super::names::{LONGEST, LONGEST_OF_ENTRY, Scope, Wanted};
use super::phrases::Phrase;

/// A device, and in which words it is described.
pub(super) struct Device<'a> {
    pub system: &'a System,
    pub dictionary: &'a Dictionary,
    /// The node, where it is known.
    pub node: Option<u8>,
    /// How facts are worded.
    pub wording: Wording,
    /// The language of the specification's texts.
    texts: &'a str,
    /// What every name of the files begins with.
    pub prefix: String,
    entry_names: BTreeMap<EntryId, String>,
    type_names: BTreeMap<&'a str, String>,
    /// The names of the files.
    pub scope: Scope,
}

impl<'a> Device<'a> {
    pub(super) fn new(
        system: &'a System,
        dictionary: &'a Dictionary,
        node: Option<u8>,
        texts: &'a str,
        words: Language,
    ) -> Self {
        let prefix = Words::of(&dictionary.key);
        let wanted: Vec<(EntryId, Wanted)> = dictionary
            .entries()
            .map(|(id, object, entry)| {
                let mut words = prefix.and(&object.name);
                if object.is_structured() {
                    words = words.and(&entry.name);
                }
                (id, Wanted::new(words.snake(), number(id)))
            })
            .collect();
        let (ids, wanted): (Vec<_>, Vec<_>) = wanted.into_iter().unzip();
        let entry_names = ids.into_iter().zip(Scope::new(LONGEST_OF_ENTRY).give_all(&wanted)).collect();
        let mut device = Self {
            system,
            dictionary,
            node,
            wording: Wording::manual(words),
            texts,
            prefix: prefix.snake(),
            entry_names,
            type_names: BTreeMap::new(),
            scope: Scope::new(LONGEST),
        };
        let types = device.types();
        let wanted: Vec<Wanted> =
            types.iter().map(|named| Wanted::new(prefix.and(&named.name).snake(), "type")).collect();
        let names = Scope::new(LONGEST_OF_ENTRY).give_all(&wanted);
        device.type_names = types.iter().map(|named| named.name.as_str()).zip(names).collect();
        device
    }

    /// The enums and bit fields that entries of the device have, by name.
    pub(super) fn types(&self) -> Vec<&'a NamedType> {
        let named = self.dictionary.entries().filter_map(|(_, _, entry)| entry.named_type.as_deref());
        let by_name: BTreeMap<&str, &NamedType> = named.map(|named| (named.name.as_str(), named)).collect();
        by_name.into_values().collect()
    }

    /// The bit fields among them.
    pub(super) fn bit_types(&self) -> Vec<&'a NamedType> {
        self.types().into_iter().filter(|named| matches!(named.kind, TypeKind::Bits(_))).collect()
    }

    /// The state machines of the device.
    pub(super) fn machines(&self) -> impl Iterator<Item = &'a StateMachine> {
        let key = self.dictionary.key.as_str();
        self.system.machines.values().filter(move |machine| machine.devices.includes(key))
    }

    /// What names that have to do with an entry begin with.
    pub(super) fn name_of(&self, id: EntryId) -> &str {
        self.entry_names.get(&id).map_or("", String::as_str)
    }

    /// What names that have to do with an object begin with.
    pub(super) fn name_of_object(&self, object: &Object) -> String {
        Words::of(&self.prefix).and(&object.name).snake()
    }

    /// What names that have to do with a type begin with.
    pub(super) fn name_of_type(&self, named: &NamedType) -> &str {
        self.type_names.get(named.name.as_str()).map_or("", String::as_str)
    }

    /// A name that begins with that of the device.
    pub(super) fn prefixed(&self, name: &str) -> String {
        Words::of(&self.prefix).and(name).snake()
    }

    /// A fixed sentence.
    pub(super) fn phrase(&self, phrase: Phrase, parts: &[&str]) -> String {
        phrase.filled(self.wording.language, parts)
    }

    /// A text of the specification; empty where there is none.
    pub(super) fn text<'t>(&self, text: &'t od_spec::model::Text) -> &'t str {
        text.get(self.texts).unwrap_or_default()
    }

    /// `2000h set pressure`.
    pub(super) fn title(&self, id: EntryId) -> String {
        format!("{id} {}", self.dictionary.entry_name(id).unwrap_or_default())
    }

    /// What is worth knowing of an entry, line by line.
    pub(super) fn comment(&self, id: EntryId, object: &Object, entry: &Entry) -> Vec<String> {
        let wording = self.wording;
        let mut facts = vec![entry.data_type.to_string(), wording.access(entry)];
        facts.extend(entry.named_type.as_ref().map(|named| named.name.clone()));
        facts.extend(entry.unit.as_ref().map(|unit| wording.step(unit)));
        facts.extend(wording.range(object.index, entry));
        facts.extend(entry.default.as_ref().map(|value| {
            format!("{}: {}", wording.fact(Fact::Default), wording.value(Some(object.index), entry, value))
        }));
        let mut lines = vec![self.title(id), facts.join(", ")];
        if let Some(alias) = &entry.alias {
            let of = self.title(alias.target);
            lines.push(format!("{}: {of}, {}", wording.fact(Fact::Alias), wording.conversion(alias)));
        }
        let warning = self.text(&entry.warning);
        if !warning.is_empty() {
            lines.push(format!("{}: {warning}", wording.fact(Fact::Warning)));
        }
        lines.push(self.text(&entry.about).to_owned());
        lines.retain(|line| !line.is_empty());
        lines
    }

    /// `bit 3`, `bits 3..5`.
    pub(super) fn place_of_bits(&self, first: u8, last: u8) -> String {
        if first == last {
            format!("{} {first}", self.wording.word(Word::NamelessBit))
        } else {
            format!("{} {first}..{last}", self.wording.word(Word::NamelessBits))
        }
    }
}

/// What distinguishes an entry from every other one: `6041_0`.
pub(super) fn number(id: EntryId) -> String {
    format!("{:04X}_{}", id.index.0, id.sub.0)
}

/// A name and what follows it, in upper case as constants and types have them.
pub(super) fn capitals(name: &str, behind: &str) -> String {
    joined(name, behind).to_ascii_uppercase()
}

/// A name and the words after it.
pub(super) fn joined(name: &str, behind: &str) -> String {
    Words::of(name).and(behind).snake()
}
