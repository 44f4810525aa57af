//! The language of a document: its fixed words, and what its texts are called by.

use std::collections::BTreeMap;

use od_spec::wording::{self, Wording};

od_spec::texts! {
    /// A fixed word of the documents that is chosen here. Templates know all of the section, by their keys.
    pub(crate) enum Word in "documents" {
        Abbreviation = "abbreviation",
        Access = "access",
        Action = "action",
        Active = "active",
        AddressDifference = "address_difference",
        AlarmCode = "alarm_code",
        Alias = "alias",
        AliasOf = "alias_of",
        Aliases = "aliases",
        AliasesIntro = "aliases_intro",
        All = "all",
        AllBits = "all_bits",
        AllTables = "all_tables",
        And = "and",
        AnyColumn = "any_column",
        Appendix = "appendix",
        Assumed = "assumed",
        AssumedFacts = "assumed_facts",
        BaseUnit = "base_unit",
        Because = "because",
        Before = "before",
        Bit = "bit",
        BitOf = "bit_of",
        BitRates = "bit_rates",
        Bits = "bits",
        Block = "block",
        BothEdges = "both_edges",
        Brings = "brings",
        Byte = "byte",
        Capacity = "capacity",
        Category = "category",
        CausedBy = "caused_by",
        Change = "change",
        ChangedSince = "changed_since",
        Changes = "changes",
        ChangesIntro = "changes_intro",
        Chooses = "chooses",
        ChosenBy = "chosen_by",
        Clamp = "clamp",
        Column = "column",
        CobId = "cob_id",
        Command = "command",
        Commands = "commands",
        CommunicationObjects = "communication_objects",
        Condition = "condition",
        Consequence = "consequence",
        Constraint = "constraint",
        Constraints = "constraints",
        ConstraintsIntro = "constraints_intro",
        Date = "date",
        Default = "default",
        Description = "description",
        Device = "device",
        DeviceType = "device_type",
        Differs = "differs",
        DiffersCount = "differs_count",
        Does = "does",
        DynamicChannels = "dynamic_channels",
        ElementsOf = "elements",
        Enabled = "enabled",
        Errata = "errata",
        ErrataIntro = "errata_intro",
        ErrorCodes = "error_codes",
        ErrorRegister = "error_register",
        Errors = "errors",
        ErrorsIntro = "errors_intro",
        ErrorsUnsaid = "errors_unsaid",
        Event = "event",
        EventTimer = "event_timer",
        EveryError = "every_error",
        Factor = "factor",
        Extends = "extends",
        Facts = "facts",
        Figure = "figure",
        Formula = "formula",
        From = "from",
        FromStandard = "from_standard",
        FurtherObjects = "further_objects",
        Gap = "gap",
        Gates = "gates",
        Generated = "generated",
        GoesOffAt = "goes_off_at",
        GoesOn = "goes_on",
        Index = "index",
        InhibitTime = "inhibit_time",
        Issue = "issue",
        Kind = "kind",
        Links = "links",
        ListOfFigures = "list_of_figures",
        LockedNote = "locked",
        Machines = "machines",
        ManufacturerObjects = "manufacturer_objects",
        Map = "map",
        Mark = "mark",
        Mask = "mask",
        Meaning = "meaning",
        Mem = "mem",
        Mnemonic = "mnemonic",
        Modules = "modules",
        Name = "name",
        Notation = "notation",
        NotationConst = "notation_const",
        NotationAssumedMeaning = "notation_assumed_meaning",
        NotationItalics = "notation_italics",
        NotationItalicsMeaning = "notation_italics_meaning",
        NotationMapBoth = "notation_map_both",
        NotationMapNone = "notation_map_none",
        NotationMapReceive = "notation_map_receive",
        NotationMapTransmit = "notation_map_transmit",
        NotationNotStored = "notation_not_stored",
        NotationRaw = "notation_raw",
        NotationRead = "notation_read",
        NotationReadUnlocked = "notation_read_unlocked",
        NotationReadWrite = "notation_read_write",
        NotationReadWriteReceive = "notation_read_write_receive",
        NotationReadWriteTransmit = "notation_read_write_transmit",
        NotationStored = "notation_stored",
        NotationStoredInEds = "notation_stored_in_eds",
        NotationUnlocked = "notation_unlocked",
        NotationWrite = "notation_write",
        No = "no",
        NotStated = "not_stated",
        NotSupported = "not_supported",
        Number = "number",
        Object = "object",
        Objects = "objects",
        Off = "off",
        OffFrom = "off_from",
        Offset = "offset",
        On = "on",
        OnFrom = "on_from",
        OnlyThere = "only_there",
        OpenBits = "open_bits",
        OpenQuestion = "open_question",
        OpenQuestions = "open_questions",
        OpenQuestionsIntro = "open_questions_intro",
        Or = "or",
        OrderCode = "order_code",
        Parameter = "parameter",
        Pattern = "pattern",
        Pdo = "pdo",
        Pdos = "pdos",
        Place = "place",
        Printed = "printed",
        Prints = "prints",
        Priority = "priority",
        Product = "product",
        ProductRevision = "product_revision",
        ProfileObjects = "profile_objects",
        Range = "range",
        Reaction = "reaction",
        Reads = "reads",
        Relation = "relation",
        ReportedBy = "reported_by",
        Reserved = "reserved",
        ResetBy = "reset_by",
        Section = "section",
        Send = "send",
        SetByDefault = "set_by_default",
        Since = "since",
        Span = "span",
        State = "state",
        States = "states",
        Status = "status",
        Step = "step",
        StepNumber = "step_number",
        Storage = "storage",
        StorageIntro = "storage_intro",
        StorageRestore = "storage_restore",
        StorageSave = "storage_save",
        Stored = "stored",
        Sub = "sub_short",
        SubIndex = "sub",
        Supported = "supported",
        SwitchedOff = "switched_off",
        SwitchedOn = "switched_on",
        Switches = "switches",
        Symbol = "symbol",
        SyncStart = "sync_start",
        Table = "table",
        TablesIntro = "tables_intro",
        TakesFrom = "takes_from",
        Target = "target",
        To = "to",
        Transition = "transition",
        Transitions = "transitions",
        Transmission = "transmission",
        Type = "type",
        Unit = "unit",
        Units = "units",
        UnitsIntro = "units_intro",
        Untranslated = "untranslated",
        Unused = "unused",
        UsedBy = "used_by",
        Value = "value",
        Values = "values",
        Vendor = "vendor",
        Warning = "warning",
        WritableWhen = "writable_when",
        Yes = "yes",
    }
}

