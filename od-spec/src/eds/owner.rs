//! Which object or entry a place of a document belongs to, and which of its comments say nothing about one.

use super::document::{Document, SectionRef};
use super::line::LineKind;
use super::names::{Topic, topic};
use crate::model::{EntryId, Index, SubIndex};
use crate::source::Span;

/// What a section is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Owner {
    /// The file or the device.
    File,
    /// An object; of a VAR, its entry.
    Object(Index),
    /// An entry of a structured object.
    Entry(EntryId),
}

/// A comment of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark<'d> {
    /// What it stands at.
    pub owner: Owner,
    /// Its text, without the sign in front of it.
    pub text: &'d str,
}

/// What the section of a name is about.
pub(super) fn owner(section: &str) -> Owner {
    match topic(section) {
        Topic::Object(index) | Topic::Elements(index, _) | Topic::ObjectLinks(index) => Owner::Object(index),
        Topic::Sub(index, sub) => match u8::try_from(sub) {
            Ok(sub) => Owner::Entry(EntryId { index, sub: SubIndex(sub) }),
            Err(_) => Owner::Object(index),
        },
        Topic::FileInfo
        | Topic::DeviceInfo
        | Topic::DummyUsage
        | Topic::Comments
        | Topic::Objects(_)
        | Topic::Commissioning
        | Topic::DynamicChannels
        | Topic::Tools
        | Topic::Tool(_)
        | Topic::SupportedModules
        | Topic::ConnectedModules
        | Topic::Module(..)
        | Topic::Unknown => Owner::File,
    }
}

impl Document<'_> {
    /// What a place in the document is about.
    pub fn owner(&self, place: Span) -> Owner {
        self.header_before(place.start).and_then(super::Line::name).map_or(Owner::File, owner)
    }

    /// The comments that the reader finds no meaning in, in the order of the file.
    pub fn remarks(&self) -> Vec<Remark<'_>> {
        let mut remarks: Vec<Remark<'_>> = Vec::new();
        for line in self.preamble() {
            if let Some(text) = line.comment() {
                // What stands above the first header is above a section.
                remarks.push(Remark { owner: Owner::File, text });
            }
        }
        let sections: Vec<SectionRef<'_, '_>> = self.sections().collect();
        for (at, section) in sections.iter().enumerate() {
            let body = section.body();
            let is_key = |line: &super::Line<'_>| !matches!(line.kind(), LineKind::Blank | LineKind::Comment);
            let keys_end = body.iter().rposition(is_key).map_or(0, |last| last + 1);
            for text in body[..keys_end].iter().filter_map(super::Line::comment) {
                remarks.push(Remark { owner: owner(section.name()), text });
            }
            let next = sections.get(at + 1).map_or(Owner::File, |next| owner(next.name()));
            let above = &body[keys_end..];
            let directly = above.iter().rev().take_while(|line| line.kind() == LineKind::Comment).count();
            let (apart, directly) = above.split_at(above.len() - directly);
            for text in apart.iter().filter_map(super::Line::comment) {
                remarks.push(Remark { owner: next, text });
            }
            for text in directly.iter().filter_map(super::Line::comment) {
                if next == Owner::File || is_code(text) {
                    remarks.push(Remark { owner: next, text });
                }
            }
        }
        // Lines that only divide say nothing.
        remarks.retain(|remark| remark.text.chars().any(char::is_alphanumeric));
        remarks
    }
}

/// Whether a comment is a part of the file that somebody took out: `;[6406]`, `;AccessType=rw`.
pub(crate) fn is_code(text: &str) -> bool {
    let text = text.trim();
    let is_word = |key: &str| key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    text.starts_with('[') || text.split_once('=').is_some_and(|(key, _)| is_word(key))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    #[test]
    fn comments_without_a_meaning_stand_at_what_they_are_about() {
        let text = "; made by hand\n[FileInfo]\nA=1\n;inside\n\n; apart\n\n; unit mm\n;----\n[2000]\nB=2\n;StorageLocation=RAM\nC=3\n\
            ;[2001]\n[2000sub1]\nD=4\n; at the end\n";
        let mut sources = SourceMap::new();
        let file = sources.add("a.eds", text);
        let document = Document::scan(file, text);
        let object = Owner::Object(Index(0x2000));
        let entry = Owner::Entry(EntryId { index: Index(0x2000), sub: SubIndex(1) });
        let remarks: Vec<(Owner, &str)> =
            document.remarks().into_iter().map(|remark| (remark.owner, remark.text)).collect();
        assert_eq!(
            remarks,
            [
                (Owner::File, "made by hand"),
                (object, "inside"),
                (object, "apart"),
                (object, "StorageLocation=RAM"),
                (entry, "[2001]"),
                (Owner::File, "at the end"),
            ]
        );
        let at = |needle: &str| {
            let start = u32::try_from(text.find(needle).unwrap()).unwrap();
            document.owner(Span { file, start, end: start })
        };
        assert_eq!((at("A=1"), at("B=2"), at("D=4")), (Owner::File, object, entry));
    }
}
