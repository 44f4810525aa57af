//! EDS and DCF texts (CiA 306).
//!
//! A [`Document`] is what a writer fills and what a reader gives: it knows sections, keys, comments and line breaks, and
//! nothing of devices, objects or types. It is with the other front ends and not with the model, so that a text can be
//! read, mended, compared and written back before it is understood.

pub(crate) mod check;
pub(crate) mod coded;
pub mod codes;
pub(crate) mod dates;
mod document;
mod editor;
mod edits;
pub(crate) mod example;
mod line;
pub(crate) mod names;
pub(crate) mod number;
pub(crate) mod owner;
pub(crate) mod read;
mod scan;
pub(crate) mod view;

/// Whether a text is an EDS or DCF: by the name of its file or, where that says nothing, by its first line.
pub fn is_eds(name: &str, text: &str) -> bool {
    let is_yaml = ends_with(name, ".yaml") || ends_with(name, ".yml");
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with([';', '#']));
    has_eds_name(name) || (!is_yaml && first.is_some_and(|line| line.starts_with('[') && line.ends_with(']')))
}

/// Whether a file is named like an EDS or DCF.
pub fn has_eds_name(name: &str) -> bool {
    ends_with(name, ".eds") || is_dcf(name)
}

/// The name of a file without its directories.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// Whether a file is named like a DCF.
pub(crate) fn is_dcf(name: &str) -> bool {
    ends_with(name, ".dcf")
}

pub(crate) fn ends_with(name: &str, extension: &str) -> bool {
    let start = name.len().checked_sub(extension.len());
    start.and_then(|start| name.get(start..)).is_some_and(|end| end.eq_ignore_ascii_case(extension))
}

pub use check::keys::keys_of_section;
pub use dates::{date_text, time_text};
pub use document::{Document, Section, SectionRef};
pub use line::{Line, LineEnd, LineKind};
pub use owner::{GENERATED, MARK, Owner, Remark, owner};
pub use read::{cannot_hold, cannot_hold_section};
