//! What some of the rules over the text say, for tests.

use super::check;
use super::document::Document;
use super::view::{FileFacts, View};
use crate::diag::Diagnostics;
use crate::encoding::Encoding;
use crate::source::{FileId, SourceMap};
use crate::wording::FileFormat;

/// What some rules say about the EDS or DCF `file` of `sources`.
pub(super) fn findings_with(
    rules: &[&check::FormatRule],
    sources: &SourceMap,
    file: FileId,
    encoding: Encoding,
) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    let source = sources.file(file);
    let name = super::file_name(source.name());
    let document = Document::scan(file, source.text());
    let view = View::new(
        &document,
        file,
        super::is_dcf(name),
        FileFacts { name, encoding, format: FileFormat::Eds },
    );
    check::document_with(rules.iter().copied(), &view, &mut diagnostics);
    diagnostics.sort();
    diagnostics
}
