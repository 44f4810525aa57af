//! What `dcfchk` of lely's dcf-tools 2.4 ends with an error for: faults that its lint finds, and what its reader raises for.

mod device;
mod implied;
mod lint;
mod objects;
mod values;

use super::python::{Capitals, Ini};
use super::refusal::Refusals;
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

pub(super) fn refusals(text: &str, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::Dcfchk, file);
    let ini = Ini::read(text, &['#', ';'], Capitals::AreAlike, &mut refusals);
    lint::lint(&ini, &mut refusals);
    device::device(&ini, &mut refusals);
    refusals
}
