//! How a text is written so that every reader of YAML takes it for that text.

/// Words that some reader of YAML takes for a truth value or for nothing.
const WORDS: [&str; 10] = ["yes", "no", "on", "off", "true", "false", "null", "y", "n", "nan"];

/// A text as YAML: plain where it cannot be misread, else in quotes.
pub fn spelled(text: &str) -> String {
    if is_plain(text) {
        return text.to_owned();
    }
    let printable = text.chars().all(is_printable);
    if printable && text.contains(['"', '\\']) && !text.contains('\'') {
        return format!("'{text}'");
    }
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\r' => quoted.push_str("\\r"),
            '\t' => quoted.push_str("\\t"),
            c if is_printable(c) => quoted.push(c),
            c => quoted.push_str(&escaped(c)),
        }
    }
    quoted.push('"');
    quoted
}

fn escaped(c: char) -> String {
    match u32::from(c) {
        code @ ..=0xFF => format!("\\x{code:02X}"),
        code @ ..=0xFFFF => format!("\\u{code:04X}"),
        code => format!("\\U{code:08X}"),
    }
}

/// Whether a character may be in a YAML text as it is, on one line.
fn is_printable(c: char) -> bool {
    match c {
        ' '..='~' | '\u{A0}'..='\u{D7FF}' => !matches!(c, '\u{2028}' | '\u{2029}' | '\u{200B}'..='\u{200F}'),
        '\u{E000}'..='\u{FFFD}' => c != '\u{FEFF}',
        '\u{1_0000}'.. => true,
        _ => false,
    }
}

/// Whether a text needs no quotes, also inside `{…}` and `[…]`.
fn is_plain(text: &str) -> bool {
    let starts_well =
        text.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '$' | '(' | '/' | '_' | '°'));
    let lower = text.to_lowercase();
    starts_well
        && text.trim() == text
        && text.chars().all(|c| is_printable(c) && !matches!(c, ',' | '[' | ']' | '{' | '}' | ':' | '"'))
        && !text.contains(" #")
        && !WORDS.contains(&lower.as_str())
        && !looks_like_a_number(text)
}

/// Whether some reader might take a text for a number or a date.
fn looks_like_a_number(text: &str) -> bool {
    let of_number = |c: char| {
        c.is_ascii_hexdigit() || matches!(c, 'x' | 'X' | 'o' | 'O' | '_' | '.' | '+' | '-' | 'T' | 'Z')
    };
    text.starts_with(|c: char| c.is_ascii_digit()) && text.chars().all(of_number)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::spelled;
    use od_spec::diag::Diagnostics;
    use od_spec::source::SourceMap;
    use od_spec::yaml::{NodeKind, parse};

    /// The texts of a document, as the compiler reads them: a key, its value, both in a flow map, and in a list there.
    fn read(document: &str) -> Option<Vec<String>> {
        let mut sources = SourceMap::new();
        let id = sources.add("text", document);
        let root = parse(id, sources.file(id), &mut Diagnostics::new())?;
        let mut texts = Vec::new();
        let (key, value) = root.entries().first()?;
        texts.extend([key.value.clone(), scalar(value)?]);
        let flow = root.get("flow")?;
        let (key, value) = flow.entries().first()?;
        texts.extend([key.value.clone(), scalar(value)?]);
        texts.push(scalar(flow.get("list")?.items().first()?)?);
        Some(texts)
    }

    fn scalar(node: &od_spec::yaml::Node) -> Option<String> {
        match &node.kind {
            NodeKind::Scalar { text, .. } => Some(text.clone()),
            NodeKind::Null | NodeKind::List(_) | NodeKind::Map(_) | NodeKind::Broken => None,
        }
    }

    fn document(text: &str) -> String {
        let text = spelled(text);
        format!("{text}: {text}\nflow: {{{text}: {text}, list: [{text}, {text}]}}\n")
    }

    fn check(text: &str) {
        let document = document(text);
        assert_eq!(read(&document), Some(vec![text.to_owned(); 5]), "{document}");
        let other: serde_yaml::Value =
            serde_yaml::from_str(&document).unwrap_or_else(|error| panic!("{error}: {document}"));
        let texts = || serde_yaml::Value::String(text.to_owned());
        assert_eq!(other.get(texts()), Some(&texts()), "{document}");
        assert_eq!(other["flow"].get(texts()), Some(&texts()), "{document}");
        assert_eq!(other["flow"]["list"][0], texts(), "{document}");
    }

    #[test]
    fn what_could_be_misread_is_quoted() {
        for text in [
            "",
            " ",
            "a ",
            " a",
            "yes",
            "No",
            "NULL",
            "~",
            "null",
            "on",
            "n",
            "1",
            "0x1F",
            "1.10",
            "-5",
            "+1",
            ".5",
            "1e5",
            "12:30",
            "2009-05-27",
            "1_000",
            "a: b",
            "a:",
            ":a",
            "a #b",
            "#a",
            "a#b",
            "- a",
            "-",
            "?",
            "? a",
            "* a",
            "*a",
            "&a",
            "!a",
            "|",
            ">",
            "%a",
            "@a",
            "`a`",
            "{a}",
            "[a]",
            "a, b",
            "a]",
            "\"a\"",
            "'a'",
            "it's",
            "a\\b",
            "say \"it's\"",
            "a\nb",
            "a\tb",
            "\u{0}",
            "\u{7F}",
            "\u{85}",
            "\u{2028}",
            "\u{FEFF}",
            "日本",
            "°C",
            "µs",
            "Größe",
            "=",
            "<<",
            "---",
            "...",
            "--- a",
            "true",
            ".inf",
            ".nan",
            "0o17",
            "0b1",
            "1,5",
            "$NODEID",
            "(a)",
            "\u{1F600}",
            "a\u{A0}b",
            "é",
        ] {
            check(text);
        }
    }

    #[test]
    fn what_cannot_be_misread_is_not_quoted() {
        for text in [
            "Producer heartbeat time",
            "set pressure (2)",
            "10 ms",
            "Größe",
            "COB-ID SYNC",
            "01 A1 05",
            "it's",
            "a#b",
            "$NODEID + 0x180",
            "/path",
            "°C",
        ] {
            assert_eq!(spelled(text), text);
        }
        assert_eq!(spelled("say \"a\""), "'say \"a\"'");
    }

    proptest! {
        #[test]
        fn every_text_survives(text in "[ -~]{0,12}") {
            check(&text);
        }

        #[test]
        fn every_unicode_text_survives(text in "\\PC{0,8}") {
            check(&text);
        }

        #[test]
        fn control_characters_survive(text in "[\u{0}-\u{A0}\u{2028}\u{FEFF}a:#,\"'\\\\ -]{0,8}") {
            check(&text);
        }
    }
}
