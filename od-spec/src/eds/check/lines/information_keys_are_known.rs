//! Every key of a section about file, device, list or node is one of the standard.

use super::super::keys;
use super::super::rule::FormatRule;
use super::unknown_keys;
use crate::diag::{Code, Diagnostics, Example, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS117",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "an unknown key about file or device",
    explanation: "The standard has no key of this name in a section about the file, the device, a list or the node. \
        Most readers ignore it; lely's dcfchk refuses the file. Where the name is a misspelling, what the standard's \
        key would say is missing. Bit rates that CiA 301 does not have, such as `BaudRate_100`, are unknown keys, \
        too.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines=0\nAuthor=me", "; Author: me\n[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let sections = view.topics().filter(|(topic, _)| !keys::is_of_object(*topic));
    unknown_keys::report(CODE, sections, "in this section", diagnostics);
}
