//! What generated code says of its source.

use std::path::Path;

use od_spec::source::SourceMap;
use od_spec::visible::visible;

/// Which specification code was made from, for the head of a file. Nothing about its text: a comment, another layout or other
/// files for the same facts make the same code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    name: String,
}

impl Provenance {
    /// Of what was read for a specification; its own file is the first.
    pub fn of(sources: &SourceMap) -> Self {
        let first = sources.files().next().map_or("", |(_, file)| file.name());
        let name = Path::new(first).file_name().unwrap_or_default().to_string_lossy();
        Self { name: visible(&name).into_owned() }
    }

    /// Name of the specification's file, as it can be in a comment of one line.
    pub fn name(&self) -> &str {
        &self.name
    }
}
