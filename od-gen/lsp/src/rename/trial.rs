//! Whether changed texts say the same as before.

use std::collections::BTreeMap;
use std::sync::Arc;

use od_readers::remark;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::names::{DefinitionId, Names};
use od_spec::source::{FileId, SourceFile, SourceMap, Span};
use od_spec::yaml::Node;
use od_spec::{Loader, compile};

use crate::analysis::Analysis;
use crate::place::beside;
use crate::trees::Trees;

/// Gives texts by their names, and their trees.
struct Texts {
    by_name: BTreeMap<String, String>,
    trees: Trees,
}

impl Loader for Texts {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        self.by_name
            .get(&beside(from, path))
            .map(|text| text.clone().into_bytes())
            .ok_or_else(|| "no such file".to_owned())
    }

    fn tree(
        &mut self,
        file: FileId,
        source: &SourceFile,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Node>> {
        self.trees.tree(file, source, diagnostics)
    }
}

/// Compiles the texts with changes, and refuses what is new about them.
pub(super) fn check(now: &Analysis, changes: &[(Span, String)]) -> Result<(), String> {
    let Some(root) = now.root else { return Err("the specification cannot be read".to_owned()) };
    let texts =
        now.sources.files().map(|(id, file)| (file.name().to_owned(), changed(id, file.text(), changes)));
    let mut texts = Texts { by_name: texts.collect(), trees: Trees::default() };
    let name = now.sources.file(root).name();
    let mut sources = SourceMap::new();
    let root = sources.add(name, texts.by_name.get(name).cloned().unwrap_or_default());
    let mut compiled = compile(&mut sources, root, &mut texts);
    remark(&sources, root, &mut compiled);
    if let Some(news) = news(&now.diagnostics, &compiled.diagnostics) {
        return Err(format!("with this name there would be a message: {}", news.message));
    }
    let tree = |(id, file)| (id, texts.trees.tree(id, file, &mut Diagnostics::new()));
    let trees: BTreeMap<FileId, Option<Arc<Node>>> = sources.files().map(tree).collect();
    let names = Names::of(&sources, root, |file| trees.get(&file)?.as_deref(), compiled.system.as_ref());
    if targets(&names) == targets(now.names()) {
        Ok(())
    } else {
        Err("with this name something would refer to something else".to_owned())
    }
}

/// A text with its changes.
pub(super) fn changed(file: FileId, text: &str, changes: &[(Span, String)]) -> String {
    let (mut new, mut at) = (String::with_capacity(text.len()), 0);
    // Changes lie in the order of their places.
    for (span, instead) in changes.iter().filter(|(span, _)| span.file == file) {
        new.push_str(text.get(at..span.start as usize).unwrap_or_default());
        new.push_str(instead);
        at = span.end as usize;
    }
    new.push_str(text.get(at..).unwrap_or_default());
    new
}

/// A message of which there are more than before, of its code.
pub(super) fn news<'a>(before: &Diagnostics, after: &'a Diagnostics) -> Option<&'a Diagnostic> {
    let count = |list: &Diagnostics, id: &str| list.iter().filter(|one| one.code.id == id).count();
    after.iter().find(|one| count(after, one.code.id) > count(before, one.code.id))
}

/// What each reference refers to, in the order of the texts.
fn targets(names: &Names) -> Vec<&[DefinitionId]> {
    names.references().iter().map(|one| one.targets.as_slice()).collect()
}
