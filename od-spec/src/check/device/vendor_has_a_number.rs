//! The vendor has the number that CiA gave it.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::SystemSource;
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0821",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a vendor without a number",
    explanation: "CiA gives every maker a vendor-ID, and 0 to none of them: in 1018h.1 it says that there is none. A tool that compares 1018h.1 cannot distinguish such a device from those of other makers that \
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
    let message = "the vendor number is 0, which CiA gives to no maker";
    findings.push(Diagnostic::new(CODE, place, message).help(subject.help(Help {
        specification: "write the vendor-ID that CiA has given, as `number:` of the vendor",
        eds: &format!(
            "write the vendor-ID that CiA has given, here and as {} of 1018h.1",
            subject.format.key(Key::Default)
        ),
        setting: "the device has to state its maker",
    })));
}
