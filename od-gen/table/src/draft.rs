//! Facts as a specification with each fact on a line of its own, so that what the compiler says of a line is about a cell.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use od_import::yaml::spelled;
use od_spec::diag::Severity;
use od_spec::model::{EntryId, Fact, Index, ObjectKind, SubIndex};

use crate::columns::with_language;
use crate::facts::{EntryFacts, Facts, ListAt, ListFacts, ListOf, ListRow, ObjectFacts, Texts};
use crate::settle::{is_text, shape};
use crate::spelling::Language;

/// What a line is about.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum About {
    /// The file as a whole.
    File,
    /// A fact about the device.
    Device(String),
    /// A unit, and a key of it.
    Unit(usize, Option<&'static str>),
    /// A list, and a row of it.
    List(usize, Option<usize>),
    /// An object.
    Object(u16),
    /// An entry: of a structured object one of its sub-indices.
    Entry(u16, Option<u8>),
    /// A fact about an entry.
    Fact(u16, Option<u8>, Fact),
    /// An error code.
    Error(u16),
}

/// A specification in lines.
#[derive(Debug, Default)]
pub(crate) struct Draft {
    pub text: String,
    /// The code of the first language.
    language: String,
    /// What each line is about.
    pub lines: Vec<About>,
}

/// The objects that every device has; those that the tables lack are the library's.
pub(crate) const MANDATORY: [u16; 3] = [0x1000, 0x1001, 0x1018];

/// The key of the device.
const DEVICE: &str = "device";

impl Draft {
    /// The specification of what tables say, called `title` where they do not say how.
    pub(crate) fn of(facts: &Facts, title: &str) -> Self {
        let mut draft = Self::default();
        draft.header(facts, title);
        draft.units(facts);
        let names = list_names(facts);
        draft.lists(facts, &names);
        draft.errors(facts);
        draft.line(0, "objects:", &About::File);
        for (index, object) in &facts.objects {
            draft.object(*index, object, &names);
        }
        draft
    }

    fn line(&mut self, depth: usize, text: &str, about: &About) {
        self.text.push_str(&"  ".repeat(depth));
        self.text.push_str(text);
        self.text.push('\n');
        self.lines.push(about.clone());
    }

    fn header(&mut self, facts: &Facts, title: &str) {
        let stated = |key: &str| facts.device.get(key).map(|cell| cell.value.as_str());
        let of_file = About::File;
        self.line(0, "od-spec: 1", &of_file);
        let title = stated("title").unwrap_or(title);
        self.line(0, &format!("title: {}", spelled(title)), &of_file);
        let language = match facts.language() {
            Language::English => "[en]",
            Language::German => "[de]",
        };
        let languages = stated("languages").unwrap_or(language);
        let first = languages.trim_matches(['[', ']']).split(',').next().unwrap_or_default();
        first.trim().clone_into(&mut self.language);
        self.line(0, &format!("languages: {languages}"), &About::Device("languages".to_owned()));
        if let (name, Some(number)) =
            (stated("vendor name"), stated("vendor number").or(stated("vendor name").map(|_| "0")))
        {
            let about = About::Device("vendor number".to_owned());
            let name = spelled(name.unwrap_or("unknown"));
            self.line(0, &format!("vendor: {{name: {name}, number: {number}}}"), &about);
        }
        if MANDATORY.iter().any(|index| !facts.objects.contains_key(index)) {
            self.line(0, "uses: [cia301]", &of_file);
        }
        // Which rules the device breaks is found when the specification is written.
        self.line(0, "allow:", &of_file);
        let codes = od_spec::all_codes();
        let rules =
            codes.iter().filter(|code| code.severity == Severity::Error && od_spec::can_be_allowed(code));
        for rule in rules {
            self.line(1, &format!("{}: {}", rule.id, spelled(rule.title)), &of_file);
        }
        self.line(0, "devices:", &of_file);
        self.line(1, &format!("{}:", stated("key").unwrap_or(DEVICE)), &About::Device("key".to_owned()));
        self.line(
            2,
            &format!("name: {}", spelled(stated("name").unwrap_or(title))),
            &About::Device("name".to_owned()),
        );
        let of_about = facts.device.iter().filter_map(|(key, cell)| {
            let (key, language) = with_language(key);
            (key == "about").then(|| (language.map(str::to_owned), cell.clone()))
        });
        self.texts(2, "about", &of_about.collect(), &About::Device("about".to_owned()));
        for (key, cell) in &facts.device {
            let Some(kind) = device_key(key) else { continue };
            let value = match kind {
                DeviceKey::Text => spelled(&cell.value),
                DeviceKey::Plain => cell.value.clone(),
                DeviceKey::List => format!("[{}]", cell.value),
                DeviceKey::Elsewhere => continue,
            };
            self.line(2, &format!("{key}: {value}"), &About::Device(key.clone()));
        }
    }

