//! What every backend gives: files, not yet written.

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// Path below the output directory, with `/` between its parts.
    pub path: String,
    /// Contents.
    pub bytes: Vec<u8>,
    /// What the file is for, in a few words.
    pub purpose: String,
}
