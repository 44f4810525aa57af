//! What readers are reported to stumble over, and no rule says.

use super::python::{Ini, int};
use od_spec::diag::Diagnostic;
use od_spec::diag::readers::codes::BOTH_WAYS;
use od_spec::diag::readers::{Reader, Readers};
use od_spec::source::{FileId, Span};

/// The first index that is not an object of communication.
const FIRST_OF_DEVICE: u32 = 0x2000;

/// A note about entries that may be mapped and are both read and written. Of a text that is read without regard to case.
pub(super) fn both_ways(ini: &Ini<'_>, file: FileId) -> Option<Diagnostic> {
    let entries = ini.sections.iter().filter(|section| {
        let index = section.name.get(..4).and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let is_mappable =
            section.value("PDOMapping").and_then(|text| int(text, 0)).is_some_and(|flag| flag != 0);
        let is_both = section.value("AccessType").is_some_and(|access| access.eq_ignore_ascii_case("rw"));
        index.is_some_and(|index| index >= FIRST_OF_DEVICE) && is_mappable && is_both
    });
    let places: Vec<_> = entries.map(|section| section.place("AccessType")).collect();
    let first = places.first()?;
    let at = |offset| u32::try_from(offset).unwrap_or(u32::MAX);
    let place = Span { file, start: at(first.start), end: at(first.end) };
    let message = match places.len() {
        1 => "an entry that may be mapped is both read and written".to_owned(),
        count => format!("{count} entries that may be mapped are both read and written"),
    };
    let mut note = Diagnostic::new(BOTH_WAYS, place, message)
        .help("write rwr for what the device sends, rww for what it receives");
    note.minded_by = Readers::of(&[Reader::Codesys]);
    Some(note)
}
