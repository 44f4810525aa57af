//! XDD and XDC files: what our own files say comes back, what others write is read, and whatever a file holds, nothing breaks.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod editor;
mod hostile;
mod reading;
mod round_trip;

use od_spec::diag::render::{Format, render};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, add_source, compile};

/// Compiles a file of a name.
fn compiled(name: &str, bytes: impl Into<Vec<u8>>) -> (Compiled, SourceMap) {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, bytes.into()).unwrap();
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (compiled, sources)
}

/// What is said about a file, one line each.
fn said(name: &str, bytes: impl Into<Vec<u8>>) -> String {
    let (compiled, sources) = compiled(name, bytes);
    render(&compiled.diagnostics, &sources, Format::Short, false)
}
