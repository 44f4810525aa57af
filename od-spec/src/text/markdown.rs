//! Texts as Markdown shows them: signs that it would read as its own are escaped.

/// A text on one line, with the signs escaped that Markdown would read as its own.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut before = ' ';
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let after = signs.peek().copied().unwrap_or(' ');
        let special = match sign {
            '\\' | '`' | '*' | '[' | ']' | '|' | '~' => true,
            // `<` begins a tag, `&` an entity, only before a letter or the like.
            '<' => after.is_alphabetic() || matches!(after, '/' | '!' | '?'),
            '&' => after.is_alphanumeric() || after == '#',
            // Inside a word it is not an emphasis.
            '_' => !(before.is_alphanumeric() && after.is_alphanumeric()),
            _ => false,
        };
        if special {
            escaped.push('\\');
        }
        escaped.push(if sign.is_control() { ' ' } else { sign });
        before = sign;
    }
    escaped
}

/// An escaped text as a paragraph of its own: what would begin a heading, a list or a quotation is escaped, too.
pub fn paragraph(text: String) -> String {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    if digits > 0 && text[digits..].starts_with(['.', ')']) {
        return format!("{}\\{}", &text[..digits], &text[digits..]);
    }
    if text.starts_with(['#', '>', '-', '+', '=']) { format!("\\{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_signs_that_markdown_reads_are_escaped() {
        assert_eq!(escape("1 < 2, a <b> c & d &amp; e"), "1 < 2, a \\<b> c & d \\&amp; e");
        assert_eq!(escape("PMM_controlword _x_ a*b|c"), "PMM_controlword \\_x\\_ a\\*b\\|c");
        assert_eq!(escape("r(w) 0..3 [1]"), "r(w) 0..3 \\[1\\]");
    }

    #[test]
    fn a_paragraph_is_no_heading_list_or_quotation() {
        for text in ["# a", "> a", "- a", "+ a", "= a"] {
            assert_eq!(paragraph(text.to_owned()), format!("\\{text}"));
        }
        assert_eq!(paragraph("12. a".to_owned()), "12\\. a");
        assert_eq!(paragraph("12 a".to_owned()), "12 a");
    }
}
