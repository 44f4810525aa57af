mod lamp {
    od_macros::object_dictionary!(lamp);
}

mod other {
    od_macros::object_dictionary!("ui/ok_minimal.od.yaml", devise = "lamp");
}

fn main() {}
