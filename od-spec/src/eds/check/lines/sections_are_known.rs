//! Every section is one of the standard.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, nearest, shorten};
use crate::eds::names::{Topic, canonical};
use crate::eds::view::{View, name_place};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS116",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "an unknown section",
    explanation: "The standard has no section of this name. It is allowed to add some, so most readers ignore it; \
        lely's dcfchk refuses the file. Where the name is a misspelling, a section that the standard wants is \
        missing.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[VendorSpecific]\nColor=1", "; Color is 1")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for section in &view.unknown {
        let place = name_place(section.header(), view.file);
        found.add(place, [], || message(section.name()).at(place));
    }
    found.finish("sections", diagnostics);
}

/// What is said about a name.
struct Message {
    text: String,
    help: Help,
}

/// What to do about it.
enum Help {
    /// Write this name.
    Word(String),
    Text(&'static str),
}

impl Message {
    fn at(self, place: crate::source::Span) -> Diagnostic {
        let diagnostic = Diagnostic::new(CODE, place, self.text);
        match self.help {
            Help::Word(word) => diagnostic.did_you_mean(&word),
            Help::Text(text) => diagnostic.help(text),
        }
    }
}

fn message(name: &str) -> Message {
    let plain = Topic::OF_EVERY_FILE.into_iter().chain([Topic::Commissioning, Topic::SupportedModules]);
    let known: Vec<String> = plain.filter_map(canonical).collect();
    let is_number = name.len() > 4 && name.bytes().all(|byte| byte.is_ascii_hexdigit());
    let text = format!("`{}` is not a section of the standard", shorten(name));
    let help = match nearest(name, known.iter().map(String::as_str)) {
        Some(meant) => Help::Word(meant.to_owned()),
        None if is_number => Help::Text("an index has four hexadecimal digits"),
        None => {
            Help::Text("nothing to do if the tools that read the file know it; otherwise make it comments")
        }
    };
    Message { text, help }
}
