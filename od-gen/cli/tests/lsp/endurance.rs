//! A long session: memory stays as it is.

use serde_json::json;

use crate::LAMP;
use crate::client::Client;

/// Edits of a session: a part of them, or all of a long run.
fn edits() -> i64 {
    if std::env::var_os("OD_TESTS_LONG").is_some() { 10_000 } else { 3_000 }
}

/// So many come faster than answers.
const FAST: i64 = 25;
/// After so many, everything that is kept is there.
const WARM: i64 = 1_000;
/// What memory may grow by from then on, in kB: some analyses of the specification, of which hundreds are made. Allocators give pages
/// back late.
const GROWTH: u64 = 8 * 1024;

/// What is typed: a number grows digit by digit, is wrong in between, and goes away again; now and then a name is broken, and
/// the text is no YAML.
fn typed(version: i64) -> (u32, u32, u32, &'static str) {
    match version % 6 {
        2 => (8, 88, 88, "9"),
        3 => (8, 88, 89, ""),
        4 => (9, 11, 12, "["),
        5 => (9, 11, 12, "n"),
        0 => (9, 54, 55, "k"),
        _ => (9, 54, 55, "c"),
    }
}

#[test]
#[cfg(target_os = "linux")]
fn thousands_of_edits_leave_memory_as_it_is() {
    let edits = edits();
    let mut client = Client::new("endurance");
    client.open("lamp.od.yaml", LAMP);
    client.diagnostics("lamp.od.yaml", 1);
    let (mut warm, mut said) = (0, 0);
    for version in 2..=edits {
        let (line, start, end, text) = typed(version);
        let range =
            json!({"start": {"line": line, "character": start}, "end": {"line": line, "character": end}});
        client.change("lamp.od.yaml", version, &json!([{"range": range, "text": text}]));
        if version % FAST != 0 {
            continue;
        }
        said += usize::from(!client.diagnostics("lamp.od.yaml", version).is_empty());
        client.request_about("textDocument/documentSymbol", "lamp.od.yaml");
        client.request_about("textDocument/foldingRange", "lamp.od.yaml");
        if version == WARM {
            warm = client.resident();
        }
    }
    let end = client.resident();
    assert!(end <= warm + GROWTH, "{warm} kB after {WARM} edits, {end} kB after {edits}");
    // Each kind of edit was seen: three of six are errors.
    assert!(said > usize::try_from(edits / FAST).unwrap() / 3, "{said}");
    assert_eq!(client.leave(), 0);
}
