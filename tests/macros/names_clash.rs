mod lamp {
    od_macros::object_dictionary!("macros/names_clash.od.yaml");
}

fn main() {}
