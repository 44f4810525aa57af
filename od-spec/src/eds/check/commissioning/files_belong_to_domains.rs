//! Files are written into and read from DOMAINs.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS708",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a file for an entry that takes none",
    explanation: "`DownloadFile` names the file that is written into a DOMAIN, `UploadFile` the one that is read out of it. An \
        entry of another type takes a value, not a file. What can only be read takes none, and what can only be written \
        gives none.",
    clause: Some("CiA 306 5.3.1"),
    example: Some(Example::dcf(
        "[2000]\nParameterName=program\nObjectType=0x7\nDataType=0x0007\nAccessType=wo\nDownloadFile=program.bin",
        "[2000]\nParameterName=program\nObjectType=0x2\nAccessType=wo\nDownloadFile=program.bin",
    )),
};

const DOMAIN: i128 = 0x2;
const DOMAIN_TYPE: i128 = 0xF;

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        let number = |key: &str| part.value(key).and_then(|value| lenient_integer(value.value));
        let access = part.value("AccessType").map(|value| value.value.to_ascii_lowercase());
        let is_domain = number("ObjectType") == Some(DOMAIN) || number("DataType") == Some(DOMAIN_TYPE);
        for (key, refused, does) in [
            ("UploadFile", &["wo"][..], "cannot be read"),
            ("DownloadFile", &["ro", "const"][..], "cannot be written"),
        ] {
            let Some(file) = part.value(key) else { continue };
            let message = if !is_domain {
                format!("`{key}` stands at an entry that is no DOMAIN")
            } else if access.as_deref().is_some_and(|access| refused.contains(&access)) {
                format!("`{key}` stands at an entry that {does}")
            } else {
                continue;
            };
            found.add(file.span, [], || {
                Diagnostic::new(CODE, file.span, message)
                    .help("remove the key, or correct type or access of the entry")
            });
        }
    }
    found.finish("entries", diagnostics);
}
