//! What a DCF says about its node.

pub(super) mod a_node_is_commissioned;
pub(super) mod bit_rate_is_standard;
pub(super) mod bit_rate_is_supported;
pub(super) mod commissioning_has_its_name;
pub(super) mod files_belong_to_domains;
pub(super) mod node_id_is_one;
pub(super) mod node_is_identified;
pub(super) mod serial_numbers_agree;
pub(super) mod settings_belong_to_a_dcf;
