//! The libraries that come with the compiler, as texts and trees.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::diag::Diagnostics;
use crate::source::{FileId, SourceMap};
use crate::yaml::{self, Node, packed};

/// Libraries that come with the compiler: name and text.
pub const LIBRARIES: &[(&str, &str)] = &[
    ("cia301", include_str!("../../profiles/cia301.od.yaml")),
    ("cia302", include_str!("../../profiles/cia302.od.yaml")),
    ("cia401", include_str!("../../profiles/cia401.od.yaml")),
    ("cia402", include_str!("../../profiles/cia402.od.yaml")),
];

/// Their trees, in the same order.
const TREES: [&[u8]; LIBRARIES.len()] = [
    include_bytes!("../../profiles/cia301.tree"),
    include_bytes!("../../profiles/cia302.tree"),
    include_bytes!("../../profiles/cia401.tree"),
    include_bytes!("../../profiles/cia402.tree"),
];

/// The tree of a library that is a file of a compilation.
pub(crate) fn tree(name: &str, file: FileId, sources: &SourceMap) -> Option<Node> {
    unpacked(file, sources, TREES[place(name)?])
}

/// The tree of a text of this crate: its packed one, or after a change of the text, what it is parsed to.
pub(crate) fn unpacked(file: FileId, sources: &SourceMap, tree: &[u8]) -> Option<Node> {
    let source = sources.file(file);
    packed::unpack(file, source.text(), tree).or_else(|| yaml::parse(file, source, &mut Diagnostics::new()))
}

/// The features of a library of [`LIBRARIES`] with what it says about each; nothing is looked up.
pub fn features(name: &str, text: &str) -> Vec<(String, Node)> {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    let tree = tree(name, file, &sources);
    let features = tree.as_ref().and_then(|tree| tree.get("features")).map(Node::entries).unwrap_or_default();
    features.iter().map(|(name, node)| (name.value.clone(), node.clone())).collect()
}

/// The position of a library in [`LIBRARIES`].
pub(crate) fn place(name: &str) -> Option<usize> {
    LIBRARIES.iter().position(|(library, _)| *library == name)
}

/// The libraries by the names of their features; asked only about a feature that a specification does not find.
static BY_FEATURE: LazyLock<BTreeMap<String, &'static str>> = LazyLock::new(|| {
    let of = |(library, text): &(&'static str, &str)| {
        let library = *library;
        features(library, text).into_iter().map(move |(feature, _)| (feature, library))
    };
    LIBRARIES.iter().flat_map(of).collect()
});

/// The library that offers a feature.
pub(crate) fn offering(feature: &str) -> Option<&'static str> {
    BY_FEATURE.get(feature).copied()
}
