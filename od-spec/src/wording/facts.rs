//! Words for access, PDO mapping, storage, views, and for facts themselves.

use super::{Notation, Wording};
use crate::model::{
    Access, Alias, Category, Departure, Dictionary, Entry, EntryId, ErratumKind, ErrorKind, Fact, Index,
    Outside, Part, PdoMapping, Ratio, Rounding, Storage, SubIndex,
};

crate::texts! {
    /// A fixed word about a fact of an entry.
    pub enum Word in "facts" {
        ToRange = "to_range",
        From = "counted_from",
        NodeId = "node_id",
        NamelessBit = "nameless_bit",
        NamelessBits = "nameless_bits",
        Communication = "communication",
        Application = "application",
        Manufacturer = "manufacturer",
        Remanent = "remanent",
        StoredCommunication = "stored_communication",
        StoredWithAll = "stored_with_all",
        StoredApplication = "stored_application",
        StoredManufacturer = "stored_manufacturer",
        StoredRemanent = "stored_remanent",
        NotStored = "not_stored",
        CategoryMandatory = "mandatory",
        CategoryOptional = "optional",
        CategoryConditional = "conditional",
        OutsideAbort = "outside_abort",
        OutsideSaturate = "outside_saturate",
        OutsideWrap = "outside_wrap",
        RoundedDown = "rounded_down",
        RoundedNearest = "rounded_nearest",
        RoundedUp = "rounded_up",
        RoundedZero = "rounded_zero",
    }
}

crate::texts! {
    /// What part of an object a departure is about.
    enum PartWord in "departures" {
        Elements = "elements",
        Entry = "entry",
        Entries = "entries",
    }
}

impl Wording {
    /// A fixed word.
    pub fn word(self, word: Word) -> &'static str {
        word.text(self.language)
    }

    /// Access over the bus, with the lock that service opens.
    pub fn access(self, entry: &Entry) -> String {
        let word = entry.access.word();
        match self.notation {
            // The mapping column shows the direction, so that rwr and rww need no brackets of their own.
            Notation::Manual => match (entry.locked, entry.access) {
                (true, Access::Wo) => "(w)".to_owned(),
                (true, Access::Const | Access::Ro | Access::Rw | Access::Rwr | Access::Rww) => {
                    "r(w)".to_owned()
                }
                (false, _) => word.to_owned(),
            },
            Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic if entry.locked => {
                format!("{word} locked")
            }
            Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic => word.to_owned(),
        }
    }

    /// The PDOs into which an entry may be mapped; outside the documents' tables empty where there are none.
    pub const fn mapping(self, pdo: PdoMapping) -> &'static str {
        match (self.notation, pdo) {
            (Notation::Manual, PdoMapping::None) => "N",
            (Notation::Manual, PdoMapping::Receive) => "Y (R)",
            (Notation::Manual, PdoMapping::Transmit) => "Y (T)",
            (Notation::Manual, PdoMapping::Both) => "Y (RT)",
            (Notation::Json, pdo) => pdo.word(),
            (Notation::Eds | Notation::Rust | Notation::Diagnostic, PdoMapping::None) => "",
            (Notation::Eds | Notation::Rust | Notation::Diagnostic, PdoMapping::Receive) => "RPDO",
            (Notation::Eds | Notation::Rust | Notation::Diagnostic, PdoMapping::Transmit) => "TPDO",
            (Notation::Eds | Notation::Rust | Notation::Diagnostic, PdoMapping::Both) => "RPDO and TPDO",
        }
    }

    /// What keeps a value over power-off: a word in the documents' tables, a phrase elsewhere; empty where nothing does.
    pub fn storage(self, storage: Storage) -> &'static str {
        match (self.notation, storage) {
            (Notation::Json, storage) => storage.word(),
            (_, Storage::No) => "",
            (Notation::Manual, Storage::Communication) => self.word(Word::Communication),
            (Notation::Manual, Storage::Application) => self.word(Word::Application),
            (Notation::Manual, Storage::Manufacturer) => self.word(Word::Manufacturer),
            (Notation::Manual, Storage::Remanent) => self.word(Word::Remanent),
            (_, Storage::Communication) => "stored with the communication parameters",
            (_, Storage::Application) => "stored with the application parameters",
            (_, Storage::Manufacturer) => "stored with the manufacturer parameters",
            (_, Storage::Remanent) => "kept over power-off",
        }
    }

    /// The heading above all that is kept in one way.
    pub fn storage_group(self, storage: Storage) -> &'static str {
        self.word(match storage {
            Storage::No => Word::NotStored,
            Storage::Communication => Word::StoredCommunication,
            Storage::Application => Word::StoredApplication,
            Storage::Manufacturer => Word::StoredManufacturer,
            Storage::Remanent => Word::StoredRemanent,
        })
    }

    /// The same for a device, which may lack the command for communication parameters and save them with all others.
    pub fn storage_group_of(self, storage: Storage, device: &Dictionary) -> &'static str {
        let has = |sub: u8| device.entry(EntryId { index: Index(0x1010), sub: SubIndex(sub) }).is_some();
        if storage == Storage::Communication && has(1) && !has(2) {
            return self.word(Word::StoredWithAll);
        }
        self.storage_group(storage)
    }

    /// Whether a standard demands an object.
    pub fn category(self, category: Category) -> &'static str {
        self.word(match category {
            Category::Mandatory => Word::CategoryMandatory,
            Category::Optional => Word::CategoryOptional,
            Category::Conditional => Word::CategoryConditional,
        })
    }

    /// How a rescaling alias rounds.
    pub fn rounding(self, rounding: Rounding) -> &'static str {
        self.word(match rounding {
            Rounding::Down => Word::RoundedDown,
            Rounding::Up => Word::RoundedUp,
            Rounding::Nearest => Word::RoundedNearest,
            Rounding::Zero => Word::RoundedZero,
        })
    }

    /// How an alias converts: `× 0.1, rounded down; outside its range: the nearest value`.
    pub fn conversion(self, alias: &Alias) -> String {
        let outside = self.word(match alias.outside {
            Outside::Saturate => Word::OutsideSaturate,
            Outside::Wrap => Word::OutsideWrap,
            Outside::Abort => Word::OutsideAbort,
        });
        if alias.factor == Ratio::ONE {
            return outside.to_owned();
        }
        format!("× {}, {}; {outside}", self.decimal(&alias.factor.to_string()), self.rounding(alias.rounding))
    }

    /// A kind of fact: `unit`.
    pub fn fact(self, fact: Fact) -> &'static str {
        self.language.text("kinds of facts", fact.word())
    }

    /// A departure from a standard, with the entries that it is about: `name`, `elements: unit`,
    /// `sub-indices 2 to 15: added`.
    pub fn departure(self, departure: Departure) -> String {
        let fact = self.fact(departure.fact);
        match departure.part {
            Part::Object => fact.to_owned(),
            Part::Elements => PartWord::Elements.filled(self.language, &[fact]),
            Part::Entry(sub) => PartWord::Entry.filled(self.language, &[&sub.to_string(), fact]),
            Part::Entries { first, last } => {
                PartWord::Entries.filled(self.language, &[&first.to_string(), &last.to_string(), fact])
            }
        }
    }

    /// A kind of error, as a bit of the error register.
    pub fn error_kind(self, kind: ErrorKind) -> &'static str {
        self.language.text("kinds of errors", kind.word())
    }

    /// What kind of fact an erratum corrects.
    pub fn erratum_kind(self, kind: ErratumKind) -> &'static str {
        self.language.text("kinds of errata", kind.word())
    }
}
