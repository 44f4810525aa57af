//! Devices, where they take network variables, and what their EDS files say about themselves.

use super::lexical;
use super::numbered::twice;
use super::read::{Field, Reader, reader};
use crate::ast::{ChannelDecl, DeviceDecl, FileDecl, IndexRange, Name};
use crate::diag::{Diagnostics, codes};
use crate::keys::{channel_keys, device_keys, file_keys};
use crate::source::Spanned;

device_keys! { reader pub(super) fn device(key: Name) -> DeviceDecl }
file_keys! { reader fn file() -> FileDecl }
channel_keys! { reader fn channel(range: Spanned<IndexRange>) -> ChannelDecl }

impl Field for Option<FileDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|child| file(child, diagnostics))
    }
}

/// Segments of indices, each index in one of them.
impl Field for Vec<ChannelDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let mut channels: Vec<(Spanned<&str>, ChannelDecl)> = Vec::new();
        for (name, r) in reader.entries(key) {
            let Some(range) = lexical::indices(name.value) else { continue };
            let shared = channels.iter().find_map(|(before, other)| {
                let other = other.range.value;
                (other.first <= range.last && range.first <= other.last)
                    .then(|| (other.first.max(range.first), *before))
            });
            match shared {
                Some((index, before)) => {
                    diagnostics.push(twice(codes::DUPLICATE_INDEX, &index.to_string(), name, before));
                }
                None => channels.push((name, channel(Spanned::new(range, name.span), r, diagnostics))),
            }
        }
        channels.into_iter().map(|(_, channel)| channel).collect()
    }
}
