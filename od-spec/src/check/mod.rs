//! The rules, one file each, named after the fact that they establish. A rule's file holds its code, what it means, an
//! example before and after, and the check itself; `odgen explain` and the book's pages of messages are printed from there.
//!
//! Rules see the model and nothing else: a value may have been written in a specification, in a library, or in a setting
//! laid over both; the place of a message comes from the fact that it is about.

pub(crate) mod allowed;
pub(crate) mod departures;
mod findings;
mod help;
mod possible;
mod rule;
pub(crate) mod standard;
mod subject;
mod verdict;

pub(crate) mod access;
pub(crate) mod communication;
pub(crate) mod constraints;
pub(crate) mod device;
pub(crate) mod drives;
pub(crate) mod errors;
pub(crate) mod machines;
pub(crate) mod names;
pub(crate) mod pdo;
pub(crate) mod settings;
pub(crate) mod standard_objects;
pub(crate) mod storage;
pub(crate) mod structure;
pub(crate) mod values;

#[cfg(test)]
mod tests;

/// Codes of rules that others know by name: reading and looking up report some as well, and what is made of a file depends on some.
pub mod codes {
    pub(crate) use super::communication::cob_ids_are_unrestricted::CODE as BAD_COB_ID;
    pub use super::device::vendor_has_a_number::CODE as NO_VENDOR_NUMBER;
    pub use super::drives::drive_modes_have_their_objects::CODE as MODE_WITHOUT_OBJECTS;
    pub use super::names::definitions_are_used::CODE as UNUSED_DEFINITION;
    pub use super::names::names_are_unique::CODE as DUPLICATE_NAME;
    pub use super::names::names_differ_in_letters::CODE as ALIKE_NAMES;
    pub use super::names::names_fit_eds::CODE as NAME_NOT_FOR_EDS;
    pub(crate) use super::names::names_keep_their_characters::CODE as NAME_WITHOUT_FORM;
    pub use super::names::texts_fit_eds::CODE as NOT_FOR_EDS;
    pub use super::pdo::mapped_entries_are_mappable::CODE as NOT_MAPPABLE;
    pub use super::settings::commands_are_not_downloaded::CODE as IS_COMMAND;
    pub(crate) use super::settings::locked_entries_are_not_set::CODE as LOCKED;
    pub use super::settings::set_entries_are_writable::CODE as NOT_WRITABLE;
    pub use super::settings::settings_have_an_order::CODE as NO_ORDER;
    pub use super::settings::write_conditions_are_met::CODE as NOT_NOW;
    pub(crate) use super::structure::counts_agree::CODE as COUNT_MISMATCH;
    pub use super::structure::elements_are_alike::CODE as UNLIKE_ELEMENTS;
    pub use super::values::value_fits_type::CODE as VALUE_DOES_NOT_FIT;
    pub(crate) use super::values::value_in_enum::CODE as UNKNOWN_ENUM_VALUE;
    pub(crate) use super::values::value_within_limits::CODE as OUTSIDE_LIMITS;
}

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::diag::Diagnostics;
use crate::model::{Dictionary, System};
use crate::order::Arrange as _;
use crate::source::Span;

use allowed::Allowed;
use findings::Findings;
use rule::{Check, Needs};
pub(crate) use rule::{Rule, Rules};
pub(crate) use standard::Standard;
use subject::Subject;

/// All rules, by code.
pub(crate) static RULES: LazyLock<Vec<&'static Rule>> = LazyLock::new(|| {
    let areas = [
        structure::RULES,
        names::RULES,
        values::RULES,
        constraints::RULES,
        access::RULES,
        storage::RULES,
        settings::RULES,
        pdo::RULES,
        communication::RULES,
        standard_objects::RULES,
        device::RULES,
        drives::RULES,
        machines::RULES,
        errors::RULES,
    ];
    let mut rules: Vec<&Rule> = areas.into_iter().flatten().collect();
    rules.arrange_by_key(|rule| rule.code);
    rules
});

