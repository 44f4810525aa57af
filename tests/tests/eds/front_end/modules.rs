//! Bus couplers: what they are without modules, and what they are with some.

use od_formats::eds::{write_dcf, write_eds};
use od_spec::eds::codes::UNKNOWN_MODULE;
use od_spec::model::{Dictionary, EntryId, Index, SubIndex, Value};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile_with_modules};

use super::{compiled, device};

fn entry(section: &str, data_type: u8, access: &str, value: &str) -> String {
    format!(
        "[{section}]\nParameterName={section}\nObjectType=7\nDataType={data_type}\nAccessType={access}\nDefaultValue={value}\nPDOMapping=0\n"
    )
}

/// An extension that adds a sub-index with each module.
fn extension(module: u8, index: &str, data_type: u8, value: &str, count: &str) -> String {
    format!(
        "[M{module}SubExt{index}]\nParameterName=of module \nObjectType=7\nDataType={data_type}\nAccessType=ro\n\
         DefaultValue={value}\nPDOMapping=1\n{count}\n"
    )
}

/// A bus coupler for digital inputs, which maps those of its first module.
fn coupler() -> String {
    let modules = [1, 2].map(|module| {
        let count = if module == 1 { "Count=2" } else { "Count=0;4" };
        format!(
            "[M{module}ModuleInfo]\nProductName={module}\nProductVersion=1\nProductRevision=0\nOrderCode=DI{module}\n\
             [M{module}SubExtends]\nNrOfEntries=2\n1=0x1027\n2=0x6000\n{}{}",
            extension(module, "1027", 6, &format!("0xA00{module}"), "Count=1"),
            extension(module, "6000", 5, "0", count)
        )
    });
    [
        "[DeviceInfo]\nVendorNumber=7\nProductName=Coupler\nGranularity=8\nBaudRate_125=1\nNrOfTXPDO=1\n"
            .to_owned(),
        entry("1000", 7, "ro", "0x10191"),
        "[1027]\nParameterName=Module list\nObjectType=8\nSubNumber=1\n".to_owned(),
        entry("1027sub0", 5, "ro", "0"),
        "[1800]\nParameterName=TPDO\nObjectType=9\nSubNumber=3\n".to_owned(),
        entry("1800sub0", 5, "const", "2"),
        entry("1800sub1", 7, "rw", "$NODEID+0x180"),
        entry("1800sub2", 5, "rw", "255"),
        "[1A00]\nParameterName=mapping\nObjectType=9\nSubNumber=2\n".to_owned(),
        entry("1A00sub0", 5, "rw", "1"),
        entry("1A00sub1", 7, "rw", "0x60000108"),
        "[SupportedModules]\nNrOfEntries=2\n".to_owned(),
        modules.concat(),
    ]
    .concat()
}

fn codes(compiled: &Compiled) -> Vec<&str> {
    let about_objects = compiled.diagnostics.iter().filter(|found| !found.code.id.starts_with("EDS"));
    about_objects.map(|found| found.code.id).collect()
}

/// Default values of the sub-indices of an object.
fn values(device: &Dictionary, index: u16) -> Vec<Option<i128>> {
    let object = &device.objects[&Index(index)];
    object.entries.iter().map(|entry| entry.default.as_ref().and_then(Value::integer)).collect()
}

fn plugged(text: &str, modules: &[u32]) -> Compiled {
    let mut sources = SourceMap::new();
    let root = sources.add("coupler.eds", text);
    compile_with_modules(&mut sources, root, &mut NoFiles, modules)
}

#[test]
fn a_coupler_lacks_nothing_that_its_modules_bring() {
    let text = coupler();
    let without = [
        "OD0314", "OD0321", // 1027h without an element
        "OD0502", // a mapping of 6000h.1
        "OD0844", // a device type with digital inputs
    ];
    let (alone, _) = compiled("coupler.eds", &text);
    let found = codes(&alone);
    assert!(found.iter().all(|code| !without.contains(code)), "{found:?}");
    // It does not, where no module brings them.
    let plain = text.split("[SupportedModules]").next().unwrap();
    let (plain, _) = compiled("coupler.eds", plain);
    let found = codes(&plain);
    assert!(["OD0314", "OD0321", "OD0844"].iter().all(|code| found.contains(code)), "{found:?}");
}

