//! The modes of operation of drives: what rules about 6502h and 6060h read.

use crate::check::device::device_type_is_kept::{self, DRIVES};
use crate::check::pdo::parameters::Parameter;
use crate::check::subject::Subject;
use crate::model::Index;

/// A mode of operation that CiA 402 defines.
pub(in crate::check) struct Mode {
    /// Its value in 6060h.
    pub value: i128,
    /// Its bit in 6502h.
    bit: u8,
    /// Its name, which is also that of the library's feature.
    pub name: &'static str,
    /// The objects that a drive has to have with it, as the first axis has them.
    pub objects: &'static [u16],
}

const fn mode(value: i128, bit: u8, name: &'static str, objects: &'static [u16]) -> Mode {
    Mode { value, bit, name, objects }
}

/// The modes about which sources agree; the eleventh, with the commutation angle, is in few of them. Objects that a library's feature has
/// next to these belong to the mode, but no source calls them mandatory.
pub(in crate::check) const MODES: [Mode; 9] = [
    mode(1, 0, "profile position mode", &[0x6064, 0x607A, 0x6081, 0x6083, 0x6086]),
    mode(2, 1, "velocity mode", &[0x6042, 0x6043, 0x6044, 0x6046, 0x6048]),
    mode(3, 2, "profile velocity mode", &[0x606B, 0x606C, 0x6083, 0x60FF]),
    mode(4, 3, "torque profile mode", &[0x6071, 0x6077, 0x6087, 0x6088]),
    mode(6, 5, "homing mode", &[0x6098, 0x6099]),
    mode(7, 6, "interpolated position mode", &[0x6064, 0x60C1]),
    mode(8, 7, "cyclic synchronous position mode", &[0x6064, 0x607A]),
    mode(9, 8, "cyclic synchronous velocity mode", &[0x60FF]),
    mode(10, 9, "cyclic synchronous torque mode", &[0x6071]),
];

/// The value of a mode for the torque of whose motor the master gives the commutation angle.
const WITH_COMMUTATION_ANGLE: i128 = 11;

/// The axis of a drive that says in 6502h which modes it has.
pub(in crate::check) struct Axis<'a> {
    /// Its first index.
    first: Index,
    /// 6502h.
    pub supported: Parameter<'a>,
}

impl Axis<'_> {
    /// An index of the first axis, on this one.
    pub(in crate::check) const fn index(&self, on_first: u16) -> Index {
        Index(on_first - 0x6000 + self.first.0)
    }

    /// Whether 6502h has the bit of a mode.
    pub(in crate::check) fn has(&self, mode: &Mode) -> bool {
        self.supported.raw() >> mode.bit & 1 == 1
    }

    /// Whether 6502h has a value of 6060h among its modes; those of the maker, and none at all, it does not name.
    pub(in crate::check) fn lists(&self, value: i128) -> bool {
        match MODES.iter().find(|mode| mode.value == value) {
            Some(mode) => self.has(mode),
            None => value <= 0 || value == WITH_COMMUTATION_ANGLE,
        }
    }

    /// The name of a mode's feature.
    pub(in crate::check) fn feature(&self, mode: &Mode) -> String {
        match (self.first.0 - 0x6000) / 0x800 {
            0 => format!("`{}`", mode.name),
            before => format!("`{} axis {}`", mode.name, before + 1),
        }
    }
}

/// The axes of drives that say which modes they have.
pub(in crate::check) fn axes<'a>(subject: &Subject<'a>) -> Vec<Axis<'a>> {
    let axis = |first: Index| {
        let supported = subject.parameter(first.0 - 0x6000 + 0x6502, 0)?;
        Some(Axis { first, supported })
    };
    device_type_is_kept::axes(subject, DRIVES).into_iter().filter_map(axis).collect()
}
