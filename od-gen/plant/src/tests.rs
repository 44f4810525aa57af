//! What a plant's files say of each other.

use od_spec::Loader;
use od_spec::plant::plant;
use od_spec::source::SourceMap;

use super::*;

const PLANT: &str = "od-plant: 1
title: Lamps
devices: {lamp: lamp.od.yaml}
types: {L: {bit-rate: 125, positions: {top: {lamp: 1}}, parameters: {lamp: {brightness: 50}}}}
sites: {Hall: {type: L, machines: {1..9: {}}}}
";

struct Lamp;

impl Loader for Lamp {
    fn load(&mut self, _path: &str, _from: &str) -> Result<Vec<u8>, String> {
        let text = "od-spec: 1
title: Lamp
uses: [cia301]
devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}}
objects: {0x2000: {name: brightness, type: unsigned8, access: rw, default: 80}}
";
        Ok(text.into())
    }
}

#[test]
fn the_overview_names_the_tables_that_are_written() {
    let mut sources = SourceMap::new();
    let root = sources.add("plant.yaml", PLANT);
    let plant = plant(&mut sources, root, &mut Lamp).plant.unwrap();
    let settled: Vec<Settled> = (0..plant.classes.len()).filter_map(|class| plant.settle(class)).collect();
    let with = |rows: u32| {
        let workbook = workbook::write(&plant, &settled, rows);
        let files = files_with(workbook, &plant, &settled, &[], &[]);
        let overview = String::from_utf8(files[0].pieces.concat()).unwrap();
        let named = overview.lines().find(|line| line.contains("a row for each value")).unwrap().to_owned();
        (named, files.iter().any(|file| file.path == WORKBOOK))
    };
    // Nine rows below the titles: on four sheets of four lines they have room, on four of three they have not.
    let counted = "9 machines at 1 site, 9 nodes of 1 kind.";
    let both = format!("{counted} `values.xlsx` and `values.csv` have a row for each value of each node.");
    let one = format!("{counted} `values.csv` has a row for each value of each node.");
    assert_eq!(with(workbook::MOST_ROWS), (both.clone(), true));
    assert_eq!(with(4), (both, true));
    assert_eq!(with(3), (one, false));
}

/// Texts of a plant command nothing in Markdown.
#[test]
fn the_overview_escapes_texts() {
    let hostile = "*b* `m` [l](x) <img src=x> |";
    let text = PLANT
        .replace("title: Lamps", &format!("title: '{hostile}'\nabout: '# {hostile}'"))
        .replace("{Hall: {type: L,", &format!("{{Hall: {{title: '{hostile}', comment: '{hostile}', type: L,"))
        .replace("1..9: {}", &format!("1..9: {{}}, 1: {{comment: '{hostile}', serial: '{hostile}'}}"));
    let mut sources = SourceMap::new();
    let root = sources.add("plant.yaml", text);
    let compiled = plant(&mut sources, root, &mut Lamp);
    let plant = compiled.plant.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let settled: Vec<Settled> = (0..plant.classes.len()).filter_map(|class| plant.settle(class)).collect();
    let overview = overview::write(&plant, &settled, &["values.csv"]);
    let escaped = "\\*b\\* \\`m\\` \\[l\\](x) \\<img src=x> \\|";
    assert_eq!(overview.matches(escaped).count(), overview.matches("img").count(), "{overview}");
    assert!(overview.matches(escaped).count() >= 5, "{overview}");
    assert!(overview.contains(&format!("\n\\# {escaped}\n")), "{overview}");
}
