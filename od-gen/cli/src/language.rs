//! The language that a command line chooses for what is written for people.

use od_spec::diag::{Diagnostic, codes};
use od_spec::model::System;
use od_spec::wording::Language;

/// The language of this code, in any case: one whose fixed words are known, or one of the specifications.
pub(crate) fn language<'a>(
    code: &str,
    systems: impl Iterator<Item = &'a System>,
) -> Result<String, Box<Diagnostic>> {
    let of_specs = systems.flat_map(|system| &system.languages).map(String::as_str);
    let mut known: Vec<&str> = Language::ALL.iter().map(|language| language.code()).chain(of_specs).collect();
    known.sort_unstable();
    known.dedup();
    known.iter().find(|known| known.eq_ignore_ascii_case(code)).map(|known| (*known).to_owned()).ok_or_else(
        || {
            let list = known.iter().map(|code| format!("`{code}`")).collect::<Vec<_>>().join(", ");
            Box::new(
                Diagnostic::without_place(codes::UNKNOWN_WORD, format!("there is no language `{code}`"))
                    .help(format!("the languages are {list}")),
            )
        },
    )
}
