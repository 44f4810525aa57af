//! Syntax trees of texts that were read before: of the files of a specification, an edit changes one, and the libraries are the same
//! in every session.

use std::sync::{Arc, Mutex, PoisonError};

use od_spec::diag::Diagnostics;
use od_spec::source::{FileId, SourceFile};
use od_spec::yaml::{Node, parse};

/// Texts that are remembered: those of a large specification, and a few more.
const REMEMBERED: usize = 12;

/// A text with its tree; `None` of what is no YAML.
struct Read {
    file: FileId,
    text: String,
    tree: Option<Arc<Node>>,
}

/// What was asked for last comes last.
static READ: Mutex<Vec<Read>> = Mutex::new(Vec::new());

/// The syntax tree of a file; `None` of what is no YAML.
pub(super) fn tree(file: FileId, source: &SourceFile) -> Option<Arc<Node>> {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(at) = read.iter().position(|one| one.file == file && one.text == source.text()) {
        let known = read.remove(at);
        let tree = known.tree.clone();
        read.push(known);
        return tree;
    }
    let tree = parse(file, source, &mut Diagnostics::new()).map(Arc::new);
    if read.len() == REMEMBERED {
        read.remove(0);
    }
    read.push(Read { file, text: source.text().to_owned(), tree: tree.clone() });
    tree
}
