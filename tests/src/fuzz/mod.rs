//! Mutants of texts, and what is demanded of every one of them.
//!
//! [`mutant()`] changes texts by chance; a [`Subject`] says what must hold for whatever comes out; [`hunt()`] tries one mutant after
//! the other, and makes what fails as small as it can. What a language looks like is a [`Notation`], what is demanded of its texts a
//! [`Subject`]; nothing else depends on one.

mod bounds;
mod eds;
mod findings;
mod hunt;
mod mutate;
mod notation;
mod random;
mod settings;
mod shrink;
mod specifications;
mod templates;
mod values;
mod xdd;

pub use bounds::{Meter, Used};
pub use eds::EdsFiles;
pub use hunt::{Caught, Hunt, Outcome, hunt};
pub use mutate::{Seed, mutant};
pub use notation::{EDS, Layout, Notation, SETTINGS, TEMPLATES, XDD, YAML};
pub use random::Random;
pub use settings::Settings;
pub use shrink::shrink;
pub use specifications::Specifications;
pub use templates::TemplateFiles;
pub use xdd::XddFiles;

/// A demand that a text does not meet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// What was being done.
    pub step: String,
    /// What is wrong, in a line.
    pub what: String,
}

impl Complaint {
    /// What is left of a complaint without the names and numbers of the text: two of a kind have it in common.
    pub fn kind(&self) -> String {
        let mut words = String::new();
        // What is between quotes is of the text.
        for part in self.what.split(['`', '"']).step_by(2) {
            let is_plain = |word: &&str| !word.contains(|c: char| c.is_ascii_digit());
            words.extend(part.split_whitespace().filter(is_plain).take(12).map(|word| format!(" {word}")));
        }
        format!("{}:{words}", self.step)
    }
}

/// What is demanded of the texts of one language.
pub trait Subject: Sync {
    /// How its texts are built.
    fn notation(&self) -> &Notation;

    /// Everything that is wrong with a text. A panic is caught and is wrong too.
    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn complaints_of_a_kind_differ_in_names_and_numbers_only() {
        let kind = |what: &str| Complaint { step: "fix".to_owned(), what: what.to_owned() }.kind();
        assert_eq!(kind("2000h: first `a b`, then 5"), kind("2001h.1: first `c`, then 77"));
        assert_ne!(kind("2000h: first `a b`"), kind("2000h: second `a b`"));
    }
}
