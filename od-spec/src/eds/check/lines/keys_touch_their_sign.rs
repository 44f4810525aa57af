//! A key begins its line and touches its equals sign.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS112",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "spaces around a key",
    explanation: "A key begins its line, and the equals sign follows at once. With a space in between, some readers take the space as part of the key; Python's configparser, which python-canopen and lely's tools use, takes an indented key as the continuation of the value above.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines =0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines() {
        let Some(key) = line.key_part() else { continue };
        let (start, end) = (key.start as usize, key.end as usize);
        let Some(sign) = line.text()[end..].find('=').map(|at| end + at) else { continue };
        if (start == 0 && end == sign) || line.text().starts_with('\u{FEFF}') {
            continue;
        }
        let place = edits::place(view, line);
        // Where the line is touched, it becomes as the standard has it.
        let value = line.value_part().map_or(sign + 1, |value| value.start as usize);
        let cut = [(0, start), (end, sign), (sign + 1, value)].into_iter().filter(|(from, to)| from < to);
        let cuts = cut.map(|(from, to)| Edit { span: place.part(from, to), text: String::new() });
        found.add(place, cuts, || {
            let name = shorten(line.key().unwrap_or_default());
            let message = if start > 0 {
                format!("there are spaces before `{name}`")
            } else {
                format!("there are spaces between `{name}` and `=`")
            };
            Diagnostic::new(CODE, place.part(start, sign + 1), message)
                .help("remove the spaces; `odgen fix` does")
        });
    }
    found.finish("lines", diagnostics);
}
