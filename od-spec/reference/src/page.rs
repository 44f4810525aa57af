//! Pages of the book.

/// A page of the book, as Markdown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// The name of its file.
    pub file: String,
    /// The text.
    pub text: String,
}

/// The last line of each page, for readers of the file who look for the source of its text. A page begins with its title,
/// which the book takes from there.
pub(crate) const NOTICE: &str = "<!-- Printed by `cargo xtask generate`. Do not edit. -->";
