//! Names with placeholders for numbers: `Receive PDO {pdo} Mapping`, `Mapping Entry {n}`.

use std::ops::Range;

use crate::model::Index;

/// The numbers that the placeholders of a name mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Numbers {
    /// Number of the PDO, from 1.
    pub pdo: u16,
    /// The object.
    pub index: Index,
    /// Sub-index of the mapped entry, where the name is that of one.
    pub entry: Option<u8>,
}

/// What a placeholder counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counted {
    /// `{pdo}`: the PDOs of a direction.
    Pdo,
    /// `{n}`: the mapped entries of a PDO.
    Entry,
}

/// How a number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// `{pdo}`.
    Decimal,
    /// `{pdo:x}`.
    LowerHex,
    /// `{pdo:X}`.
    UpperHex,
}

/// What is in braces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Placeholder {
    /// `{index}`: the object's index as in `1400h`.
    Index,
    /// A number.
    Number {
        /// What it counts.
        counted: Counted,
        /// Counted from 0 (`{pdo-1}`) and not from 1.
        from_zero: bool,
        /// How it is written.
        digits: Digits,
    },
}

impl Placeholder {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        let digits = [Digits::Decimal, Digits::UpperHex, Digits::LowerHex];
        let numbers = [Counted::Pdo, Counted::Entry].into_iter().flat_map(move |counted| {
            digits.into_iter().flat_map(move |digits| {
                [false, true].map(|from_zero| Self::Number { counted, from_zero, digits })
            })
        });
        std::iter::once(Self::Index).chain(numbers)
    }

    /// As it is written between the braces.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Index => "index",
            Self::Number { counted: Counted::Pdo, from_zero, digits } => match (digits, from_zero) {
                (Digits::Decimal, false) => "pdo",
                (Digits::Decimal, true) => "pdo-1",
                (Digits::LowerHex, false) => "pdo:x",
                (Digits::LowerHex, true) => "pdo-1:x",
                (Digits::UpperHex, false) => "pdo:X",
                (Digits::UpperHex, true) => "pdo-1:X",
            },
            Self::Number { counted: Counted::Entry, from_zero, digits } => match (digits, from_zero) {
                (Digits::Decimal, false) => "n",
                (Digits::Decimal, true) => "n-1",
                (Digits::LowerHex, false) => "n:x",
                (Digits::LowerHex, true) => "n-1:x",
                (Digits::UpperHex, false) => "n:X",
                (Digits::UpperHex, true) => "n-1:X",
            },
        }
    }

    /// What it means; `None` where there is no such number.
    pub fn value(self, numbers: Numbers) -> Option<String> {
        let Self::Number { counted, from_zero, digits } = self else {
            return Some(numbers.index.to_string());
        };
        let number = match counted {
            Counted::Pdo => numbers.pdo,
            Counted::Entry => u16::from(numbers.entry?),
        };
        let number = number.checked_sub(u16::from(from_zero))?;
        Some(match digits {
            Digits::Decimal => number.to_string(),
            Digits::LowerHex => format!("{number:x}"),
            Digits::UpperHex => format!("{number:X}"),
        })
    }

    /// Whether it means a number that only mapped entries have.
    pub const fn is_of_entry(self) -> bool {
        matches!(self, Self::Number { counted: Counted::Entry, .. })
    }
}

/// A name with placeholders.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamePattern {
    parts: Vec<Part>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Part {
    Text(String),
    /// With its place in the text.
    Placeholder(Placeholder, Range<usize>),
}

/// What is wrong with a pattern.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PatternError {
    /// Where in the text, in bytes.
    pub range: Range<usize>,
    /// What is wrong there.
    pub message: String,
}

