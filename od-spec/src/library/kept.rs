//! The libraries that come with the compiler, as compilations have read them.

use std::cell::RefCell;
use std::sync::Arc;

use crate::ast::Spec;
use crate::decode::read_own;
use crate::diag::Diagnostics;
use crate::library::shipped::{LIBRARIES, place, tree};
use crate::resolve;
use crate::source::{FileId, SourceMap};

/// A library as a compilation has read it, with the languages of its texts.
type Kept = (Vec<String>, Arc<Spec>);

thread_local! {
    /// The last of each library, in the order of [`LIBRARIES`]: reading takes longer than all else that a small specification asks
    /// for. Of each thread, so that no compilation depends on what runs at the same time.
    static KEPT: RefCell<[Option<Kept>; LIBRARIES.len()]> = const { RefCell::new([const { None }; LIBRARIES.len()]) };
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
