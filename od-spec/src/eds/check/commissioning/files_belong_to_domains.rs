//! Files are written into and read from DOMAINs.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::coded;
use crate::eds::view::View;
use crate::model::{Access, DataType};

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

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        let text = |key: &str| part.value(key).map(|value| value.value);
        let access = text("AccessType").and_then(coded::access);
        let is_domain = text("ObjectType").and_then(coded::object_code) == Some(DOMAIN)
            || text("DataType").and_then(coded::data_type) == Some(DataType::Domain);
        for (key, can, does) in [
            ("UploadFile", Access::is_readable as fn(Access) -> bool, "cannot be read"),
            ("DownloadFile", Access::is_writable, "cannot be written"),
        ] {
            let Some(file) = part.value(key) else { continue };
            let message = if !is_domain {
                format!("`{key}` is at an entry that is not a DOMAIN")
            } else if access.is_some_and(|access| !can(access)) {
                format!("`{key}` is at an entry that {does}")
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
