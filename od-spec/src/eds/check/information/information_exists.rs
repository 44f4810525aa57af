//! There is a section about the file and one about the device.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS201",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "no section about file or device",
    explanation: "`[FileInfo]` says which version of the file this is, `[DeviceInfo]` whose device it is and what it \
        can do. PLC tools show them and choose files by them; python-canopen and lely's tools expect the device's. \
        Only the maker can say what belongs there.",
    clause: Some("CiA 306 4.4 and 4.5"),
    example: Some(Example::eds(
        "; without [FileInfo]",
        "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\nDescription=Example\nCreationTime=09:00AM\nCreationDate=01-31-2020\nCreatedBy=me\nModificationTime=09:00AM\nModificationDate=01-31-2020\nModifiedBy=me",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (topic, name, tells) in [
        (Topic::FileInfo, "FileInfo", "version, date and author of the file"),
        (Topic::DeviceInfo, "DeviceInfo", "maker, product and abilities of the device"),
    ] {
        if view.section(topic).is_none() {
            let message = format!("there is no section `[{name}]`");
            diagnostics
                .push(Diagnostic::new(CODE, view.start(), message).help(format!("add it, with {tells}")));
        }
    }
}
