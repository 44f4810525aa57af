//! What a PLC creates in the dynamic channels is not described as an object.

use std::ops::RangeInclusive;

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Part, View};
use crate::model::Index;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS220",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object where a PLC creates its own",
    explanation: "A segment of `[DynamicChannels]` is a range of indices that is empty until the program of a PLC creates network \
        variables in it. An object that the file describes there is not in the device at first, or is in the way of what \
        is created. Remove the object, or correct the range.",
    clause: Some("CiA 306 4.6.3.4.3"),
    example: Some(Example::eds(
        "[DeviceInfo]\nDynamicChannelsSupported=1\n; ...\n\n[DynamicChannels]\nNrOfSeg=1\nType1=0x0005\nDir1=ro\nRange1=0xA040-0xA07F\nPPOffset1=0\n\n\
         [A040]\nParameterName=network variable\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[DeviceInfo]\nDynamicChannelsSupported=1\n; ...\n\n[DynamicChannels]\nNrOfSeg=1\nType1=0x0005\nDir1=ro\nRange1=0xA040-0xA07F\nPPOffset1=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DynamicChannels) else { return };
    let mut found = Repeated::new();
    for range in segments(part) {
        for (index, object) in view.objects.range(range) {
            let Some(part) = object.object.as_ref().or_else(|| object.subs.values().next()) else { continue };
            found.add(part.place(), [], || {
                let message = format!("{index} is described, but is in a segment of `[DynamicChannels]`");
                Diagnostic::new(CODE, part.place(), message).help(
                    "remove the object, which is created at run time, or correct the range of the segment",
                )
            });
        }
    }
    found.finish("objects", diagnostics);
}

/// The indices of the segments, `Range1=0xA080-0xA0BF` or a single one. Index 0 is not a segment.
fn segments(part: &Part<'_>) -> impl Iterator<Item = RangeInclusive<Index>> {
    let is_range = |key: &str| {
        let digits = key.get(.."Range".len()).filter(|front| front.eq_ignore_ascii_case("Range"));
        digits.is_some_and(|front| key[front.len()..].bytes().all(|byte| byte.is_ascii_digit()))
    };
    let ranges = part.entries().filter(move |entry| is_range(entry.key.value));
    ranges.filter_map(|entry| {
        let index = |text: &str| Some(Index(u16::try_from(lenient_integer(text.trim())?).ok()?));
        let (first, last) = match entry.value.value.split_once('-') {
            Some((first, last)) => (index(first)?, index(last)?),
            None => (index(entry.value.value)?, index(entry.value.value)?),
        };
        // A range that ends before it begins has no indices.
        (Index(0) < first && first <= last).then_some(first..=last)
    })
}
