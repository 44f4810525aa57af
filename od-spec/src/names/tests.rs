use std::collections::BTreeMap;
use std::path::Path;

use super::walk::{Role, Visitor, walk};
use super::*;
use crate::diag::Diagnostics;
use crate::expr::Expr;
use crate::keys::{AXES, KeyKind, PART, PART_OF, SPEC, Shape};
use crate::source::Spanned;
use crate::{Compiled, Loader, add_source, compile, yaml};

/// Reads what is next to the shipped specifications.
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
        let is_axis = matches!(path.last(), Some(Step::Key { keys, .. }) if keys.name == AXES.name);
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
                let parts =
                    by_scalar.get(&span).unwrap_or_else(|| panic!("{place}: `{text}` refers to nothing"));
                // The parts of one reference follow one another, and a condition holds several.
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
/// elements and counts that have no description, or objects of a standard that only follow from others.
fn explains(part: &Reference) -> bool {
    !(part.by == By::Number && matches!(part.kind, Kind::Bit | Kind::Entry))
}

#[test]
fn every_definition_is_where_its_name_is() {
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

/// A specification whose parts lie in memory.
fn small(text: &str) -> Read {
    read("small.od.yaml", text.as_bytes().to_vec(), true)
}

const SMALL: &str = r#"od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
  dimmer: {name: Dimmer, bit-rates: [125]}
units:
  "tenth °C": {symbol: °C, scale: 1/10}
types:
  mode: {base: unsigned8, values: {0: off, 1: {name: on}}}
  flags:
    base: unsigned8
    bits: {0: ready, 1..2: {name: level, values: {0: low, 3: high}}, 3..7: reserved}
objects:
  0x2000: {name: mode of light, devices: lamp, type: mode, access: rw, default: off, pdo: receive}
  0x2001:
    name: heat
    array: {count: 2, name: "sensor {n}", type: unsigned8, unit: tenth °C, access: ro, pdo: transmit}
  0x2002: {name: state, type: flags, access: rw, default: [ready, {level: high}], writable-when: 'mode of light == on', devices: [lamp]}
  0x2003..0x2004: {name: "spare {n}", type: unsigned8, access: rw, default: 0}
  0x2005:
    name: block
    record:
      1: {name: first, type: unsigned8, access: rw, default: 0}
      2: {name: second one, type: unsigned8, access: rw, default: 1}
constraints:
  in order: {require: "block.first <= block.second one and bit(lamp:state, ready) == 1 and spare 2 < 5", devices: lamp}
  by number: {require: 'lamp:0x2005.1 < 0x2001.2'}
pdos:
  lamp:
    receive: {1: {map: [mode of light]}}
    transmit: {1: {map: [heat.sensor 1, 0x2001.2]}}
"#;

/// What the reference at a text is, in words.
fn referred(read: &Read, before: &str, at: &str) -> String {
    let text = read.sources.file(read.root).text();
    let offset = text.find(before).unwrap() + before.find(at).unwrap();
    match read.names.at(read.root, u32::try_from(offset).unwrap()) {
        Some(Found::Reference(one)) => {
            let targets = one.targets.iter().map(|id| {
                let one = read.names.definition(*id);
                format!("{} {} at {}", one.kind.word(), one.name, read.sources.text(one.span))
            });
            let targets = targets.collect::<Vec<_>>().join(", ");
            format!("{:?} {} -> {targets}", one.by, read.sources.text(one.span))
        }
        Some(Found::Definition(_, one)) => format!("{} {}", one.kind.word(), one.name),
        None => "nothing".to_owned(),
    }
}

#[test]
fn names_of_entries_types_and_values_lead_to_where_they_are_described() {
    let read = small(SMALL);
    assert!(
        read.compiled.system.is_some(),
        "{:?}",
        read.compiled.diagnostics.iter().map(|d| &d.message).collect::<Vec<_>>()
    );
    let referred = |before: &str, at: &str| referred(&read, before, at);
    for (before, at, expected) in [
        ("type: mode,", "mode", "Name mode -> type mode at mode"),
        ("unit: tenth °C", "tenth", "Name tenth °C -> unit tenth °C at \"tenth °C\""),
        ("default: off", "off", "Name off -> value off at off"),
        ("[ready, {", "ready", "Name ready -> bit ready at ready"),
        ("{level: high}", "level", "Name level -> bit level at level"),
        ("{level: high}", "high", "Name high -> value high at high"),
        ("'mode of light == on'", "mode of", "Name mode of light -> object mode of light at mode of light"),
        ("'mode of light == on'", "on'", "Name on -> value on at on"),
        ("\"block.first", "block", "Name block -> object block at block"),
        ("\"block.first", "first", "Name first -> entry first at first"),
        ("block.second one", "second", "Name second one -> entry second one at second one"),
        ("bit(lamp:state, ready)", "lamp", "Name lamp -> device lamp at lamp"),
        ("bit(lamp:state, ready)", "state", "Name state -> object state at state"),
        ("bit(lamp:state, ready)", "ready", "Name ready -> bit ready at ready"),
        ("spare 2 < 5", "spare", "Name spare 2 -> object spare {n} at \"spare {n}\""),
        ("'lamp:0x2005.1 <", "lamp", "Name lamp -> device lamp at lamp"),
        ("'lamp:0x2005.1 <", "0x2005", "Number 0x2005 -> object block at block"),
        ("'lamp:0x2005.1 <", "1 <", "Number 1 -> entry first at first"),
        ("[mode of light]", "mode", "Name mode of light -> object mode of light at mode of light"),
        ("[heat.sensor 1,", "heat", "Name heat -> object heat at heat"),
        ("[heat.sensor 1,", "sensor", "Name sensor 1 -> entry sensor {n} at \"sensor {n}\""),
        (", 0x2001.2]", "0x2001", "Number 0x2001 -> object heat at heat"),
        ("devices: [lamp]", "lamp", "Name lamp -> device lamp at lamp"),
        (
            "[heartbeat producer]",
            "heartbeat",
            "Name heartbeat producer -> feature heartbeat producer at heartbeat producer",
        ),
        ("[cia301]", "cia301", "Word cia301 -> file cia301 at "),
        ("0x2005:\n", "0x2005", "object block"),
        ("name: heat", "heat", "object heat"),
    ] {
        assert_eq!(referred(before, at), expected, "{before}");
    }
}

#[test]
fn a_text_that_is_broken_in_the_middle_has_names_before_and_after() {
    let broken = SMALL.replace("type: flags, access: rw,", "type: flags, access: {rw,");
    let mut sources = SourceMap::new();
    let root = sources.add("small.od.yaml", broken.as_str());
    assert!(yaml::parse(root, sources.file(root), &mut Diagnostics::new()).is_none());
    let tree = yaml::lenient(root, &broken);
    let names = Names::of(&sources, root, |_| Some(&tree), None);
    let at = |text: &str| {
        let offset = u32::try_from(broken.find(text).unwrap() + 1).unwrap();
        names.at(root, offset).map(|found| match found {
            Found::Reference(one) => names.definition(one.targets[0]).name.clone(),
            Found::Definition(_, one) => one.name.clone(),
        })
    };
    assert_eq!(at("[heat.sensor").unwrap(), "heat");
    assert_eq!(at(" mode, access").unwrap(), "mode");
    assert_eq!(at("block.second").unwrap(), "block");
}

#[test]
fn what_nothing_has_the_name_of_is_what_compiling_reports() {
    let right = SMALL.to_owned();
    for (from, to) in [
        ("type: mode,", "type: made,"),
        ("[mode of light]", "[mode of lamp]"),
        ("unit: tenth °C", "unit: tenths"),
        ("devices: [lamp]", "devices: [lump]"),
        ("\"block.first <=", "\"block.fist <="),
        ("[heartbeat producer]", "[heartbeat]"),
        ("bit(lamp:state, ready)", "bit(lamp:state, reedy)"),
        ("[heat.sensor 1,", "[heat.senser 1,"),
    ] {
        let read = small(&right.replace(from, to));
        let unknown = |one: &&Reference| one.targets.is_empty() && one.by != By::Word;
        let mine = read.names.references().iter().filter(|one| one.span.file == read.root).filter(unknown);
        let places: Vec<Span> = mine.map(|one| one.scalar).collect();
        let reported = read.compiled.diagnostics.iter().filter_map(|one| Some(one.labels.first()?.span));
        let is_in = |place: &Span, span: &Span| place.start <= span.start && span.end <= place.end;
        let both: Vec<Span> = reported.filter(|span| places.iter().any(|place| is_in(place, span))).collect();
        let start = u32::try_from(read.sources.file(read.root).text().find(to).unwrap()).unwrap();
        let end = start + u32::try_from(to.len()).unwrap();
        assert!(both.iter().any(|span| start <= span.start && span.end <= end), "{to}: {both:?}");
    }
}

#[test]
fn a_place_has_the_keys_that_lead_to_it() {
    let mut sources = SourceMap::new();
    let file = sources.add("small.od.yaml", SMALL);
    let tree = yaml::lenient(file, SMALL);
    let spot = |before: &str, at: &str| {
        let offset = SMALL.find(before).unwrap() + before.find(at).unwrap();
        let place = Place::of(&tree, u32::try_from(offset).unwrap())?;
        Some(match place.spot {
            Spot::Key { keys, name, .. } => format!("key {} of {}", name.value, keys.name),
            Spot::Data { kind, name, .. } => format!("{kind:?} {}", name.value),
            Spot::Value { shape, .. } => format!("{shape:?}"),
        })
    };
    assert_eq!(spot("access: rw", "ac").unwrap(), "key access of an object");
    assert_eq!(spot("unit: tenth", "tenth").unwrap(), "NameOf(Unit)");
    assert_eq!(spot("count: 2", "count").unwrap(), "key count of an array");
    assert_eq!(spot("0x2005:", "0x").unwrap(), "Indices 0x2005");
    assert_eq!(spot("{map: [mode", "mode").unwrap(), "Entries");
    assert!(spot("    name: block", " ").is_none());
}
