//! Templates and what they are filled with.

use od_spec::diag::{Diagnostic, codes};

/// The template with its marks, such as `{{key}}`, replaced; `my-device` has the title `My device`.
///
/// # Errors
/// A mark that nothing replaces, as of a template that is misspelt.
pub(super) fn fill(template: &str, key: &str, marks: &[(&str, &str)]) -> Result<String, Diagnostic> {
    let title = title(key);
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (mark, rest) = piece.split_once("}}").unwrap_or((piece, ""));
        let replacement = match mark {
            "key" => key,
            "title" => &title,
            _ => marks.iter().find(|(name, _)| *name == mark).ok_or_else(|| unknown(mark))?.1,
        };
        text.push_str(replacement);
        text.push_str(rest);
    }
    Ok(text)
}

fn title(key: &str) -> String {
    let mut title = key.replace('-', " ");
    if let Some(first) = title.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    title
}

fn unknown(mark: &str) -> Diagnostic {
    let mark = mark.lines().next().unwrap_or_default();
    Diagnostic::without_place(codes::BAD_TEMPLATE, format!("nothing replaces the mark `{{{{{mark}}}}}`"))
        .help("report this: a template of `odgen new` is wrong")
}

/// A list of features.
pub(super) fn items<'a>(features: impl Iterator<Item = &'a str>) -> String {
    features.map(|feature| format!("      - {feature}")).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_replaced() {
        let text = fill("{{title}} {{key}}: [{{other}}] {a}", "my-device", &[("other", "{{key}}")]);
        assert_eq!(text.unwrap(), "My device my-device: [{{key}}] {a}");
    }

    #[test]
    fn a_mark_that_nothing_replaces_is_refused() {
        for (template, mark) in [("a {{kye}} b", "kye"), ("{{Key}}", "Key"), ("{{key\nb", "key")] {
            let message = fill(template, "device", &[]).unwrap_err().message;
            assert_eq!(message, format!("nothing replaces the mark `{{{{{mark}}}}}`"));
        }
    }
}
