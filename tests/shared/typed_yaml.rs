//! YAML as an editor hands it to a JSON Schema.

use serde_json::{Map, Value};

/// A text typed by YAML 1.2, with every key a text.
pub(crate) fn json(yaml: &str) -> Value {
    convert(serde_yaml::from_str(yaml).unwrap_or_else(|error| panic!("{error}\n{yaml}")))
}

fn convert(value: serde_yaml::Value) -> Value {
    match value {
        serde_yaml::Value::Mapping(map) => {
            let members = map.into_iter().map(|(name, value)| {
                let name = match convert(name) {
                    Value::String(name) => name,
                    other => other.to_string(),
                };
                (name, convert(value))
            });
            Value::Object(members.collect::<Map<_, _>>())
        }
        serde_yaml::Value::Sequence(list) => list.into_iter().map(convert).collect(),
        other => serde_json::to_value(other).expect("a scalar"),
    }
}
