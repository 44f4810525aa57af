//! The parts and libraries of a text that is not YAML at the moment: compiling stops before it reads them, but their names are
//! wanted all the same.

use od_spec::source::{FileId, SourceMap};
use od_spec::yaml::{self, Node};
use od_spec::{LIBRARIES, Loader, read_text};

use super::place::beside;

/// Adds the files that a text names. What cannot be read is left out; it will be reported once the text can be compiled.
pub(super) fn add(sources: &mut SourceMap, root: FileId, loader: &mut dyn Loader) {
    let from = sources.file(root).name().to_owned();
    let tree = yaml::lenient(root, sources.file(root).text());
    let names = |key: &str| -> Vec<String> {
        let items = tree.get(key).map(Node::items).unwrap_or_default();
        items.iter().filter_map(|item| Some(item.text()?.value.to_owned())).collect()
    };
    let mut load = |name: &str| read_text(name, loader.load(name, &from).ok()?).ok();
    for part in names("parts") {
        if let Some(text) = load(&part) {
            sources.add_part(beside(&from, &part), text, root);
        }
    }
    for library in names("uses") {
        match LIBRARIES.iter().find(|(name, _)| *name == library) {
            Some((name, text)) => {
                sources.add(format!("<{name}>"), *text);
            }
            None => {
                if let Some(text) = load(&library) {
                    sources.add(beside(&from, &library), text);
                }
            }
        }
    }
}
