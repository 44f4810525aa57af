// Two devices of one specification: what is said of it is said once.
#![deny(deprecated)]

mod lamp {
    od_macros::object_dictionary!("ui/warn_od0803_error_control.od.yaml");
}

mod lamp_again {
    od_macros::object_dictionary!("ui/warn_od0803_error_control.od.yaml", device = "lamp");
}

fn main() {}
