//! `[DynamicChannels]` (CiA 306-3): where a PLC can create network variables.

use std::collections::BTreeMap;

use super::{made, without_place, words};
use crate::ast::{ChannelDecl, IndexRange};
use crate::diag::{Diagnostics, shorten};
use crate::eds::codes;
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Entry, Part, View};
use crate::model::{Access, Index};
use crate::source::Spanned;

/// The first letters of the keys of a segment; its number follows.
const KEYS: [&str; 4] = ["Type", "Dir", "Range", "PPOffset"];

/// The segments in the order of their numbers. What cannot be read is left out, and said.
pub(super) fn read(view: &View<'_>, diagnostics: &mut Diagnostics) -> Vec<ChannelDecl> {
    let supported = view.section(Topic::DeviceInfo).and_then(|info| info.value("DynamicChannelsSupported"));
    let is_supported =
        supported.and_then(|value| lenient_integer(value.value)).is_some_and(|number| number != 0);
    let section = view.section(Topic::DynamicChannels);
    let numbers = section.map(|section| numbers(section, diagnostics)).unwrap_or_default();
    if let (Some(section), Some(_), false) = (section, numbers.first(), is_supported) {
        let message = "the dynamic channels are left out: `DynamicChannelsSupported` is 0".to_owned();
        diagnostics.push(without_place(codes::NO_PLACE, section.place(), message));
        return Vec::new();
    }
    let mut channels: Vec<ChannelDecl> = Vec::new();
    // Where each segment ends, by where it begins: they have no index in common.
    let mut ends: BTreeMap<Index, Index> = BTreeMap::new();
    for (section, number) in
        section.into_iter().flat_map(|section| numbers.iter().map(move |n| (section, *n)))
    {
        let read = channel(section, number, diagnostics).and_then(|channel| match clash(&channel, &ends) {
            Some(why) => Err((channel.range.span, why)),
            None => Ok(channel),
        });
        match read {
            Ok(channel) => {
                ends.insert(channel.range.value.first, channel.range.value.last);
                channels.push(channel);
            }
            Err((place, why)) => {
                let message = format!("segment {number} of the dynamic channels is left out: {why}");
                diagnostics.push(without_place(codes::NO_PLACE, place, message));
            }
        }
    }
    if let (Some(value), true, true, Some(_)) = (supported, is_supported, channels.is_empty(), section) {
        let message = "`DynamicChannelsSupported` is left out: no segment is described".to_owned();
        diagnostics.push(without_place(codes::NO_PLACE, value.span, message));
    }
    channels
}

/// The numbers of the segments that are described, whatever the count says; what no segment has is reported.
fn numbers(section: &Part<'_>, diagnostics: &mut Diagnostics) -> Vec<u32> {
    let mut numbers = Vec::new();
    for entry in section.entries().filter(|entry| !entry.key.value.eq_ignore_ascii_case("NrOfSeg")) {
        match number(&entry) {
            Some(number) => numbers.push(number),
            None if entry.value.value.is_empty() => {}
            None => {
                let message = format!("`{}` of the dynamic channels is left out", shorten(entry.key.value));
                diagnostics.push(without_place(codes::NO_PLACE, entry.key.span, message));
            }
        }
    }
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The number in a key of a segment.
fn number(entry: &Entry<'_>) -> Option<u32> {
    let key = entry.key.value;
    KEYS.iter().find_map(|front| {
        let (word, digits) = key.split_at_checked(front.len())?;
        let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        (word.eq_ignore_ascii_case(front) && is_number).then(|| digits.parse().ok())?
    })
}

/// What is wrong, and where.
type Fault = (crate::source::Span, String);

/// One segment.
fn channel(section: &Part<'_>, number: u32, diagnostics: &mut Diagnostics) -> Result<ChannelDecl, Fault> {
    let value = |front: &str| {
        let key = format!("{front}{number}");
        section.value(&key).ok_or_else(|| (section.place(), format!("there is no `{key}`")))
    };
    let wrong = |text: Spanned<&str>, expected: &str| {
        (text.span, format!("found `{}`, expected {expected}", shorten(text.value)))
    };
    let (range, type_code, direction, offset) =
        (value("Range")?, value("Type")?, value("Dir")?, value("PPOffset")?);
    let indices = indices(range.value).ok_or_else(|| wrong(range, "indices such as 0xA080-0xA0BF"))?;
    let data_type = words::data_type(type_code, diagnostics)
        .ok_or_else(|| wrong(type_code, "the index of a data type"))?;
    let access = words::access(direction, diagnostics).filter(|access| *access != Access::Const);
    let access = access.ok_or_else(|| wrong(direction, "`ro`, `wo`, `rw`, `rwr` or `rww`"))?;
    let (first, difference) = match offset.value.split_once(',') {
        Some((first, second)) => (first, Some(second)),
        None => (offset.value, None),
    };
    let unsigned =
        |text: &str| lenient_integer(text.trim()).filter(|number| (0..=0xFFFF_FFFF).contains(number));
    let read = |text: &str| {
        let number = unsigned(text).ok_or_else(|| wrong(offset, "one or two numbers"))?;
        Ok::<_, Fault>(Spanned::new(number, offset.span))
    };
    Ok(ChannelDecl {
        range: Spanned::new(indices, range.span),
        type_name: Some(made(data_type.name(), type_code.span)),
        access: Some(Spanned::new(access, direction.span)),
        offset: Some(read(first)?),
        difference: difference.map(read).transpose()?,
    })
}

/// `0xA080-0xA0BF`, or one index.
fn indices(text: &str) -> Option<IndexRange> {
    let index = |text: &str| {
        let number = u16::try_from(lenient_integer(text.trim())?).ok()?;
        (number > 0).then_some(Index(number))
    };
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let (first, last) = (index(first)?, index(last)?);
    (first <= last).then_some(IndexRange { first, last })
}

/// The segment that has indices of another one.
fn clash(channel: &ChannelDecl, ends: &BTreeMap<Index, Index>) -> Option<String> {
    let IndexRange { first, last } = channel.range.value;
    let (other_first, other_last) = ends.range(..=last).next_back().filter(|(_, end)| first <= **end)?;
    Some(format!("it has indices of the segment {other_first} to {other_last}"))
}
