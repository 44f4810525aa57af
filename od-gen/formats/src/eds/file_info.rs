//! `[FileInfo]` (CiA 306 4.4): the file's name, version, times and people.

use od_spec::eds::{Document, GENERATED, date_text, time_text};
use od_spec::model::Dictionary;

use super::writer::SectionWriter;

/// `[FileInfo]` of a file under a name, with the comment that states that it is generated. A DCF names the EDS that it
/// was made from.
pub(super) fn write(document: &mut Document<'_>, device: &Dictionary, file: &str, last_eds: Option<&str>) {
    let info = &device.file;
    let mut section = SectionWriter::new("FileInfo", &[GENERATED.to_owned()]);
    section.text("FileName", file);
    section.key("FileVersion", info.version);
    section.key("FileRevision", info.revision);
    section.text("EDSVersion", "4.0");
    section.text("Description", &info.description);
    section.text("CreationTime", &time_text((info.created.hour, info.created.minute)));
    section.key("CreationDate", date_text(info.created.date));
    section.text("CreatedBy", &info.created_by);
    section.text("ModificationTime", &time_text((info.modified.hour, info.modified.minute)));
    section.key("ModificationDate", date_text(info.modified.date));
    section.text("ModifiedBy", &info.modified_by);
    if let Some(last_eds) = last_eds {
        section.text("LastEDS", last_eds);
    }
    section.finish(device, document);
}
