//! The keys of an entry's section (CiA 306 4.6.3.2).

use od_spec::model::{DataType, Entry, EntryId, Object, ObjectKind, PdoMapping};
use od_spec::{Commissioning, Denoted};

use super::value;
use super::writer::SectionWriter;

/// The keys of an entry under a name; in a DCF with its value on a node, and what else belongs to the node.
pub(super) fn write(
    section: &mut SectionWriter,
    object: &Object,
    entry: &Entry,
    name: &str,
    node: Option<&Commissioning>,
) {
    let is_domain = entry.data_type == DataType::Domain;
    let kind = if is_domain { ObjectKind::Domain } else { ObjectKind::Var };
    section.text("ParameterName", name);
    section.hexadecimal("ObjectType", kind.code(), 1);
    section.hexadecimal("DataType", entry.data_type.code(), 4);
    let (low, high) = entry.hull();
    if let Some(low) = low {
        section.key("LowLimit", low);
    }
    if let Some(high) = high {
        section.key("HighLimit", high);
    }
    for (key, limit) in [("LowLimit", &entry.real_limits.low), ("HighLimit", &entry.real_limits.high)] {
        if let Some(limit) = limit {
            section.key(key, format_args!("{:?}", limit.number()));
        }
    }
    let id = EntryId { index: object.index, sub: entry.sub };
    let eds = node.map_or(entry.eds, |node| node.shown(id, entry));
    section.text("AccessType", eds.access.word());
    let notation = value::Notation { object, entry, node: node.map(|commissioning| commissioning.node) };
    if let Some(default) = entry.default.as_ref().filter(|_| eds.default && !is_domain) {
        section.value("DefaultValue", &notation.text(default));
    }
    if !is_domain {
        section.flag("PDOMapping", entry.pdo != PdoMapping::None);
    }
    if eds.flags() != 0 {
        section.key("ObjFlags", eds.flags());
    }
    let Some(node) = node else { return };
    if let Some(value) = node.values.get(&id) {
        section.value("ParameterValue", &notation.text(value));
    }
    denotation(
        section,
        node,
        if object.is_structured() { Denoted::entry(id) } else { Denoted::object(id.index) },
    );
    if let Some(files) = node.files.get(&id) {
        for (key, path) in [("UploadFile", &files.upload), ("DownloadFile", &files.download)] {
            if let Some(path) = path {
                section.value(key, path);
            }
        }
    }
}

/// What an object or entry of a node is called in the application and in drawings of the plant.
pub(super) fn denotation(section: &mut SectionWriter, node: &Commissioning, of: Denoted) {
    if let Some(name) = node.denotations.get(&of) {
        section.text("Denotation", name);
    }
    if let Some(reference) = node.references.get(&of) {
        section.text("ParamRefd", reference);
    }
}
