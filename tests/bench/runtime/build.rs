include!("dictionaries/model.rs");

// What the bench has to know of each model: `Model` in `benches/dictionary/main.rs`.
fn main() {
    each_size(&["--format", "rs"], "rs", |_, _| {});
}
