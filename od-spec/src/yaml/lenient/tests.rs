use super::*;
use crate::diag::Diagnostics;
use crate::library::shipped::LIBRARIES;
use crate::source::SourceMap;
use crate::yaml::parse;

/// What differs first between two trees.
fn difference(strict: &Node, lenient: &Node, sources: &SourceMap) -> Option<String> {
    let place = || sources.place(strict.span);
    let differ = |what: &str| Some(format!("{}: {what}: {strict:?} or {lenient:?}", place()));
    match (&strict.kind, &lenient.kind) {
        (NodeKind::Map(one), NodeKind::Map(other)) => {
            let pairs = one.iter().zip(other);
            let found = pairs.clone().find_map(|((key, node), (other_key, other))| {
                if (&key.value, key.span) != (&other_key.value, other_key.span) {
                    return Some(format!("{}: {key:?} or {other_key:?}", sources.place(key.span)));
                }
                difference(node, other, sources)
            });
            found.or_else(|| if one.len() == other.len() { None } else { differ("keys") })
        }
        (NodeKind::List(one), NodeKind::List(other)) => {
            let found = one.iter().zip(other).find_map(|(one, other)| difference(one, other, sources));
            found.or_else(|| if one.len() == other.len() { None } else { differ("items") })
        }
        (NodeKind::Null, NodeKind::Null) => None,
        (one, other) if one == other && strict.span == lenient.span => None,
        _ => differ("value"),
    }
}

fn same(name: &str, text: &str) {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    let strict = parse(file, sources.file(file), &mut Diagnostics::new()).unwrap_or_else(|| panic!("{name}"));
    let found = difference(&strict, &lenient(file, text), &sources);
    assert!(found.is_none(), "{}", found.unwrap_or_default());
}

#[test]
fn a_text_that_is_right_has_the_tree_of_the_parser() {
    for (name, text) in LIBRARIES {
        same(name, text);
        same(name, &text.replace('\n', "\r\n"));
    }
    let devices = concat!(env!("CARGO_MANIFEST_DIR"), "/devices");
    for file in std::fs::read_dir(devices).unwrap() {
        let path = file.unwrap().path();
        same(&path.display().to_string(), &std::fs::read_to_string(&path).unwrap());
    }
    for (at, text) in [
        "a: {b: c, d: [e, f: 1, \"g, h\"], 'i': }\nj:\n- k\n-   l: 1\n    m: 2\n",
        "a: &x {b: 1}\nc: *x\nd: [*x, *x]\n",
        "a: >-\n  one\n  two\n\n  three\n   four\nb: |\n  x\n   y\n",
        "a: one\n  two\n\n  three # no more\nb: \"x\\u00b0\\n \\\"\n  y\"\nc: 'it''s'\n",
        "---\n# c\na: {\n  b: 1, # d\n  c: two\n    words,\n}\ne: # f\n  g: h#i\n",
        "a: [\n  1,\n  2\n]\nb: {x: \"y\", \"z\": w}\n",
    ]
    .iter()
    .enumerate()
    {
        same(&format!("text {at}"), text);
    }
}

#[test]
fn what_is_not_closed_ends_where_the_lines_around_go_on() {
    let mut sources = SourceMap::new();
    let mut read = |text: &str| {
        let file = sources.add("a", text);
        lenient(file, text)
    };
    let tree =
        read("objects:\n  0x1: {name: a, type\n  0x2: {name: \"b\n  0x3: [c\nunits:\n  u: {symbol: V}\n");
    let keys = |node: &Node| node.entries().iter().map(|(key, _)| key.value.clone()).collect::<Vec<_>>();
    assert_eq!(keys(&tree), ["objects", "units"]);
    let objects = tree.get("objects").unwrap();
    assert_eq!(keys(objects), ["0x1", "0x2", "0x3"]);
    assert_eq!(keys(objects.get("0x1").unwrap()), ["name", "type"]);
    assert_eq!(
        tree.get("units").unwrap().get("u").unwrap().get("symbol").unwrap().text().unwrap().value,
        "V"
    );
    // A word without a colon is a key among keys.
    let tree = read("a:\n  b: 1\n  wor\n  c: 2\nd\n");
    assert_eq!(
        (keys(tree.get("a").unwrap()), keys(&tree)),
        (vec!["b".into(), "wor".into(), "c".into()], vec!["a".into(), "d".into()])
    );
}

#[test]
fn every_beginning_of_a_text_is_read() {
    let text = "a: {b: [c, {d: 'e''f', g: \"h\\\"\"}], *i: &j k}\n- l\n  - >\n   m\n\n  n: |2\n     o\n: }\n]\n\t? p\n!q r # s\n°: ☃\n";
    let mut sources = SourceMap::new();
    for (end, _) in text.char_indices() {
        for start in [0, end / 2] {
            if text.is_char_boundary(start) {
                let part = &text[start..end];
                let file = sources.add("a", part);
                let tree = lenient(file, part);
                assert!(tree.span.end as usize <= part.len());
            }
        }
    }
    let file = sources.add("deep", "[".repeat(100_000));
    let _ = lenient(file, sources.file(file).text());
    let deep: Vec<String> = (0..500).map(|at| format!("{}a:\n", " ".repeat(at))).collect();
    let deep = deep.concat();
    let _ = lenient(file, &deep);
}
