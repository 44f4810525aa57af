//! The rules over a text, one file each, named after the fact that they establish, as in `crate::check`. They see sections,
//! keys and lines; what an object's keys mean is the reader's business, what the objects mean together that of the rules
//! over the model.

mod enumeration;
pub(in crate::eds) mod keys;
mod numbered;
mod object_form;
mod rule;

mod commissioning;
mod information;
mod lines;
mod lists;
mod modules;
mod objects;

#[cfg(test)]
mod tests;

use std::sync::LazyLock;

use crate::diag::Diagnostics;
use crate::eds::edits;
use crate::eds::view::View;

pub use commissioning::settings_belong_to_a_dcf::CODE as SETTINGS_IN_EDS;
pub(crate) use lines::nothing_stands_before_the_text::CODE as BYTE_ORDER_MARK;
pub use lists::entries_are_indices::CODE as NO_INDEX;
pub use modules::connected_modules_are_supported::CODE as UNKNOWN_MODULE;
pub use objects::links_have_an_object::CODE as LINKS_OF_NOTHING;
pub(crate) use rule::FormatRule;

/// All rules, by code.
pub(crate) static RULES: LazyLock<Vec<&'static FormatRule>> = LazyLock::new(|| {
    let areas = [
        lines::RULES,
        information::RULES,
        lists::RULES,
        objects::RULES,
        modules::RULES,
        commissioning::RULES,
    ];
    areas.into_iter().flatten().collect()
});

/// Applies all rules to a text.
pub(crate) fn document(view: &View<'_>, diagnostics: &mut Diagnostics) {
    document_with(RULES.iter().copied(), view, diagnostics);
}

/// Applies some rules to a text.
pub(crate) fn document_with<'r>(
    rules: impl Iterator<Item = &'r FormatRule>,
    view: &View<'_>,
    diagnostics: &mut Diagnostics,
) {
    for rule in rules {
        (rule.check)(view, diagnostics);
    }
}
