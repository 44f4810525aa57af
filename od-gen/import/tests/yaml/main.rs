//! Models written as specifications: the text compiles, gives the same model, and reads as a person would have written it.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod faults;
mod foreign;
mod likeness;
mod obstacles;
mod pdo_parameters;
mod random;
mod shipped;
#[path = "../../../../tests/shared/shipped.rs"]
mod texts;
mod words;

use od_import::yaml::{Options, Specification, specification};
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

/// The model of a text that compiles.
fn model(text: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("written.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let shown = render(&compiled.diagnostics, &sources, Format::Human, false);
    compiled.system.unwrap_or_else(|| panic!("{shown}\n{text}"))
}

/// The first device as a specification.
fn written(system: &System) -> Specification {
    written_with(system, &Options::default())
}

fn written_with(system: &System, options: &Options) -> Specification {
    specification(system, &system.devices[0], options).unwrap_or_else(|refused| {
        let messages: Vec<&str> = refused.iter().map(|one| one.message.as_str()).collect();
        panic!("{messages:?}")
    })
}
