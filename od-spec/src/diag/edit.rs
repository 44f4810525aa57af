//! Changes of a source text that messages bring with them.

use crate::source::Span;

/// A change of a source text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty for text that is put in between.
    pub span: Span,
    /// What is written there afterwards.
    pub text: String,
}

/// Whether a text can take the place of any other in a specification: it needs no quotes, wherever it is written, and
/// would need none inside of some.
pub(super) fn stands_without_quotes(text: &str) -> bool {
    let is_harmless =
        |c: char| c.is_alphanumeric() || matches!(c, ' ' | '.' | '-' | '_' | '(' | ')' | '/' | '°');
    let begins = text.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    begins && text.chars().all(is_harmless) && !text.ends_with(' ') && text != "null"
}

#[cfg(test)]
mod tests {
    use super::stands_without_quotes;

    #[test]
    fn only_texts_that_say_the_same_everywhere_take_the_place_of_others() {
        for text in
            ["0x2001", "0x2001.3", "unsigned16", "größe 1", "1/10", "drive data.error mask", "rw locked"]
        {
            assert!(stands_without_quotes(text), "{text}");
        }
        for text in [
            "", " a", "a ", "a: b", "a, b", "a #b", "- a", "null", "~", "it's", "\"a\"", "[a]", "a\nb", "*a",
            "%",
        ] {
            assert!(!stands_without_quotes(text), "{text}");
        }
    }
}
