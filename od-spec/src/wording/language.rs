//! Languages, and the fixed words for facts in each.

/// A language whose words are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Language {
    /// English, also for languages whose words are not known.
    English,
    /// German.
    German,
}

impl Language {
    /// Codes of the languages whose words are known.
    pub const CODES: &'static [&'static str] = &["en", "de"];

    /// The language of a code such as `de` or `de-AT`.
    pub fn of(code: &str) -> Self {
        if code == "de" || code.starts_with("de-") { Self::German } else { Self::English }
    }

    /// A number that was written with a decimal point, as the language writes it.
    pub fn decimal(self, number: &str) -> String {
        match self {
            Self::English => number.to_owned(),
            Self::German => number.replace('.', ","),
        }
    }

    /// A date: `2009-05-27`, in German `27.05.2009`.
    pub fn date(self, date: crate::model::Date) -> String {
        let crate::model::Date { year, month, day } = date;
        match self {
            Self::English => format!("{year:04}-{month:02}-{day:02}"),
            Self::German => format!("{day:02}.{month:02}.{year:04}"),
        }
    }
}

macro_rules! words {
    ($($(#[$meta:meta])* $variant:ident $key:literal: $english:literal, $german:literal;)+) => {
        /// A fixed word about a fact of an entry, in every language.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Word { $($(#[$meta])* $variant,)+ }

        impl Word {
            /// All words.
            pub const ALL: &'static [Word] = &[$(Word::$variant,)+];

            /// The name by which templates know the word.
            pub const fn key(self) -> &'static str {
                match self { $(Word::$variant => $key,)+ }
            }

            /// The word in a language.
            pub const fn text(self, language: Language) -> &'static str {
                match (self, language) {
                    $((Word::$variant, Language::English) => $english,
                    (Word::$variant, Language::German) => $german,)+
                }
            }
        }
    };
}

words! {
    /// Between the ends of a range.
    ToRange "to_range": "to", "bis";
    /// Between a raw step and what the raw value 0 stands for.
    From "counted_from": "from", "ab";
    /// The node-ID in a formula.
    NodeId "node_id": "node-ID", "Node-ID";
    /// A bit without a name.
    NamelessBit "nameless_bit": "bit", "Bit";
    /// Bits without a name.
    NamelessBits "nameless_bits": "bits", "Bits";
    /// Kept with the communication parameters, in a table.
    Communication "communication": "communication", "Kommunikation";
    /// Kept with the application parameters, in a table.
    Application "application": "application", "Anwendung";
    /// Kept with the manufacturer parameters, in a table.
    Manufacturer "manufacturer": "manufacturer", "Hersteller";
    /// Kept by the device itself, in a table.
    Remanent "remanent": "by itself", "von selbst";
    /// Heading of what is kept with the communication parameters.
    StoredCommunication "stored_communication": "1010h.2, communication parameters", "1010h.2, Kommunikationsparameter";
    /// Heading of communication parameters of a device that saves all parameters together.
    StoredWithAll "stored_with_all": "1010h.1, communication parameters with all others", "1010h.1, Kommunikationsparameter mit allen anderen";
    /// Heading of what is kept with the application parameters.
    StoredApplication "stored_application": "1010h.3, application parameters", "1010h.3, Anwendungsparameter";
    /// Heading of what is kept with the manufacturer parameters.
    StoredManufacturer "stored_manufacturer": "1010h.4 and above, manufacturer parameters", "1010h.4 und höher, Herstellerparameter";
    /// Heading of what the device keeps by itself.
    StoredRemanent "stored_remanent": "by the device itself", "vom Gerät selbst";
    /// Heading of what is lost at power-off.
    NotStored "not_stored": "not stored", "nicht gespeichert";
    /// A category of a standard.
    CategoryMandatory "mandatory": "mandatory", "verpflichtend";
    /// A category of a standard.
    CategoryOptional "optional": "optional", "optional";
    /// A category of a standard.
    CategoryConditional "conditional": "conditional", "bedingt";
    /// An alias refuses what it cannot show.
    OutsideAbort "outside_abort": "outside its range: abort", "außerhalb seines Bereichs: Abbruch";
    /// An alias shows the nearest value.
    OutsideSaturate "outside_saturate":
        "outside its range: the nearest value",
        "außerhalb seines Bereichs: der nächstgelegene Wert";
    /// An alias shows the low bits.
    OutsideWrap "outside_wrap": "outside its range: the low bits", "außerhalb seines Bereichs: die unteren Bits";
    /// An alias rounds towards minus infinity.
    RoundedDown "rounded_down": "rounded down", "nach unten gerundet";
    /// An alias rounds to the nearest step.
    RoundedNearest "rounded_nearest": "rounded to the nearest step", "auf den nächstgelegenen Schritt gerundet";
    /// An alias rounds towards plus infinity.
    RoundedUp "rounded_up": "rounded up", "nach oben gerundet";
    /// An alias rounds towards zero.
    RoundedZero "rounded_zero": "rounded towards zero", "zur Null hin gerundet";
}
