//! `FileName` is the name of the file, without directories.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::file_name;
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS212",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a file with another name",
    explanation: "`FileName` is the name of the file itself. Where the two differ, the file was renamed or copied, and \
        it is not clear which of two files is meant. A path of the author's computer means nothing to others.",
    clause: Some("CiA 306 4.4"),
    example: Some(Example::eds(
        "[FileInfo]\nFileName=C:\\EDS\\example.eds\n; ...",
        "[FileInfo]\nFileName=example.eds\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(value) = view.section(Topic::FileInfo).and_then(|part| part.value("FileName")) else { return };
    let name = view.facts.name;
    if name.is_empty() || value.value == name {
        return;
    }
    let (found, real) = (shorten(value.value), shorten(name));
    let is_path = file_name(value.value) != value.value;
    let diagnostic = if is_path && file_name(value.value).eq_ignore_ascii_case(name) {
        let edit = Edit { span: value.span, text: name.to_owned() };
        let message = format!("`FileName` is `{found}`, expected a name without directories");
        let mut diagnostic =
            Diagnostic::new(CODE, value.span, message).help(format!("write `{real}`; `odgen fix` does"));
        diagnostic.edits.push(edit);
        diagnostic
    } else {
        let message = format!("`FileName` is `{found}`, but the file is called `{real}`");
        Diagnostic::new(CODE, value.span, message).help("correct the key, or rename the file")
    };
    diagnostics.push(diagnostic);
}
