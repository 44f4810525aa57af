//! Words for access, PDO mapping, storage, views, and for facts themselves.

use super::{Language, Notation, Word, Wording};
use crate::model::{
    Access, Alias, Category, Entry, ErratumKind, Outside, PdoMapping, Ratio, Rounding, Storage,
};

/// Facts of an entry or object by the names of departures and of `standard`, and their German words.
const FACTS: &[(&str, &str)] = &[
    ("about", "Beschreibung"),
    ("access", "Zugriff"),
    ("added", "zusätzlich"),
    ("alias", "Abbild"),
    ("bit-errors", "Fehlercodes der Bits"),
    ("bit-rates", "Bitraten"),
    ("capacity", "Kapazität"),
    ("category", "Kategorie"),
    ("count", "Anzahl"),
    ("default", "Vorgabe"),
    ("eds", "EDS"),
    ("elements", "Elemente"),
    ("granularity", "Granularität"),
    ("identifier", "Bezeichner"),
    ("max", "größter Wert"),
    ("meaning", "Bedeutung"),
    ("min", "kleinster Wert"),
    ("name", "Name"),
    ("no-rtr", "Remote-Frames"),
    ("object-type", "Objekttyp"),
    ("pdo", "PDO-Mapping"),
    ("since", "Ausgabe"),
    ("special", "besondere Werte"),
    ("stored", "Speicherung"),
    ("type", "Datentyp"),
    ("unit", "Einheit"),
    ("writable-when", "Schreibbedingung"),
];

/// Whether a fact has words.
#[cfg(test)]
pub(super) fn knows(name: &str) -> bool {
    FACTS.iter().any(|(known, _)| *known == name)
}

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

    /// A fact by its name, such as `unit`; one that is about some entries, as departures have it, with their place:
    /// `sub-indices 2 to 15: added`.
    pub fn fact(self, name: &str) -> String {
        let german = |word: &str| {
            FACTS
                .iter()
                .find(|(english, _)| *english == word)
                .map_or_else(|| word.to_owned(), |(_, german)| (*german).to_owned())
        };
        match (self.language, name.split_once(": ")) {
            (Language::English, _) => name.to_owned(),
            (Language::German, None) => german(name),
            (Language::German, Some((place, fact))) => {
                format!("{}: {}", german_place(place, german), german(fact))
            }
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

/// The entries that a departure is about: `elements`, `sub-index 2`, `sub-indices 2 to 15`.
fn german_place(place: &str, german: impl Fn(&str) -> String) -> String {
    if let Some(number) = place.strip_prefix("sub-index ") {
        return format!("Subindex {number}");
    }
    match place.strip_prefix("sub-indices ").and_then(|numbers| numbers.split_once(" to ")) {
        Some((first, last)) => format!("Subindizes {first} bis {last}"),
        None => german(place),
    }
}
