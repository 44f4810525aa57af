//! Names of the language: ASCII, not too long, none twice whatever the case, none that is a word of the language.

use std::collections::{BTreeMap, BTreeSet};

/// Longest name. TIA Portal takes 128 characters; CODESYS and TwinCAT have no end.
pub(super) const LONGEST: usize = 120;
/// Longest name of an entry, so that there is room for what follows it.
pub(super) const LONGEST_OF_ENTRY: usize = 80;

/// Words of the language, and of the tools that take it, which name nothing else; in upper case. Names of the file
/// begin with the key of the device; members of structures and enums do not, and are compared with these.
const WORDS: &[&str] = &[
    "ABS",
    "ABSTRACT",
    "ACOS",
    "ACTION",
    "ADD",
    "ADR",
    "AND",
    "AND_THEN",
    "ANY",
    "ARRAY",
    "ASIN",
    "AT",
    "ATAN",
    "BEGIN",
    "BIT",
    "BITADR",
    "BOOL",
    "BY",
    "BYTE",
    "CAL",
    "CALC",
    "CALCN",
    "CASE",
    "CHAR",
    "CLASS",
    "CONCAT",
    "CONFIGURATION",
    "CONSTANT",
    "CONTINUE",
    "COS",
    "CTD",
    "CTU",
    "CTUD",
    "DATE",
    "DATE_AND_TIME",
    "DELETE",
    "DINT",
    "DIV",
    "DO",
    "DT",
    "DWORD",
    "ELSE",
    "ELSIF",
    "EN",
    "END_ACTION",
    "END_CASE",
    "END_CLASS",
    "END_CONFIGURATION",
    "END_FOR",
    "END_FUNCTION",
    "END_FUNCTION_BLOCK",
    "END_IF",
    "END_INTERFACE",
    "END_METHOD",
    "END_NAMESPACE",
    "END_PROGRAM",
    "END_PROPERTY",
    "END_REPEAT",
    "END_RESOURCE",
    "END_STEP",
    "END_STRUCT",
    "END_TRANSITION",
    "END_TYPE",
    "END_UNION",
    "END_VAR",
    "END_WHILE",
    "ENO",
    "EQ",
    "EXIT",
    "EXP",
    "EXPT",
    "EXTENDS",
    "FALSE",
    "FINAL",
    "FIND",
    "FOR",
    "FROM",
    "FUNCTION",
    "FUNCTION_BLOCK",
    "F_EDGE",
    "F_TRIG",
    "GE",
    "GET",
    "GOTO",
    "GT",
    "IF",
    "IMPLEMENTS",
    "INI",
    "INITIAL_STEP",
    "INSERT",
    "INT",
    "INTERFACE",
    "INTERNAL",
    "INTERVAL",
    "JMP",
    "JMPC",
    "JMPCN",
    "LABEL",
    "LD",
    "LDATE",
    "LDN",
    "LDT",
    "LE",
    "LEFT",
    "LEN",
    "LIMIT",
    "LINT",
    "LN",
    "LOG",
    "LREAL",
    "LT",
    "LTIME",
    "LTOD",
    "LWORD",
    "MAX",
    "METHOD",
    "MID",
    "MIN",
    "MOD",
    "MOVE",
    "MUL",
    "MUX",
    "NAMESPACE",
    "NE",
    "NON_RETAIN",
    "NOT",
    "NULL",
    "OF",
    "ON",
    "OR",
    "OR_ELSE",
    "OVERLAP",
    "OVERRIDE",
    "PERSISTENT",
    "POINTER",
    "PRIORITY",
    "PRIVATE",
    "PROGRAM",
    "PROPERTY",
    "PROTECTED",
    "PUBLIC",
    "R",
    "R1",
    "READ_ONLY",
    "READ_WRITE",
    "REAL",
    "REF",
    "REFERENCE",
    "REF_TO",
    "REGION",
    "REPEAT",
    "REPLACE",
    "RESOURCE",
    "RET",
    "RETAIN",
    "RETC",
    "RETCN",
    "RETURN",
    "RIGHT",
    "ROL",
    "ROR",
    "RS",
    "R_EDGE",
    "R_TRIG",
    "S",
    "S1",
    "SEL",
    "SEMA",
    "SET",
    "SHL",
    "SHR",
    "SIN",
    "SINGLE",
    "SINT",
    "SIZEOF",
    "SQRT",
    "SR",
    "ST",
    "STEP",
    "STN",
    "STRING",
    "STRUCT",
    "SUB",
    "SUPER",
    "TAN",
    "TASK",
    "THEN",
    "THIS",
    "TIME",
    "TIME_OF_DAY",
    "TO",
    "TOD",
    "TOF",
    "TON",
    "TP",
    "TRANSITION",
    "TRUE",
    "TRUNC",
    "TYPE",
    "UDINT",
    "UINT",
    "ULINT",
    "UNION",
    "UNTIL",
    "USING",
    "USINT",
    "VAR",
    "VAR_ACCESS",
    "VAR_CONFIG",
    "VAR_EXTERNAL",
    "VAR_GLOBAL",
    "VAR_INPUT",
    "VAR_INST",
    "VAR_IN_OUT",
    "VAR_OUTPUT",
    "VAR_STAT",
    "VAR_TEMP",
    "VOID",
    "WCHAR",
    "WHILE",
    "WITH",
    "WORD",
    "WSTRING",
    "XOR",
    "XORN",
];

