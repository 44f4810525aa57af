//! Which features a device has.

use std::collections::BTreeSet;

use super::libraries::{self, Libraries};
use super::scope::unknown_or;
use crate::ast::{DeviceDecl, FeatureDecl, Name, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::library::shipped;
use crate::source::Spanned;

/// A feature that a device has.
pub(super) struct Selected<'a> {
    pub library: &'a Spec,
    pub feature: &'a FeatureDecl,
    pub axis: u16,
    /// Who asks for it.
    pub name: Name,
}

/// The features of a device: those that every device has, those it names, and those they need.
pub(super) fn of_device<'a>(
    libraries: &Libraries<'a>,
    device: &DeviceDecl,
    diagnostics: &mut Diagnostics,
) -> Vec<Selected<'a>> {
    let mut wanted: Vec<Name> = libraries.implied().iter().map(|feature| feature.name.clone()).collect();
    wanted.extend(device.features.iter().map(|choice| choice.value.name.clone()));
    let mut seen: BTreeSet<String> = BTreeSet::new();
    let mut found = Vec::new();
    while let Some(name) = wanted.pop() {
        if !seen.insert(name.value.clone()) {
            continue;
        }
        let on_axis = || {
            let (plain, axis) = axis_of(&name.value)?;
            let (library, feature) = libraries.feature(plain)?;
            library.axes.filter(|axes| axis <= axes.count).map(|_| (library, feature, axis))
        };
        let plain = libraries.feature(&name.value).map(|(library, feature)| (library, feature, 1));
        match plain.or_else(on_axis) {
            Some((library, feature, axis)) => {
                // What a feature of a further axis needs, it needs on that axis.
                let needs = feature.needs.iter().chain(&feature.channels_of);
                wanted.extend(needs.map(|need| match axis {
                    1 => need.clone(),
                    _ => Spanned::new(format!("{} axis {axis}", need.value), need.span),
                }));
                found.push(Selected { library, feature, axis, name });
            }
            None => {
                if let Some(library) = shipped::offering(&name.value) {
                    let message =
                        format!("`{library}` has the feature `{}`, and is not used here", name.value);
                    diagnostics.push(libraries::not_used(codes::UNKNOWN_FEATURE, &name, message, library));
                    continue;
                }
                let otherwise = |diagnostic: Diagnostic| match libraries.features_with(&name.value)[..] {
                    [] if libraries.is_empty() => diagnostic
                        .help("add `uses: [cia301]` to the specification; features come from libraries"),
                    [] => diagnostic.help("`odgen reference` lists the features of the libraries"),
                    [alike] => diagnostic.did_you_mean(alike),
                    ref alike => {
                        let alike: Vec<String> = alike.iter().map(|known| format!("`{known}`")).collect();
                        diagnostic.help(format!("did you mean {}?", alike.join(" or ")))
                    }
                };
                let known = libraries.features();
                unknown_or(codes::UNKNOWN_FEATURE, &name, "feature", known, otherwise, diagnostics);
            }
        }
    }
    found
}

/// `homing mode axis 2` is the feature `homing mode` on axis 2.
fn axis_of(name: &str) -> Option<(&str, u16)> {
    let (plain, axis) = name.rsplit_once(" axis ")?;
    Some((plain, axis.parse().ok().filter(|axis| *axis >= 1)?))
}
