//! Rules that hold for every message.

use od_formats::findings;
use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostic, Language};
use od_spec::source::{SourceMap, Span};

use crate::diagnostics::codes::eds_example;
use crate::diagnostics::{cases, human, run, said_of_cases};

/// The wording rules: what the message says, how it starts and ends, that there is help, and that places exist.
pub(crate) fn check_wording(diagnostic: &Diagnostic, sources: &SourceMap, case: &str) {
    let message = diagnostic.message.as_str();
    let at = || format!("{case}: {}: {message}", diagnostic.code);
    let help = diagnostic.help.as_deref().unwrap_or_else(|| panic!("{}: no help", at()));
    assert!(!message.ends_with(['.', '!']) && !message.trim().is_empty(), "{}", at());
    let first = message.chars().next().unwrap();
    let word = message.split([' ', ',', ':']).next().unwrap_or_default();
    let acronym =
        word.len() > 1 && word.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
    assert!(
        first.is_lowercase() || matches!(first, '`' | '-' | '$' | '0'..='9') || acronym || is_index(word),
        "{}",
        at()
    );
    assert!(
        help.chars().next().is_some_and(|c| c.is_lowercase() || c == '`' || c.is_ascii_digit()),
        "{}: {help}",
        at()
    );
    for text in [message, help].into_iter().chain(diagnostic.notes.iter().map(String::as_str)) {
        assert!(!text.contains(['\n', '\r', '\t']), "{}: {text:?} has several lines", at());
        assert!(text.matches('`').count() % 2 == 0, "{}: odd backticks in {text:?}", at());
        assert!(text.chars().count() <= 600, "{}: {text:?} is too long", at());
    }
    for label in &diagnostic.labels {
        assert!(is_inside(label.span, sources), "{}: {:?} lies outside", at(), label.span);
        assert!(!label.text.contains('\n'), "{}: {:?}", at(), label.text);
    }
}

/// `607Ah`, `607Ah.1`.
fn is_index(word: &str) -> bool {
    let (digits, rest) = word.split_at_checked(4).unwrap_or(("", ""));
    !digits.is_empty() && digits.chars().all(|c| c.is_ascii_hexdigit()) && rest.starts_with('h')
}

fn is_inside(span: Span, sources: &SourceMap) -> bool {
    let text = sources.file(span.file).text();
    let (start, end) = (span.start as usize, span.end as usize);
    start <= end && end <= text.len() && text.is_char_boundary(start) && text.is_char_boundary(end)
}

#[test]
fn messages_keep_the_wording_rules() {
    for (name, _, (sources, _, compiled)) in said_of_cases() {
        for diagnostic in &compiled.diagnostics {
            check_wording(diagnostic, sources, name);
            assert!(!diagnostic.labels.is_empty(), "{name}: {} has no place", diagnostic.message);
        }
    }
}

#[test]
fn messages_about_eds_texts_keep_the_wording_rules() {
    let of_texts = od_spec::all_codes().into_iter().filter_map(|code| Some((code, code.example?)));
    let of_texts: Vec<_> =
        of_texts.filter(|(_, example)| matches!(example.language, Language::Eds | Language::Dcf)).collect();
    assert!(of_texts.len() > 50);
    for (code, example) in of_texts {
        let (diagnostics, sources) = eds_example(&example);
        for diagnostic in &diagnostics {
            check_wording(diagnostic, &sources, code.id);
            assert!(!diagnostic.labels.is_empty(), "{code}: {} has no place", diagnostic.message);
            // A command that is recommended must do what is recommended.
            let promises = diagnostic.help.as_deref().unwrap_or_default().contains("`odgen fix` does");
            let is_about_bytes = code.id == "EDS102";
            assert!(!promises || is_about_bytes || !diagnostic.edits.is_empty(), "{code}: nothing is mended");
        }
    }
}

/// A library of the compiler is right: what is wrong is wrong in the user's file.
#[test]
fn messages_are_about_the_users_file() {
    for (name, _, (_, root, compiled)) in said_of_cases() {
        for diagnostic in &compiled.diagnostics {
            assert_eq!(
                diagnostic.labels.first().map(|label| label.span.file),
                Some(*root),
                "{name}: {}",
                diagnostic.message
            );
        }
    }
}

#[test]
fn messages_are_sorted_and_not_repeated() {
    for (name, _, (_, _, compiled)) in said_of_cases() {
        let places: Vec<_> = compiled
            .diagnostics
            .iter()
            .map(|diagnostic| {
                (diagnostic.labels[0].span.file, diagnostic.labels[0].span.start, diagnostic.code)
            })
            .collect();
        assert!(places.is_sorted(), "{name}");
        let mut seen: Vec<&Diagnostic> = Vec::new();
        for diagnostic in &compiled.diagnostics {
            assert!(!seen.contains(&diagnostic), "{name}: {}", diagnostic.message);
            seen.push(diagnostic);
        }
    }
}

#[test]
fn short_and_json_are_one_line_each() {
    for (name, _, (sources, _, compiled)) in said_of_cases() {
        let count = compiled.diagnostics.iter().count();
        let short = render(&compiled.diagnostics, sources, Format::Short, false);
        assert_eq!(short.lines().count(), count, "{name}: {short}");
        assert!(short.lines().all(|line| line.starts_with(&format!("{name}:"))), "{name}: {short}");
        let json = findings::json(&compiled.diagnostics, sources);
        assert_eq!(json.lines().count(), count, "{name}: {json}");
        for (line, diagnostic) in json.lines().zip(&compiled.diagnostics) {
            let value: serde_json::Value = serde_json::from_str(line).unwrap();
            assert_eq!(value["code"], diagnostic.code.id);
            assert_eq!(value["severity"], diagnostic.severity().word());
            assert_eq!(value["message"], diagnostic.message.as_str());
            assert_eq!(value["help"].as_str(), diagnostic.help.as_deref());
            assert_eq!(value["labels"].as_array().unwrap().len(), diagnostic.labels.len());
            assert_eq!(value["labels"][0]["file"], name.as_str());
        }
    }
}

#[test]
fn line_ends_of_other_systems_change_nothing() {
    for (name, text, (sources, _, compiled)) in said_of_cases() {
        let (crlf_sources, _, crlf) = run(name, &text.replace('\n', "\r\n"));
        let short = |diagnostics, sources| render(diagnostics, sources, Format::Short, false);
        assert_eq!(short(&crlf.diagnostics, &crlf_sources), short(&compiled.diagnostics, sources), "{name}");
        assert_eq!(human(&crlf.diagnostics, &crlf_sources), human(&compiled.diagnostics, sources), "{name}");
        assert_eq!(crlf.system.is_some(), compiled.system.is_some(), "{name}");
    }
}

#[test]
fn colour_changes_nothing_but_colour() {
    let (name, text) = cases().into_iter().find(|(name, _)| name == "err_many_mistakes.od.yaml").unwrap();
    let (sources, _, compiled) = run(&name, &text);
    let coloured = render(&compiled.diagnostics, &sources, Format::Human, true);
    assert!(coloured.contains("\u{1b}["));
    let mut plain = String::new();
    let mut rest = coloured.as_str();
    while let Some((before, after)) = rest.split_once("\u{1b}[") {
        plain.push_str(before);
        rest = after.split_once('m').unwrap().1;
    }
    plain.push_str(rest);
    assert_eq!(plain, human(&compiled.diagnostics, &sources));
}
