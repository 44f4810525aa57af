//! What comments above a section say (the form is that of our own EDS files): a unit, named bits and values, who keeps the
//! value, a default that is withheld; and words for people.
//!
//! Everything else stays a text. A comment can add a meaning to what the keys say, and never contradict them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use super::made;
use crate::ast::{
    BitDecl, BitRange, ConditionDecl, DefaultDecl, EdsDecl, EntryDecl, Offset, SpecialDecl, TypeDecl,
    UnitDecl, ValueDecl,
};
use crate::eds::number::{formula, lenient_integer};
use crate::eds::owner::is_code;
use crate::eds::view::Part;
use crate::expr::Expr;
use crate::model::{Access, AccessRight, BitUsage, DataType, Family, Ratio, Storage, Text};
use crate::order::Arrange as _;
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::wording::{Notation, Wording};

const WORDING: Wording = Wording::english(Notation::Eds);

/// Units and types that comments name, each once.
#[derive(Default)]
pub(super) struct Meanings {
    units: BTreeMap<String, UnitDecl>,
    /// Types by what they say, with their names.
    types: BTreeMap<String, TypeDecl>,
    /// The names of these types.
    type_names: BTreeSet<String>,
}

impl Meanings {
    /// The units and types for the declaration.
    pub(super) fn into_declarations(self) -> (Vec<UnitDecl>, Vec<TypeDecl>) {
        let mut types: Vec<TypeDecl> = self.types.into_values().collect();
        types.arrange_by(|one, other| one.name.value.cmp(&other.name.value));
        (self.units.into_values().collect(), types)
    }

    /// Adds what the comments above a section say about its entry.
    pub(super) fn add_to(&mut self, entry: EntryDecl, part: &Part<'_>, name: &str) -> EntryDecl {
        let lines = sentences(part);
        if lines.is_empty() {
            return entry;
        }
        let place = entry.span;
        let data_type = entry.type_name.as_ref().and_then(|name| DataType::from_name(&name.value));
        let mut read = Comments::default();
        for line in lines {
            read.line(line);
        }
        let mut entry = entry;
        if let Some(warning) = &read.warning {
            entry.warning = Some(Spanned::new(Text::new([("en", warning.as_str())]), place));
        }
        if let Some(text) = read.text() {
            entry.about = Some(Spanned::new(Text::new([("en", text.as_str())]), place));
        }
        let Some(data_type) = data_type else { return entry };
        let is_number = data_type.is_integer() || data_type.family() == Family::Real;
        if let Some(unit) = read.unit.filter(|_| is_number) {
            entry.unit = Some(made(self.unit(&unit, place), place));
        }
        if let Some(storage) = read.storage {
            entry.stored = Some(Spanned::new(storage, place));
        }
        if let (true, Some(access)) = (read.is_locked, entry.access) {
            entry = locked(entry, access, place);
        }
        let is_writable = entry.access.is_some_and(|access| access.value.access.is_writable());
        if let Some(condition) = read.condition.filter(|_| is_writable) {
            entry.writable_when = Some(Spanned::new(ConditionDecl::Plain(condition), place));
        }
        if let Some(text) = read.withheld.filter(|_| entry.default.is_none()) {
            entry = withheld(entry, &text, data_type, place);
        }
        if !read.bits.is_empty() && data_type.is_integer() {
            if let Some(named) = bits(read.bits, data_type, place) {
                entry.type_name = Some(made(self.named(named, name), place));
            }
            entry = special(entry, read.values, data_type);
        } else if !read.values.is_empty() && data_type.is_integer() {
            entry = self.values(entry, read.values, data_type, name);
        }
        entry
    }

    /// The name of a unit, which is how its step reads.
    fn unit(&mut self, unit: &StepText, place: Span) -> String {
        let decl = UnitDecl {
            name: made(unit.text.clone(), place),
            symbol: Some(made(unit.symbol.clone(), place)),
            scale: Some(Spanned::new(unit.scale, place)),
            offset: unit.offset.map(|offset| Spanned::new(Offset(offset), place)),
            base: None,
            formula: None,
            about: None,
        };
        self.units.entry(unit.text.clone()).or_insert(decl);
        unit.text.clone()
    }

