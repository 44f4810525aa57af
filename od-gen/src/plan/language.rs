//! What a plan has to know of the language that it will be printed in: how identifiers look, and which are taken.

use super::names::Words;

/// A language that plans are printed in.
pub trait Language {
    /// The identifier that words become in a scope, which is not a keyword and nothing that the printed code needs
    /// there itself; empty where there are no words.
    fn identifier(&self, scope: ScopeKind, role: Role, words: &Words) -> String;

    /// The further identifier that the language's printer makes from one; `None` where it makes none.
    fn companion(&self, companion: Companion, identifier: &str) -> Option<String>;

    /// The identifier of a type that has one of some variants, from their identifiers.
    fn alternatives(&self, variants: &[&str]) -> String;
}

/// What an identifier names. A language may spell each in its own way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A type: a dictionary, a group of accessors, a unit, an enum, a bit field, a PDO.
    Type,
    /// One of a type's alternatives: an entry, a state, a command, a special value.
    Variant,
    /// A constant: a value of an enum, an error code.
    Constant,
    /// What is called: the accessor of an entry, a group or some bits; a condition.
    Function,
    /// An entry where values are together, as in a PDO.
    Field,
}

/// What is printed with an identifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Companion {
    /// With the accessor of an entry: what writes it.
    Setter,
    /// With the accessor of a group: the group, to be changed.
    Mutable,
    /// With the accessor of elements by sub-index: all of them.
    Elements,
    /// With the accessor of some bits: the word with other bits.
    With,
}

impl Companion {
    /// What the companion is, for messages.
    pub(super) fn describe(self, what: &str) -> String {
        match self {
            Companion::Setter => format!("the setter of {what}"),
            Companion::Mutable => format!("{what} to be changed"),
            Companion::Elements => format!("all elements of {what}"),
            Companion::With => what.to_owned(),
        }
    }
}

/// A scope: identifiers that must differ from each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ScopeKind {
    /// Types in addition to the dictionary's.
    Dictionary,
    /// Accessors of the dictionary: of entries and of groups.
    Accessors,
    /// Types of groups.
    Groups,
    /// Accessors of one group.
    GroupMembers,
    /// All entries, as variants.
    Entries,
    /// All entries, as fields.
    Fields,
    /// Units.
    Units,
    /// Enums and bit fields.
    Types,
    /// Constants and accessors of one enum or bit field.
    TypeMembers,
    /// Values of one set of special values.
    SpecialValues,
    /// Fields of one PDO.
    PdoFields,
    /// State machines.
    Machines,
    /// States, or commands, of one state machine.
    MachineVariants,
    /// Error codes.
    Errors,
    /// Conditions between entries.
    Constraints,
}
