//! The keys of the language.

use lsp_types::CompletionItemKind;
use od_spec::keys::{Key, Keys, Need, Shape};
use od_spec::yaml::Node;

use super::items::{Insert, Offer, Written};
use super::{Insertion, MARK, Wanted, is_collection};

/// The keys of a map that are not there yet, those that have to be there first.
pub(super) fn of_map(map: &Node, keys: &'static Keys, written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let is_there = |key: &Key| {
        map.entries().iter().any(|(name, _)| !name.value.contains(MARK) && name.value == key.name)
    };
    let missing = keys.keys.iter().filter(|key| !is_there(key));
    missing.map(|key| offer(key, written, wanted.insertion)).collect()
}

fn offer(key: &Key, written: &Written, insertion: Insertion) -> Offer {
    let is_required = key.need == Need::Required;
    let must = if is_required { "required" } else { "" };
    let about = match key.example {
        Some(example) => format!("{}\n\n```yaml\n{}: {example}\n```", key.about, key.name),
        None => key.about.to_owned(),
    };
    let insert = match (insertion, key.shape) {
        // The colon stands there already.
        _ if written.follows == ':' => Insert::Raw(key.name.to_owned()),
        (Insertion::Snippet, Shape::List(_)) => Insert::Snippet(format!("{}: [$0]", key.name)),
        _ if is_collection(key.shape) => Insert::Raw(format!("{}:", key.name)),
        _ => Insert::Raw(format!("{}: ", key.name)),
    };
    Offer {
        insert,
        rank: if is_required { 1 } else { 3 },
        ..Offer::name(key.name, CompletionItemKind::PROPERTY).detail(must).about(Some(about))
    }
}
