//! The keys by which a text says what it is.

use super::{PARAMETERS_VERSION, PART_OF, PLANT_VERSION, SPEC_VERSION};

/// Lines of a text in which it says what it is. `content.js` of the extension for VS Code has the same number.
const BEGINNING: usize = 100;

/// Whether a text says by this key what it is: of the keys that say so, it is the first at the beginning of a line.
pub(crate) fn is_marked(text: &str, key: &str) -> bool {
    let begins =
        |line: &str, key: &str| line.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with(':'));
    let marks = [SPEC_VERSION, PART_OF, PARAMETERS_VERSION, PLANT_VERSION];
    let mut lines = text.lines().take(BEGINNING);
    lines.find_map(|line| marks.into_iter().find(|mark| begins(line, mark))) == Some(key)
}
