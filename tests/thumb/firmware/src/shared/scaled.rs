// The program of the scaled model, the same for every size; `model` is the size's module.

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware_glue::Application;
use panic_halt as _;

use super::model::{Controller, Entry};

#[path = "server.rs"]
mod server;

/// What an application does with a few entries.
struct Channel;

impl Application<Controller> for Channel {
    fn refresh(&mut self, dictionary: &mut Controller, entry: Entry) {
        match entry {
            Entry::Channel1Temperature => dictionary.set_channel_1_temperature(black_box(0)),
            Entry::Channel1Position => dictionary.set_channel_1_position(black_box(0)),
            _ => {}
        }
    }

    fn changed(&mut self, dictionary: &mut Controller, entry: Entry) {
        match entry {
            Entry::Channel1Setpoint => {
                black_box(dictionary.channel_1_setpoint());
            }
            Entry::Channel1Speed => dictionary.set_channel_1_position(dictionary.channel_1_speed()),
            _ => {}
        }
    }
}

static REQUEST: server::Request<{ Controller::LARGEST_VALUE }> = server::Request::new();

#[entry]
fn main() -> ! {
    // `entry` hands it out as `&'static mut`.
    static mut DICTIONARY: Controller = Controller::new(1);
    server::serve(DICTIONARY, &mut Channel, &REQUEST)
}
