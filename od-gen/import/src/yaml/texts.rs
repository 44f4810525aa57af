//! Names and texts as the values of keys.

use od_spec::model::Text;

use super::node::{Item, Node};
use super::scalar::spelled;

/// A name by itself, or with what is said about it.
pub(super) fn named(name: &str, more: Vec<Item>, about: &Text, language: &str) -> Node {
    let about = words(about, language).map(|about| Item::new("about", about));
    let more: Vec<Item> = more.into_iter().chain(about).collect();
    if more.is_empty() {
        return Node::text(name);
    }
    let name = Item::new("name", Node::text(name));
    Node::Map(std::iter::once(name).chain(more).collect())
}

/// A text in one language as it is, in several by their codes.
pub(super) fn words(text: &Text, language: &str) -> Option<Node> {
    let by_language: Vec<(&str, &str)> = text.iter().collect();
    match by_language.as_slice() {
        [] => None,
        [(code, text)] if *code == language => Some(Node::text(*text)),
        texts => {
            let items = texts.iter().map(|(code, text)| Item::new(spelled(code), Node::text(*text)));
            Some(Node::Map(items.collect()))
        }
    }
}

/// A value by itself, several as a list.
pub(super) fn one_or_more(mut nodes: Vec<Node>) -> Node {
    match nodes.pop() {
        Some(one) if nodes.is_empty() => one,
        last => Node::List(nodes.into_iter().chain(last).collect()),
    }
}
