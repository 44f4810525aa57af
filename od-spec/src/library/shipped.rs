//! The libraries that come with the compiler, as texts.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::diag::Diagnostics;
use crate::source::SourceMap;
use crate::yaml::{self, Node};

/// Libraries that come with the compiler: name and text.
pub const LIBRARIES: &[(&str, &str)] = &[
    ("cia301", include_str!("../../profiles/cia301.od.yaml")),
    ("cia302", include_str!("../../profiles/cia302.od.yaml")),
    ("cia401", include_str!("../../profiles/cia401.od.yaml")),
    ("cia402", include_str!("../../profiles/cia402.od.yaml")),
];

/// The features of a library of [`LIBRARIES`] with what it says about each; nothing is looked up.
pub fn features(name: &str, text: &str) -> Vec<(String, Node)> {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    let tree = yaml::parse(file, sources.file(file), &mut Diagnostics::new());
    let features = tree.as_ref().and_then(|tree| tree.get("features")).map(Node::entries).unwrap_or_default();
    features.iter().map(|(name, node)| (name.value.clone(), node.clone())).collect()
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
