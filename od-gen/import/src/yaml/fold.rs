//! What several entries have in common, said once.

use std::collections::BTreeSet;

use od_spec::model::Fact;

use super::entry::Keys;
use super::node::Node;

/// Keys that hold for all entries of a list, and what single entries have of their own.
pub(super) struct Folded {
    pub common: Keys,
    /// By sub-index.
    pub own: Vec<(u8, Keys)>,
}

/// Takes out what most elements of an array have in common. An element can say another value of a common key, but not that it has
/// none; where a word for "none" exists, it is said.
pub(super) fn elements(list: Vec<(u8, Keys)>) -> Folded {
    let mut facts: Vec<Fact> = list.iter().flat_map(|(_, keys)| keys.iter().map(|(fact, _)| *fact)).collect();
    facts.sort_unstable();
    facts.dedup();
    let mut folded = Folded { common: Vec::new(), own: list };
    for fact in facts.into_iter().filter(|fact| !matches!(fact, Fact::Name | Fact::Identifier)) {
        let Some(common) = most_frequent(&folded.own, fact) else { continue };
        let count =
            |wanted: Option<&Node>| folded.own.iter().filter(|(_, keys)| get(keys, fact) == wanted).count();
        let (missing, having) = (count(None), count(Some(&common)));
        let neutral = match fact {
            Fact::Mapping => Some(Node::plain("none")),
            Fact::Storage => Some(Node::plain("no")),
            _ => None,
        };
        match neutral {
            _ if missing == 0 => {}
            Some(neutral) if having > missing => {
                let without = folded.own.iter_mut().filter(|(_, keys)| get(keys, fact).is_none());
                without.for_each(|(_, keys)| keys.push((fact, neutral.clone())));
            }
            Some(_) | None => continue,
        }
        for (_, keys) in &mut folded.own {
            keys.retain(|key| *key != (fact, common.clone()));
        }
        folded.common.push((fact, common));
    }
    folded
}

/// Takes out what all members of a record have in common, as far as it goes down from the object.
pub(super) fn members(list: Vec<(u8, Keys)>) -> Folded {
    const DOWN: [Fact; 6] = [Fact::Type, Fact::Unit, Fact::Access, Fact::Mapping, Fact::Storage, Fact::Eds];
    let mut folded = Folded { common: Vec::new(), own: list };
    if folded.own.len() < 2 {
        return folded;
    }
    for fact in DOWN {
        let first = folded.own.first().and_then(|(_, keys)| get(keys, fact)).cloned();
        let Some(common) =
            first.filter(|first| folded.own.iter().all(|(_, keys)| get(keys, fact) == Some(first)))
        else {
            continue;
        };
        for (_, keys) in &mut folded.own {
            keys.retain(|(own, _)| *own != fact);
        }
        folded.common.push((fact, common));
    }
    folded
}

/// What most elements of an array are called: the pattern of their names, and of their identifiers if all have one.
pub(super) fn name_patterns(list: &[(u8, Keys)]) -> Vec<(Fact, String)> {
    let has_identifier = |(_, keys): &(u8, Keys)| get(keys, Fact::Identifier).is_some();
    let identifiers = pattern(list, Fact::Identifier).filter(|_| list.iter().all(has_identifier));
    let found = [(Fact::Name, pattern(list, Fact::Name)), (Fact::Identifier, identifiers)];
    found.into_iter().filter_map(|(fact, pattern)| Some((fact, pattern?))).collect()
}

/// The pattern in which `{n}` is the sub-index, if at least two names or the only one follow it; or the name that at least two
/// have.
fn pattern(list: &[(u8, Keys)], fact: Fact) -> Option<String> {
    let names = |sub: &u8, keys: &Keys| Some((*sub, text(get(keys, fact)?)?.to_owned()));
    let names: Vec<(u8, String)> = list.iter().filter_map(|(sub, keys)| names(sub, keys)).collect();
    let fits = |pattern: &str| {
        names.iter().filter(|(sub, name)| pattern.replace("{n}", &sub.to_string()) == *name).count()
    };
    let mut best: Option<(usize, String)> = None;
    let mut offer = |count: usize, least: usize, pattern: &str| {
        if count >= least && best.as_ref().is_none_or(|(most, _)| count > *most) {
            best = Some((count, pattern.to_owned()));
        }
    };
    for (sub, name) in &names {
        for pattern in patterns(name, &sub.to_string()) {
            offer(fits(&pattern), names.len().min(2), &pattern);
        }
    }
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    for (_, name) in names.iter().filter(|(_, name)| seen.insert(name)) {
        offer(fits(name), 2, name);
    }
    best.map(|(_, pattern)| pattern)
}

/// The patterns that a name could come from: each place of the number in it that is a number by itself, the last first.
pub(super) fn patterns(name: &str, number: &str) -> Vec<String> {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let mut patterns = Vec::new();
    for (at, _) in name.rmatch_indices(number) {
        let (before, after) = (&name[..at], &name[at + number.len()..]);
        if !is_digit(before.chars().last()) && !is_digit(after.chars().next()) {
            patterns.push(format!("{before}{{n}}{after}"));
        }
    }
    patterns
}

/// The value that most entries have; of equally frequent ones the first.
fn most_frequent(list: &[(u8, Keys)], fact: Fact) -> Option<Node> {
    let mut best: Option<(usize, &Node)> = None;
    for (_, keys) in list {
        let Some(node) = get(keys, fact) else { continue };
        let count = list.iter().filter(|(_, keys)| get(keys, fact) == Some(node)).count();
        if best.is_none_or(|(most, _)| count > most) {
            best = Some((count, node));
        }
        if count == list.len() {
            break;
        }
    }
    best.map(|(_, node)| node.clone())
}

/// What is written about a fact.
pub(super) fn get(keys: &Keys, fact: Fact) -> Option<&Node> {
    keys.iter().find(|(one, _)| *one == fact).map(|(_, node)| node)
}

/// A text.
fn text(node: &Node) -> Option<&str> {
    match node {
        Node::Text(text) => Some(text),
        Node::Plain(_) | Node::List(_) | Node::Map(_) | Node::Block(_) => None,
    }
}
