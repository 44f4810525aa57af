//! What is said about documents: the same as `odgen check` says, where it belongs, and no longer than it is true.

use std::fs;
use std::path::Path;

use od_readers::remark;
use od_spec::diag::Severity;
use od_spec::source::SourceMap;
use od_spec::{Loader, add_source, compile};
use serde_json::{Value, json};

use crate::client::Client;
use crate::{LAMP, PITCH, short};

fn codes(diagnostics: &[Value]) -> Vec<&str> {
    diagnostics.iter().map(|one| one["code"].as_str().unwrap()).collect()
}

/// A directory in which there is nothing.
struct Nothing;

impl Loader for Nothing {
    fn load(&mut self, _path: &str, _from: &str) -> Result<Vec<u8>, String> {
        Err("no such file".to_owned())
    }
}

/// What the compiler says about a text, each message with its place counted in another way than the server does.
fn expected(name: &str, text: &str) -> Vec<String> {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, text.as_bytes().to_vec()).unwrap();
    let mut compiled = compile(&mut sources, root, &mut Nothing);
    remark(&sources, root, &mut compiled);
    let position = |at: u32| {
        let at = at as usize;
        let before = &text[..at];
        let line = before.replace("\r\n", "\n").matches(['\n', '\r']).count();
        let in_line = before.rsplit(['\n', '\r']).next().unwrap();
        format!("{line}:{}", in_line.encode_utf16().count())
    };
    let mut lines: Vec<String> = compiled
        .diagnostics
        .iter()
        .filter(|one| one.labels.first().is_none_or(|label| label.span.file == root))
        .map(|one| {
            let place = one.labels.first().map_or("0:0-0:0".to_owned(), |label| {
                format!("{}-{}", position(label.span.start), position(label.span.end))
            });
            let severity = match one.severity {
                Severity::Error => 1,
                Severity::Warning => 2,
                Severity::Note => 4,
            };
            let related = one.labels.len().saturating_sub(1);
            format!("{} {place} {severity} {related} {}", one.code, one.message)
        })
        .collect();
    lines.sort();
    lines
}

fn found(diagnostics: &[Value]) -> Vec<String> {
    let mut lines: Vec<String> = diagnostics
        .iter()
        .map(|one| {
            let related = one["relatedInformation"].as_array().map_or(0, Vec::len);
            let message = one["message"].as_str().unwrap().lines().next().unwrap();
            format!("{} {} {related} {message}", short(one), one["severity"])
        })
        .collect();
    lines.sort();
    lines
}

/// The texts of the compiler's own cases are opened one after the other; each has the messages that it has on the command line.
#[test]
fn documents_have_the_messages_of_the_compiler() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/ui");
    let mut names: Vec<String> = fs::read_dir(&cases)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".od.yaml"))
        .collect();
    names.sort();
    let mut client = Client::new("cases");
    let mut messages = 0;
    for name in names {
        let text = String::from_utf8_lossy(&fs::read(cases.join(&name)).unwrap()).into_owned();
        // What is no specification has another reader here than in the compiler's cases.
        if text.starts_with('\u{feff}') || name.contains("od0120") {
            continue;
        }
        client.open(&name, &text);
        let said = client.diagnostics(&name, 1);
        let mut found = found(&said);
        let mut expected = expected(&name, &text);
        // A label's words are after the message.
        for (found, expected) in found.iter_mut().zip(&mut expected) {
            if let Some(rest) = found.strip_prefix(expected.as_str()) {
                assert!(rest.is_empty() || rest.starts_with(" ("), "{name}: {found}");
                found.truncate(expected.len());
            }
        }
        assert_eq!(found, expected, "{name}");
        messages += found.len();
        client.close(&name);
        client.diagnostics_of_file(&name);
    }
    assert!(messages > 300, "{messages}");
    assert_eq!(client.leave(), 0);
}

#[test]
fn lines_may_end_in_two_characters_and_hold_wide_ones() {
    let mut client = Client::new("crlf");
    let text = LAMP.replace("max: 100", "max: °").replace('\n', "\r\n");
    client.open("lamp.od.yaml", &text);
    let said = client.diagnostics("lamp.od.yaml", 1);
    assert_eq!(found(&said).len(), expected("lamp.od.yaml", &text).len());
    assert_eq!(short(&said[0]), "OD0401 8:90-8:91");
    assert_eq!(client.leave(), 0);
    // The same with bytes.
    let (mut client, answer) =
        Client::with("bytes", &json!({"general": {"positionEncodings": ["utf-16", "utf-8"]}}));
    assert_eq!(answer["capabilities"]["positionEncoding"], "utf-8");
    client.open("lamp.od.yaml", &text.replace("{name: br", "{name: 🌀br"));
    let said = client.diagnostics("lamp.od.yaml", 1);
    // The first is about the name.
    assert_eq!(short(&said[1]), "OD0401 8:94-8:96");
    assert_eq!(client.leave(), 0);
}

