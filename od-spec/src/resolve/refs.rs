//! References to entries, by index or by name.

use std::collections::BTreeMap;

use crate::ast::Name;
use crate::decode::{lexical, nearest};
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{Dictionary, EntryId, Index, Object, SubIndex};

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

    /// The entry that a reference names; `missing` tells which indices exist only in broken form and stay silent.
    pub(super) fn find(
        &self,
        reference: &Name,
        exists: impl Fn(EntryId) -> bool,
        is_broken: impl Fn(Index) -> bool,
        diagnostics: &mut Diagnostics,
    ) -> Option<EntryId> {
        let text = reference.value.as_str();
        if lexical::looks_like_index(text) {
            let (id, _) = lexical::entry_by_index(text)?;
            if exists(id) {
                return Some(id);
            }
            if !is_broken(id.index) {
                diagnostics.push(
                    Diagnostic::new(Code::UnknownEntry, reference.span, format!("there is no entry {id}"))
                        .help("correct the index or sub-index, or define the object on this device"),
                );
            }
            return None;
        }
        let found = self.by_name.get(text).copied();
        if found.is_none() {
            let diagnostic =
                Diagnostic::new(Code::UnknownEntry, reference.span, format!("there is no entry named `{text}`"));
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
    names.by_name.get(text).copied().filter(|id| dictionary.entry(*id).is_some()).ok_or_else(|| {
        nearest(text, names.by_name.keys().map(String::as_str)).map(ToOwned::to_owned)
    })
}

/// `607A`, `0x607A`, `607Ah`, with `.3` or `sub3`; the index is always hexadecimal.
fn hex_reference(text: &str) -> Option<EntryId> {
    let (object, sub) = match text.split_once('.') {
        Some((object, sub)) => (object, crate::yaml::scalar::integer(sub).ok()?),
        None => (text, 0),
    };
    let digits = object.strip_prefix("0x").or_else(|| object.strip_prefix("0X")).unwrap_or(object);
    let digits = digits.strip_suffix(['h', 'H']).unwrap_or(digits);
    let hex = (1..=4).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let index = u16::from_str_radix(digits, 16).ok().filter(|_| hex)?;
    Some(EntryId { index: Index(index), sub: SubIndex(u8::try_from(sub).ok()?) })
}