    /// The name of a type: that of the first entry that has it.
    fn named(&mut self, named: TypeDecl, entry: &str) -> String {
        let content = content(&named);
        if let Some(known) = self.types.get(&content) {
            return known.name.value.clone();
        }
        let is_taken = |name: &str| DataType::from_name(name).is_some() || self.type_names.contains(name);
        let numbered = (2..).map(|number| format!("{entry} {number}"));
        let name = std::iter::once(entry.to_owned()).chain(numbered).find(|name| !is_taken(name));
        let name = name.unwrap_or_default();
        let place = named.name.span;
        self.type_names.insert(name.clone());
        self.types.insert(content, TypeDecl { name: made(name.clone(), place), ..named });
        name
    }

    /// Named values: an enum if nothing that the keys say lies outside of them, or else special values.
    fn values(
        &mut self,
        entry: EntryDecl,
        values: BTreeMap<i128, String>,
        data_type: DataType,
        name: &str,
    ) -> EntryDecl {
        let place = entry.span;
        let (low, high) = data_type.range().unwrap_or_default();
        let names: BTreeSet<&String> = values.values().collect();
        if names.len() < values.len() || values.keys().any(|value| !(low..=high).contains(value)) {
            return entry;
        }
        let default = entry.default.as_ref().and_then(|default| scalar::integer(default.value.text()?).ok());
        let is_enum = entry.min.is_none()
            && entry.max.is_none()
            && entry.unit.is_none()
            && default.is_none_or(|default| values.contains_key(&default));
        if is_enum {
            let values = values.into_iter().map(|(value, name)| {
                let (name, supported) = match name.strip_suffix(" (not supported)") {
                    Some(name) => (name.to_owned(), Some(Spanned::new(false, place))),
                    None => (name, None),
                };
                ValueDecl {
                    value: Spanned::new(value, place),
                    name: Some(made(name, place)),
                    supported,
                    about: None,
                    gap: None,
                    search: None,
                }
            });
            let named = type_decl(data_type, place, Some(values.collect()), None);
            let type_name = Some(made(self.named(named, name), place));
            return EntryDecl { type_name, ..entry };
        }
        special(entry, values, data_type)
    }
}

/// Values with a meaning of their own.
fn special(entry: EntryDecl, values: BTreeMap<i128, String>, data_type: DataType) -> EntryDecl {
    let place = entry.span;
    let (low, high) = data_type.range().unwrap_or_default();
    if values.is_empty() || values.keys().any(|value| !(low..=high).contains(value)) {
        return entry;
    }
    let special = values.into_iter().map(|(value, name)| SpecialDecl {
        value: Spanned::new(value, place),
        name: Some(made(name, place)),
        about: None,
    });
    EntryDecl { special: Some(Spanned::new(special.collect(), place)), ..entry }
}

/// What the comments of one section say.
#[derive(Default)]
struct Comments {
    text: Vec<String>,
    warning: Option<String>,
    unit: Option<StepText>,
    storage: Option<Storage>,
    is_locked: bool,
    condition: Option<Expr>,
    withheld: Option<String>,
    bits: Vec<(BitRange, String)>,
    values: BTreeMap<i128, String>,
}

/// A step of a unit: `0.1 degC`.
struct StepText {
    text: String,
    scale: Ratio,
    /// What the raw value 0 means, where the comment says it.
    offset: Option<Ratio>,
    symbol: String,
}

impl Comments {
    fn line(&mut self, line: String) {
        if let Some(bit) = bit(&line) {
            self.bits.push(bit);
        } else if let Some((value, name)) = named_value(&line) {
            self.values.insert(value, name);
        } else if let Some(warning) = line.strip_prefix("Warning: ") {
            self.warning = Some(warning.trim().to_owned());
        } else if !self.facts(&line) {
            self.text.push(line);
        }
    }

