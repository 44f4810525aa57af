mod lamp {
    od_macros::object_dictionary!("../../../../tests/macros/names_clash.od.yaml");
}

fn main() {}
