//! Devices, where they take network variables, and what their EDS files say about themselves.

use std::collections::BTreeMap;

use super::lexical;
use super::numbered::{numbered, twice};
use super::read::{Field, FromNode, Reader, owned, reader};
use crate::ast::{
    AnyErrorDecl, ChannelDecl, ChannelNumber, DeviceDecl, FeatureChoice, FileDecl, FileSectionDecl,
    IndexRange, Name, NotesDecl,
};
use crate::diag::{Diagnostics, codes};
use crate::keys::{CHANNELS, any_error_keys, channel_keys, device_keys, file_keys, notes_keys};
use crate::model::{Index, PdoMapping};
use crate::scalar;
use crate::source::Spanned;

device_keys! { reader pub(super) fn device(key: Name) -> DeviceDecl }
file_keys! { reader fn file() -> FileDecl }
any_error_keys! { reader fn any_error() -> AnyErrorDecl }
channel_keys! { reader fn channel(range: Spanned<IndexRange>) -> ChannelDecl }
notes_keys! { reader fn notes(range: Spanned<IndexRange>) -> NotesDecl }

impl FromNode for FeatureChoice {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        if let Some(name) = reader.scalar(|text| Some(text.to_owned())) {
            return Some(Self { name, channels: ChannelNumber::None });
        }
        let (name, number) = reader.pairs().next()?;
        let number = number.scalar(|text| scalar::integer(text).ok());
        let number = number.filter(|number| (1..=CHANNELS).contains(&number.value));
        let channels = number.map_or(ChannelNumber::Refused, ChannelNumber::Stated);
        Some(Self { name: owned(name), channels })
    }
}

impl Field for Option<FileDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|child| file(child, diagnostics))
    }
}

impl Field for Option<AnyErrorDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|child| any_error(child, diagnostics))
    }
}

impl Field for Vec<ChannelDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let ranges = ranges(reader, key, diagnostics);
        ranges.into_iter().map(|(range, r)| channel(range, r, diagnostics)).collect()
    }
}

impl Field for Vec<NotesDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let ranges = ranges(reader, key, diagnostics);
        ranges.into_iter().map(|(range, r)| notes(range, r, diagnostics)).collect()
    }
}

/// A map by runs of indices, each index in one of them.
fn ranges<'a>(
    reader: Reader<'a>,
    key: &str,
    diagnostics: &mut Diagnostics,
) -> Vec<(Spanned<IndexRange>, Reader<'a>)> {
    let mut ranges = Vec::new();
    // The runs by where they begin: they have no index in common.
    let mut before: BTreeMap<Index, (Index, Spanned<&str>)> = BTreeMap::new();
    for (name, r) in reader.entries(key) {
        let Some(range) = lexical::indices(name.value) else { continue };
        let other = before.range(..=range.last).next_back().filter(|(_, (last, _))| range.first <= *last);
        let shared = other.map(|(first, (_, name))| ((*first).max(range.first), *name));
        match shared {
            Some((index, before)) => {
                diagnostics.push(twice(codes::DUPLICATE_INDEX, &index.to_string(), name, before));
            }
            None => {
                before.insert(range.first, (range.last, name));
                ranges.push((Spanned::new(range, name.span), r));
            }
        }
    }
    ranges
}

/// By sub-index.
impl Field for BTreeMap<u8, Spanned<PdoMapping>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let number = |text: &str| u8::try_from(scalar::integer(text).ok()?).ok();
        let show = |sub: u8| format!("sub-index {sub}");
        let subs = numbered(reader.entries(key), number, diagnostics, codes::DUPLICATE_SUB_INDEX, show);
        let word = |(sub, r): (Spanned<u8>, Reader<'_>)| {
            let mapping = r.scalar(PdoMapping::from_word)?;
            Some((sub.value, Spanned::new(mapping.value, sub.span)))
        };
        subs.into_iter().filter_map(word).collect()
    }
}

impl Field for Vec<FileSectionDecl> {
    fn read(reader: Reader<'_>, key: &str, _: &mut Diagnostics) -> Self {
        let text = |(key, r): (Spanned<&str>, Reader<'_>)| {
            Some((owned(key), r.scalar(|text| Some(text.to_owned()))?))
        };
        let section = |(name, r): (Spanned<&str>, Reader<'_>)| FileSectionDecl {
            name: owned(name),
            keys: r.pairs().filter_map(text).collect(),
        };
        reader.entries(key).map(section).collect()
    }
}
