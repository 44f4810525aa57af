//! `[FileInfo]` (CiA 306 4.4): the file's name, version, times and people.

use od_spec::eds::Document;
use od_spec::model::{Date, DateTime, Dictionary};

use super::writer::SectionWriter;

/// `[FileInfo]` of a file under a name. A DCF names the EDS that it was made from.
pub(super) fn write(document: &mut Document<'_>, device: &Dictionary, file: &str, last_eds: Option<&str>) {
    let info = &device.file;
    let mut section = SectionWriter::new("FileInfo", &[]);
    section.key("FileName", file);
    section.key("FileVersion", info.version);
    section.key("FileRevision", info.revision);
    section.key("EDSVersion", "4.0");
    section.key("Description", &info.description);
    section.key("CreationTime", time(info.created));
    section.key("CreationDate", date(info.created.date));
    section.key("CreatedBy", &info.created_by);
    section.key("ModificationTime", time(info.modified));
    section.key("ModificationDate", date(info.modified.date));
    section.key("ModifiedBy", &info.modified_by);
    if let Some(last_eds) = last_eds {
        section.key("LastEDS", last_eds);
    }
    section.finish(document);
}

/// `mm-dd-yyyy`.
fn date(date: Date) -> String {
    format!("{:02}-{:02}-{:04}", date.month, date.day, date.year)
}

/// `hh:mmAM`.
fn time(at: DateTime) -> String {
    let half = if at.hour < 12 { "AM" } else { "PM" };
    let hour = match at.hour % 12 {
        0 => 12,
        hour => hour,
    };
    format!("{hour:02}:{:02}{half}", at.minute)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_hour_clock() {
        let at = |hour, minute| time(DateTime { date: Date { year: 2009, month: 5, day: 27 }, hour, minute });
        assert_eq!(at(0, 0), "12:00AM");
        assert_eq!(at(9, 5), "09:05AM");
        assert_eq!(at(12, 30), "12:30PM");
        assert_eq!(at(23, 59), "11:59PM");
    }
}
