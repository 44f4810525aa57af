//! The words of a dictionary's facts, in one place: how a value, a range, an access, a unit, a storage group or a PDO mapping
//! reads in an EDS comment, in the documents, in Rust documentation, in the JSON dump and in a message.
//!
//! A place has a [`Notation`] and a [`Language`]; together they are a [`Wording`]. Every output asks here, so that no two can
//! say different things about one fact. The rules, one for each kind:
//!
//! - **Number.** Whether a number is a pattern or a count is decided by the entry and is the same in every notation
//!   ([`Radix`]): bit fields and the identities, COB-IDs and mapping parameters of the communication profile (UNSIGNED32
//!   from 1000h to 1FFFh without a unit) are patterns, everything else is a count. A pattern has as many hexadecimal digits as its type: `00FFh`
//!   in the documents, as the manuals and the standards print it, and `0x00FF` where a program or a tool reads the place. A
//!   count is decimal.
//! - **Special value.** Its number is written in one way, [`Wording::special`]: as a pattern where the standards print one
//!   (`FFFFFFFFh`, `65766173h`), that is for a bit field, for more than 16 bits, and for an unsigned value whose highest byte
//!   is FFh; else in decimal. Signed values stay decimal, as the manuals print them (`-32768`) and CiA 306 demands them:
//!   `8000h` would not show its sign. As a value it is `number (name)`, in a list `number: name`.
//! - **Value of an enum.** `number: name` for those who send numbers over the bus, the readers of an EDS and of the manual;
//!   the name alone for those who write the name: in Rust, in a specification (messages), and in JSON, where the number
//!   is next to it. The number is decimal; the manual adds its pattern, `-113 (8Fh)`, where that reads otherwise.
//! - **Value of a bit field.** The pattern; what is set in it, one field after the other ([`Wording::set_bits`]), follows where a
//!   person reads single values: the name, or `name = value` for a run of bits.
//! - **Physical value.** With its unit: `50.0 °C`. The raw value follows in brackets where it is another number and the
//!   reader has to send it: in an EDS and in the manual, `50.0 °C (500)`. Rust converts, JSON has the raw value next
//!   to it, and a specification takes either.
//! - **Range.** `a to b`, `≥ a`, `≤ b`, each end like a value ("at least", "at most" in an EDS, which is ASCII). A limit that
//!   the data type has anyhow, and those of an enum, are not a range: its values are. A message names both ends,
//!   always.
//! - **Identifier.** Indices and error codes are names more than numbers: `6040h` and `8611h`, the field's notation, wherever a
//!   person reads.
//! - **Node-ID formula.** `180h + node-ID` in the documents, `$NODEID+0x180` elsewhere, as CiA 306 has it.
//! - **Text.** As it is; `""` for an empty one where a reader would take nothing for "no default". **Bytes**: pairs of digits;
//!   with spaces for people, without where a tool may copy them.
//! - **Access.** The specification's word. A lock is `r(w)` or `(w)` in the manual, `rw locked` in Rust and a sentence in the
//!   EDS, whose own access says `ro` then.
//! - **Unit.** One raw step with the symbol, `0.1 °C`; a step of 1 is the symbol alone. Where the raw value 0 is not 0, what it is
//!   follows: `0.1 °C from -40 °C`.
//! - **Storage, PDO mapping.** A word in the documents' tables, a phrase elsewhere; see [`storage`](Wording::storage) and
//!   [`mapping`](Wording::mapping).
//! - **Facts.** The words for facts themselves (`default`, `special`), which are used in departures from a standard and
//!   kinds of errata, are [`Wording::fact`].
//!
//! Numbers and words follow the language in the documents alone; all other places are English.
//!
//! ```
//! use od_spec::model::{DataType, PdoMapping, Storage};
//! use od_spec::wording::{Language, Notation, Wording};
//!
//! let (eds, manual) = (Wording::english(Notation::Eds), Wording::manual(Language::GERMAN));
//! assert_eq!(eds.pattern(DataType::Integer16, -1), "0xFFFF");
//! assert_eq!(manual.pattern(DataType::Integer16, -1), "FFFFh");
//! assert_eq!(eds.storage(Storage::Application), "stored with the application parameters");
//! assert_eq!(manual.storage(Storage::Application), "Anwendung");
//! assert_eq!((eds.mapping(PdoMapping::Receive), manual.mapping(PdoMapping::Receive)), ("RPDO", "Y (R)"));
//! ```

mod bits;
mod facts;
mod file_keys;
mod language;
mod number;
mod range;
#[cfg(test)]
mod tests;
mod value;

pub use facts::Word;
pub(crate) use file_keys::{FileFormat, Key};
pub use language::{Language, Line, Texts, filled};
pub use number::Radix;
pub use range::Limits;
pub use value::{allowed, format_value};

/// The kind of place that a word is in, which is the kind of its reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Notation {
    /// A comment of an EDS or DCF: read by who integrates the device into a PLC and sends raw numbers. ASCII in the end.
    Eds,
    /// The reference documents: read at commissioning, together with the printed manual.
    Manual,
    /// Documentation of generated code, Rust or C: read by who writes the firmware.
    Rust,
    /// `text` in the JSON dump, next to the raw value.
    Json,
    /// A message about a specification or a setting: read by who writes it.
    Diagnostic,
}

/// How a place words facts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wording {
    /// The kind of place.
    pub notation: Notation,
    /// The language of words and decimal signs.
    pub language: Language,
}

impl Wording {
    /// The reference documents in a language.
    pub const fn manual(language: Language) -> Self {
        Self { notation: Notation::Manual, language }
    }

    /// Any other place; these are in English.
    pub const fn english(notation: Notation) -> Self {
        Self { notation, language: Language::ENGLISH }
    }
}
