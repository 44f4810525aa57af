//! Keys that the standard has taken back are not used.

use super::super::keys::RESERVED;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS119",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a key of EDS version 3",
    explanation: "`ProductVersion`, `ProductRevision`, `LMT_ManufacturerName`, `LMT_ProductName`, \
        `ExtendedBootUpMaster` and `ExtendedBootUpSlave` belong to files of version 3; today they are reserved. No \
        tool reads them; remove them, and say what is still true with today's keys.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds("[DeviceInfo]\nProductVersion=1\n; ...", "[DeviceInfo]\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for entry in view.section(Topic::DeviceInfo).into_iter().flat_map(crate::eds::view::Part::entries) {
        let Some(key) = RESERVED.iter().find(|key| key.eq_ignore_ascii_case(entry.key.value)) else {
            continue;
        };
        found.add(entry.key.span, [], || {
            Diagnostic::new(
                CODE,
                entry.key.span,
                format!("`{key}` is a key of EDS version 3, reserved since"),
            )
            .help("remove it")
        });
    }
    found.finish("keys", diagnostics);
}
