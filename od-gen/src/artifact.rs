//! What every backend gives: files, not yet written.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

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

/// A file of a set, as who writes it sees it.
pub trait OutputFile {
    /// Path below the output directory, with `/` between its parts.
    fn path(&self) -> &str;
    /// Contents, in pieces that follow one another.
    fn pieces(&self) -> Vec<&[u8]>;
    /// The first of the pieces that is not empty: the mark of the maker of the file is there.
    fn head(&self) -> &[u8] {
        self.pieces().into_iter().find(|piece| !piece.is_empty()).unwrap_or_default()
    }
}

impl OutputFile for Artifact {
    fn path(&self) -> &str {
        &self.path
    }

    fn pieces(&self) -> Vec<&[u8]> {
        vec![&self.bytes]
    }
}

/// A file that has pieces in common with others: a plant has a thousand of them that differ in three lines.
#[derive(Debug, Clone)]
pub struct SharedFile {
    /// Path below the output directory, with `/` between its parts.
    pub path: String,
    /// Contents, in pieces that follow one another.
    pub pieces: Vec<Arc<[u8]>>,
}

impl OutputFile for SharedFile {
    fn path(&self) -> &str {
        &self.path
    }

    fn pieces(&self) -> Vec<&[u8]> {
        self.pieces.iter().map(AsRef::as_ref).collect()
    }
}

/// Pieces of files, each once in memory, however many files have it.
#[derive(Debug, Default)]
pub struct Pool {
    known: Mutex<BTreeSet<Arc<[u8]>>>,
}

impl Pool {
    /// A piece with these contents.
    pub fn piece(&self, contents: &[u8]) -> Arc<[u8]> {
        // A set whose writing stopped halfway is one without that piece.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(piece) = known.get(contents) {
            return Arc::clone(piece);
        }
        let piece: Arc<[u8]> = contents.into();
        known.insert(Arc::clone(&piece));
        piece
    }
}
