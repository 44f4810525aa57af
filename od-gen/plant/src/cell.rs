//! A text in a cell of a table.

use od_spec::markdown::escape;

/// A text on one line that commands nothing in Markdown.
pub(super) fn plain(text: &str) -> String {
    escape(text).trim().to_owned()
}
