//! Another reader of YAML sees the same in a specification.

use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::yaml::{Node, NodeKind};
use od_spec::{LIBRARIES, scalar};
use od_tests::shipped::PITCH;

use crate::diagnostics::cases;

/// What two YAML readers must agree about: structure, order, and scalars by what they mean.
fn same(ours: &Node, theirs: &serde_yaml::Value, place: &str) {
    use serde_yaml::Value;
    match (&ours.kind, theirs) {
        (NodeKind::Null, Value::Null) => {}
        (NodeKind::List(items), Value::Sequence(their_items)) => {
            assert_eq!(items.len(), their_items.len(), "{place}");
            for (at, (item, their_item)) in items.iter().zip(their_items).enumerate() {
                same(item, their_item, &format!("{place}[{at}]"));
            }
        }
        (NodeKind::Map(entries), Value::Mapping(their_entries)) => {
            assert_eq!(entries.len(), their_entries.len(), "{place}");
            for ((name, node), (their_key, their_node)) in entries.iter().zip(their_entries) {
                let key_text = name.value.as_str();
                same_scalar(key_text, their_key, &format!("{place}, key {key_text}"));
                same(node, their_node, &format!("{place}.{key_text}"));
            }
        }
        (NodeKind::Scalar { text, .. }, theirs) => same_scalar(text, theirs, place),
        (kind, theirs) => panic!("{place}: {kind:?} is not {theirs:?}"),
    }
}

/// YAML readers give plain scalars a type; ours keeps the text. Numbers are compared as numbers.
fn same_scalar(text: &str, theirs: &serde_yaml::Value, place: &str) {
    use serde_yaml::Value;
    let means_the_same = match theirs {
        Value::String(string) => string == text,
        Value::Bool(value) => text == value.to_string(),
        Value::Number(number) => match (number.as_i64().map(i128::from), number.as_u64().map(i128::from)) {
            (Some(value), _) | (None, Some(value)) => scalar::integer(text) == Ok(value),
            _ => text.parse::<f64>().ok() == number.as_f64(),
        },
        Value::Null => matches!(text, "" | "~" | "null"),
        _ => false,
    };
    assert!(means_the_same, "{place}: `{text}` is not {theirs:?}");
}

#[test]
fn another_yaml_reader_sees_the_same() {
    let accepted = cases().into_iter().filter(|(name, _)| name.starts_with("ok_"));
    let libraries = LIBRARIES.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    for (name, text) in accepted.chain(libraries).chain([("pitch".to_owned(), PITCH.clone())]) {
        let mut sources = SourceMap::new();
        let id = sources.add(name.as_str(), text.as_str());
        let mut diagnostics = Diagnostics::new();
        let ours = od_spec::yaml::parse(id, sources.file(id), &mut diagnostics).expect("YAML");
        assert!(diagnostics.is_empty(), "{name}");
        let theirs: serde_yaml::Value =
            serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        same(&ours, &theirs, &name);
    }
}
