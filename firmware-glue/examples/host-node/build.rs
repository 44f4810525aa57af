//! Generates the dictionary of the lamp from its specification.

fn main() {
    // OUT_DIR/lamp.rs
    od_gen::Builder::new("lamp.od.yaml").device("lamp").generate();
}
