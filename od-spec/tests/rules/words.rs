//! What rules say to the owner of an EDS is in the words of an EDS, and to the author of a specification in those of the
//! language: each rule, tried with a fault in an EDS or DCF, and with its example.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use od_spec::diag::{Diagnostic, Diagnostics, Language};
use od_spec::keys::{self, Keys};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, Strictness, compile_as};

use crate::{rules, said_of_example};

/// Keys of the language. As a word alone, most are words of any language; a key is recognized by its colon.
const CHAPTERS: [&Keys; 30] = [
    &keys::ALLOWED,
    &keys::CONSTRAINT,
    &keys::DEVICE,
    &keys::CHANNEL,
    &keys::FILE,
    &keys::ENTRY,
    &keys::SPECIAL,
    &keys::ERROR,
    &keys::ANY_ERROR,
    &keys::REVISION,
    &keys::SOURCE,
    &keys::SPEC,
    &keys::VENDOR,
    &keys::AXES,
    &keys::FEATURE,
    &keys::COMMAND,
    &keys::MACHINE,
    &keys::STATE,
    &keys::TRANSITION,
    &keys::ERRATUM,
    &keys::SECTION,
    &keys::CONTENT,
    &keys::ARRAY,
    &keys::OBJECT,
    &keys::SUB0,
    &keys::PDO,
    &keys::PDOS,
    &keys::BIT,
    &keys::TYPE,
    &keys::UNIT,
];

/// Words that mean something in a specification alone.
const WORDS: [&str; 6] = ["special", "variable", "fixed", "rw locked", "locked", "stored"];

/// Keys of the sections of objects; those of `[DeviceInfo]` and its like are in every file.
const OBJECT_KEYS: [&str; 10] = [
    "ParameterName",
    "ObjectType",
    "DataType",
    "AccessType",
    "DefaultValue",
    "ParameterValue",
    "PDOMapping",
    "LowLimit",
    "HighLimit",
    "SubNumber",
];

/// The parts of a text in backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// What of a text only the author of a specification knows.
fn word_of_specifications(text: &str) -> Option<String> {
    let keys: BTreeSet<&str> = CHAPTERS.iter().flat_map(|chapter| chapter.keys).map(|key| key.name).collect();
    let is_key = |part: &str| {
        let words = |c: char| !(c.is_ascii_alphanumeric() || matches!(c, '-' | ':'));
        part.split(words).any(|word| word.strip_suffix(':').is_some_and(|key| keys.contains(key)))
    };
    let in_quotes = quoted(text).find(|part| is_key(part) || WORDS.contains(part)).map(str::to_owned);
    let plain = ["feature `", "cia301", "cia402", "library", "specification"];
    in_quotes.or_else(|| plain.into_iter().find(|word| text.contains(word)).map(str::to_owned))
}

/// What of a text only the owner of an EDS knows.
fn word_of_eds(text: &str) -> Option<String> {
    let empty = Language::Dcf.whole("");
    let of_device = empty.lines().filter_map(|line| Some(line.split_once('=')?.0));
    let keys: BTreeSet<&str> = of_device.chain(OBJECT_KEYS).chain(["ObjFlags"]).collect();
    let is_section = |part: &str| {
        let name = part.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        name.is_some_and(|name| name.chars().all(|c| c.is_ascii_alphanumeric()))
    };
    let is_key = |part: &str| is_section(part) || keys.contains(part.split('=').next().unwrap_or(part));
    quoted(text).find(|part| is_key(part)).map(str::to_owned)
}

/// The texts of a finding.
fn texts(finding: &Diagnostic) -> impl Iterator<Item = &str> {
    let labels = finding.labels.iter().map(|label| label.text.as_str());
    let notes = finding.notes.iter().map(String::as_str);
    [finding.message.as_str()].into_iter().chain(finding.help.as_deref()).chain(labels).chain(notes)
}

fn foreign_words(found: &Diagnostics, word: fn(&str) -> Option<String>) -> String {
    let mut wrong = String::new();
    for finding in found {
        for text in texts(finding) {
            if let Some(word) = word(text) {
                let _ = write!(wrong, "\n{}: `{word}` in: {text}", finding.code);
            }
        }
    }
    wrong
}

/// An object of one value.
fn var(index: u16, name: &str, data_type: u8, access: &str, more: &str) -> String {
    format!(
        "[{index:X}]\nParameterName={name}\nObjectType=0x7\nDataType=0x{data_type:04X}\nAccessType={access}\n{more}\n\n"
    )
}

