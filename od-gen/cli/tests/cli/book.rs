//! What the book shows of the command is what the command prints.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use od_bus::monitor::{Monitor, Shows};
use od_bus::trace::{Decoder, Node, What};
use od_spec::source::SourceMap;

use crate::{FAN, Scratch, odgen, stderr, stdout};

/// The folder of the book.
fn book() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/book")
}

fn page(name: &str) -> String {
    fs::read_to_string(book().join(name)).unwrap()
}

/// What a page has between its marks `<!-- mark -->` and `<!-- /mark -->`, as a block of a language.
#[track_caller]
fn block(name: &str, mark: &str, language: &str) -> String {
    let page = page(name);
    let (_, rest) = page.split_once(&format!("<!-- {mark} -->\n```{language}\n")).expect(mark);
    rest.split_once(&format!("```\n<!-- /{mark} -->")).expect(mark).0.to_owned()
}

/// Demands that a page shows these lines between its marks. As snapshots are, they are written there with `INSTA_UPDATE=always`.
#[track_caller]
pub(crate) fn shows<'t>(name: &str, mark: &str, lines: impl IntoIterator<Item = &'t str>) {
    /// Pages are written one after the other.
    static PAGES: Mutex<()> = Mutex::new(());
    let language = if mark == "specification" { "yaml" } else { "text" };
    let _pages = PAGES.lock();
    let (shown, screen) = (block(name, mark, language), lines.into_iter().collect::<Vec<_>>().join("\n"));
    let screen = format!("{}\n", screen.trim_end());
    if shown != screen && std::env::var("INSTA_UPDATE").is_ok_and(|how| how == "always") {
        let page = page(name).replacen(
            &format!("<!-- {mark} -->\n```{language}\n{shown}"),
            &format!("<!-- {mark} -->\n```{language}\n{screen}"),
            1,
        );
        fs::write(book().join(name), page).unwrap();
        return;
    }
    assert_eq!(shown, screen, "{mark}");
}

#[test]
fn the_screens_of_a_check_are_what_it_says() {
    let scratch = Scratch::new("book");
    scratch.file("fan.eds", FAN);
    for (mark, arguments) in [("check", "check fan.eds"), ("for", "check fan.eds --for python-canopen")] {
        let said = stderr(&odgen(&scratch.0, &arguments.split(' ').collect::<Vec<_>>()));
        let command = format!("$ odgen {arguments}");
        shows("guides/plc.md", mark, [command.as_str()].into_iter().chain(said.lines()));
    }
}

#[test]
fn the_way_from_an_eds_to_a_specification_is_as_shown() {
    let scratch = Scratch::new("book-ways");
    scratch.file("fan.eds", FAN);
    let fixed = odgen(&scratch.0, &["fix", "fan.eds"]);
    let (said, diff) = (stderr(&fixed), stdout(&fixed));
    let (_, counts) = said.split_once("note: fan.eds").unwrap();
    let counts = format!("note: fan.eds{counts}");
    shows(
        "guides/plc.md",
        "fix",
        ["$ odgen fix fan.eds"].into_iter().chain(diff.lines()).chain([""]).chain(counts.lines()),
    );
    odgen(&scratch.0, &["fix", "fan.eds", "--write"]);
    let imported = stdout(&odgen(&scratch.0, &["import", "fan.eds"]));
    shows("guides/plc.md", "import", ["$ odgen import fan.eds"].into_iter().chain(imported.lines()));
    let specification = fs::read_to_string(scratch.0.join("fan.od.yaml")).unwrap();
    let (_, objects) = specification.split_once("\nobjects:\n").unwrap();
    shows("guides/plc.md", "specification", ["objects:"].into_iter().chain(objects.lines()));
}

#[test]
fn a_table_is_imported_as_shown() {
    let scratch = Scratch::new("book-table");
    scratch.file("pump.csv", block("guides/tables.md", "table", "text"));
    let imported = odgen(&scratch.0, &["import", "pump.csv"]);
    let (said, done) = (stderr(&imported), stdout(&imported));
    let lines = ["$ odgen import pump.csv"].into_iter().chain(said.lines()).chain(done.lines());
    shows("guides/tables.md", "import", lines);
    let specification = fs::read_to_string(scratch.0.join("pump.od.yaml")).unwrap();
    let (_, units) = specification.split_once("\nunits:\n").unwrap();
    shows("guides/tables.md", "specification", ["units:"].into_iter().chain(units.lines()));
    let exported = odgen(&scratch.0, &["export", "pump.od.yaml", "--xlsx", "pump.xlsx", "--csv", "new.csv"]);
    assert!(!stderr(&exported).contains("not in the tables"), "{}", stderr(&exported));
    let again = odgen(&scratch.0, &["import", "pump.xlsx", "--out", "again"]);
    assert_eq!(stderr(&again), "");
    let same = odgen(&scratch.0, &["diff", "pump.od.yaml", "again/pump.od.yaml", "--exit-code", "documents"]);
    assert_eq!(same.status.code(), Some(0), "{}", stdout(&same));
}

#[test]
fn a_setting_is_checked_as_shown() {
    let scratch = Scratch::new("book-setting");
    scratch.file("valve.od.yaml", include_str!("../../../../tests/book/valve.od.yaml"));
    let output =
        odgen(&scratch.0, &["dcf", "valve.od.yaml", "--node", "5", "--set", "set pressure=17.0 bar"]);
    let command = "$ odgen dcf valve.od.yaml --node 5 --set \"set pressure=17.0 bar\"";
    let said = stderr(&output);
    shows("guides/specification.md", "setting", [command].into_iter().chain(said.lines()));
}