/// A name that is wanted.
#[derive(Debug, Clone)]
pub(super) struct Wanted {
    /// The name; may be empty.
    pub name: String,
    /// What distinguishes it from others, where it is too long or not the only one: `2001_1`.
    pub number: String,
}

impl Wanted {
    pub(super) fn new(name: String, number: impl Into<String>) -> Self {
        Self { name, number: number.into() }
    }
}

/// A scope in which a name is given once.
#[derive(Debug)]
pub(super) struct Scope {
    /// In upper case.
    taken: BTreeSet<String>,
    longest: usize,
}

impl Scope {
    pub(super) const fn new(longest: usize) -> Self {
        Self { taken: BTreeSet::new(), longest }
    }

    /// A scope in which some names are taken from the start.
    pub(super) fn without(names: &[&str]) -> Self {
        Self { taken: names.iter().map(|name| name.to_ascii_uppercase()).collect(), longest: LONGEST }
    }

    /// The names of things that are alike. One that is too long, a word of the language, or wanted by two gets its number, so
    /// that it does not depend on which of them comes first.
    pub(super) fn give_all(&mut self, wanted: &[Wanted]) -> Vec<String> {
        let mut count: BTreeMap<String, usize> = BTreeMap::new();
        for one in wanted {
            *count.entry(one.name.to_ascii_uppercase()).or_default() += 1;
        }
        let names = wanted.iter().map(|one| {
            let capitals = one.name.to_ascii_uppercase();
            let is_alone = count.get(&capitals) == Some(&1) && !self.taken.contains(&capitals);
            let is_name = !one.name.is_empty() && !WORDS.contains(&capitals.as_str());
            if is_alone && is_name && one.name.len() <= self.longest {
                self.taken.insert(capitals);
                return one.name.clone();
            }
            self.numbered(one)
        });
        names.collect()
    }

    /// The name of something that is alone of its kind.
    pub(super) fn give(&mut self, name: String, number: impl Into<String>) -> String {
        self.give_all(&[Wanted::new(name, number)]).pop().unwrap_or_default()
    }

    fn numbered(&mut self, wanted: &Wanted) -> String {
        let mut again = 1;
        loop {
            let behind = match (wanted.number.as_str(), again) {
                ("", again) => format!("_{again}"),
                (number, 1) => format!("_{number}"),
                (number, again) => format!("_{number}_{again}"),
            };
            let begin = if wanted.name.is_empty() { "x" } else { &wanted.name };
            let name = format!("{}{behind}", cut(begin, self.longest.saturating_sub(behind.len())));
            if self.taken.insert(name.to_ascii_uppercase()) {
                return name;
            }
            again += 1;
        }
    }
}

/// The beginning of a name, without a `_` at its end.
fn cut(name: &str, longest: usize) -> &str {
    name.get(..longest).unwrap_or(name).trim_end_matches('_')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(scope: &mut Scope, wanted: &[(&str, &str)]) -> Vec<String> {
        let wanted: Vec<Wanted> =
            wanted.iter().map(|(name, number)| Wanted::new((*name).to_owned(), *number)).collect();
        scope.give_all(&wanted)
    }

    #[test]
    fn names_differ_in_more_than_case() {
        let mut scope = Scope::new(12);
        assert_eq!(
            given(&mut scope, &[("speed", "1"), ("Speed", "2"), ("other", "3")]),
            ["speed_1", "Speed_2", "other"]
        );
        assert_eq!(given(&mut scope, &[("OTHER", "4")]), ["OTHER_4"]);
        assert_eq!(
            given(&mut scope, &[("a_very_long_name", "5"), ("eleven_char_", "")]),
            ["a_very_lon_5", "eleven_char_"]
        );
        assert_eq!(
            given(&mut scope, &[("", "6"), ("type", "b1"), ("other", "4")]),
            ["x_6", "type_b1", "other_4_2"]
        );
    }

    #[test]
    fn words_are_in_order_and_once() {
        assert!(WORDS.is_sorted_by(|one, other| one < other));
    }
}
