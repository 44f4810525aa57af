//! EDS and DCF files as a front end: what our own files say comes back, and whatever a file holds, it becomes a model.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod channels;
mod conditions;
mod editor;
mod links;
mod node;
mod own_files;
mod random;
mod reading;
mod words;

use od_spec::model::Dictionary;
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};

/// Compiles a text under a file name.
fn compiled(name: &str, text: &str) -> (Compiled, SourceMap) {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (compiled, sources)
}

/// The device of an EDS that is expected to give one.
fn device(name: &str, text: &str) -> Dictionary {
    compiled(name, text).0.system.unwrap().devices.remove(0)
}
