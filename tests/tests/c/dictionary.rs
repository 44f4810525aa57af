//! The dictionary in plain C, compiled by the compiler that Rust links with, answers every request as the Rust does.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and counts")]

use std::fmt::Write as _;
use std::path::PathBuf;

use firmware_glue::Dictionary;
use od_bus::runtime::{self, LiveDictionary};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};
use od_spec::diag::Diagnostics;
use od_tests::c_dictionary::{
    Compiler, Exchange, Host, Reference, SDO_SERVER, SdoTrial, Trial, Written, compare, write, write_text,
};

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod everything {
    od_macros::object_dictionary!("readers/everything.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod limits {
    od_macros::object_dictionary!("readers/limits.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    deprecated,
    reason = "what users' lints say about generated code is tested with od-generated; the specification has a warning"
)]
mod scales {
    od_macros::object_dictionary!("readers/scales.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod conditions {
    od_macros::object_dictionary!("c/conditions.od.yaml");
}

/// A directory of a test's own.
fn directory(name: &str) -> PathBuf {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("c").join(name);
    let _ = std::fs::remove_dir_all(&directory);
    std::fs::create_dir_all(&directory).unwrap();
    directory
}

fn cc() -> Compiler {
    Compiler::new("cc", &[])
}

fn try_device<D: Dictionary<'static>>(path: &str, key: &str, reference: Reference<D>) {
    let directory = directory(key);
    assert!(write(path, &directory).unwrap().devices.iter().any(|device| device == key));
    let host = Host::build(&cc(), &directory, key).unwrap();
    try_host(&host, key, reference);
}

fn try_host<'t, D: Dictionary<'t>>(host: &Host, key: &str, reference: Reference<D>) {
    let exchange = Trial::new(reference, 1).exchange(20_000);
    println!("{key}: {} requests", exchange.len());
    assert!(exchange.len() > 40_000);
    compare(&exchange, &host.ask(&exchange).unwrap()).unwrap();
}

#[test]
fn the_pmc_answers_as_its_rust() {
    try_device("od-spec/devices/pitch-control-system.od.yaml", "pmc", Reference::generated(Pmc::new(5)));
}

#[test]
fn the_pmm_answers_as_its_rust() {
    try_device("od-spec/devices/pitch-control-system.od.yaml", "pmm", Reference::generated(Pmm::new(5)));
}

#[test]
fn the_fullmo_drive_answers_as_its_rust() {
    try_device("od-spec/devices/fullmo-drive.od.yaml", "fullmo", Reference::generated(Fullmo::new(5)));
}

#[test]
fn every_feature_answers_as_its_rust() {
    try_device(
        "tests/readers/everything.od.yaml",
        "everything",
        Reference::plain(everything::Everything::new(5)),
    );
}

#[test]
fn limits_of_all_types_answer_as_their_rust() {
    try_device("tests/readers/limits.od.yaml", "limits", Reference::plain(limits::Limits::new(5)));
}

#[test]
fn scales_of_all_kinds_answer_as_their_rust() {
    try_device("tests/readers/scales.od.yaml", "scales", Reference::plain(scales::Scales::new(5)));
}

#[test]
fn the_sdo_server_of_the_book_answers_as_that_in_rust() {
    let directory = directory("sdo");
    let Written { system, devices } = write("tests/c/valve.od.yaml", &directory).unwrap();
    let live = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = live.lists();
    let table = lists.table().unwrap();
    let dictionary = LiveDictionary::new(&live, &table, 5).unwrap();
    let exchange = SdoTrial::new(dictionary, 5).unwrap().exchange();
    assert!(exchange.len() > 500, "{} frames", exchange.len());
    let host = Host::build_with(&cc(), &directory, &devices[0], &SDO_SERVER).unwrap();
    compare(&exchange, &host.ask(&exchange).unwrap()).unwrap();
}

/// A client whose command succeeds relies on the memory.
#[test]
fn the_sdo_server_of_the_book_stores_nothing_and_says_so() {
    let directory = directory("sdo-save");
    let Written { devices, .. } = write("tests/c/valve.od.yaml", &directory).unwrap();
    let host = Host::build_with(&cc(), &directory, &devices[0], &SDO_SERVER).unwrap();
    let request =
        |request: &[u8], answer: &[u8]| Exchange { request: request.to_vec(), answer: answer.to_vec() };
    let exchange =
        [request(&[5], &[]), request(b"\x23\x10\x10\x01save", &[0x80, 0x10, 0x10, 1, 0x20, 0, 0, 8])];
    compare(&exchange, &host.ask(&exchange).unwrap()).unwrap();
}

#[test]
fn conditions_of_128_bits_and_views_answer_as_their_rust() {
    try_device(
        "tests/c/conditions.od.yaml",
        "conditions",
        Reference::generated(conditions::Conditions::new(5)),
    );
}

/// As a tool of another maker writes it: names that clash and that are words of C, odd widths, placeholders, texts without a capacity, a comment's end.
const FOREIGN: &str = "\
[DeviceInfo]
ProductName=int */ thing
Granularity=8
[DummyUsage]
Dummy0001=1
Dummy0002=1
Dummy0003=1
Dummy0004=1
Dummy0005=1
Dummy0006=1
Dummy0007=1
[MandatoryObjects]
SupportedObjects=1
1=0x1000
[1000]
ParameterName=Device type
ObjectType=7
DataType=7
AccessType=ro
DefaultValue=0
[1005]
ParameterName=COB-ID SYNC
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=0x80
[1014]
ParameterName=COB-ID EMCY
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=$NODEID+0x80
[1400]
ParameterName=RPDO 1 parameter
ObjectType=9
SubNumber=3
[1400sub0]
ParameterName=highest
ObjectType=7
DataType=5
AccessType=ro
DefaultValue=2
[1400sub1]
ParameterName=COB-ID
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=$NODEID+0x200
[1400sub2]
ParameterName=type
ObjectType=7
DataType=5
AccessType=rw
DefaultValue=255
[1600]
ParameterName=RPDO 1 mapping
ObjectType=9
SubNumber=4
[1600sub0]
ParameterName=number
ObjectType=7
DataType=5
AccessType=rw
DefaultValue=3
[1600sub1]
ParameterName=map 1
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=0x20000010
[1600sub2]
ParameterName=map 2
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=0x00050008
[1600sub3]
ParameterName=map 3
ObjectType=7
DataType=7
AccessType=rw
DefaultValue=0x20020018
[2000]
ParameterName=Register
ObjectType=7
DataType=6
AccessType=rww
PDOMapping=1
LowLimit=0x10
HighLimit=0x7FFF
DefaultValue=0x20
[2001]
ParameterName=register */ /* \\
ObjectType=7
DataType=0x12
AccessType=rw
LowLimit=-5
[2002]
ParameterName=while
ObjectType=7
DataType=0x10
AccessType=rww
PDOMapping=1
[2003]
ParameterName=text \"??/
ObjectType=7
DataType=9
AccessType=rw
DefaultValue=what??/ \"it\"
[2004]
ParameterName=octets
ObjectType=7
DataType=0xA
AccessType=rw
[2005]
ParameterName=gaps
ObjectType=9
SubNumber=3
[2005sub0]
ParameterName=highest
ObjectType=7
DataType=5
AccessType=ro
DefaultValue=9
[2005sub4]
ParameterName=a real
ObjectType=7
DataType=8
AccessType=rw
DefaultValue=1.5
[2005sub9]
ParameterName=time
ObjectType=7
DataType=0xC
AccessType=rw
[2006]
ParameterName=24V ---
ObjectType=7
DataType=1
AccessType=wo
";

/// Communication objects whose values have rules of their own, all of them writable, and as wide as the standard has them.
fn communication_objects() -> String {
    let variable = |name: &str, data_type: u8, default: &str| {
        format!(
            "ParameterName={name}\nObjectType=7\nDataType={data_type}\nAccessType=rw\nDefaultValue={default}\n"
        )
    };
    let mut text = String::new();
    for (index, data_type, default) in
        [(0x1006, 7, "0"), (0x1012, 7, "0x100"), (0x1019, 5, "0"), (0x1017, 6, "0"), (0x100C, 6, "0")]
    {
        let _ = write!(text, "[{index:X}]\n{}", variable(&format!("object {index:X}"), data_type, default));
    }
    let records: [(u16, &[(u8, &str)]); 9] = [
        (0x1003, &[(7, "0"), (7, "0"), (7, "0")]),
        (0x1010, &[(7, "1"), (7, "1")]),
        (0x1011, &[(7, "1")]),
        (0x1016, &[(7, "0"), (7, "0"), (7, "0")]),
        (0x1028, &[(7, "0x80000000"), (7, "0x85")]),
        (0x1029, &[(5, "0"), (5, "1")]),
        (0x1200, &[(7, "$NODEID+0x600"), (7, "$NODEID+0x580"), (5, "1")]),
        (0x1201, &[(7, "0x80000000"), (7, "0x80000000"), (5, "1")]),
        (0x1280, &[(7, "0x80000000"), (7, "0x80000000"), (5, "1")]),
    ];
    for (index, subs) in records {
        let _ = write!(
            text,
            "[{index:X}]\nParameterName=object {index:X}\nObjectType=9\nSubNumber={}\n",
            subs.len() + 1
        );
        let count = if index == 0x1003 { "0".to_owned() } else { subs.len().to_string() };
        let _ = write!(text, "[{index:X}sub0]\n{}", variable("number", 5, &count));
        for (sub, (data_type, default)) in (1..).zip(subs) {
            let _ = write!(
                text,
                "[{index:X}sub{sub:X}]\n{}",
                variable(&format!("part {sub}"), *data_type, default)
            );
        }
    }
    text
}

#[test]
fn an_eds_answers_as_the_table_that_is_made_of_it() {
    let directory = directory("foreign");
    let text = FOREIGN.to_owned() + &communication_objects();
    let Written { system, devices } = write_text("foreign.eds", text, &directory).unwrap();
    let [device] = devices.as_slice() else { panic!("{devices:?}") };
    let host = Host::build(&cc(), &directory, device).unwrap();
    let live = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = live.lists();
    let table = lists.table().unwrap();
    let dictionary = LiveDictionary::new(&live, &table, 5).unwrap();
    try_host(&host, "foreign", Reference::plain(dictionary));
}
