//! Serves lookups, reads and checked writes of the PMC.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware_glue::Application;
use od_generated::pmc::{Entry, Pmc, types, units};
use panic_halt as _;

#[path = "../shared/server.rs"]
mod server;

/// What a drive does with a few entries.
struct Drive;

impl Application<Pmc> for Drive {
    fn refresh(&mut self, dictionary: &mut Pmc, entry: Entry) {
        match entry {
            Entry::PositionActualValue => {
                dictionary.set_position_actual_value(units::PositionUnit(black_box(0)))
            }
            Entry::ActualVelocity => {
                dictionary.set_actual_velocity(units::PositionUnitPerSecond(black_box(0)))
            }
            _ => {}
        }
    }

    fn changed(&mut self, dictionary: &mut Pmc, entry: Entry) {
        match entry {
            Entry::Controlword => {
                dictionary.set_statusword(types::Statusword(black_box(dictionary.controlword().0)))
            }
            Entry::ModesOfOperation => {
                dictionary.set_modes_of_operation_display(dictionary.modes_of_operation())
            }
            Entry::TargetPosition => {
                black_box(dictionary.target_position());
            }
            _ => {}
        }
    }
}

static REQUEST: server::Request<{ Pmc::LARGEST_VALUE }> = server::Request::new();

#[entry]
fn main() -> ! {
    // `entry` hands it out as `&'static mut`.
    static mut DICTIONARY: Pmc = Pmc::new(1);
    server::serve(DICTIONARY, &mut Drive, &REQUEST)
}
