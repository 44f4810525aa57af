//! A picture file as an address that has the picture in itself.

use std::fs;
use std::path::Path;

use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Reads an SVG or PNG file.
pub(crate) fn read(path: &Path) -> Result<String, Diagnostic> {
    let shown = file_name::shown(path);
    let bytes = fs::read(path).map_err(|error| {
        Diagnostic::without_place(codes::UNREADABLE, format!("cannot read {shown}: {error}"))
            .help("correct the path of the logo")
    })?;
    let kind = if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        "image/png"
    } else if std::str::from_utf8(&bytes).is_ok_and(|text| text.contains("<svg")) {
        "image/svg+xml"
    } else {
        return Err(Diagnostic::without_place(
            codes::UNREADABLE,
            format!("{shown} is no SVG and no PNG file"),
        )
        .help("give the logo as an SVG or PNG file"));
    };
    Ok(format!("data:{kind};base64,{}", base64(&bytes)))
}

/// Bytes in groups of three as four digits each (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |at: usize| u32::from(group.get(at).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let digit = bits >> (18 - 6 * place) & 0x3F;
            text.push(if place > group.len() { '=' } else { char::from(DIGITS[digit as usize]) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn groups_are_filled_up() {
        let texts = ["", "f", "fo", "foo", "foob"];
        assert_eq!(texts.map(|text| base64(text.as_bytes())), ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }
}
