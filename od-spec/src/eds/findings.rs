//! Everything that can be said about an EDS or DCF.

use super::Encoding;
use super::check;
use super::document::Document;
use super::is_dcf;
use super::view::{FileFacts, View};
use crate::diag::Diagnostics;
use crate::source::{FileId, SourceMap};

/// What is wrong with the EDS or DCF `file` of `sources`, as serious as the standard takes it; sorted by place.
///
/// `encoding` is what [`decode`](super::decode) told about the file's bytes. The file is taken as a DCF if its name says so.
///
/// ```
/// use od_spec::eds::{Encoding, findings};
/// use od_spec::source::SourceMap;
///
/// let mut sources = SourceMap::new();
/// let file = sources.add("lamp.eds", "[Comments]\nLines=1\n");
/// let found = findings(&sources, file, Encoding::Ascii);
/// assert!(found.iter().any(|one| one.message == "`Lines` is 1, but there are no entries"));
/// ```
pub fn findings(sources: &SourceMap, file: FileId, encoding: Encoding) -> Diagnostics {
    said(sources, file, encoding, check::document)
}

/// The same under some of the rules.
#[cfg(test)]
pub(super) fn findings_with(
    rules: &[&check::FormatRule],
    sources: &SourceMap,
    file: FileId,
    encoding: Encoding,
) -> Diagnostics {
    said(sources, file, encoding, |view, diagnostics| {
        check::document_with(rules.iter().copied(), view, diagnostics);
    })
}

fn said(
    sources: &SourceMap,
    file: FileId,
    encoding: Encoding,
    check: impl FnOnce(&View<'_>, &mut Diagnostics),
) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    let source = sources.file(file);
    let name = file_name(source.name());
    let document = Document::scan(file, source.text());
    let view = View::new(&document, file, is_dcf(name), FileFacts { name, encoding });
    check(&view, &mut diagnostics);
    diagnostics.sort();
    diagnostics
}

/// The name of a file without its directories.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
