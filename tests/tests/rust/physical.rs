//! Values in units that do not count from 0, and of REAL types, in every output. What is expected is worked out by hand.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::Arc;

use firmware_glue::{AbortCode, Constrained as _, Dictionary as _, OutOfRange, Quantity as _, Special};
use od_documents::{self as docs, Format, Templates};
use od_spec::diag::Diagnostics;
use od_spec::model::{EntryId, Index, SubIndex, System, Value};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{NoFiles, assign, compile};
use od_tests::{compile_clean, compile_with_sources};

#[deny(warnings)]
mod pack {
    od_macros::object_dictionary!("shared/physical.od.yaml");
}

use pack::Pack;
use pack::units::{Bipolar, CelsiusAbove40, Decikelvin, Kelvin, Third, Volt};

fn system() -> Arc<System> {
    compile_clean("tests/shared/physical.od.yaml").unwrap()
}

const fn id(index: u16) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(0) }
}

fn eds() -> String {
    let system = system();
    String::from_utf8(od_formats::eds::write_eds(&system, &system.devices[0])).unwrap().replace("\r\n", "\n")
}

#[test]
fn physical_values_become_raw_ones() {
    let system = system();
    let entry = |index| system.devices[0].entry(id(index)).unwrap();
    let raw = |index| entry(index).default.clone();
    assert_eq!(raw(0x2000), Some(Value::Integer(60)), "20 = 60 - 40");
    assert_eq!((entry(0x2000).low, entry(0x2000).high), (Some(20), Some(100)));
    assert_eq!(raw(0x2001), Some(Value::Integer(2932)), "20.05 = 293.2 - 273.15");
    assert_eq!(raw(0x2002), Some(Value::Integer(350)), "2000 = 350 * 20 - 5000");
    assert_eq!(entry(0x2002).low, Some(0));
    assert_eq!(raw(0x2003), Some(Value::Integer(293)), "the same origin, ten times the step");
    let real = |number: f64| Some(Value::Real(number.into()));
    assert_eq!((raw(0x2010), entry(0x2010).limits()), (real(20.5), (real(-40.0), real(85.25))));
    assert_eq!((raw(0x2011), entry(0x2011).limits()), (real(1500.0), (real(500.0), None)));
    assert_eq!((raw(0x2013), entry(0x2013).limits()), (real(2932.0), (None, real(3731.5))));
}

#[test]
fn an_eds_holds_raw_values_and_says_where_they_count_from() {
    let eds = eds();
    let part = |section: &str| {
        let (before, after) = eds.split_once(&format!("[{section}]\n")).unwrap();
        let comments = before.rsplit_once("\n\n").unwrap().1;
        format!("{comments}{}", after.split_once("\n\n").map_or(after, |(keys, _)| keys))
    };
    let cell = part("2000");
    assert!(cell.contains("; unit 1 degC from -40 degC\n"), "{cell}");
    assert!(cell.contains("DefaultValue=60\n") && cell.contains("LowLimit=20\nHighLimit=100"), "{cell}");
    assert!(part("2001").contains("; unit 0.1 degC from -273.15 degC"), "{}", part("2001"));
    let ambient = part("2010");
    assert!(ambient.contains("DefaultValue=20.5\n"), "{ambient}");
    assert!(ambient.contains("LowLimit=-40.0\nHighLimit=85.25"), "{ambient}");
    assert!(
        part("2011").contains("LowLimit=500.0\n") && !part("2011").contains("HighLimit"),
        "{}",
        part("2011")
    );
    assert!(part("2012").contains("HighLimit=0.1\n"), "{}", part("2012"));
    assert!(part("2002").contains("; unit 20 mV from -5000 mV"), "{}", part("2002"));
}

