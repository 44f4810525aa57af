//! `odgen fmt` changes no fact, and is done after one run.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::{Path, PathBuf};

use od_formats::eds::write_eds;
use od_gen::source::FileLoader;
use od_spec::source::SourceMap;
use od_spec::{compile, layout};

/// Every specification, part and library of the repository that is YAML.
fn specifications() -> Vec<PathBuf> {
    fn collect(directory: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(&path, found);
            } else if path.to_string_lossy().ends_with(".od.yaml") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for directory in ["od-spec", "tests", "od-gen"] {
        collect(&root.join(directory), &mut found);
    }
    found.sort();
    found
}

/// What the outputs hold, of those that compile.
fn outputs(path: &Path, text: &str) -> Option<Vec<Vec<u8>>> {
    let mut sources = SourceMap::new();
    let root = sources.add(path.to_string_lossy(), text);
    let system = compile(&mut sources, root, &mut FileLoader::default()).system?;
    let dump = od_formats::json::dump(&system, &[]);
    let eds = system.devices.iter().map(|device| write_eds(&system, device));
    Some(std::iter::once(dump).chain(eds).collect())
}

#[test]
fn every_specification_keeps_its_facts_and_is_laid_out_at_once() {
    let (mut laid_out, mut compared) = (0, 0);
    for path in specifications() {
        let name = path.display().to_string();
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let Ok(new) = layout(&name, text.clone()) else {
            // What is no YAML has no layout; everything else has one.
            let is_wrong = name.contains("err_") || name.contains("/new/") || name.contains("seeds");
            assert!(is_wrong, "{name}");
            continue;
        };
        laid_out += 1;
        assert_eq!(layout(&name, new.clone()).ok().as_ref(), Some(&new), "{name}");
        let comments = |text: &str| text.matches('#').count();
        assert_eq!(comments(&text), comments(&new), "{name}");
        let before = outputs(&path, &text);
        compared += usize::from(before.is_some());
        assert!(new == text || before == outputs(&path, &new), "{name}");
    }
    assert!(laid_out > 150 && compared > 60, "{laid_out} {compared}");
}

#[test]
fn lines_are_where_they_belong() {
    let text = "\
od-spec:   1


objects:
    0x2000:   {name: level,type:  unsigned8}      # of the tank
    # The second.
    0x2001:
          name:  temperature   # in °C
          about:  >-
             Of the
               tank.

    # Nothing more.
units:
- {a: [1,2],
      b: 3}
-  - text
      that goes on
   # in the list
# at the end
";
    assert_eq!(
        layout("a.od.yaml", text.to_owned()).ok().as_deref(),
        Some(
            "\
od-spec: 1

objects:
  0x2000: {name: level, type: unsigned8}          # of the tank
  # The second.
  0x2001:
    name: temperature          # in °C
    about: >-
      Of the
        tank.

  # Nothing more.
units:
  - {a: [1, 2],
        b: 3}
  - - text
      that goes on
    # in the list
# at the end
"
        )
    );
}

#[test]
fn what_is_not_yaml_is_reported_with_its_place() {
    let (diagnostics, sources) = layout("a.od.yaml", "a: [1\nb: 2\n".to_owned()).unwrap_err();
    let first = diagnostics.iter().next().unwrap();
    assert_eq!(first.code.id, "OD0104");
    assert!(sources.place(first.labels[0].span).starts_with("a.od.yaml:"));
}

#[test]
fn texts_that_are_easily_broken_stay() {
    for (text, laid_out) in [
        // A line of spaces in a block of text, and one after it.
        ("a: |\n  one\n     \n  two\nb: c\n", "a: |\n  one\n     \n  two\nb: c\n"),
        ("a:\n    # x\n  b: c\n", "a:\n  # x\n  b: c\n"),
        ("\u{feff}# c\na:   b\n", "\u{feff}# c\na: b\n"),
        ("\u{feff}a:   b\n", "\u{feff}a: b\n"),
        ("a: {b:   , c: }\n", "a: {b: , c: }\n"),
        ("a: \"x \u{2028} y\"\n", "a: \"x \u{2028} y\"\n"),
    ] {
        assert_eq!(layout("a.od.yaml", text.to_owned()).ok().as_deref(), Some(laid_out), "{text:?}");
        assert_eq!(layout("a.od.yaml", laid_out.to_owned()).ok().as_deref(), Some(laid_out), "{text:?}");
    }
}

/// What the repository ships is laid out as `odgen fmt` does it.
#[test]
fn shipped_specifications_are_laid_out() {
    let is_shipped = |path: &PathBuf| {
        let path = path.to_string_lossy();
        path.contains("od-spec/devices/") || path.contains("od-spec/profiles/")
    };
    let shipped: Vec<PathBuf> = specifications().into_iter().filter(is_shipped).collect();
    assert!(shipped.len() > 8);
    for path in shipped {
        let text = fs::read_to_string(&path).unwrap();
        assert!(layout("shipped", text.clone()).ok() == Some(text), "`odgen fmt {}`", path.display());
    }
}
