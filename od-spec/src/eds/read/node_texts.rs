//! What a DCF says about objects and entries of its node in addition to their values (CiA 306 5.3.1): names in the
//! application, and files of DOMAINs. In an EDS, and where a key means nothing, it is left out with a word.

use super::entry::Context;
use super::node::FileUse;
use super::{owned, without_place};
use crate::commissioning::Denoted;
use crate::diag::Diagnostic;
use crate::eds::codes;
use crate::eds::view::Part;
use crate::model::{DataType, EntryId, SubIndex};
use crate::source::Spanned;
use crate::wording::Key;

/// Longest line without its line break (CiA 306 4.2).
const LONGEST_LINE: usize = 255;

/// Reads the section of an object or an entry; of an entry, and of an object that is one, with its data type.
pub(super) fn read(part: &Part<'_>, of: Denoted, data_type: Option<DataType>, context: &mut Context<'_>) {
    if let Some(name) = part.value("Denotation") {
        match context.node.as_deref_mut() {
            Some(node) => node.denotations.push((of, owned(name))),
            None => context.push(no_dcf(name, &context.format.key(Key::Denotation), of)),
        }
    }
    if let Some(reference) = part.value("ParamRefd") {
        match context.node.as_deref_mut() {
            Some(node) => node.references.push((of, owned(reference))),
            None => context.push(no_dcf(reference, "`ParamRefd`", of)),
        }
    }
    for file in FileUse::ALL {
        let Some(path) = part.value(file.key()) else { continue };
        let why = match data_type {
            _ if context.node.is_none() => {
                context.push(no_dcf(path, &format!("`{}`", file.key()), of));
                continue;
            }
            Some(DataType::Domain) => problem(path.value, file.key()),
            _ => Some("it is no DOMAIN"),
        };
        let id = EntryId { index: of.index, sub: of.sub.unwrap_or(SubIndex(0)) };
        match (why, context.node.as_deref_mut()) {
            (None, Some(node)) => node.files.push((id, file, owned(path))),
            (Some(why), _) => {
                let message = format!("`{}` of {of} is left out: {why}", file.key());
                context.push(without_place(codes::NO_PLACE, path.span, message));
            }
            (None, None) => {}
        }
    }
}

/// The names of the elements of a compact array.
pub(super) fn element_name(name: Spanned<&str>, of: Denoted, context: &mut Context<'_>) {
    match context.node.as_deref_mut() {
        Some(node) => node.denotations.push((of, owned(name))),
        None => context.push(no_dcf(name, "the application name", of)),
    }
}

/// A section that represents several entries, and so for none of a node.
pub(super) fn leave_out(part: &Part<'_>, id: EntryId, context: &mut Context<'_>) {
    for key in ["Denotation", "UploadFile", "DownloadFile", "ParamRefd"] {
        if let Some(text) = part.value(key) {
            let message = format!("`{key}` of {id} is left out: the section is about several entries");
            context.push(without_place(codes::NO_PLACE, text.span, message));
        }
    }
}

/// Why a path could not be written again as it is; a changed one would be another file.
fn problem(path: &str, key: &str) -> Option<&'static str> {
    if !path.bytes().all(|byte| matches!(byte, b' '..=b'~')) {
        return Some("the path has characters beyond ASCII");
    }
    (key.len() + 1 + path.len() > LONGEST_LINE).then_some("the path is too long for a line")
}

fn no_dcf(text: Spanned<&str>, what: &str, of: Denoted) -> Diagnostic {
    Diagnostic::new(codes::NO_PLACE, text.span, format!("{what} of {of} is left out: this is no DCF"))
        .help("call the file a DCF if it is for one node")
}