#[test]
fn an_eds_that_is_read_has_the_units() {
    let mut sources = SourceMap::new();
    let root = sources.add("pack.eds", eds());
    let read = compile(&mut sources, root, &mut NoFiles).system.unwrap();
    let shown = |index, raw| read.devices[0].entry(id(index)).unwrap().unit.as_ref().unwrap().show(raw);
    assert_eq!([shown(0x2000, 60), shown(0x2001, 2932)], ["20 °C", "20.05 °C"]);
    assert_eq!([shown(0x2002, 0), shown(0x2005, 12)], ["-5000 mV", "12 V"]);
    assert_eq!(shown(0x2010, 3), "3 °C", "of a REAL");
    let limits = |system: &System, index| system.devices[0].entry(id(index)).unwrap().limits();
    for index in 0x2010..=0x2014 {
        assert_eq!(limits(&read, index), limits(&system(), index), "{index:04X}");
    }
    // And as a specification.
    let written =
        od_import::yaml::specification(&read, &read.devices[0], &od_import::yaml::Options::default());
    let text = written.unwrap().text;
    for line in [
        "offset: -40",
        "offset: -5463/20",
        "default: 20 °C",
        "default: 20.05 °C",
        "default: 2000 mV",
        "min: -40.0",
        "max: 85.25",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn the_dump_has_the_offset() {
    let system = system();
    let dump: serde_json::Value = serde_json::from_slice(&od_formats::json::dump(&system, &[])).unwrap();
    let offset = |name: &str| {
        let units = dump["units"].as_array().unwrap();
        units.iter().find(|unit| unit["name"] == name).unwrap()["offset"].clone()
    };
    assert_eq!(offset("celsius above -40"), serde_json::json!([-40, 1]));
    assert_eq!(offset("decikelvin"), serde_json::json!([-5463, 20]));
    assert!(offset("volt").is_null());
    let ambient = dump["devices"][0]["objects"].as_array().unwrap();
    let ambient = &ambient.iter().find(|object| object["index"] == "0x2010").unwrap()["entries"][0];
    assert_eq!((ambient["low"].as_f64(), ambient["high"].as_f64()), (Some(-40.0), Some(85.25)));
    assert_eq!(ambient["default"], serde_json::json!({"raw": 20.5, "text": "20.5 °C"}));
}

#[test]
fn documents_show_what_is_measured() {
    let system = system();
    let page = |language: &str| {
        let templates = [Templates::new(Some(Format::Markdown), &[]).unwrap()];
        let options = docs::options(&system, &[], Some(language));
        let artifacts = docs::artifacts(&system, "", "pack", &options, &templates).unwrap();
        artifacts.into_iter().map(|one| String::from_utf8(one.bytes).unwrap()).collect::<String>()
    };
    let english = page("en");
    for text in [
        "20 °C (60)",
        "-20 °C (20) to 60 °C (100)",
        "1 °C from -40 °C",
        "20.05 °C (2932)",
        "2000 mV (350)",
        "-40.0 °C to 85.25 °C",
        "20.05 °C (2932.0)",
        "≤ 0.1",
        "≥ 500.0 mV",
    ] {
        assert!(english.contains(text), "{text}: {english}");
    }
    assert!(
        english.contains("> 50 °C and supply") && english.contains("10 V or bit 7 of heater"),
        "{english}"
    );
    let german = page("de");
    assert!(german.contains("0,1 °C ab -273,15 °C") && german.contains("20,05 °C (2932)"), "{german}");
}

#[test]
fn generated_code_converts_and_shows() {
    let mut od = Pack::new(1);
    assert_eq!(od.cell_temperature(), CelsiusAbove40(60));
    assert_eq!(od.cell_temperature().to_string(), "20 °C");
    assert_eq!(CelsiusAbove40(0u8).to_string(), "-40 °C");
    assert_eq!(Decikelvin(0u16).to_string(), "-273.15 °C");
    assert_eq!(Decikelvin(2732u16).to_string(), "0.05 °C");
    assert_eq!(Decikelvin(2731u16).to_string(), "-0.05 °C");
    assert_eq!(od.coolant_temperature(), Special::Value(Decikelvin(2932)));
    assert_eq!(od.coolant_temperature_in_1_k().to_string(), "19.85 °C");
    assert_eq!(od.shunt_voltage().to_string(), "2000 mV");
    assert_eq!(od.odd().to_string(), "7 × 1/3 + -1/3 °C");
    // Between units: exactly, downwards, or not at all.
    assert_eq!(Kelvin(293u16).convert::<Decikelvin<u16>, u16>(), Ok(Decikelvin(2930)));
    assert_eq!(Bipolar(350u16).convert::<Volt<u8>, u8>(), Ok(Volt(2)));
    assert_eq!(Volt(-5i8).convert::<Bipolar<u16>, u16>(), Ok(Bipolar(0)));
    assert_eq!(Bipolar(349u16).convert::<Volt<u8>, u8>(), Err(OutOfRange));
    assert_eq!(Bipolar(349u16).convert_down::<Volt<u8>, u8>(), Ok(Volt(1)));
    assert_eq!(Bipolar(0u16).convert::<Volt<u8>, u8>(), Err(OutOfRange), "no negative number");
    assert_eq!(CelsiusAbove40(60u8).convert::<Decikelvin<u16>, u16>(), Err(OutOfRange), "between two steps");
    assert_eq!(CelsiusAbove40(60u8).convert_down::<Decikelvin<u16>, u16>(), Ok(Decikelvin(2931)));
    assert_eq!(Third(1u8).convert::<CelsiusAbove40<u8>, u8>(), Ok(CelsiusAbove40(40)), "both are 0 °C");
    // Limits of REAL: what is not a number lies in none of them.
    let single =
        |od: &mut Pack, index, value: f32| od.write(index, 0, &value.to_le_bytes(), &mut ()).map(drop);
    let double =
        |od: &mut Pack, index, value: f64| od.write(index, 0, &value.to_le_bytes(), &mut ()).map(drop);
    assert_eq!(od.ambient().to_bits(), 20.5f32.to_bits());
    for (value, expected) in [
        (-40.0, Ok(())),
        (-40.000_004, Err(AbortCode::TOO_LOW)),
        (85.25, Ok(())),
        (85.250_01, Err(AbortCode::TOO_HIGH)),
        (-0.0, Ok(())),
        (f32::INFINITY, Err(AbortCode::TOO_HIGH)),
        (f32::NAN, Err(AbortCode::TOO_HIGH)),
        (-f32::NAN, Err(AbortCode::TOO_LOW)),
    ] {
        assert_eq!(single(&mut od, 0x2010, value), expected, "{value}");
    }
    assert_eq!(single(&mut od, 0x2012, 0.1), Ok(()), "the limit as a REAL32 has it");
    assert_eq!(single(&mut od, 0x2012, 0.100_000_01), Err(AbortCode::TOO_HIGH), "the next number");
    assert_eq!(double(&mut od, 0x2011, f64::INFINITY), Ok(()), "nothing limits that side");
    assert_eq!(double(&mut od, 0x2011, 499.99), Err(AbortCode::TOO_LOW));
    assert_eq!(double(&mut od, 0x2011, f64::NAN), Err(AbortCode::TOO_HIGH));
    assert_eq!(single(&mut od, 0x2014, f32::NAN), Ok(()), "no limits");
    assert_eq!(pack::limits::AMBIENT, -40.0..=85.25);
    assert_eq!(pack::limits::PUMP_VOLTAGE, 500.0..=f64::INFINITY);
    // Limits, writes and conditions.
    assert_eq!(od.write(0x2000, 0, &[101], &mut ()), Err(AbortCode::TOO_HIGH));
    assert!(od.write(0x2000, 0, &[40], &mut ()).is_ok());
    assert_eq!(od.write(0x2004, 0, &[1], &mut ()), Err(AbortCode::DEVICE_STATE), "0 °C is not below 0 °C");
    od.set_cell_temperature(CelsiusAbove40(39));
    assert!(od.write(0x2004, 0, &[1], &mut ()).is_ok());
    od.set_shunt_voltage(Bipolar(249));
    assert_eq!(od.write(0x2004, 0, &[2], &mut ()), Err(AbortCode::DEVICE_STATE), "249 * 20 - 5000 = -20 mV");
    assert!(od.broken_constraint().is_none());
    od.set_cell_temperature(CelsiusAbove40(61));
    assert!(od.broken_constraint().is_some(), "21 °C is not below 20.05 °C");
}

#[test]
fn one_of_two_conditions_is_enough() {
    let mut od = Pack::new(1);
    let mut fan = |cell: u8, supply: u8, heater: u8| {
        od.set_cell_temperature(CelsiusAbove40(cell));
        od.set_supply(Volt(supply));
        od.set_heater(heater);
        od.write(0x2015, 0, &[1], &mut ()).map(drop)
    };
    let refused = Err(AbortCode::DEVICE_STATE);
    assert_eq!(fan(91, 11, 0), Ok(()), "51 °C and 11 V");
    assert_eq!(fan(90, 11, 0), refused);
    assert_eq!(fan(91, 10, 0), refused);
    assert_eq!(fan(0, 0, 0x80), Ok(()), "bit 7");
    // The fan is 1 by now, so that the other alternative counts, where it is asked for.
    let mut breaks = |supply: u8, heater: u8, odd: u8| {
        od.set_cell_temperature(CelsiusAbove40(0));
        od.set_supply(Volt(supply));
        od.set_heater(heater);
        od.set_odd(Third(odd));
        od.broken_constraint().map(|constraint| constraint.name)
    };
    let broken = Some("the fan or the heater");
    assert_eq!([breaks(4, 1, 7), breaks(21, 1, 7), breaks(12, 1, 7)], [broken, broken, None]);
    assert_eq!([breaks(4, 0, 7), breaks(4, 0, 0)], [None, broken], "both of an alternative");
}

#[test]
fn names_in_conditions_mean_indices() {
    let system = compile_clean("tests/ui/ok_conditions_by_name.od.yaml").unwrap();
    let device = &system.devices[0];
    let condition = |index, sub| {
        let entry = device.entry(EntryId { index: Index(index), sub: SubIndex(sub) }).unwrap();
        entry.writable_when.as_ref().unwrap().text.clone()
    };
    assert_eq!(condition(0x2004, 0), "0x2000 == 2 or 0x2000 == 1");
    assert_eq!(condition(0x2005, 0), condition(0x2004, 0), "a view of it");
    assert_eq!(condition(0x2006, 0), "bit(0x2001, 1) == 1 and lamp:0x2003 < 5");
    assert_eq!([condition(0x2007, 1), condition(0x2007, 3)], ["0x2000 != 0", "0x2000 != 0"]);
    let said = |constraint: &od_spec::model::Constraint| {
        let when = constraint.when.as_ref().map_or_else(String::new, |when| format!(" when {}", when.text));
        format!("{}: {}{when}", constraint.name, constraint.require.text)
    };
    let constraints: Vec<String> = system.constraints.iter().map(said).collect();
    assert_eq!(
        constraints[..5],
        [
            "limits in order: 0x2002.1 < 0x2002.2 when 0x2002.2 != 3276.7",
            "difference: 0x2002.2 - 0x2002.1 >= 2",
            "level 1 is below the dimmer: 0x2007.1 <= 0x2004 or 0x2007.1 == 0",
            "level 2 is below the dimmer: 0x2007.2 <= 0x2004 or 0x2007.2 == 0",
            "level 3 is below the dimmer: 0x2007.3 <= 0x2004 or 0x2007.3 == 0",
        ]
    );
    assert_eq!(constraints[5..].len(), 8);
    assert_eq!(constraints[12], "bit 15 stays 0: bit(0x2001, 15) == 0");
    assert_eq!(system.constraints[3].about.get("en"), Some("Level 2."));
}

#[test]
fn settings_are_written_as_they_are_measured() {
    let (system, mut sources) = compile_with_sources("tests/shared/physical.od.yaml").unwrap();
    let mut set = |text: &str| {
        let file = sources.add("--set", text);
        let setting = Spanned::new(text.to_owned(), sources.whole(file));
        let mut diagnostics = Diagnostics::new();
        let values = assign(&system, &system.devices[0], 5, &[setting], &mut diagnostics);
        let said = diagnostics.iter().map(|found| format!("{}: {}", found.code.id, found.message)).next();
        said.map_or_else(|| Ok(values.into_values().next().unwrap()), Err)
    };
    assert_eq!(set("coolant temperature=25.05 °C"), Ok(Value::Integer(2982)));
    assert_eq!(set("0x2002=-5 V"), Ok(Value::Integer(0)));
    assert_eq!(set("cell temperature=-20 °C"), Ok(Value::Integer(20)));
    assert_eq!(set("ambient=-12.25 °C"), Ok(Value::Real((-12.25).into())));
    assert_eq!(set("pump voltage=2 V"), Ok(Value::Real(2000.0.into())));
    for (text, code) in [
        ("ambient=85.26 °C", "OD0406"),
        ("ambient=20 K", "OD0405"),
        ("gain=0.2", "OD0406"),
        ("cell temperature=-21 °C", "OD0406"),
        ("coolant temperature=25 °C", "OD0412"),
        ("0x2002=-5.02 V", "OD0404"),
    ] {
        assert!(set(text).is_err_and(|said| said.starts_with(code)), "{text}: {:?}", set(text));
    }
}

#[test]
fn times_of_pdos_become_raw_ones() {
    let system = compile_clean("tests/ui/ok_times.od.yaml").unwrap();
    let device = &system.devices[0];
    let times = device.pdos.iter().map(|pdo| (pdo.inhibit_time, pdo.event_timer)).collect::<Vec<_>>();
    let expected = [(None, Some(100)), (Some(100), Some(100)), (Some(5), Some(20)), (Some(100), Some(250))];
    assert_eq!(times, expected, "in 100 µs and in ms");
    assert_eq!(device.entry(id(0x1017)).unwrap().default, Some(Value::Integer(1000)));
}

#[test]
fn bits_by_name_become_raw_values() {
    let system = compile_clean("tests/ui/ok_bits_of_default.od.yaml").unwrap();
    let raw = |index, sub| {
        let entry = system.devices[0].entry(EntryId { index: Index(index), sub: SubIndex(sub) }).unwrap();
        entry.default.as_ref().unwrap().integer().unwrap()
    };
    assert_eq!(raw(0x2000, 0), 0b11);
    assert_eq!(raw(0x2001, 0), i128::from(0x8010_u16.cast_signed()), "the sign of an INTEGER16");
    assert_eq!(raw(0x2002, 0), 0x0151);
    assert_eq!([raw(0x2003, 1), raw(0x2003, 2)], [1, -0x8000]);
    let eds = od_formats::eds::write_eds(&system, &system.devices[0]);
    assert!(String::from_utf8(eds).unwrap().contains("DefaultValue=-32752\r\n"));
}
