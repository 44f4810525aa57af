//! What values of an EDS or DCF refer to: the entry that a PDO maps, the object that a list names.

use od_spec::eds::{Document, Owner, SectionRef, owner};
use od_spec::model::{EntryId, Index, Role, SubIndex};
use od_spec::scalar;
use od_spec::source::{FileId, Span};

/// A value that refers to an entry, or to an object by its sub-index 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Referring {
    /// The value.
    pub value: Span,
    /// The entry.
    pub id: EntryId,
}

/// All values that refer to something, in the order of the text.
pub(super) fn referring(file: FileId, text: &str) -> Vec<Referring> {
    let document = Document::scan(file, text);
    let mut found = Vec::new();
    for section in document.sections() {
        for line in section.keys() {
            let (Some(key), Some(value), Some(place)) = (line.key(), line.value(), document.place(line))
            else {
                continue;
            };
            let Some(id) = number(value).and_then(|number| meant(&section, key, number)) else { continue };
            // The key ends at the first equals sign, and the value is what follows it.
            let written = text.get(place.start as usize..place.end as usize).unwrap_or_default();
            let after = written.find('=').map_or(0, |at| at + 1);
            let Some(at) = written[after..].find(value) else { continue };
            found.push(Referring { value: place.part(after + at, after + at + value.len()), id });
        }
    }
    found
}

fn number(text: &str) -> Option<u32> {
    u32::try_from(scalar::integer(text).ok()?).ok()
}

/// The entry that a number means in a section.
fn meant(section: &SectionRef<'_, '_>, key: &str, number: u32) -> Option<EntryId> {
    let is = |name: &str| section.name().eq_ignore_ascii_case(name);
    let is_item = key.bytes().all(|byte| byte.is_ascii_digit());
    if is_item && ["MandatoryObjects", "OptionalObjects", "ManufacturerObjects"].into_iter().any(is) {
        return Some(EntryId { index: Index(u16::try_from(number).ok()?), sub: SubIndex(0) });
    }
    let is_mapping = |index| Role::of(index) == Role::PdoMapping;
    let is_value = match owner(section.name()) {
        Owner::Entry(id) => {
            let is_key =
                ["DefaultValue", "ParameterValue"].into_iter().any(|one| key.eq_ignore_ascii_case(one));
            is_mapping(id.index) && id.sub.0 > 0 && is_key
        }
        Owner::Object(index) => {
            is_mapping(index) && is_item && section.name().to_ascii_lowercase().ends_with("value")
        }
        Owner::File => false,
    };
    let [high, low, sub, _] = number.to_be_bytes();
    let id = EntryId { index: Index(u16::from_be_bytes([high, low])), sub: SubIndex(sub) };
    // Data types fill a PDO; they are not entries.
    (is_value && id.index.0 >= 0x1000).then_some(id)
}

/// The header of the section that describes an entry, or else its object.
pub(super) fn section_of(file: FileId, text: &str, id: EntryId) -> Option<Span> {
    let document = Document::scan(file, text);
    let header = |wanted: Owner| {
        let mut sections = document.sections();
        let section = sections.find(|section| {
            let ends_plain = section.name().ends_with(|c: char| c.is_ascii_hexdigit());
            owner(section.name()) == wanted && ends_plain
        })?;
        document.place(section.header())
    };
    header(Owner::Entry(id)).or_else(|| header(Owner::Object(id.index)))
}
