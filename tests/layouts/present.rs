// The same with a file of the present layout, as the generator printed it when the layout began: as long as it compiles, the
// layout is the same. When it no longer does, the layout needs a new number, and this file a successor.

#[path = "layout_2.rs"]
mod pump;

use firmware_glue::{Application, Dictionary, pdo};
use pump::{Entry, Pump, types::Mode, units::Decibar};

struct Hardware;

impl Application<Pump> for Hardware {
    fn changed(&mut self, od: &mut Pump, entry: Entry) {
        if entry == Entry::SetPressure {
            od.set_mode(Mode::RUN);
        }
    }
}

fn main() {
    let mut od = Pump::new(1);
    od.set_set_pressure(Decibar(120));
    let _ = od.read(0x2000, 0);
    let _ = od.write(0x2000, 0, &[1, 0], &mut Hardware);
    let _ = pdo::pack(&mut od, 1, &mut Hardware);
}
