//! Dictionaries that are made at run time answer as the generated ones do: the same tables, the same outcome of every access, the
//! same verdict of every condition.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and counts")]

use firmware_glue::{Constrained, Dictionary};
use od_bus::runtime::{self, LiveDictionary};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};
use od_spec::diag::Diagnostics;
use od_tests::fuzz::Random;
use od_tests::{access_cases, compile_clean, root};

#[path = "../../shared/cases.rs"]
mod cases;

use crate::everything;

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const FULLMO: &str = "od-spec/devices/fullmo-drive.od.yaml";
const EVERYTHING: &str = "tests/readers/everything.od.yaml";

/// The device of a file.
fn device(path: &str, key: &str) -> runtime::Device {
    let system = compile_clean(path).unwrap();
    let mut diagnostics = Diagnostics::new();
    runtime::device(&system, system.device(key).unwrap(), &mut diagnostics).unwrap()
}

/// The number of its write conditions that a table refers to.
fn conditions<'t>(dictionary: &impl Dictionary<'t>) -> u16 {
    let of_rows = dictionary.table().parts().attributes.iter().map(|shared| shared.condition);
    of_rows.filter(|condition| *condition != firmware_glue::table::NONE).max().map_or(0, |last| last + 1)
}

/// Compares a device with what was generated of it: the tables, and with random values every condition.
fn compare<D: Dictionary<'static> + Constrained>(path: &str, key: &str, mut generated: D) {
    let device = device(path, key);
    let lists = device.lists();
    let table = lists.table().unwrap();
    assert_eq!(format!("{:#?}", table.parts()), format!("{:#?}", generated.table().parts()), "{key}");
    let mut live = LiveDictionary::new(&device, &table, 5).unwrap();
    assert_eq!(live.image(), generated.image());
    let mut random = Random::new(1);
    let conditions = conditions(&generated);
    let (mut held, mut failed, mut broken, mut kept) = (0, 0, 0, 0);
    for _ in 0..2000 {
        // Values as they may come, many of them small: numbers would hardly ever be close to each other otherwise.
        let byte = |_| {
            u8::try_from(if random.chance(60) { [0, 1, 2, 0xFF][random.below(4)] } else { random.below(256) })
        };
        let image: Vec<u8> = (0..device.image_size()).map(byte).collect::<Result<_, _>>().unwrap();
        live.image_mut().copy_from_slice(&image);
        generated.image_mut().copy_from_slice(&image);
        for number in 0..conditions {
            let holds = generated.condition(number);
            assert_eq!(live.condition(number), holds, "{key}: condition {number} with {image:?}");
            *if holds { &mut held } else { &mut failed } += 1;
        }
        let expected = D::CONSTRAINTS.iter().filter(|constraint| !(constraint.holds)(&generated));
        let expected: Vec<&str> = expected.map(|constraint| constraint.name).collect();
        assert_eq!(live.broken_constraints().collect::<Vec<_>>(), expected, "{key} with {image:?}");
        broken += expected.len();
        kept += D::CONSTRAINTS.len() - expected.len();
    }
    println!(
        "{key}: {} entries, {} rows of attributes; {conditions} conditions held {held} times and failed {failed} times; {} \
         constraints held {kept} times and failed {broken} times",
        table.parts().entries.len(),
        table.parts().attributes.len(),
        D::CONSTRAINTS.len(),
    );
    // Each verdict came often enough to be seen.
    assert!(conditions == 0 || held.min(failed) > 100, "{held} and {failed}");
    assert!(D::CONSTRAINTS.is_empty() || broken.min(kept) > 100, "{broken} and {kept}");
}

#[test]
fn the_table_of_the_pmc_is_the_generated_one() {
    compare(PITCH, "pmc", Pmc::new(5));
}

#[test]
fn the_table_of_the_pmm_is_the_generated_one() {
    compare(PITCH, "pmm", Pmm::new(5));
}

