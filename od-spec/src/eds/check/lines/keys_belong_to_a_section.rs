//! Every key is in a section.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::view::{View, entry};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS109",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a key before the first section",
    explanation: "A key belongs to the section above it. Before the first section it belongs to none: Python's \
        configparser refuses the file, other readers drop the key. Move it to its section.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("Lines=0\n[Comments]\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for entry in view.document.preamble().iter().filter_map(|line| entry(line, view.file)) {
        found.add(entry.key.span, [], || {
            Diagnostic::new(
                CODE,
                entry.key.span,
                format!("`{}` is before the first section", shorten(entry.key.value)),
            )
            .help("move it into its section")
        });
    }
    found.finish("keys", diagnostics);
}
