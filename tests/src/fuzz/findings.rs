//! What is demanded of findings, whatever text they are about: their places, and how they read in every format.

use od_formats::findings::{Findings, github, json, sarif};
use od_reference::explanation;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::source::{SourceMap, Span};
use serde_json::Value;

/// What is wrong with the texts of findings.
pub(super) fn wrong(
    name: &str,
    diagnostics: &Diagnostics,
    sources: &SourceMap,
) -> Vec<(&'static str, String)> {
    let count = diagnostics.iter().count();
    let [human, short] =
        [Format::Human, Format::Short].map(|format| render(diagnostics, sources, format, false));
    let (json, github) = (json(diagnostics, sources), github(diagnostics, sources));
    let document = sarif("0.0.0", explanation, &[Findings { name, diagnostics, sources }]);
    let mut wrong = places(diagnostics, sources);
    for (format, text) in
        [("human", &human), ("short", &short), ("json", &json), ("github", &github), ("sarif", &document)]
    {
        let is_raw = |c: &char| c.is_control() && *c != '\n';
        wrong.extend(
            text.chars().find(is_raw).map(|raw| (format, format!("has the character {raw:?} as it is"))),
        );
    }
    // Of a code, people see the first thousand, and a line that counts the others.
    let (shown, more) = diagnostics.first_of_each_code(1_000);
    let lines = |format, text: &str, expected: usize| {
        let found = text.split_terminator('\n').count();
        (found != expected).then(|| (format, format!("{found} lines for {count} findings")))
    };
    wrong.extend(lines("short", &short, shown.len() + more.len()));
    wrong.extend(lines("json", &json, count));
    wrong.extend(lines("github", &github, count));
    let is_object = |line: &str| serde_json::from_str::<Value>(line).is_ok_and(|value| value.is_object());
    let broken = json.lines().find(|line| !is_object(line));
    wrong.extend(broken.map(|line| ("json", format!("no object: `{line}`"))));
    match serde_json::from_str::<Value>(&document) {
        Ok(document) => {
            let results = document.pointer("/runs/0/results").and_then(Value::as_array).map(Vec::len);
            wrong.extend(
                (results != Some(count))
                    .then(|| ("sarif", format!("{results:?} results for {count} findings"))),
            );
        }
        Err(error) => wrong.push(("sarif", format!("cannot be read: {error}"))),
    }
    wrong
}

/// A place is a part of its file, from character to character.
fn places(diagnostics: &Diagnostics, sources: &SourceMap) -> Vec<(&'static str, String)> {
    let spans = diagnostics.iter().flat_map(|one| one.labels.iter().map(move |label| (one, label.span)));
    let outside = |span: Span| {
        let bytes = usize::try_from(span.start).ok().zip(usize::try_from(span.end).ok());
        let part = bytes.and_then(|(start, end)| sources.file(span.file).text().get(start..end));
        part.is_none().then_some((span.start, span.end))
    };
    let wrong = spans.filter_map(|(one, span)| Some((one, outside(span)?)));
    wrong.map(|(one, (start, end))| ("places", format!("{} is at {start} to {end}", one.code.id))).collect()
}
