//! No key is read and then ignored: what is written in a specification has an effect where it is written.

use std::collections::BTreeSet;

use super::scope::unknown;
use super::surroundings::Surroundings;
use crate::ast::{BitDecl, EntryDecl, ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{BitUsage, Entry, Fact, PatternBit};
use crate::source::{FileId, Span};

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
    for bit in root.types.iter().flat_map(|decl| decl.bits.iter().flatten()) {
        check_bit(bit, diagnostics);
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

/// Checks that bits without meaning have none, and that a level is that of one bit.
fn check_bit(bit: &BitDecl, diagnostics: &mut Diagnostics) {
    let BitDecl { bits, usage, name, errors, active, edge, values, modes, .. } = bit;
    let keys = [
        ("name", name.as_ref().map(|name| name.span)),
        ("error", errors.first().map(|code| code.span)),
        ("active", active.map(|active| active.span)),
        ("edge", edge.map(|_| bits.span)),
        ("values", values.first().map(|value| value.value.span)),
        ("modes", modes.first().map(|mode| mode.mode.span)),
    ];
    let why = match usage {
        BitUsage::Reserved => "a reserved bit means nothing",
        BitUsage::Unused => "an unused bit means nothing",
        BitUsage::Used => {
            if let Some(active) = active.filter(|_| bits.value.first != bits.value.last) {
                let help = "remove it, or list the bits one by one";
                refuse("active", active.span, "several bits have no one level", help, diagnostics);
            }
            return;
        }
    };
    // The first one is enough.
    if let Some((key, span)) = keys.into_iter().find_map(|(key, span)| Some((key, span?))) {
        let help = "remove it, or the mark that the bit has no meaning";
        refuse(key, span, why, help, diagnostics);
    }
}

pub(super) fn check_object(object: &ObjectDecl, diagnostics: &mut Diagnostics) {
    let ObjectDecl { alias, from, like, array, record, sub0, omit, outside, rounding, entry, .. } = object;
    if alias.is_none() {
        for (key, span) in [("outside", outside.map(|o| o.span)), ("rounding", rounding.map(|r| r.span))] {
            if let Some(span) = span {
                refuse(key, span, "the object is not an alias", "remove it, or add `alias:`", diagnostics);
            }
        }
    }
    let structured = array.is_some() || record.is_some() || from.is_some();
    if let Some(sub0) = sub0.as_ref().filter(|_| !structured) {
        refuse_sub0(sub0, diagnostics);
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

/// A VAR with something about a number of entries.
pub(super) fn refuse_sub0(sub0: &EntryDecl, diagnostics: &mut Diagnostics) {
    let help = "remove it, or add `array:` or `record:`";
    refuse("sub0", sub0.span, "a VAR has one entry only", help, diagnostics);
}

/// Checks that what the maker says of all entries of an object is taken by one of them.
pub(super) fn check_taken(
    decl: &ObjectDecl,
    entries: &[Entry],
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) {
    let of_object = decl.entry.inherited();
    let of_array = decl.array.as_ref().map(|array| &array.entry);
    for common in [Some(&of_object), of_array].into_iter().flatten().filter(|common| !common.unsure) {
        for (key, fact) in common.stated() {
            // What a library has is not reported, nor what the object has that this one is like.
            let is_makers =
                key.span.file.is_one_with(around.file) && decl.like.is_none_or(|like| like.span != key.span);
            let is_taken =
                |entry: &Entry| entry.facts.get(fact).is_some_and(|stated| key.span.contains(stated.span));
            // The name is that of elements which others may have that are like this one; a default may be that of other devices.
            let may_be_left = fact == Fact::Name || fact == Fact::Default && !common.is_for(around.device);
            if is_makers
                && !may_be_left
                && !entries.iter().any(is_taken)
                && diagnostics.is_new(codes::CONFLICTING_KEYS, key.span)
            {
                let help = format!("write `{}` at the entries that it is meant for, or remove it", key.value);
                refuse(key.value, key.span, "no entry takes it from here", &help, diagnostics);
            }
        }
    }
}

/// Checks that a default which the maker wants in the EDS is there.
pub(super) fn check_written(
    decl: &ObjectDecl,
    entries: &[Entry],
    maker: FileId,
    diagnostics: &mut Diagnostics,
) {
    let array = decl.array.iter();
    let single = array.clone().flat_map(|array| &array.elements);
    let single = single.chain(decl.record.iter().flat_map(|record| &record.members)).map(|(_, entry)| entry);
    let all = [&decl.entry].into_iter().chain(decl.sub0.as_deref()).chain(array.map(|array| &array.entry));
    for eds in all.chain(single).filter_map(|entry| entry.eds.as_ref()) {
        let mut meant = entries.iter().filter(|entry| entry.place(Fact::Eds) == eds.span).peekable();
        let is_makers = eds.value.default == Some(true) && eds.span.file.is_one_with(maker);
        if is_makers
            && meant.peek().is_some()
            && meant.all(|entry| entry.default.is_none())
            && diagnostics.is_new(codes::CONFLICTING_KEYS, eds.span)
        {
            let help = "remove it, or add `default:`";
            refuse("default: written", eds.span, "there is no default", help, diagnostics);
        }
    }
}

pub(super) fn refuse(key: &str, span: Span, why: &str, help: &str, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Diagnostic::new(codes::CONFLICTING_KEYS, span, format!("`{key}` has no effect here: {why}"))
            .help(help),
    );
}
