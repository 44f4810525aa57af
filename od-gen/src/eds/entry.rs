//! The keys of an entry's section (CiA 306 4.6.3.2).

use od_spec::Commissioning;
use od_spec::model::{DataType, Entry, EntryId, Object, ObjectKind, PdoMapping};

use super::value;
use super::writer::SectionWriter;

/// The keys of an entry under a name; with its value on a node in a DCF.
pub(super) fn write(
    section: &mut SectionWriter,
    object: &Object,
    entry: &Entry,
    name: &str,
    node: Option<&Commissioning>,
) {
    let is_domain = entry.data_type == DataType::Domain;
    let kind = if is_domain { ObjectKind::Domain } else { ObjectKind::Var };
    section.key("ParameterName", name);
    section.key("ObjectType", format_args!("0x{:X}", kind.code()));
    section.key("DataType", format_args!("0x{:04X}", entry.data_type.code()));
    let (low, high) = entry.hull();
    if let Some(low) = low {
        section.key("LowLimit", low);
    }
    if let Some(high) = high {
        section.key("HighLimit", high);
    }
    section.key("AccessType", entry.eds.access.word());
    let notation = value::Notation { object, entry, node: node.map(|commissioning| commissioning.node) };
    if let Some(default) = entry.default.as_ref().filter(|_| entry.eds.default && !is_domain) {
        section.value("DefaultValue", &notation.text(default));
    }
    if !is_domain {
        section.flag("PDOMapping", entry.pdo != PdoMapping::None);
    }
    if entry.eds.flags() != 0 {
        section.key("ObjFlags", entry.eds.flags());
    }
    let id = EntryId { index: object.index, sub: entry.sub };
    if let Some(value) = node.and_then(|commissioning| commissioning.values.get(&id)) {
        section.value("ParameterValue", &notation.text(value));
    }
}
