//! Objects that are reached by the number in their names, and all elements of an array.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::Dictionary as _;
use od_spec::diag::Diagnostics;
use od_tests::compile_clean;

#[deny(warnings)]
mod modules {
    od_macros::object_dictionary!("shared/runs.od.yaml");
}

use modules::Modules;
use modules::units::Millivolt;

/// What SDO reads at an index and a sub-index.
fn uploaded(modules: &Modules, index: u16, sub: u8) -> Vec<u8> {
    modules.read(index, sub).unwrap().to_vec()
}

#[test]
fn arrays_take_a_number_and_a_sub_index() {
    let mut modules = Modules::new(1);
    assert_eq!(modules.set_module_cells(2, 3, Millivolt(3456)), Some(()));
    assert_eq!(modules.module_cells(2, 3), Some(Millivolt(3456)));
    assert_eq!(uploaded(&modules, 0x2101, 3), 3456u16.to_le_bytes());
    let all: Vec<u16> = modules.module_2_cells_iter().map(|cell| cell.0).collect();
    assert_eq!(all, [3300, 3300, 3456, 3300]);
    for n in 1..=3 {
        for sub in 1..=4 {
            let value = n * 100 + u16::from(sub);
            assert_eq!(modules.set_module_cells(n, sub, Millivolt(value)), Some(()));
            assert_eq!(uploaded(&modules, 0x20FF + n, sub), value.to_le_bytes());
        }
    }
    for (n, sub) in [(0, 1), (4, 1), (1, 0), (1, 5), (u16::MAX, 1)] {
        assert_eq!(modules.module_cells(n, sub), None, "{n} {sub}");
        assert_eq!(modules.set_module_cells(n, sub, Millivolt(0)), None, "{n} {sub}");
    }
}

#[test]
fn records_take_a_number() {
    let mut modules = Modules::new(1);
    for n in 1..=3 {
        let mut string = modules.string_mut(n).unwrap();
        assert_eq!((string.current(), string.state()), (-7, 2));
        string.set_current(i32::from(n) * 1000);
        string.set_state(u8::try_from(n).unwrap());
        assert_eq!(uploaded(&modules, 0x210F + n, 1), (i32::from(n) * 1000).to_le_bytes());
        assert_eq!(uploaded(&modules, 0x210F + n, 2), [u8::try_from(n).unwrap()]);
    }
    assert_eq!(modules.string(2).map(|string| string.current()), Some(2000));
    assert!(modules.string(0).is_none() && modules.string(4).is_none() && modules.string_mut(4).is_none());
}

#[test]
fn values_take_the_number_that_their_names_have() {
    let mut modules = Modules::new(1);
    assert_eq!([2, 3, 4, 5].map(|n| modules.limit(n)), [None, Some(30), Some(40), None]);
    assert_eq!(modules.set_limit(4, 41), Some(()));
    assert_eq!((modules.limit_3(), modules.limit_4()), (30, 41));
}

/// Only what is alike, numbered without a gap and is no other name is reached by number.
#[test]
fn others_are_not() {
    let modules = Modules::new(1);
    let pump: bool = modules.pump();
    assert!(!pump);
    let system = compile_clean("tests/shared/runs.od.yaml").unwrap();
    let tokens = od_gen::rust::tokens(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let generated = tokens.to_string();
    for name in ["date_of_make", "lamp", "fan"] {
        assert!(!generated.contains(&format!("pub fn {name} (")), "{name}");
        assert!(generated.contains(&format!("pub fn {name}_1 (")), "{name}");
    }
}
