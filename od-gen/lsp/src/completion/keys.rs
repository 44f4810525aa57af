//! The keys of the language.

use lsp_types::CompletionItemKind;
use od_spec::keys::{Choice, Key, Keys, Need, OBJECT, SPEC, Shape, TYPE};
use od_spec::model::DataType;
use od_spec::yaml::Node;

use super::items::{Insert, Offer, Written};
use super::{Insertion, MARK, Wanted, is_collection};

/// The keys of a map that are not there yet, those that have to be there first.
pub(super) fn of_map(map: &Node, keys: &'static Keys, written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let has =
        |key: &str| map.entries().iter().any(|(name, _)| !name.value.contains(MARK) && name.value == key);
    let missing = keys.keys.iter().filter(|key| !has(key.name) && !is_refused(key.name, keys, map, &has));
    missing.enumerate().map(|(at, key)| offer(key, at, written, wanted.insertion)).collect()
}

/// The keys that most objects and entries have, in the order in which they are usually written.
const USUAL: [&str; 11] =
    ["name", "type", "unit", "access", "pdo", "default", "min", "max", "record", "array", "from"];

/// Keys of an entry that are about one value.
const OF_ONE_VALUE: [&str; 6] = ["default", "min", "max", "special", "bit-errors", "capacity"];

/// Whether `check` refuses a key next to those that a map has.
fn is_refused(key: &str, keys: &Keys, map: &Node, has: &impl Fn(&str) -> bool) -> bool {
    let any = |others: &[&str]| others.iter().any(|other| has(other));
    let text = |key: &str| map.get(key).and_then(Node::text).map(|text| text.value);
    let of_object = keys.name == OBJECT.name
        && match key {
            "array" => any(&["record", "alias"]),
            "record" => any(&["array", "alias"]),
            "from" => any(&["like", "alias"]),
            "like" => any(&["from", "alias"]),
            "alias" => any(&["from", "like", "array", "record", "default", "stored"]),
            "outside" | "rounding" => !has("alias"),
            "omit" => !any(&["from", "like", "array"]),
            "sub0" => !any(&["from", "like", "array", "record"]),
            "stored" => has("alias"),
            _ => OF_ONE_VALUE.contains(&key) && any(&["array", "record"]) || key == "default" && has("alias"),
        };
    let of_entry = keys.get("writable-when").is_some()
        && match key {
            "writable-when" => text("access").is_some_and(|access| matches!(access, "ro" | "const")),
            "capacity" => {
                text("type").and_then(DataType::from_name).is_some_and(|data_type| !data_type.is_string())
            }
            _ => false,
        };
    let of_type = keys.name == TYPE.name && key == "rest" && has("values");
    let of_file = keys.name == SPEC.name && matches!(key, "features" | "axes") && !has("profile");
    let is_other_choice = keys.choices.iter().any(|choice| match choice {
        Choice::One(names) => names.contains(&key) && any(names),
        Choice::Any(_) | Choice::AnyInherited(_) | Choice::Together(_) => false,
    });
    of_object || of_entry || of_type || of_file || is_other_choice
}

fn offer(key: &Key, at: usize, written: &Written, client: &Insertion) -> Offer {
    let usual = USUAL.iter().position(|usual| *usual == key.name);
    let is_required = key.need == Need::Required;
    let must = if is_required { "required" } else { "" };
    let about = match key.example {
        Some(example) => format!("{}\n\n```yaml\n{}: {example}\n```", key.about, key.name),
        None => key.about.to_owned(),
    };
    let is_new = written.follows != ':';
    let insert = match (client.snippets, key.shape) {
        _ if !is_new => Insert::Raw(key.name.to_owned()),
        (true, Shape::List(_)) => Insert::Snippet(format!("{}: [$0]", key.name)),
        _ if is_collection(key.shape) => Insert::Raw(format!("{}:", key.name)),
        _ => Insert::Raw(format!("{}: ", key.name)),
    };
    Offer {
        insert,
        rank: match usual {
            _ if is_required => 1,
            Some(_) => 2,
            None => 3,
        },
        order: usual.unwrap_or(at),
        goes_on: is_new && !is_collection(key.shape),
        ..Offer::name(key.name, CompletionItemKind::PROPERTY).detail(must).about(Some(about))
    }
}
