include!("dictionaries/model.rs");

// What the bench has to know of each model: `Model` in `benches/shared/model.rs`.
fn main() {
    each_size(&["--format", "rs"], "rs", |_, _| {});
}
