//! What two files say beyond the facts of the model: keys and sections in their own words, and modules.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::ascii::transliterate;
use od_spec::eds::{Owner, owner};
use od_spec::model::{Fact, Further, FurtherSection, KeyValue, Module};

use super::change::{Change, Class, Consequence, Place};
use super::objects::{Devices, name};
use super::rules::{self, Consequences};
use super::sides::{Values, sides};

impl Devices<'_> {
    /// What differs in it, where both sides can have it.
    pub(super) fn further(self) -> Vec<Change> {
        let (Some(old), Some(new)) = (self.old.further.as_deref(), self.new.further.as_deref()) else {
            return Vec::new();
        };
        let lines = |lines: &[String]| transliterate(&lines.join(" / "));
        let comments = old.comments.as_ref().zip(new.comments.as_ref());
        let comments =
            comments.and_then(|(old, new)| Change::text(Place::Device, Fact::Eds, &lines(old), &lines(new)));
        let comments =
            comments.map(|change| change.part("comments").so(Class::Documents, "the file about itself"));
        let mut changes: Vec<Change> = comments.into_iter().collect();
        let none = Vec::new();
        let keys =
            |further: &'_ Further, section: &String| further.keys.get(section).unwrap_or(&none).clone();
        let names: BTreeSet<&String> = old.keys.keys().chain(new.keys.keys()).collect();
        for section in names {
            changes.extend(self.keys(section, &keys(old, section), &keys(new, section)));
        }
        let of_maker = |_: &str| vec![BY_TOOLS];
        changes.extend(sections(Fact::Further, &old.sections, &new.sections, of_maker));
        let numbers: BTreeSet<&u32> = old.modules.keys().chain(new.modules.keys()).collect();
        for number in numbers {
            changes.extend(module(*number, old.modules.get(number), new.modules.get(number)));
        }
        changes
    }

    /// The keys of one section.
    fn keys(self, section: &str, old: &[KeyValue], new: &[KeyValue]) -> Vec<Change> {
        let has = |index| self.old.objects.contains_key(&index) && self.new.objects.contains_key(&index);
        let (place, front) = match owner(section) {
            Owner::File => (Place::Device, format!("[{section}] ")),
            // What is there on one side only is reported as that.
            Owner::Object(index) if has(index) => (Place::Object(index), String::new()),
            Owner::Entry(id) if self.old.entry(id).is_some() && self.new.entry(id).is_some() => {
                (Place::entry(id), String::new())
            }
            Owner::Object(_) | Owner::Entry(_) => return Vec::new(),
        };
        let objects = place
            .index()
            .and_then(|index| Some((self.old.objects.get(&index)?, self.new.objects.get(&index)?)));
        let called = objects.map_or(String::new(), |(old, new)| name(old, new, &place));
        let changes = values(old, new).into_iter().filter_map(|(key, (before, after))| {
            let change = Change::of(place.clone(), Fact::Further, before, after)?;
            Some(change.named(&called).part(format!("{front}{key}")).with([BY_TOOLS]))
        });
        changes.collect()
    }
}

const BY_TOOLS: Consequence = Consequence::new(Class::Behaviour, "tools that know the key act otherwise");

/// The values of keys on both sides; an EDS of ours has them in ASCII.
fn values<'k>(old: &'k [KeyValue], new: &'k [KeyValue]) -> BTreeMap<&'k str, Values> {
    let in_ascii = |one: &'k KeyValue| (one.key.as_str(), transliterate(&one.value));
    sides(old.iter().map(in_ascii), new.iter().map(in_ascii))
}

/// What differs in the keys of whole sections.
fn sections(
    fact: Fact,
    old: &[FurtherSection],
    new: &[FurtherSection],
    consequences: impl Fn(&str) -> Consequences,
) -> Vec<Change> {
    let mut by_name: BTreeMap<&str, [&[KeyValue]; 2]> = BTreeMap::new();
    for (side, sections) in [old, new].into_iter().enumerate() {
        for section in sections {
            by_name.entry(&section.name).or_default()[side] = &section.keys;
        }
    }
    let changes = by_name.into_iter().flat_map(|(name, [old, new])| {
        let of_section = values(old, new).into_iter().filter_map(|(key, (before, after))| {
            let change = Change::of(Place::Device, fact, before, after)?;
            Some(change.part(format!("[{name}] {key}")).with(consequences(name)))
        });
        of_section.collect::<Vec<_>>()
    });
    changes.collect()
}

/// A module that came, went or is another.
fn module(number: u32, old: Option<&Module>, new: Option<&Module>) -> Vec<Change> {
    let (Some(before), Some(after)) = (old, new) else {
        let called = |module: &Module| format!("{} ({})", module.product_name, module.order_code);
        let change = Change::of(Place::Device, Fact::Modules, old.map(called), new.map(called));
        let change = change.map(|change| change.part(number.to_string()).with(rules::ability(new.is_none())));
        return change.into_iter().collect();
    };
    let consequences = |section: &str| {
        let is_for_people = section.ends_with("ModuleInfo") || section.ends_with("Comments");
        vec![if is_for_people {
            Consequence::new(Class::Documents, "what people read about the module")
        } else {
            Consequence::new(Class::Plc, "other objects come with the module")
        }]
    };
    sections(Fact::Modules, &before.sections, &after.sections, consequences)
}
