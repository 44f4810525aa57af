//! Names and texts as the values of keys.

use od_spec::model::{Phrases, Text};

use super::node::{Item, Node};
use super::scalar::spelled;

/// A name by itself, or with what is said about it.
pub(super) fn named(name: &str, more: Vec<Item>, about: &Text, language: &str) -> Node {
    let more: Vec<Item> = more.into_iter().chain(described(about, language)).collect();
    if more.is_empty() {
        return Node::text(name);
    }
    let name = Item::new("name", Node::text(name));
    Node::Map(std::iter::once(name).chain(more).collect())
}

/// `about:`, and `gap:` where the printed manual leaves something open.
pub(super) fn described(text: &Text, language: &str) -> impl Iterator<Item = Item> {
    let about = words(text, language).map(|about| Item::new("about", about));
    about.into_iter().chain(open(text, language).map(|gap| Item::new("gap", gap)))
}

/// What the printed manual leaves open.
pub(super) fn open(text: &Text, language: &str) -> Option<Node> {
    text.gap().and_then(|gap| words(gap, language))
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

/// Phrases by the codes of their languages.
pub(super) fn phrases(phrases: &Phrases) -> Option<Node> {
    let list = |(code, list): (&str, &[String])| {
        Item::new(spelled(code), one_or_more(list.iter().map(|phrase| Node::text(phrase.as_str())).collect()))
    };
    (!phrases.is_empty()).then(|| Node::Map(phrases.iter().map(list).collect()))
}

/// `search:`, where there are words to look for.
pub(super) fn search(of: &Phrases) -> Option<Item> {
    phrases(of).map(|phrases| Item::new("search", phrases))
}

/// A value by itself, several as a list.
pub(super) fn one_or_more(mut nodes: Vec<Node>) -> Node {
    match nodes.pop() {
        Some(one) if nodes.is_empty() => one,
        last => Node::List(nodes.into_iter().chain(last).collect()),
    }
}
