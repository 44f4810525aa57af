//! What differs between two dictionaries, and what each change breaks.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod cases;
mod eds;
mod lamp;
mod print;
mod same;
#[path = "../../../../tests/shared/shipped.rs"]
mod shipped;

use std::sync::LazyLock;

use od_diff::{Difference, Question, Scope, compare};
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use shipped::{PITCH, in_one_file};

static FULLMO: LazyLock<String> = LazyLock::new(|| in_one_file("fullmo-drive"));

static PITCH_SYSTEM: LazyLock<System> = LazyLock::new(|| system(&PITCH));

/// A change of one place in a specification, and what the comparison says about it.
struct Case {
    name: &'static str,
    /// Where the search begins.
    at: &'static str,
    /// The first text after that …
    find: &'static str,
    /// … becomes this one.
    replace: &'static str,
    /// One line for each change: device, what differs, consequences.
    expected: &'static [&'static str],
}

impl Case {
    /// The specification with the change.
    fn applied(&self, text: &str) -> String {
        let start = text.find(self.at).unwrap_or_else(|| panic!("{}: no `{}`", self.name, self.at));
        let found = text[start..].find(self.find);
        let at = start + found.unwrap_or_else(|| panic!("{}: no `{}`", self.name, self.find));
        format!("{}{}{}", &text[..at], self.replace, &text[at + self.find.len()..])
    }
}

fn system(text: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("test.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let shown = render(&compiled.diagnostics, &sources, Format::Short, false);
    compiled.system.unwrap_or_else(|| panic!("{shown}"))
}

fn difference(old: &System, new: &System, scope: Scope) -> Difference {
    compare(&Question { old, new, scope, device: None, nodes: None })
        .unwrap_or_else(|error| panic!("{error}"))
}