/// An ARRAY (8) or RECORD (9) with sub-index 0 and others: type, access and further keys of each.
fn structured(index: u16, kind: u8, zero: (&str, &str), subs: &[(u8, &str, &str)]) -> String {
    let mut text = format!(
        "[{index:X}]\nParameterName=object {index:X}\nObjectType=0x{kind}\nSubNumber={}\n\n[{index:X}sub0]\nParameterName=highest\nDataType=0x0005\nAccessType={}\n{}\n\n",
        subs.len() + 1,
        zero.0,
        zero.1
    );
    for (at, (data_type, access, more)) in subs.iter().enumerate() {
        let sub = at + 1;
        let _ = write!(
            text,
            "[{index:X}sub{sub}]\nParameterName=entry {sub}\nDataType=0x{data_type:04X}\nAccessType={access}\n{more}\n\n"
        );
    }
    text
}

/// A PDO of two objects: COB-ID and its access, transmission type, number of mapped entries and its access, mapped entries.
struct Pdo<'t> {
    index: u16,
    cob_id: (&'t str, &'t str),
    transmission: &'t str,
    count: (&'t str, &'t str),
    mapped: &'t [(&'t str, &'t str)],
}

/// TPDO 1, which maps 2000h.
const TPDO: Pdo<'_> = Pdo {
    index: 0x1800,
    cob_id: ("rw", "$NODEID+0x180"),
    transmission: "255",
    count: ("rw", "1"),
    mapped: &[("rw", "0x20000008")],
};
/// RPDO 1, which maps 2001h.
const RPDO: Pdo<'_> =
    Pdo { index: 0x1400, cob_id: ("rw", "$NODEID+0x200"), mapped: &[("rw", "0x20010008")], ..TPDO };

impl Pdo<'_> {
    fn text(&self) -> String {
        let default = |value: &str| format!("DefaultValue={value}");
        let (cob_id, transmission) = (default(self.cob_id.1), default(self.transmission));
        let communication = structured(
            self.index,
            9,
            ("const", "DefaultValue=2"),
            &[(7, self.cob_id.0, &cob_id), (5, "rw", &transmission)],
        );
        let values: Vec<String> = self.mapped.iter().map(|(_, value)| default(value)).collect();
        let mapped: Vec<(u8, &str, &str)> = self
            .mapped
            .iter()
            .zip(&values)
            .map(|((access, _), value)| (7, *access, value.as_str()))
            .collect();
        let count = default(self.count.1);
        communication + &structured(self.index + 0x200, 9, (self.count.0, &count), &mapped)
    }
}

/// The communication parameters of a PDO with an inhibit time and an event timer.
fn pdo_with_times(index: u16, transmission: &str) -> String {
    let transmission = format!("DefaultValue={transmission}");
    let (time, reserved) = ((6, "rw", "DefaultValue=100"), (5, "rw", ""));
    let subs = [(7, "rw", "DefaultValue=$NODEID+0x80000180"), (5, "rw", &transmission), time, reserved, time];
    structured(index, 9, ("const", "DefaultValue=5"), &subs)
}

/// The communication parameters of a PDO that begins with SYNC 3, next to other objects.
fn pdo_with_sync_start(index: u16, transmission: &str, others: &str) -> String {
    let transmission = format!("DefaultValue={transmission}");
    let subs = [
        (7, "rw", "DefaultValue=$NODEID+0x80000180"),
        (5, "rw", &transmission),
        (6, "rw", "DefaultValue=0"),
        (5, "rw", ""),
        (6, "rw", "DefaultValue=0"),
        (5, "rw", "DefaultValue=3"),
    ];
    others.to_owned() + &structured(index, 9, ("const", "DefaultValue=6"), &subs)
}

/// Entries that PDOs map.
fn levels() -> String {
    var(0x2000, "level", 5, "ro", "PDOMapping=1") + &var(0x2001, "set level", 5, "rww", "PDOMapping=1")
}

fn info(keys: &str) -> String {
    format!("[DeviceInfo]\n{keys}\n; ...\n\n")
}

