//! Words of the language that are explained one by one: the values of a key with a choice of words.

use std::fmt::Write as _;

/// The words of one key.
pub(super) struct WordTable {
    /// The mark of the table in a chapter.
    pub mark: &'static str,
    /// Each word and its meaning.
    pub meanings: &'static [(&'static str, &'static str)],
}

/// All of them.
pub(super) static WORD_TABLES: &[&WordTable] = &[&STORAGE, &ROUNDING, &OUTSIDE, &ERRATA];

/// `stored:`.
static STORAGE: WordTable = WordTable {
    mark: "{STORAGE}",
    meanings: &[
        ("no", "it is lost at power-off"),
        ("communication", "saved with the communication parameters, 1010h.2"),
        ("application", "saved with the application parameters, 1010h.3"),
        ("manufacturer", "saved with parameters of the manufacturer's choice, 1010h.4 and above"),
        ("remanent", "kept by the device itself at power-off, without a command"),
    ],
};

/// `rounding:`.
static ROUNDING: WordTable = WordTable {
    mark: "{ROUNDING}",
    meanings: &[
        ("down", "the step below"),
        ("up", "the step above"),
        ("nearest", "the nearest step; halves are rounded away from zero"),
        ("zero", "the step nearer to zero"),
    ],
};

/// `outside:`.
static OUTSIDE: WordTable = WordTable {
    mark: "{OUTSIDE}",
    meanings: &[
        ("saturate", "the nearest value that the alias can show"),
        ("wrap", "its low bits"),
        ("abort", "an SDO abort"),
    ],
};

/// `kind:` of an erratum.
static ERRATA: WordTable = WordTable {
    mark: "{ERRATA}",
    meanings: &[
        ("index", "an index"),
        ("name", "a name"),
        ("type", "a data type"),
        ("sign", "the sign of a type or value"),
        ("access", "an access right"),
        ("object-type", "VAR, ARRAY or RECORD"),
        ("sub-index", "a sub-index, or the number of them"),
        ("count", "the number of elements or rows"),
        ("default", "a default value"),
        ("limit", "a limit"),
        ("unit", "a unit or scale"),
        ("pdo", "PDO mapping, or its direction"),
        ("stored", "whether a value is stored"),
        ("bits", "a bit table"),
        ("values", "a value table"),
        ("table", "a table's number, caption or headings"),
        ("text", "running text"),
        ("gap", "the manual states nothing, and something had to be chosen"),
        ("profile", "the manual differs from a CiA profile; the specification follows the manual"),
    ],
};

impl WordTable {
    /// The table in Markdown.
    pub(super) fn markdown(&self) -> String {
        let mut out = String::from("| Word | Meaning |\n| --- | --- |");
        for (word, about) in self.meanings {
            let _ = write!(out, "\n| `{word}` | {about} |");
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use od_spec::model::{ErratumKind, Outside, Rounding, Storage};

    #[test]
    fn every_word_is_explained() {
        let explains =
            |table: &WordTable, words: &[&str]| table.meanings.iter().map(|(word, _)| word).eq(words);
        assert!(explains(&STORAGE, Storage::WORDS));
        assert!(explains(&ERRATA, ErratumKind::WORDS));
        assert!(explains(&ROUNDING, Rounding::WORDS));
        assert!(explains(&OUTSIDE, Outside::WORDS));
    }
}
