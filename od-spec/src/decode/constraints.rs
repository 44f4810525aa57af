//! Constraints that are written once for several numbers.

use std::collections::BTreeMap;

use crate::ast::{ConditionDecl, ConstraintDecl, Words};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::expr::PLACEHOLDER;
use crate::model::{Series, Text};
use crate::source::{Span, Spanned};

/// The constraint itself, or one for each of its numbers.
pub(super) fn numbered(decl: ConstraintDecl, diagnostics: &mut Diagnostics) -> Vec<ConstraintDecl> {
    let conditions = || [&decl.require, &decl.when].into_iter().flatten();
    let has_place = |condition: &&Spanned<ConditionDecl>| match &condition.value {
        ConditionDecl::Plain(_) => false,
        ConditionDecl::Named(text) => text.contains(PLACEHOLDER),
    };
    let Some(first) = decl.numbers.first() else {
        let in_name = decl.name.value.contains(PLACEHOLDER).then_some(decl.name.span);
        let in_condition = conditions().find(has_place).map(|condition| condition.span);
        if let Some(place) = in_condition.or(in_name) {
            diagnostics.push(
                Diagnostic::new(codes::BAD_NOTATION, place, "`{n}` has no number here")
                    .help("add the numbers of the run to the constraint: `n: 0..11`"),
            );
            return Vec::new();
        }
        return vec![decl];
    };
    // A condition that is missing or cannot be read was reported.
    if decl.require.is_none() {
        return Vec::new();
    }
    let mut missing = Vec::new();
    if !decl.name.value.contains(PLACEHOLDER) {
        missing.push((decl.name.span, "the constraints would all have this name"));
    }
    if !conditions().any(|condition| has_place(&condition)) {
        missing.push((first.span, "the constraints would all say the same"));
    }
    if !missing.is_empty() {
        for (place, message) in missing {
            diagnostics.push(
                Diagnostic::new(codes::BAD_NOTATION, place, message)
                    .help("write `{n}` into the name and the conditions; it means the number"),
            );
        }
        return Vec::new();
    }
    let numbers = decl.numbers.iter().flat_map(|range| range.value.first..=range.value.last);
    numbers.map(|number| of_number(&decl, number.into())).collect()
}

/// Leaves out constraints whose name another one has, which numbers may have given it.
pub(super) fn of_distinct_names(
    list: Vec<ConstraintDecl>,
    diagnostics: &mut Diagnostics,
) -> Vec<ConstraintDecl> {
    let mut names: BTreeMap<String, Span> = BTreeMap::new();
    let mut distinct = Vec::with_capacity(list.len());
    for decl in list {
        match names.get(&decl.name.value) {
            Some(first) => diagnostics.push(
                Diagnostic::new(
                    codes::DUPLICATE_KEY,
                    decl.name.span,
                    format!("two constraints are named `{}`", shorten(&decl.name.value)),
                )
                .label("again here")
                .with(*first, "first here")
                .help("correct the numbers, or give one of the two another name"),
            ),
            None => {
                names.insert(decl.name.value.clone(), decl.name.span);
                distinct.push(decl);
            }
        }
    }
    distinct
}

/// The constraint for one number.
fn of_number(decl: &ConstraintDecl, number: u32) -> ConstraintDecl {
    let digits = number.to_string();
    let said = |text: &str| text.replace(PLACEHOLDER, &digits);
    let condition = |condition: &Option<Spanned<ConditionDecl>>| {
        let condition = condition.as_ref()?;
        let of_number = match &condition.value {
            ConditionDecl::Plain(_) => condition.value.clone(),
            // A number fits wherever its place does, and what does not exist is reported later.
            ConditionDecl::Named(text) => {
                let text = said(text);
                ConditionDecl::read(&text).unwrap_or(ConditionDecl::Named(text))
            }
        };
        Some(Spanned::new(of_number, condition.span))
    };
    let words = |words: &Words| {
        let words = words.as_ref()?;
        let texts: Vec<(&str, String)> =
            words.value.iter().map(|(language, text)| (language, said(text))).collect();
        let texts = texts.iter().map(|(language, text)| (*language, text.as_str()));
        Some(Spanned::new(Text::new(texts), words.span))
    };
    ConstraintDecl {
        name: Spanned::new(said(&decl.name.value), decl.name.span),
        series: Some(Series { name: decl.name.value.clone(), number }),
        devices: decl.devices.clone(),
        require: condition(&decl.require),
        when: condition(&decl.when),
        numbers: Vec::new(),
        about: words(&decl.about),
        gap: words(&decl.gap),
    }
}