#[test]
fn the_table_of_the_fullmo_drive_is_the_generated_one() {
    compare(FULLMO, "fullmo", Fullmo::new(5));
}

#[test]
fn the_table_of_a_device_with_everything_is_the_generated_one() {
    let device = device(EVERYTHING, "everything");
    let (lists, generated) = (device.lists(), everything::Everything::new(5));
    let table = lists.table().unwrap();
    assert_eq!(format!("{:#?}", table.parts()), format!("{:#?}", generated.table().parts()));
}

/// Every access of the cases that the generated dictionaries are tried with.
fn try_device(path: &str, stem: &str, key: &str, least: usize) {
    let dump = std::fs::read(root().join(format!("generated/{stem}.json"))).unwrap();
    let dump = serde_json::from_slice(&dump).unwrap();
    let made = access_cases::of_device(&dump, key).unwrap();
    let device = device(path, key);
    let lists = device.lists();
    let table = lists.table().unwrap();
    let mut live = LiveDictionary::new(&device, &table, cases::NODE).unwrap();
    match cases::run(&mut live, &made.bytes) {
        Ok(count) => println!("{key}: {count} accesses as the dump says"),
        Err((number, (kind, index, sub), code)) => {
            panic!("{key}: case {number} (kind {kind}) at {index:04X}h.{sub}: {code:08X}h came")
        }
    }
    assert!(made.count >= least, "{} cases only", made.count);
}

#[test]
fn every_access_has_the_outcome_that_the_dump_says() {
    try_device(PITCH, "pitch-control-system", "pmc", 56_000);
    try_device(PITCH, "pitch-control-system", "pmm", 50_000);
    try_device(FULLMO, "fullmo-drive", "fullmo", 10_000);
}

/// An EDS says less than its specification (no enums, no conditions), but has the same entries with the same values.
#[test]
fn a_device_of_an_eds_has_the_entries_and_defaults_of_its_specification() {
    for (path, key) in [(PITCH, "pmc"), (PITCH, "pmm"), (FULLMO, "fullmo")] {
        let (of_spec, of_eds) = (device(path, key), device_of_eds(key));
        let (spec_lists, eds_lists) = (of_spec.lists(), of_eds.lists());
        let (spec_table, eds_table) = (spec_lists.table().unwrap(), eds_lists.table().unwrap());
        let spec = LiveDictionary::new(&of_spec, &spec_table, 5).unwrap();
        let eds = LiveDictionary::new(&of_eds, &eds_table, 5).unwrap();
        let rows = u16::try_from(spec_table.parts().entries.len()).unwrap();
        assert_eq!(eds_table.parts().entries.len(), usize::from(rows));
        let mut same = 0;
        for id in (0..rows).map(|row| spec_table.id(row)) {
            let read = |dictionary: &LiveDictionary<'_>| {
                dictionary.read(id.index, id.sub).map(|value| value.to_vec())
            };
            let expected = read(&spec);
            // An EDS does not know that an entry is another view of one, and so says nothing of what it shows.
            if spec.info_at(id.index, id.sub).unwrap().is_alias() {
                continue;
            }
            assert_eq!(read(&eds), expected, "{key} {id}");
            same += 1;
        }
        println!("{key}: {same} of {rows} entries of its EDS read as those of the specification");
    }
}

fn device_of_eds(key: &str) -> runtime::Device {
    let path = format!("generated/eds/{key}.eds");
    let text = std::fs::read_to_string(root().join(&path)).unwrap();
    let mut sources = od_spec::source::SourceMap::new();
    let file = sources.add(path, text);
    let system = od_spec::compile(&mut sources, file, &mut od_spec::NoFiles).system.unwrap();
    let mut diagnostics = Diagnostics::new();
    runtime::device(&system, &system.devices[0], &mut diagnostics)
        .unwrap_or_else(|| panic!("{diagnostics:?}"))
}