#[test]
fn the_trace_is_reported_as_shown() {
    let scratch = Scratch::new("book-decode");
    scratch.file("valve.od.yaml", include_str!("../../../../tests/book/valve.od.yaml"));
    let lines = "\
(12.500) can0 705#00
(12.620) can0 605#2B002000A5000000
(12.621) can0 585#8000200031000906
(12.740) can0 205#3C00
";
    scratch.file("bus.log", lines);
    let arguments = "decode valve.od.yaml --node 5 --trace bus.log";
    let reported = stdout(&odgen(&scratch.0, &arguments.split(' ').collect::<Vec<_>>()));
    shows(
        "guides/virtual-nodes.md",
        "decode",
        [format!("$ odgen {arguments}").as_str()].into_iter().chain(reported.lines()),
    );
}

#[test]
fn the_bus_is_watched_as_shown() {
    let mut sources = SourceMap::new();
    let root = sources.add("valve.od.yaml", include_str!("../../../../tests/book/valve.od.yaml"));
    let system = od_spec::compile(&mut sources, root, &mut od_spec::NoFiles).system.unwrap();
    let decoder = Decoder::new(vec![Node::new(5, &system, &system.devices[0])]);
    let mut monitor = Monitor::new(decoder, Shows::default(), 0);
    let mut reported = vec!["$ odgen node monitor valve.od.yaml --node 5 --ask".to_owned()];
    for (at, line) in
        [(412, "t70517F"), (1412, "t70517F"), (2020, "t00020105"), (2412, "t705105"), (2600, "t20523C00")]
    {
        let (frame, _) = od_bus::slcan::frame(line).unwrap();
        reported.extend(monitor.take(&What::Frame(frame), at * 1000));
    }
    reported.extend(monitor.poll(monitor.next_deadline().unwrap()));
    shows("guides/operator.md", "monitor", reported.iter().map(String::as_str));
}

#[test]
fn the_parameter_file_is_one_of_the_valve() {
    let scratch = Scratch::new("book-parameters");
    scratch.file("valve.od.yaml", include_str!("../../../../tests/book/valve.od.yaml"));
    scratch.file("valve-5.yaml", block("guides/plant.md", "parameters", "yaml"));
    let dcf = odgen(&scratch.0, &["dcf", "valve.od.yaml", "--params", "valve-5.yaml", "--out", "saved.dcf"]);
    assert_eq!(stderr(&dcf), "");
    let text = fs::read_to_string(scratch.0.join("saved.dcf")).unwrap();
    assert!(text.contains("ParameterValue=60\r\n") && text.contains("Baudrate=500\r\n"));
    let explained = odgen(&scratch.0, &["dcf", "valve.od.yaml", "--params", "valve-5.yaml", "--explain"]);
    assert!(
        stdout(&explained).contains("*  2000h     set pressure = 6.0 bar  (set; the default is 2.5 bar)")
    );
    let back = odgen(&scratch.0, &["params", "saved.dcf", "--spec", "valve.od.yaml"]);
    assert!(stdout(&back).ends_with("\n  set pressure: 6.0 bar\n"), "{}", stdout(&back));
    let schema = odgen(&scratch.0, &["schema", "--params", "valve.od.yaml"]);
    assert!(stdout(&schema).contains("\"title\": \"Parameters of Valve (valve)\""));
}

/// From an empty folder: the specification, the plant file, and the commands as they are there.
#[test]
fn the_plant_is_built_by_the_commands_that_are_shown() {
    let scratch = Scratch::new("book-plant");
    scratch.file("valve.od.yaml", include_str!("../../../../tests/book/valve.od.yaml"));
    scratch.file("plant.yaml", block("guides/plant.md", "plant", "yaml"));
    let commands = block("guides/plant.md", "plant-commands", "sh");
    let mut said = Vec::new();
    for line in
        commands.lines().map(|line| line.split('#').next().unwrap().trim()).filter(|line| !line.is_empty())
    {
        // Where its output goes is a matter of the shell.
        let line = line.split(" > ").next().unwrap();
        let arguments: Vec<&str> = line.strip_prefix("odgen ").unwrap().split(' ').collect();
        let output = odgen(&scratch.0, &arguments);
        assert_eq!((crate::code(&output), stderr(&output).as_str()), (0, ""), "{line}");
        said.push(stdout(&output));
    }
    assert_eq!(said.len(), 4);
    assert!(said[1].contains("200 machines at 1 site, 400 nodes"), "{}", said[1]);
    assert!(
        said[2].contains("set pressure = 5.8 bar\n      machine Nordfeld 17, position right, plant.yaml:"),
        "{}",
        said[2]
    );
    let dcf = fs::read_to_string(scratch.0.join("plant/Nordfeld/17/right-valve.dcf")).unwrap();
    assert!(dcf.contains("ParameterValue=58\r\n") && dcf.contains("LSS_SerialNumber=0x00001267\r\n"));
    for name in [
        "plant/overview.md",
        "plant/values.csv",
        "plant/Nordfeld/17/nodelist.cpj",
        "plant/Nordfeld/1/left-valve.bin",
    ] {
        assert!(scratch.0.join(name).is_file(), "{name}");
    }
}
