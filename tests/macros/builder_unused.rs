#![deny(unused_must_use)]

fn main() {
    od_gen::Builder::new("lamp.od.yaml").device("lamp");
}
