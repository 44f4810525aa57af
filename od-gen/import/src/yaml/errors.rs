//! `errors:`: the error codes of the device.

use od_spec::model::{ErrorCode, Text};

use super::context::Context;
use super::node::{Item, Node};
use super::texts::{described, one_or_more, search, words};

/// The codes that the device reports, in full.
pub(super) fn items(context: &Context<'_>) -> Vec<Item> {
    let reported = context.system.errors.iter().filter(|error| error.devices.includes(&context.device.key));
    reported.map(|error| Item::new(format!("0x{:04X}", error.code), code(context, error))).collect()
}

fn code(context: &Context<'_>, error: &ErrorCode) -> Node {
    let language = context.language();
    let mut items = vec![Item::new("name", Node::text(error.name.clone()))];
    let mut add = |key: &str, node: Option<Node>| items.extend(node.map(|node| Item::new(key, node)));
    let is_treated = error.treated_by.includes(&context.device.key);
    let text = |text: &Text| words(text, language);
    add("priority", error.priority.clone().filter(|_| is_treated).map(Node::Text));
    add("reaction", text(&error.reaction).filter(|_| is_treated));
    let chosen_by = error.option_code.filter(|id| is_treated && context.device.entry(*id).is_some());
    add("option-code", chosen_by.map(|id| Node::plain(id.notation())));
    let kinds: Vec<Node> = error.kinds.iter().map(|kind| Node::plain(kind.word())).collect();
    add("register", (!kinds.is_empty()).then(|| one_or_more(kinds)));
    add("reset", text(&error.reset));
    items.extend(described(&error.about, language));
    items.extend(search(&error.search));
    Node::Map(items)
}
