//! A device with dynamic channels describes them.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS216",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "dynamic channels that are not described, or not there",
    explanation: "`DynamicChannelsSupported` other than 0 says that a PLC can create network variables in the device, and \
        `[DynamicChannels]` states where. One without the other leaves the tool of the PLC without what it needs. What is \
        created in this way is not described as an object.",
    clause: Some("CiA 306 4.5 and 4.6.3.4.3"),
    example: Some(Example::eds(
        "[DeviceInfo]\nDynamicChannelsSupported=1\n; ...",
        "[DeviceInfo]\nDynamicChannelsSupported=0\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    const KEY: &str = "DynamicChannelsSupported";
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    let is_supported = match part.value(KEY) {
        None => Some(false),
        Some(value) => lenient_integer(value.value).map(|number| number != 0),
    };
    let channels = view.section(Topic::DynamicChannels);
    match (is_supported, channels) {
        (Some(true), None) => {
            let place = part.value(KEY).map_or(part.place(), |value| value.span);
            diagnostics.push(
                Diagnostic::new(
                    CODE,
                    place,
                    format!("`{KEY}` is set, but there is no section `[DynamicChannels]`"),
                )
                .help("add the section, or set the key to 0"),
            );
        }
        (Some(false), Some(channels)) => diagnostics.push(
            Diagnostic::new(CODE, channels.place(), format!("there are dynamic channels, but `{KEY}` is 0"))
                .help("set the key to 1, or remove the section"),
        ),
        (None, _) | (Some(true), Some(_)) | (Some(false), None) => {}
    }
}