    fn units(&mut self, facts: &Facts) {
        if facts.units.is_empty() {
            return;
        }
        self.line(0, "units:", &About::File);
        for (at, unit) in facts.units.iter().enumerate() {
            let about = About::Unit(at, None);
            self.line(1, &format!("{}:", spelled(&unit.name.value)), &about);
            for (key, value) in &unit.keys {
                let value = match *key {
                    "symbol" => spelled(&value.value),
                    _ => value.value.clone(),
                };
                self.line(2, &format!("{key}: {value}"), &About::Unit(at, Some(key)));
            }
            self.texts(2, "about", &unit.about, &about);
        }
    }

    fn lists(&mut self, facts: &Facts, names: &BTreeMap<ListOf, String>) {
        let lists = facts
            .lists
            .iter()
            .enumerate()
            .filter(|(_, list)| names.contains_key(&list.of) && list.base.is_some());
        let lists: Vec<(usize, &ListFacts)> = lists.collect();
        if lists.is_empty() {
            return;
        }
        self.line(0, "types:", &About::File);
        for (at, list) in lists {
            let (Some(name), Some(base)) = (names.get(&list.of), &list.base) else { continue };
            let about = About::List(at, None);
            self.line(1, &format!("{}:", spelled(name)), &about);
            self.line(2, &format!("base: {}", base.value.name()), &about);
            self.texts(2, "about", &list.about, &about);
            self.line(2, if list.is_bits() { "bits:" } else { "values:" }, &about);
            for (row_at, row) in list.rows.iter().enumerate() {
                let about = About::List(at, Some(row_at));
                match &row.at {
                    ListAt::Value(value) => self.list_row(3, &value.to_string(), row, &[], &about),
                    ListAt::Bits(bits) => {
                        let values = list.rows.iter().enumerate().filter_map(|(row_at, row)| match &row.at {
                            ListAt::ValueOfBits(of, value) if of == bits => {
                                Some((About::List(at, Some(row_at)), *value, row))
                            }
                            _ => None,
                        });
                        let values: Vec<(About, i128, &ListRow)> = values.collect();
                        self.list_row(3, &key_of_bits(bits), row, &values, &about);
                    }
                    ListAt::ValueOfBits(..) => {}
                }
            }
            if list.is_bits() && !covers(list) {
                self.line(2, "rest: reserved", &about);
            }
        }
    }

    /// A value or a field of bits, with the values of the field.
    fn list_row(
        &mut self,
        depth: usize,
        key: &str,
        row: &ListRow,
        values: &[(About, i128, &ListRow)],
        about: &About,
    ) {
        let name = row.name.as_ref().map_or("", |name| name.value.as_str());
        let is_bare = values.is_empty() && row.errors.is_none() && row.about.is_empty();
        let without_use = matches!(row.at, ListAt::Bits(_)).then(|| without_use(name)).flatten();
        if let Some(word) = without_use.filter(|_| is_bare) {
            return self.line(depth, &format!("{key}: {word}"), about);
        }
        self.line(depth, &format!("{key}:"), about);
        match without_use {
            Some(word) => self.line(depth + 1, &format!("{word}: yes"), about),
            None => self.line(depth + 1, &format!("name: {}", spelled(name)), about),
        }
        if !row.supported {
            self.line(depth + 1, "supported: no", about);
        }
        if let Some(errors) = &row.errors {
            self.line(depth + 1, &format!("error: [{}]", hexadecimal_list(&errors.value)), about);
        }
        self.texts(depth + 1, "about", &row.about, about);
        if !values.is_empty() {
            self.line(depth + 1, "values:", about);
        }
        for (about, value, row) in values {
            self.list_row(depth + 2, &value.to_string(), row, &[], about);
        }
    }

