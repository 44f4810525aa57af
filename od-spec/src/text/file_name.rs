//! Names of files on every system.

use std::path::Path;

/// A path as messages show it: with `/` between its parts on every system, so that a message is the same on all of them.
/// Windows takes both separators, except in a path that begins with `\\?\`.
pub fn shown(path: impl AsRef<Path>) -> String {
    let text = path.as_ref().display().to_string();
    if cfg!(windows) { with_slashes(text) } else { text }
}

fn with_slashes(text: String) -> String {
    if text.starts_with(r"\\?\") { text } else { text.replace('\\', "/") }
}

/// `CON`, `NUL`, `COM1`: names that no file can have on Windows, whatever the ending.
pub fn is_device(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    let numbered = |kind: &str| {
        let mut rest = name.strip_prefix(kind).unwrap_or_default().chars();
        matches!((rest.next(), rest.next()), (Some('0'..='9' | '¹' | '²' | '³'), None))
    };
    matches!(name.as_str(), "CON" | "PRN" | "AUX" | "NUL" | "CONIN$" | "CONOUT$")
        || numbered("COM")
        || numbered("LPT")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_paths_have_one_kind_of_separator() {
        for (path, shown) in [
            (r"out\eds/lamp.eds", "out/eds/lamp.eds"),
            (r"C:\specs\lamp.od.yaml", "C:/specs/lamp.od.yaml"),
            (r"\\server\share\a.eds", "//server/share/a.eds"),
            (r"\\?\C:\long\a.eds", r"\\?\C:\long\a.eds"),
        ] {
            assert_eq!(with_slashes(path.to_owned()), shown);
        }
    }
}
