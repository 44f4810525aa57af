//! C as a language of plans: its spelling, and the words that nothing may be called.

use od_gen::plan::{Companion, Language, Role, ScopeKind, Words};

/// Words of C99, C11 and C23, of C++ up to C++20, of the headers that generated files include, and those that compilers for microcontrollers and
/// the dialects of GNU add: a header is read by all of them.
const RESERVED: &[&str] = &[
    "alignas",
    "alignof",
    "and",
    "and_eq",
    "asm",
    "assert",
    "atomic_cancel",
    "atomic_commit",
    "atomic_noexcept",
    "auto",
    "bit",
    "bitand",
    "bitor",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "char16_t",
    "char32_t",
    "char8_t",
    "class",
    "co_await",
    "co_return",
    "co_yield",
    "code",
    "compl",
    "complex",
    "concept",
    "const",
    "const_cast",
    "consteval",
    "constexpr",
    "constinit",
    "continue",
    "data",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "dynamic_cast",
    "else",
    "enum",
    "errno",
    "explicit",
    "export",
    "extern",
    "false",
    "far",
    "float",
    "for",
    "friend",
    "goto",
    "huge",
    "idata",
    "if",
    "imaginary",
    "inline",
    "int",
    "interrupt",
    "linux",
    "long",
    "mutable",
    "namespace",
    "near",
    "new",
    "noexcept",
    "noreturn",
    "not",
    "not_eq",
    "nullptr",
    "offsetof",
    "operator",
    "or",
    "or_eq",
    "pdata",
    "private",
    "protected",
    "public",
    "reentrant",
    "reflexpr",
    "register",
    "reinterpret_cast",
    "requires",
    "restrict",
    "return",
    "sbit",
    "sfr",
    "short",
    "signed",
    "sizeof",
    "static",
    "static_assert",
    "static_cast",
    "stderr",
    "stdin",
    "stdout",
    "struct",
    "switch",
    "synchronized",
    "template",
    "this",
    "thread_local",
    "throw",
    "true",
    "try",
    "typedef",
    "typeid",
    "typename",
    "typeof",
    "typeof_unqual",
    "union",
    "unix",
    "unsigned",
    "using",
    "virtual",
    "void",
    "volatile",
    "wchar_t",
    "while",
    "xdata",
    "xor",
    "xor_eq",
];

/// Whether nothing may be called so.
pub(super) fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name)
}

/// C99, which C++ reads, too. What has a name in the whole program gets the device's name before it ([`super::names`]); the plan's identifiers are
/// without it.
pub(crate) struct C;

impl Language for C {
    fn identifier(&self, _: ScopeKind, role: Role, words: &Words) -> String {
        // Names of a scope follow that of the device and of the scope.
        match role {
            // No such word is written in upper case.
            Role::Variant | Role::Constant => words.screaming(),
            Role::Type | Role::Function | Role::Field => {
                let name = words.snake();
                if RESERVED.contains(&name.as_str()) { format!("{name}_") } else { name }
            }
        }
    }

    fn companion(&self, _: Companion, _: &str) -> Option<String> {
        // What is done with an entry is before its name: `pmc_get_speed`, `pmc_set_speed`.
        None
    }

    fn alternatives(&self, variants: &[&str]) -> String {
        variants.join("_OR_")
    }
}

#[cfg(test)]
mod tests {
    use od_gen::plan::{Members, Shape, plan};
    use od_gen::rust::Rust;
    use od_spec::diag::Diagnostics;
    use od_spec::model::System;
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use super::*;

    #[test]
    fn words_of_the_languages_are_no_identifiers() {
        let field = |name: &str| C.identifier(ScopeKind::Fields, Role::Field, &Words::of(name));
        assert_eq!(
            (field("register").as_str(), field("actual speed").as_str()),
            ("register_", "actual_speed")
        );
        assert_eq!((field("class").as_str(), field("24V").as_str()), ("class_", "n24v"));
        assert_eq!(C.identifier(ScopeKind::TypeMembers, Role::Constant, &Words::of("register")), "REGISTER");
        assert!(RESERVED.is_sorted());
    }

    fn system(objects: &str) -> System {
        let head = "od-spec: 1\ntitle: T\nuses: [cia301]\ndevices: {float: {name: D, bit-rates: [125]}}\n";
        let types = "types:\n  double:\n    base: unsigned8\n    values: {0: void, 1: {name: default}}\n";
        let mut sources = SourceMap::new();
        let root = sources.add("words.od.yaml", format!("{head}{types}objects:\n{objects}"));
        let compiled = compile(&mut sources, root, &mut NoFiles);
        compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
    }

    const KEYWORDS: &str = "
  0x2000: {name: register, type: unsigned8, access: rw}
  0x2001: {name: switch, type: double, access: rw}
  0x2002:
    name: Short
    record:
      1: {name: int, type: unsigned8, access: rw}
      2: {name: type, type: unsigned8, access: rw, special: {255: char}}
";

    #[test]
    fn names_avoid_the_keywords() {
        let system = system(KEYWORDS);
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
        for name in ["float_", "register_", "switch_", "short_", "int_", "double_", "type", "VOID"] {
            assert!(names.iter().any(|planned| planned == name), "`{name}` is not among {names:?}");
        }
        assert_eq!(names.iter().find(|name| RESERVED.contains(&name.as_str())), None);
    }

    #[test]
    fn names_clash_where_they_do_in_c() {
        let clashes = |language: &dyn Language| {
            let object = |index: u16, name: &str| {
                format!("  0x{index:X}: {{name: {name}, type: double, access: rw}}\n")
            };
            let system = system(&[object(0x2000, "word 1"), object(0x2001, "word1")].concat());
            let mut diagnostics = Diagnostics::new();
            plan(&system, &system.devices[0], language, &mut diagnostics);
            diagnostics.count().0
        };
        assert_eq!(clashes(&C), 0, "`word_1` and `word1` differ");
        assert_eq!(clashes(&Rust), 1, "there is one `Word1`");
    }
}
