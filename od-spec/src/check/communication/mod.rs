//! Identifiers, bit rates and the services of CiA 301 other than PDOs.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    cob_ids_are_unrestricted,
    cob_ids_differ,
    communication_values_are_defined,
    bit_rates_are_standard,
    bit_rates_exist,
    error_control_exists,
    lss_has_serial_number,
    error_codes_are_listed,
    communication_indices_are_defined,
    services_have_their_objects,
    predefined_cob_ids_are_kept,
    heartbeats_of_others_are_watched,
    sdo_clients_talk_to_one_server,
    sync_times_are_possible,
    one_error_control_is_used,
}
