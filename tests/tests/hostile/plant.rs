//! Other texts in the places of a specification's own.

use std::collections::BTreeSet;
use std::ops::Range;

use od_spec::diag::Diagnostics;
use od_spec::keys::{KeyKind, Keys, SPEC, Shape};
use od_spec::source::SourceMap;
use od_spec::visible::visible_json;
use od_spec::yaml::{Node, NodeKind, parse};

/// A key of the language: what it is a key of, and its name.
pub(crate) type KeyName = (&'static str, &'static str);

/// A text of the specification, wherever it stands: a name stands where it is given and where it is used.
#[derive(Debug, Clone)]
pub(crate) struct Site {
    pub(crate) text: String,
    pub(crate) keys: BTreeSet<KeyName>,
    pub(crate) places: Vec<Range<usize>>,
}

/// Every text of a specification, by the tables of keys.
pub(crate) fn sites(text: &str) -> Vec<Site> {
    let mut sources = SourceMap::new();
    let id = sources.add("texts.od.yaml", text);
    let root = parse(id, sources.file(id), &mut Diagnostics::new()).unwrap();
    let mut sites = Vec::new();
    walk_map(&root, &SPEC, &mut sites);
    let mut scalars = Vec::new();
    all(&root, &mut scalars);
    for site in &mut sites {
        let same = scalars.iter().filter(|(text, _)| *text == site.text);
        site.places = same.map(|(_, place)| place.clone()).collect();
    }
    sites
}

/// The keys that take a text.
pub(crate) fn text_keys() -> BTreeSet<KeyName> {
    fn keys(table: &'static Keys, seen: &mut BTreeSet<&'static str>, found: &mut BTreeSet<KeyName>) {
        if seen.insert(table.name) {
            for key in table.keys {
                shape(key.shape, (table.name, key.name), seen, found);
            }
        }
    }
    fn shape(one: Shape, name: KeyName, seen: &mut BTreeSet<&'static str>, found: &mut BTreeSet<KeyName>) {
        match one {
            Shape::Text | Shape::HeaderText | Shape::Words | Shape::NumberedName(_) => {
                found.insert(name);
            }
            Shape::Map(table) => keys(table, seen, found),
            Shape::MapOf(kind, inner) => {
                if kind == KeyKind::Name {
                    found.insert(name);
                }
                shape(*inner, name, seen, found);
            }
            Shape::List(inner) | Shape::OneOrMore(inner) => shape(*inner, name, seen, found),
            Shape::ShortOr(short, table) => {
                shape(*short, name, seen, found);
                keys(table, seen, found);
            }
            _ => {}
        }
    }
    let mut found = BTreeSet::new();
    keys(&SPEC, &mut BTreeSet::new(), &mut found);
    found
}

/// The text with a payload at some sites, each with its number, and where the payloads stand.
pub(crate) fn planted(
    text: &str,
    sites: &[Site],
    chosen: &[usize],
    payload: &str,
) -> (String, Vec<(Range<usize>, usize)>) {
    let mut places: Vec<(Range<usize>, usize)> = chosen
        .iter()
        .flat_map(|at| sites[*at].places.iter().map(move |place| (place.clone(), *at)))
        .collect();
    places.sort_by_key(|(place, _)| place.start);
    let (mut out, mut end, mut now) = (String::new(), 0, Vec::new());
    for (place, at) in places {
        out.push_str(&text[end..place.start]);
        let start = out.len();
        let placeholders: String =
            ["{n}", "{pdo}"].into_iter().filter(|one| sites[at].text.contains(one)).collect();
        let quoted = serde_json::to_string(&format!("{payload} {at} {placeholders}").trim_end()).unwrap();
        out.push_str(&visible_json(&quoted));
        now.push((start..out.len(), at));
        end = place.end;
    }
    out.push_str(&text[end..]);
    (out, now)
}

fn walk_map(node: &Node, table: &'static Keys, sites: &mut Vec<Site>) {
    for (name, value) in node.entries() {
        if let Some(key) = table.keys.iter().find(|key| key.name == name.value) {
            walk(value, key.shape, (table.name, key.name), sites);
        }
    }
}

fn walk(node: &Node, shape: Shape, name: KeyName, sites: &mut Vec<Site>) {
    match shape {
        Shape::Text | Shape::HeaderText | Shape::Words | Shape::NumberedName(_) => match &node.kind {
            NodeKind::Map(entries) => entries.iter().for_each(|(_, value)| walk(value, shape, name, sites)),
            _ => node.text().into_iter().for_each(|text| add(text.value, name, sites)),
        },
        Shape::Map(table) => walk_map(node, table, sites),
        Shape::MapOf(kind, inner) => {
            for (key, value) in node.entries() {
                if kind == KeyKind::Name {
                    add(&key.value, name, sites);
                }
                walk(value, *inner, name, sites);
            }
        }
        Shape::List(inner) => node.items().iter().for_each(|item| walk(item, *inner, name, sites)),
        Shape::OneOrMore(inner) => match &node.kind {
            NodeKind::List(items) => items.iter().for_each(|item| walk(item, *inner, name, sites)),
            _ => walk(node, *inner, name, sites),
        },
        Shape::ShortOr(short, table) => match &node.kind {
            NodeKind::Map(_) => walk_map(node, table, sites),
            _ => walk(node, *short, name, sites),
        },
        _ => {}
    }
}

fn add(text: &str, name: KeyName, sites: &mut Vec<Site>) {
    match sites.iter_mut().find(|site| site.text == text) {
        Some(site) => drop(site.keys.insert(name)),
        None => sites.push(Site { text: text.to_owned(), keys: BTreeSet::from([name]), places: Vec::new() }),
    }
}

/// Every scalar with its place.
fn all(node: &Node, found: &mut Vec<(String, Range<usize>)>) {
    match &node.kind {
        NodeKind::Scalar { text, .. } => {
            found.push((text.clone(), node.span.start as usize..node.span.end as usize));
        }
        NodeKind::List(items) => items.iter().for_each(|item| all(item, found)),
        NodeKind::Map(entries) => {
            for (key, value) in entries {
                found.push((key.value.clone(), key.span.start as usize..key.span.end as usize));
                all(value, found);
            }
        }
        NodeKind::Null | NodeKind::Broken => {}
    }
}
