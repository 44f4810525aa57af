#![deny(deprecated)]

mod lamp {
    od_macros::object_dictionary!("ui/warn_od0803_error_control.od.yaml");
}

fn main() {}
