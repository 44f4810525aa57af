//! Where a document is: what URIs, paths and the names of sources stand for.

use std::fmt;
use std::path::{Component, Path, PathBuf};
use std::str::FromStr as _;

use lsp_types::Uri;

use super::copies;
use crate::source::plain;

/// Where a document is. Two spellings of one file are one place.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    /// A file, by its absolute path.
    File(PathBuf),
    /// A library that comes with the compiler; who opens its copy has opened the library.
    Library(&'static str),
    /// Something without a file, such as a text that was never saved, by its URI.
    Elsewhere(String),
}

impl Place {
    /// The place that a client means.
    pub(super) fn of_uri(uri: &Uri) -> Self {
        match path_of(uri.as_str()) {
            Some(path) => {
                let path = plain(&path);
                copies::library_at(&path).map_or(Place::File(path), Place::Library)
            }
            None => Place::Elsewhere(uri.as_str().to_owned()),
        }
    }

    /// The place of a source by its name, which is that of [`name`](Self::name), or of the compiler for a library.
    pub(super) fn of_source(name: &str) -> Self {
        let library = name.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
        let library = library.and_then(|name| od_spec::LIBRARIES.iter().find(|(known, _)| *known == name));
        match library {
            Some((name, _)) => Place::Library(name),
            None if Path::new(name).is_absolute() => Place::File(plain(Path::new(name))),
            None => Place::Elsewhere(name.to_owned()),
        }
    }

    /// What the compiler calls it.
    pub(super) fn name(&self) -> String {
        match self {
            Place::File(path) => path.display().to_string(),
            Place::Library(name) => format!("<{name}>"),
            Place::Elsewhere(uri) => uri.clone(),
        }
    }

    /// Its path, if it is a file.
    pub(super) fn path(&self) -> Option<&Path> {
        match self {
            Place::File(path) => Some(path),
            Place::Library(_) | Place::Elsewhere(_) => None,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

/// The path that a `file:` URI means.
fn path_of(uri: &str) -> Option<PathBuf> {
    let rest = uri.get(..7).filter(|scheme| scheme.eq_ignore_ascii_case("file://")).and(uri.get(7..))?;
    let path = decoded(&rest[rest.find('/')?..])?;
    // `/c:/file` on systems with drives.
    let bytes = path.as_bytes();
    let has_drive = cfg!(windows) && bytes.get(2) == Some(&b':') && bytes[1].is_ascii_alphabetic();
    Some(PathBuf::from(if has_drive { &path[1..] } else { path.as_str() }))
}

/// A text with the characters that `%41` and the like stand for.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let digit = |byte: Option<u8>| char::from(byte?).to_digit(16);
            let value = digit(rest.next())? * 16 + digit(rest.next())?;
            bytes.push(u8::try_from(value).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok().filter(|path| !path.contains('\0'))
}

/// The URI of a file.
pub(super) fn uri_of(path: &Path) -> Option<Uri> {
    let mut uri = "file://".to_owned();
    for part in path.components() {
        match part {
            Component::Prefix(drive) => {
                uri.push('/');
                encode(drive.as_os_str().to_str()?, &mut uri);
            }
            Component::RootDir | Component::CurDir => {}
            Component::ParentDir => uri.push_str("/.."),
            Component::Normal(name) => {
                uri.push('/');
                encode(name.to_str()?, &mut uri);
            }
        }
    }
    Uri::from_str(&uri).ok()
}

/// Writes a part of a path as a URI has it.
fn encode(text: &str, uri: &mut String) {
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_' | b'.' | b'~') {
            uri.push(char::from(byte));
        } else {
            uri.push('%');
            uri.extend([byte >> 4, byte & 15].map(|digit| char::from(b"0123456789ABCDEF"[digit as usize])));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(uri: &str) -> Place {
        Place::of_uri(&Uri::from_str(uri).unwrap())
    }

    #[test]
    #[cfg(unix)]
    fn a_file_has_one_place_however_its_uri_is_spelt() {
        let lamp = Place::File(PathBuf::from("/a b/größe/lamp.od.yaml"));
        for uri in [
            "file:///a%20b/gr%C3%B6%C3%9Fe/lamp.od.yaml",
            "file:///a%20b/x/../gr%c3%b6%c3%9fe/./lamp%2Eod.yaml",
            "FILE://localhost/a%20b/gr%C3%B6%C3%9Fe/lamp.od.yaml",
        ] {
            assert_eq!(place(uri), lamp, "{uri}");
        }
        let uri = uri_of(lamp.path().unwrap()).unwrap();
        assert_eq!(uri.as_str(), "file:///a%20b/gr%C3%B6%C3%9Fe/lamp.od.yaml");
        assert_eq!(Place::of_source(&lamp.name()), lamp);
    }

    #[test]
    fn what_is_no_file_is_known_by_its_uri() {
        for uri in ["untitled:Untitled-1", "file:///%FF", "file:///a%00b", "git:/lamp.od.yaml"] {
            assert_eq!(place(uri), Place::Elsewhere(uri.to_owned()));
        }
        assert_eq!(Place::of_source("<cia402>"), Place::Library("cia402"));
        assert_eq!(Place::of_source("<x>"), Place::Elsewhere("<x>".to_owned()));
    }
}