#[test]
fn modules_are_counted_in_sub_index_0() {
    let connected = "[ConnectedModules]\nNrOfEntries=3\n1=2\n2=1\n3=2\n";
    let of_dcf = device("coupler.dcf", &format!("{}{connected}", coupler()));
    let plugged_in = plugged(&coupler(), &[2, 1, 2]).system.unwrap().devices.remove(0);
    for device in [of_dcf, plugged_in] {
        assert_eq!(values(&device, 0x1027), [3, 0xA002, 0xA001, 0xA002].map(Some));
        assert_eq!(values(&device, 0x6000), [3, 0, 0, 0].map(Some));
    }
}

/// A DCF may have the sub-indices of the modules in full, with their values, or leave them to its reader.
#[test]
fn a_dcf_with_modules_is_read_as_it_was_written() {
    for (text, with_list) in [(coupler(), true), (coupler().replace("1027", "2027"), false)] {
        let whole = plugged(&text, &[1, 2]);
        let system = whole.system.unwrap();
        let node = od_spec::Commissioning::of_node(&system.devices[0], 5);
        let dcf = write_dcf(&system, &system.devices[0], &node, "coupler.dcf");
        let dcf = String::from_utf8(dcf).unwrap();
        assert!(dcf.contains("[ConnectedModules]\r\nNrOfEntries=2\r\n1=1\r\n2=2\r\n"), "{dcf}");
        let (read, _) = compiled("coupler.dcf", &dcf);
        assert!(!codes(&read).contains(&"OD0321"));
        let again = read.system.unwrap();
        if with_list {
            assert_eq!(values(&again.devices[0], 0x1027), [2, 0xA001, 0xA002].map(Some));
        }
        assert_eq!(values(&again.devices[0], 0x6000), [3, 0, 0, 0].map(Some));
        let node = read.node.unwrap().at(None);
        let again = write_dcf(&again, &again.devices[0], &node, "coupler.dcf");
        assert_eq!(String::from_utf8(again).unwrap(), dcf);
    }
}

#[test]
fn sub_indices_of_the_coupler_come_before_those_of_modules() {
    let own = format!(
        "[6000]\nParameterName=inputs\nObjectType=8\nSubNumber=2\n{}{}",
        entry("6000sub0", 5, "ro", "1"),
        entry("6000sub1", 5, "ro", "3")
    );
    let whole = plugged(&format!("{}{own}", coupler()), &[1]).system.unwrap();
    let device = &whole.devices[0];
    assert_eq!(values(device, 0x6000), [Some(3), Some(3), Some(0), Some(0)]);
    let of_coupler = device.entry(EntryId { index: Index(0x6000), sub: SubIndex(1) }).unwrap();
    assert_eq!(of_coupler.name, "6000sub1");
}

/// What is mapped and not there ends a mapping.
#[test]
fn a_mapping_ends_before_what_no_module_brings() {
    let more = coupler()
        .replace(
            "[1A00sub0]\nParameterName=1A00sub0\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=1",
            "[1A00sub0]\nParameterName=1A00sub0\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=3",
        )
        .replace(
            "[SupportedModules]",
            &format!(
                "{}{}[SupportedModules]",
                entry("1A00sub2", 7, "rw", "0x60000208"),
                entry("1A00sub3", 7, "rw", "0x60000308")
            ),
        );
    let mapped = |modules: &[u32]| {
        let whole = plugged(&more, modules).system.unwrap();
        let device = &whole.devices[0];
        (values(device, 0x1A00)[0], device.pdos[0].map.len())
    };
    assert_eq!(
        [mapped(&[]), mapped(&[1]), mapped(&[2]), mapped(&[1, 2])],
        [(Some(3), 3), (Some(2), 2), (Some(1), 1), (Some(3), 3)]
    );
}

#[test]
fn module_sections_come_out_as_they_went_in() {
    let (read, _) = compiled("coupler.eds", &coupler());
    let system = read.system.unwrap();
    let eds = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap().replace("\r\n", "\n");
    let sections = |text: &str| {
        let start = text.find("[SupportedModules]").unwrap();
        text[start..]
            .lines()
            .filter(|line| !line.is_empty())
            .map(str::trim_end)
            .collect::<Vec<_>>()
            .join("\n")
    };
    assert_eq!(sections(&eds), sections(&coupler()));
}

#[test]
fn a_module_that_is_not_described_is_reported() {
    let (read, _) =
        compiled("coupler.dcf", &format!("{}[ConnectedModules]\nNrOfEntries=1\n1=9\n", coupler()));
    assert!(read.diagnostics.iter().any(|found| found.code == UNKNOWN_MODULE));
}
