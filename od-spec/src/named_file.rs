//! Files that a specification names: libraries and parts.

use std::path::Path;

use crate::Loader;
use crate::check::codes;
use crate::compile::read_text;
use crate::diag::{Diagnostic, Label, shorten};
use crate::source::{Span, Spanned};

/// The text of the file of a name that stands in the file `from`. `missing` says that there is none, with a reason.
pub(crate) fn read(
    name: &Spanned<String>,
    from: &str,
    loader: &mut dyn Loader,
    missing: impl FnOnce(&Spanned<String>, &str) -> Diagnostic,
) -> Result<String, Box<Diagnostic>> {
    let bytes = loader.load(&name.value, from).map_err(|reason| Box::new(missing(name, &reason)))?;
    read_text(&name.value, bytes).map_err(|mut diagnostic| {
        diagnostic.labels.push(Label { span: name.span, text: "used here".to_owned() });
        diagnostic
    })
}

/// The path of a file that is named relative to another, as messages show it.
pub(crate) fn beside(from: &str, name: &str) -> String {
    Path::new(from).parent().unwrap_or(Path::new("")).join(name).display().to_string()
}

/// A file is named a second time.
pub(crate) fn twice(what: &str, first: Span, again: &Spanned<String>) -> Diagnostic {
    let message = format!("{what} `{}` is used twice", shorten(&again.value));
    Diagnostic::new(codes::DUPLICATE_NAME, again.span, message)
        .label("again here")
        .with(first, "first here")
        .help("remove one of the two")
}
