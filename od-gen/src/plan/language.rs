//! What a plan has to know of the language that it will be printed in: how identifiers look, and which are taken.

use super::names::Words;

/// A language that plans are printed in.
pub(crate) trait Language {
    /// The identifier that words become, which is no keyword; empty where there are no words.
    fn identifier(&self, role: Role, words: &Words) -> String;

    /// The further identifier that the language's printer makes from one; `None` where it makes none.
    fn companion(&self, companion: Companion, identifier: &str) -> Option<String>;

    /// The identifier of a type that has one of some variants, from their identifiers.
    fn alternatives(&self, variants: &[&str]) -> String;

    /// Identifiers of a scope that the printed code needs itself.
    fn reserved(&self, scope: ScopeKind) -> &'static [&'static str];
}

/// What an identifier names. A language may spell each in its own way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// A type: a dictionary, a group of accessors, a unit, an enum, a bit field, a PDO.
    Type,
    /// One of a type's alternatives: an entry, a state, a command, a special value.
    Variant,
    /// A constant: a value of an enum, an error code.
    Constant,
    /// What is called: the accessor of an entry, a group or some bits; a condition.
    Function,
    /// An entry where values stand together, as in a PDO.
    Field,
}

/// What is printed beside an identifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Companion {
    /// Beside the accessor of an entry: what writes it.
    Setter,
    /// Beside the accessor of a group: the group, to be changed.
    Mutable,
    /// Beside the accessor of elements by sub-index: all of them.
    Elements,
    /// Beside the accessor of some bits: the word with other bits.
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
pub(crate) enum ScopeKind {
    /// Types beside the dictionary's.
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

#[cfg(test)]
mod tests {
    use od_spec::diag::Diagnostics;
    use od_spec::model::System;
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use super::*;
    use crate::plan::{Members, Shape, plan};

    /// A little of C: its keywords, one spelling for types and functions, setters that end with `_set`.
    struct C;

    const C_KEYWORDS: [&str; 12] = [
        "auto", "case", "char", "default", "double", "float", "int", "register", "short", "switch",
        "unsigned", "void",
    ];

    impl Language for C {
        fn identifier(&self, role: Role, words: &Words) -> String {
            match role {
                Role::Variant | Role::Constant => words.screaming(),
                Role::Type | Role::Function | Role::Field => {
                    let name = words.snake();
                    if C_KEYWORDS.contains(&name.as_str()) { format!("od_{name}") } else { name }
                }
            }
        }

        fn companion(&self, companion: Companion, identifier: &str) -> Option<String> {
            match companion {
                Companion::Setter => Some(format!("{identifier}_set")),
                Companion::Mutable | Companion::Elements | Companion::With => None,
            }
        }

        fn alternatives(&self, variants: &[&str]) -> String {
            variants.join("_OR_").to_lowercase()
        }

        fn reserved(&self, scope: ScopeKind) -> &'static [&'static str] {
            if scope == ScopeKind::Accessors { &["od_init"] } else { &[] }
        }
    }

    fn system(objects: &str) -> System {
        let head = "od-spec: 1\ntitle: T\nuses: [cia301]\ndevices: {float: {name: D, bit-rates: [125]}}\n";
        let types = "types:\n  double:\n    base: unsigned8\n    values: {0: void, 1: {name: default}}\n";
        let mut sources = SourceMap::new();
        let root = sources.add("words.od.yaml", format!("{head}{types}objects:\n{objects}"));
        let compiled = compile(&mut sources, root, &mut NoFiles);
        compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
    }

    const KEYWORDS_OF_C: &str = "
  0x2000: {name: register, type: unsigned8, access: rw}
  0x2001: {name: switch, type: double, access: rw}
  0x2002:
    name: Short
    record:
      1: {name: int, type: unsigned8, access: rw}
      2: {name: type, type: unsigned8, access: rw, special: {255: char}}
";

    #[test]
    fn names_avoid_the_keywords_of_the_language_that_is_printed() {
        let system = system(KEYWORDS_OF_C);
        let mut diagnostics = Diagnostics::new();
        let plan = plan(&system, &system.devices[0], &C, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let mut names = vec![plan.name.clone()];
        for object in &plan.objects {
            names.push(object.name.clone());
            names.extend(match &object.shape {
                Shape::Var => None,
                Shape::Indexed { count } => count.clone(),
                Shape::Group { type_name } => Some(type_name.clone()),
            });
        }
        for entry in &plan.entries {
            names.extend([entry.name.clone(), entry.member.clone(), entry.variant.clone()]);
        }
        for planned in &plan.types {
            names.push(planned.name.clone());
            match &planned.members {
                Members::Values(values) => names.extend(values.iter().map(|value| value.name.clone())),
                Members::Bits(bits) => names.extend(bits.iter().map(|bits| bits.name.clone())),
            }
        }
        for name in
            ["od_float", "od_register", "od_switch", "od_short", "od_int", "od_double", "type", "VOID"]
        {
            assert!(names.iter().any(|planned| planned == name), "`{name}` is not among {names:?}");
        }
        let keyword = names.iter().find(|name| C_KEYWORDS.contains(&name.as_str()));
        assert_eq!(keyword, None);
    }

    #[test]
    fn names_clash_where_they_do_in_the_language_that_is_printed() {
        let clashes = |language: &dyn Language, objects: &str| {
            let system = system(objects);
            let mut diagnostics = Diagnostics::new();
            plan(&system, &system.devices[0], language, &mut diagnostics);
            diagnostics.count().0
        };
        let object =
            |index: u16, name: &str| format!("  0x{index:X}: {{name: {name}, type: double, access: rw}}\n");
        let used = object(0x2000, "used");
        let setter = format!("{used}{}{}", object(0x2001, "speed"), object(0x2002, "speed set"));
        assert_eq!(clashes(&C, &setter), 1, "`speed_set` is a setter and an accessor");
        let reserved = format!("{used}{}", object(0x2001, "od init"));
        assert_eq!(clashes(&C, &reserved), 1, "`od_init` is part of every dictionary");
        let digits = format!("{used}{}{}", object(0x2001, "word 1"), object(0x2002, "word1"));
        assert_eq!(clashes(&C, &digits), 0, "`WORD_1` and `WORD1` differ");
    }
}
