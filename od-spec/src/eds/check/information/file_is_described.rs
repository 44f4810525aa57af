//! The file says what it is, when it was made and by whom.

use super::super::enumeration::enumeration;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS203",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a file without name, version, date or author",
    explanation: "`[FileInfo]` says what the file is called, which version and revision it has, and who made and \
        changed it, and when; a DCF also names the EDS it was made from. Nothing else distinguishes two versions of a \
        file. Fill in what is missing; an empty key counts as missing.",
    clause: Some("CiA 306 4.4 and 5.2"),
    example: Some(Example::eds(
        "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\nDescription=Example\nCreationTime=09:00AM\nCreationDate=01-31-2020\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=01-31-2020",
        "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\nDescription=Example\nCreationTime=09:00AM\nCreationDate=01-31-2020\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=01-31-2020\nModifiedBy=Example",
    )),
};

const KEYS: [&str; 10] = [
    "FileName",
    "FileVersion",
    "FileRevision",
    "Description",
    "CreationTime",
    "CreationDate",
    "CreatedBy",
    "ModificationTime",
    "ModificationDate",
    "ModifiedBy",
];

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::FileInfo) else { return };
    let last = view.is_dcf.then_some("LastEDS");
    let missing: Vec<&str> = KEYS.into_iter().chain(last).filter(|key| part.value(key).is_none()).collect();
    if !missing.is_empty() {
        let message = format!("`[FileInfo]` does not say {}", enumeration(&missing));
        diagnostics.push(Diagnostic::new(CODE, part.place(), message).help("fill in what is missing"));
    }
}
