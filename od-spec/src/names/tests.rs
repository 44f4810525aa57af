use std::collections::BTreeMap;
use std::path::Path;

use super::walk::{Role, Visitor, walk};
use super::*;
use crate::diag::Diagnostics;
use crate::expr::Expr;
use crate::keys::{AXES, KeyKind, PART, PART_OF, SPEC, Shape};
use crate::source::Spanned;
use crate::{Compiled, Loader, add_source, compile, yaml};

/// Reads what lies beside the shipped specifications.
struct Beside;

impl Loader for Beside {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let path = Path::new(from).parent().unwrap().join(path);
        std::fs::read(path).map_err(|error| error.to_string())
    }
}

struct Read {
    sources: SourceMap,
    root: FileId,
    trees: BTreeMap<FileId, Node>,
    compiled: Compiled,
    names: Names,
}

fn read(name: &str, text: Vec<u8>, with_model: bool) -> Read {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, text).unwrap();
    let compiled = compile(&mut sources, root, &mut Beside);
    let trees: BTreeMap<FileId, Node> = sources
        .files()
        .filter_map(|(id, file)| Some((id, yaml::parse(id, file, &mut Diagnostics::new())?)))
        .collect();
    let system = compiled.system.as_ref().filter(|_| with_model);
    let names = Names::of(&sources, root, |file| trees.get(&file), system);
    Read { sources, root, trees, compiled, names }
}

fn shipped(with_model: bool) -> impl Iterator<Item = Read> {
    let devices = concat!(env!("CARGO_MANIFEST_DIR"), "/devices");
    let profiles = concat!(env!("CARGO_MANIFEST_DIR"), "/profiles");
    let files = [
        (devices, "pitch-control-system"),
        (devices, "fullmo-drive"),
        (profiles, "cia301"),
        (profiles, "cia302"),
        (profiles, "cia401"),
        (profiles, "cia402"),
    ];
    files.into_iter().map(move |(folder, name)| {
        let path = format!("{folder}/{name}.od.yaml");
        let text = std::fs::read(&path).unwrap();
        read(&path, text, with_model)
    })
}

/// The scalars that name something, by the table of keys alone.
struct Naming(Vec<(Span, String, bool)>);

impl<'t> Visitor<'t> for Naming {
    fn scalar(&mut self, text: Spanned<&'t str>, role: Role, path: &[Step<'t>]) {
        let is_condition = matches!(role, Role::Value(Shape::Condition | Shape::Formula));
        let is_axis = matches!(path.last(), Some(Step::Key { keys, .. }) if std::ptr::eq(*keys, &AXES));
        let names = match role {
            Role::Value(
                Shape::NameOf(_)
                | Shape::Type
                | Shape::Entry
                | Shape::Entries
                | Shape::Index
                | Shape::ErrorCode
                | Shape::Feature,
            )
            | Role::Key(KeyKind::Device)
            | Role::FeatureKey => true,
            _ => is_condition,
        };
        if names && !is_axis {
            self.0.push((text.span, text.value.to_owned(), is_condition));
        }
    }
}

#[test]
fn every_scalar_that_names_something_is_one_reference() {
    for with_model in [true, false] {
        for read in shipped(with_model) {
            assert!(read.compiled.system.is_some() || !with_model || read.sources.files().count() == 1);
            let mut naming = Naming(Vec::new());
            for (file, tree) in &read.trees {
                let is_part = file.is_one_with(read.root) && tree.get(PART_OF).is_some();
                walk(tree, if is_part { &PART } else { &SPEC }, &mut naming);
            }
            let mut by_scalar: BTreeMap<Span, Vec<&Reference>> = BTreeMap::new();
            for reference in read.names.references() {
                by_scalar.entry(reference.scalar).or_default().push(reference);
            }
            assert!(naming.0.len() > 50, "{}", naming.0.len());
            for (span, text, is_condition) in naming.0 {
                let place = read.sources.place(span);
                let parts = by_scalar.get(&span).unwrap_or_else(|| panic!("{place}: `{text}` refers to nothing"));
                // The parts of one reference lie one behind the other, and a condition holds several.
                for pair in parts.windows(2) {
                    assert!(pair[0].range.end <= pair[1].range.start, "{place}: {text}");
                }
                if is_condition {
                    let text = text.replace("{n}", "0");
                    let read = Expr::parse(&text).or_else(|_| Expr::parse_term(&text));
                    let entries = read.map_or(1, |read| read.entries().len());
                    let found = parts.iter().filter(|part| part.kind == Kind::Object).count();
                    assert_eq!(found, entries, "{place}: {text}");
                } else {
                    let covered: usize = parts.iter().map(|part| part.range.len()).sum();
                    assert_eq!(covered + parts.len() - 1, text.len(), "{place}: {text}");
                }
                for part in parts {
                    let is_found = !part.targets.is_empty() || part.by == By::Word || !explains(part);
                    assert!(is_found, "{place}: `{}` of `{text}` is {part:?}", &text[part.range.clone()]);
                }
            }
        }
    }
}

/// Whether some text describes what a reference is to by itself: bits by number have no name, and neither have sub-indices of
/// elements and counts that nobody describes, or objects of a standard that only follow from others.
fn explains(part: &Reference) -> bool {
    !(part.by == By::Number && matches!(part.kind, Kind::Bit | Kind::Entry))
}

#[test]
fn every_definition_stands_where_its_name_is() {
    for read in shipped(true) {
        for (_, one) in read.names.definitions() {
            let written = read.sources.text(one.span);
            let plain = written.trim_matches(['"', '\'']).replace("''", "'").replace("\\\"", "\"");
            match one.spelling {
                Spelling::Written => assert_eq!(plain, one.name, "{}", read.sources.place(one.span)),
                Spelling::Pattern => assert!(plain == one.name || one.name == "elements"),
                Spelling::Elsewhere => {}
            }
            let found = read.names.at(one.span.file, one.span.start);
            assert!(found.is_some() || one.kind == Kind::File, "{one:?}");
        }
    }
}
