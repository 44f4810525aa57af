mod lamp {
    od_macros::object_dictionary!("../../../../tests/ui/ok_minimal.od.yaml", device = "stranger");
}

fn main() {}
