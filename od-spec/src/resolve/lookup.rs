//! The entries that settings name, by index or by name, in a complete dictionary.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use super::refs::{Meant, Names, Namesake, member_called};
use crate::diag::Suggestions;
use crate::model::{Dictionary, EntryId, Index, SubIndex};

/// Finds entries of a complete dictionary by the text of a reference: `607A`, `0x607Ah`, `30FA.3` (index in hexadecimal),
/// `30FAsub3`, `30FA:3` or a name.
pub(crate) struct Lookup<'a> {
    dictionary: &'a Dictionary,
    names: OnceCell<Names<'a>>,
    /// By lower-case name; `None` for one that several have.
    alike: OnceCell<BTreeMap<String, Option<EntryId>>>,
}

impl<'a> Lookup<'a> {
    pub(crate) const fn new(dictionary: &'a Dictionary) -> Self {
        Self { dictionary, names: OnceCell::new(), alike: OnceCell::new() }
    }

    /// The entry.
    pub(crate) fn find(&self, text: &str, suggestions: &mut Suggestions) -> Result<EntryId, NotFound> {
        let by_index = hex_reference(text);
        if let Some(HexReference::Entry(id)) = by_index
            && self.dictionary.entry(id).is_some()
        {
            return Ok(id);
        }
        let names = self.names.get_or_init(|| Names::new(self.dictionary.objects.values()));
        match names.get(text) {
            Meant::One(id) => return Ok(id),
            Meant::Several(found) => {
                let namesakes = found.into_iter().map(|(object, sub)| Namesake::of(text, object, sub));
                return Err(NotFound::Several(namesakes.collect()));
            }
            Meant::Nothing => {}
        }
        if let Some(HexReference::Ambiguous { decimal, hexadecimal }) = by_index {
            return Err(NotFound::Ambiguous { decimal, hexadecimal });
        }
        // At a command line, upper and lower case are the same, as long as it is clear what is meant.
        match self.alike(names).get(&text.to_lowercase()) {
            Some(Some(id)) => Ok(*id),
            _ => Err(NotFound::Unknown {
                nearest: member_called(text, names.all())
                    .or_else(|| suggestions.nearest(text, names.all()))
                    .map(ToOwned::to_owned),
            }),
        }
    }

    /// Whether a text is the index of an object of the dictionary, with a sub-index or without.
    pub(crate) fn is_by_index(&self, text: &str) -> bool {
        let by_index = hex_reference(text);
        matches!(by_index, Some(HexReference::Entry(id)) if self.dictionary.objects.contains_key(&id.index))
    }

    /// The object that a text without a sub-index means.
    pub(crate) fn object(&self, text: &str) -> Option<Index> {
        let is_whole = !text.contains(['.', ':']) && !text.to_ascii_lowercase().contains("sub");
        if is_whole
            && let Some(HexReference::Entry(id)) = hex_reference(text)
            && self.dictionary.objects.contains_key(&id.index)
        {
            return Some(id.index);
        }
        let names = self.names.get_or_init(|| Names::new(self.dictionary.objects.values()));
        let mut named = names.named(text);
        if let Some(object) = named.next() {
            // Which one is meant is not clear where there are more.
            return named.next().is_none().then_some(object.index);
        }
        // As for entries, case does not matter where it is clear what is meant.
        let lower = text.to_lowercase();
        let mut alike = self.dictionary.objects.values().filter(|object| object.name.to_lowercase() == lower);
        let only = alike.next()?;
        alike.next().is_none().then_some(only.index)
    }

    /// The objects of a name that several have, as many as [`ambiguous`] wants; empty for any other.
    pub(crate) fn objects(&self, text: &str) -> Vec<Namesake> {
        let names = self.names.get_or_init(|| Names::new(self.dictionary.objects.values()));
        let named = names.named(text).take(Namesake::LISTED + 1);
        let named: Vec<Namesake> = named.map(|object| Namesake::of(text, object, SubIndex(0))).collect();
        if named.len() > 1 { named } else { Vec::new() }
    }

    fn alike(&self, names: &Names<'a>) -> &BTreeMap<String, Option<EntryId>> {
        self.alike.get_or_init(|| {
            let mut alike: BTreeMap<String, Option<EntryId>> = BTreeMap::new();
            for name in names.all() {
                let id = names.get(name).one();
                alike
                    .entry(name.to_lowercase())
                    .and_modify(|known| *known = known.filter(|known| Some(*known) == id))
                    .or_insert(id);
            }
            alike
        })
    }
}

/// Why [`Lookup`] finds no entry.
pub(crate) enum NotFound {
    /// Nothing has that index or name; the nearest name, if there is one.
    Unknown { nearest: Option<String> },
    /// Several entries have the name.
    Several(Vec<Namesake>),
    /// The sub-index is another number to those who count in hexadecimal.
    Ambiguous { decimal: EntryId, hexadecimal: EntryId },
}

/// What a reference by index says.
#[derive(Clone, Copy)]
enum HexReference {
    Entry(EntryId),
    Ambiguous { decimal: EntryId, hexadecimal: EntryId },
}

/// `607A`, `0x607A`, `607Ah`; the index is always hexadecimal. A sub-index follows as `.3`, a number as the language writes it; as
/// `sub3`, in hexadecimal as in an EDS; or as `:3`, which some tools count in decimal and others in hexadecimal.
fn hex_reference(text: &str) -> Option<HexReference> {
    let text = text.to_ascii_lowercase();
    let entry = |object: &str, sub: u8| {
        let digits = object.strip_prefix("0x").unwrap_or(object);
        let digits = digits.strip_suffix('h').unwrap_or(digits);
        let index = u16::try_from(hexadecimal(digits, 4)?).ok()?;
        Some(EntryId { index: Index(index), sub: SubIndex(sub) })
    };
    let number = |sub: &str| u8::try_from(crate::scalar::integer(sub).ok()?).ok();
    let in_hexadecimal = |sub: &str| u8::try_from(hexadecimal(sub, 2)?).ok();
    if let Some((object, sub)) = text.split_once("sub") {
        return entry(object, in_hexadecimal(sub)?).map(HexReference::Entry);
    }
    if let Some((object, sub)) = text.split_once(':') {
        let digits = sub.strip_prefix("0x").or_else(|| sub.strip_suffix('h'));
        if let Some(digits) = digits {
            return entry(object, in_hexadecimal(digits)?).map(HexReference::Entry);
        }
        let plain = sub.bytes().all(|byte| byte.is_ascii_digit());
        let decimal = plain.then(|| sub.parse().ok()).flatten().and_then(|sub| entry(object, sub));
        let hexadecimal = in_hexadecimal(sub).and_then(|sub| entry(object, sub));
        return match (decimal, hexadecimal) {
            (Some(decimal), Some(hexadecimal)) if decimal != hexadecimal => {
                Some(HexReference::Ambiguous { decimal, hexadecimal })
            }
            (decimal, hexadecimal) => decimal.or(hexadecimal).map(HexReference::Entry),
        };
    }
    let (object, sub) = match text.split_once('.') {
        Some((object, sub)) => (object, number(sub)?),
        None => (text.as_str(), 0),
    };
    entry(object, sub).map(HexReference::Entry)
}

/// Hexadecimal digits and nothing else, so many at most.
fn hexadecimal(digits: &str, most: usize) -> Option<u32> {
    let plain = (1..=most).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    plain.then(|| u32::from_str_radix(digits, 16).ok()).flatten()
}