    /// A line of facts; whether it is one.
    fn facts(&mut self, line: &str) -> bool {
        let stored = |fact: &str| {
            let kinds =
                [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent];
            kinds.into_iter().find(|storage| WORDING.storage(*storage) == fact)
        };
        let is_fact = |fact: &str| {
            let prefixes = [
                "unit ",
                "view of ",
                "writable only ",
                "range ",
                "factory default ",
                "default of the standard ",
                "start value ",
            ];
            prefixes.iter().any(|prefix| fact.starts_with(prefix)) || stored(fact).is_some()
        };
        if !line.split("; ").all(is_fact) {
            return false;
        }
        for fact in line.split("; ") {
            let default = ["factory default ", "default of the standard ", "start value "]
                .into_iter()
                .find_map(|prefix| fact.strip_prefix(prefix));
            if let Some(step) = fact.strip_prefix("unit ") {
                self.unit = step_text(step);
            } else if let Some(text) = default {
                self.withheld = Some(text.to_owned());
            } else if let Some(condition) = fact.strip_prefix("writable only while ") {
                self.condition = Expr::parse(condition).ok();
            } else if fact == "writable only when unlocked for service" {
                self.is_locked = true;
            } else {
                self.storage = stored(fact).or(self.storage);
            }
        }
        true
    }

    fn text(&self) -> Option<String> {
        (!self.text.is_empty()).then(|| self.text.join(" "))
    }
}

/// The comments above a section, lines that were broken joined again. What is separated from the header, or is a part
/// of the file that was taken out, is about something else.
fn sentences(part: &Part<'_>) -> Vec<String> {
    let mut sentences: Vec<String> = Vec::new();
    for line in part.comments_at_header() {
        let is_continued = line.starts_with("  ") && !sentences.is_empty();
        let text = line.trim();
        let is_rule = !text.chars().any(char::is_alphanumeric);
        match sentences.last_mut() {
            _ if is_code(text) || is_rule => {}
            Some(sentence) if is_continued => {
                sentence.push(' ');
                sentence.push_str(text);
            }
            _ => sentences.push(text.to_owned()),
        }
    }
    sentences
}

/// `bit 3: ready`, `bits 4..7: mode`.
fn bit(line: &str) -> Option<(BitRange, String)> {
    let (bits, name) = line.split_once(": ")?;
    let (first, last) = match (bits.strip_prefix("bit "), bits.strip_prefix("bits ")) {
        (Some(bit), _) => (bit, bit),
        (None, Some(run)) => run.split_once("..")?,
        (None, None) => return None,
    };
    let (first, last) = (first.parse().ok()?, last.parse().ok()?);
    (first <= last && !name.trim().is_empty()).then(|| (BitRange { first, last }, name.trim().to_owned()))
}

/// `1: on`, `0xFFFF: sensor broken`.
fn named_value(line: &str) -> Option<(i128, String)> {
    let (number, name) = line.split_once(": ")?;
    let is_number = number.bytes().all(|byte| byte.is_ascii_hexdigit() || matches!(byte, b'x' | b'-'));
    let value = lenient_integer(number).filter(|_| is_number)?;
    (!name.trim().is_empty()).then(|| (value, name.trim().to_owned()))
}

/// `0.1 degC`, `ms`, `0.1 degC from -40 degC`.
fn step_text(text: &str) -> Option<StepText> {
    let counted = |text: &str| {
        let (number, symbol) = text.trim().split_once(' ')?;
        Some((scalar::ratio(number)?, symbol.trim().to_owned()))
    };
    let ends = text.rsplit_once(" from ").and_then(|(step, from)| Some((counted(step)?, counted(from)?)));
    let (scale, symbol, offset) = match ends.filter(|((_, symbol), (_, of_offset))| symbol == of_offset) {
        Some(((scale, symbol), (offset, _))) => (scale, symbol, Some(offset)),
        None => {
            let (scale, symbol) = counted(text).unwrap_or_else(|| (Ratio::ONE, text.trim().to_owned()));
            (scale, symbol, None)
        }
    };
    let is_positive = scale.compare(Ratio::ZERO).is_some_and(std::cmp::Ordering::is_gt);
    // Signs that ASCII does not have.
    let symbol = match symbol.as_str() {
        "degC" => "°C",
        "deg" => "°",
        other => other,
    };
    (is_positive && !symbol.is_empty()).then(|| StepText {
        text: text.trim().to_owned(),
        scale,
        offset,
        symbol: symbol.to_owned(),
    })
}

