//! How texts of a language are built, as far as it takes to change them with effect.

mod eds;
mod settings;
mod templates;
mod xdd;
mod yaml;

pub use eds::EDS;
pub use settings::SETTINGS;
pub use templates::TEMPLATES;
pub use xdd::XDD;
pub use yaml::YAML;

/// What a text is made of.
#[derive(Debug, Clone, Copy)]
pub struct Notation {
    /// What its sections look like.
    pub layout: Layout,
    /// What is between a key and its value.
    pub sign: char,
    /// Most changes of one mutant. After one change of a specification most are refused, and then nothing is printed.
    pub most_changes: usize,
    /// Lines that mean something, to put anywhere.
    pub lines: &'static [&'static str],
    /// Values at the edge of what is allowed, and beyond.
    pub values: &'static [&'static str],
    /// Names of sections.
    pub headers: &'static [&'static str],
}

/// How lines form sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// A section begins with its name in brackets.
    Bracketed,
    /// A section begins with a line that is indented by two or not at all.
    Indented,
    /// A section begins with an instruction: `{% … %}`.
    Instructed,
    /// A section is an object or a parameter, with what is in it; what these lie in are sections, too.
    Elements,
    /// All lines are alike.
    Plain,
}

impl Notation {
    /// Whether a section begins with this line.
    pub(super) fn is_header(&self, line: &str) -> bool {
        match self.layout {
            Layout::Bracketed => line.starts_with('['),
            Layout::Indented => {
                let name = line.strip_prefix("  ").unwrap_or(line);
                !name.starts_with([' ', '#', '-', '\n', '\r'])
            }
            Layout::Instructed => line.starts_with("{%"),
            Layout::Elements => xdd::is_item(line) || xdd::is_around(line),
            Layout::Plain => false,
        }
    }

    /// Whether what this line begins belongs to every part of a text: without it, the sections below mean nothing.
    pub(super) fn is_frame(&self, line: &str) -> bool {
        match self.layout {
            Layout::Indented => !line.starts_with([' ', '#']),
            Layout::Elements => xdd::is_around(line),
            Layout::Bracketed | Layout::Instructed | Layout::Plain => false,
        }
    }

    /// The first line of a section, without its break.
    pub(super) fn header(&self, name: &str) -> String {
        match self.layout {
            Layout::Bracketed => format!("[{name}]"),
            Layout::Indented => format!("{name}:"),
            Layout::Instructed => format!("{{% {name} %}}"),
            Layout::Elements => format!("<{name}"),
            Layout::Plain => name.to_owned(),
        }
    }

    /// The first line of a section under another index.
    pub(super) fn numbered(&self, header: &str, index: usize) -> String {
        let line_end = header.trim_end_matches(['\r', '\n']).len();
        let (text, line_break) = header.split_at(line_end);
        match self.layout {
            Layout::Bracketed => format!("[{index:04X}]{line_break}"),
            Layout::Indented => {
                let rest = text.split_once(self.sign).map_or("", |(_, rest)| rest);
                format!("  0x{index:04X}:{rest}{line_break}")
            }
            // The index is among the attributes.
            Layout::Elements | Layout::Instructed | Layout::Plain => header.to_owned(),
        }
    }

    /// Where the name of a section begins in its first line.
    pub(super) fn name_start(&self, header: &str) -> usize {
        match self.layout {
            Layout::Bracketed => 1,
            Layout::Indented => header.len() - header.trim_start_matches(' ').len(),
            Layout::Instructed => 2,
            Layout::Elements => header.find('<').map_or(0, |at| at + 1),
            Layout::Plain => 0,
        }
        .min(header.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_begin_where_a_language_begins_them() {
        let headers = |notation: &Notation, lines: &[&str]| -> Vec<bool> {
            lines.iter().map(|line| notation.is_header(line)).collect()
        };
        assert_eq!(headers(&EDS, &["[1000]\n", "a=1\n", "\n"]), [true, false, false]);
        let lines = ["objects:\n", "  0x2000: {}\n", "    1: {}\n", "# a\n", "  - b\n", "\n"];
        assert_eq!(headers(&YAML, &lines), [true, true, false, false, false, false]);
        assert_eq!(headers(&TEMPLATES, &["{% for a in b %}\n", "{{ a }}\n"]), [true, false]);
        assert_eq!(headers(&SETTINGS, &["2000=1\n"]), [false]);
        assert!(YAML.is_frame("objects:\n") && !YAML.is_frame("  0x2000: {}\n"));
    }

    #[test]
    fn a_section_gets_another_index() {
        assert_eq!(EDS.numbered("[1000]\r\n", 0x2000), "[2000]\r\n");
        assert_eq!(YAML.numbered("  0x1000: {name: a}\n", 0x2000), "  0x2000: {name: a}\n");
        assert_eq!(TEMPLATES.numbered("{% a %}\n", 5), "{% a %}\n");
        assert_eq!(YAML.name_start("  0x1000:"), 2);
        assert_eq!(EDS.name_start(""), 0);
    }
}