/// Faults in EDS texts, by the code of what is said about them; some have several things wrong with them.
fn faults() -> Vec<(&'static str, String)> {
    let default = |value: &str| format!("DefaultValue={value}");
    let level = |more: &str| var(0x2000, "level", 5, "rw", more);
    let pdo = |pdo: Pdo<'_>| levels() + &pdo.text();
    let element = (5, "ro", "");
    let in_pdo = "PDOMapping=1";
    let comment = |text: &str, object: String| format!(";{text}\n{object}");
    vec![
        ("OD0303", level("") + &var(0x2001, "level", 5, "ro", "")),
        ("OD0303", var(0x2000, "unsigned8", 5, "ro", "")),
        ("OD0303", var(0x2001, "object 2000.entry 1", 5, "ro", "") + &structured(0x2000, 8, ("const", "DefaultValue=1"), &[element])),
        ("OD0303", structured(0x2000, 8, ("const", "DefaultValue=1"), &[element]).replace("=highest", "=entry 1")),
        ("OD0846", var(0x2000, "level 温度", 5, "rw", "")),
        ("OD0502", pdo(Pdo { mapped: &[("rw", "0x20990008")], ..TPDO })),
        ("OD0313", structured(0x2000, 8, ("const", "DefaultValue=3"), &[element])),
        ("OD0417", structured(0x2000, 8, ("wo", "DefaultValue=1"), &[element])),
        ("OD0314", structured(0x2000, 8, ("const", "DefaultValue=0"), &[])),
        ("OD0315", structured(0x2000, 8, ("const", "DefaultValue=2"), &[element, (6, "ro", "")])),
        ("OD0316", var(0xC000, "level", 5, "ro", "")),
        ("OD0318", var(0x2000, "speed = 0", 5, "ro", "")),
        ("OD0318", info("ProductName=a # b\nOrderCode=a = b\nVendorName=a # b") + &level("")),
        ("OD0319", var(0x2000, "label", 9, "rw", "DefaultValue=a = b")),
        ("OD0320", var(0x1001, "error register", 7, "ro", "")),
        ("OD0320", var(0x1018, "identity", 7, "ro", "")),
        ("OD0321", structured(0x1016, 8, ("const", "DefaultValue=0"), &[])),
        ("OD0321", structured(0x1018, 9, ("const", "DefaultValue=5"), &[(7, "ro", "DefaultValue=1"); 5])),
        ("OD0322", var(0x1021, "store EDS", 15, "ro", "")),
        ("OD0323", level("") + "[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n\n"),
        ("OD0404", level(&default("300"))),
        ("OD0404", level(&default("$NODEID+0x180"))),
        ("OD0406", level("DefaultValue=120\nHighLimit=100")),
        ("OD0407", level("LowLimit=100\nHighLimit=1")),
        ("OD0404", level("HighLimit=300")),
        ("OD0414", comment("writable only when unlocked for service", var(0x2000, "level", 5, "const", &default("1")))),
        ("OD0415", comment("stored with the application parameters", var(0x2000, "level", 5, "const", &default("1")))),
        ("OD0416", var(0x2000, "label", 9, "ro", in_pdo)),
        ("OD0502", level("") + &TPDO.text()),
        ("OD0502", level("") + &Pdo { mapped: &[("rw", "0x20000008")], ..RPDO }.text()),
        ("OD0502", pdo(Pdo { mapped: &[("rw", "0x20000010")], ..TPDO })),
        ("OD0502", pdo(Pdo { mapped: &[("rw", "0x1A000008")], ..TPDO })),
        ("OD0503", pdo(Pdo { cob_id: ("rw", "0x7"), ..TPDO })),
        ("OD0503", var(0x1014, "COB-ID EMCY", 7, "rw", &default("0x7"))),
        ("OD0504", pdo(Pdo { cob_id: ("rw", "$NODEID+0x180"), ..RPDO }) + &TPDO.text()),
        ("OD0505", pdo(Pdo { transmission: "245", ..TPDO })),
        ("OD0506", pdo(Pdo { mapped: &[("rw", "0x00050008")], ..RPDO })),
        ("OD0506", pdo(Pdo { mapped: &[("rw", "0x00050008")], ..TPDO })),
        ("OD0507", pdo(Pdo { count: ("rw", "9"), mapped: &[("rw", "0x20000008"); 9], ..TPDO })),
        ("OD0508", pdo(Pdo { count: ("rw", "2"), ..TPDO })),
        ("OD0508", pdo(Pdo { count: ("rw", "2"), mapped: &[("rw", "0x20000008"), ("rw", "0")], ..TPDO })),
        ("OD0508", pdo(Pdo { count: ("ro", "0"), mapped: &[("ro", "0")], ..TPDO })),
        ("OD0508", info("Granularity=16") + &pdo(TPDO)),
        ("OD0508", pdo(Pdo { cob_id: ("rw", "0x40000205"), ..RPDO })),
        ("OD0509", info("Granularity=0") + &pdo(TPDO)),
        ("OD0509", pdo(Pdo { count: ("ro", "1"), mapped: &[("ro", "0x20000008")], ..TPDO })),
        ("OD0509", "[DummyUsage]\nDummy0001=1\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0\n\n".to_owned() + &level("")),
        ("OD0510", structured(0x1003, 8, ("rw", "DefaultValue=1"), &[(7, "ro", "")])),
        ("OD0510", structured(0x1016, 8, ("const", "DefaultValue=2"), &[(7, "rw", "DefaultValue=0x50064"); 2])),
        ("OD0511", pdo(Pdo { count: ("rw", "254"), ..TPDO })),
        ("OD0512", pdo(Pdo { mapped: &[("ro", "0x20000008")], ..TPDO })),
        ("OD0516", pdo(Pdo { cob_id: ("rw", "$NODEID+0x40000180"), transmission: "253", ..TPDO })),
        ("OD0602", info("BaudRate_125=0") + &level("")),
        ("OD0611", info("VendorNumber=5") + &structured(0x1018, 9, ("const", "DefaultValue=1"), &[(7, "ro", "DefaultValue=6")])),
        ("OD0801", level("")),
        ("OD0802", levels()),
        ("OD0803", level("")),
        ("OD0804", info("LSS_Supported=1") + &structured(0x1018, 9, ("const", "DefaultValue=1"), &[(7, "ro", "DefaultValue=1")])),
        ("OD0805", var(0x2000, "level", 5, "const", "")),
        ("OD0807", var(0x2000, "gain", 8, "rw", &default("1.5"))),
        ("OD0809", comment("stored with the application parameters", level(""))),
        ("OD0810", var(0x1001, "error register", 5, "ro", &default("0x40"))),
        ("OD0812", var(0x1000, "device type", 7, "rw", "")),
        ("OD0812", var(0x1008, "device name", 9, "wo", "")),
        ("OD0812", var(0x1017, "heartbeat", 6, "rw", in_pdo)),
        ("OD0813", var(0x1004, "reserved", 7, "ro", "")),
        ("OD0814", pdo(Pdo { transmission: "1", ..TPDO })),
        ("OD0814", var(0x1005, "COB-ID SYNC", 7, "rw", &default("0x40000080"))),
        ("OD0815", var(0x1014, "COB-ID EMCY", 7, "rw", &default("0x123"))),
        ("OD0815", structured(0x1200, 9, ("const", "DefaultValue=3"), &[(7, "ro", "DefaultValue=$NODEID+0x600"), (7, "ro", "DefaultValue=$NODEID+0x580"), (5, "ro", "")])),
        ("OD0816", structured(0x1010, 8, ("const", "DefaultValue=1"), &[(7, "rw", "DefaultValue=1")])),
        ("OD0817", var(0x1000, "device type", 7, "ro", &default("0x192"))),
        ("OD0817", var(0x1000, "device type", 7, "ro", &default("0xFFFF0191"))),
        ("OD0818", structured(0x2000, 8, ("rw", "DefaultValue=1"), &[element])),
        ("OD0818", structured(0x2000, 8, ("ro", "DefaultValue=1\nPDOMapping=1"), &[element])),
        ("OD0819", pdo(Pdo { count: ("rw", "2"), mapped: &[("rw", "0x20000008"); 2], ..TPDO })),
        ("OD0820", pdo(Pdo { cob_id: ("ro", "$NODEID+0x180"), ..TPDO })),
        ("OD0821", info("VendorNumber=0") + &level("")),
        ("OD0822", structured(0x2000, 8, ("const", "DefaultValue=2"), &[element, (5, "rw", "")])),
        ("OD0822", structured(0x2000, 8, ("const", "DefaultValue=2"), &[element, (5, "ro", in_pdo)])),
        ("OD0822", structured(0x2000, 8, ("const", "DefaultValue=2"), &[(5, "rw", ""), (5, "rw", "DefaultValue=1")])),
        ("OD0823", pdo(Pdo { cob_id: ("rw", "0x185"), ..TPDO })),
        ("OD0823", pdo(Pdo { cob_id: ("rw", "$NODEID+0x180"), ..RPDO })),
        ("OD0823", pdo(Pdo { index: 0x1804, cob_id: ("rw", "$NODEID+0x1C0"), ..TPDO })),
        ("OD0825", var(0x2000, "level", 5, "wo", &default("1"))),
        ("OD0826", var(0x2000, "level", 0x16, "ro", "")),
        ("OD0827", info("GroupMessaging=1") + &level("")),
        ("OD0827", info("GroupMessaging=1") + &pdo(Pdo { count: ("ro", "1"), ..TPDO })),
    ]
}

