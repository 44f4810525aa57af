//! Enums and bit fields: what their values and bits mean before and after.

use std::collections::BTreeMap;

use od_spec::model::{
    BitField, BitUsage, DataType, Dictionary, EntryId, EnumValue, Fact, ModeMeaning, NamedType, TypeKind,
};

use super::change::{Change, Class, Consequence, Place};
use super::rules::{self, Consequences, same_words};
use super::texts::{phrases, texts};
use super::words::{self, VALUES};

/// What generated code calls after the members of a type, on both sides; `None` where there is no code to break.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Names {
    /// Generated code has constants and methods of these names.
    InCode,
    /// No code is generated.
    Nowhere,
}

/// The types that entries of both devices have under one name.
pub(super) fn changes(old: &Dictionary, new: &Dictionary, names: Names, language: &str) -> Vec<Change> {
    let mut changes = Vec::new();
    for (name, (before, after, users)) in shared(old, new) {
        let found = Members { place: Place::Type(name.to_owned()), names, language };
        let users = users.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        changes.extend(found.of(before, after).into_iter().map(|change| change.named(users.clone())));
    }
    changes
}

type Shared<'a> = BTreeMap<&'a str, (&'a NamedType, &'a NamedType, Vec<EntryId>)>;

fn shared<'a>(old: &'a Dictionary, new: &'a Dictionary) -> Shared<'a> {
    let mut shared = Shared::new();
    for (id, _, entry) in new.entries() {
        let before = old.entry(id).and_then(|entry| entry.named_type.as_deref());
        let after = entry.named_type.as_deref();
        if let (Some(before), Some(after)) = (before, after)
            && before.name == after.name
        {
            shared.entry(&after.name).or_insert_with(|| (before, after, Vec::new())).2.push(id);
        }
    }
    shared
}

/// What an entry's values mean once it has another type.
pub(super) fn replaced(
    before: Option<&NamedType>,
    after: Option<&NamedType>,
    is_writable: bool,
) -> Consequences {
    let is_enum = |named: &NamedType| matches!(named.kind, TypeKind::Enum(_));
    let one = |class, because| vec![Consequence::new(class, because)];
    match (before, after) {
        (None, Some(named)) if is_enum(named) && is_writable => {
            one(Class::Plc, "values that the enum does not list are refused")
        }
        (Some(named), None) if is_enum(named) && is_writable => {
            one(Class::Addition, "values are not restricted to a list any more")
        }
        (Some(before), Some(after)) => {
            let found = Members { place: Place::Device, names: Names::Nowhere, language: "" };
            found.of(before, after).into_iter().flat_map(|change| change.consequences).collect()
        }
        (None, _) | (_, None) => one(Class::Documents, "the value itself is the same"),
    }
}

/// Looks at the members of a type.
pub(super) struct Members<'a> {
    pub place: Place,
    pub names: Names,
    pub language: &'a str,
}