/// An EDS shows a locked entry as read-only. One that shows it otherwise keeps what it shows: tools obey the key, not the comment.
fn locked(entry: EntryDecl, access: Spanned<AccessRight>, place: Span) -> EntryDecl {
    let shown = access.value.access;
    let writable = if shown == Access::Ro { Access::Rw } else { shown };
    let right = AccessRight { access: writable, locked: true };
    let stated = entry.eds.as_ref().map(|eds| &eds.value);
    let eds = EdsDecl {
        default: stated.and_then(|eds| eds.default),
        access: (shown != Access::Ro).then_some(shown),
        // What keeps tools from writing it follows from the lock.
        no_write: false,
        no_scan: stated.is_some_and(|eds| eds.no_scan),
    };
    EntryDecl { access: Some(Spanned::new(right, place)), eds: Some(Spanned::new(eds, place)), ..entry }
}

/// A default that the file does not show to tools.
fn withheld(entry: EntryDecl, text: &str, data_type: DataType, place: Span) -> EntryDecl {
    let stated = entry.eds.as_ref().map(|eds| &eds.value);
    let eds = EdsDecl {
        default: Some(false),
        access: stated.and_then(|eds| eds.access),
        no_write: stated.is_some_and(|eds| eds.no_write),
        no_scan: stated.is_some_and(|eds| eds.no_scan),
    };
    let eds = Some(Spanned::new(eds, place));
    if formula(text).is_some() && data_type.is_integer() {
        return EntryDecl { default: Some(DefaultDecl::one(made(text, place))), eds, ..entry };
    }
    let in_brackets = text.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')'));
    let first = text.split([' ', ':']).next().unwrap_or_default();
    let raw = in_brackets.and_then(lenient_integer).or_else(|| lenient_integer(first));
    let (low, high) = data_type.range().unwrap_or((0, -1));
    let Some(raw) = raw.filter(|raw| (low..=high).contains(raw)) else { return entry };
    EntryDecl { default: Some(DefaultDecl::one(made(raw.to_string(), place))), eds, ..entry }
}

/// A bit field of bits with names; `None` where they are not those of one.
fn bits(mut list: Vec<(BitRange, String)>, data_type: DataType, place: Span) -> Option<TypeDecl> {
    list.arrange_by_key(|(range, _)| range.first);
    let width = data_type.bits()?;
    let apart = list.windows(2).all(|pair| pair[0].0.last < pair[1].0.first);
    let names: BTreeSet<&String> = list.iter().map(|(_, name)| name).collect();
    let fits = list.last().is_some_and(|(range, _)| u16::from(range.last) < width);
    if !apart || !fits || names.len() < list.len() {
        return None;
    }
    let bits = list.into_iter().map(|(range, name)| BitDecl {
        bits: Spanned::new(range, place),
        usage: BitUsage::Used,
        name: Some(made(name, place)),
        about: None,
        gap: None,
        search: None,
        errors: Vec::new(),
        mnemonic: None,
        clamp: None,
        active: None,
        edge: None,
        priority: None,
        values: Vec::new(),
        modes: Vec::new(),
    });
    Some(type_decl(data_type, place, None, Some(bits.collect())))
}

fn type_decl(
    data_type: DataType,
    place: Span,
    values: Option<Vec<ValueDecl>>,
    bits: Option<Vec<BitDecl>>,
) -> TypeDecl {
    // What the comments leave out may have a meaning all the same.
    let rest = bits.as_ref().map(|_| Spanned::new(BitUsage::Unused, place));
    let base = Some(made(data_type.name(), place));
    TypeDecl { unsure: false, name: made("", place), base, about: None, gap: None, values, bits, rest }
}

/// What a type says, without its name: equal types are one.
fn content(named: &TypeDecl) -> String {
    let mut content = named.base.as_ref().map_or(String::new(), |base| base.value.clone());
    let mut add = |first: i128, last: i128, name: Option<&Spanned<String>>, supported: bool| {
        let name = name.map_or("", |name| name.value.as_str());
        let _ = write!(content, "|{first}..{last}:{supported}:{name}");
    };
    for value in named.values.iter().flatten() {
        let number = value.value.value;
        add(number, number, value.name.as_ref(), value.supported.is_none_or(|supported| supported.value));
    }
    for bit in named.bits.iter().flatten() {
        add(bit.bits.value.first.into(), bit.bits.value.last.into(), bit.name.as_ref(), true);
    }
    content
}
