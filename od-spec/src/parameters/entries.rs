//! The entries of a device, as settings name them.

use crate::ast::Name;
use crate::ast::Reference;
use crate::diag::{Diagnostic, Suggestions, codes, shorten};
use crate::model::{Dictionary, Entry, EntryId, Index, Object, SubIndex};
use crate::resolve::{self, Namesake, NotFound};
use crate::scalar;

/// The entries of a device.
pub(super) struct Entries<'a> {
    device: &'a Dictionary,
    lookup: resolve::Lookup<'a>,
}

type Found<'a> = Result<(EntryId, &'a Entry), Box<Diagnostic>>;

impl<'a> Entries<'a> {
    pub(super) const fn of(device: &'a Dictionary) -> Self {
        Self { device, lookup: resolve::Lookup::new(device) }
    }

    /// Looks names and indices up.
    pub(super) const fn lookup(&self) -> &resolve::Lookup<'a> {
        &self.lookup
    }

    /// The entry that a setting names.
    pub(super) fn find(&self, reference: &Reference, suggestions: &mut Suggestions) -> Found<'a> {
        match reference {
            Reference::Whole(name) => self.whole(name, suggestions),
            Reference::Member { object, entry } => {
                let found = self.object(object, suggestions)?;
                member(found, entry, suggestions)
            }
        }
    }

    /// The entry that one text names.
    pub(super) fn whole(&self, name: &Name, suggestions: &mut Suggestions) -> Found<'a> {
        let device = self.device;
        let text = name.value.as_str();
        let id = self.lookup.find(text, suggestions).map_err(|why| match why {
            NotFound::Unknown { nearest } => {
                let otherwise =
                    "write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`";
                let message = format!("`{}` has no entry `{}`", device.key, shorten(text));
                unknown(name, message, nearest.as_deref(), || otherwise.to_owned())
            }
            NotFound::Several(namesakes) => Box::new(resolve::ambiguous(text, &namesakes, name.span)),
            NotFound::Ambiguous { decimal, hexadecimal } => ambiguous(name, decimal, hexadecimal),
        })?;
        let Some(entry) = device.entry(id) else {
            return Err(unknown(name, format!("there is no entry {id}"), None, || "correct it".to_owned()));
        };
        let is_whole = id.sub == SubIndex(0) && self.lookup.object(text) == Some(id.index);
        match device.objects.get(&id.index).filter(|object| is_whole && object.is_structured()) {
            Some(object) if !entry.access.is_writable() => Err(without_sub_index(name, object)),
            Some(_) | None => Ok((id, entry)),
        }
    }

    /// The object that a text names.
    fn object(&self, name: &Name, suggestions: &mut Suggestions) -> Result<&'a Object, Box<Diagnostic>> {
        let text = name.value.as_str();
        let found = self.lookup.object(text).and_then(|index| self.device.objects.get(&index));
        found.ok_or_else(|| {
            let namesakes = self.lookup.objects(text);
            if !namesakes.is_empty() {
                return Box::new(resolve::ambiguous(text, &namesakes, name.span));
            }
            let names = self.device.objects.values().map(|object| object.name.as_str());
            let otherwise = || "write an index in hexadecimal (`607D`), or an object's name".to_owned();
            let message = format!("`{}` has no object `{}`", self.device.key, shorten(text));
            unknown(name, message, suggestions.nearest(text, names), otherwise)
        })
    }
}

/// An entry of an object, by sub-index or name.
fn member<'a>(object: &'a Object, name: &Name, suggestions: &mut Suggestions) -> Found<'a> {
    let text = name.value.as_str();
    let id = |sub: SubIndex| EntryId { index: object.index, sub };
    let named: Vec<&Entry> =
        object.entries.iter().filter(|entry| object.is_structured() && entry.is_called(text)).collect();
    let alike = || {
        let mut alike =
            object.entries.iter().filter(|entry| entry.name.to_lowercase() == text.to_lowercase());
        alike.next().filter(|_| object.is_structured() && alike.next().is_none())
    };
    let numbered = || {
        let sub = u8::try_from(scalar::integer(text).ok()?).ok()?;
        object.entry(SubIndex(sub))
    };
    if let (None, [_, _, ..]) = (numbered(), named.as_slice()) {
        let namesake = |entry: &&Entry| {
            let way = Some(entry.label()).filter(|label| *label != text);
            let number = id(entry.sub).to_string();
            Namesake { number, way: way.map_or_else(|| entry.sub.to_string(), ToOwned::to_owned) }
        };
        let namesakes: Vec<Namesake> = named.iter().map(namesake).collect();
        return Err(Box::new(resolve::ambiguous(text, &namesakes, name.span)));
    }
    if let Some(entry) = numbered().or_else(|| named.first().copied()).or_else(alike) {
        return Ok((id(entry.sub), entry));
    }
    let message = format!("{} ({}) has no entry `{}`", object.index, object.name, shorten(text));
    if !object.is_structured() {
        let help = || format!("it has one value: write `{}: VALUE`", shorten(&object.name));
        return Err(unknown(name, message, None, help));
    }
    let names = object.counted().map(|entry| entry.name.as_str());
    let otherwise = || format!("write a sub-index, 1 to {}, or the name of an entry", object.highest());
    Err(unknown(name, message, suggestions.nearest(text, names), otherwise))
}

fn unknown(
    name: &Name,
    message: String,
    word: Option<&str>,
    otherwise: impl FnOnce() -> String,
) -> Box<Diagnostic> {
    let diagnostic = Diagnostic::new(codes::UNKNOWN_ENTRY, name.span, message);
    Box::new(diagnostic.did_you_mean_or(word, otherwise))
}

fn ambiguous(name: &Name, decimal: EntryId, hexadecimal: EntryId) -> Box<Diagnostic> {
    let message = format!(
        "sub-index {0} is {0} in decimal and {1} in hexadecimal, and after a colon both are usual",
        decimal.sub, hexadecimal.sub
    );
    let Index(index) = decimal.index;
    let help = format!(
        "write `{index:04X}.{0}` for sub-index {0}, or `{index:04X}.{1}` for sub-index {1}",
        decimal.sub, hexadecimal.sub
    );
    Box::new(Diagnostic::new(codes::BAD_ASSIGNMENT, name.span, message).help(help))
}

/// The number of its entries cannot be written: one of them is meant.
fn without_sub_index(name: &Name, object: &Object) -> Box<Diagnostic> {
    let message =
        format!("{} ({}) has several entries, and none of them is named", object.index, object.name);
    let Index(index) = object.index;
    let example =
        object.counted().find(|entry| entry.access.is_writable()).or_else(|| object.counted().next());
    let example = example.map_or(1, |entry| entry.sub.0);
    let last = object.highest();
    Box::new(
        Diagnostic::new(codes::BAD_ASSIGNMENT, name.span, message)
            .help(format!("add a sub-index, 1 to {last}, or the name of an entry: `{index:04X}.{example}`")),
    )
}
