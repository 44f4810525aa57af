//! The Fullmo drive holds its whole manual, distinguishes the maker's word from the standard's, and its Rust gives the
//! raw values that the manual prints.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use firmware_glue::quantity::Fraction;
use firmware_glue::{Dictionary as _, Quantity as _};
use od_generated::fullmo::types::{
    DriveControlword, DriveMode, EdgeFunctions, HomingSensors, RelativePositioningOption,
};
use od_generated::fullmo::{Fullmo, units};
use od_spec::model::{
    Access, Author, DataType, Dictionary, EntryId, Erratum, ErratumKind, Fact, Index, Origin, PdoMapping,
    Storage, SubIndex, System, TableContent, TypeKind,
};
use od_tests::compile_clean;

fn fullmo() -> Arc<System> {
    compile_clean("od-spec/devices/fullmo-drive.od.yaml").unwrap()
}

fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

fn indices(device: &Dictionary, origin: Origin) -> Vec<u16> {
    device.objects.values().filter(|object| object.origin == origin).map(|object| object.index.0).collect()
}

#[test]
fn every_object_that_the_manual_names_and_no_other() {
    let system = fullmo();
    let [device] = system.devices.as_slice() else { panic!("one device") };
    let mut expected = vec![0x3402, 0x3404];
    expected.extend(0x3511..=0x3519_u16);
    expected.extend([0x6040, 0x6041, 0x605A, 0x605B, 0x605C, 0x605D, 0x605E, 0x6060, 0x6061]);
    // The list of homing names 6062h; position control has 6063h to 6068h.
    expected.extend([0x6062, 0x6063, 0x6064, 0x6067, 0x6068]);
    expected.extend([0x606B, 0x606C, 0x606D, 0x606E, 0x606F, 0x6070]);
    expected.extend(0x6071..=0x6079_u16);
    expected.extend([0x607A, 0x607C, 0x607D, 0x607E, 0x607F, 0x6080, 0x6081, 0x6083, 0x6084, 0x6085, 0x6087]);
    // The formulas of the position units.
    expected.extend([0x608F, 0x6091, 0x6092]);
    expected.extend([0x6098, 0x6099, 0x609A, 0x60B8, 0x60C5, 0x60C6, 0x60F2, 0x60FC, 0x60FF]);
    let mut manual = indices(device, Origin::Manual);
    // The error register carries the bits that an emergency message shows; CiA 301 asks for it.
    manual.retain(|index| *index >= 0x2000);
    assert_eq!(manual, expected);
}

/// Each chapter lists the objects that it implements, and describes others, too.
#[test]
fn objects_that_a_chapter_describes_and_does_not_list_have_an_erratum() {
    let system = fullmo();
    let mut described: BTreeMap<String, [BTreeSet<Index>; 2]> = BTreeMap::new();
    for section in &system.document.sections {
        let chapter = section.number.split('.').next().unwrap().to_owned();
        let [listed, shown] = described.entry(chapter).or_default();
        for table in &section.tables {
            match &table.content {
                TableContent::Overview(list) => listed.extend(list),
                TableContent::Objects(list) => shown.extend(list),
                _ => {}
            }
        }
    }
    let mut only_described: BTreeSet<u16> = BTreeSet::new();
    for (chapter, [listed, shown]) in described.iter().filter(|(_, [listed, _])| !listed.is_empty()) {
        for index in shown.difference(listed) {
            let says_so = |erratum: &Erratum| {
                matches!(erratum.kind, ErratumKind::Count | ErratumKind::Gap)
                    && erratum.place.get("de").is_some_and(|place| place.starts_with(&format!("{chapter}.")))
                    && erratum.at.iter().any(|at| at.index() == *index)
            };
            assert!(system.errata.iter().any(says_so), "{index} in chapter {chapter}");
            only_described.insert(index.0);
        }
    }
    let of_the_manual = [
        0x6063, 0x606B, 0x606C, 0x606D, 0x606E, 0x606F, 0x6070, 0x6074, 0x608F, 0x6091, 0x6092, 0x60B8,
        0x60F2, 0x60FC,
    ];
    assert_eq!(only_described, of_the_manual.into());
}