impl Members<'_> {
    /// Everything that differs but the data type, which is a fact of the entries.
    pub(super) fn of(&self, before: &NamedType, after: &NamedType) -> Vec<Change> {
        let mut changes = texts(&self.place, Fact::About, &before.about, &after.about, self.language);
        match (&before.kind, &after.kind) {
            (TypeKind::Enum(old), TypeKind::Enum(new)) => {
                changes.extend(self.values("", after.base, old, new));
            }
            (TypeKind::Bits(old), TypeKind::Bits(new)) => changes.extend(self.bits(after.base, old, new)),
            (TypeKind::Enum(_), TypeKind::Bits(_)) | (TypeKind::Bits(_), TypeKind::Enum(_)) => {
                let kind = |named: &NamedType| match named.kind {
                    TypeKind::Enum(_) => "values",
                    TypeKind::Bits(_) => "bits",
                };
                let change = Change::text(self.place.clone(), Fact::Meaning, kind(before), kind(after));
                let change = change.map(|change| change.so(Class::Plc, "every value means something else"));
                changes.extend(change.map(|change| change.with(self.gone())));
            }
        }
        changes
    }

    /// What follows in firmware when a name is gone.
    fn gone(&self) -> Option<Consequence> {
        match self.names {
            Names::InCode => Some(Consequence::new(Class::Firmware, "the name is gone from generated code")),
            Names::Nowhere => None,
        }
    }

    /// The same, unless one of the names that are there now has the same words.
    fn gone_from<'n>(&self, name: &str, mut now: impl Iterator<Item = &'n str>) -> Option<Consequence> {
        if now.any(|one| same_words(one, name)) { None } else { self.gone() }
    }

    fn values(&self, part: &str, base: DataType, old: &[EnumValue], new: &[EnumValue]) -> Vec<Change> {
        let find = |list: &'_ [EnumValue], raw| list.iter().position(|one| one.value == raw);
        let mut raws: Vec<i128> = old.iter().chain(new).map(|value| value.value).collect();
        raws.sort_unstable();
        raws.dedup();
        let mut changes = Vec::new();
        for raw in raws {
            let part = format!("{part}value {}", VALUES.enum_number(base, raw));
            let now = || new.iter().map(|value| value.name.as_str());
            match (find(old, raw).map(|at| &old[at]), find(new, raw).map(|at| &new[at])) {
                (Some(before), Some(after)) => {
                    changes.extend(self.value(&part, before, after, old, new));
                }
                (Some(before), None) => changes.push(
                    Change::removed(self.place.clone(), &before.name)
                        .part(part)
                        .with(support(before.supported, false))
                        .with(self.gone_from(&before.name, now())),
                ),
                (None, Some(after)) => changes.push(
                    Change::added(self.place.clone(), &after.name)
                        .part(part)
                        .with(support(false, after.supported)),
                ),
                (None, None) => {}
            }
        }
        changes
    }

    /// A value that both sides have.
    fn value(
        &self,
        part: &str,
        before: &EnumValue,
        after: &EnumValue,
        old: &[EnumValue],
        new: &[EnumValue],
    ) -> Vec<Change> {
        let mut changes = Vec::new();
        if let Some(change) = Change::text(self.place.clone(), Fact::Meaning, &before.name, &after.name) {
            let is_anothers = old.iter().any(|one| same_words(&one.name, &after.name));
            let now = new.iter().map(|value| value.name.as_str());
            changes.push(
                change
                    .part(part)
                    .with(if before.supported || after.supported {
                        rules::meaning(&before.name, &after.name, is_anothers)
                    } else {
                        support(false, false)
                    })
                    .with(self.gone_from(&before.name, now)),
            );
        }
        let supported = |value: &EnumValue| words::yes_no(value.supported);
        if let Some(change) =
            Change::text(self.place.clone(), Fact::Meaning, supported(before), supported(after))
        {
            let part = format!("{part} supported");
            changes.push(change.part(part).with(support(before.supported, after.supported)));
        }
        let about = texts(&self.place, Fact::About, &before.about, &after.about, self.language);
        let search = phrases(&self.place, &before.search, &after.search, self.language);
        changes.extend(about.into_iter().chain(search).map(|change| change.part(part)));
        changes
    }

    fn bits(&self, base: DataType, old: &[BitField], new: &[BitField]) -> Vec<Change> {
        let mut ranges: Vec<(u8, u8)> =
            old.iter().chain(new).map(|field| (field.first, field.last)).collect();
        ranges.sort_unstable();
        ranges.dedup();
        let mut changes = self.free_bits(old, new);
        for (first, last) in ranges {
            let find = |list: &'_ [BitField]| {
                list.iter().position(|field| (field.first, field.last) == (first, last))
            };
            let (before, after) = (find(old).map(|at| &old[at]), find(new).map(|at| &new[at]));
            let part = part(first, last);
            let is_used = |field: Option<&BitField>| field.is_some_and(|field| field.usage == BitUsage::Used);
            match (before.filter(|_| is_used(before)), after.filter(|_| is_used(after))) {
                (Some(before), Some(after)) => {
                    changes.extend(self.field(&part, base, before, after, old, new));
                }
                (Some(before), None) => changes.push(
                    Change::removed(self.place.clone(), &before.name)
                        .part(part)
                        .so(Class::Plc, "the bits mean nothing any more, or something else")
                        .with(self.gone_from(&before.name, names(new))),
                ),
                (None, Some(after)) => changes.push(
                    Change::added(self.place.clone(), &after.name)
                        .part(part)
                        .so(Class::Addition, "the bits had no meaning"),
                ),
                (None, None) => {
                    if let (Some(before), Some(after)) = (before, after) {
                        let about =
                            texts(&self.place, Fact::About, &before.about, &after.about, self.language);
                        changes.extend(about.into_iter().map(|change| change.part(part.clone())));
                    }
                }
            }
        }
        changes
    }

    /// Bits without a meaning on both sides: reserved or unused.
    fn free_bits(&self, old: &[BitField], new: &[BitField]) -> Vec<Change> {
        let usage = |list: &[BitField], bit: u8| {
            let field = list.iter().find(|field| (field.first..=field.last).contains(&bit))?;
            match field.usage {
                BitUsage::Used => None,
                BitUsage::Reserved => Some("reserved"),
                BitUsage::Unused => Some("unused"),
            }
        };
        let changes = (0..64).filter_map(|bit| {
            let (before, after) = (usage(old, bit)?, usage(new, bit)?);
            let change = Change::text(self.place.clone(), Fact::Meaning, before, after)?;
            Some(change.part(part(bit, bit)).so(Class::Documents, "the bit means nothing either way"))
        });
        changes.collect()
    }

    /// Bits with a meaning on both sides.
    fn field(
        &self,
        part: &str,
        base: DataType,
        before: &BitField,
        after: &BitField,
        old: &[BitField],
        new: &[BitField],
    ) -> Vec<Change> {
        let mut changes = Vec::new();
        if let Some(change) = Change::text(self.place.clone(), Fact::Meaning, &before.name, &after.name) {
            let is_anothers = names(old).any(|name| !name.is_empty() && same_words(name, &after.name));
            changes.push(
                change
                    .part(part)
                    .with(rules::meaning(&before.name, &after.name, is_anothers))
                    .with(self.gone_from(&before.name, names(new))),
            );
        }
        let level = |field: &BitField| Some(field.active.to_string());
        let edge = |field: &BitField| field.edge.map(|edge| edge.word().to_owned());
        let errors = |field: &BitField| {
            let codes: Vec<String> = field.error_codes().map(|code| format!("{code:04X}h")).collect();
            (!codes.is_empty()).then(|| codes.join(", "))
        };
        let details = [
            (Fact::Meaning, " active level", level(before), level(after), Class::Plc, "1 means what 0 meant"),
            (
                Fact::Meaning,
                " edge",
                edge(before),
                edge(after),
                Class::Behaviour,
                "another write triggers it",
            ),
            (
                Fact::BitErrors,
                "",
                errors(before),
                errors(after),
                Class::Documents,
                "bit and code keep their meanings",
            ),
            (
                Fact::Priority,
                "",
                before.priority.clone(),
                after.priority.clone(),
                Class::Behaviour,
                "the device treats the error otherwise",
            ),
            (
                Fact::Meaning,
                " mnemonic",
                before.mnemonic.clone(),
                after.mnemonic.clone(),
                Class::Documents,
                "a name in documents only",
            ),
            (
                Fact::Meaning,
                " clamp",
                before.clamp.clone(),
                after.clamp.clone(),
                Class::Documents,
                "wiring, not communication",
            ),
        ];
        changes.extend(details.into_iter().filter_map(|(fact, detail, before, after, class, because)| {
            let change = Change::of(self.place.clone(), fact, before, after)?;
            Some(change.part(format!("{part}{detail}")).so(class, because))
        }));
        changes.extend(self.values(&format!("{part} "), base, &before.values, &after.values));
        changes.extend(self.modes(part, &before.modes, &after.modes));
        let about = texts(&self.place, Fact::About, &before.about, &after.about, self.language);
        let search = phrases(&self.place, &before.search, &after.search, self.language);
        changes.extend(about.into_iter().chain(search).map(|change| change.part(part)));
        changes
    }

    /// What bits mean in single modes of operation.
    fn modes(&self, part: &str, old: &[ModeMeaning], new: &[ModeMeaning]) -> Vec<Change> {
        let mut modes: Vec<&str> = old.iter().chain(new).map(|one| one.mode.value.as_str()).collect();
        modes.sort_unstable();
        modes.dedup();
        let mut changes = Vec::new();
        for mode in modes {
            let find = |list: &'_ [ModeMeaning]| list.iter().position(|one| one.mode.value == mode);
            let (before, after) = (find(old).map(|at| &old[at]), find(new).map(|at| &new[at]));
            let name = |one: Option<&ModeMeaning>| one.map(|one| one.name.clone());
            let part = format!("{part} in {mode}");
            if let Some(change) = Change::of(self.place.clone(), Fact::Meaning, name(before), name(after)) {
                let consequences = match (before, after) {
                    (Some(before), Some(after)) => rules::meaning(&before.name, &after.name, false),
                    (Some(_), None) => {
                        vec![Consequence::new(Class::Plc, "the bits mean nothing in the mode")]
                    }
                    (None, _) => vec![Consequence::new(Class::Addition, "the bits had no meaning")],
                };
                let gone = before.and_then(|before| {
                    self.gone_from(&before.name, after.into_iter().map(|one| one.name.as_str()))
                });
                changes.push(change.part(part.clone()).with(consequences).with(gone));
            }
            if let (Some(before), Some(after)) = (before, after) {
                let about = texts(&self.place, Fact::About, &before.about, &after.about, self.language);
                changes.extend(about.into_iter().map(|change| change.part(part.clone())));
            }
        }
        changes
    }
}

fn names(fields: &[BitField]) -> impl Iterator<Item = &str> {
    fields.iter().filter(|field| field.usage == BitUsage::Used).map(|field| field.name.as_str())
}

fn part(first: u8, last: u8) -> String {
    if first == last { format!("bit {first}") } else { format!("bits {first}..{last}") }
}

/// A value of an enum that the device takes and sends, or not.
fn support(before: bool, after: bool) -> Consequences {
    match (before, after) {
        (true, false) => vec![Consequence::new(Class::Plc, "the device does not take or send it any more")],
        (false, true) => vec![Consequence::new(Class::Addition, "nothing used it")],
        (true, true) | (false, false) => {
            vec![Consequence::new(Class::Documents, "the device does not have it")]
        }
    }
}
