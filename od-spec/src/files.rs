//! Texts from files: where they come from, how large they may be and how they are written; and the files that a
//! specification names.

use std::path::Path;
use std::sync::Arc;

use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, Label, codes, shorten};
use crate::encoding::Encoding;
use crate::file_name;
use crate::keys::{PART_OF, SPEC_VERSION};
use crate::source::{FileId, SourceFile, SourceMap, Span, Spanned};
use crate::xdd::Disabled;
use crate::yaml::{self, Node};
use crate::{eds, encoding, other_bus, xdd};

/// Largest file that is read, in bytes.
const LARGEST_FILE: usize = 64 << 20;

/// Gives the compiler the files that a specification names by path, libraries and parts, and says what to take of them.
pub trait Loader {
    /// The bytes of `path`, which is named in the file named `from`.
    ///
    /// # Errors
    /// Why there are none, in a few words such as "no such file".
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String>;

    /// The syntax tree of a specification, a part of one or a library; `None` with a message of what is no YAML. A
    /// caller that compiles a text again, or wants its tree, keeps what was read.
    fn tree(
        &mut self,
        file: FileId,
        source: &SourceFile,
        diagnostics: &mut Diagnostics,
    ) -> Option<Arc<Node>> {
        yaml::parse(file, source, diagnostics).map(Arc::new)
    }

    /// What becomes of objects of an XDD that are switched off.
    fn disabled(&self) -> Disabled {
        Disabled::LeftOut
    }
}

/// A loader without files: only the built-in libraries can be used.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoFiles;

impl Loader for NoFiles {
    fn load(&mut self, _path: &str, _from: &str) -> Result<Vec<u8>, String> {
        Err("files cannot be read here".to_owned())
    }
}

/// Whether a text may be a specification, a part of one or a library: it has the key that all of them have, or that of a
/// part. Any other text may be confidential: no message quotes it.
pub fn may_be_specification(text: &[u8]) -> bool {
    [SPEC_VERSION, PART_OF].into_iter().any(|key| has_key(text, key))
}

/// Whether a key may be somewhere in a text.
fn has_key(text: &[u8], key: &str) -> bool {
    memchr::memmem::find_iter(text, key).any(|at| {
        let rest = text.get(at + key.len()..).unwrap_or_default();
        let unquoted = rest.strip_prefix(b"\"").or_else(|| rest.strip_prefix(b"'")).unwrap_or(rest);
        unquoted.trim_ascii_start().starts_with(b":")
    })
}

/// The text of the file of a name that is written in the file `from`. `missing` says that there is none, with a reason,
/// and `other` that it is something else.
pub(crate) fn read(
    name: &Spanned<String>,
    from: &str,
    loader: &mut dyn Loader,
    missing: impl FnOnce(&Spanned<String>, &str) -> Diagnostic,
    other: impl FnOnce(&Spanned<String>) -> Diagnostic,
) -> Result<String, Box<Diagnostic>> {
    let bytes = loader.load(&name.value, from).map_err(|reason| Box::new(missing(name, &reason)))?;
    if bytes.len() <= LARGEST_FILE && !may_be_specification(&bytes) {
        return Err(Box::new(other(name)));
    }
    read_text(&name.value, bytes).map_err(|mut diagnostic| {
        diagnostic.labels.push(Label { span: name.span, text: "used here".to_owned() });
        diagnostic
    })
}

/// The path of a file that is named relative to another, as messages show it.
pub(crate) fn beside(from: &str, name: &str) -> String {
    file_name::shown(Path::new(from).parent().unwrap_or(Path::new("")).join(name))
}

/// A file is named a second time.
pub(crate) fn twice(what: &str, first: Span, again: &Spanned<String>) -> Diagnostic {
    let message = format!("{what} `{}` is used twice", shorten(&again.value));
    Diagnostic::new(rule_codes::DUPLICATE_NAME, again.span, message)
        .label("again here")
        .with(first, "first here")
        .help("remove one of the two")
}

/// Adds the bytes of a file: a specification in UTF-8, or an EDS or DCF in whatever it is.
///
/// # Errors
/// As [`read_text`]; of an EDS, the code page is one that is not read (OD0102), or it is not one of CANopen (OD0121).
pub fn add_source(sources: &mut SourceMap, name: &str, bytes: Vec<u8>) -> Result<FileId, Box<Diagnostic>> {
    if bytes.len() <= LARGEST_FILE {
        if eds::has_eds_name(name) || xdd::has_xdd_name(name) {
            let (text, encoding) = decode(name, bytes)?;
            return Ok(sources.add_decoded(name, text, encoding));
        }
        // Where the name says nothing, the text does; what is UTF-8 needs no look at it yet.
        if std::str::from_utf8(&bytes).is_err()
            && let Ok((text, encoding)) = encoding::decode(bytes.clone())
            && (eds::is_eds(name, &text) || xdd::is_xdd(name, &text))
        {
            return Ok(sources.add_decoded(name, text, encoding));
        }
    }
    Ok(sources.add(name, read_text(name, bytes)?))
}

/// The text of a file that is named as an EDS, DCF, XDD or XDC.
///
/// # Errors
/// Its code page is one that is not read (OD0102), or it is something else than its name says (OD0121).
pub(crate) fn decode(name: &str, bytes: Vec<u8>) -> Result<(String, Encoding), Box<Diagnostic>> {
    let read = encoding::decode(bytes).map_err(|page| {
        let (page, iconv) = (page.name(), page.name().to_lowercase());
        let message = format!("the texts of `{name}` are in {page}, in which a character has two bytes");
        let help = format!("save it as UTF-8, for example with `iconv -f {iconv} -t utf-8`");
        Box::new(Diagnostic::without_place(codes::NOT_UTF8, message).help(help))
    })?;
    match other_bus::refusal(name, &read.0) {
        Some(refusal) => Err(refusal),
        None => Ok(read),
    }
}

/// Checks the bytes of a source file: size and UTF-8. A byte order mark is dropped.
///
/// # Errors
/// A message without a place: the file is larger than 64 MiB (OD0103), or is not UTF-8 (OD0102).
pub fn read_text(name: &str, bytes: Vec<u8>) -> Result<String, Box<Diagnostic>> {
    if bytes.len() > LARGEST_FILE {
        return Err(Box::new(
            Diagnostic::without_place(
                codes::TOO_LARGE,
                format!("`{name}` has {} MiB; the limit is {} MiB", bytes.len() >> 20, LARGEST_FILE >> 20),
            )
            .help("is this the right file?"),
        ));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..valid]);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1;
        let byte = error.as_bytes().get(valid).copied().unwrap_or_default();
        Box::new(
            Diagnostic::without_place(
                codes::NOT_UTF8,
                format!("`{name}:{line}:{column}` holds the byte {byte:#04X}, expected UTF-8 text"),
            )
            .help("convert the file, for example with `iconv -f latin1 -t utf-8`"),
        )
    })?;
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}
