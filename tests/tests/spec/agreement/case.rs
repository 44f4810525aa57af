//! What a case of the table is.

use firmware_glue::AbortCode;
use od_spec::model::{DataType, EntryId, Index, SubIndex, Value};

use crate::agreement::reason::Reason;

/// Who judges a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Party {
    /// The compiler, about a specification that states the value as a default.
    Specification,
    /// The same rules, about a setting of a DCF.
    Settings,
    /// The generated dictionary, about an SDO download.
    Device,
}

impl Party {
    pub(crate) const ALL: [Self; 3] = [Self::Specification, Self::Settings, Self::Device];
}

/// What one of them says.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Said {
    /// Nothing.
    Accepted,
    /// Warnings: their codes.
    Warned(String),
    /// Errors: their codes.
    Refused(String),
    /// The device ends the transfer.
    Aborted(AbortCode),
    /// The language has no words for the value.
    NoWords,
}

/// A value as the table writes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Raw {
    Number(i128),
    Real(f32),
    Text(&'static str),
    Octets(&'static [u8]),
}

impl Raw {
    /// As a specification and a setting write it.
    pub(crate) fn written(self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Real(number) => number.to_string(),
            Self::Text(text) => text.to_owned(),
            Self::Octets(octets) => {
                let digits: Vec<String> = octets.iter().map(|octet| format!("{octet:02X}")).collect();
                digits.concat()
            }
        }
    }

    /// As it is downloaded into an entry of a type: a number that does not fit takes as many bytes as it needs.
    pub(crate) fn bytes(self, data_type: DataType) -> Vec<u8> {
        match self {
            Self::Number(number) => {
                let size = usize::from(data_type.bits().unwrap_or(8).div_ceil(8));
                let fits = |size: &usize| {
                    let values = 1i128 << (8 * size);
                    let lowest = if data_type.is_signed() { -values / 2 } else { 0 };
                    (lowest..lowest + values).contains(&number)
                };
                number.to_le_bytes()[..(size..16).find(fits).unwrap()].to_vec()
            }
            Self::Real(number) => number.to_le_bytes().to_vec(),
            Self::Text(text) if data_type == DataType::UnicodeString => {
                text.encode_utf16().flat_map(u16::to_le_bytes).collect()
            }
            Self::Text(text) => text.as_bytes().to_vec(),
            Self::Octets(octets) => octets.to_vec(),
        }
    }

    /// As the model holds it.
    pub(crate) fn value(self) -> Value {
        match self {
            Self::Number(number) => Value::Integer(number),
            Self::Real(number) => Value::Real(f64::from(number).into()),
            Self::Text(text) => Value::Text(text.to_owned()),
            Self::Octets(octets) => Value::Bytes(octets.to_vec()),
        }
    }
}

/// An entry with the value that it is to have.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Set {
    pub(crate) id: EntryId,
    pub(crate) raw: Raw,
}

/// A number for an entry.
pub(crate) fn number(index: u16, sub: u8, number: i128) -> Set {
    set(index, sub, Raw::Number(number))
}

/// A value for an entry.
pub(crate) fn set(index: u16, sub: u8, raw: Raw) -> Set {
    Set { id: EntryId { index: Index(index), sub: SubIndex(sub) }, raw }
}

/// What all three say.
#[derive(Debug, Clone, Copy)]
enum Verdict {
    Accepted,
    /// The code of the rule, and the abort code of the device.
    Refused(&'static str, AbortCode),
}

/// What one of the three says instead, and why that is right.
#[derive(Debug, Clone)]
pub(crate) struct Exception {
    pub(crate) party: Party,
    said: Said,
    pub(crate) reason: Reason,
}

/// A case.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    /// What it is about.
    about: &'static str,
    /// The value in question first; after it what else has to be set for it.
    pub(crate) set: Vec<Set>,
    verdict: Verdict,
    pub(crate) exceptions: Vec<Exception>,
}

/// A value that all accept.
pub(crate) fn accepted(about: &'static str, set: &[Set]) -> Case {
    Case { about, set: set.to_vec(), verdict: Verdict::Accepted, exceptions: Vec::new() }
}

/// A value that all refuse: the rule's code, and the device's.
pub(crate) fn refused(about: &'static str, set: &[Set], rule: &'static str, abort: AbortCode) -> Case {
    Case { about, set: set.to_vec(), verdict: Verdict::Refused(rule, abort), exceptions: Vec::new() }
}

impl Case {
    /// With an exception.
    pub(crate) fn but(mut self, party: Party, said: Said, reason: Reason) -> Self {
        assert!(!self.exceptions.iter().any(|exception| exception.party == party), "{}", self.about);
        self.exceptions.push(Exception { party, said, reason });
        self
    }

    /// What one of the three says by the verdict.
    pub(crate) fn common(&self, party: Party) -> Said {
        match (self.verdict, party) {
            (Verdict::Accepted, _) => Said::Accepted,
            (Verdict::Refused(rule, _), Party::Specification | Party::Settings) => {
                Said::Refused(rule.to_owned())
            }
            (Verdict::Refused(_, abort), Party::Device) => Said::Aborted(abort),
        }
    }

    /// What one of the three has to say.
    pub(crate) fn expected(&self, party: Party) -> Said {
        let exception = self.exceptions.iter().find(|exception| exception.party == party);
        exception.map_or_else(|| self.common(party), |exception| exception.said.clone())
    }

    /// `2000h=-101 (below the low limit)`.
    pub(crate) fn title(&self) -> String {
        let set: Vec<String> = self.set.iter().map(|set| format!("{}={}", set.id, shown(set.raw))).collect();
        format!("{} ({})", set.join(", "), self.about)
    }
}

/// Large numbers are identifiers and mappings, which are not read in decimal.
fn shown(raw: Raw) -> String {
    match raw {
        Raw::Number(number @ 0x400..) => format!("{number:X}h"),
        Raw::Number(_) | Raw::Real(_) | Raw::Text(_) | Raw::Octets(_) => raw.written(),
    }
}
