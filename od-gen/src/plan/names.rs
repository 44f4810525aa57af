//! Names of a specification as words, and scopes in which an identifier is given once.

use std::collections::BTreeMap;

use od_spec::ascii::transliterate;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::rule_codes::ALIKE_NAMES;
use od_spec::source::Span;

/// The words of a name in lower case: letters and digits of ASCII, after transliteration.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Words(Vec<String>);

impl Words {
    /// The words of a name; none where it has no letter or digit.
    pub fn of(name: &str) -> Self {
        let ascii = transliterate(name);
        let words = ascii.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        Self(words.map(str::to_ascii_lowercase).collect())
    }

    /// These words and those of another name.
    pub fn and(&self, name: &str) -> Self {
        Self(self.0.iter().cloned().chain(Self::of(name).0).collect())
    }

    /// The numbers among the words: the place of each, the number, and the words without it, if there are others.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (usize, u16, Self)> {
        self.0.iter().enumerate().filter(|_| self.0.len() > 1).filter_map(|(at, word)| {
            let number = word.parse().ok()?;
            let rest = self.0.iter().enumerate().filter(|(place, _)| *place != at);
            Some((at, number, Self(rest.map(|(_, word)| word.clone()).collect())))
        })
    }

    /// `actual_velocity_16bit`; an `n` goes before a leading digit, which no language takes.
    pub fn snake(&self) -> String {
        with_letter(self.0.join("_"), 'n')
    }

    /// `ActualVelocity16bit`; between two digits a `_` stays, and an `N` goes before a leading digit.
    pub fn camel(&self) -> String {
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        let mut joined = String::new();
        for word in &self.0 {
            if is_digit(joined.chars().last()) && is_digit(word.chars().next()) {
                joined.push('_');
            }
            let (head, rest) = word.split_at(1);
            joined.push_str(&head.to_ascii_uppercase());
            joined.push_str(rest);
        }
        with_letter(joined, 'N')
    }

    /// `ACTUAL_VELOCITY_16BIT`; an `N` goes before a leading digit.
    pub fn screaming(&self) -> String {
        with_letter(self.0.join("_").to_ascii_uppercase(), 'N')
    }
}

fn with_letter(identifier: String, letter: char) -> String {
    if identifier.starts_with(|first: char| first.is_ascii_digit()) {
        format!("{letter}{identifier}")
    } else {
        identifier
    }
}

/// The identifiers of one scope, each given once.
#[derive(Debug, Default)]
pub(super) struct Scope {
    taken: BTreeMap<String, Owner>,
}

/// What an identifier means.
#[derive(Debug)]
struct Owner {
    what: String,
    /// `None` for objects by number.
    span: Option<Span>,
    /// Whether it is already reported that something else would have the identifier, too.
    is_told: bool,
}

impl Scope {
    /// Gives an identifier to `what`, or reports why it cannot have it and returns `false`. What the check warned of is an
    /// error then, and not reported once more.
    pub(super) fn claim(
        &mut self,
        identifier: &str,
        what: &str,
        span: Span,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let help =
            "add `identifier:` to one of the objects or entries; give a type, unit or value another name";
        if identifier.is_empty() {
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
        if let Some(owner) = self.taken.get_mut(identifier) {
            if std::mem::replace(&mut owner.is_told, true) || diagnostics.harden(ALIKE_NAMES, span) {
                return false;
            }
            let diagnostic = Diagnostic::new(
                codes::IDENTIFIER_CLASH,
                span,
                format!("`{identifier}` would name {what} and {}", owner.what),
            );
            diagnostics.push(match owner.span.filter(|of_owner| *of_owner != span) {
                Some(of_owner) => diagnostic.with(of_owner, "the other one").help(help),
                None => diagnostic.help(help),
            });
            return false;
        }
        let owner = Owner { what: what.to_owned(), span: Some(span), is_told: false };
        self.taken.insert(identifier.to_owned(), owner);
        true
    }

    /// Gives identifiers to something that code can do without, if nothing has one of them.
    pub(super) fn claim_if_free(&mut self, identifiers: &[&str]) -> bool {
        let free = identifiers.iter().all(|one| !one.is_empty() && !self.taken.contains_key(*one));
        if free {
            let owner = || Owner { what: "objects by number".to_owned(), span: None, is_told: false };
            self.taken.extend(identifiers.iter().map(|one| ((*one).to_owned(), owner())));
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_words_and_words_identifiers() {
        let snake = |name: &str| Words::of(name).snake();
        let camel = |name: &str| Words::of(name).camel();
        assert_eq!(snake("actual velocity 16bit"), "actual_velocity_16bit");
        assert_eq!(snake("24V supply status"), "n24v_supply_status");
        assert_eq!(snake("Wärmetauscher-Größe (µs)"), "waermetauscher_groesse_us");
        assert_eq!(camel("dc-link voltage"), "DcLinkVoltage");
        assert_eq!(camel("sensor 1 2nd"), "Sensor1_2nd");
        assert_eq!(camel("24V supply"), "N24vSupply");
        assert_eq!(Words::of("lithium ion type 1").screaming(), "LITHIUM_ION_TYPE_1");
        assert_eq!(Words::of("24V").and("supply status").snake(), "n24v_supply_status");
    }

    #[test]
    fn the_check_knows_which_names_give_one_identifier() {
        let names = [
            "on",
            "On!",
            "word 1",
            "Word1",
            "1 0",
            "10",
            "phase 1 a",
            "phase 1a",
            "on line",
            "online",
            "Größe",
            "groesse",
            "+",
        ];
        for (one, other) in names.iter().flat_map(|one| names.iter().map(move |other| (*one, *other))) {
            let is_one = Words::of(one).camel() == Words::of(other).camel();
            assert_eq!(
                od_spec::ascii::letters(one) == od_spec::ascii::letters(other),
                is_one,
                "{one} {other}"
            );
        }
    }
}
