//! The 16-bit aliases of the PMC, on the target's arithmetic: saturation, rounding and writing through, in the typed accessors
//! and over the bus.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware_glue::{AbortCode, Dictionary};
use od_generated::pmc::{Entry, Pmc, units};
use panic_semihosting as _;

/// Values of a 32-bit target and what an INTEGER16 shows of them.
const SIGNED: [(i32, i16); 12] = [
    (i32::MIN, i16::MIN),
    (i32::MIN + 1, i16::MIN),
    (-65_536, i16::MIN),
    (-32_769, i16::MIN),
    (-32_768, i16::MIN),
    (-32_767, -32_767),
    (-1, -1),
    (0, 0),
    (32_767, i16::MAX),
    (32_768, i16::MAX),
    (65_536, i16::MAX),
    (i32::MAX, i16::MAX),
];

/// Millivolts and the volts that an UNSIGNED16 shows of them, rounded down.
const VOLTS: [(u32, u16); 9] = [
    (0, 0),
    (999, 0),
    (1000, 1),
    (560_999, 560),
    (32_768_000, 32_768),
    (65_534_999, 65_534),
    (65_535_999, u16::MAX),
    (65_536_000, u16::MAX),
    (u32::MAX, u16::MAX),
];

/// What is written to an alias.
const WRITTEN: [i16; 6] = [i16::MIN, -32_767, -1, 0, 1, i16::MAX];

#[entry]
fn main() -> ! {
    static mut DICTIONARY: Pmc = Pmc::new(1);
    position(DICTIONARY);
    voltage(DICTIONARY);
    target_position(DICTIONARY);
    hprintln!("{} positions, {} voltages, {} written values", SIGNED.len(), VOLTS.len(), WRITTEN.len());
    debug::exit(debug::EXIT_SUCCESS);
    unreachable!("QEMU ends at the line before")
}

/// 5064h shows 6064h; both are read-only over the bus.
fn position(dictionary: &mut Pmc) {
    for (target, shown) in black_box(SIGNED) {
        dictionary.set_position_actual_value(units::PositionUnit(target));
        assert_eq!(dictionary.position_actual_value().0, target);
        assert_eq!(dictionary.position_actual_value_16bit().0, shown, "5064h of {target}");
        expect(dictionary, 0x6064, &target.to_le_bytes());
        expect(dictionary, 0x5064, &shown.to_le_bytes());
        assert_eq!(dictionary.write(0x5064, 0, &[1, 0], &mut ()), Err(AbortCode::READ_ONLY));
        assert_eq!(dictionary.position_actual_value().0, target, "a refused write changes nothing");
    }
}

/// 5079h shows 6079h in volts.
fn voltage(dictionary: &mut Pmc) {
    for (target, shown) in black_box(VOLTS) {
        dictionary.set_dc_link_circuit_voltage(units::Millivolt(target));
        assert_eq!(dictionary.dc_link_circuit_voltage().0, target);
        assert_eq!(dictionary.dc_link_circuit_voltage_16bit().0, shown, "5079h of {target}");
        expect(dictionary, 0x6079, &target.to_le_bytes());
        expect(dictionary, 0x5079, &shown.to_le_bytes());
        assert_eq!(dictionary.write(0x5079, 0, &[1, 0], &mut ()), Err(AbortCode::READ_ONLY));
        assert_eq!(dictionary.dc_link_circuit_voltage().0, target, "a refused write changes nothing");
    }
}

/// 507Ah shows 607Ah, and writes it.
fn target_position(dictionary: &mut Pmc) {
    for (target, shown) in black_box(SIGNED) {
        dictionary.set_target_position(units::PositionUnit(target));
        assert_eq!(dictionary.target_position_16bit().0, shown, "507Ah of {target}");
        expect(dictionary, 0x507A, &shown.to_le_bytes());
        // Over the bus, the same.
        dictionary.set_target_position(units::PositionUnit(0));
        assert_eq!(dictionary.write(0x607A, 0, &target.to_le_bytes(), &mut ()), Ok(Entry::TargetPosition));
        assert_eq!(dictionary.target_position().0, target);
        assert_eq!(dictionary.target_position_16bit().0, shown, "507Ah of {target}, written");
        expect(dictionary, 0x507A, &shown.to_le_bytes());
    }
    for value in black_box(WRITTEN) {
        let bytes = value.to_le_bytes();
        // All bits of the target differ, so that its upper half has to be written, too.
        let before = units::PositionUnit(!i32::from(value));
        dictionary.set_target_position(before);
        assert_eq!(dictionary.write(0x507A, 0, &bytes, &mut ()), Ok(Entry::TargetPosition));
        assert_eq!(dictionary.target_position().0, i32::from(value), "{value} through 507Ah");
        expect(dictionary, 0x607A, &i32::from(value).to_le_bytes());
        expect(dictionary, 0x507A, &bytes);

        dictionary.set_target_position(before);
        assert_eq!(dictionary.set_target_position_16bit(units::PositionUnit(value)), Ok(()));
        assert_eq!(dictionary.target_position().0, i32::from(value), "{value} through the typed 507Ah");
        assert_eq!(dictionary.target_position_16bit().0, value);

        let refused = [(&bytes[..1], AbortCode::TOO_SHORT), (&[bytes[0], bytes[1], 0], AbortCode::TOO_LONG)];
        for (data, code) in refused {
            assert_eq!(dictionary.write(0x507A, 0, data, &mut ()), Err(code));
            assert_eq!(dictionary.target_position().0, i32::from(value), "a refused write changes nothing");
        }
    }
}

fn expect(dictionary: &Pmc, index: u16, bytes: &[u8]) {
    match dictionary.read(index, 0) {
        Ok(value) => assert_eq!(value.bytes(), bytes, "{index:04X}h"),
        Err(abort) => panic!("{index:04X}h: {:08X}h", abort.0),
    }
}
