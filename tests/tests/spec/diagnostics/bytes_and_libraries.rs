//! What is said about bytes that are not text, and about library files.

use od_spec::source::SourceMap;
use od_spec::{Compiled, Loader, add_source, compile, read_text};

use crate::diagnostics::wording_rules::check_wording;
use crate::diagnostics::{human, human_one};

#[test]
fn bytes_that_are_no_text() {
    let sources = SourceMap::new();
    let refused =
        |name: &str, bytes: &[u8]| human_one(*read_text(name, bytes.to_vec()).unwrap_err(), &sources);
    insta::assert_snapshot!(refused("lamp.od.yaml", b"od-spec: 1\ntitle: L\xe4mpchen\n"), @r#"
        error[OD0102]: `lamp.od.yaml:2:9` holds the byte 0xE4, expected UTF-8 text
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(refused("lamp.od.yaml", "title: Gr\u{f6}\u{df}e 5 \u{b5}".as_bytes().split_last().unwrap().1), @r#"
        error[OD0102]: `lamp.od.yaml:1:16` holds the byte 0xC2, expected UTF-8 text
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(human_one(*read_text("disk.img", vec![b' '; (64 << 20) + (9 << 20)]).unwrap_err(), &sources), @r#"
        error[OD0103]: `disk.img` has 73 MiB; the limit is 64 MiB
        help: is this the right file?
        "#);
}

#[test]
fn files_that_are_no_eds() {
    let sources = SourceMap::new();
    let refused = |name: &str, bytes: &[u8]| {
        human_one(*add_source(&mut SourceMap::new(), name, bytes.to_vec()).unwrap_err(), &sources)
    };
    insta::assert_snapshot!(refused("lamp.eds", b"[2000]\nParameterName=\xCB\xD9\xB6\xC8\n"), @r#"
        error[OD0102]: the texts of `lamp.eds` are in GBK, in which a character has two bytes
        help: save it as UTF-8, for example with `iconv -f gbk -t utf-8`
        "#);
    insta::assert_snapshot!(refused("lamp.eds", b"[File]\nRevision = 1.0;\n[Device]\nMajRev = 1;\n"), @r#"
        error[OD0121]: `lamp.eds` is an EDS of EtherNet/IP or DeviceNet ([File], [Device]), not of CANopen
        help: ask the maker for the EDS of the CANopen interface
        "#);
    insta::assert_snapshot!(refused("lamp.dcf", b"\n"), @r#"
        error[OD0121]: `lamp.dcf` is no EDS or DCF: it has no section
        help: is this the right file?
        "#);
}

#[test]
fn a_byte_order_mark_is_no_text() {
    assert_eq!(read_text("lamp.od.yaml", b"\xef\xbb\xbfod-spec: 1\n".to_vec()).unwrap(), "od-spec: 1\n");
    assert_eq!(read_text("lamp.od.yaml", vec![b' '; 64 << 20]).unwrap().len(), 64 << 20);
}

/// Library files for tests.
struct Files(&'static [(&'static str, &'static [u8])]);

impl Loader for Files {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        assert!(["plant/lamp.od.yaml", "plant/../lamps.od.yaml"].contains(&from), "{from}");
        let file = self.0.iter().find(|(name, _)| *name == path);
        file.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "no such file".to_owned())
    }
}

/// Compiles a specification that finds these files next to it.
pub(crate) fn compiled_with(
    text: &str,
    files: &'static [(&'static str, &'static [u8])],
) -> (SourceMap, Compiled) {
    let mut sources = SourceMap::new();
    let root = sources.add("plant/lamp.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut Files(files));
    for diagnostic in &compiled.diagnostics {
        check_wording(diagnostic, &sources, text);
    }
    assert_eq!(compiled.system.is_some(), !compiled.diagnostics.has_errors());
    (sources, compiled)
}

fn with_libraries(text: &str, files: &'static [(&'static str, &'static [u8])]) -> String {
    let (sources, compiled) = compiled_with(text, files);
    human(&compiled.diagnostics, &sources)
}

pub(crate) const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301, ../lamps.od.yaml]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, dimmer]}
";

#[test]
fn libraries_from_files() {
    let lamps: &[(&str, &[u8])] = &[(
        "../lamps.od.yaml",
        b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nfeatures:\n  dimmer: {objects: [0x2000]}\nobjects:\n  0x2000: {name: brightness, type: unsigned8, access: rw}\n",
    )];
    insta::assert_snapshot!(with_libraries(LAMP, lamps), @"");
    insta::assert_snapshot!(with_libraries(LAMP, &[]), @r#"
        error[OD0113]: cannot read library `../lamps.od.yaml`: no such file
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: name a built-in library (`cia301`, `cia302`, `cia401`, `cia402`), or a file relative to this one
        "#);
    insta::assert_snapshot!(with_libraries(&LAMP.replace("cia301, ../lamps.od.yaml", "cia31"), &[]), @r#"
        error[OD0113]: cannot read library `cia31`: no such file
         --> plant/lamp.od.yaml:3:8
          |
        3 | uses: [cia31]
          |        ^^^^^
          |
        help: did you mean `cia301`?
        "#);
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\ntitle: L\xe4mpchen\n")]), @r#"
        error[OD0102]: `../lamps.od.yaml:2:9` holds the byte 0xE4, expected UTF-8 text
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^ used here
          |
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\ntitle: Lamps\n")]), @r#"
        error[OD0114]: `../lamps.od.yaml` is not a library
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: a library has `profile: NAME` at its top level and no `uses:` of its own
        "#);
    insta::assert_snapshot!(
        with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nuses: [cia301]\n")]),
        @r#"
        error[OD0114]: `../lamps.od.yaml` is not a library
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: a library has `profile: NAME` at its top level and no `uses:` of its own
        "#
    );
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\nprofile: [lamps\n")]), @r#"
        error[OD0104]: this is not YAML: unclosed bracket '['
         --> plant/../lamps.od.yaml:2:10
          |
        2 | profile: [lamps
          |          ^
          |
        help: close it with `]`; inside, put texts that hold a comma or a bracket in quotes
        "#);
    insta::assert_snapshot!(
        with_libraries(
            LAMP,
            &[("../lamps.od.yaml", b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nfeatures:\n  dimmer: {objects: [0x2001]}\n")]
        ),
        @r#"
        error[OD0309]: feature `dimmer` names 2001h, which the library does not define
         --> plant/../lamps.od.yaml:5:22
          |
        5 |   dimmer: {objects: [0x2001]}
          |                      ^^^^^^
          |
        help: define the object in the library, or correct the index
        "#
    );
}
