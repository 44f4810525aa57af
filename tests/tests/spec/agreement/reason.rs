//! Why one of the three may say something else than the verdict.

macro_rules! reasons {
    ($($reason:ident: $text:literal;)+) => {
        /// Why one of the three may say something else.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub(crate) enum Reason { $(#[doc = $text] $reason,)+ }

        impl Reason {
            pub(crate) const ALL: &'static [Self] = &[$(Self::$reason),+];

            pub(crate) const fn text(self) -> &'static str {
                match self { $(Self::$reason => $text,)+ }
            }
        }
    };
}

reasons! {
    DefaultNeedsNoWrite: "a specification states the value that the entry has; nothing writes it";
    ReservedBitIsHarmless: "a reserved bit is a warning to its author; a device ignores it (CiA 301: reserved bits are not checked)";
    WatchingNobodyIsHarmless: "an entry of 1016h that watches no node is a warning to its author; a device leaves it unused";
    DefaultIsPredefined: "masters listen where the pre-defined connection set says: a warning to the maker of a device, not to the user who configures one";
    TwiceIsHarmless: "an entry twice in one PDO wastes room, and breaks nothing: a warning";
    EmptyIsSwitchedOff: "who sets the number of mapped entries to 0 switches the PDO off; a specification says so by `valid: no`";
    NeverSentIsHarmless: "a PDO that is never sent is no error of the device; its user wants it sent";
    NothingReachesIt: "a SYNC start value that no counter reaches leaves a PDO silent, or has no effect: a warning";
    OnlyWhileConditionHolds: "a DCF cannot know in which state the device will be: a warning";
    EdsLineHoldsLess: "an EDS or DCF line cannot hold the text; the bus can";
    NoNotation: "no specification, EDS or DCF has a notation for values of this type";
    FollowsFromType: "lengths of mapped entries, their number and empty places follow from `map:`";
    MapNamesEntries: "`map:` names entries, and a name or index that is not there is unknown before it can be mapped";
    KeyHasARange: "the key of the language has a range of its own";
    TargetIsWider: "a specification states the value of the target, whose type has it";
    BetweenSteps: "a specification states the value of the target, which has no such step";
    OnlyToolsMustNot: "a tool must not write it at each boot; a person with a client may";
    EdsShowsLess: "the EDS shows less access than the device gives, and a DCF goes by the EDS";
    PassedOnTheWay: "while PDOs are configured one after the other, two may pass through one identifier";
    RealsAreMisread: "PLC tools may misread a default of type REAL: a warning";
}
