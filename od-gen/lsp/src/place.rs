//! Where a document is: what URIs, paths and the names of sources mean.

use std::fmt;
use std::path::{Path, PathBuf};

use lsp_types::Uri;
use od_gen::source::plain;

use od_spec::file_name;

use super::copies;
use super::uri::path_of;

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
            Place::File(path) => file_name::shown(path),
            Place::Library(name) => format!("<{name}>"),
            Place::Elsewhere(uri) => uri.clone(),
        }
    }

    /// Its path, if it is a file.
    #[cfg(test)]
    pub(super) fn path(&self) -> Option<&Path> {
        match self {
            Place::File(path) => Some(path),
            Place::Library(_) | Place::Elsewhere(_) => None,
        }
    }
}

/// The name of a source that another one names, relative to itself.
pub(super) fn beside(from: &str, name: &str) -> String {
    file_name::shown(Path::new(from).parent().unwrap_or(Path::new("")).join(name))
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr as _;

    use super::super::uri::uri_of;
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