#[test]
fn nothing_is_known_to_be_stored() {
    let system = fullmo();
    let device = &system.devices[0];
    assert!(!device.objects.contains_key(&Index(0x1010)));
    let stored: Vec<EntryId> =
        device.entries().filter(|(.., entry)| entry.stored != Storage::No).map(|(id, ..)| id).collect();
    assert!(stored.is_empty(), "{stored:?}");
}

#[test]
fn every_table_of_the_manual_is_there_once_and_in_order() {
    let system = fullmo();
    let tables = system.document.sections.iter().flat_map(|section| &section.tables);
    let numbers: Vec<u16> = tables.filter_map(|table| table.number).collect();
    assert_eq!(numbers, (1..=7).collect::<Vec<u16>>());
}

#[test]
fn emergency_codes_are_those_of_table_7() {
    let system = fullmo();
    let codes: Vec<u16> = system.errors.iter().map(|error| error.code).collect();
    let mut printed = vec![
        0x3211, 0x3221, 0x4220, 0x4210, 0x8160, 0x7121, 0x7305, 0x5116, 0x5113, 0x5114, 0x5111, 0x5115,
        0x5112, 0x2221, 0x7113, 0x3330, 0x7111, 0x5530, 0x5441, 0xFF01, 0xFFFF,
    ];
    let mut sorted = codes.clone();
    sorted.sort_unstable();
    printed.sort_unstable();
    assert_eq!(sorted, printed);
}

#[test]
fn option_codes_modes_and_homing_methods_are_the_supported_ones() {
    let system = fullmo();
    let values = |index: u16| -> Vec<i128> {
        let entry = system.devices[0].entry(id(index, 0)).unwrap();
        match &entry.named_type.as_ref().unwrap().kind {
            TypeKind::Enum(values) => {
                values.iter().filter(|value| value.supported).map(|value| value.value).collect()
            }
            TypeKind::Bits(_) => panic!("{index:04X}h is a bit field"),
        }
    };
    assert_eq!(values(0x605A), (0..=8).collect::<Vec<i128>>());
    assert_eq!(values(0x605B), [0, 1]);
    assert_eq!(values(0x605C), [0, 1]);
    assert_eq!(values(0x605D), (0..=4).collect::<Vec<i128>>());
    assert_eq!(values(0x605E), (0..=4).collect::<Vec<i128>>());
    // 4 is missing in the list and described in chapter 5.
    assert_eq!(values(0x6060), [-1, 1, 3, 4, 6]);
    let mut methods = vec![-19, -18];
    methods.extend(17..=30);
    methods.push(35);
    assert_eq!(values(0x6098), methods);
}

#[test]
fn what_the_manual_does_not_say_is_marked_as_the_standards_word() {
    let system = fullmo();
    let entry = |index, sub| system.devices[0].entry(id(index, sub)).unwrap();
    // 6083h: the maker's unit on the standard's type and access.
    let acceleration = entry(0x6083, 0);
    assert_eq!(acceleration.data_type, DataType::Unsigned32);
    let of_the_standard: Vec<Fact> = acceleration.facts.said_by(Author::Library).collect();
    assert_eq!(of_the_standard, [Fact::Type, Fact::Access, Fact::Mapping, Fact::Category, Fact::Search]);
    assert_eq!(acceleration.unit.as_ref().unwrap().name, "revolution per second squared");
    // 3511h: type and access are in Table 2, nothing of a standard's.
    let edges = entry(0x3511, 1);
    assert_eq!((edges.data_type, edges.access), (DataType::Unsigned16, Access::Rw));
    assert_eq!(edges.facts.said_by(Author::Library).count(), 0);
    // 60B8h is another thing than in CiA 402: it is not mapped by mistake.
    assert_eq!(entry(0x60B8, 0).pdo, PdoMapping::None);
}

