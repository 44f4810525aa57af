//! Other texts in the places of a specification's own.

use std::collections::BTreeSet;
use std::ops::Range;

use od_spec::diag::{Diagnostics, Severity};
use od_spec::keys::{KeyKind, Keys, SPEC, Shape};
use od_spec::source::SourceMap;
use od_spec::visible::visible_json;
use od_spec::yaml::{Node, NodeKind, parse};
use od_spec::{Compiled, NoFiles, compile};

/// A specification in which every key that takes a text has one.
pub const TEXTS: &str = include_str!("../shared/texts.od.yaml");

/// A key of the language: what it is a key of, and its name.
pub type KeyName = (&'static str, &'static str);

/// A text of the specification, wherever it is: a name is where it is given and where it is used.
#[derive(Debug, Clone)]
pub struct Site {
    /// The text that is there.
    pub text: String,
    /// The keys that it is given for.
    pub keys: BTreeSet<KeyName>,
    /// Where it is.
    pub places: Vec<Range<usize>>,
}

/// A specification with a payload in all places that take it.
#[derive(Debug)]
pub struct Accepted {
    /// The numbers of these sites.
    pub chosen: Vec<usize>,
    /// What was compiled.
    pub sources: SourceMap,
    /// What came out; there is a model.
    pub compiled: Compiled,
}

/// Compiles a specification whose name would command a terminal.
#[must_use]
pub fn compiled(text: &str) -> (SourceMap, Compiled) {
    let mut sources = SourceMap::new();
    let root = sources.add("texts\u{1b}[31m\n::error::.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (sources, compiled)
}

/// Plants a payload: what is refused is left out until the rest is accepted. Nothing, if that does not come to an end. What comes
/// out on the way is shown to `look`.
pub fn accepted(
    text: &str,
    sites: &[Site],
    payload: &str,
    look: &mut dyn FnMut(&SourceMap, &Compiled),
) -> Option<Accepted> {
    let mut chosen: Vec<usize> = (0..sites.len()).collect();
    loop {
        let (now, places) = planted(text, sites, &chosen, payload);
        let (sources, result) = compiled(&now);
        look(&sources, &result);
        if result.system.is_some() {
            return Some(Accepted { chosen, sources, compiled: result });
        }
        let mut refused = refused(&now, &places, &result.diagnostics);
        if refused.is_empty() {
            // The message is about something else that has the text: each is tried alone.
            let is_taken = |at: usize| compiled(&planted(text, sites, &[at], payload).0).1.system.is_some();
            refused = chosen.iter().copied().filter(|at| !is_taken(*at)).collect();
        }
        let before = chosen.len();
        chosen.retain(|at| !refused.contains(at));
        if chosen.len() == before {
            return None;
        }
    }
}

/// The sites that errors are about.
fn refused(text: &str, places: &[(Range<usize>, usize)], diagnostics: &Diagnostics) -> BTreeSet<usize> {
    let errors = diagnostics.iter().filter(|one| one.severity() == Severity::Error);
    let spans = errors.flat_map(|one| &one.labels).map(|label| label.span);
    spans
        .flat_map(|span| {
            let (start, end) = (span.start as usize, span.end as usize);
            let within = |wanted: &dyn Fn(&Range<usize>) -> bool| -> Vec<usize> {
                places.iter().filter(|(place, _)| wanted(place)).map(|(_, at)| *at).collect()
            };
            let exact = within(&|place| place.start < end.max(start + 1) && start < place.end);
            if !exact.is_empty() {
                return exact;
            }
            // Of a message about a key, everything below it.
            let block = block(text, start);
            within(&|place| block.contains(&place.start))
        })
        .collect()
}

/// The line of a place, and those below it that are indented further.
fn block(text: &str, at: usize) -> Range<usize> {
    let indent = |line: &str| line.len() - line.trim_start().len();
    let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
    let mut lines = text[start..].split_inclusive('\n');
    let first = lines.next().unwrap_or_default();
    let below = lines.take_while(|line| indent(line) > indent(first)).map(str::len).sum::<usize>();
    start..start + first.len() + below
}

/// Every text of a specification, by the tables of keys.
#[must_use]
pub fn sites(text: &str) -> Vec<Site> {
    let mut sources = SourceMap::new();
    let id = sources.add("texts.od.yaml", text);
    let mut sites = Vec::new();
    let Some(root) = parse(id, sources.file(id), &mut Diagnostics::new()) else { return sites };
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
#[must_use]
pub fn text_keys() -> BTreeSet<KeyName> {
    fn keys(table: &'static Keys, seen: &mut BTreeSet<&'static str>, found: &mut BTreeSet<KeyName>) {
        if seen.insert(table.name) {
            for key in table.keys {
                shape(key.shape, (table.name, key.name), seen, found);
            }
        }
    }
    fn shape(one: Shape, name: KeyName, seen: &mut BTreeSet<&'static str>, found: &mut BTreeSet<KeyName>) {
        match one {
            Shape::Text | Shape::HeaderText | Shape::Words | Shape::NumberedName(_) | Shape::NameOf(_) => {
                found.insert(name);
            }
            Shape::Map(table) => keys(table, seen, found),
            Shape::MapOf(kind, inner) => {
                if matches!(kind, KeyKind::Name | KeyKind::Device) {
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

/// What is at a site instead of its text: the payload with the number of the site, and the placeholders that the text
/// has.
#[must_use]
pub fn text_at(sites: &[Site], at: usize, payload: &str) -> String {
    let text = &sites[at].text;
    let placeholders: String = ["{n}", "{pdo}"].into_iter().filter(|one| text.contains(one)).collect();
    format!("{payload} {at} {placeholders}").trim_end().to_owned()
}

/// The text with a payload at some sites, each with its number, and where the payloads are.
#[must_use]
pub fn planted(
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
        let quoted = serde_json::Value::from(text_at(sites, at, payload)).to_string();
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
        Shape::Text | Shape::HeaderText | Shape::Words | Shape::NumberedName(_) | Shape::NameOf(_) => {
            match &node.kind {
                NodeKind::Map(entries) => {
                    for (_, value) in entries {
                        walk(value, shape, name, sites);
                    }
                }
                _ => node.text().into_iter().for_each(|text| add(text.value, name, sites)),
            }
        }
        Shape::Map(table) => walk_map(node, table, sites),
        Shape::MapOf(kind, inner) => {
            for (key, value) in node.entries() {
                if matches!(kind, KeyKind::Name | KeyKind::Device) {
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
