//! Rules over the resolved model, one file each. What concerns a single value is checked where it is read.

mod cob_ids_differ;
mod constants_have_values;
mod definitions_are_used;
mod entries_are_consistent;
mod error_codes_are_listed;
mod error_control_exists;
mod granularity_fits_mapping;
mod indices_in_object_areas;
pub(crate) mod keys_have_effect;
mod lss_has_serial_number;
mod mandatory_objects_exist;
mod mappable_entries_have_pdos;
mod names_fit_eds;
mod object_names_unique;
mod real_defaults;
mod reserved_bits_are_zero;
mod stored_entries_can_be_stored;

use crate::ast::Spec;
use crate::diag::Diagnostics;
use crate::model::{Dictionary, System};
use crate::source::Span;

/// A rule over one device.
type Rule = fn(&Dictionary, &mut Diagnostics);

/// Rules about what is there.
const PRESENCE: [Rule; 5] = [
    cob_ids_differ::check,
    indices_in_object_areas::check,
    names_fit_eds::check,
    object_names_unique::check,
    real_defaults::check,
];

/// Rules about what is not there, or was derived. With an error in the specification they would blame what is only a
/// consequence of it.
const ABSENCE: [Rule; 9] = [
    entries_are_consistent::check,
    constants_have_values::check,
    error_control_exists::check,
    granularity_fits_mapping::check,
    lss_has_serial_number::check,
    mandatory_objects_exist::check,
    mappable_entries_have_pdos::check,
    reserved_bits_are_zero::check,
    stored_entries_can_be_stored::check,
];

/// Applies every rule.
pub(crate) fn run(root: &Spec, system: &System, diagnostics: &mut Diagnostics) {
    let complete = !diagnostics.has_errors();
    error_codes_are_listed::check(root, system, diagnostics);
    names_fit_eds::check_vendor(root, diagnostics);
    if complete {
        definitions_are_used::check(root, system, diagnostics);
    }
    let rules = PRESENCE.into_iter().chain(ABSENCE.into_iter().filter(|_| complete));
    for rule in rules {
        for device in &system.devices {
            rule(device, diagnostics);
        }
    }
}

/// The place of something in a device; of the device itself for what comes from a library, which is right.
fn own_place(device: &Dictionary, span: Span) -> Span {
    if span.file == device.span.file { span } else { device.span }
}