/// Faults of PDOs in time.
fn faults_of_times() -> Vec<(&'static str, String)> {
    let counter = |value: &str| var(0x1019, "counter", 5, "rw", &format!("DefaultValue={value}"));
    vec![
        ("OD0824", pdo_with_times(TPDO.index, "1")),
        ("OD0824", pdo_with_times(TPDO.index, "253")),
        ("OD0824", pdo_with_times(RPDO.index, "255")),
        ("OD0824", pdo_with_times(TPDO.index, "255").replacen("DefaultValue=100", "DefaultValue=2000", 1)),
        (
            "OD0878",
            info("BaudRate_125=0\nBaudRate_20=1") + &var(0x1017, "heartbeat time", 6, "rw", "DefaultValue=1"),
        ),
        ("OD0836", pdo_with_sync_start(TPDO.index, "1", "")),
        ("OD0836", pdo_with_sync_start(TPDO.index, "1", &counter("2"))),
        ("OD0836", pdo_with_sync_start(TPDO.index, "254", "")),
        ("OD0836", pdo_with_sync_start(RPDO.index, "1", "")),
    ]
}

/// Faults of services and of profiles.
fn faults_of_services() -> Vec<(&'static str, String)> {
    let drive = "DefaultValue=0x20192";
    let io_module = "DefaultValue=0x20191";
    vec![
        ("OD0844", var(0x1000, "device type", 7, "ro", io_module) + &var(0x6000, "inputs", 5, "ro", "")),
        ("OD0831", var(0x1000, "device type", 7, "ro", drive) + &var(0x607A, "target position", 7, "rw", "")),
        ("OD0831", var(0x1000, "device type", 7, "ro", drive) + &var(0x6041, "statusword", 6, "rw", "")),
        ("OD0830", var(0x2000, "gain", 0x11, "rw", "DefaultValue=0.10000000000000000001")),
        (
            "OD0839",
            var(0x1000, "device type", 7, "ro", drive) + &var(0x6502, "modes", 7, "ro", "DefaultValue=0x20"),
        ),
        (
            "OD0840",
            var(0x1000, "device type", 7, "ro", drive)
                + &var(0x6060, "mode", 2, "rw", "DefaultValue=6")
                + &var(0x6502, "modes", 7, "ro", "DefaultValue=0"),
        ),
        ("OD0319", var(0x2000, "label", 9, "rw", "DefaultValue=$NODEID+1")),
        (
            "OD0510",
            structured(
                0x1010,
                8,
                ("const", "DefaultValue=1"),
                &[(7, "rw", "DefaultValue=0x65766173\nObjFlags=1")],
            ),
        ),
        ("OD0510", structured(0x1029, 8, ("const", "DefaultValue=1"), &[(5, "rw", "DefaultValue=7")])),
        ("OD0828", structured(0x1016, 8, ("const", "DefaultValue=1"), &[(7, "rw", "DefaultValue=1000")])),
        (
            "OD0829",
            structured(
                0x1280,
                9,
                ("const", "DefaultValue=3"),
                &[
                    (7, "rw", "DefaultValue=0x606"),
                    (7, "rw", "DefaultValue=0x587"),
                    (5, "rw", "DefaultValue=6"),
                ],
            ),
        ),
        ("OD0830", var(0x2000, "gain", 8, "rw", "DefaultValue=16777217")),
    ]
}

