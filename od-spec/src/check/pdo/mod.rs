//! PDOs: what can be mapped, how it is mapped, when it is sent.

pub(in crate::check) mod parameters;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    mappable_types_have_a_length,
    mapping_follows_access,
    mapped_entries_are_mappable,
    transmission_types_are_defined,
    placeholders_are_accepted,
    pdos_fit_a_frame,
    pdo_parameters_agree,
    granularity_fits_mapping,
    multiplexed_pdos_are_supported,
    mappings_change_as_a_whole,
    mappable_entries_have_pdos,
    pdos_map_each_entry_once,
    bus_carries_pdos,
    valid_pdos_carry_something,
    pdos_can_be_switched_off,
    pdos_have_their_predefined_cob_ids,
    times_fit_the_transmission,
    multiplexed_pdos_are_possible,
    remote_frames_are_answered,
    sync_start_has_an_effect,
}
