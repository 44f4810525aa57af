//! Words for access, PDO mapping, storage, views, and for facts themselves.

use super::{Language, Notation, Word, Wording};
use crate::model::{
    Access, Alias, Category, Departure, Dictionary, Entry, EntryId, ErratumKind, ErrorKind, Fact, Index,
    Outside, Part, PdoMapping, Ratio, Rounding, Storage, SubIndex,
};

impl Wording {
    /// A fixed word.
    pub const fn word(self, word: Word) -> &'static str {
        word.text(self.language)
    }

    /// Access over the bus, with the lock that service opens.
    pub fn access(self, entry: &Entry) -> String {
        let word = entry.access.word();
        match self.notation {
            // The mapping column tells the direction, so that rwr and rww need no brackets of their own.
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
    pub const fn storage(self, storage: Storage) -> &'static str {
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
    pub const fn storage_group(self, storage: Storage) -> &'static str {
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
    pub const fn category(self, category: Category) -> &'static str {
        self.word(match category {
            Category::Mandatory => Word::CategoryMandatory,
            Category::Optional => Word::CategoryOptional,
            Category::Conditional => Word::CategoryConditional,
        })
    }

    /// How a rescaling alias rounds.
    pub const fn rounding(self, rounding: Rounding) -> &'static str {
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
    pub const fn fact(self, fact: Fact) -> &'static str {
        match self.language {
            Language::English => fact.word(),
            Language::German => match fact {
                Fact::Name => "Name",
                Fact::ObjectType => "Objekttyp",
                Fact::Count => "Anzahl",
                Fact::Presence => "zusätzlich",
                Fact::Type => "Datentyp",
                Fact::Meaning => "Bedeutung",
                Fact::Unit => "Einheit",
                Fact::Access => "Zugriff",
                Fact::Mapping => "PDO-Mapping",
                Fact::Default => "Vorgabe",
                Fact::LowLimit => "kleinster Wert",
                Fact::HighLimit => "größter Wert",
                Fact::Special => "besondere Werte",
                Fact::Storage => "Speicherung",
                Fact::Category => "Kategorie",
                Fact::Since => "Ausgabe",
                Fact::WriteCondition => "Schreibbedingung",
                Fact::BitErrors => "Fehlercodes der Bits",
                Fact::Capacity => "Kapazität",
                Fact::Identifier => "Bezeichner",
                Fact::Eds => "EDS",
                Fact::Links => "verknüpfte Objekte",
                Fact::Warning => "Warnung",
                Fact::About => "Beschreibung",
                Fact::Alias => "Abbild",
                Fact::RemoteFrames => "Remote-Frames",
                Fact::BitRates => "Bitraten",
                Fact::Granularity => "Granularität",
                Fact::Map => "PDO-Inhalt",
                Fact::Vendor => "Hersteller",
                Fact::Product => "Produkt",
                Fact::ProductRevision => "Produktrevision",
                Fact::DeviceType => "Gerätetyp",
                Fact::BootUp => "Hochlauf",
                Fact::GroupMessaging => "Gruppennachrichten",
                Fact::Lss => "LSS",
                Fact::Dummies => "Platzhalter",
                Fact::DynamicChannels => "dynamische Kanäle",
                Fact::PdoCount => "PDOs",
                Fact::Requirement => "Forderung",
                Fact::Reaction => "Reaktion",
                Fact::Shown => "angezeigt durch",
                Fact::Reset => "Rücksetzen",
                Fact::OptionCode => "wählt die Reaktion",
                Fact::Register => "Fehlerregister",
                Fact::Priority => "Priorität",
                Fact::Languages => "Sprachen",
                Fact::Document => "Dokument",
                Fact::Errata => "Errata",
                Fact::Node => "Knoten",
            },
        }
    }

    /// A departure from a standard, with the entries that it is about: `name`, `elements: unit`,
    /// `sub-indices 2 to 15: added`.
    pub fn departure(self, departure: Departure) -> String {
        let fact = self.fact(departure.fact);
        match (self.language, departure.part) {
            (Language::English | Language::German, Part::Object) => fact.to_owned(),
            (Language::English, Part::Elements) => format!("elements: {fact}"),
            (Language::German, Part::Elements) => format!("Elemente: {fact}"),
            (Language::English, Part::Entry(sub)) => format!("sub-index {sub}: {fact}"),
            (Language::German, Part::Entry(sub)) => format!("Subindex {sub}: {fact}"),
            (Language::English, Part::Entries { first, last }) => {
                format!("sub-indices {first} to {last}: {fact}")
            }
            (Language::German, Part::Entries { first, last }) => {
                format!("Subindizes {first} bis {last}: {fact}")
            }
        }
    }

    /// A kind of error, as a bit of the error register.
    pub const fn error_kind(self, kind: ErrorKind) -> &'static str {
        match (self.language, kind) {
            (Language::English, kind) => kind.word(),
            (Language::German, ErrorKind::Generic) => "allgemein",
            (Language::German, ErrorKind::Current) => "Strom",
            (Language::German, ErrorKind::Voltage) => "Spannung",
            (Language::German, ErrorKind::Temperature) => "Temperatur",
            (Language::German, ErrorKind::Communication) => "Kommunikation",
            (Language::German, ErrorKind::Profile) => "Geräteprofil",
            (Language::German, ErrorKind::Manufacturer) => "Hersteller",
        }
    }

    /// What kind of fact an erratum corrects.
    pub const fn erratum_kind(self, kind: ErratumKind) -> &'static str {
        match self.language {
            Language::English => kind.word(),
            Language::German => match kind {
                ErratumKind::Index => "Index",
                ErratumKind::Name => "Name",
                ErratumKind::Type => "Datentyp",
                ErratumKind::Sign => "Vorzeichen",
                ErratumKind::Access => "Zugriff",
                ErratumKind::ObjectType => "Objekttyp",
                ErratumKind::SubIndex => "Subindex",
                ErratumKind::Count => "Anzahl",
                ErratumKind::Default => "Vorgabe",
                ErratumKind::Limit => "Grenze",
                ErratumKind::Unit => "Einheit",
                ErratumKind::Pdo => "PDO-Mapping",
                ErratumKind::Stored => "Speicherung",
                ErratumKind::Bits => "Bits",
                ErratumKind::Values => "Werte",
                ErratumKind::Table => "Tabelle",
                ErratumKind::Text => "Text",
                ErratumKind::Gap => "Lücke",
                ErratumKind::Profile => "Profil",
            },
        }
    }
}
