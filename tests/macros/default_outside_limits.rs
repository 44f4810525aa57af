mod lamp {
    od_macros::object_dictionary!("ui/err_od0406_default.od.yaml");
}

fn main() {}
