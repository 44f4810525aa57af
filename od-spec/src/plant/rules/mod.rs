//! The rules about plants, one file each, named after the fact that they establish.

use super::{Bus, Plant};
use crate::diag::{Code, Diagnostics};
use crate::rules::rules;

pub use cob_ids_have_one_sender::shared_cob_id;

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

rules! { Rule:
    node_ids_differ,
    cob_ids_have_one_sender,
    pdos_have_two_ends,
    heartbeats_come_in_time,
    serial_numbers_differ,
    names_name_folders,
}

/// The codes of all rules.
pub(crate) fn codes() -> impl Iterator<Item = &'static Code> {
    RULES.iter().flat_map(|rule| rule.codes).copied()
}
