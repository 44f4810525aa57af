//! What a generated dictionary does beyond single accesses: aliases, PDOs, conditions, storage, every data type.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::pdo::{self, PdoError, Refused};
use firmware_glue::storage::Command;
use firmware_glue::{
    AbortCode, Application, Constrained, Dictionary, Entries, EntryId, OtherLayout, Quantity, Special,
    Storage, Time,
};
use od_generated::pmc::{self, Pmc, types, units};
use od_generated::pmm::{self, Pmm};

use crate::everything;
use crate::everything::Everything;

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod coarse {
    od_macros::object_dictionary!("shared/coarse.od.yaml");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod special_values {
    od_macros::object_dictionary!("shared/special-values.od.yaml");
}

/// An application that remembers what it was asked.
#[derive(Default)]
struct Log<E> {
    unlocked: bool,
    commands: Vec<Command>,
    changed: Vec<E>,
    veto: Option<AbortCode>,
}

impl<D: Entries> Application<D> for Log<D::Entry> {
    fn is_unlocked(&self) -> bool {
        self.unlocked
    }
    fn accept(&mut self, _: &mut D, _: D::Entry, _: &[u8]) -> Result<(), AbortCode> {
        self.veto.map_or(Ok(()), Err)
    }
    fn command(&mut self, _: &mut D, command: Command) -> Result<(), AbortCode> {
        self.commands.push(command);
        self.veto.map_or(Ok(()), Err)
    }
    fn changed(&mut self, _: &mut D, entry: D::Entry) {
        self.changed.push(entry);
    }
}

fn log<E>() -> Log<E> {
    Log { unlocked: false, commands: Vec::new(), changed: Vec::new(), veto: None }
}

fn read<'t, D: Dictionary<'t>>(dictionary: &D, index: u16, sub: u8) -> Result<i64, AbortCode> {
    let value = dictionary.read(index, sub)?;
    let mut bytes = [0; 8];
    bytes[..value.len()].copy_from_slice(&value);
    Ok(i64::from_le_bytes(bytes))
}

// ------------------------------------------------------------------------------------------------------------- aliases

#[test]
fn a_16_bit_view_shows_its_target_at_every_boundary() {
    let mut od = Pmc::new(1);
    for (target, shown) in [
        (i32::MIN, i16::MIN),
        (-32_769, i16::MIN),
        (-32_768, i16::MIN),
        (-32_767, -32_767),
        (-1, -1),
        (0, 0),
        (1, 1),
        (32_766, 32_766),
        (32_767, i16::MAX),
        (32_768, i16::MAX),
        (65_535, i16::MAX),
        (65_536, i16::MAX),
        (i32::MAX, i16::MAX),
    ] {
        od.set_position_actual_value(units::PositionUnit(target));
        assert_eq!(od.position_actual_value_16bit(), units::PositionUnit(shown), "{target}");
        assert_eq!(*od.read(0x5064, 0).unwrap(), shown.to_le_bytes(), "{target}");
    }
    for (target, shown) in [(0, 0), (65_535, u16::MAX), (65_536, u16::MAX), (u32::MAX, u16::MAX)] {
        od.set_profile_velocity(units::PositionUnitPerSecond(target));
        assert_eq!(od.profile_velocity_16bit(), units::PositionUnitPerSecond(shown));
        assert_eq!(*od.read(0x5081, 0).unwrap(), shown.to_le_bytes());
    }
}

#[test]
fn a_view_in_volts_rounds_millivolts_down() {
    let mut od = Pmc::new(1);
    for (millivolts, volts) in
        [(0, 0), (999, 0), (1000, 1), (1999, 1), (560_999, 560), (65_535_999, 65_535), (u32::MAX, 65_535)]
    {
        od.set_dc_link_circuit_voltage(units::Millivolt(millivolts));
        assert_eq!(od.dc_link_circuit_voltage_16bit(), units::Volt(volts), "{millivolts}");
        assert_eq!(*od.read(0x5079, 0).unwrap(), volts.to_le_bytes(), "{millivolts}");
    }
    // Read-only, as its target is.
    assert_eq!(od.write(0x5079, 0, &[0, 0], &mut ()), Err(AbortCode::READ_ONLY));
}

#[test]
fn writing_a_view_writes_its_target_and_reports_it() {
    let mut od = Pmc::new(1);
    let mut application = log();
    for value in [i16::MIN, -1, 0, 1, i16::MAX] {
        let entry = od.write(0x507A, 0, &value.to_le_bytes(), &mut application).unwrap();
        assert_eq!(entry, pmc::Entry::TargetPosition);
        assert_eq!(od.target_position(), units::PositionUnit(i32::from(value)));
        assert_eq!(*od.read(0x507A, 0).unwrap(), value.to_le_bytes());
        assert_eq!(*od.read(0x607A, 0).unwrap(), i32::from(value).to_le_bytes());
    }
    assert_eq!(application.changed, [pmc::Entry::TargetPosition; 5]);
    assert_eq!(od.set_target_position_16bit(units::PositionUnit(-7)), Ok(()));
    assert_eq!(od.target_position(), units::PositionUnit(-7));
    // The view takes no memory: no row of an alias lies in the image.
    let alias = od.info(pmc::Entry::TargetPosition16bit);
    assert!(alias.is_alias());
    assert_eq!(alias.id(), EntryId { index: 0x507A, sub: 0 });
    // A veto against the target is one against the view.
    application.veto = Some(AbortCode::LOCAL_CONTROL);
    assert_eq!(od.write(0x507A, 0, &[1, 0], &mut application), Err(AbortCode::LOCAL_CONTROL));
    assert_eq!(od.target_position(), units::PositionUnit(-7));
}

#[test]
fn a_view_keeps_its_own_rules_and_those_of_its_target() {
    use everything::units::{Millivolt, Volt};
    let mut od = Everything::new(1);
    // 2004h has all 32 bits; its view reaches every value of 16.
    assert_eq!(od.write(0x201E, 0, &(-5i16).to_le_bytes(), &mut ()), Ok(everything::Entry::AnInteger32));
    assert_eq!(od.an_integer32(), -5);
    assert_eq!(od.write(0x201E, 0, &[1, 2, 3], &mut ()), Err(AbortCode::TOO_LONG));
    // 70 V are more millivolts than the target has.
    assert_eq!((od.a_voltage(), od.a_voltage_in_volts()), (Millivolt(1999), Volt(1)));
    assert_eq!(od.write(0x2023, 0, &60u16.to_le_bytes(), &mut ()), Ok(everything::Entry::AVoltage));
    assert_eq!(
        od.write(0x2023, 0, &61u16.to_le_bytes(), &mut ()),
        Err(AbortCode::TOO_HIGH),
        "the target's limit"
    );
    assert_eq!(od.write(0x2023, 0, &66u16.to_le_bytes(), &mut ()), Err(AbortCode::INVALID_VALUE));
    assert_eq!(od.a_voltage(), Millivolt(60_000));
    assert_eq!(od.set_a_voltage_in_volts(Volt(2)), Ok(()));
    assert_eq!(od.set_a_voltage_in_volts(Volt(66)), Err(firmware_glue::OutOfRange));
    assert_eq!(od.a_voltage(), Millivolt(2000));
    // 2020h has limits and a condition, its view another condition: all of them count.
    let view = |od: &mut Everything, value: i16| od.write(0x2021, 0, &value.to_le_bytes(), &mut ());
    assert_eq!(view(&mut od, 1000), Ok(everything::Entry::Limited));
    assert_eq!(view(&mut od, 1001), Err(AbortCode::TOO_HIGH));
    assert_eq!(view(&mut od, -101), Err(AbortCode::TOO_LOW));
    assert_eq!(od.limited(), 1000);
    od.set_an_unsigned8(7);
    assert_eq!(view(&mut od, 1), Err(AbortCode::DEVICE_STATE));
    od.set_an_unsigned8(8);
    od.set_a_boolean(false);
    assert_eq!(view(&mut od, 1), Err(AbortCode::DEVICE_STATE));
    assert_eq!(od.write(0x2020, 0, &1i32.to_le_bytes(), &mut ()), Ok(everything::Entry::Limited));
    assert_eq!(od.limited_view(), 1);
}

// ------------------------------------------------------------------------------------------------ conditions, constraints

#[test]
fn a_write_condition_is_asked_every_time() {
    let mut od = Pmc::new(1);
    let bits = |od: &mut Pmc, control: u16, status: u16| {
        od.set_controlword(types::Controlword(control));
        od.set_statusword(types::Statusword(status));
    };
    // Home offset: only in homing mode.
    for (mode, expected) in [(6, Ok(pmc::Entry::HomeOffset)), (1, Err(AbortCode::DEVICE_STATE))] {
        od.set_modes_of_operation_display(types::ModesOfOperation(mode));
        assert_eq!(od.write(0x607C, 0, &[0; 4], &mut ()), expected);
    }
    // The first condition of the table: `bit(0x6040, 3) == 0 and bit(0x6041, 2) == 0`.
    let table = od.table();
    let conditional = (0..u16::MAX).find(|row| table.attributes(*row).condition == 0).unwrap();
    let EntryId { index, sub } = table.id(conditional);
    let size = usize::from(table.attributes(conditional).size);
    let value = od.read(index, sub).unwrap().to_vec();
    assert_eq!(value.len(), size);
    for (control, status, open) in
        [(0, 0, true), (1 << 3, 0, false), (0, 1 << 2, false), (!(1 << 3), !(1 << 2), true)]
    {
        bits(&mut od, control, status);
        let expected = if open { Ok(od.entry(conditional).unwrap()) } else { Err(AbortCode::DEVICE_STATE) };
        assert_eq!(od.write(index, sub, &value, &mut ()), expected, "{control:#x} {status:#x}");
    }
}

#[test]
fn constraints_hold_for_the_defaults_and_are_kept() {
    let mut od = Pmm::new(1);
    assert!(od.broken_constraint().is_none());
    assert!(Pmc::new(1).broken_constraint().is_none());
    // 600 V is below the chopper's 650 V; 700 V is not.
    let chopper_off = 700u16.to_le_bytes();
    let mut application = Log { unlocked: true, ..log() };
    assert_eq!(od.write_consistent(0x30FB, 7, &chopper_off, &mut application), Err(AbortCode::INCOMPATIBLE));
    assert_eq!(application.changed, []);
    assert_eq!(od.booster_parameter_set().target_voltage(), units_of_pmm(600));
    // Without the guard the value is taken, and the condition says so.
    assert!(od.write(0x30FB, 7, &chopper_off, &mut application).is_ok());
    let broken = od.broken_constraint().unwrap();
    assert!(broken.name.contains("ladder") || broken.name.contains("chopper"), "{}", broken.name);
    // A condition that is broken already does not prevent other values.
    assert!(od.write_consistent(0x30E0, 0, &2500u16.to_le_bytes(), &mut application).is_ok());
    // What is broken already can be mended, though not yet met by everything.
    assert!(od.write_consistent(0x30FB, 7, &600u16.to_le_bytes(), &mut application).is_ok());
    assert!(od.broken_constraint().is_none());
}

fn units_of_pmm(volts: u16) -> pmm::units::Volt<u16> {
    pmm::units::Volt(volts)
}

// ---------------------------------------------------------------------------------------------------------------- PDOs

#[test]
fn default_pdos_are_packed_alike_by_structure_and_by_mapping() {
    let mut od = Pmc::new(3);
    od.set_statusword(types::Statusword(0x1237));
    od.set_actual_velocity(units::PositionUnitPerSecond(-2));
    od.set_position_actual_value(units::PositionUnit(0x0102_0304));
    let structure = pmc::pdos::Tpdo3::of(&od);
    assert_eq!(structure.pack(), [0x37, 0x12, 0xFE, 0xFF, 0xFF, 0xFF]);
    assert_eq!(pmc::pdos::Tpdo3::unpack(structure.pack()), structure);
    // Off by default: bit 31 of its COB-ID.
    assert_eq!(pdo::pack(&mut od, 3, &mut ()), Err(PdoError::NotValid));
    assert_eq!(read(&od, 0x1802, 1), Ok(i64::from(pmc::pdos::Tpdo3::cob_id(3))));
    let on = (pmc::pdos::Tpdo3::cob_id(3) & !(1 << 31)).to_le_bytes();
    od.write(0x1802, 1, &on, &mut ()).unwrap();
    assert_eq!(*pdo::pack(&mut od, 3, &mut ()).unwrap(), structure.pack());
    assert_eq!(pdo::pack(&mut od, 9, &mut ()), Err(PdoError::NoPdo));
    assert_eq!(pdo::pack(&mut od, 0, &mut ()), Err(PdoError::NoPdo));
    assert_eq!(pdo::pack(&mut od, 600, &mut ()), Err(PdoError::NoPdo));
}

#[test]
fn a_received_pdo_is_checked_value_by_value() {
    let mut od = Pmc::new(1);
    od.write(0x1401, 1, &0x301u32.to_le_bytes(), &mut ()).unwrap();
    let mut application = log();
    let received = pdo::unpack(&mut od, 2, &[0x0F, 0, 0x10, 0x27, 0, 0], &mut application).unwrap();
    assert_eq!((received.too_long, received.refused), (false, None));
    assert_eq!(application.changed, [pmc::Entry::Controlword, pmc::Entry::TargetPosition]);
    assert_eq!(od.controlword(), types::Controlword(0x0F));
    assert_eq!(od.target_position(), units::PositionUnit(10_000));
    // Too short: nothing is stored. Too long: the first bytes count.
    assert_eq!(pdo::unpack(&mut od, 2, &[0; 5], &mut application), Err(PdoError::TooShort));
    assert_eq!(od.controlword(), types::Controlword(0x0F));
    assert!(pdo::unpack(&mut od, 2, &[1, 0, 2, 0, 0, 0, 9], &mut application).unwrap().too_long);
    assert_eq!(od.target_position(), units::PositionUnit(2));
    // What is refused is left out and reported; the rest is taken.
    let mut everything = Everything::new(1);
    let received = pdo::unpack(&mut everything, 1, &[0, 0x34, 0x12], &mut ()).unwrap();
    assert_eq!(
        received.refused,
        Some(Refused { entry: everything::Entry::AnUnsigned8, code: AbortCode::TOO_LOW })
    );
    assert_eq!(everything.an_unsigned16(), 0x1234);
    assert_eq!(everything.an_unsigned8(), 255);
}

#[test]
fn a_mapping_is_changed_by_the_rules_of_cia_301() {
    let mut od = Pmc::new(1);
    let mut write = |index, sub, value: u32, size: usize| {
        od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
    };
    let tpdo = 0x181;
    // In use: neither the mapping nor the identifier changes.
    assert_eq!(write(0x1A00, 0, 0, 1), Err(AbortCode::UNSUPPORTED_ACCESS));
    assert_eq!(write(0x1A00, 1, 0, 4), Err(AbortCode::UNSUPPORTED_ACCESS));
    assert_eq!(write(0x1800, 1, 0x182, 4), Err(AbortCode::INVALID_VALUE));
    // Off, but its entries are counted: the number goes first.
    assert_eq!(write(0x1800, 1, 1 << 31 | tpdo, 4), Ok(()));
    assert_eq!(write(0x1A00, 1, 0x6064_0020, 4), Err(AbortCode::UNSUPPORTED_ACCESS));
    assert_eq!(write(0x1A00, 0, 0, 1), Ok(()));
    assert_eq!(write(0x1A00, 1, 0x6064_0020, 4), Ok(()));
    assert_eq!(write(0x1A00, 2, 0x606C_0020, 4), Ok(()));
    assert_eq!(write(0x1A00, 3, 0x6041_0010, 4), Ok(()));
    // Not there; of another length; not to be sent; too much.
    assert_eq!(write(0x1A00, 4, 0x6FFF_0020, 4), Err(AbortCode::NO_OBJECT));
    assert_eq!(write(0x1A00, 4, 0x6064_0120, 4), Err(AbortCode::NO_OBJECT));
    assert_eq!(write(0x1A00, 4, 0x6064_0010, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(write(0x1A00, 4, 0x6064_0040, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(write(0x1A00, 4, 0x607A_0020, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(write(0x1A00, 4, 0x1017_0010, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(write(0x1A00, 4, 0x0005_0008, 4), Err(AbortCode::NO_OBJECT), "no placeholder in a TPDO");
    assert_eq!(write(0x1A00, 0, 3, 1), Err(AbortCode::PDO_LENGTH));
    assert_eq!(write(0x1A00, 0, 9, 1), Err(AbortCode::PDO_LENGTH));
    assert_eq!(write(0x1A00, 0, 255, 1), Err(AbortCode::PDO_LENGTH));
    assert_eq!(write(0x1A00, 0, 2, 1), Ok(()));
    // Restricted, 29 bits; then a free identifier.
    for cob_id in [0x000, 0x07F, 0x101, 0x180, 0x581, 0x601, 0x6E0, 0x701, 0x7FF, 1 << 29 | tpdo, 0x800] {
        assert_eq!(write(0x1800, 1, cob_id, 4), Err(AbortCode::INVALID_VALUE), "{cob_id:X}");
    }
    assert_eq!(write(0x1800, 1, 0x1FF, 4), Ok(()));
    od.set_position_actual_value(units::PositionUnit(-1));
    od.set_actual_velocity(units::PositionUnitPerSecond(0x7766_5544));
    assert_eq!(*pdo::pack(&mut od, 1, &mut ()).unwrap(), [0xFF, 0xFF, 0xFF, 0xFF, 0x44, 0x55, 0x66, 0x77]);
}

#[test]
fn a_mapping_keeps_to_the_granularity_of_the_device() {
    let mut od = coarse::Coarse::new(1);
    let mut write = |index, sub, value: u32, size: usize| {
        od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
    };
    assert_eq!(write(0x1800, 1, 1 << 31 | 0x181, 4), Ok(()));
    assert_eq!(write(0x1A00, 0, 0, 1), Ok(()));
    assert_eq!(write(0x1A00, 1, 0x2000_0001, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(write(0x1A00, 1, 0x2001_0008, 4), Ok(()));
    assert_eq!(write(0x1A00, 0, 1, 1), Ok(()));
}

#[test]
fn placeholders_are_in_rpdos_only() {
    let mut od = Everything::new(1);
    let mut write = |index, sub, value: u32, size: usize| {
        od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
    };
    assert_eq!(write(0x1400, 1, 1 << 31, 4), Ok(()));
    assert_eq!(write(0x1600, 0, 0, 1), Ok(()));
    assert_eq!(write(0x1600, 1, 0x0006_0010, 4), Ok(()));
    assert_eq!(write(0x1600, 2, 0x0006_0008, 4), Err(AbortCode::NOT_MAPPABLE));
    assert_eq!(
        write(0x1600, 2, 0x0001_0001, 4),
        Err(AbortCode::NO_OBJECT),
        "the device has no such placeholder"
    );
    assert_eq!(write(0x1600, 2, 0x2009_0008, 4), Ok(()));
    assert_eq!(write(0x1600, 0, 2, 1), Ok(()));
    assert_eq!(write(0x1400, 1, 0x201, 4), Ok(()));
    assert_eq!(pdo::unpack(&mut od, 1, &[0xAA, 0xBB, 7], &mut ()).unwrap().refused, None);
    assert_eq!(od.an_unsigned8(), 7);
}

// ------------------------------------------------------------------------------------------- communication objects (1xxxh)

#[test]
fn communication_objects_keep_their_own_rules() {
    let mut od = Everything::new(7);
    let mut write = |index, sub, value: u64, size: usize| {
        od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
    };
    // 1003h.0 takes 0 only.
    assert_eq!(write(0x1003, 0, 1, 1), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1003, 0, 0, 1), Ok(()));
    // 1005h: the identifier stays while the device produces SYNC.
    assert_eq!(write(0x1005, 0, 0x90, 4), Ok(()));
    assert_eq!(write(0x1005, 0, 0x4000_0090, 4), Ok(()));
    assert_eq!(write(0x1005, 0, 0x4000_0080, 4), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1005, 0, 0x0000_0080, 4), Ok(()));
    assert_eq!(write(0x1005, 0, 0x2000_0080, 4), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1005, 0, 0x0000_0101, 4), Err(AbortCode::INVALID_VALUE));
    // 1010h, 1011h take their signature, from an application that carries the command out.
    for (index, signature) in [(0x1010, b"save"), (0x1011, b"load")] {
        let signature = u32::from_le_bytes(*signature).into();
        assert_eq!(write(index, 1, signature, 4), Err(AbortCode::NOT_STORED), "nothing stores it");
    }
    let mut reported = log();
    assert_eq!(od.write(0x1010, 1, b"load", &mut reported), Err(AbortCode::NOT_STORED));
    assert_eq!(od.write(0x1011, 1, &[0; 4], &mut reported), Err(AbortCode::NOT_STORED));
    assert!(od.write(0x1010, 1, b"save", &mut reported).is_ok());
    assert!(od.write(0x1011, 2, b"load", &mut reported).is_ok());
    assert_eq!(reported.commands, [Command::Save(1), Command::Restore(2)]);
    assert_eq!(reported.changed, [], "a command is no value");
    reported.veto = Some(AbortCode::HARDWARE);
    assert_eq!(
        od.write(0x1010, 1, b"save", &mut reported),
        Err(AbortCode::HARDWARE),
        "and is carried out before the answer"
    );
    assert_eq!(read(&od, 0x1010, 1), Ok(0));
    let mut write = |index, sub, value: u64, size: usize| {
        od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
    };
    // 1014h: off before it changes.
    assert_eq!(write(0x1014, 0, 0x88, 4), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1014, 0, 0x8000_0087, 4), Ok(()));
    assert_eq!(write(0x1014, 0, 0x88, 4), Ok(()));
    // 1016h: a node is watched once, and is a node.
    assert_eq!(write(0x1016, 1, 0x0005_0064, 4), Ok(()));
    assert_eq!(write(0x1016, 2, 0x0005_00C8, 4), Err(AbortCode::INCOMPATIBLE));
    assert_eq!(write(0x1016, 2, 0x0005_0000, 4), Ok(()));
    assert_eq!(write(0x1016, 1, 0x0005_00C8, 4), Ok(()));
    assert_eq!(write(0x1016, 3, 0x0080_0064, 4), Err(AbortCode::INVALID_VALUE));
    // 1019h: not while SYNC is produced.
    assert_eq!(write(0x1019, 0, 1, 1), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1019, 0, 2, 1), Ok(()));
    assert_eq!(write(0x1006, 0, 1000, 4), Ok(()));
    assert_eq!(write(0x1019, 0, 3, 1), Err(AbortCode::DEVICE_STATE));
    // Communication parameters of PDOs.
    assert_eq!(write(0x1400, 2, 252, 1), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1800, 2, 252, 1), Ok(()));
    assert_eq!(write(0x1800, 2, 241, 1), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1800, 3, 101, 2), Err(AbortCode::INVALID_VALUE));
    assert_eq!(write(0x1800, 3, 100, 2), Ok(()));
    assert_eq!(write(0x1801, 6, 5, 1), Ok(()));
    assert_eq!(write(0x1801, 6, 241, 1), Err(AbortCode::INVALID_VALUE));
}

#[test]
fn the_error_history_shows_what_is_filled() {
    let mut od = Everything::new(1);
    assert_eq!(od.read(0x1003, 1).unwrap_err(), AbortCode::NO_DATA);
    od.set_pre_defined_error_field(1, everything::types::ErrorFieldEntry(0x3210));
    od.set_pre_defined_error_field_number_of_errors(1);
    assert_eq!(read(&od, 0x1003, 1), Ok(0x3210));
    assert_eq!(od.read(0x1003, 2).unwrap_err(), AbortCode::NO_DATA);
    assert_eq!(od.write(0x1003, 0, &[0], &mut ()), Ok(everything::Entry::PreDefinedErrorFieldNumberOfErrors));
    assert_eq!(od.read(0x1003, 1).unwrap_err(), AbortCode::NO_DATA);
}

// ----------------------------------------------------------------------------------------------------------- data types

#[test]
fn every_data_type_is_read_and_written() {
    let mut od = Everything::new(5);
    assert!(od.a_boolean());
    assert_eq!(od.write(0x2000, 0, &[2], &mut ()), Err(AbortCode::INVALID_VALUE));
    od.write(0x2000, 0, &[0], &mut ()).unwrap();
    assert!(!od.a_boolean());
    assert_eq!(od.an_integer8(), -128);
    assert_eq!(od.an_integer24(), -8_388_608);
    assert_eq!(od.set_an_integer24(8_388_608), Err(firmware_glue::OutOfRange));
    assert_eq!(od.set_an_integer24(8_388_607), Ok(()));
    assert_eq!(*od.read(0x2003, 0).unwrap(), [0xFF, 0xFF, 0x7F]);
    assert_eq!((od.an_integer40(), od.an_integer48(), od.an_integer56()), (-1, -2, -3));
    assert_eq!(od.an_integer64(), i64::MIN);
    assert_eq!(od.an_unsigned24(), 0xFF_FFFF);
    assert_eq!(od.an_unsigned32(), 0x605, "node-ID added");
    assert_eq!((od.an_unsigned40(), od.an_unsigned48(), od.an_unsigned56()), (1, 2, 3));
    assert_eq!(od.an_unsigned64(), u64::MAX);
    od.set_a_real32(0.5);
    assert_eq!(*od.read(0x2011, 0).unwrap(), 0.5f32.to_le_bytes());
    od.write(0x2012, 0, &(-2.5e300f64).to_le_bytes(), &mut ()).unwrap();
    assert!((od.a_real64() + 2.5e300).abs() < 1e290);
    // Strings: up to their capacity, without padding.
    assert_eq!(od.a_visible_string(), "Hello world");
    assert_eq!(*od.read(0x2013, 0).unwrap(), *b"Hello world");
    od.write(0x2013, 0, b"exactly twenty bytes", &mut ()).unwrap();
    assert_eq!(od.a_visible_string(), "exactly twenty bytes");
    assert_eq!(od.write(0x2013, 0, b"exactly twenty bytes!", &mut ()), Err(AbortCode::TOO_LONG));
    assert_eq!(od.write(0x2013, 0, b"no\ncontrol", &mut ()), Err(AbortCode::INVALID_VALUE));
    // Zeros may pad a text, but not be in it.
    assert_eq!(od.write(0x2013, 0, b"one\0two", &mut ()), Err(AbortCode::INVALID_VALUE));
    assert!(od.write(0x2013, 0, b"one\0\0", &mut ()).is_ok());
    assert_eq!(od.a_visible_string(), "one");
    od.write(0x2013, 0, b"", &mut ()).unwrap();
    assert_eq!(od.a_visible_string(), "");
    assert_eq!(*od.read(0x2014, 0).unwrap(), [1, 0xA1, 5, 0x3C]);
    od.write(0x2014, 0, &[0, 0], &mut ()).unwrap();
    assert_eq!(od.an_octet_string(), [0, 0]);
    assert_eq!(od.set_an_octet_string(&[0; 7]), Err(firmware_glue::NoFit));
    od.set_a_unicode_string("Größe").unwrap();
    assert_eq!(od.a_unicode_string().chars().collect::<String>(), "Größe");
    assert_eq!(od.read(0x2015, 0).unwrap().len(), 10);
    assert_eq!(od.write(0x2015, 0, &[65, 0, 0, 0, 66, 0], &mut ()), Err(AbortCode::INVALID_VALUE));
    assert_eq!(od.write(0x2015, 0, &[65, 0, 66], &mut ()), Err(AbortCode::LENGTH));
    let time = Time { days: 15_000, milliseconds: 1 };
    od.set_a_time_of_day(time);
    assert_eq!(*od.read(0x2016, 0).unwrap(), time.to_bytes());
    // Enums, bit fields, units, special values.
    assert_eq!(od.a_mode(), everything::types::Mode::REVERSE);
    assert_eq!(od.write(0x2019, 0, &[2], &mut ()), Err(AbortCode::INVALID_VALUE));
    assert_eq!(everything::types::Mode::known(5), Err(firmware_glue::UnknownValue(5)));
    assert_eq!(format!("{:?}", od.a_mode()), "mode: reverse (-1)");
    let flags = od.some_flags();
    assert!(flags.run() && flags.alarm() && flags.speed() == everything::types::Flags::SPEED_SLOW);
    let fast = flags.with_speed(everything::types::Flags::SPEED_FAST).unwrap();
    assert_eq!(fast.with_alarm(false).0, 0x000F);
    const { assert!(everything::types::Flags(0).with_speed(7).unwrap().0 == 0x000E) };
    assert_eq!(format!("{:?}", flags.with_speed(7).unwrap()), "flags: 0x800f (run, speed = 7, alarm)");
    // Three bits hold no 8, and none of its bits are lost in silence.
    assert_eq!(flags.with_speed(8), None);
    assert_eq!(flags.with_speed(u8::MAX), None);
    assert_eq!(od.waermetauscher_groesse(), Special::Value(everything::units::Decicelsius(-125)));
    assert_eq!(format!("{:?}", od.waermetauscher_groesse()), "-12.5 °C");
    assert_eq!(
        od.write(0x201B, 0, &i16::MAX.to_le_bytes(), &mut ()),
        Ok(everything::Entry::WaermetauscherGroesse)
    );
    assert_eq!(
        od.waermetauscher_groesse().special(),
        Some(everything::specials::ShortCircuitOrWireBreak::WireBreak)
    );
    assert_eq!(od.waermetauscher_groesse().value(), None);
    assert_eq!(od.waermetauscher_groesse().to_string(), "wire break");
    assert_eq!(od.write(0x201B, 0, &851i16.to_le_bytes(), &mut ()), Err(AbortCode::TOO_HIGH));
    // Arrays by sub-index, records with gaps.
    assert_eq!(od.write(0x201C, 12, &[1], &mut ()).map(drop), Ok(()));
    assert_eq!(od.write(0x201C, 13, &[1], &mut ()), Err(AbortCode::NO_SUB_INDEX));
    for sub in [2, 3, 4, 6, 9, 11, 0xFD, 0xFF] {
        assert_eq!(od.read(0x201D, sub).unwrap_err(), AbortCode::NO_SUB_INDEX, "{sub}");
    }
    assert_eq!(read(&od, 0x201D, 0), Ok(254));
    assert_eq!(read(&od, 0x201D, 1), Ok(1));
    assert_eq!(*od.read(0x201D, 10).unwrap(), *b"ten");
    let mut application = log();
    assert_eq!(od.write(0x201D, 5, &[0; 4], &mut application), Err(AbortCode::DEVICE_STATE));
    application.unlocked = true;
    assert!(od.write(0x201D, 5, &[9, 0, 0, 0], &mut application).is_ok());
    assert_eq!(od.record_with_gaps().fifth(), 9);
    od.record_with_gaps_mut().set_fifth(-9);
    assert_eq!(od.record_with_gaps().fifth(), -9);
}

#[test]
fn one_meaning_has_the_raw_value_of_each_entry() {
    use special_values::{Probes, specials::WireBreak::WireBreak, units::Decicelsius};
    const BROKEN: [u8; 2] = i16::MAX.to_le_bytes();
    let mut od = Probes::new(1);
    assert_eq!(od.torque(), Special::Special(WireBreak), "the default");
    assert_eq!(od.level(), Special::Special(WireBreak), "a constant");
    assert_eq!([od.pressure().special(), od.temperature().special()], [None, None]);
    od.write(0x2000, 0, &BROKEN, &mut ()).unwrap();
    assert_eq!(od.temperature(), Special::Special(WireBreak));
    od.write(0x2001, 0, &BROKEN, &mut ()).unwrap();
    assert_eq!(od.pressure(), Special::Value(0x7FFF), "elsewhere, the number means itself");
    od.set_pressure(Special::Special(WireBreak));
    assert_eq!(*od.read(0x2001, 0).unwrap(), [0xFF; 2]);
    od.set_torque(Special::Value(300));
    assert_eq!(od.write(0x2002, 0, &BROKEN, &mut ()), Err(AbortCode::TOO_HIGH));
    od.write(0x2000, 0, &126i16.to_le_bytes(), &mut ()).unwrap();
    assert_eq!(od.temperature_in_8_bits(), Special::Value(Decicelsius(126)));
    od.flow_mut().set_mean(Special::Special(WireBreak));
    od.speed_mut().set_mean(Special::Special(WireBreak));
    assert_eq!([read(&od, 0x2005, 1), read(&od, 0x2006, 1)], [Ok(255), Ok(254)], "types of their own");
}

#[test]
fn state_machines_are_read_and_commanded() {
    use pmc::machines::{PowerDriveCommand, PowerDriveState};
    // Status words and control words as every CiA 402 drive has them.
    for (word, state) in [
        (0x0000, PowerDriveState::NotReadyToSwitchOn),
        (0x0250, PowerDriveState::SwitchOnDisabled),
        (0x0231, PowerDriveState::ReadyToSwitchOn),
        (0x0233, PowerDriveState::SwitchedOn),
        (0x0237, PowerDriveState::OperationEnabled),
        (0x0217, PowerDriveState::QuickStopActive),
        (0x021F, PowerDriveState::FaultReactionActive),
        (0x0218, PowerDriveState::Fault),
    ] {
        assert_eq!(PowerDriveState::of(types::Statusword(word)), Some(state), "{word:#06x}");
    }
    assert_eq!(PowerDriveState::of(types::Statusword(0x0002)), None);
    for (command, mask, bits) in [
        (PowerDriveCommand::Shutdown, 0x87, 0x06),
        (PowerDriveCommand::EnableOperation, 0x8F, 0x0F),
        (PowerDriveCommand::DisableVoltage, 0x82, 0x00),
    ] {
        for word in [0x0000, 0xFFFF] {
            let word = command.apply(types::Controlword(word));
            assert_eq!(word.0 & mask, bits, "{command:?}");
            assert!(command.is_in(word));
        }
        // Bits that are not the command's stay.
        assert_eq!(command.apply(types::Controlword(0xFF00)).0 & 0xFE00, 0xFE00);
    }
    assert_eq!(pmc::errors::NO_ERROR, 0);
}

#[test]
fn names_and_ids_of_entries() {
    let od = Pmc::new(1);
    assert_eq!(od.find(0x6064, 0), Ok(pmc::Entry::PositionActualValue));
    assert_eq!(od.find(0x6510, 4).unwrap().name(), "drive data.min DC link voltage");
    assert_eq!(format!("{:?}", pmc::Entry::PositionActualValue), "6064h.0 position actual value");
    let mut rows = 0;
    while let Some(entry) = od.entry(rows) {
        let EntryId { index, sub } = od.info(entry).id();
        assert_eq!(od.find(index, sub), Ok(entry));
        assert_eq!(od.row(entry), rows);
        rows += 1;
    }
    assert_eq!(rows, 264);
}

// --------------------------------------------------------------------------------------------------------------- domains

/// An application with a DOMAIN of its own.
#[derive(Default)]
struct Store(Vec<u8>);

impl Application<Everything> for Store {
    fn read_domain(
        &mut self,
        _: &mut Everything,
        _: everything::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest = self.0.get(usize::try_from(offset).unwrap()..).unwrap_or_default();
        let length = rest.len().min(buffer.len());
        buffer[..length].copy_from_slice(&rest[..length]);
        Ok(length)
    }
    fn write_domain(
        &mut self,
        _: &mut Everything,
        _: everything::Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        self.0.truncate(usize::try_from(offset).unwrap());
        self.0.extend(data);
        Ok(())
    }
}

#[test]
fn a_domain_is_the_applications() {
    let mut od = Everything::new(1);
    let mut store = Store::default();
    assert_eq!(od.read(0x2018, 0).unwrap_err(), AbortCode::UNSUPPORTED_ACCESS);
    assert_eq!(od.write(0x2018, 0, &[1], &mut store), Err(AbortCode::UNSUPPORTED_ACCESS));
    assert_eq!(od.download_domain(0x2018, 0, 0, b"1234567", false, &mut store), Ok(()));
    assert_eq!(od.download_domain(0x2018, 0, 7, b"89", true, &mut store), Ok(()));
    let mut buffer = [0; 4];
    assert_eq!(od.upload_domain(0x2018, 0, 6, &mut buffer, &mut store), Ok(3));
    assert_eq!(&buffer[..3], b"789");
    assert_eq!(od.upload_domain(0x2018, 0, 9, &mut buffer, &mut store), Ok(0));
    assert_eq!(od.upload_domain(0x2000, 0, 0, &mut buffer, &mut store), Err(AbortCode::UNSUPPORTED_ACCESS));
    assert_eq!(od.download_domain(0x2018, 0, 0, b"", true, &mut ()), Err(AbortCode::NOT_STORED));
    assert_eq!(
        od.download_domain(0x201D, 0xFE, 0, b"", true, &mut store),
        Err(AbortCode::DEVICE_STATE),
        "locked"
    );
}

// --------------------------------------------------------------------------------------------------------- storage, units

#[test]
fn stored_groups_are_single_pieces_that_come_back() {
    let mut od = Pmc::new(1);
    let mut application = Log { unlocked: true, ..log() };
    od.write(0x6065, 0, &77u32.to_le_bytes(), &mut application).unwrap();
    let saved = od.stored(Storage::Application).to_vec();
    let layout = od.layout(Storage::Application);
    assert!(!saved.is_empty());
    od.reset(1);
    assert_ne!(read(&od, 0x6065, 0), Ok(77));
    assert_eq!(od.restore(Storage::Application, layout ^ 1, &saved), Err(OtherLayout));
    assert_eq!(od.restore(Storage::Application, layout, &saved[1..]), Err(OtherLayout));
    assert_eq!(od.restore(Storage::Manufacturer, layout, &saved), Err(OtherLayout));
    assert_ne!(read(&od, 0x6065, 0), Ok(77));
    assert_eq!(od.restore(Storage::Application, layout, &saved), Ok(()));
    assert_eq!(read(&od, 0x6065, 0), Ok(77));
    // Restoring the defaults of one group leaves the others alone.
    od.set_position_actual_value(units::PositionUnit(5));
    od.reset_stored(Storage::Application, 1);
    assert_ne!(read(&od, 0x6065, 0), Ok(77));
    assert_eq!(od.position_actual_value(), units::PositionUnit(5));
}

/// A dictionary in static memory, made at compile time.
static NODE_9: Pmc = Pmc::new(9);

#[test]
fn the_node_id_is_in_every_value_that_follows_it() {
    for node in [1u8, 127] {
        let mut od = Pmc::new(node);
        assert_eq!(read(&od, 0x1014, 0), Ok(0x80 + i64::from(node)));
        assert_eq!(read(&od, 0x1200, 1), Ok(0x600 + i64::from(node)));
        assert_eq!(read(&od, 0x1400, 1), Ok(i64::from(pmc::pdos::Rpdo1::cob_id(node))));
        let fresh = od.image().to_vec();
        od.set_controlword(types::Controlword(1));
        od.reset(node);
        assert_eq!(od.image(), fresh);
    }
    assert_eq!(read(&NODE_9, 0x1014, 0), Ok(0x89));
}

#[test]
fn units_convert_exactly_or_not_at_all() {
    let millivolts = units::Millivolt(560_500u32);
    assert_eq!(millivolts.convert::<units::Volt<u16>, u16>(), Err(firmware_glue::OutOfRange));
    assert_eq!(millivolts.convert_down::<units::Volt<u16>, u16>(), Ok(units::Volt(560)));
    assert_eq!(units::Volt(12u16).convert::<units::Millivolt<u32>, u32>(), Ok(units::Millivolt(12_000)));
    assert_eq!(units::Volt(70u16).convert::<units::Millivolt<u16>, u16>(), Err(firmware_glue::OutOfRange));
    assert_eq!(units::Millivolt(-1i32).convert_down::<units::Volt<i32>, i32>(), Ok(units::Volt(-1)));
    assert_eq!(millivolts.to_string(), "560500 mV");
    assert_eq!(pmm::units::Decicelsius(-5i16).to_string(), "-0.5 °C");
    assert_eq!(
        pmc::defaults::FOLLOWING_ERROR_TIMEOUT.0,
        u16::from_le_bytes(*Pmc::new(1).read(0x6066, 0).unwrap().first_chunk().unwrap())
    );
}
