//! The lists of objects (CiA 306 4.6.3.1), each followed by the sections of its objects.

use od_spec::eds::Document;
use od_spec::model::{Dictionary, Entry, Object, System};
use od_spec::{Commissioning, Denoted};

use super::comments;
use super::entry;
use super::writer::{SectionWriter, entry_section, object_section, write_further};

/// The list that an object is in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum List {
    Mandatory,
    Optional,
    Manufacturer,
}

impl List {
    const ALL: [Self; 3] = [Self::Mandatory, Self::Optional, Self::Manufacturer];

    const fn of(object: &Object) -> Self {
        match object.index.0 {
            0x1000 | 0x1001 | 0x1018 => Self::Mandatory,
            0x2000..=0x5FFF => Self::Manufacturer,
            _ => Self::Optional,
        }
    }

    const fn section(self) -> &'static str {
        match self {
            Self::Mandatory => "MandatoryObjects",
            Self::Optional => "OptionalObjects",
            Self::Manufacturer => "ManufacturerObjects",
        }
    }
}

/// The three lists with their objects, and what a file says in addition to them; with the values of a node in a DCF.
pub(super) fn write(
    document: &mut Document<'_>,
    system: &System,
    device: &Dictionary,
    node: Option<&Commissioning>,
) {
    for list in List::ALL {
        let objects: Vec<&Object> =
            device.objects.values().filter(|object| List::of(object) == list).collect();
        let mut section = SectionWriter::new(list.section(), &[]);
        section.key("SupportedObjects", objects.len());
        for (number, object) in (1..).zip(&objects) {
            section.hexadecimal(&number.to_string(), object.index.0, 4);
        }
        section.finish(device, document);
        for object in objects {
            write_object(document, system, device, object, node);
        }
    }
    if let Some(further) = &device.further {
        write_further(document, further);
        if node.is_some() {
            write_connected(document, device, &further.connected);
        }
    }
}

/// `[ConnectedModules]` of a DCF (CiA 306 6.4), where modules are plugged in.
fn write_connected(document: &mut Document<'_>, device: &Dictionary, modules: &[u32]) {
    if modules.is_empty() {
        return;
    }
    let mut section = SectionWriter::new("ConnectedModules", &[]);
    section.key("NrOfEntries", modules.len());
    for (place, module) in (1..).zip(modules) {
        section.key(&place.to_string(), module);
    }
    section.finish(device, document);
}

fn write_object(
    document: &mut Document<'_>,
    system: &System,
    device: &Dictionary,
    object: &Object,
    node: Option<&Commissioning>,
) {
    let language = system.language();
    let name = object_section(object.index);
    if !object.is_structured() {
        for var in &object.entries {
            let mut section =
                SectionWriter::new(&name, &comments::entry(device, object.index, var, node, language));
            entry::write(&mut section, object, var, &object.eds_name_of(var), node);
            of_object(&mut section, object);
            of_entry(&mut section, object, var);
            section.finish(device, document);
        }
        write_links(document, device, object);
        return;
    }
    let mut section = SectionWriter::new(&name, &comments::object(object, language));
    section.key("SubNumber", object.entries.len());
    section.text("ParameterName", &object.eds_name());
    section.hexadecimal("ObjectType", object.kind.code(), 1);
    if let Some(node) = node {
        entry::denotation(&mut section, node, Denoted::object(object.index));
    }
    of_object(&mut section, object);
    section.finish(device, document);
    for member in &object.entries {
        let name = entry_section(object.index, member.sub);
        let mut section =
            SectionWriter::new(&name, &comments::entry(device, object.index, member, node, language));
        entry::write(&mut section, object, member, &object.eds_name_of(member), node);
        of_entry(&mut section, object, member);
        section.finish(device, document);
    }
    write_links(document, device, object);
}

/// What CANopenEditor keeps of an object as a whole.
fn of_object(section: &mut SectionWriter, object: &Object) {
    for (property, value) in object.editor.iter().flat_map(|notes| notes.of_object()) {
        section.property(property, value);
    }
}

/// What CANopenEditor keeps of an entry.
fn of_entry(section: &mut SectionWriter, object: &Object, entry: &Entry) {
    if let Some((property, value)) = object.editor.as_ref().and_then(|notes| notes.of_entry(entry.sub)) {
        section.property(property, value);
    }
}

/// The objects that belong together with an object (CiA 306 4.6.4).
fn write_links(document: &mut Document<'_>, device: &Dictionary, object: &Object) {
    if object.links.is_empty() {
        return;
    }
    let mut section = SectionWriter::new(&format!("{:X}ObjectLinks", object.index.0), &[]);
    section.key("ObjectLinks", object.links.len());
    for (number, index) in (1..).zip(object.linked()) {
        section.hexadecimal(&number.to_string(), index.0, 4);
    }
    section.finish(device, document);
}
