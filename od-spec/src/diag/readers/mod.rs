//! Programs that read EDS and DCF files, and sets of them.

pub mod codes;

use std::fmt;

/// A program that reads EDS and DCF files, and of which it is known what it stumbles over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Reader {
    /// The Python library `canopen`.
    PythonCanopen,
    /// The checker of lely's dcf-tools, which `dcfgen` calls as well.
    Dcfchk,
    /// The Python package `eds-utils`.
    EdsUtils,
    /// The JavaScript library `canopen`.
    NodeCanopen,
    /// The Rust crate `canopen-host`.
    CanopenHost,
    /// CODESYS, and the PLC tools that are made from it.
    Codesys,
    /// The editor of CANopenNode, with its library libedssharp.
    CanopenEditor,
    /// CANeds and CANchkEDS of Vector.
    Caneds,
}

/// How it is known what a reader stumbles over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// It was run, and what is said of it is compared with what it does.
    Tested,
    /// Its users reported it.
    Reported,
}

impl Reader {
    /// All of them, those that were run first.
    pub const ALL: [Reader; 8] = [
        Reader::PythonCanopen,
        Reader::Dcfchk,
        Reader::EdsUtils,
        Reader::NodeCanopen,
        Reader::CanopenHost,
        Reader::Codesys,
        Reader::CanopenEditor,
        Reader::Caneds,
    ];

    /// What people call it.
    pub const fn name(self) -> &'static str {
        match self {
            Reader::PythonCanopen => "python-canopen",
            Reader::Dcfchk => "dcfchk",
            Reader::EdsUtils => "eds-utils",
            Reader::NodeCanopen => "node-canopen",
            Reader::CanopenHost => "canopen-host",
            Reader::Codesys => "CODESYS",
            Reader::CanopenEditor => "CANopenEditor",
            Reader::Caneds => "CANeds",
        }
    }

    /// How it is known what it stumbles over.
    pub const fn evidence(self) -> Evidence {
        match self {
            Reader::PythonCanopen
            | Reader::Dcfchk
            | Reader::EdsUtils
            | Reader::NodeCanopen
            | Reader::CanopenHost => Evidence::Tested,
            Reader::Codesys | Reader::CanopenEditor | Reader::Caneds => Evidence::Reported,
        }
    }

    const fn bit(self) -> u16 {
        1 << self as u16
    }
}

impl fmt::Display for Reader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of readers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Readers(u16);

impl Readers {
    /// None.
    pub const NONE: Self = Self(0);

    /// These.
    pub const fn of(readers: &[Reader]) -> Self {
        let (mut bits, mut at) = (0, 0);
        // A loop over an iterator is not constant.
        while at < readers.len() {
            bits |= readers[at].bit();
            at += 1;
        }
        Self(bits)
    }

    /// Adds one.
    pub const fn insert(&mut self, reader: Reader) {
        self.0 |= reader.bit();
    }

    /// Whether it is one of them.
    pub const fn contains(self, reader: Reader) -> bool {
        self.0 & reader.bit() != 0
    }

    /// Whether one of them is among the others.
    pub const fn meet(self, others: Self) -> bool {
        self.0 & others.0 != 0
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// In the order of [`Reader::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Reader> {
        Reader::ALL.into_iter().filter(move |reader| self.contains(*reader))
    }

    /// The beginning of a sentence: `dcfchk refuses`, `dcfchk and python-canopen refuse`.
    pub fn with_verb(self, one: &str, several: &str) -> String {
        let names: Vec<&str> = self.iter().map(Reader::name).collect();
        format!("{} {}", listed(&names), if names.len() == 1 { one } else { several })
    }

    /// What is said at a finding: which readers refuse the file because of it, and which are reported to fail; a line
    /// each.
    pub(crate) fn sentences(self) -> Vec<String> {
        let named = |evidence| {
            let names = self.iter().filter(move |reader| reader.evidence() == evidence);
            names.map(Reader::name).collect::<Vec<_>>()
        };
        let mut sentences = Vec::new();
        match named(Evidence::Tested).as_slice() {
            [] => {}
            [one] => sentences.push(format!("{one} refuses the file because of this")),
            several => sentences.push(format!("{} refuse the file because of this", listed(several))),
        }
        match named(Evidence::Reported).as_slice() {
            [] => {}
            [one] => sentences.push(format!("{one} is reported to stumble over this")),
            several => sentences.push(format!("{} are reported to stumble over this", listed(several))),
        }
        sentences
    }
}

/// `a`, `a and b`, `a, b and c`.
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_says_who_is_in_it() {
        const BOTH: Readers = Readers::of(&[Reader::Dcfchk, Reader::PythonCanopen]);
        assert_eq!(BOTH.iter().collect::<Vec<_>>(), [Reader::PythonCanopen, Reader::Dcfchk]);
        assert_eq!(BOTH.sentences(), ["python-canopen and dcfchk refuse the file because of this"]);
        assert!(Readers::NONE.is_empty() && Readers::NONE.sentences().is_empty());
        let all = Readers::of(&Reader::ALL);
        assert_eq!(all.iter().collect::<Vec<_>>(), Reader::ALL);
        assert_eq!(
            all.sentences(),
            [
                "python-canopen, dcfchk, eds-utils, node-canopen and canopen-host refuse the file because of this",
                "CODESYS, CANopenEditor and CANeds are reported to stumble over this",
            ]
        );
    }
}
