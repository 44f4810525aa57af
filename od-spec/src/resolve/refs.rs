//! References to entries, by index or by name.

use std::collections::{BTreeMap, BTreeSet};

use crate::ast::Name;
use crate::decode::{lexical, nearest};
use crate::diag::shorten;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, EntryId, Index, Object, SubIndex};

/// What is defined, but not well enough to be there: a reference to it says nothing new.
#[derive(Debug, Default)]
pub(super) struct Broken {
    indices: BTreeSet<Index>,
    names: BTreeSet<String>,
}

impl Broken {
    pub(super) fn add(&mut self, index: Index, name: Option<&Name>) {
        self.indices.insert(index);
        self.names.extend(name.map(|name| name.value.clone()));
    }

    pub(super) fn append(&mut self, more: Broken) {
        self.indices.extend(more.indices);
        self.names.extend(more.names);
    }

    pub(super) fn has(&self, index: Index) -> bool {
        self.indices.contains(&index)
    }

    /// Whether a name is that of a broken object, or of an entry in one.
    fn has_name(&self, name: &str) -> bool {
        let of = |object: &String| {
            name.strip_prefix(object.as_str()).is_some_and(|r| r.is_empty() || r.starts_with('.'))
        };
        self.names.iter().any(of)
    }
}

/// Entries of one device by name: `controlword`, `drive data.error mask`.
pub(super) struct Names {
    by_name: BTreeMap<String, EntryId>,
}

impl Names {
    pub(super) fn new<'a>(objects: impl IntoIterator<Item = &'a Object>) -> Self {
        let mut by_name = BTreeMap::new();
        for object in objects {
            let id = |sub| EntryId { index: object.index, sub };
            by_name.entry(object.name.clone()).or_insert(id(SubIndex(0)));
            if object.is_structured() {
                for entry in &object.entries {
                    by_name.entry(format!("{}.{}", object.name, entry.name)).or_insert(id(entry.sub));
                }
            }
        }
        Self { by_name }
    }

    /// The entry that a reference names; what is broken is not reported as missing.
    pub(super) fn find(
        &self,
        reference: &Name,
        exists: impl Fn(EntryId) -> bool,
        broken: &Broken,
        diagnostics: &mut Diagnostics,
    ) -> Option<EntryId> {
        let text = reference.value.as_str();
        if lexical::looks_like_index(text) {
            let id = lexical::entry_by_index(text)?.id();
            if exists(id) {
                return Some(id);
            }
            if !broken.has(id.index) {
                diagnostics.push(
                    Diagnostic::new(codes::UNKNOWN_ENTRY, reference.span, format!("there is no entry {id}"))
                        .help("correct the index or sub-index, or define the object on this device"),
                );
            }
            return None;
        }
        let found = self.by_name.get(text).copied();
        if found.is_none() && !broken.has_name(text) {
            let message = format!("there is no entry named `{}`", shorten(text));
            let diagnostic = Diagnostic::new(codes::UNKNOWN_ENTRY, reference.span, message);
            diagnostics.push(match nearest(text, self.by_name.keys().map(String::as_str)) {
                Some(name) => diagnostic.help(format!("did you mean `{name}`?")),
                None => diagnostic.help("write an object's name, `object.entry` for a member, or an index"),
            });
        }
        found
    }
}

/// Finds an entry of a complete dictionary by the text of a reference: `607A`, `0x607Ah`, `30FA.3` (index in hexadecimal)
/// or a name. `Err` holds the nearest name, if there is one.
pub(crate) fn lookup(dictionary: &Dictionary, text: &str) -> Result<EntryId, Option<String>> {
    if let Some(id) = hex_reference(text).filter(|id| dictionary.entry(*id).is_some()) {
        return Ok(id);
    }
    let names = Names::new(dictionary.objects.values());
    if let Some(id) = names.by_name.get(text) {
        return Ok(*id);
    }
    // A person at a command line does not care for capitals, as long as it is clear what is meant.
    let mut alike = names.by_name.iter().filter(|(name, _)| name.to_lowercase() == text.to_lowercase());
    match (alike.next(), alike.next()) {
        (Some((_, id)), None) => Ok(*id),
        _ => Err(nearest(text, names.by_name.keys().map(String::as_str)).map(ToOwned::to_owned)),
    }
}

/// `607A`, `0x607A`, `607Ah`, with `.3`; the index is always hexadecimal.
fn hex_reference(text: &str) -> Option<EntryId> {
    let (object, sub) = match text.split_once('.') {
        Some((object, sub)) => (object, crate::scalar::integer(sub).ok()?),
        None => (text, 0),
    };
    let digits = object.strip_prefix("0x").or_else(|| object.strip_prefix("0X")).unwrap_or(object);
    let digits = digits.strip_suffix(['h', 'H']).unwrap_or(digits);
    let hex = (1..=4).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let index = u16::from_str_radix(digits, 16).ok().filter(|_| hex)?;
    Some(EntryId { index: Index(index), sub: SubIndex(u8::try_from(sub).ok()?) })
}
