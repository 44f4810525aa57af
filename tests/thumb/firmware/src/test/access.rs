//! Every access to the dictionaries of PMC, PMM and the Fullmo drive, against the JSON dump, as tests/tests/rust/access.rs does on the host.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware_glue::Dictionary;
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};
use panic_semihosting as _;

#[path = "../../../../shared/cases.rs"]
mod cases;

static PMC: &[u8] = include_bytes!(env!("PMC_CASES"));
static PMM: &[u8] = include_bytes!(env!("PMM_CASES"));
static FULLMO: &[u8] = include_bytes!(env!("FULLMO_CASES"));

#[entry]
fn main() -> ! {
    static mut PMC_DICTIONARY: Pmc = Pmc::new(cases::NODE);
    static mut PMM_DICTIONARY: Pmm = Pmm::new(cases::NODE);
    static mut FULLMO_DICTIONARY: Fullmo = Fullmo::new(cases::NODE);
    let pmc = try_device("PMC", PMC_DICTIONARY, PMC, env!("PMC_COUNT"));
    let pmm = try_device("PMM", PMM_DICTIONARY, PMM, env!("PMM_COUNT"));
    let fullmo = try_device("FULLMO", FULLMO_DICTIONARY, FULLMO, env!("FULLMO_COUNT"));
    debug::exit(if pmc && pmm && fullmo { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("QEMU ends at the line before")
}

/// `made`: how many cases there are, in digits.
fn try_device(name: &str, dictionary: &mut impl Dictionary<'static>, bytes: &[u8], made: &str) -> bool {
    match cases::run(dictionary, bytes) {
        Ok(count) => {
            hprintln!("{}: {} of {} cases", name, count, made);
            made.parse() == Ok(count) && count > 0
        }
        Err((number, (kind, index, sub), code)) => {
            hprintln!(
                "{}: case {} (kind {}) at {:04X}h.{}: {:08X}h came",
                name,
                number,
                kind,
                index,
                sub,
                code
            );
            false
        }
    }
}
