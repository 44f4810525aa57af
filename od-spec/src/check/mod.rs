//! The rules, one file each, named after the fact that they establish. A rule's file holds its code, what it means, an
//! example before and after, and the check itself; `odgen explain` and `docs/messages.md` are printed from there.
//!
//! Rules see the model and nothing else: a value may have been written in a specification, in a library, or in a setting
//! laid over both; the place of a message comes from the fact that it is about.

pub(crate) mod allowed;
mod findings;
mod from_library;
mod help;
mod pdo;
mod rule;
pub(crate) mod standard;
mod subject;

mod arrays_have_one_type;
mod bit_rates_are_standard;
mod bit_rates_exist;
mod channels_are_in_the_device_type;
mod cob_ids_are_unrestricted;
mod cob_ids_differ;
mod commands_are_flagged;
mod commands_are_not_downloaded;
mod communication_indices_are_defined;
mod communication_values_are_defined;
mod constants_are_not_stored;
mod constants_have_values;
mod constraints_are_computable;
mod constraints_hold;
mod counts_agree;
mod counts_are_constant;
mod definitions_are_used;
mod device_type_is_kept;
mod drive_modes;
mod drive_modes_are_listed;
mod drive_modes_have_their_objects;
mod drive_objects_keep_their_type;
mod elements_are_alike;
mod error_codes_are_listed;
mod error_control_exists;
mod granularity_fits_mapping;
mod heartbeats_of_others_are_watched;
mod identity_agrees;
mod indices_in_object_areas;
mod integers_have_common_widths;
mod limits_in_order;
mod links_lead_somewhere;
mod locked_entries_are_not_set;
mod locks_guard_writing;
mod lss_has_serial_number;
mod mandatory_objects_exist;
mod mappable_entries_have_pdos;
mod mappable_types_have_a_length;
mod mapped_entries_are_mappable;
mod mapping_follows_access;
mod mappings_change_as_a_whole;
mod multiplexed_pdos_are_possible;
mod multiplexed_pdos_are_supported;
mod names_are_unique;
mod names_fit_eds;
mod objects_need_each_other;
mod pdo_parameters_agree;
mod pdos_can_be_switched_off;
mod pdos_fit_a_frame;
mod pdos_have_their_predefined_cob_ids;
mod pdos_map_each_entry_once;
mod placeholders_are_accepted;
mod predefined_cob_ids_are_kept;
mod real_defaults;
mod real_values_are_kept;
mod remote_frames_are_answered;
mod reserved_bits_are_zero;
mod sdo_clients_talk_to_one_server;
mod services_have_their_objects;
mod set_entries_are_writable;
mod settings_have_an_order;
mod standard_access_is_kept;
mod standard_objects_are_complete;
mod standard_objects_keep_their_type;
pub(crate) mod start_values_are_allowed;
mod stored_entries_can_be_stored;
mod structures_have_entries;
mod sync_start_has_an_effect;
pub(crate) mod texts_fit_eds;
mod times_fit_the_transmission;
mod transmission_types_are_defined;
mod value_fits_type;
mod value_in_enum;
mod value_within_limits;
mod values_can_be_read_back;
mod vendor_has_a_number;
mod views_show_values;
mod write_conditions_are_met;

/// Codes of rules that others know by name: reading and looking up report some as well, and what is made of a file depends on some.
pub mod codes {
    pub use super::arrays_have_one_type::CODE as MIXED_TYPES;
    pub use super::bit_rates_are_standard::CODE as NO_STANDARD_BIT_RATE;
    pub use super::bit_rates_exist::CODE as NO_BIT_RATE;
    pub(crate) use super::cob_ids_are_unrestricted::CODE as BAD_COB_ID;
    pub use super::commands_are_not_downloaded::CODE as IS_COMMAND;
    pub use super::constants_are_not_stored::CODE as STORED_CONSTANT;
    pub use super::counts_agree::CODE as COUNT_MISMATCH;
    pub use super::definitions_are_used::CODE as UNUSED_DEFINITION;
    pub use super::drive_modes_have_their_objects::CODE as MODE_WITHOUT_OBJECTS;
    pub use super::elements_are_alike::CODE as UNLIKE_ELEMENTS;
    pub use super::granularity_fits_mapping::CODE as GRANULARITY_DIFFERS;
    pub use super::indices_in_object_areas::CODE as OUTSIDE_AREAS;
    pub use super::limits_in_order::CODE as SWAPPED_LIMITS;
    pub(crate) use super::locked_entries_are_not_set::CODE as LOCKED;
    pub use super::locks_guard_writing::CODE as USELESS_LOCK;
    pub use super::mappable_types_have_a_length::CODE as NO_LENGTH;
    pub use super::mapped_entries_are_mappable::CODE as NOT_MAPPABLE;
    pub use super::mapping_follows_access::CODE as MAPPING_AGAINST_ACCESS;
    pub use super::names_are_unique::CODE as DUPLICATE_NAME;
    pub use super::names_fit_eds::CODE as NAME_NOT_FOR_EDS;
    pub use super::pdo_parameters_agree::CODE as PDO_PARAMETERS_DIFFER;
    pub use super::set_entries_are_writable::CODE as NOT_WRITABLE;
    pub use super::settings_have_an_order::CODE as NO_ORDER;
    pub use super::texts_fit_eds::CODE as NOT_FOR_EDS;
    pub use super::value_fits_type::CODE as VALUE_DOES_NOT_FIT;
    pub use super::value_in_enum::CODE as UNKNOWN_ENUM_VALUE;
    pub(crate) use super::value_within_limits::CODE as OUTSIDE_LIMITS;
    pub use super::vendor_has_a_number::CODE as NO_VENDOR_NUMBER;
    pub use super::write_conditions_are_met::CODE as NOT_NOW;
}

