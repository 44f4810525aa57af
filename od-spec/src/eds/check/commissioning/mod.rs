//! What a DCF says about its node.

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    a_node_is_commissioned,
    commissioning_has_its_name,
    node_id_is_one,
    node_is_identified,
    bit_rate_is_standard,
    bit_rate_is_supported,
    serial_numbers_agree,
    files_belong_to_domains,
    settings_belong_to_a_dcf,
}
