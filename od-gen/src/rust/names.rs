//! Identifiers made from the names of a specification.

use std::collections::BTreeMap;

use od_spec::ascii::transliterate;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::source::Span;

/// Words that Rust keeps for itself, in any edition.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield",
];

/// The words of a name in lower case: letters and digits of ASCII, after transliteration.
fn words(name: &str) -> Vec<String> {
    transliterate(name)
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_ascii_lowercase)
        .collect()
}

/// `actual_velocity_16bit`; an `n` goes before a leading digit, a `_` behind a keyword.
pub(super) fn snake(name: &str) -> String {
    let joined = words(name).join("_");
    if joined.starts_with(|first: char| first.is_ascii_digit()) {
        format!("n{joined}")
    } else if KEYWORDS.contains(&joined.as_str()) {
        format!("{joined}_")
    } else {
        joined
    }
}

/// `ActualVelocity16bit`; between two digits a `_` stays.
pub(super) fn camel(name: &str) -> String {
    let mut joined = String::new();
    for word in words(name) {
        let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        if digit(joined.chars().last()) && digit(word.chars().next()) {
            joined.push('_');
        }
        let (head, tail) = word.split_at(1);
        joined.push_str(&head.to_ascii_uppercase());
        joined.push_str(tail);
    }
    match joined.as_str() {
        "Self" => "Self_".to_owned(),
        digit if digit.starts_with(|first: char| first.is_ascii_digit()) => format!("N{joined}"),
        _ => joined,
    }
}

/// `ACTUAL_VELOCITY_16BIT`.
pub(super) fn screaming(name: &str) -> String {
    let joined = words(name).join("_").to_ascii_uppercase();
    if joined.starts_with(|first: char| first.is_ascii_digit()) { format!("N{joined}") } else { joined }
}

/// The setter of an accessor: `set_actual_velocity`; of `type_`, `set_type`.
pub(super) fn setter(name: &str) -> String {
    format!("set_{}", name.trim_end_matches('_'))
}

/// The accessor of a group that is to be changed: `gear_ratio_mut`.
pub(super) fn mutable(name: &str) -> String {
    format!("{}_mut", name.trim_end_matches('_'))
}

/// The names of one scope, each given once.
#[derive(Debug, Default)]
pub(super) struct Scope {
    taken: BTreeMap<String, Owner>,
}

/// What a name stands for.
#[derive(Debug)]
struct Owner {
    what: String,
    /// `None` for what generated code always has.
    span: Option<Span>,
}

impl Scope {
    /// A scope in which generated code needs some names itself.
    pub(super) fn with_reserved(names: &[&str]) -> Self {
        let own = |name: &&str| {
            ((*name).to_owned(), Owner { what: "generated code itself".to_owned(), span: None })
        };
        Self { taken: names.iter().map(own).collect() }
    }

    /// Gives a name to `what`, or reports why it cannot have it and returns `false`.
    pub(super) fn claim(
        &mut self,
        name: &str,
        what: &str,
        span: Span,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let help =
            "add `identifier:` to one of the objects or entries; give a type, unit or value another name";
        if name.is_empty() {
            diagnostics.push(
                Diagnostic::new(
                    codes::NO_IDENTIFIER,
                    span,
                    format!("the name of {what} has no letter or digit that an identifier could have"),
                )
                .help("write `identifier:`, or a name with letters"),
            );
            return false;
        }
        if let Some(owner) = self.taken.get(name) {
            let diagnostic = Diagnostic::new(
                codes::IDENTIFIER_CLASH,
                span,
                format!("`{name}` would name {what} and {}", owner.what),
            );
            diagnostics.push(match owner.span.filter(|other| *other != span) {
                Some(other) => diagnostic.with(other, "the other one").help(help),
                None => diagnostic.help(help),
            });
            return false;
        }
        self.taken.insert(name.to_owned(), Owner { what: what.to_owned(), span: Some(span) });
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        assert_eq!(snake("actual velocity 16bit"), "actual_velocity_16bit");
        assert_eq!(snake("24V supply status"), "n24v_supply_status");
        assert_eq!(snake("type"), "type_");
        assert_eq!(snake("Wärmetauscher-Größe (µs)"), "waermetauscher_groesse_us");
        assert_eq!(camel("dc-link voltage"), "DcLinkVoltage");
        assert_eq!(camel("sensor 1 2nd"), "Sensor1_2nd");
        assert_eq!(camel("24V supply"), "N24vSupply");
        assert_eq!(screaming("lithium ion type 1"), "LITHIUM_ION_TYPE_1");
    }
}
