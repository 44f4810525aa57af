//! The libraries that come with the compiler, as texts and as they were read.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use crate::ast::Spec;
use crate::decode::read_own;
use crate::diag::Diagnostics;
use crate::resolve;
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

/// A library as a compilation has read it, with the languages of its texts.
type Kept = (Vec<String>, Arc<Spec>);

thread_local! {
    /// The last of each library, in the order of [`LIBRARIES`]: reading takes longer than all else that a small specification asks
    /// for. Of each thread, so that no compilation depends on what runs at the same time.
    static KEPT: RefCell<[Option<Kept>; LIBRARIES.len()]> = const { RefCell::new([const { None }; LIBRARIES.len()]) };
}

fn place(name: &str) -> Option<usize> {
    LIBRARIES.iter().position(|(library, _)| *library == name)
}

/// A library as it was read last, in whatever languages.
pub(crate) fn kept(name: &str) -> Option<Arc<Spec>> {
    let place = place(name)?;
    KEPT.with_borrow(|kept| kept[place].as_ref().map(|(_, library)| Arc::clone(library)))
}

/// A library with its texts in some languages, from a file of a compilation: as it was read last if that was the same.
pub(crate) fn built_in(
    name: &str,
    file: FileId,
    languages: &[String],
    sources: &SourceMap,
) -> Option<Arc<Spec>> {
    let place = place(name)?;
    let is_same = |(of, library): &&Kept| library.file == file && of == languages;
    if let Some(library) =
        KEPT.with_borrow(|kept| kept[place].as_ref().filter(is_same).map(|(_, library)| Arc::clone(library)))
    {
        return Some(library);
    }
    let mut library = read_own(&tree(name, file, sources)?, languages);
    resolve::expand(&mut library, &mut Diagnostics::new());
    let library = Arc::new(library);
    let kept = (languages.to_vec(), Arc::clone(&library));
    KEPT.with_borrow_mut(|places| places[place] = Some(kept));
    Some(library)
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

#[cfg(test)]
mod tests {
    use crate::compile::compile;
    use crate::files::NoFiles;
    use crate::source::SourceMap;

    /// The model of a device with objects of a library, read after other files.
    fn system(languages: &str, files_before: usize) -> String {
        let text = format!(
            "od-spec: 1\ntitle: t\nlanguages: [{languages}]\nuses: [cia301]\ndevices: {{d: {{name: d, bit-rates: [125]}}}}\nobjects:\n  0x1010: {{from: cia301}}\n  0x1017: {{from: cia301}}\n"
        );
        let mut sources = SourceMap::new();
        for _ in 0..files_before {
            sources.add("other", "");
        }
        let root = sources.add("a.od.yaml", text);
        let compiled = compile(&mut sources, root, &mut NoFiles);
        format!("{:?}{:?}", compiled.system.unwrap(), compiled.diagnostics)
    }

    #[test]
    fn a_library_that_is_kept_is_as_one_that_is_read() {
        let cases = [("en", 0), ("de, en", 0), ("en", 2), ("en, de", 2)];
        let read = cases.map(|(languages, before)| system(languages, before));
        assert!(read[0] != read[1], "the languages make no difference");
        // Each after itself, and after another.
        for (at, (languages, before)) in [0, 0, 1, 1, 3, 3, 2, 2, 0].map(|at| (at, cases[at])) {
            assert!(system(languages, before) == read[at], "{languages}, {before}");
        }
    }
}
