//! What is demanded of every set of templates, however wrong.

use od_documents::{self as docs, Format, Options, TemplateError, Templates};
use od_spec::model::System;

use super::bounds::caught;
use super::notation::{Notation, TEMPLATES};
use super::{Complaint, Seed, Subject};
use crate::{Failure, compile_with_sources};

/// The shipped templates, one of which is a user's own.
#[derive(Debug)]
pub struct TemplateFiles {
    system: System,
    options: Options,
}

/// A small device, with something in every chapter of its documents.
const DEVICE: &str = "tests/ui/ok_everything.od.yaml";
/// What the names of seeds begin with.
const FORMATS: [(&str, Format); 3] =
    [("md/", Format::Markdown), ("html/", Format::Html), ("print/", Format::Print)];

impl TemplateFiles {
    /// Documents of a small device.
    ///
    /// # Errors
    /// Its specification cannot be read.
    pub fn new() -> Result<Self, Failure> {
        let (system, _) = compile_with_sources(DEVICE)?;
        let options = docs::options(&system, &[], None);
        Ok(Self { system, options })
    }

    /// The shipped templates.
    pub fn seeds() -> Vec<Seed> {
        let seeds = FORMATS.into_iter().flat_map(|(folder, format)| {
            format.files().iter().map(move |(name, text)| Seed {
                name: format!("{folder}{name}"),
                bytes: text.as_bytes().to_vec(),
            })
        });
        seeds.collect()
    }

    fn print(&self, format: Format, file: &str, text: &str) -> Option<String> {
        let replacement = (file.to_owned(), text.to_owned());
        let printed = Templates::new(Some(format), &[replacement])
            .and_then(|set| docs::artifacts(&self.system, "", "mutant", &self.options, &[set]));
        complaint(&printed.err()?)
    }
}

impl Subject for TemplateFiles {
    fn notation(&self) -> &Notation {
        &TEMPLATES
    }

    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint> {
        let text = String::from_utf8_lossy(bytes);
        let wrong = FORMATS.into_iter().filter_map(|(folder, format)| {
            let file = name.strip_prefix(folder)?;
            caught(|| self.print(format, file, &text)).unwrap_or_else(Some)
        });
        wrong.map(|what| Complaint { step: "templates".to_owned(), what }).collect()
    }
}

/// A mistake is told in words, with a place in the template.
fn complaint(error: &TemplateError) -> Option<String> {
    let TemplateError::InTemplate { template, source, range, message } = error else {
        return Some(format!("`{error}` has no place"));
    };
    let has_place = source.get(range.clone()).is_some();
    if template.is_empty() || !has_place {
        Some(format!("`{message}` has no place"))
    } else if message.trim().is_empty() || message.chars().any(char::is_control) {
        Some(format!("`{}` says nothing", message.escape_debug()))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_has_a_place_and_a_text() {
        let error = |template: &str, range, message: &str| {
            let (template, source) = (template.to_owned(), "ä".to_owned());
            complaint(&TemplateError::InTemplate { template, source, range, message: message.to_owned() })
        };
        assert_eq!(error("a.md", 0..2, "wrong"), None);
        assert_eq!(error("a.md", 0..1, "wrong").as_deref(), Some("`wrong` has no place"));
        assert_eq!(error("", 0..2, "wrong").as_deref(), Some("`wrong` has no place"));
        let of_set = complaint(&TemplateError::SamePage("a.md".to_owned()));
        assert!(of_set.is_some_and(|what| what.ends_with("has no place")));
        assert_eq!(error("a.md", 0..2, "a\nb").as_deref(), Some("`a\\nb` says nothing"));
    }

    #[test]
    fn the_shipped_templates_are_right() {
        let subject = TemplateFiles::new().unwrap();
        for seed in TemplateFiles::seeds() {
            assert_eq!(subject.complaints(&seed.name, &seed.bytes), []);
        }
    }
}
