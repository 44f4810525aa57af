mod lamp {
    od_macros::object_dictionary!("missing.od.yaml");
}

fn main() {}
