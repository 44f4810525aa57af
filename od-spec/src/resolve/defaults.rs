//! Defaults that are written for several things at once: by device, and for the elements of an array.

use std::borrow::Cow;

use super::consumers;
use super::surroundings::Surroundings;
use crate::ast::{ArrayDecl, DefaultDecl, EntryDecl, Name, ObjectDecl, Spec};
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::source::Spanned;

/// The declaration with the default that the device has.
pub(super) fn of_device<'d>(
    decl: &'d EntryDecl,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Cow<'d, EntryDecl> {
    let Some(Spanned { value: DefaultDecl::ByDevice(values), span }) = &decl.default else {
        return Cow::Borrowed(decl);
    };
    if around.index.is_some_and(|index| consumers::are_meant(index, values)) {
        return Cow::Borrowed(decl);
    }
    let own = around.device.and_then(|device| values.iter().find(|(key, _)| key.value == device));
    // One of its keys was no device, and may have been meant for this one.
    let is_misspelt = || values.iter().any(|(key, _)| diagnostics.was_said(codes::UNKNOWN_DEVICE, key.span));
    if own.is_none() && !is_misspelt() {
        let (message, help) = match around.device {
            Some(device) => (
                format!("this default says nothing for `{device}`"),
                format!("add `{device}:` with its value, or write one value for all devices"),
            ),
            None => (
                "the objects of a library have one default for all devices".to_owned(),
                "write one value; a device says what differs".to_owned(),
            ),
        };
        diagnostics.push(Diagnostic::new(codes::MISSING_KEY, *span, message).help(help));
    }
    Cow::Owned(EntryDecl { default: own.map(|(_, value)| value.clone()), ..decl.clone() })
}

/// The text of a default that is one value.
pub(super) fn one(
    default: Option<&Spanned<DefaultDecl>>,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Name> {
    let default = default?;
    let (message, help) = match &default.value {
        DefaultDecl::One(text) => return Some(Spanned::new(text.clone(), default.span)),
        DefaultDecl::Each(_) => (
            "a list of values is the default of an array, and this is one entry",
            "write one value, or the list under `array:` with a value for each element",
        ),
        DefaultDecl::ByDevice(keys)
            if around.index.is_some_and(|index| consumers::are_meant(index, keys)) =>
        {
            let raw = consumers::raw(keys, default.span, diagnostics)?;
            return Some(Spanned::new(raw.to_string(), default.span));
        }
        DefaultDecl::ByDevice(_) => (
            "devices inside of what is for one device already",
            "write one value for each device, or one list for each",
        ),
    };
    diagnostics.push(Diagnostic::new(codes::BAD_VALUE, default.span, message).help(help));
    None
}

/// Takes the defaults of single elements out of what all elements have in common, in the order of the elements.
pub(super) fn of_elements(
    common: &mut EntryDecl,
    array: &ArrayDecl,
    count: usize,
    diagnostics: &mut Diagnostics,
) -> Vec<Spanned<DefaultDecl>> {
    let Some(Spanned { value: DefaultDecl::Each(values), span }) = &common.default else { return Vec::new() };
    let (values, span) = (values.clone(), *span);
    common.default = None;
    if values.len() != count {
        let several =
            |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let message = format!("{} for {}", several(values.len(), "default"), several(count, "element"));
        let (place, label) = array.count.map_or((array.span, "the array"), |count| (count.span, "the count"));
        diagnostics.push(
            Diagnostic::new(rule_codes::COUNT_MISMATCH, span, message)
                .with(place, label)
                .help("write one value for each element that there is, or one value alone for all of them"),
        );
        return Vec::new();
    }
    values
}

/// Checks that defaults name devices that have the object.
pub(super) fn check_devices(
    root: &Spec,
    mut unknown: impl FnMut(&Name, &mut Diagnostics),
    diagnostics: &mut Diagnostics,
) {
    let is_known = |name: &str| root.devices.iter().any(|device| device.key.value == name);
    for decl in &root.objects {
        let defaults = entries(decl).filter_map(|entry| entry.default.as_ref());
        for values in defaults.filter_map(|default| by_device(&default.value)) {
            let is_consumer = consumers::are_meant(decl.index.value, values);
            for (key, _) in values {
                let has =
                    decl.devices.as_ref().is_none_or(|on| on.iter().any(|device| device.value == key.value));
                match (is_consumer, is_known(&key.value)) {
                    (true, true) => diagnostics.push(two_meanings(key)),
                    (true, false) => {}
                    (false, false) => unknown(key, diagnostics),
                    (false, true) if has => {}
                    (false, true) => {
                        let message = format!("`{}` has no object {}", key.value, decl.index.value);
                        diagnostics.push(
                            Diagnostic::new(codes::CONFLICTING_KEYS, key.span, message)
                                .with(decl.index.span, "an object of other devices")
                                .help("remove it, or name the device where the object says which devices have it"),
                        );
                    }
                }
            }
        }
    }
}

fn two_meanings(key: &Name) -> Diagnostic {
    let message = format!("`{}` is a device, and also a key of a heartbeat consumer", key.value);
    Diagnostic::new(codes::BAD_VALUE, key.span, message)
        .help("write the consumers as a list under `array:`, or the raw value")
}

fn by_device(default: &DefaultDecl) -> Option<&[(Name, Spanned<DefaultDecl>)]> {
    match default {
        DefaultDecl::ByDevice(values) => Some(values),
        DefaultDecl::One(_) | DefaultDecl::Each(_) => None,
    }
}

/// Everything that an object says of entries.
fn entries(decl: &ObjectDecl) -> impl Iterator<Item = &EntryDecl> {
    let array = decl.array.iter().map(|array| &array.entry);
    let elements = decl.array.iter().flat_map(|array| &array.elements);
    let members = decl.record.iter().flat_map(|record| &record.members);
    [&decl.entry]
        .into_iter()
        .chain(decl.sub0.as_deref())
        .chain(array)
        .chain(elements.chain(members).map(|(_, entry)| entry))
}
