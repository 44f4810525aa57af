//! What a file says beyond the standard: keys of a maker, and whole sections.

use super::check::keys;
use super::document::Document;
use super::line::LineKind;
use super::names::{Topic, topic};
use super::owner::{Owner, owner};

/// A key that the standard does not have where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extra<'d> {
    /// What it stands at.
    pub owner: Owner,
    /// Its section, where that is about no object: `Tools`.
    pub section: Option<&'d str>,
    /// The line, without blanks around it: `Unit=mm`.
    pub text: &'d str,
}

impl Document<'_> {
    /// The keys that the reader finds no meaning in, in the order of the file. Misspelled ones of the standard are among them,
    /// if more than capitals differ.
    pub fn extras(&self) -> Vec<Extra<'_>> {
        let mut extras = Vec::new();
        for section in self.sections() {
            let topic = topic(section.name());
            let known = keys::of(topic);
            let is_extra = |key: &str| {
                known.as_ref().is_none_or(|known| !known.is_standard(key) && known.spelling(key).is_none())
            };
            let owner = owner(section.name());
            let name = (owner == Owner::File).then(|| section.name());
            // What the standard leaves to the maker has no keys of the standard, but a meaning.
            if topic == Topic::DynamicChannels {
                continue;
            }
            for line in section.body().iter().filter(|line| line.kind() == LineKind::KeyValue) {
                let is_empty = line.value().is_none_or(str::is_empty);
                if !is_empty && line.key().is_some_and(is_extra) {
                    extras.push(Extra { owner, section: name, text: line.text().trim() });
                }
            }
        }
        extras
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Index;
    use crate::source::SourceMap;

    #[test]
    fn what_the_standard_has_is_no_extra() {
        let text = "[FileInfo]\nfileversion=1\nAuthor=me\n[Vendor]\nColor=1\n[2000]\nParameterName=a\n  Unit=mm \nNote=\n\
            [Comments]\nLines=1\nLine1=x\n";
        let mut sources = SourceMap::new();
        let file = sources.add("a.eds", text);
        let document = Document::scan(file, text);
        let extras: Vec<_> =
            document.extras().into_iter().map(|one| (one.owner, one.section, one.text)).collect();
        assert_eq!(
            extras,
            [
                (Owner::File, Some("FileInfo"), "Author=me"),
                (Owner::File, Some("Vendor"), "Color=1"),
                (Owner::Object(Index(0x2000)), None, "Unit=mm"),
            ]
        );
    }
}