/// Faults of what belongs together: conditions, areas, objects that act on others, ranges, drives.
fn faults_of_relations() -> Vec<(&'static str, String)> {
    let default = |value: &str| format!("DefaultValue={value}");
    let drive = |object: String| var(0x1000, "device type", 7, "ro", "DefaultValue=0x20192") + &object;
    let word = |index: u16, value: &str| var(index, &format!("object {index:X}"), 6, "rw", &default(value));
    let long = |index: u16, value: &str| var(index, &format!("object {index:X}"), 7, "rw", &default(value));
    let array = |index: u16, element: (u8, &str, &str), count: usize| {
        structured(index, 8, ("const", &default(&count.to_string())), &vec![element; count])
    };
    vec![
        ("OD0803", var(0x1017, "heartbeat", 6, "ro", "DefaultValue=0")),
        (
            "OD0831",
            var(0x1000, "device type", 7, "ro", "DefaultValue=0x10191") + &array(0x6000, (6, "ro", ""), 1),
        ),
        (
            "OD0880",
            ";writable only while 0x2001 == 300\n".to_owned()
                + &var(0x2000, "level", 5, "rw", "DefaultValue=0")
                + &var(0x2001, "mode", 5, "rw", "DefaultValue=0"),
        ),
        (
            "OD0880",
            ";writable only while 0x2001 == 1\n".to_owned()
                + &var(0x2000, "level", 5, "rw", "DefaultValue=0")
                + ";writable only while 0x2000 == 1\n"
                + &var(0x2001, "mode", 5, "rw", "DefaultValue=0"),
        ),
        ("OD0884", ";stored with the application parameters\n".to_owned() + &word(0x1017, "0")),
        ("OD0886", long(0x1006, "10000") + &long(0x1007, "20000")),
        ("OD0886", long(0x1006, "10")),
        ("OD0887", word(0x1015, "0")),
        ("OD0888", array(0x1F50, (15, "rw", ""), 2) + &array(0x1F51, (5, "rw", ""), 1)),
        ("OD0889", var(0x1014, "COB-ID EMCY", 7, "const", "DefaultValue=$NODEID+0x80000080")),
        (
            "OD0891",
            drive(structured(
                0x607D,
                8,
                ("const", "DefaultValue=2"),
                &[(4, "rw", "DefaultValue=1000"), (4, "rw", "DefaultValue=-1000")],
            )),
        ),
        ("OD0892", drive(var(0x6502, "modes", 7, "ro", "DefaultValue=0"))),
        ("OD0893", drive(word(0x6040, "0xF"))),
        (
            "OD0895",
            word(0x1017, "1000")
                + &word(0x100C, "100")
                + &var(0x100D, "life time factor", 5, "rw", "DefaultValue=3"),
        ),
        (
            "OD0896",
            info("DynamicChannelsSupported=1")
                + "[DynamicChannels]\nNrOfSeg=1\nType1=0x0005\nDir1=ro\nRange1=0xA080-0xA0BF\nPPOffset1=0\n\n"
                + &var(0xA080, "level", 5, "ro", ""),
        ),
        ("OD0897", ";unit 0.1 degC from -2732 degC\n".to_owned() + &var(0x2000, "temperature", 5, "ro", "")),
    ]
}