use std::collections::BTreeSet;

use crate::diag::Diagnostics;
use crate::model::{Dictionary, System};
use crate::source::Span;

use allowed::Allowed;
use findings::Findings;
use rule::{Check, Needs};
pub(crate) use rule::{Rule, Rules};
pub(crate) use standard::Standard;
use subject::Subject;

/// All rules, by code.
pub(crate) static RULES: &[Rule] = &[
    names_are_unique::RULE,
    counts_agree::RULE,
    structures_have_entries::RULE,
    arrays_have_one_type::RULE,
    indices_in_object_areas::RULE,
    names_fit_eds::RULE,
    texts_fit_eds::RULE,
    standard_objects_keep_their_type::RULE,
    standard_objects_are_complete::RULE,
    objects_need_each_other::RULE,
    links_lead_somewhere::RULE,
    value_in_enum::RULE,
    value_fits_type::RULE,
    value_within_limits::RULE,
    limits_in_order::RULE,
    locks_guard_writing::RULE,
    constants_are_not_stored::RULE,
    mappable_types_have_a_length::RULE,
    mapping_follows_access::RULE,
    mapped_entries_are_mappable::RULE,
    cob_ids_are_unrestricted::RULE,
    cob_ids_differ::RULE,
    transmission_types_are_defined::RULE,
    placeholders_are_accepted::RULE,
    pdos_fit_a_frame::RULE,
    pdo_parameters_agree::RULE,
    granularity_fits_mapping::RULE,
    communication_values_are_defined::RULE,
    multiplexed_pdos_are_supported::RULE,
    mappings_change_as_a_whole::RULE,
    bit_rates_are_standard::RULE,
    bit_rates_exist::RULE,
    constraints_hold::RULE,
    constraints_are_computable::RULE,
    identity_agrees::RULE,
    set_entries_are_writable::RULE,
    locked_entries_are_not_set::RULE,
    commands_are_not_downloaded::RULE,
    write_conditions_are_met::RULE,
    mandatory_objects_exist::RULE,
    mappable_entries_have_pdos::RULE,
    error_control_exists::RULE,
    lss_has_serial_number::RULE,
    constants_have_values::RULE,
    definitions_are_used::RULE,
    real_defaults::RULE,
    error_codes_are_listed::RULE,
    stored_entries_can_be_stored::RULE,
    reserved_bits_are_zero::RULE,
    standard_access_is_kept::RULE,
    communication_indices_are_defined::RULE,
    services_have_their_objects::RULE,
    predefined_cob_ids_are_kept::RULE,
    commands_are_flagged::RULE,
    device_type_is_kept::RULE,
    channels_are_in_the_device_type::RULE,
    counts_are_constant::RULE,
    pdos_map_each_entry_once::RULE,
    pdos_can_be_switched_off::RULE,
    vendor_has_a_number::RULE,
    elements_are_alike::RULE,
    pdos_have_their_predefined_cob_ids::RULE,
    times_fit_the_transmission::RULE,
    values_can_be_read_back::RULE,
    integers_have_common_widths::RULE,
    multiplexed_pdos_are_possible::RULE,
    heartbeats_of_others_are_watched::RULE,
    sdo_clients_talk_to_one_server::RULE,
    drive_objects_keep_their_type::RULE,
    real_values_are_kept::RULE,
    views_show_values::RULE,
    remote_frames_are_answered::RULE,
    sync_start_has_an_effect::RULE,
    start_values_are_allowed::RULE,
    settings_have_an_order::RULE,
    drive_modes_have_their_objects::RULE,
    drive_modes_are_listed::RULE,
];

/// Applies the rules to a system whose devices are types: each may become any node.
pub(crate) fn system(
    rules: Rules<'_>,
    system: &System,
    library: Option<&Dictionary>,
    allowed: &mut Allowed<'_>,
    diagnostics: &mut Diagnostics,
) {
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
