//! What begins the names of a dictionary, so that several can be in one program.

use std::fmt;
use std::str::FromStr;

use super::language::is_reserved;

/// The longest prefix: what follows still differs within the 63 characters that C99 distinguishes.
const LONGEST: usize = 16;

/// Names of the stack in the files that are the same for every device: they stay with any prefix.
const OF_STACK: [&str; 13] = [
    "OD_FLAGS_PDO_SIZE",
    "OD_IO_t",
    "OD_entry_t",
    "OD_extension_init",
    "OD_extension_t",
    "OD_find",
    "OD_getSub",
    "OD_readOriginal",
    "OD_requestTPDO",
    "OD_set_u8",
    "OD_size_t",
    "OD_stream_t",
    "OD_writeOriginal",
];

/// What begins the names of a dictionary for CANopenNode and of its files, `OD` unless several are in one program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prefix(String);

/// A text that no name of a dictionary can begin with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotAPrefix;

impl fmt::Display for NotAPrefix {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "names in C begin with a letter and have letters, digits and `_`; at most {LONGEST} characters, such as `ODA`"
        )
    }
}

impl std::error::Error for NotAPrefix {}

impl Default for Prefix {
    fn default() -> Self {
        Self("OD".to_owned())
    }
}

impl FromStr for Prefix {
    type Err = NotAPrefix;

    fn from_str(text: &str) -> Result<Self, NotAPrefix> {
        let is_name = text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        // The stack's own names begin with `CO`.
        let is_free = !is_reserved(text) && text != "CO" && !text.starts_with("CO_");
        if is_name && is_free && text.len() <= LONGEST { Ok(Self(text.to_owned())) } else { Err(NotAPrefix) }
    }
}

impl fmt::Display for Prefix {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl Prefix {
    /// Whether the dictionary is the only one of its program.
    pub(super) fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// A text of ours whose names begin with `OD`, such as the files that are the same for every device, with this prefix.
    pub(super) fn in_text(&self, text: &str) -> String {
        if self.is_usual() {
            return text.to_owned();
        }
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut out = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(start) = rest.find(is_part) {
            let (before, from) = rest.split_at(start);
            let (name, after) = from.split_at(from.find(|c| !is_part(c)).unwrap_or(from.len()));
            out.push_str(before);
            let own = name.strip_prefix("OD").filter(|rest| rest.is_empty() || rest.starts_with('_'));
            match own.filter(|_| !OF_STACK.contains(&name)) {
                Some(own) => {
                    out.push_str(&self.0);
                    out.push_str(own);
                }
                None => out.push_str(name),
            }
            rest = after;
        }
        out.push_str(rest);
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_the_stack_stay() {
        let prefix: Prefix = "ODA".parse().unwrap();
        assert_eq!(
            prefix.in_text("#include \"OD.h\"\nODR_t OD_extendAll(OD_entry_t *e) { OD_find(OD, 1U); x_OD; }"),
            "#include \"ODA.h\"\nODR_t ODA_extendAll(OD_entry_t *e) { OD_find(ODA, 1U); x_OD; }"
        );
        assert_eq!(Prefix::default().in_text("OD_RAM"), "OD_RAM");
    }

    #[test]
    fn a_prefix_begins_a_name_of_c() {
        for text in ["OD", "ODA", "drive_2", "a"] {
            assert!(text.parse::<Prefix>().is_ok(), "{text}");
        }
        for text in ["", "2D", "_x", "O-D", "CO", "CO_x", "int", "Größe", "a name", "abcdefghijklmnopq"] {
            assert!(text.parse::<Prefix>().is_err(), "{text}");
        }
    }
}
