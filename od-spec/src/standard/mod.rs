//! The shipped libraries, and the standards that they describe, for comparing an object with what CiA 301 and CiA 402 say about it: a
//! device may have written the object in full, without the library.
//!
//! For comparing, the texts are read once in a process, and only when something is compared. Places in them mean nothing to whoever
//! asks: they belong to sources of their own.

use std::sync::LazyLock;

use crate::ast::Spec;
use crate::decode::decode;
use crate::diag::Diagnostics;
use crate::model::{Dictionary, Entry, Index, Object, SubIndex};
use crate::resolve;
use crate::source::SourceMap;
use crate::yaml;

/// Libraries that come with the compiler: name and text.
pub const LIBRARIES: &[(&str, &str)] = &[
    ("cia301", include_str!("../../profiles/cia301.od.yaml")),
    ("cia402", include_str!("../../profiles/cia402.od.yaml")),
];

/// The library of CiA 301.
pub(crate) const CIA301: &str = "cia301";
/// The library of CiA 402.
const CIA402: &str = "cia402";
/// The feature of `cia402` that every drive has.
const DRIVE: &str = "drive";

/// Objects of CiA 301 that come in runs and are in no library, each described by its first one.
const RUNS: &str = include_str!("runs.od.yaml");

static COMMUNICATION: LazyLock<[Option<Dictionary>; 2]> = LazyLock::new(|| {
    [shipped(CIA301).and_then(read), read(RUNS)].map(|spec| spec.as_ref().and_then(dictionary))
});

static DRIVE_OBJECTS: LazyLock<Vec<Index>> = LazyLock::new(|| {
    let library = shipped(CIA402).and_then(read);
    let features = library.iter().flat_map(|library| &library.features);
    let drive = features.filter(|feature| feature.name.value == DRIVE);
    drive.flat_map(|feature| feature.objects.iter().map(|index| index.value)).collect()
});

fn shipped(name: &str) -> Option<&'static str> {
    LIBRARIES.iter().find(|(library, _)| *library == name).map(|(_, text)| *text)
}

fn read(text: &str) -> Option<Spec> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("standard", text);
    let node = yaml::parse(file, sources.file(file), &mut diagnostics)?;
    Some(decode(&node, &mut diagnostics)).filter(|_| !diagnostics.has_errors())
}

fn dictionary(spec: &Spec) -> Option<Dictionary> {
    let mut diagnostics = Diagnostics::new();
    let library = resolve::resolve(spec, &[], &mut diagnostics).library;
    library.filter(|_| !diagnostics.has_errors())
}

/// The object that CiA 301 defines at an index; for one of a run, the first of the run.
pub(crate) fn object(index: Index) -> Option<&'static Object> {
    let first = match index.0 {
        0x1201..=0x127F => 0x1201,
        0x1280..=0x12FF => 0x1280,
        0x1400..=0x15FF => 0x1400,
        0x1600..=0x17FF => 0x1600,
        0x1800..=0x19FF => 0x1800,
        0x1A00..=0x1BFF => 0x1A00,
        0x1FA0..=0x1FCF => 0x1FA0,
        0x1FD0..=0x1FFF => 0x1FD0,
        single => single,
    };
    COMMUNICATION.iter().flatten().find_map(|dictionary| dictionary.objects.get(&Index(first)))
}

/// Whether the library `cia301` has the object at an index.
pub(crate) fn is_in_library(index: Index) -> bool {
    COMMUNICATION[0].as_ref().is_some_and(|library| library.objects.contains_key(&index))
}

/// What CiA 301 says about the entry of an object at a sub-index: an array goes on as its last element that is described.
pub(crate) fn entry(object: &'static Object, sub: SubIndex) -> Option<&'static Entry> {
    let goes_on = object.kind == crate::model::ObjectKind::Array && sub.0 > 0;
    object.entry(sub).or_else(|| object.entries.last().filter(|_| goes_on))
}

/// The objects that every drive of CiA 402 has.
pub(crate) fn of_every_drive() -> &'static [Index] {
    &DRIVE_OBJECTS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_standards_are_read_without_a_remark() {
        assert!(COMMUNICATION.iter().all(Option::is_some));
        assert_eq!(of_every_drive().first(), Some(&Index(0x603F)));
    }

    #[test]
    fn objects_of_a_run_are_described_by_its_first() {
        let index = |index: u16| object(Index(index)).map(|object| object.index.0);
        assert_eq!(index(0x1017), Some(0x1017));
        assert_eq!(index(0x1200), Some(0x1200));
        for (first, last) in [
            (0x1201, 0x127F),
            (0x1280, 0x12FF),
            (0x1400, 0x15FF),
            (0x1600, 0x17FF),
            (0x1800, 0x19FF),
            (0x1A00, 0x1BFF),
            (0x1FA0, 0x1FCF),
            (0x1FD0, 0x1FFF),
        ] {
            assert_eq!((index(first), index(last)), (Some(first), Some(first)));
        }
        for nothing in [0x1004, 0x1300, 0x1C00, 0x1F9F, 0x2000, 0x6040] {
            assert_eq!(index(nothing), None, "{nothing:04X}h");
        }
    }

    #[test]
    fn an_array_goes_on_as_it_ends_and_a_record_does_not() {
        let name = |index: u16, sub: u8| {
            let object = object(Index(index)).unwrap();
            entry(object, SubIndex(sub)).map(|entry| entry.name.as_str())
        };
        assert_eq!(name(0x1016, 90), Some("Consumer heartbeat time 1"));
        assert_eq!(name(0x1018, 4), Some("Serial number"));
        assert_eq!(name(0x1018, 5), None);
        assert_eq!(name(0x1017, 1), None);
    }
}
