// A program with a file that was generated for an older layout of `firmware-glue`: one error, in the file's import.

#[path = "layout_1.rs"]
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
