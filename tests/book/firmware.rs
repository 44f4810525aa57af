mod valve {
    od_macros::object_dictionary!("book/valve.od.yaml");
}

use firmware_glue::{Application, Special, pdo};
use valve::{Entry, Valve, units::Decibar};

struct Hardware {
    set_point: Decibar<u16>,
}

impl Application<Valve> for Hardware {
    fn changed(&mut self, od: &mut Valve, entry: Entry) {
        if entry == Entry::SetPressure {
            self.set_point = od.set_pressure();
        }
    }
}

/// RPDO 1 in, with the limits of the specification; TPDO 1 out.
fn cycle(od: &mut Valve, hardware: &mut Hardware, received: &[u8], measured: u16) -> Option<pdo::Frame> {
    pdo::unpack(od, 1, received, hardware).ok()?;
    od.set_actual_pressure(Special::Value(Decibar(measured)));
    pdo::pack(od, 1, hardware).ok()
}
