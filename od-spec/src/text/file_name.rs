//! Names that no file can have on some system.

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
