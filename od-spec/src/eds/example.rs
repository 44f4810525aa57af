//! The texts of examples as whole files.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::document::Document;
use super::line::Line;
use super::names::{List, Topic, topic};
use crate::diag::Language;
use crate::model::Index;
use crate::source::SourceMap;

/// What an EDS has at the least besides `[FileInfo]` and the lists of objects.
const SECTIONS: [(Topic, &str); 4] = [
    (
        Topic::DeviceInfo,
        "[DeviceInfo]\nVendorName=Example\nVendorNumber=1\nProductName=Example\nProductNumber=1\nRevisionNumber=1\nOrderCode=Example\n\
         BaudRate_10=0\nBaudRate_20=0\nBaudRate_50=0\nBaudRate_125=1\nBaudRate_250=0\nBaudRate_500=0\nBaudRate_800=0\nBaudRate_1000=0\n\
         SimpleBootUpMaster=0\nSimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\n\
         LSS_Supported=0\n",
    ),
    (
        Topic::DummyUsage,
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0\n",
    ),
    (Topic::Comments, "[Comments]\nLines=0\n"),
    (Topic::Commissioning, "[DeviceComissioning]\nNodeID=1\nBaudrate=125\n"),
];

/// A text with the sections that every EDS or DCF has after it, where it has none of its own: the objects that it
/// describes are listed. A comment `; without [Comments]` leaves one out; `; ...` represents the other keys of
/// `[FileInfo]` or `[DeviceInfo]`.
pub(crate) fn whole(language: Language, text: &str) -> String {
    let text = &with_other_keys(language, text);
    let mut sources = SourceMap::new();
    let file = sources.add(language.file_name(), text);
    let document = Document::scan(file, text);
    let described: BTreeSet<Topic> = document.sections().map(|section| topic(section.name())).collect();
    let left_out = document
        .lines()
        .iter()
        .filter_map(Line::comment)
        .filter_map(|comment| comment.strip_prefix("without [")?.strip_suffix(']').map(topic));
    let own: BTreeSet<Topic> = described.iter().copied().chain(left_out).collect();
    let mut whole = format!("{text}\n");
    if !own.contains(&Topic::FileInfo) {
        whole.push_str(&file_info(language));
    }
    for (topic, section) in SECTIONS {
        if !own.contains(&topic) && (language == Language::Dcf || topic != Topic::Commissioning) {
            let _ = write!(whole, "\n{section}");
        }
    }
    for list in List::ALL.into_iter().filter(|list| !own.contains(&Topic::Objects(*list))) {
        let objects = described.iter().filter_map(|topic| match topic {
            Topic::Object(index) if List::of(*index) == list => Some(*index),
            _ => None,
        });
        whole.push_str(&object_list(list, &objects.collect::<Vec<_>>()));
    }
    whole
}

fn with_other_keys(language: Language, text: &str) -> String {
    let file = file_info(language);
    let sections = SECTIONS.iter().map(|(_, section)| *section).chain([file.trim_start()]);
    let own =
        sections.filter_map(|section| section.split_once('\n')).find(|(header, _)| text.starts_with(header));
    let Some((_, keys)) = own else { return text.to_owned() };
    let key = |line: &str| line.split('=').next().unwrap_or_default().to_owned();
    let others = keys.lines().filter(|line| !text.lines().any(|own| key(own) == key(line)));
    text.replace("; ...", &others.collect::<Vec<_>>().join("\n"))
}

fn file_info(language: Language) -> String {
    let last = if language == Language::Dcf { "LastEDS=example.eds\n" } else { "" };
    format!(
        "\n[FileInfo]\nFileName={}\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\nDescription=Example\nCreationTime=09:00AM\n\
         CreationDate=01-31-2020\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=01-31-2020\nModifiedBy=Example\n{last}",
        language.file_name()
    )
}

fn object_list(list: List, objects: &[Index]) -> String {
    let mut text = format!("\n[{}]\nSupportedObjects={}\n", list.section(), objects.len());
    for (at, index) in objects.iter().enumerate() {
        let _ = writeln!(text, "{}=0x{:04X}", at + 1, index.0);
    }
    text
}