/// The EDS states why a default is missing: nothing is known to be stored, but the standard's defaults are not the
/// maker's.
#[test]
fn the_eds_does_not_promise_the_standards_defaults() {
    let system = fullmo();
    let eds = String::from_utf8(od_formats::eds::write_eds(&system, &system.devices[0])).unwrap();
    assert!(eds.contains("=24 defaults are left out because only the standard states them"), "{eds}");
    assert!(!eds.contains("defaults of stored or locked parameters"));
    // What it starts with is chosen here, and not promised.
    assert!(eds.contains("=3 values that the device starts with are left out"), "{eds}");
    let section =
        |name: &str| eds.split("\r\n\r\n").find(|part| part.contains(&format!("[{name}]"))).unwrap();
    assert!(section("6071").contains("; default") || section("6071").contains("default of the standard"));
    assert!(!section("6071").contains("DefaultValue="));
    for (name, start) in
        [("6060", "; start value 1: "), ("6061", "; start value 1: "), ("6098", "; start value 35: ")]
    {
        assert!(
            section(name).contains(start) && !section(name).contains("DefaultValue="),
            "{}",
            section(name)
        );
    }
}

#[test]
fn scales_are_those_of_the_manual() {
    let system = fullmo();
    let step = |index, sub| {
        let unit = system.devices[0].entry(id(index, sub)).unwrap().unit.as_ref().unwrap();
        (unit.scale.numerator(), unit.scale.denominator(), unit.symbol.as_str())
    };
    for index in [0x6083, 0x6084, 0x6085, 0x60C5, 0x60C6] {
        assert_eq!(step(index, 0), (61, 4000, "U/s²"), "{index:04X}h");
    }
    for sub in [3, 5] {
        assert_eq!(step(0x3402, sub), (1, 100, "A"), "3402h.{sub}");
    }
    for sub in [9, 12] {
        assert_eq!(step(0x3402, sub), (1, 100, "V"), "3402h.{sub}");
    }
    assert_eq!(step(0x3404, 5), (1, 100, "A"));
    for index in [0x6062, 0x6064, 0x6067, 0x607A, 0x607C] {
        let unit = system.devices[0].entry(id(index, 0)).unwrap().unit.as_ref().unwrap();
        assert_eq!(unit.name, "position unit", "{index:04X}h");
    }
    assert_eq!(step(0x6075, 0), (1, 1, "mA"));
    assert_eq!(step(0x6076, 0), (1, 1, "mNm"));
    assert_eq!(step(0x6079, 0), (1, 1, "mV"));
    for index in [0x6071, 0x6072, 0x6073, 0x6074, 0x6077, 0x6078] {
        assert_eq!(step(index, 0), (1, 10, "%"), "{index:04X}h");
    }
}

#[test]
fn units_of_the_generated_rust_convert_as_the_manual_says() {
    let mut od = Fullmo::new(1);
    od.write(0x6083, 0, &1000_u32.to_le_bytes(), &mut ()).unwrap();
    let step = od.profile_acceleration();
    assert_eq!(step, units::RevolutionPerSecondSquared(1000));
    assert_eq!(step.to_string(), "15.25000 U/s²");
    let voltage = units::Centivolt(4800_u16);
    assert_eq!(voltage.to_string(), "48.00 V");
    assert_eq!(units::Centivolt::<u16>::SCALE, Fraction { numerator: 1, denominator: 100 });
}

/// Writes a value through the generated record and reads the raw bytes that an SDO client sees.
fn raw(of: impl FnOnce(&mut Fullmo), index: u16, sub: u8) -> Vec<u8> {
    let mut od = Fullmo::new(1);
    of(&mut od);
    od.read(index, sub).unwrap().to_vec()
}

fn edges(value: EdgeFunctions) -> u16 {
    let bytes = raw(|od| od.input_functions_1_mut().set_edge_functions(value), 0x3511, 1);
    u16::from_le_bytes(bytes.try_into().unwrap())
}

