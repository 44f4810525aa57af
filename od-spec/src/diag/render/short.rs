//! One line each, as compilers print them and editors read them.

use std::fmt::Write as _;

use crate::diag::Diagnostic;
use crate::source::SourceMap;

pub(super) fn short(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let mut line = String::new();
    if let Some(label) = diagnostic.labels.first() {
        let _ = write!(line, "{}: ", sources.place(label.span));
    }
    let _ = write!(line, "{}[{}]: {}", diagnostic.severity().word(), diagnostic.code, diagnostic.message);
    if let Some(help) = &diagnostic.help {
        let _ = write!(line, " ({help})");
    }
    line.replace(['\n', '\r'], " ")
}
