//! Objects that are alike except for their number, written once.

use od_spec::model::Index;

use super::fold::patterns;
use super::node::{Item, Node};
use super::objects::key;

/// Fewest objects that make a run.
const FEWEST: usize = 3;

/// Objects by ascending index, with runs of equal ones put together. Those that may not be put together have no index.
pub(super) fn fold(items: &[(Option<Index>, Item)]) -> Vec<Item> {
    let mut out = Vec::new();
    let mut rest = items;
    while let Some(((_, first), behind)) = rest.split_first() {
        match run(rest).filter(|(length, _)| *length >= FEWEST) {
            Some((length, item)) => {
                out.push(item);
                rest = &rest[length..];
            }
            None => {
                out.push(first.clone());
                rest = behind;
            }
        }
    }
    out
}

/// The longest run at the start of a list: its length, and what is written for it.
fn run(items: &[(Option<Index>, Item)]) -> Option<(usize, Item)> {
    let (Some(first), item) = items.first()? else { return None };
    let named = patterns(name(item)?, "1").into_iter().map(|pattern| {
        let length = (0u16..).zip(items).take_while(|(at, (index, one))| {
            let expected = first.0.checked_add(*at).map(Index);
            let number = (u32::from(*at) + 1).to_string();
            *index == expected && index.is_some() && is_like(item, one, &pattern, &number)
        });
        (length.count(), pattern)
    });
    let (length, pattern) = named.max_by_key(|(length, _)| *length)?;
    let last = Index(first.0 + u16::try_from(length).ok()?.checked_sub(1)?);
    let value = with_name(&item.value, &pattern)?;
    Some((length, Item { key: format!("{}..{}", key(*first), key(last)), value, ..item.clone() }))
}

/// The items of an object that says nothing but its own facts.
fn items(item: &Item) -> Option<&[Item]> {
    match &item.value {
        Node::Map(items) if item.above.is_empty() && !has_comments(items) => Some(items),
        Node::Map(_) | Node::Text(_) | Node::Plain(_) | Node::List(_) | Node::Block(_) => None,
    }
}

fn has_comments(items: &[Item]) -> bool {
    items.iter().any(|item| {
        !item.above.is_empty()
            || match &item.value {
                Node::Map(items) | Node::Block(items) => has_comments(items),
                Node::Text(_) | Node::Plain(_) | Node::List(_) => false,
            }
    })
}

fn name(item: &Item) -> Option<&str> {
    let has_identifier = items(item)?.iter().any(|item| item.key == "identifier");
    match items(item)?.first() {
        Some(Item { key, value: Node::Text(name), .. }) if key == "name" && !has_identifier => Some(name),
        _ => None,
    }
}

/// Whether an object is the one of this number in a run.
fn is_like(first: &Item, other: &Item, pattern: &str, number: &str) -> bool {
    let named = name(other).is_some_and(|name| name == pattern.replace("{n}", number));
    let same = || Some(items(first)?.get(1..)? == items(other)?.get(1..)?);
    named && same().unwrap_or(false)
}

/// An object under another name.
fn with_name(value: &Node, name: &str) -> Option<Node> {
    let Node::Map(items) = value else { return None };
    let mut items = items.clone();
    items.first_mut()?.value = Node::text(name);
    Some(Node::Map(items))
}