    fn errors(&mut self, facts: &Facts) {
        if facts.errors.is_empty() {
            return;
        }
        self.line(0, "errors:", &About::File);
        for (code, error) in &facts.errors {
            let about = About::Error(*code);
            self.line(1, &format!("0x{code:04X}:"), &about);
            for (key, value) in &error.keys {
                let value = match *key {
                    "register" => format!("[{}]", value.value),
                    _ => spelled(&value.value),
                };
                self.line(2, &format!("{key}: {value}"), &about);
            }
            for (key, texts) in &error.texts {
                self.texts(2, key, texts, &about);
            }
        }
    }

    fn object(&mut self, index: u16, object: &ObjectFacts, names: &BTreeMap<ListOf, String>) {
        let about = About::Object(index);
        self.line(1, &format!("0x{index:04X}:"), &about);
        let kind = shape(object);
        if !matches!(kind, ObjectKind::Array | ObjectKind::Record) {
            return self.entry(2, (index, None), &object.own, names);
        }
        self.entry(2, (index, None), &object.own, names);
        if let Some(count) = object.subs.get(&0) {
            self.line(2, "sub0:", &About::Entry(index, Some(0)));
            self.entry(3, (index, Some(0)), count, names);
        }
        let members = object.subs.iter().filter(|(sub, _)| **sub != 0);
        let depth = if kind == ObjectKind::Array {
            let highest = object.subs.keys().next_back().copied().unwrap_or(0);
            let gaps: Vec<String> = (1..highest)
                .filter(|sub| !object.subs.contains_key(sub))
                .map(|sub| sub.to_string())
                .collect();
            if !gaps.is_empty() {
                self.line(2, &format!("omit: [{}]", gaps.join(", ")), &about);
            }
            self.line(2, "array:", &about);
            self.line(3, &format!("count: {highest}"), &about);
            self.line(3, "elements:", &about);
            4
        } else {
            self.line(2, "record:", &about);
            3
        };
        for (sub, entry) in members {
            self.line(depth, &format!("{sub}:"), &About::Entry(index, Some(*sub)));
            self.entry(depth + 1, (index, Some(*sub)), entry, names);
        }
    }

    fn entry(
        &mut self,
        depth: usize,
        (index, sub): (u16, Option<u8>),
        entry: &EntryFacts,
        names: &BTreeMap<ListOf, String>,
    ) {
        let about = |fact: Fact| About::Fact(index, sub, fact);
        let list = match &entry.list {
            Some(list) => names.get(&ListOf::Named(list.value.clone())),
            None => names.get(&ListOf::Entry(index, sub)),
        };
        let data_type = entry.data_type.as_ref().map(|one| one.value.name().to_owned());
        if let Some(word) = list.map(|name| spelled(name)).or(data_type).filter(|_| sub != Some(0)) {
            self.line(depth, &format!("type: {word}"), &about(Fact::Type));
        }
        if let Some(access) = &entry.access {
            let locked = if access.value.locked { " locked" } else { "" };
            self.line(
                depth,
                &format!("access: {}{locked}", access.value.access.word()),
                &about(Fact::Access),
            );
        }
        for (fact, cell) in &entry.stated {
            let value = if is_text(*fact) { spelled(&cell.value) } else { cell.value.clone() };
            self.line(depth, &format!("{}: {value}", fact.word()), &about(*fact));
        }
        self.texts(depth, "about", &entry.about, &about(Fact::About));
        self.texts(depth, "warning", &entry.warning, &about(Fact::Warning));
    }

    fn texts(&mut self, depth: usize, key: &str, texts: &Texts, about: &About) {
        let items: Vec<(&Option<String>, String)> =
            texts.iter().map(|(language, text)| (language, spelled(&text.value))).collect();
        match items.as_slice() {
            [] => {}
            [(None, text)] => self.line(depth, &format!("{key}: {text}"), about),
            items => {
                self.line(depth, &format!("{key}:"), about);
                for (language, text) in items {
                    let language = language.as_deref().unwrap_or(&self.language).to_owned();
                    self.line(depth + 1, &format!("{}: {text}", spelled(&language)), about);
                }
            }
        }
    }
}

