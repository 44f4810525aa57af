//! How many instructions a PDO of four entries takes, by SysTick: with `-icount shift=0`, QEMU's clock goes by instructions.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware_glue::pdo::{Frame, Rpdo, Tpdo};
use firmware_glue::{AbortCode, Dictionary};
use od_generated::pmc::Pmc;
use panic_semihosting as _;

#[path = "../shared/instructions.rs"]
mod instructions;

use instructions::{count, timer};

/// A TPDO may not take as many.
const PACKED: u32 = 150;
/// Neither may an RPDO whose entries have no rules, or where one of the four is an enum, whose values are checked.
const FREE: u32 = 250;
const CHECKED: u32 = 640;

/// 6041h, 603Fh, 6077h and 6078h: four words.
const SENT: [u32; 4] = [0x6041_0010, 0x603F_0010, 0x6077_0010, 0x6078_0010];
/// 6040h, 5040h and 60FFh, which take every value, and one that does as well.
const TAKEN: [u32; 3] = [0x6040_0010, 0x5040_0008, 0x60B1_0020];
/// 6060h, an enum.
const MODE: u32 = 0x6060_0008;

/// A function of its own, so that what is called from here is not woven into the loop.
#[inline(never)]
fn send(tpdo: &mut Tpdo, dictionary: &mut Pmc) -> Option<Frame> {
    tpdo.pack(dictionary, &mut ()).ok()
}

#[inline(never)]
fn take(rpdo: &mut Rpdo, dictionary: &mut Pmc, data: &[u8]) -> bool {
    rpdo.unpack(dictionary, data, &mut ()).is_ok_and(|received| received.refused.is_none())
}

/// Maps entries as a client does.
fn map(dictionary: &mut Pmc, index: u16, parameters: &[u32]) -> Result<(), AbortCode> {
    let cob_id = <[u8; 4]>::try_from(dictionary.read(index, 1)?.bytes()).map_err(|_| AbortCode::INTERNAL)?;
    let cob_id = u32::from_le_bytes(cob_id) & !(1 << 31);
    dictionary.write(index, 1, &(cob_id | 1 << 31).to_le_bytes(), &mut ())?;
    dictionary.write(index + 0x200, 0, &[0], &mut ())?;
    for (sub, parameter) in (1..).zip(parameters) {
        dictionary.write(index + 0x200, sub, &parameter.to_le_bytes(), &mut ())?;
    }
    let number = u8::try_from(parameters.len()).map_err(|_| AbortCode::INTERNAL)?;
    dictionary.write(index + 0x200, 0, &[number], &mut ())?;
    dictionary.write(index, 1, &cob_id.to_le_bytes(), &mut ())?;
    Ok(())
}

#[entry]
fn main() -> ! {
    static mut DICTIONARY: Pmc = Pmc::new(1);
    let mut timer = timer();
    let (mut tpdo, mut rpdo) = (Tpdo::new(DICTIONARY.table(), 1), Rpdo::new(DICTIONARY.table(), 1));
    let (Ok(tpdo), Ok(rpdo)) = (&mut tpdo, &mut rpdo) else { panic!("the PMC has both") };
    let empty = count(&mut timer, || {
        black_box(black_box(&DICTIONARY));
    });
    let mut within = true;
    let mut judge = |what: &str, taken: u32, most: u32| {
        hprintln!("{} instructions: {}", taken - empty, what);
        within &= taken > empty && taken - empty < most;
    };

    map(DICTIONARY, 0x1800, &SENT).expect("all can be mapped");
    let mut sent = None;
    let taken = count(&mut timer, || sent = send(tpdo, black_box(DICTIONARY)));
    assert_eq!(sent.map(|frame| frame.len()), Some(8));
    judge("packs four words", taken, PACKED);

    map(DICTIONARY, 0x1400, &[TAKEN[0], TAKEN[1], 0x5040_0008, TAKEN[2]]).expect("all can be mapped");
    let mut all = true;
    let taken =
        count(&mut timer, || all &= take(rpdo, black_box(DICTIONARY), black_box(&[6, 0, 1, 1, 5, 0, 0, 0])));
    assert!(all && DICTIONARY.controlword().0 == 6);
    judge("unpacks four numbers without rules", taken, FREE);

    map(DICTIONARY, 0x1400, &[TAKEN[0], TAKEN[1], MODE, TAKEN[2]]).expect("all can be mapped");
    let taken =
        count(&mut timer, || all &= take(rpdo, black_box(DICTIONARY), black_box(&[7, 0, 1, 1, 5, 0, 0, 0])));
    assert!(all && DICTIONARY.controlword().0 == 7);
    judge("unpacks three numbers without rules and an enum", taken, CHECKED);
    debug::exit(if within { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("QEMU ends at the line before")
}
