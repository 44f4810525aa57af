//! A C file while it is written: its text, and the names that it defines.

use od_gen::plan::Plan;
use od_spec::diag::Diagnostics;
use od_spec::model::Text as Words;
use od_spec::wording::{Notation, Wording};

use super::names::{Names, Register};
use super::text::Text;

/// How comments word facts.
pub(super) const WORDING: Wording = Wording::english(Notation::Rust);

/// A file of a device.
pub(super) struct Page<'p, 'a> {
    pub plan: &'p Plan<'a>,
    pub names: &'p Names,
    pub text: Text,
    pub register: &'p mut Register,
    pub diagnostics: &'p mut Diagnostics,
}

impl Page<'_, '_> {
    /// The text so far; what is written next is another file.
    pub(super) fn finish(&mut self) -> Text {
        std::mem::take(&mut self.text)
    }

    /// A macro; `what` names it in messages.
    pub(super) fn define(&mut self, parts: &[&str], value: &str, what: &str) {
        let name = self.names.macro_of(parts);
        self.enter(&name, what);
        self.text.define(&name, value);
    }

    /// Enters a name that the file defines.
    pub(super) fn enter(&mut self, name: &str, what: &str) {
        self.register.enter(name, what, self.plan.device, self.diagnostics);
    }

    /// A text in the language of the specification.
    pub(super) fn words<'t>(&self, text: &'t Words) -> &'t str {
        text.get(self.plan.system.language()).unwrap_or_default()
    }

    /// `name: meaning`, or `name.`
    pub(super) fn about(&self, name: &str, text: &Words) -> String {
        match self.words(text) {
            "" => format!("{}.", name.trim_end_matches('.')),
            about => format!("{name}: {about}"),
        }
    }
}
