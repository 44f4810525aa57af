mod lamp {
    od_macros::object_dictionary!("ui/ok_minimal.od.yaml", device = "stranger");
}

fn main() {}
