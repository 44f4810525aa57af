//! Figures that are drawn from data: what their names mean.

use super::refs::{Broken, NamesOf};
use super::scope::unknown;
use super::table_content::{Known, bit_fields};
use super::varied::Varied;
use crate::ast::{Name, Spec};
use crate::check::codes as rule_codes;
use crate::decode::lexical;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{Devices, Dictionary, Entry, EntryId, System, Text};
use crate::source::{Span, Spanned};

/// What figures are resolved against.
pub(super) struct Figures<'a, 'n> {
    pub(super) system: &'a System,
    names: &'a NamesOf<'n>,
    broken: &'a Broken,
    varied: Varied<'a>,
    pub(super) bit_fields: Known<'a>,
}

impl<'a, 'n> Figures<'a, 'n> {
    pub(super) fn of(root: &'a Spec, system: &'a System, names: &'a NamesOf<'n>, broken: &'a Broken) -> Self {
        Self { system, names, broken, varied: Varied::of(root), bit_fields: bit_fields(root, system) }
    }

    /// The entry that a reference names, as the first device has it.
    pub(super) fn entry(&self, reference: &Name, diagnostics: &mut Diagnostics) -> Option<(EntryId, &Entry)> {
        let find = |id: EntryId| {
            let objects = self.names.objects(&Devices::All, id.index);
            objects.into_iter().find_map(|object| object.entry(id.sub))
        };
        let by_index = lexical::entry_by_index(&reference.value).map(lexical::NumberedEntry::id);
        let id = match by_index.filter(|id| find(*id).is_some()) {
            Some(id) => id,
            None => self.names.find(&Devices::All, reference, self.broken, diagnostics)?,
        };
        let keys = self.names.each(&Devices::All).map(|(device, _)| device.key.as_str());
        let help = "name an entry that is the same on all devices";
        if self.varied.is_refused(id.index, reference.span, keys, help, diagnostics) {
            return None;
        }
        Some((id, find(id)?))
    }

    /// The entries that references name, if all of them are there.
    pub(super) fn entries(&self, references: &[Name], diagnostics: &mut Diagnostics) -> Option<Vec<EntryId>> {
        let found: Vec<Option<EntryId>> =
            references.iter().map(|reference| self.entry(reference, diagnostics).map(|(id, _)| id)).collect();
        found.into_iter().collect()
    }

    /// Whether a device has all of these entries.
    pub(super) fn have_a_device<'r>(
        &self,
        entries: impl Iterator<Item = (EntryId, &'r Name)>,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let mut having: Vec<&Dictionary> = self.system.devices.iter().collect();
        let mut before: Option<(EntryId, Span)> = None;
        for (id, reference) in entries {
            having.retain(|device| device.entry(id).is_some());
            if having.is_empty() {
                let message = format!("no device has {id} and all entries before it");
                let diagnostic = Diagnostic::new(codes::NO_COMMON_DEVICE, reference.span, message);
                let diagnostic = match before {
                    Some((before, place)) => diagnostic.with(place, format!("{before} is named there")),
                    None => diagnostic,
                };
                diagnostics
                    .push(diagnostic.help("name entries of one device, or draw a picture for each device"));
                return false;
            }
            before = Some((id, reference.span));
        }
        true
    }
}

/// What is named in one picture.
pub(super) struct Named<'a> {
    /// What it is, in a message.
    what: &'static str,
    names: Vec<&'a Spanned<Text>>,
}

impl<'a> Named<'a> {
    /// Names in order; nothing where one is missing, which was reported, or is written twice.
    pub(super) fn of(
        what: &'static str,
        names: impl Iterator<Item = Option<&'a Spanned<Text>>>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let named = Self { what, names: names.collect::<Option<_>>()? };
        let mut is_unique = true;
        for (at, name) in named.names.iter().enumerate() {
            let has_its_name = |before: &&&Spanned<Text>| shares_a_word(&before.value, &name.value);
            if let Some(before) = named.names[..at].iter().find(has_its_name) {
                let message = format!("the {what} `{}` is written twice", named.shown(at));
                diagnostics.push(
                    Diagnostic::new(rule_codes::DUPLICATE_NAME, name.span, message)
                        .label("again here")
                        .with(before.span, "first here")
                        .help("give it a name of its own"),
                );
                is_unique = false;
            }
        }
        is_unique.then_some(named)
    }

    /// The position of what has this name, in whichever language.
    pub(super) fn find(&self, name: &Name, diagnostics: &mut Diagnostics) -> Option<usize> {
        let is_it = |text: &&Spanned<Text>| text.value.iter().any(|(_, text)| text == name.value);
        let found = self.names.iter().position(is_it);
        if found.is_none() {
            let known = self.names.iter().flat_map(|text| text.value.iter().map(|(_, text)| text));
            let help = format!("write the name of a {} of this picture", self.what);
            unknown(codes::LOOSE_PART, name, self.what, known, &help, diagnostics);
        }
        found
    }

    /// A name, for a message.
    pub(super) fn shown(&self, at: usize) -> String {
        shorten(self.names[at].value.iter().next().map_or("", |(_, text)| text))
    }

    /// Where a name is.
    pub(super) fn place(&self, at: usize) -> Span {
        self.names[at].span
    }
}

/// Whether two texts are the same in a language.
fn shares_a_word(one: &Text, other: &Text) -> bool {
    one.iter().any(|(_, text)| other.iter().any(|(_, same)| same == text))
}
