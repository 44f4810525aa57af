//! Syntax trees of the texts of a specification as they were read last: an edit changes one of them, and what is asked about a
//! text needs the tree that compiling read.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use od_spec::diag::Diagnostics;
use od_spec::source::{FileId, SourceFile};
use od_spec::yaml::{Node, parse};

/// The trees of the files of a specification, each of its last text.
#[derive(Debug, Default)]
pub(super) struct Trees(Mutex<BTreeMap<FileId, Read>>);

/// A text with its tree, `None` if it is not YAML, and the messages about it.
#[derive(Debug)]
struct Read {
    text: String,
    tree: Option<Arc<Node>>,
    said: Diagnostics,
}

impl Read {
    fn of(file: FileId, source: &SourceFile) -> Self {
        let mut said = Diagnostics::new();
        let tree = parse(file, source, &mut said).map(Arc::new);
        Self { text: source.text().to_owned(), tree, said }
    }
}

impl Trees {
    /// The tree of a text, read if it is not the last text of its file.
    pub(super) fn tree(
        &self,
        file: FileId,
        source: &SourceFile,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Node>> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // A tree is several times as large as its text: the earlier one goes before the next is read.
        all.retain(|of, read| *of != file || read.text == source.text());
        let read = all.entry(file).or_insert_with(|| Read::of(file, source));
        diagnostics.append(read.said.clone());
        read.tree.clone()
    }
}
