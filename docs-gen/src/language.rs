//! The fixed words of the documents: headings, column titles, notes. Words about facts are those of [`od_spec::wording`].

use std::collections::BTreeMap;

use od_spec::wording::{self, Wording};

use crate::synonyms::{self, Synonyms};

macro_rules! words {
    ($($variant:ident $key:literal: $en:literal, $de:literal;)+) => {
        /// A heading, a column title or another fixed word of the documents.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub(crate) enum Word { $($variant,)+ }

        impl Word {
            /// The name by which templates know the word.
            pub(crate) const fn key(self) -> &'static str {
                match self { $(Word::$variant => $key,)+ }
            }

            const fn text(self, language: wording::Language) -> &'static str {
                match (self, language) {
                    $((Word::$variant, wording::Language::English) => $en,
                    (Word::$variant, wording::Language::German) => $de,)+
                }
            }

            const ALL: &'static [Word] = &[$(Word::$variant,)+];
        }
    };
}

words! {
    KeysHint "keys_hint":
        "/ search, ↓ ↑ results, Enter best result, Esc clear",
        "/ Suche, ↓ ↑ Treffer, Enter bester Treffer, Esc leeren";
    Shaded "shaded":
        "Shaded rows are kept over power-off: their Mem. is Y, or their column Stored says by what.",
        "Schattierte Zeilen überdauern das Ausschalten: bei ihnen steht Sp. auf Y, oder die Spalte Gespeichert nennt, wodurch.";
    Transitions "transitions": "transitions", "Übergänge";
    States "states": "states", "Zustände";
    Commands "commands": "commands", "Befehle";
    On "on": "Devices", "Geräte";
    Capacity "capacity": "At most {n} bytes.", "Höchstens {n} Byte.";
    And "and": "and", "und";
    Or "or": "or", "oder";
    Abbreviation "abbreviation": "Abbreviation", "Abkürzung";
    Access "access": "Attr", "Zugriff";
    Action "action": "Action", "Aktion";
    Active "active": "Active", "Aktiv";
    AlarmCode "alarm_code": "Error code", "Fehlercode";
    AddressDifference "address_difference": "Address difference", "Adressabstand";
    Alias "alias": "View", "Abbild";
    AliasOf "alias_of": "View of", "Abbild von";
    AfterPrinted "after_printed": "After the printed manual:", "Nach dem gedruckten Handbuch:";
    Aliases "aliases": "Aliases", "Abbilder";
    AliasesIntro "aliases_intro":
        "Objects that show another object in a narrower type or another unit. They have no value of their own: what is written to them goes to the object that they show.",
        "Objekte, die ein anderes Objekt in einem kleineren Typ oder einer anderen Einheit zeigen. Sie haben keinen eigenen Wert: was in sie geschrieben wird, geht an das gezeigte Objekt.";
    All "all": "all", "alle";
    AllBits "all_bits": "all bits", "alle Bits";
    AllTables "all_tables": "Index of tables", "Verzeichnis der Tabellen";
    BaseUnit "base_unit": "Base unit", "Basiseinheit";
    Appendix "appendix": "Appendix", "Anhang";
    Because "because": "Why", "Begründung";
    Before "before": "Before", "Vorher";
    Bit "bit": "Bit", "Bit";
    Bits "bits": "Bits", "Bits";
    BitOf "bit_of": "bit {n} of", "Bit {n} von";
    BitRates "bit_rates": "Bit rates", "Bitraten";
    BothEdges "both_edges": "0↔1", "0↔1";
    Block "block": "Block", "Block";
    Byte "byte": "Byte", "Byte";
    Category "category": "Category", "Kategorie";
    CausedBy "caused_by": "Caused by step", "Ausgelöst von Schritt";
    Chapters "chapters": "Chapters", "Kapitel";
    ChosenBy "chosen_by": "As chosen by {n}.", "Wie mit {n} gewählt.";
    Chooses "chooses": "Chooses the reaction to", "Wählt die Reaktion auf";
    Clamp "clamp": "Clamp", "Klemme";
    Compare "compare":
        "Show where the printed manual says something else", "Zeigen, wo das gedruckte Handbuch anderes sagt";
    CobId "cob_id": "COB-ID", "COB-ID";
    Command "command": "Command", "Befehl";
    CommunicationObjects "communication_objects": "Communication objects", "Kommunikationsobjekte";
    Condition "condition": "Condition", "Bedingung";
    Constraint "constraint": "Constraint", "Bedingung";
    Constraints "constraints": "Constraints", "Bedingungen";
    ConstraintsIntro "constraints_intro":
        "Conditions between entries that every configuration has to meet.",
        "Bedingungen zwischen Einträgen, die jede Parametrierung erfüllen muss.";
    Contents "contents": "Contents", "Inhalt";
    Copied "copied": "copied", "kopiert";
    Copy "copy": "Copy", "Kopieren";
    Date "date": "Date", "Datum";
    Default "default": "Default", "Vorgabe";
    Device "device": "Device", "Gerät";
    DeviceType "device_type": "Device type", "Gerätetyp";
    Does "does": "Function", "Funktion";
    DynamicChannels "dynamic_channels": "Dynamic channels", "Dynamische Kanäle";
    Differs "differs": "Differs from the standard in", "Weicht vom Standard ab in";
    ElementsOf "elements": "Entries", "Einträge";
    Enabled "enabled": "Active", "Aktiv";
    Errata "errata": "Errata", "Errata";
    ErrataIntro "errata_intro":
        "Where the printed manual says something else than this document, contradicts itself or says nothing, and why this document says what it says.",
        "Wo das gedruckte Handbuch etwas anderes sagt als dieses Dokument, sich widerspricht oder schweigt, und warum dieses Dokument sagt, was es sagt.";
    Erratum "erratum": "Erratum", "Erratum";
    ErrorCodes "error_codes": "Error codes", "Fehlercodes";
    ErrorRegister "error_register": "In 1001h", "In 1001h";
    Errors "errors": "Errors", "Fehler";
    ErrorsIntro "errors_intro":
        "From a code to its cause, to what the device does, to the bits that show it and to what resets it. A field that is empty is not stated.",
        "Von einem Code zur Ursache, zu dem, was das Gerät tut, zu den Bits, die ihn anzeigen, und zu dem, was ihn zurücksetzt. Was in einem leeren Feld stünde, ist nicht angegeben.";
    ErrorsUnsaid "errors_unsaid": "Not stated for any single code: {n}.", "Für keinen einzelnen Code angegeben: {n}.";
    EveryError "every_error": "What holds for every error", "Was für jeden Fehler gilt";
    Event "event": "Event", "Ereignis";
    EventTimer "event_timer": "Event timer", "Event-Timer";
    Facts "facts": "Device", "Gerät";
    Factor "factor": "Factor", "Faktor";
    Figure "figure": "Figure", "Abbildung";
    Formula "formula": "Formula", "Formel";
    From "from": "From", "Von";
    FromStandard "from_standard": "From", "Aus";
    FurtherObjects "further_objects": "Further objects", "Weitere Objekte";
    Gates "gates": "Decides about writing to", "Entscheidet über das Schreiben von";
    Generated "generated": "Table here", "Tabelle hier";
    GoesOffAt "goes_off_at": "Off again at", "Wieder aus bei";
    GoesOn "goes_on": "On at", "Ein bei";
    Index "index": "Index", "Index";
    IndexOfObjects "index_of_objects": "Index of objects", "Verzeichnis der Objekte";
    InhibitTime "inhibit_time": "Inhibit time", "Sperrzeit";
    Issue "issue": "Issue", "Ausgabe";
    Kind "kind": "Kind", "Art";
    Legend "legend":
        "Attr: ro can be read, wo written, rw both; rwr and rww are rw for TPDOs and RPDOs alone; r(w) can be read, and written once the device is unlocked for service, (w) only the latter; const never changes. Map: N not mappable, Y (R) into RPDOs, Y (T) into TPDOs, Y (RT) into both. Mem.: Y can be stored, N not. Behind a value with its unit stands in brackets the number that is transferred, where the two differ; special values are such numbers. What is in italics comes from a standard, not from the manual.",
        "Zugriff: ro ist lesbar, wo schreibbar, rw beides; rwr und rww sind rw nur für TPDOs und nur für RPDOs; r(w) ist lesbar und, wenn das Gerät für den Service entsperrt ist, schreibbar, (w) nur das Letztere; const ändert sich nie. Map: N nicht mappbar, Y (R) in RPDOs, Y (T) in TPDOs, Y (RT) in beide. Sp.: Y speicherbar, N nicht. Hinter einem Wert mit Einheit steht in Klammern die Zahl, die übertragen wird, wo beide sich unterscheiden; besondere Werte sind solche Zahlen. Was kursiv steht, stammt aus einem Standard und nicht aus dem Handbuch.";
    LegendOfEds "legend_of_eds":
        "Attr: ro can be read, wo written, rw both; rwr and rww are rw for TPDOs and RPDOs alone; r(w) can be read, and written once the device is unlocked for service, (w) only the latter; const never changes. Map: N not mappable, Y (R) into RPDOs, Y (T) into TPDOs, Y (RT) into both. Mem.: Y can be stored; about the others the EDS says nothing, and where it says it of none, the column is missing. Behind a value in a unit stands the raw value where the two differ; special values are raw.",
        "Zugriff: ro ist lesbar, wo schreibbar, rw beides; rwr und rww sind rw nur für TPDOs und nur für RPDOs; r(w) ist lesbar und, wenn das Gerät für den Service entsperrt ist, schreibbar, (w) nur das Letztere; const ändert sich nie. Map: N nicht mappbar, Y (R) in RPDOs, Y (T) in TPDOs, Y (RT) in beide. Sp.: Y speicherbar; über die anderen sagt die EDS nichts, und wo sie es von keinem sagt, fehlt die Spalte. Hinter einem Wert mit Einheit steht der Rohwert, wo beide sich unterscheiden; besondere Werte sind Rohwerte.";
    Links "links": "See also", "Siehe auch";
    ListOfFigures "list_of_figures": "Figures", "Abbildungen";
    ListOfTables "list_of_tables": "Tables", "Tabellen";
    LockedNote "locked": "Writable only when the device is unlocked for service.", "Nur schreibbar, wenn das Gerät für den Service entsperrt ist.";
    Machines "machines": "State machines", "Zustandsmaschinen";
    Manual "manual": "Manual", "Handbuch";
    ManufacturerObjects "manufacturer_objects": "Manufacturer-specific objects", "Herstellerspezifische Objekte";
    Map "map": "Map", "Map";
    Mark "mark": "Mark", "Marke";
    Mask "mask": "Mask", "Maske";
    Mnemonic "mnemonic": "Short", "Kürzel";
    Meaning "meaning": "Meaning", "Bedeutung";
    Mem "mem": "Mem.", "Sp.";
    Description "description": "Description", "Beschreibung";
    Name "name": "Name", "Name";
    No "no": "no", "nein";
    Note "note": "Note", "Hinweis";
    NoMatch "no_match":
        "Nothing fits. Escape clears the search.",
        "Nichts passt. Esc leert die Suche.";
    Notation "notation": "Notation", "Schreibweise";
    NotStated "not_stated": "not stated", "nicht angegeben";
    NotSupported "not_supported": "not supported", "nicht unterstützt";
    Number "number": "No.", "Nr.";
    Offset "offset": "Offset", "Offset";
    Object "object": "Object", "Objekt";
    Objects "objects": "Objects", "Objekte";
    ObjectsOutside "objects_outside":
        "The objects of the device that no chapter shows.",
        "Die Objekte des Geräts, die kein Kapitel zeigt.";
    Off "off": "off after start-up", "nach dem Einschalten aus";
    OffFrom "off_from": "Off value from", "Ausschaltwert aus";
    OnFrom "on_from": "On value from", "Einschaltwert aus";
    OnlyThere "only_there": "Only while", "Nur solange";
    OpenBits "open_bits":
        "x: a bit that the command leaves open; the code has it at 0, or at 1 where that stands in brackets.",
        "x: ein Bit, das der Befehl offenlässt; im Code ist es 0, oder 1, wo das in Klammern steht.";
    OrderCode "order_code": "Order code", "Bestellnummer";
    Parameter "parameter": "Parameter", "Parameter";
    Pattern "pattern": "Bits", "Bits";
    Pdo "pdo": "PDO", "PDO";
    Pdos "pdos": "PDOs", "PDOs";
    PdosIntro "pdos_intro":
        "Default mapping. Byte 0 is sent first; bit 0 is the least significant bit of a byte.",
        "Vorbelegung der PDOs. Byte 0 wird zuerst gesendet; Bit 0 ist das niederwertigste Bit eines Bytes.";
    Place "place": "Place", "Stelle";
    Prints "prints": "The manual prints", "Im Handbuch steht";
    Printed "printed": "Printed table", "Gedruckte Tabelle";
    Priority "priority": "Prio.", "Prio.";
    Product "product": "Product code", "Produktcode";
    ProductRevision "product_revision": "Product revision", "Produktrevision";
    ProfileObjects "profile_objects": "Device profile objects", "Objekte des Geräteprofils";
    Range "range": "Range", "Bereich";
    Reaction "reaction": "Reaction", "Reaktion";
    Reads "reads": "Read as", "Gelesen als";
    Reference "reference": "Object reference", "Objektreferenz";
    ReferenceIntro "reference_intro":
        "Every object of the device, also those of the communication profile and of the PDOs.",
        "Alle Objekte des Geräts, auch die des Kommunikationsprofils und der PDOs.";
    Relation "relation": "", "";
    ReportedBy "reported_by": "Shown by", "Angezeigt von";
    ResetBy "reset_by": "Reset by", "Zurückgesetzt durch";
    Reserved "reserved": "reserved", "reserviert";
    Revision "revision": "Issue", "Ausgabe";
    Search "search": "Search", "Suche";
    Results "results": "Results", "Treffer";
    ResultsElsewhere "results_elsewhere": "On other pages", "Auf anderen Seiten";
    ResultsMore "results_more": "more results", "weitere Treffer";
    ResultsSimilar "results_similar":
        "Nothing fits exactly; this is similar.",
        "Nichts passt genau; dies ist ähnlich.";
    RowsAll "rows_all": "Show all rows", "Alle Zeilen zeigen";
    SearchHint "search_hint": "index, name or word", "Index, Name oder Wort";
    Section "section": "Section", "Abschnitt";
    Send "send": "Code", "Code";
    SetByDefault "set_by_default": "Set by default: {n}.", "Als Vorgabe gesetzt: {n}.";
    Since "since": "Since issue", "Seit Ausgabe";
    SkipLink "skip": "Skip to the objects", "Zu den Objekten";
    SkipContents "skip_contents": "Skip to the text", "Zum Text";
    Span "span": "Span", "Strecke";
    State "state": "State", "Zustand";
    Status "status": "Status", "Status";
    Storage "storage": "Storage", "Speicherung";
    StorageIntro "storage_intro":
        "What is kept over power-off: the entries that each command of store parameters saves and that restore default parameters sets back, and what the device keeps by itself.",
        "Was das Ausschalten überdauert: die Einträge, die jeder Befehl zum Speichern der Parameter sichert und der zum Wiederherstellen der Vorgaben zurücksetzt, und was das Gerät von sich aus hält.";
    StorageRestore "storage_restore":
        "To restore the defaults, write 64616F6Ch (load) to the same sub-index of 1011h and reset the device.",
        "Zum Wiederherstellen der Vorgaben 64616F6Ch (load) in denselben Subindex von 1011h schreiben und das Gerät zurücksetzen.";
    StorageSave "storage_save":
        "To save, write 65766173h (save) to the sub-index of 1010h that stands above the table.",
        "Zum Speichern 65766173h (save) in den Subindex von 1010h schreiben, der über der Tabelle steht.";
    Stored "stored": "Stored", "Gespeichert";
    Step "step": "One step", "Ein Schritt";
    StepNumber "step_number": "Step", "Schritt";
    SwitchedOff "switched_off": "off", "aus";
    SwitchedOn "switched_on": "on", "ein";
    Switches "switches": "Switches", "Schaltet";
    SubIndex "sub": "Sub-Index", "Subindex";
    Sub "sub_short": "Sub", "Sub";
    Supported "supported": "Supported", "Unterstützt";
    Symbol "symbol": "Symbol", "Zeichen";
    SyncStart "sync_start": "SYNC start value", "SYNC-Startwert";
    Table "table": "Table", "Tabelle";
    TablesIntro "tables_intro":
        "Every table of the printed manual, the table of this document that takes its place, and the errata about it. The file tables.json lists them for programs, fact by fact.",
        "Jede Tabelle des gedruckten Handbuchs, die Tabelle dieses Dokuments, die an ihre Stelle tritt, und die Errata dazu. Die Datei tables.json führt sie für Programme einzeln auf.";
    DiffersCount "differs_count": "Errata", "Errata";
    TakesFrom "takes_from": "Takes from", "Bekommt von";
    Target "target": "Shows", "Zeigt";
    Theme "theme": "Light or dark", "Hell oder dunkel";
    To "to": "To", "Nach";
    Transition "transition": "Transition", "Übergang";
    Transmission "transmission": "Transmission type", "Übertragungsart";
    Type "type": "Type", "Typ";
    Unit "unit": "Unit", "Einheit";
    Units "units": "Units", "Einheiten";
    UnitsIntro "units_intro":
        "What one step of a raw value is worth, and which entries are in the unit.",
        "Was ein Schritt des Rohwerts wert ist, und welche Einträge die Einheit haben.";
    Unused "unused": "free", "frei";
    UsedBy "used_by": "Entries", "Einträge";
    Value "value": "Value", "Wert";
    Values "values": "Values", "Werte";
    Vendor "vendor": "Vendor", "Hersteller";
    Warning "warning": "Warning", "Warnung";
    Warnings "warnings": "Warnings", "Warnungen";
    WarningsIntro "warnings_intro":
        "Every warning of this manual, with the place where it stands: first those of the chapters, then those of the objects. Read them before commissioning; each counts together with what stands around it.",
        "Alle Warnungen dieses Handbuchs mit der Stelle, an der sie stehen: zuerst die der Kapitel, dann die der Objekte. Vor der Inbetriebnahme lesen; jede gilt zusammen mit dem, was um sie herum steht.";
    WritableWhen "writable_when": "Writable while", "Schreibbar, solange";
    Yes "yes": "yes", "ja";
}

