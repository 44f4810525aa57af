//! The vendor has the number that CiA gave it.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::SystemSource;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0821",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a vendor without a number",
    explanation: "CiA gives every maker a vendor-ID, and 0 to nobody: in 1018h.1 it says that there is none. Whoever compares 1018h.1 cannot tell such a device from those of other makers that \
        left the number open. Write the vendor-ID; 0 is right only as long as it is not known.",
    clause: Some("CiA 301, object 1018h (vendor-ID); CiA 306, 4.5 (VendorNumber)"),
    example: Some(Example::new(
        "vendor: {name: Example, number: 0}",
        "vendor: {name: Example, number: 0x123}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let vendor = &subject.system.vendor;
    let place = match subject.system.source {
        SystemSource::Specification => vendor.number_span.or(vendor.name_span),
        // That `VendorNumber` is missing is said about the text.
        SystemSource::Eds => vendor.number_span,
    };
    let Some(place) = place.filter(|_| vendor.number == 0) else { return };
    let message = "the vendor number is 0, which CiA gives to nobody";
    findings.push(Diagnostic::new(CODE, place, message).help(subject.help(Help {
        specification: "write the vendor-ID that CiA has given, as `number:` of the vendor",
        eds: "write the vendor-ID that CiA has given, here and as `DefaultValue` of 1018h.1",
        setting: "the device has to tell who made it",
    })));
}