#[test]
fn what_is_put_right_is_said_no_longer() {
    let mut client = Client::new("cleared");
    client.open("lamp.od.yaml", &LAMP.replace("unit: celsius", "unit: celsus"));
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 1)), ["OD0608"]);
    client.replace("lamp.od.yaml", 2, LAMP);
    assert_eq!(client.diagnostics("lamp.od.yaml", 2), [Value::Null; 0]);
    client.replace("lamp.od.yaml", 3, "");
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 3)), ["OD0110"]);
    // Of what is closed nothing is said.
    client.close("lamp.od.yaml");
    assert_eq!(client.diagnostics_of_file("lamp.od.yaml"), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn a_part_has_its_own_messages_whoever_is_open() {
    let mut client = Client::new("parts");
    let whole = LAMP.replace("uses: [cia301]\n", "uses: [cia301]\nparts: [units.od.yaml]\n");
    let (units, rest) =
        ("units:\n  celsius: {symbol: °C, about: \"🌀\"}\n", "od-spec: 1\npart-of: lamp.od.yaml\n");
    let whole = whole.replace(units, "");
    let part = format!("{rest}{units}");
    client.directory.write("lamp.od.yaml", &whole);
    client.directory.write("units.od.yaml", &part.replace("symbol", "symbl"));
    client.open("lamp.od.yaml", &whole);
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 1)), [""; 0]);
    let said = client.diagnostics_of_file("units.od.yaml");
    assert_eq!(short(&said[0]), "OD0201 3:12-3:17", "{said:?}");
    // The editor shows another text of the part than the file holds.
    client.open("units.od.yaml", &part);
    assert_eq!(client.diagnostics("units.od.yaml", 1), [Value::Null; 0]);
    client.replace("units.od.yaml", 2, &part.replace("celsius", "kelvin"));
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 1)), ["OD0608"]);
    assert_eq!(codes(&client.diagnostics("units.od.yaml", 2)), [""; 0]);
    // A part represents its specification, also where only the part is open.
    client.close("lamp.od.yaml");
    client.replace("units.od.yaml", 3, &part);
    assert_eq!(client.diagnostics("units.od.yaml", 3), [Value::Null; 0]);
    // What it says it is a part of does not name it.
    client.directory.write("lamp.od.yaml", LAMP);
    let changed = json!({"changes": [{"uri": client.uri("lamp.od.yaml"), "type": 2}]});
    client.notify("workspace/didChangeWatchedFiles", &changed);
    client.replace("units.od.yaml", 4, &part);
    assert_eq!(codes(&client.diagnostics("units.od.yaml", 4)), [""; 0]);
    assert!(
        client.request_about("textDocument/documentSymbol", "units.od.yaml").to_string().contains("celsius")
    );
    // There is no such file.
    client.replace("units.od.yaml", 5, &part.replace("lamp", "tank"));
    assert_eq!(codes(&client.diagnostics("units.od.yaml", 5)), ["OD0119"]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn a_library_of_the_user_has_the_messages_of_each_that_uses_it() {
    let mut client = Client::new("library");
    let library = "od-spec: 1\ntitle: House\nprofile: house\nunits:\n  celsius: {symbol: °C}\nobjects:\n  0x2101: {name: place, type: unsigned8, access: rw}\n";
    let lamp = LAMP.replace("uses: [cia301]", "uses: [cia301, house.od.yaml]");
    let lamp = lamp.replace("units:\n  celsius: {symbol: °C, about: \"🌀\"}\n", "");
    client.open("lamp.od.yaml", &lamp);
    let missing = client.diagnostics("lamp.od.yaml", 1);
    assert_eq!(codes(&missing), ["OD0113"], "{missing:?}");
    // It comes into being as an unsaved text, and as a file.
    client.open("house.od.yaml", library);
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 1)), [""; 0]);
    client.replace("house.od.yaml", 2, &library.replace("unsigned8", "unsigned9"));
    let said = client.diagnostics("house.od.yaml", 2);
    assert_eq!(codes(&said), ["OD0609"], "the library says it once, by itself and for the lamp: {said:?}");
    client.directory.write("house.od.yaml", &library.replace("°C", "K"));
    client.close("house.od.yaml");
    assert_eq!(client.diagnostics_of_file("house.od.yaml"), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn messages_lead_to_built_in_libraries_and_to_their_explanation() {
    let mut client = Client::new("copies");
    let text = LAMP.replace("objects:\n", "objects:\n  0x1017: {from: cia301, type: unsigned32}\n");
    client.open("lamp.od.yaml", &text);
    let said = client.diagnostics("lamp.od.yaml", 1);
    let href = said[0]["codeDescription"]["href"].as_str().unwrap();
    let explained = fs::read_to_string(href.strip_prefix("file://").unwrap()).unwrap();
    assert!(explained.starts_with(&format!("# {} (", said[0]["code"].as_str().unwrap())), "{explained}");
    let related: Vec<&Value> =
        said.iter().flat_map(|one| one["relatedInformation"].as_array().into_iter().flatten()).collect();
    for one in &related {
        let uri = one["location"]["uri"].as_str().unwrap();
        assert!(Path::new(uri.strip_prefix("file://").unwrap()).is_file(), "{uri}");
    }
    assert_eq!(client.leave(), 0);
}

#[test]
fn an_eds_is_checked_while_it_is_open() {
    let mut client = Client::new("eds");
    let eds = include_str!("../../../../generated/eds/pmc.eds");
    client.open("pmc.eds", eds);
    let said = client.diagnostics("pmc.eds", 1);
    assert_eq!(found(&said), expected("pmc.eds", eds));
    let broken = eds.replacen("ParameterName=Device type", "ParameterName=Device type\r\nParameterNam=x", 1);
    let broken = broken.replacen("AccessType=ro", "AccessType=RO ", 1);
    client.replace("pmc.eds", 2, &broken);
    let said = client.diagnostics("pmc.eds", 2);
    assert_eq!(found(&said), expected("pmc.eds", &broken));
    assert!(said.len() > 1, "{said:?}");
    assert_eq!(client.leave(), 0);
}

#[test]
fn plants_and_parameter_files_are_checked_as_far_as_they_stand_alone() {
    let mut client = Client::new("plant");
    client.directory.write("lamp.od.yaml", LAMP);
    let plant = "od-plant: 1\ntitle: House\ndevices: {lamp: lamp.od.yaml}\ntypes:\n  hall:\n    bit-rate: 125\n    positions: {A: {lamp: 5}}\n    parameters: {lamp: {brightness: 120}}\nsites:\n  north: {type: hall, machines: {1: {}}}\n";
    client.open("house.yaml", plant);
    let said = client.diagnostics("house.yaml", 1);
    assert_eq!(short(&said[0]), "OD0406 7:36-7:39", "{said:?}");
    client.replace("house.yaml", 2, &plant.replace("120", "20"));
    assert_eq!(codes(&client.diagnostics("house.yaml", 2)), [""; 0]);
    client.open("hall.yaml", "od-parameters: 1\nparameter: {brightness: 60}\n");
    assert!(codes(&client.diagnostics("hall.yaml", 1)).contains(&"OD0201"));
    // Other YAML is not looked at.
    client.open("docker-compose.yaml", "services: {lamp: }\n");
    assert_eq!(codes(&client.diagnostics("docker-compose.yaml", 1)), [""; 0]);
    assert_eq!(client.leave(), 0);
}

/// A hundred thousand entries would take seconds after each key.
#[test]
fn a_document_that_is_too_large_is_not_checked_and_that_is_said() {
    let mut client = Client::new("large");
    let comment = "# A line that makes the document large, and nothing else.\n";
    client.open("lamp.od.yaml", &(LAMP.to_owned() + &comment.repeat((4 << 20) / comment.len())));
    let said = client.diagnostics("lamp.od.yaml", 1);
    let [one] = said.as_slice() else { panic!("{said:?}") };
    let message = one["message"].as_str().unwrap();
    assert!(message.contains("it has 5 MiB, expected at most 4 MiB\nhelp: "), "{message}");
    // What becomes small enough is checked.
    client.replace("lamp.od.yaml", 2, &LAMP.replace("unit: celsius", "unit: celsus"));
    assert_eq!(codes(&client.diagnostics("lamp.od.yaml", 2)), ["OD0608"]);
    assert_eq!(client.leave(), 0);
}

/// A text that was never saved has a URI that is no file's.
#[test]
fn a_text_without_a_file_is_checked() {
    let mut client = Client::new("untitled");
    let document = json!({"uri": "untitled:Untitled-1", "languageId": "yaml", "version": 3, "text": PITCH});
    client.notify("textDocument/didOpen", &json!({"textDocument": document}));
    let said = client.wait(|message| message["params"]["uri"] == "untitled:Untitled-1");
    let said = said["params"]["diagnostics"].as_array().unwrap().clone();
    assert_eq!(codes(&said), ["OD0117", "OD0117"], "{said:?}");
    assert!(said[0]["message"].as_str().unwrap().contains("save it first"), "{said:?}");
    assert_eq!(client.leave(), 0);
}