/// Applies the rules to a system whose devices are types: each may become any node.
pub(crate) fn system(
    rules: Rules<'_>,
    system: &System,
    library: Option<&Dictionary>,
    allowed: &mut Allowed<'_>,
    diagnostics: &mut Diagnostics,
) {
    // Warnings of reading and resolving may be allowed, too; their errors leave nothing to go on with.
    allowed.soften_warnings(diagnostics);
    for needs in [Needs::Nothing, Needs::Everything] {
        if needs == Needs::Everything && diagnostics.has_errors() {
            return;
        }
        let mut found = Diagnostics::new();
        for rule in rules.list.iter().filter(|rule| rule.needs == needs) {
            apply(rule, rules, system, library, None, &mut found);
        }
        diagnostics.append(allowed.soften(found));
    }
    allowed.report_unused(diagnostics);
}

/// Applies the rules to a device that was read from a foreign file, or to the node that a DCF is for. What is wrong there
/// prevents nothing, so that every rule has its say.
pub(crate) fn foreign(rules: Rules<'_>, system: &System, node: Option<u8>, diagnostics: &mut Diagnostics) {
    for rule in rules.list {
        apply(rule, rules, system, None, node, diagnostics);
    }
}

fn apply(
    rule: &Rule,
    rules: Rules<'_>,
    system: &System,
    library: Option<&Dictionary>,
    node: Option<u8>,
    diagnostics: &mut Diagnostics,
) {
    let mut look = |check: fn(&Subject<'_>, &mut Findings), device: &Dictionary| {
        let mut findings = Findings::of(device);
        let Rules { standard, format, .. } = rules;
        check(&Subject { system, device, node, standard, format }, &mut findings);
        diagnostics.append(findings.into_diagnostics());
    };
    match rule.check {
        Check::System(check) => {
            let mut findings = Findings::anywhere();
            check(system, &mut findings);
            diagnostics.append(findings.into_diagnostics());
        }
        Check::Objects(check) => {
            system.devices.iter().chain(library).for_each(|device| look(check, device));
        }
        Check::Device(check) => {
            system.devices.iter().for_each(|device| look(check, device));
        }
        Check::Settings(_) => {}
    }
}

/// Applies the rules to a node that was read from a DCF: `device` has the file's parameter values. What is wrong with its
/// defaults was said about the device.
pub(crate) fn foreign_node(
    rules: Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    diagnostics: &mut Diagnostics,
) {
    let Rules { standard, format, .. } = rules;
    let subject = Subject { system, device, node: Some(node), standard, format };
    let places: BTreeSet<Span> = subject.set_entries().map(|(.., place)| place).collect();
    for rule in rules.list {
        let (Check::Objects(check) | Check::Device(check) | Check::Settings(check)) = rule.check else {
            continue;
        };
        let mut findings = Findings::of(device);
        check(&subject, &mut findings);
        diagnostics.append(findings.standing_at(&places));
    }
}

/// Applies the rules to one configured node: `device` has the settings laid over its defaults. What is wrong without the
/// settings is not said again.
pub(crate) fn configuration(
    rules: Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    diagnostics: &mut Diagnostics,
) {
    let Rules { standard, format, .. } = rules;
    let subject = Subject { system, device, node: Some(node), standard, format };
    let before = diagnostics.count().0;
    // As for a specification: what is only a consequence of something wrong is not said.
    for needs in [Needs::Nothing, Needs::Everything] {
        if needs == Needs::Everything && diagnostics.count().0 > before {
            return;
        }
        for rule in rules.list.iter().filter(|rule| rule.needs == needs) {
            let (Check::Objects(check) | Check::Device(check) | Check::Settings(check)) = rule.check else {
                continue;
            };
            let mut findings = Findings::of(device);
            check(&subject, &mut findings);
            diagnostics.append(findings.touching(&subject.settings()));
        }
    }
}
