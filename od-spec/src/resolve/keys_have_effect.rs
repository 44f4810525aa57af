//! No key is read and then ignored: what stands in a specification has an effect where it stands.

use std::collections::BTreeSet;

use super::scope::unknown;
use crate::ast::{ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::PatternBit;
use crate::source::Span;

/// Checks that a feature which has the channels of another one finds some there.
fn check_channels(library: &Spec, diagnostics: &mut Diagnostics) {
    let counted = library.features.iter().filter(|feature| feature.channels.is_some());
    let counted: BTreeSet<&str> = counted.map(|feature| feature.name.value.as_str()).collect();
    for of in library.features.iter().filter_map(|feature| feature.channels_of.as_ref()) {
        if !counted.contains(of.value.as_str()) {
            let otherwise = "name a feature of this library that has `channels:`";
            unknown(
                codes::UNKNOWN_FEATURE,
                of,
                "feature with channels",
                counted.iter().copied(),
                otherwise,
                diagnostics,
            );
        }
    }
}

/// Checks that what is left out of an object would be there.
pub(super) fn check_omitted(decl: &ObjectDecl, merged: &ObjectDecl, diagnostics: &mut Diagnostics) {
    let elements = merged.array.as_ref().map_or(0, |array| {
        let highest = array.elements.last().map_or(0, |(sub, _)| i128::from(sub.value.0));
        array.count.map_or(0, |count| count.value).max(highest)
    });
    let members = merged.record.iter().flat_map(|record| &record.members);
    let has =
        |sub: i128| sub <= elements || members.clone().any(|(member, _)| i128::from(member.value.0) == sub);
    for sub in decl.omit.iter().filter(|sub| !has(sub.value)) {
        diagnostics.push(
            Diagnostic::new(
                codes::UNKNOWN_ENTRY,
                sub.span,
                format!("{} has no sub-index {} that could be left out", decl.index.value, sub.value),
            )
            .help("remove it from `omit:`, or correct it"),
        );
    }
}

pub(super) fn check(root: &Spec, diagnostics: &mut Diagnostics) {
    // What an object has that is like another one, the other one decides, too.
    for object in root.objects.iter().filter(|object| object.like.is_none()) {
        check_object(object, diagnostics);
    }
    check_channels(root, diagnostics);
    for decl in root.types.iter().filter(|decl| decl.values.is_some()) {
        if let Some(rest) = &decl.rest {
            refuse(
                "rest",
                rest.span,
                "an enum has no bits",
                "remove it; `rest:` belongs to `bits:`",
                diagnostics,
            );
        }
    }
    if let (None, Some(feature)) = (&root.profile, root.features.first()) {
        let help = "add `profile:` to make the file a library, or select features under `devices:`";
        refuse("features", feature.name.span, "only a library offers features", help, diagnostics);
    }
    if let (None, Some(axes)) = (&root.profile, &root.axes) {
        let help = "add `profile:` to make the file a library, or remove it";
        refuse("axes", axes.span, "only a library has axes", help, diagnostics);
    }
    for state in root.machines.iter().flat_map(|machine| &machine.states) {
        let edge = |bit: &PatternBit| matches!(bit, PatternBit::Rising | PatternBit::Falling);
        if let Some(pattern) = state.pattern.as_ref().filter(|pattern| pattern.value.0.iter().any(edge)) {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_NOTATION,
                    pattern.span,
                    "a state is shown by levels, not by edges",
                )
                .help("write `0`, `1` or `x`; `r` and `f` belong to commands"),
            );
        }
    }
}

pub(super) fn check_object(object: &ObjectDecl, diagnostics: &mut Diagnostics) {
    let ObjectDecl { alias, from, like, array, record, sub0, omit, outside, rounding, entry, .. } = object;
    if alias.is_none() {
        for (key, span) in [("outside", outside.map(|o| o.span)), ("rounding", rounding.map(|r| r.span))] {
            if let Some(span) = span {
                refuse(key, span, "the object is no alias", "remove it, or add `alias:`", diagnostics);
            }
        }
    }
    let structured = array.is_some() || record.is_some() || from.is_some();
    if let Some(sub0) = sub0.as_ref().filter(|_| !structured) {
        refuse(
            "sub0",
            sub0.span,
            "a VAR has one entry only",
            "remove it, or add `array:` or `record:`",
            diagnostics,
        );
    }
    if let Some(sub) = omit.first().filter(|_| from.is_none() && like.is_none() && array.is_none()) {
        let help = "leave the sub-index out of `record:` instead";
        refuse("omit", sub.span, "nothing is taken from a library", help, diagnostics);
    }
    if array.is_some() || record.is_some() {
        for key in entry.about_one_value() {
            let help = format!("move `{}` to the entries that it is meant for", key.value);
            refuse(key.value, key.span, "the object has several values", &help, diagnostics);
        }
    }
}

pub(super) fn refuse(key: &str, span: Span, why: &str, help: &str, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Diagnostic::new(codes::CONFLICTING_KEYS, span, format!("`{key}` has no effect here: {why}"))
            .help(help),
    );
}
