//! Templates and what they are filled with.

/// The template with its marks replaced; `my-device` has the title `My device`.
pub(super) fn fill(template: &str, key: &str, marks: &[(&str, &str)]) -> String {
    let mut title = key.replace('-', " ");
    if let Some(first) = title.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    let mut text = template.replace("<key>", key).replace("<title>", &title);
    for (mark, replacement) in marks {
        text = text.replace(mark, replacement);
    }
    text
}

/// A list of features.
pub(super) fn items<'a>(features: impl Iterator<Item = &'a str>) -> String {
    features.map(|feature| format!("      - {feature}")).collect::<Vec<_>>().join("\n")
}