/// The same for DCF texts: what is set.
fn faults_of_nodes() -> Vec<(&'static str, String)> {
    let set =
        |access: &str, more: &str| var(0x2000, "level", 5, access, &format!("{more}\nParameterValue=120"));
    let pdo = |sub: &str, value: &str| {
        let text = levels() + &TPDO.text();
        let start = text.find(&format!("[{sub}]")).unwrap_or_default();
        let end = start + text[start..].find("\n\n").unwrap_or_default();
        format!("{}\nParameterValue={value}{}", &text[..end], &text[end..])
    };
    vec![
        ("OD0403", ";0: off\n;1: on\n".to_owned() + &set("rw", "DefaultValue=0")),
        ("OD0404", set("rw", "").replace("=120", "=300")),
        ("OD0406", set("rw", "HighLimit=100")),
        ("OD0502", pdo("1A00sub1", "0x20010008")),
        ("OD0502", pdo("1A00sub1", "0x20990008")),
        ("OD0503", pdo("1800sub1", "0x7")),
        ("OD0505", pdo("1800sub2", "245")),
        ("OD0506", pdo("1A00sub1", "0x00050008")),
        ("OD0508", pdo("1A00sub0", "2")),
        ("OD0511", pdo("1A00sub0", "254")),
        ("OD0703", set("ro", "")),
        ("OD0704", ";writable only when unlocked for service\n".to_owned() + &set("ro", "")),
        ("OD0707", set("rw", "ObjFlags=1")),
        (
            "OD0710",
            ";writable only while 0x2001 == 1\n".to_owned()
                + &set("rw", "")
                + &var(0x2001, "mode", 5, "rw", "DefaultValue=0"),
        ),
        (
            "OD0838",
            ";writable only while 0x2001 == 120\n".to_owned()
                + &set("rw", "DefaultValue=0")
                + ";writable only while 0x2000 == 120\n"
                + &var(0x2001, "mode", 5, "rw", "DefaultValue=0\nParameterValue=120"),
        ),
        ("OD0814", pdo("1800sub2", "1")),
        ("OD0824", levels() + &pdo_with_times(TPDO.index, "255\nParameterValue=1")),
    ]
}

