//! Rust as a language of plans: its keywords, its spelling, and what generated modules use themselves.

use crate::plan::{Companion, Language, Role, ScopeKind, Words};

/// Words that Rust keeps for itself, in any edition.
const KEYWORDS: &[&str] = &[
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield",
];

/// Names that generated code uses where groups of accessors are defined.
const GROUPS: &[&str] = &["Option", "Some", "None", "Result", "Ok", "Err", "Borrow", "BorrowMut", "D"];

/// Names that generated code uses where enums and bit fields are defined.
const TYPES: &[&str] = &["Option", "Some", "None"];

/// Those of groups, and the type next to the dictionary's.
const DICTIONARY: &[&str] =
    &["Option", "Some", "None", "Result", "Ok", "Err", "Borrow", "BorrowMut", "D", "Entry"];

/// Names that the dictionary's own methods have, and the methods of its traits: an accessor would hide them.
const METHODS: &[&str] = &[
    "new",
    "clone",
    "entry",
    "row",
    "image",
    "image_mut",
    "condition",
    "find",
    "info",
    "read",
    "upload",
    "write",
    "upload_domain",
    "download_domain",
    "reset",
    "reset_stored",
    "stored",
    "restore",
    "layout",
    "broken_constraint",
    "write_consistent",
];

/// Rust with `firmware-glue`.
pub struct Rust;

impl Language for Rust {
    fn identifier(&self, scope: ScopeKind, role: Role, words: &Words) -> String {
        let name = match role {
            Role::Type | Role::Variant => words.camel(),
            Role::Constant => words.screaming(),
            Role::Function | Role::Field => words.snake(),
        };
        let is_taken = KEYWORDS.contains(&name.as_str()) || taken(scope).contains(&name.as_str());
        if is_taken { format!("{name}_") } else { name }
    }

    fn companion(&self, companion: Companion, identifier: &str) -> Option<String> {
        Some(match companion {
            Companion::Setter => setter(identifier),
            Companion::Mutable => mutable(identifier),
            Companion::Elements => elements(identifier),
            Companion::With => with(identifier),
        })
    }

    fn alternatives(&self, variants: &[&str]) -> String {
        match variants {
            [only] => (*only).to_owned(),
            // The underscore that makes another name of a keyword is not wanted inside of a name.
            several => {
                several.iter().map(|variant| variant.trim_end_matches('_')).collect::<Vec<_>>().join("Or")
            }
        }
    }
}

/// Identifiers that generated code needs itself in a scope.
const fn taken(scope: ScopeKind) -> &'static [&'static str] {
    match scope {
        ScopeKind::Dictionary => DICTIONARY,
        ScopeKind::Accessors => METHODS,
        ScopeKind::Groups => GROUPS,
        ScopeKind::Types => TYPES,
        // Methods that `firmware-glue` gives to every enum and bit field.
        ScopeKind::TypeMembers => &["known", "bits", "name", "number", "is_known"],
        ScopeKind::GroupMembers
        | ScopeKind::Entries
        | ScopeKind::Fields
        | ScopeKind::Units
        | ScopeKind::SpecialValues
        | ScopeKind::PdoFields
        | ScopeKind::Machines
        | ScopeKind::MachineVariants
        | ScopeKind::Errors
        | ScopeKind::Constraints => &[],
    }
}

/// The name of a device's module.
pub fn module(key: &str) -> String {
    Rust.identifier(ScopeKind::Constraints, Role::Function, &Words::of(key))
}

/// The setter of an accessor: `set_actual_velocity`; of `type_`, `set_type`.
pub(super) fn setter(accessor: &str) -> String {
    format!("set_{}", accessor.trim_end_matches('_'))
}

/// The accessor of a group that is to be changed: `gear_ratio_mut`.
pub(super) fn mutable(accessor: &str) -> String {
    let name = format!("{}_mut", accessor.trim_end_matches('_'));
    if METHODS.contains(&name.as_str()) { name + "_" } else { name }
}

/// The accessor of all elements of an array: `cell_voltages_iter`.
pub(super) fn elements(accessor: &str) -> String {
    format!("{}_iter", accessor.trim_end_matches('_'))
}

/// The method that gives a word with other bits: `with_fault`.
pub(super) fn with(accessor: &str) -> String {
    format!("with_{accessor}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_are_no_identifiers() {
        let of = |scope, role, name: &str| Rust.identifier(scope, role, &Words::of(name));
        let function = |name: &str| of(ScopeKind::Accessors, Role::Function, name);
        assert_eq!((function("type").as_str(), function("register").as_str()), ("type_", "register"));
        assert_eq!(of(ScopeKind::Units, Role::Type, "self"), "Self_");
        assert_eq!(of(ScopeKind::TypeMembers, Role::Constant, "self"), "SELF");
        assert_eq!((setter("type_").as_str(), mutable("type_").as_str()), ("set_type", "type_mut"));
    }
}
