//! Devices, where they take network variables, and what their EDS files say about themselves.

use std::collections::BTreeMap;

use super::lexical;
use super::numbered::twice;
use super::read::{Field, FromNode, Reader, owned, reader};
use crate::ast::{
    AnyErrorDecl, ChannelDecl, ChannelNumber, DeviceDecl, FeatureChoice, FileDecl, IndexRange, Name,
};
use crate::diag::{Diagnostics, codes};
use crate::keys::{CHANNELS, any_error_keys, channel_keys, device_keys, file_keys};
use crate::model::Index;
use crate::scalar;
use crate::source::Spanned;

device_keys! { reader pub(super) fn device(key: Name) -> DeviceDecl }
file_keys! { reader fn file() -> FileDecl }
any_error_keys! { reader fn any_error() -> AnyErrorDecl }
channel_keys! { reader fn channel(range: Spanned<IndexRange>) -> ChannelDecl }

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

/// Segments of indices, each index in one of them.
impl Field for Vec<ChannelDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let mut channels: Vec<ChannelDecl> = Vec::new();
        // The segments by where they begin: they have no index in common.
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
                    channels.push(channel(Spanned::new(range, name.span), r, diagnostics));
                }
            }
        }
        channels
    }
}
