//! Rules over the resolved model, one file each. What concerns a single value is checked where it is read.

mod constants_have_values;
mod cob_ids_differ;
mod error_control_exists;
mod granularity_fits_mapping;
mod indices_in_object_areas;
mod lss_has_serial_number;
mod mandatory_objects_exist;
mod mappable_entries_have_pdos;
mod names_fit_eds;
mod object_names_unique;
mod real_defaults;

use crate::diag::Diagnostics;
use crate::model::{Dictionary, System};

/// A rule over one device.
type Rule = fn(&Dictionary, &mut Diagnostics);

const RULES: [Rule; 11] = [
    cob_ids_differ::check,
    constants_have_values::check,
    error_control_exists::check,
    granularity_fits_mapping::check,
    indices_in_object_areas::check,
    lss_has_serial_number::check,
    mandatory_objects_exist::check,
    mappable_entries_have_pdos::check,
    names_fit_eds::check,
    object_names_unique::check,
    real_defaults::check,
];

/// Applies every rule to every device.
pub(crate) fn run(system: &System, diagnostics: &mut Diagnostics) {
    for device in &system.devices {
        for rule in RULES {
            rule(device, diagnostics);
        }
    }
}
