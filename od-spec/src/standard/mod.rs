//! The shipped libraries, and the standards that they describe, for comparing an object with what CiA 301 says about it: a
//! device may have written the object in full, without the library.
//!
//! For comparing, the texts are read once in a process, and only when something is compared. Places in them mean
//! nothing to a caller that asks: they belong to other sources than the device's.

use std::sync::LazyLock;

use crate::ast::Spec;
use crate::check::standard::continued;
use crate::check::standard_objects::from_library::{CIA302, CIA401, CIA402};
use crate::check::{Rule, Rules, Standard};
use crate::decode::read_own;
use crate::diag::Diagnostics;
use crate::library::kept::kept;
use crate::library::shipped::{LIBRARIES, tree, unpacked};
use crate::model::{DataType, Dictionary, Index, Object, SubIndex};
use crate::resolve;
use crate::source::SourceMap;
use crate::wording::FileFormat;

/// Objects of CiA 301 that come in runs and are in no library, each described by its first one.
const RUNS: &str = include_str!("runs.od.yaml");
const TREE_OF_RUNS: &[u8] = include_bytes!("runs.tree");

static IN_LIBRARY: LazyLock<Option<Dictionary>> = LazyLock::new(|| shipped("cia301"));
/// Asked only for an object that is not the library's.
static OF_MANAGERS: LazyLock<Option<Dictionary>> = LazyLock::new(|| shipped(CIA302));
static OF_IO_MODULES: LazyLock<Option<Dictionary>> = LazyLock::new(|| shipped(CIA401));
static OF_DRIVES: LazyLock<Option<Dictionary>> = LazyLock::new(|| shipped(CIA402));
/// Apart from the library, which takes much longer to read: every device with PDOs asks for these.
static IN_RUNS: LazyLock<Option<Dictionary>> = LazyLock::new(runs);

fn shipped(name: &str) -> Option<Dictionary> {
    if let Some(library) = kept(name) {
        return resolved(&library);
    }
    let mut sources = SourceMap::new();
    let file = sources.add(name, LIBRARIES.iter().find(|(library, _)| *library == name)?.1);
    resolved(&read_own(&tree(name, file, &sources)?, &[]))
}

fn runs() -> Option<Dictionary> {
    let mut sources = SourceMap::new();
    let file = sources.add("runs", RUNS);
    resolved(&read_own(&unpacked(file, &sources, TREE_OF_RUNS)?, &[]))
}

fn resolved(spec: &Spec) -> Option<Dictionary> {
    let mut diagnostics = Diagnostics::new();
    let library = resolve::resolve(spec, &[], &mut diagnostics).library;
    library.filter(|_| !diagnostics.has_errors())
}

/// The object that CiA 301 defines at an index; for one of a run, the first of the run.
fn object(index: Index) -> Option<&'static Object> {
    let first = match index.0 {
        0x1201..=0x127F => 0x1201,
        0x1280..=0x12FF => 0x1280,
        0x1400..=0x15FF => 0x1400,
        0x1600..=0x17FF => 0x1600,
        0x1800..=0x19FF => 0x1800,
        0x1A00..=0x1BFF => 0x1A00,
        0x1FA0..=0x1FCF => 0x1FA0,
        0x1FD0..=0x1FFF => 0x1FD0,
        single @ 0x1000..=0x1FFF => return IN_LIBRARY.as_ref()?.objects.get(&Index(single)),
        _ => return None,
    };
    IN_RUNS.as_ref()?.objects.get(&Index(first))
}

/// The data type that CiA 301 gives an entry of an object with sub-indices, or without a sub-index an object that is one value.
pub(crate) fn data_type(index: Index, sub: Option<SubIndex>) -> Option<DataType> {
    let defined = || object(index).filter(|object| object.is_structured() == sub.is_some());
    match sub {
        // Of every object, also of a maker's.
        Some(SubIndex(0)) => Some(DataType::Unsigned8),
        Some(sub) => continued(defined()?, sub).map(|entry| entry.data_type),
        None => defined()?.entries.first().map(|entry| entry.data_type),
    }
}

/// Whether the library `cia301` has the object at an index.
fn is_in_library(index: Index) -> bool {
    IN_LIBRARY.as_ref().is_some_and(|library| library.objects.contains_key(&index))
}

/// The object that a library of another standard than CiA 301 has at an index, as the first axis has it.
fn in_library(library: &str, index: Index) -> Option<&'static Object> {
    let library = match library {
        CIA302 => &OF_MANAGERS,
        CIA401 => &OF_IO_MODULES,
        CIA402 => &OF_DRIVES,
        _ => return None,
    };
    library.as_ref()?.objects.get(&index)
}

/// All rules or some of them, with this standard to hold objects against.
pub(crate) const fn rules<'a>(list: &'a [&'a Rule]) -> Rules<'a> {
    Rules { list, standard: Standard { object, is_in_library, in_library }, format: FileFormat::Eds }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::decode;
    use crate::diag::Severity;
    use crate::yaml::parse;

    #[test]
    fn the_standards_are_read_without_a_remark() {
        assert!(IN_LIBRARY.is_some() && IN_RUNS.is_some());
        assert!(OF_MANAGERS.is_some() && OF_IO_MODULES.is_some() && OF_DRIVES.is_some());
        for (name, text) in LIBRARIES.iter().chain(&[("runs", RUNS)]) {
            let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
            let file = sources.add(*name, *text);
            let tree = parse(file, sources.file(file), &mut diagnostics).unwrap();
            decode(&tree, &mut diagnostics);
            // Texts that are in English alone are noted.
            let remarks = diagnostics.iter().filter(|one| one.severity() != Severity::Note);
            assert_eq!(remarks.count(), 0, "{name}: {diagnostics:?}");
        }
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
            continued(object, SubIndex(sub)).map(|entry| entry.name.as_str())
        };
        assert_eq!(name(0x1016, 90), Some("Consumer heartbeat time 1"));
        assert_eq!(name(0x1018, 4), Some("Serial number"));
        assert_eq!((name(0x1018, 5), name(0x1016, 0xFF)), (None, None));
        assert_eq!(name(0x1017, 1), None);
    }

    #[test]
    fn types_are_those_of_the_standard() {
        let of = |index: u16, sub: Option<u8>| data_type(Index(index), sub.map(SubIndex));
        assert_eq!(of(0x1017, None), Some(DataType::Unsigned16));
        assert_eq!(of(0x1003, Some(254)), Some(DataType::Unsigned32));
        assert_eq!(of(0x1A05, Some(64)), Some(DataType::Unsigned32));
        assert_eq!(of(0x1801, Some(3)), Some(DataType::Unsigned16));
        assert_eq!([of(0x1003, Some(0)), of(0x2000, Some(0))], [Some(DataType::Unsigned8); 2]);
        // Another shape than the standard's, and what it does not know.
        assert_eq!([of(0x1017, Some(1)), of(0x1003, None), of(0x2000, None), of(0x1018, Some(5))], [None; 4]);
    }
}