/// How a fact about the device is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DeviceKey {
    Text,
    Plain,
    List,
    /// It is not among the keys of the device.
    Elsewhere,
}

/// The facts about a device that tables hold, by key.
fn device_key(key: &str) -> Option<DeviceKey> {
    Some(match key {
        "title" | "languages" | "vendor name" | "vendor number" | "key" | "name" => DeviceKey::Elsewhere,
        "product-name" | "order-code" => DeviceKey::Text,
        "product" | "product-revision" | "device-type" | "granularity" | "boot-up-master"
        | "boot-up-slave" | "group-messaging" | "lss" => DeviceKey::Plain,
        "bit-rates" | "dummies" => DeviceKey::List,
        _ if with_language(key).0 == "about" => DeviceKey::Elsewhere,
        _ => return None,
    })
}

/// Whether tables may say this about the device.
pub(crate) fn is_device_key(key: &str) -> bool {
    device_key(key).is_some()
}

/// Whether the rows of a list describe every bit of its base.
pub(crate) fn covers(list: &ListFacts) -> bool {
    let width = list.base.as_ref().and_then(|base| base.value.bits()).unwrap_or(0);
    let covered = list.rows.iter().fold(0_u64, |covered, row| match &row.at {
        ListAt::Bits(bits) => bits.clone().filter(|bit| *bit < 64).fold(covered, |all, bit| all | 1 << bit),
        ListAt::Value(_) | ListAt::ValueOfBits(..) => covered,
    });
    u64::from(width) == u64::from(covered.trailing_ones())
}

/// `reserved` or `unused`, if the name of a bit says that it has no use.
fn without_use(name: &str) -> Option<&'static str> {
    match crate::spelling::plain(name).as_str() {
        "reserved" | "reserviert" | "res" => Some("reserved"),
        "unused" | "notused" | "free" | "unbenutzt" | "frei" | "nichtbenutzt" => Some("unused"),
        _ => None,
    }
}

fn key_of_bits(bits: &RangeInclusive<u8>) -> String {
    let (first, last) = (bits.start(), bits.end());
    if first == last { first.to_string() } else { format!("{first}..{last}") }
}

/// Error codes with a mark.
fn hexadecimal_list(text: &str) -> String {
    let codes = text.split([',', ';']).map(str::trim).map(|code| {
        crate::spelling::marked_hex(code).map_or_else(|| format!("0x{code}"), |code| format!("0x{code:04X}"))
    });
    codes.collect::<Vec<_>>().join(", ")
}

/// The names of the types of lists: their own, or that of the entry.
fn list_names(facts: &Facts) -> BTreeMap<ListOf, String> {
    let mut names: BTreeMap<ListOf, String> = BTreeMap::new();
    for list in &facts.lists {
        let wanted = match &list.of {
            ListOf::Named(name) => name.clone(),
            ListOf::Entry(index, sub) => {
                let Some(object) = facts.objects.get(index) else { continue };
                let name = |entry: &EntryFacts| entry.get(Fact::Name).map(|name| name.value.clone());
                let of_object = name(&object.own).unwrap_or_else(|| format!("object {index:04X}"));
                match sub.and_then(|sub| object.subs.get(&sub)).and_then(name) {
                    Some(of_entry) => format!("{of_object} {of_entry}"),
                    None => of_object,
                }
            }
        };
        let numbered = (2..1000).map(|number| format!("{wanted} {number}"));
        let is_free = |name: &String| {
            !names.values().any(|one| one == name) && od_spec::model::DataType::from_name(name).is_none()
        };
        let free = std::iter::once(wanted.clone()).chain(numbered).find(is_free);
        names.extend(free.map(|name| (list.of.clone(), name)));
    }
    names
}

/// The id of an entry in the model.
pub(crate) fn entry_id(index: u16, sub: Option<u8>) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub.unwrap_or(0)) }
}