impl NamePattern {
    /// Reads a pattern: `{…}` is a placeholder, `{{` and `}}` are braces.
    ///
    /// # Errors
    /// A brace that is neither, or a placeholder that there is not.
    pub fn parse(text: &str) -> Result<Self, PatternError> {
        let mut parts = Vec::new();
        let mut plain = String::new();
        let mut at = 0;
        while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
            if let Some(brace) = ["{{", "}}"].into_iter().find(|brace| rest.starts_with(brace)) {
                plain.push_str(&brace[1..]);
                at += brace.len();
            } else if rest.starts_with('{') {
                let length = rest.find('}').ok_or_else(|| PatternError {
                    range: at..text.len(),
                    message: "a brace that is not closed".to_owned(),
                })?;
                let (inside, range) = (&rest[1..length], at..at + length + 1);
                let placeholder = Placeholder::all().find(|one| one.text() == inside);
                let message = || format!("there is no placeholder `{{{}}}`", crate::diag::shorten(inside));
                let placeholder =
                    placeholder.ok_or_else(|| PatternError { range: range.clone(), message: message() })?;
                if !plain.is_empty() {
                    parts.push(Part::Text(std::mem::take(&mut plain)));
                }
                parts.push(Part::Placeholder(placeholder, range));
                at += length + 1;
            } else if rest.starts_with('}') {
                let message = "a closing brace without its opening one".to_owned();
                return Err(PatternError { range: at..at + 1, message });
            } else {
                let length = rest.find(['{', '}']).unwrap_or(rest.len());
                plain.push_str(&rest[..length]);
                at += length;
            }
        }
        if !plain.is_empty() {
            parts.push(Part::Text(plain));
        }
        Ok(Self { parts })
    }

    /// A text as the part of a pattern that means it.
    pub fn escape(text: &str) -> String {
        text.replace('{', "{{").replace('}', "}}")
    }

    /// The name for these numbers. A placeholder that has none there stays empty.
    pub fn fill(&self, numbers: Numbers) -> String {
        let parts = self.parts.iter().map(|part| match part {
            Part::Text(text) => text.clone(),
            Part::Placeholder(placeholder, _) => placeholder.value(numbers).unwrap_or_default(),
        });
        parts.collect()
    }

    /// Its placeholders in order, each with its place in the text.
    pub fn placeholders(&self) -> impl Iterator<Item = (Placeholder, Range<usize>)> {
        self.parts.iter().filter_map(|part| match part {
            Part::Text(_) => None,
            Part::Placeholder(placeholder, range) => Some((*placeholder, range.clone())),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBERS: Numbers = Numbers { pdo: 27, index: Index(0x161A), entry: Some(12) };

    fn filled(pattern: &str) -> String {
        NamePattern::parse(pattern).unwrap().fill(NUMBERS)
    }

    #[test]
    fn every_placeholder_is_filled() {
        assert_eq!(filled("PDO {pdo}, {pdo-1}, {pdo:X}, {pdo:x}, {pdo-1:X}"), "PDO 27, 26, 1B, 1b, 1A");
        assert_eq!(filled("{n}. of {n-1:x} at {index}"), "12. of b at 161Ah");
        assert_eq!(filled("plain"), "plain");
        for placeholder in Placeholder::all() {
            let text = format!("{{{}}}", placeholder.text());
            let found: Vec<_> = NamePattern::parse(&text).unwrap().placeholders().collect();
            assert_eq!(found, [(placeholder, 0..text.len())]);
        }
    }

    #[test]
    fn braces_are_doubled() {
        assert_eq!(filled("{{pdo}} {{{pdo}}}"), "{pdo} {27}");
        for name in ["{", "}", "{n}", "}}{{", "a {pdo} b", "{{{"] {
            assert_eq!(filled(&NamePattern::escape(name)), name);
        }
    }

    #[test]
    fn what_is_no_placeholder_has_a_place() {
        for (pattern, wrong) in
            [("a {pdo", "{pdo"), ("a } b", "}"), ("{sub} x", "{sub}"), ("{ pdo }", "{ pdo }"), ("ä {}", "{}")]
        {
            let error = NamePattern::parse(pattern).unwrap_err();
            assert_eq!(&pattern[error.range], wrong);
        }
    }
}
