//! What `dcfchk` of lely's dcf-tools 2.4 ends with an error for: faults that its lint finds, and what its reader raises for.

mod device;
mod implied;
mod lint;
mod objects;
mod values;

use super::python::Ini;
use super::refusal::Refusals;
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// Of a text that is read without regard to case.
pub(super) fn refusals(ini: &Ini<'_>, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::Dcfchk, file);
    ini.refuse(&mut refusals);
    lint::lint(ini, &mut refusals);
    device::device(ini, &mut refusals);
    refusals
}
