//! PDOs that `CompactPDO` implies: the reader adds their objects to the file's.

use std::collections::BTreeSet;

use super::super::python::{Ini, int};
use super::super::refusal::{Cause, Refusals};

/// Communication and mapping parameters that are added, both in the list of optional objects.
#[derive(Debug, Default)]
pub(super) struct Implied {
    pub communication: BTreeSet<u16>,
    pub mapping: BTreeSet<u16>,
}

pub(super) fn implied(ini: &Ini<'_>, refusals: &mut Refusals) -> Implied {
    let mut implied = Implied::default();
    let Some(device) = ini.section("DeviceInfo") else { return implied };
    let mut number = |key| match device.filled(key) {
        None => 0,
        Some(item) => {
            let what = "a number in another notation than `10` or `0xA`";
            refusals.wants(int(&item.value, 0), item.place, Cause::Number, what).unwrap_or(0)
        }
    };
    if number("CompactPDO") == 0 {
        return implied;
    }
    let counts = [(0x1400, number("NrOfRxPDO")), (0x1800, number("NrOfTxPDO"))];
    for (first, count) in counts {
        let is_there = |index: u16| ini.object(index).is_some();
        let described = (first..first + 512).filter(|index| is_there(*index)).count();
        let mut missing = count - i128::try_from(described).unwrap_or(i128::MAX);
        for index in (first..first + 512).filter(|index| !is_there(*index)) {
            if missing <= 0 {
                break;
            }
            missing -= 1;
            implied.communication.insert(index);
            if !is_there(index + 0x200) {
                implied.mapping.insert(index + 0x200);
            }
        }
    }
    if !implied.communication.is_empty() && ini.section("OptionalObjects").is_none() {
        refusals.add(device.place("CompactPDO"), Cause::Missing, "`[OptionalObjects]` for the implied PDOs");
    }
    implied
}