/// Phrases that mean the same. A search for one of them finds the others.
pub(crate) type Synonyms = Vec<&'static str>;

/// The language of a document.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Language<'a> {
    /// Its code, by which texts of the specification are chosen.
    pub code: &'a str,
    /// The language of fixed words.
    pub words: wording::Language,
}

impl Language<'_> {
    /// How documents in this language word facts.
    pub(crate) fn wording(self) -> Wording {
        Wording::manual(self.words)
    }

    /// A fixed word.
    pub(crate) fn word(self, word: Word) -> &'static str {
        word.text(self.words)
    }

    /// Phrases that a search takes for one another. Names of objects are English everywhere.
    pub(crate) fn synonyms(self) -> Vec<Synonyms> {
        let english = wording::Language::ENGLISH;
        let own = (self.words != english).then(|| self.words.section("search"));
        let all = own.into_iter().flatten().chain(english.section("search"));
        all.map(|(phrase, others)| std::iter::once(phrase).chain(others.split(", ")).collect()).collect()
    }

    /// All fixed words by the names that templates use, also those about facts.
    pub(crate) fn words(self) -> BTreeMap<&'static str, &'static str> {
        let of_section = |section: &'static str| {
            let keys = wording::Language::ENGLISH.section(section);
            keys.map(move |(key, _)| (key, self.words.text(section, key)))
        };
        of_section("documents").chain(of_section("facts")).collect()
    }

    /// What a language is called; its code where that is not known.
    pub(crate) fn name_of(self, code: &str) -> &str {
        self.words.section("languages").find(|(key, _)| *key == code).map_or(code, |(_, name)| name)
    }

    /// What fills a table, as a person says it.
    pub(crate) fn table_kind(self, kind: &'static str) -> &'static str {
        self.words.text("kinds of tables", kind)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn language(code: &str) -> Language<'_> {
        Language { code, words: wording::Language::of(code) }
    }

    #[test]
    fn every_word_is_in_the_files() {
        let documents: BTreeSet<&str> =
            wording::Language::ENGLISH.section("documents").map(|(key, _)| key).collect();
        let unknown: Vec<&str> =
            Word::ALL.iter().map(|word| word.key()).filter(|key| !documents.contains(key)).collect();
        assert_eq!(unknown, [""; 0]);
        // No two words of templates have one name.
        assert_eq!(language("en").words().len(), documents.len() + wording::Word::ALL.len());
    }

    #[test]
    fn words_are_those_of_the_language_or_else_english() {
        assert_eq!(language("de").table_kind("ladder"), "Stufenfolge");
        assert_eq!(language("en").table_kind("ladder"), "ladder");
        assert_eq!((language("de").word(Word::Value), language("fr").word(Word::Value)), ("Wert", "Value"));
    }

    #[test]
    fn german_documents_have_the_phrases_of_both_languages() {
        let phrases = |code| language(code).synonyms().concat();
        assert!(!phrases("en").contains(&"Zustandswort"));
        for phrase in ["Zustandswort", "csp"] {
            assert!(phrases("de").contains(&phrase));
        }
        for synonyms in language("de").synonyms() {
            assert!(synonyms.len() > 1 && synonyms.iter().all(|one| !one.is_empty()), "{synonyms:?}");
        }
    }
}