/// Rules that nothing in an EDS or DCF can break, and why.
const OUT_OF_REACH: [(&str, &str); 22] = [
    ("OD0420", "it has no views of other entries"),
    ("OD0601", "an EDS has keys for the bit rates of CiA 301 alone"),
    ("OD0606", "it has no conditions between entries"),
    ("OD0806", "it defines units and types where entries have them"),
    ("OD0808", "it has no list of error codes"),
    ("OD0837", "where it states no default, it says nothing about the start"),
    ("OD0843", "it has no conditions between entries"),
    ("OD0870", "it has no state machines"),
    ("OD0871", "it has no state machines"),
    ("OD0872", "it has no state machines"),
    ("OD0873", "it has no state machines"),
    ("OD0874", "it has no state machines"),
    ("OD0875", "it has no special values"),
    ("OD0876", "it has no list of error codes"),
    ("OD0877", "it has no list of error codes"),
    ("OD0879", "its PDOs are described in full"),
    ("OD0881", "it has no views of other entries"),
    ("OD0882", "its comments give a unit to numbers alone"),
    ("OD0883", "its comments state no base of a symbol"),
    ("OD0885", "it does not say which objects are of a profile"),
    ("OD0890", "it may be that of one device, which has a serial number"),
    ("OD0898", "tools distinguish its objects by their indices"),
];

#[test]
fn an_eds_is_spoken_of_in_its_own_words() {
    let mut wrong = String::new();
    let eds = faults()
        .into_iter()
        .chain(faults_of_times())
        .chain(faults_of_services())
        .chain(faults_of_relations())
        .map(|(code, text)| (Language::Eds, code, text));
    let dcf = faults_of_nodes().into_iter().map(|(code, text)| (Language::Dcf, code, text));
    for (language, code, text) in eds.chain(dcf) {
        let mut sources = SourceMap::new();
        let file = sources.add(language.file_name(), language.whole(&text));
        let found = compile_as(Strictness::Standard, &mut sources, file, &mut NoFiles).diagnostics;
        if !found.iter().any(|finding| finding.code.id == code) {
            let _ = write!(wrong, "\n{code} is not said about:\n{text}");
        }
        wrong.push_str(&foreign_words(&found, word_of_specifications));
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_rule_is_tried_with_an_eds() {
    let all = faults()
        .into_iter()
        .chain(faults_of_times())
        .chain(faults_of_services())
        .chain(faults_of_relations())
        .chain(faults_of_nodes());
    let tried: BTreeSet<&str> = all.map(|(code, _)| code).collect();
    for rule in rules() {
        let is_out_of_reach = OUT_OF_REACH.iter().any(|(code, _)| *code == rule.id);
        assert_ne!(tried.contains(rule.id), is_out_of_reach, "{rule}");
    }
}

#[test]
fn a_specification_is_spoken_of_in_its_own_words() {
    for example in rules().filter_map(|rule| rule.example) {
        let wrong = foreign_words(&said_of_example(example.before), word_of_eds);
        assert!(wrong.is_empty(), "{wrong}");
    }
}

/// The guards see what they are there for.
#[test]
fn words_of_either_side_are_recognised() {
    for text in
        ["add `bit-rates:`, or not", "make it `special`", "`0x1000: {from: cia301}`", "the feature `drive`"]
    {
        assert!(word_of_specifications(text).is_some(), "{text}");
        assert!(word_of_eds(text).is_none(), "{text}");
    }
    for text in ["correct `DefaultValue`", "write `BaudRate_125=1`", "in `[DeviceInfo]`", "`Dummy0005=1`"] {
        assert!(word_of_eds(text).is_some(), "{text}");
        assert!(word_of_specifications(text).is_none(), "{text}");
    }
}
