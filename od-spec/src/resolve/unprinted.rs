//! What an erratum says about facts that the manual does not print.

use crate::ast::ErratumDecl;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    Dictionary, EntryId, ErratumKind, ErratumPlace, Fact, NamedType, System, TypeKind, Unprinted,
};

/// The facts of an erratum at these places, if it names some.
pub(super) fn of(
    decl: &ErratumDecl,
    kind: ErratumKind,
    at: &[ErratumPlace],
    system: &System,
    diagnostics: &mut Diagnostics,
) -> Option<Unprinted> {
    let (first, basis) = (decl.facts.first(), decl.basis.as_ref());
    if let Some(first) = first.filter(|_| kind != ErratumKind::Gap) {
        let message = format!("`facts` has no effect on an erratum of kind `{}`", kind.word());
        diagnostics.push(
            Diagnostic::new(codes::CONFLICTING_KEYS, first.span, message)
                .help("make it a `gap`, or remove the key"),
        );
    }
    if let Some(of) = decl.of.first().filter(|_| !decl.facts.iter().any(|fact| fact.value == Fact::Meaning)) {
        let message = "`of` has no effect without `facts: meaning`";
        diagnostics.push(
            Diagnostic::new(codes::CONFLICTING_KEYS, of.span, message)
                .help("add `facts: meaning`, or remove the key"),
        );
    }
    for number in &decl.of {
        if !types(at, system).any(|named| has(named, number.value)) {
            let message = format!("no type of `at` has a value or bit {}", number.value);
            let help = "correct the number, or name an entry of the type in `at`";
            diagnostics.push(Diagnostic::new(codes::UNKNOWN_REFERENCE, number.span, message).help(help));
        }
    }
    first?;
    Some(Unprinted {
        facts: decl.facts.iter().map(|fact| fact.value).collect(),
        of: decl.of.iter().map(|number| number.value).collect(),
        basis: basis?.value,
    })
}

/// The types of the entries at these places.
fn types<'a>(at: &'a [ErratumPlace], system: &'a System) -> impl Iterator<Item = &'a NamedType> {
    let entries = system.devices.iter().flat_map(Dictionary::entries);
    let is_meant = |id: EntryId| {
        at.iter().any(|place| match place {
            ErratumPlace::Object(index) => *index == id.index,
            ErratumPlace::Entry(one) => *one == id,
        })
    };
    entries.filter(move |(id, ..)| is_meant(*id)).filter_map(|(.., entry)| entry.named_type.as_deref())
}

/// Whether a type has a value, or a bit of its own.
fn has(named: &NamedType, number: i128) -> bool {
    match &named.kind {
        TypeKind::Enum(values) => values.iter().any(|value| value.value == number),
        TypeKind::Bits(fields) => {
            fields.iter().any(|field| (field.first..=field.last).any(|bit| i128::from(bit) == number))
        }
    }
}