#[test]
fn tables_3_to_6_input_functions() {
    use EdgeFunctions as E;
    let rising = |function| E(0).with_rising_edge_function(function);
    let falling = |function| E(0).with_falling_edge_function(function);
    let both = |of_rising, of_falling| rising(of_rising).with_falling_edge_function(of_falling);
    // Table 3
    assert_eq!(edges(rising(E::RISING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_1)), 0x0100);
    assert_eq!(edges(falling(E::FALLING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_1)), 0x0001);
    assert_eq!(
        edges(both(
            E::RISING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_1,
            E::FALLING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_1
        )),
        0x0101
    );
    // Table 4
    assert_eq!(edges(rising(E::RISING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_2)), 0x0200);
    assert_eq!(edges(falling(E::FALLING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_2)), 0x0002);
    assert_eq!(
        edges(both(
            E::RISING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_1,
            E::FALLING_EDGE_FUNCTION_CAPTURE_POSITION_IN_RESULT_2
        )),
        0x0102
    );
    // Table 5
    assert_eq!(edges(rising(E::RISING_EDGE_FUNCTION_COUNTER)), 0x0300);
    assert_eq!(edges(falling(E::FALLING_EDGE_FUNCTION_COUNTER)), 0x0003);
    assert_eq!(edges(both(E::RISING_EDGE_FUNCTION_COUNTER, E::FALLING_EDGE_FUNCTION_COUNTER)), 0x0303);
    // Table 6
    assert_eq!(edges(rising(E::RISING_EDGE_FUNCTION_TIMED_MOTION)), 0x0400);
    assert_eq!(edges(falling(E::FALLING_EDGE_FUNCTION_TIMED_MOTION)), 0x0004);
}

#[test]
fn table_6_timed_motion_of_every_input() {
    let mut od = Fullmo::new(1);
    {
        let mut input = od.input_functions_9_mut();
        input.set_edge_functions(EdgeFunctions(0).with_rising_edge_function(4));
        input.set_motion_delay(units::Millisecond(1000));
        input.set_target_velocity(500);
        input.set_acceleration(10);
    }
    assert_eq!(od.read(0x3519, 1).unwrap().to_vec(), [0x00, 0x04]);
    assert_eq!(od.read(0x3519, 5).unwrap().to_vec(), 1000_u16.to_le_bytes());
    assert_eq!(od.read(0x3519, 6).unwrap().to_vec(), 500_i32.to_le_bytes());
    assert_eq!(od.read(0x3519, 7).unwrap().to_vec(), 10_u16.to_le_bytes());
    // The other inputs are other objects.
    assert_eq!(od.read(0x3511, 1).unwrap().to_vec(), [0, 0]);
}

#[test]
fn table_1_controlwords_of_profile_position() {
    let enabled = DriveControlword(0x000F);
    let single = enabled.with_operation_mode_specific_4(true);
    assert_eq!(single, DriveControlword(0x001F));
    assert_eq!(single.with_operation_mode_specific_5(true), DriveControlword(0x003F));
    assert_eq!(single.with_operation_mode_specific_9(true), DriveControlword(0x021F));
}

#[test]
fn sensors_of_homing_and_relative_positioning() {
    let sensors = HomingSensors(0)
        .with_home_switch(HomingSensors::HOME_SWITCH_INPUT_1)
        .and_then(|sensors| sensors.with_left_limit_switch(HomingSensors::LEFT_LIMIT_SWITCH_INPUT_2))
        .and_then(|sensors| sensors.with_right_limit_switch(HomingSensors::RIGHT_LIMIT_SWITCH_INPUT_3))
        .unwrap();
    assert_eq!(raw(|od| od.set_touch_probe_function(sensors), 0x60B8, 0), 0x0321_u16.to_le_bytes());
    let actual = RelativePositioningOption(0).with_relative_to(2).unwrap();
    assert_eq!(raw(|od| od.set_positioning_option_code(actual), 0x60F2, 0), 2_u16.to_le_bytes());
    assert_eq!(raw(|od| od.set_modes_of_operation(DriveMode::HOMING_MODE), 0x6060, 0), [6]);
}
