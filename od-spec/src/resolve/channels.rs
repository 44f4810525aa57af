//! How many elements the arrays of a library have in a device that says how many channels it has:
//! `digital inputs 8-bit: 20` are three elements of eight inputs.

use std::collections::{BTreeMap, BTreeSet};

use super::features::Selected;
use crate::ast::{ArrayDecl, ChannelNumber, DeviceDecl, FeatureChoice, FeatureDecl, Name, ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::Index;
use crate::source::{FileId, Spanned};

/// Most elements that an array has.
const MOST_ELEMENTS: i128 = 254;

/// The number of elements of arrays, by library and index.
#[derive(Default)]
pub(super) struct Elements {
    by_object: BTreeMap<(FileId, Index), i128>,
}

impl Elements {
    /// How many elements an array has, where channels say so.
    pub(super) fn of(&self, library: &Spec, index: Index) -> Option<i128> {
        self.by_object.get(&(library.file, index)).copied()
    }
}

/// Who says how many channels a feature has, and how many of them an element holds.
struct Counting<'a> {
    by: &'a FeatureDecl,
    per_element: i128,
}

/// How the elements of a feature are counted; `None` for one without channels.
fn counting<'a>(library: &'a Spec, feature: &'a FeatureDecl) -> Option<Counting<'a>> {
    let by = match &feature.channels_of {
        Some(of) => library.features.iter().find(|one| one.name.value == of.value)?,
        None => feature,
    };
    let per_element = feature.channels.as_ref().or(by.channels.as_ref())?.value;
    Some(Counting { by, per_element })
}

/// The elements that follow from the channels of a device.
pub(super) fn elements(
    selected: &[Selected<'_>],
    device: &DeviceDecl,
    diagnostics: &mut Diagnostics,
) -> Elements {
    let stated = stated(device, diagnostics);
    for Selected { library, feature, name, .. } in selected {
        let counting = counting(library, feature);
        let says_itself = counting.is_some() && feature.channels_of.is_none();
        match stated.get(feature.name.value.as_str()) {
            Some(ChannelNumber::Stated(number)) if !says_itself => {
                diagnostics.push(number_without_effect(feature, number));
            }
            None | Some(ChannelNumber::None) if says_itself => {
                diagnostics.push(number_missing(device, &feature.name.value, name));
            }
            Some(_) | None => {}
        }
        if let Some(Counting { by, per_element }) = counting
            && let Some(ChannelNumber::Stated(channels)) = stated.get(by.name.value.as_str())
            && elements_for(channels.value, per_element) > MOST_ELEMENTS
        {
            diagnostics.push(too_many(channels, per_element));
        }
    }
    of_features(selected, &stated)
}

/// The elements of every feature whose channels are known: an object that is taken singly has as many as with its feature.
fn of_features(selected: &[Selected<'_>], stated: &BTreeMap<&str, ChannelNumber>) -> Elements {
    let mut elements = Elements::default();
    let mut seen: BTreeSet<FileId> = BTreeSet::new();
    for library in selected.iter().map(|one| one.library).filter(|library| seen.insert(library.file)) {
        for feature in &library.features {
            let Some(Counting { by, per_element }) = counting(library, feature) else { continue };
            let Some(ChannelNumber::Stated(channels)) = stated.get(by.name.value.as_str()) else { continue };
            // What is too much was refused.
            let count = elements_for(channels.value, per_element).min(MOST_ELEMENTS);
            for index in &feature.objects {
                elements.by_object.entry((library.file, index.value)).or_insert(count);
            }
        }
    }
    elements
}

/// How many elements hold so many channels.
fn elements_for(channels: i128, per_element: i128) -> i128 {
    (channels - 1) / per_element.max(1) + 1
}

/// What a device says about the channels of features.
fn stated<'d>(device: &'d DeviceDecl, diagnostics: &mut Diagnostics) -> BTreeMap<&'d str, ChannelNumber> {
    let mut stated: BTreeMap<&str, ChannelNumber> = BTreeMap::new();
    for FeatureChoice { name, channels } in device.features.iter().map(|choice| &choice.value) {
        let before = stated.get(name.value.as_str());
        if let (ChannelNumber::Stated(number), Some(ChannelNumber::Stated(before))) = (channels, before)
            && number.value != before.value
        {
            diagnostics.push(
                Diagnostic::new(
                    codes::DUPLICATE_VALUE,
                    number.span,
                    format!("feature `{}` has two numbers of channels", name.value),
                )
                .label("again here")
                .with(before.span, "first here")
                .help("keep one of the two"),
            );
        }
        if matches!(before, None | Some(ChannelNumber::None)) {
            stated.insert(&name.value, *channels);
        }
    }
    stated
}

/// An array of a library with so many elements; what is not an array stays as it is.
pub(super) fn with_elements(decl: &ObjectDecl, count: i128) -> ObjectDecl {
    let array = decl.array.as_ref().map(|array| {
        let count = Some(Spanned::new(count, array.span));
        Box::new(ArrayDecl { count, ..ArrayDecl::clone(array) })
    });
    ObjectDecl { array, ..decl.clone() }
}

/// A feature with channels, the number of which is not stated.
fn number_missing(device: &DeviceDecl, feature: &str, name: &Name) -> Diagnostic {
    // The place of a need is in the library; the device is whose list lacks it.
    let selecting = device.features.iter().find(|choice| choice.value.name.value == feature);
    let (span, message) = match selecting {
        Some(choice) => (choice.span, format!("feature `{feature}` lacks the number of its channels")),
        None => (
            device.key.span,
            format!("`{}` needs the feature `{feature}` with the number of its channels", device.key.value),
        ),
    };
    let diagnostic = Diagnostic::new(codes::MISSING_KEY, span, message)
        .help(format!("write `{feature}: NUMBER` under `features:`, with the number that the device has"));
    if selecting.is_some() { diagnostic } else { diagnostic.with(name.span, "needed here") }
}

/// A number at a feature that counts no channels of its own.
fn number_without_effect(feature: &FeatureDecl, number: &Spanned<i128>) -> Diagnostic {
    let message = format!("feature `{}` is given no number", feature.name.value);
    Diagnostic::new(codes::CONFLICTING_KEYS, number.span, message).help(match &feature.channels_of {
        Some(other) => format!("write the name alone; it has as many channels as `{}`", other.value),
        None => "write the name alone".to_owned(),
    })
}

/// Channels that no array can hold.
fn too_many(channels: &Spanned<i128>, per_element: i128) -> Diagnostic {
    let (number, count) = (channels.value, elements_for(channels.value, per_element));
    let message = format!("{number} channels are {count} elements; an array has at most {MOST_ELEMENTS}");
    Diagnostic::new(codes::NUMBER_OUT_OF_RANGE, channels.span, message)
        .help(format!("write a number from 1 to {}", per_element.saturating_mul(MOST_ELEMENTS)))
}
