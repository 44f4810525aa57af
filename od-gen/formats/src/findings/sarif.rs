//! SARIF 2.1.0 (OASIS): the findings of a whole run as one document, which code scanning services take.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::diag::{Code, Diagnostic, Diagnostics, Label, Severity};
use od_spec::source::{FileId, SourceMap, Span};

use super::json::printed;
use super::{edits, written};

/// What was found in one file, and in the libraries that it uses.
#[derive(Debug, Clone, Copy)]
pub struct Findings<'a> {
    /// The file, as messages name it: for a message that is about no place in it.
    pub name: &'a str,
    /// The messages.
    pub diagnostics: &'a Diagnostics,
    /// The texts that they are about.
    pub sources: &'a SourceMap,
}

/// The document, for a version of `odgen`, with codes explained as `odgen explain` does. Names of files become addresses relative to the
/// directory in which they were given.
pub fn sarif(version: &str, explanation: fn(&Code) -> String, files: &[Findings<'_>]) -> String {
    let codes: BTreeSet<&'static Code> =
        files.iter().flat_map(|file| file.diagnostics).map(|diagnostic| diagnostic.code).collect();
    let rules = codes.iter().map(|code| rule(code, &explanation(code))).collect::<Vec<_>>();
    let positions: BTreeMap<&str, usize> = codes.iter().map(|code| code.id).zip(0..).collect();
    let results = files.iter().flat_map(|file| {
        written(file.diagnostics).map(|diagnostic| {
            result(&diagnostic, positions.get(diagnostic.code.id).copied().unwrap_or_default(), file)
        })
    });
    let driver = object(&[
        ("name", printed("odgen")),
        ("version", printed(version)),
        ("semanticVersion", printed(version)),
        ("rules", list(rules)),
    ]);
    let run = object(&[
        ("tool", object(&[("driver", driver)])),
        // Columns count characters.
        ("columnKind", printed("unicodeCodePoints")),
        ("results", list(results)),
    ]);
    let document = object(&[
        ("$schema", printed("https://json.schemastore.org/sarif-2.1.0.json")),
        ("version", printed("2.1.0")),
        ("runs", list([run])),
    ]);
    document + "\n"
}

fn rule(code: &Code, whole: &str) -> String {
    let text = |text: &str| object(&[("text", printed(text))]);
    object(&[
        ("id", printed(code.id)),
        ("name", printed(&name(code.title))),
        ("shortDescription", text(code.title)),
        ("fullDescription", text(code.explanation)),
        ("help", object(&[("text", printed(whole)), ("markdown", printed(whole))])),
        ("defaultConfiguration", object(&[("level", printed(level(code.severity)))])),
    ])
}

/// `an unknown data type` → `AnUnknownDataType`: rules have names that are identifiers.
fn name(title: &str) -> String {
    let words = title.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words
        .map(|word| {
            let (head, rest) = word.split_at(1);
            head.to_ascii_uppercase() + rest
        })
        .collect()
}

const fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

fn result(diagnostic: &Diagnostic, rule: usize, file: &Findings<'_>) -> String {
    let help = diagnostic.help.iter().map(|help| format!("Help: {help}"));
    let notes = diagnostic.all_notes().map(|note| format!("Note: {note}"));
    let lines: Vec<String> = [diagnostic.message.clone()].into_iter().chain(help).chain(notes).collect();
    let (first, related) = match diagnostic.labels.split_first() {
        Some((first, related)) => (location(first, None, file.sources), related),
        // Services want a line for every result.
        None => {
            let place = physical(file.name, object(&[("startLine", "1".to_owned())]));
            (object(&[("physicalLocation", place)]), [].as_slice())
        }
    };
    let related = (1..).zip(related).map(|(number, label)| location(label, Some(number), file.sources));
    let mut members = vec![
        ("ruleId", printed(diagnostic.code.id)),
        ("ruleIndex", rule.to_string()),
        ("level", printed(level(diagnostic.severity()))),
        ("message", object(&[("text", printed(&lines.join("\n")))])),
        ("locations", list([first])),
    ];
    let related: Vec<String> = related.collect();
    if !related.is_empty() {
        members.push(("relatedLocations", list(related)));
    }
    let readers: Vec<String> = diagnostic.minded_by.iter().map(|reader| printed(reader.name())).collect();
    if !readers.is_empty() {
        members.push(("properties", object(&[("mindedBy", list(readers))])));
    }
    if !edits(diagnostic).is_empty() {
        members.push(("fixes", list([fix(diagnostic, file.sources)])));
    }
    object(&members)
}

/// A marked place; the related ones have numbers.
fn location(label: &Label, number: Option<usize>, sources: &SourceMap) -> String {
    let place = physical(sources.file(label.span.file).name(), region(label.span, sources));
    let mut members = Vec::new();
    members.extend(number.map(|number| ("id", number.to_string())));
    members.push(("physicalLocation", place));
    if !label.text.is_empty() {
        members.push(("message", object(&[("text", printed(&label.text))])));
    }
    object(&members)
}

fn physical(name: &str, region: String) -> String {
    object(&[("artifactLocation", artifact(name)), ("region", region)])
}

fn artifact(name: &str) -> String {
    object(&[("uri", printed(&address(name)))])
}

fn region(span: Span, sources: &SourceMap) -> String {
    let file = sources.file(span.file);
    let (start, end) = (file.line_col(span.start), file.line_col(span.end));
    let numbers = [
        ("startLine", start.line),
        ("startColumn", start.column),
        ("endLine", end.line),
        ("endColumn", end.column),
    ];
    object(&numbers.map(|(key, number)| (key, number.to_string())))
}

/// All edits of a message, by file.
fn fix(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let mut files: BTreeMap<FileId, Vec<String>> = BTreeMap::new();
    for edit in edits(diagnostic) {
        let inserted = object(&[("text", printed(&edit.text))]);
        let replacement =
            object(&[("deletedRegion", region(edit.span, sources)), ("insertedContent", inserted)]);
        files.entry(edit.span.file).or_default().push(replacement);
    }
    let changes = files.into_iter().map(|(file, replacements)| {
        let artifact = artifact(sources.file(file).name());
        object(&[("artifactLocation", artifact), ("replacements", list(replacements))])
    });
    let text = diagnostic.help.as_deref().unwrap_or(&diagnostic.message);
    object(&[("description", object(&[("text", printed(text))])), ("artifactChanges", list(changes))])
}

/// The address of a file: relative as its name is, or `file:///…` where the name is absolute.
fn address(name: &str) -> String {
    let path = name.replace('\\', "/");
    let path = path.strip_prefix("./").unwrap_or(&path);
    let has_drive =
        path.as_bytes().get(1) == Some(&b':') && path.starts_with(|c: char| c.is_ascii_alphabetic());
    let escaped: String = path
        .bytes()
        .map(|byte| match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                char::from(byte).to_string()
            }
            byte => format!("%{byte:02X}"),
        })
        .collect();
    match (path.starts_with('/'), has_drive) {
        (true, _) => format!("file://{escaped}"),
        (false, true) => format!("file:///{escaped}"),
        (false, false) => escaped,
    }
}

/// A JSON object of members whose values are JSON.
fn object(members: &[(&str, String)]) -> String {
    let members = members.iter().map(|(key, value)| format!("{}:{value}", printed(key)));
    format!("{{{}}}", members.collect::<Vec<_>>().join(","))
}

/// A JSON list.
fn list(elements: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", elements.into_iter().collect::<Vec<_>>().join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_become_addresses() {
        assert_eq!(address("./eds/a drive.eds"), "eds/a%20drive.eds");
        assert_eq!(address("../größe#1.eds"), "../gr%C3%B6%C3%9Fe%231.eds");
        assert_eq!(address("/tmp/a.eds"), "file:///tmp/a.eds");
        assert_eq!(address("C:\\eds\\a.eds"), "file:///C%3A/eds/a.eds");
        assert_eq!(address("<stdin>"), "%3Cstdin%3E");
    }

    #[test]
    fn titles_become_names() {
        assert_eq!(name("a sub-index without its object"), "ASubIndexWithoutItsObject");
    }
}
