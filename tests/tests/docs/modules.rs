//! The modules that a bus coupler takes are a table of the device.

use od_documents::{self as docs, Format, Templates};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

/// The Markdown page of the device in an EDS.
fn page(eds: &str) -> String {
    let mut sources = SourceMap::new();
    let root = sources.add("coupler.eds", eds);
    let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
    let templates = [Templates::new(Some(Format::Markdown), &[]).unwrap()];
    let options = docs::options(&system, &[], None);
    let files = docs::artifacts(&system, "", "coupler", &options, &templates).unwrap();
    let page = files.into_iter().find(|file| file.path.ends_with("/coupler.md")).unwrap();
    String::from_utf8(page.bytes).unwrap()
}

#[test]
fn the_modules_of_a_coupler_are_a_table() {
    let coupler = "[DeviceInfo]\nProductName=Coupler\n[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n";
    let modules = "[M1ModuleInfo]\nProductName=8 inputs\nOrderCode=DI8\n\
        [M1FixedObjects]\nNrOfEntries=1\n1=0x6005\n\
        [M1Fixed6005]\nParameterName=interrupt\nDataType=0x0001\nAccessType=rw\n\
        [M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
        [M1SubExt6000]\nParameterName=input\nDataType=5\nAccessType=ro\nCount=1\n";
    let page_with = page(&format!("{coupler}{modules}"));
    let row = page_with.lines().find(|line| line.contains("DI8")).unwrap_or_else(|| panic!("{page_with}"));
    let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
    assert_eq!(cells, ["1", "8 inputs", "DI8", "6005h", "6000h"]);
    assert!(!page(coupler).contains("Order code | Brings"));
}