/// Kinds of tables by the key of the specification that fills them, and their German names.
const TABLE_KINDS: &[(&str, &str)] = &[
    ("axis", "Achse"),
    ("bits", "Bits"),
    ("commands", "Befehle"),
    ("errors", "Fehlercodes"),
    ("flow", "Blockbild"),
    ("glossary", "Glossar"),
    ("history", "Änderungen"),
    ("hysteresis", "Hysterese"),
    ("ladder", "Stufenfolge"),
    ("objects", "Objekte"),
    ("overview", "Übersicht"),
    ("pdos", "PDOs"),
    ("reactions", "Reaktionen"),
    ("rows", "Zeilen"),
    ("states", "Zustände"),
    ("timing", "Ablauf"),
    ("transitions", "Übergänge"),
    ("values", "Werte"),
];

/// Languages whose fixed words are known; others get English words.
pub const LANGUAGES: &[&str] = wording::Language::CODES;

/// The language of a document.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Language<'a> {
    /// Its code, by which texts of the specification are chosen.
    pub code: &'a str,
}

impl Language<'_> {
    /// The language of fixed words.
    fn known(self) -> wording::Language {
        wording::Language::of(self.code)
    }

    /// How documents in this language word facts.
    pub(crate) fn wording(self) -> Wording {
        Wording::manual(self.known())
    }

    /// A fixed word.
    pub(crate) fn word(self, word: Word) -> &'static str {
        word.text(self.known())
    }

    /// Phrases that a search takes for one another.
    pub(crate) fn synonyms(self) -> Vec<Synonyms> {
        synonyms::of(self.known())
    }

    /// All fixed words by the names that templates use, also those about facts.
    pub(crate) fn words(self) -> BTreeMap<&'static str, &'static str> {
        let facts = wording::Word::ALL.iter().map(|word| (word.key(), word.text(self.known())));
        Word::ALL.iter().map(|word| (word.key(), self.word(*word))).chain(facts).collect()
    }

    /// What fills a table, as a person says it.
    pub(crate) fn table_kind(self, kind: &'static str) -> &'static str {
        match self.known() {
            wording::Language::English => kind,
            wording::Language::German => {
                TABLE_KINDS.iter().find(|(key, _)| *key == kind).map_or(kind, |(_, german)| german)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_has_one_key() {
        let language = Language { code: "en" };
        assert_eq!(language.words().len(), Word::ALL.len() + wording::Word::ALL.len());
    }

    #[test]
    fn every_kind_of_table_has_a_german_name() {
        let german = Language { code: "de" };
        assert_eq!(
            (german.table_kind("overview"), german.table_kind("ladder")),
            ("Übersicht", "Stufenfolge")
        );
        assert_eq!(Language { code: "en" }.table_kind("ladder"), "ladder");
        assert_eq!((german.word(Word::Value), Language { code: "fr" }.word(Word::Value)), ("Wert", "Value"));
    }
}
