//! What is generated and checked in is current, and the same on every run.

use std::fs;
use std::path::Path;

use od_formats::{Selection, artifacts};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use od_tests::{compile_clean, generate, shipped};

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const EVERYTHING: &str = "tests/readers/everything.od.yaml";

/// What the shipped specifications become is compared where the command that makes it is tested, with `odgen`.
#[test]
fn checked_in_texts_are_current() {
    if let Some(difference) = generate::first_difference(generate::texts().unwrap()) {
        panic!("{difference}");
    }
    assert_eq!(generate::left_pages(&od_tests::root()).unwrap(), [""; 0]);
}

#[test]
fn a_page_of_a_code_that_is_gone_is_found() {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("left-pages");
    for folder in ["language", "messages"] {
        fs::create_dir_all(root.join("docs/book").join(folder)).unwrap();
    }
    for page in ["language/index.md", "messages/OD0101.md", "messages/OD0100.md"] {
        fs::write(root.join("docs/book").join(page), "").unwrap();
    }
    assert_eq!(generate::left_pages(&root).unwrap(), ["docs/book/messages/OD0100.md"]);
}

/// Everything a specification becomes, in one string of bytes.
fn everything(name: &str, text: &str) -> Vec<u8> {
    let mut sources = SourceMap::new();
    let id = sources.add(name, text);
    let system = compile(&mut sources, id, &mut NoFiles).system.expect("no errors");
    let set = artifacts(&system, "x", &Selection { node: Some(5), ..Selection::default() });
    set.into_iter().flat_map(|artifact| artifact.bytes).collect()
}

#[test]
fn output_does_not_depend_on_run_file_name_line_ends_or_order_of_objects() {
    let text = &*shipped::PITCH;
    let first = everything("a.od.yaml", text);
    assert_eq!(first, everything("/somewhere/else.yaml", text));
    assert_eq!(first, everything("crlf", &text.replace('\n', "\r\n")));

    // The blocks of `objects:` in reverse order.
    let (head, rest) = text.split_once("\nobjects:\n").unwrap();
    let end = rest.find("\npdos:\n").unwrap();
    let (objects, tail) = rest.split_at(end);
    let mut blocks: Vec<String> = Vec::new();
    for line in objects.lines() {
        if line.starts_with("  0x") || blocks.is_empty() {
            blocks.push(String::new());
        }
        let block = blocks.last_mut().unwrap();
        block.push_str(line);
        block.push('\n');
    }
    blocks.reverse();
    let reversed = format!("{head}\nobjects:\n{}{tail}", blocks.concat());
    assert_ne!(*text, reversed);
    assert_eq!(first, everything("reversed", &reversed));
}

/// `ini` is an EDS reader that we did not write: it must find every section and key, and nothing else.
#[test]
fn an_independent_ini_reader_sees_every_section_and_value() {
    let system = compile_clean(PITCH).unwrap();
    for device in &system.devices {
        let text = String::from_utf8(od_formats::eds::write_eds(&system, device)).unwrap();
        let options =
            ini::ParseOption { enabled_quote: false, enabled_escape: false, ..ini::ParseOption::default() };
        let read = ini::Ini::load_from_str_opt(&text, options).unwrap();
        let sections = text.lines().filter(|line| line.starts_with('[')).count();
        assert_eq!(read.sections().flatten().count(), sections);
        let keys = text.lines().filter(|line| !line.starts_with(';') && line.contains('=')).count();
        assert_eq!(read.iter().map(|(_, properties)| properties.len()).sum::<usize>(), keys);
        for object in device.objects.values() {
            let name = format!("{:X}", object.index.0);
            assert_eq!(
                read.get_from(Some(&*name), "ParameterName"),
                Some(&*od_spec::ascii::transliterate(&object.name))
            );
        }
    }
}

#[test]
fn an_eds_is_plain_ascii_with_crlf_and_short_lines() {
    for system in [compile_clean(PITCH).unwrap(), compile_clean(EVERYTHING).unwrap()] {
        for device in &system.devices {
            let text = String::from_utf8(od_formats::eds::write_eds(&system, device)).unwrap();
            assert!(text.is_ascii());
            assert!(text.ends_with("\r\n") && !text.contains("\r\n\r\n\r\n"));
            assert!(text.replace("\r\n", "").bytes().all(|byte| byte >= b' '));
            assert!(text.lines().all(|line| line.len() <= 255));
        }
    }
}
