//! Lines are at most 255 characters long, which limits every name and text.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS103",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a line of more than 255 characters",
    explanation: "A line has at most 255 characters, key and equals sign included. That leaves 241 for a \
        `ParameterName` and 243 for a `ProductName`. Readers written in C cut the rest off or take it as a line of its \
        own. Shorten the text; bytes of a DOMAIN go into a file, which `DownloadFile` names.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::dcf(
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125\nNodeName=xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125\nNodeName=x",
    )),
};

/// Most characters of a line (CiA 306 4.2).
const LONGEST: usize = 255;

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| line.text().len() > LONGEST && line.number() == 1)
    {
        let length = line.text().chars().count();
        let Some(key) = (length > LONGEST).then(|| line.key()) else { continue };
        let place = edits::place(view, line);
        found.add(place, [], || {
            let diagnostic = Diagnostic::new(
                CODE,
                place,
                format!("found a line of {length} characters, expected at most {LONGEST}"),
            );
            match (key, line.value()) {
                (Some(key), Some(value)) => diagnostic.help(format!(
                    "shorten the value by {} of its {} characters: `{}` holds {}",
                    length - LONGEST,
                    value.chars().count(),
                    crate::diag::shorten(key),
                    (LONGEST - 1).saturating_sub(key.chars().count()),
                )),
                _ => diagnostic.help("divide the line"),
            }
        });
    }
    found.finish("lines", diagnostics);
}
