//! The rules about plants, one file each, named after the fact that they establish.

mod cob_ids_have_one_sender;
mod heartbeats_come_in_time;
mod node_ids_differ;
mod pdos_have_two_ends;
mod serial_numbers_differ;

use super::{Bus, Plant};
use crate::diag::{Code, Diagnostics};

/// A rule about plants.
pub(crate) struct Rule {
    /// Its codes, with severity and explanation.
    pub codes: &'static [&'static Code],
    /// How it looks.
    pub check: Check,
}

/// What a rule looks at.
pub(crate) enum Check {
    /// The bus of a machine; one of each kind.
    Bus(fn(&Bus<'_>, &mut Diagnostics)),
    /// All machines.
    Plant(fn(&Plant, &mut Diagnostics)),
}

/// All rules.
pub(crate) static RULES: &[Rule] = &[
    node_ids_differ::RULE,
    cob_ids_have_one_sender::RULE,
    pdos_have_two_ends::RULE,
    heartbeats_come_in_time::RULE,
    serial_numbers_differ::RULE,
];

/// The codes of all rules.
pub(crate) fn codes() -> impl Iterator<Item = &'static Code> {
    RULES.iter().flat_map(|rule| rule.codes).copied()
}
