//! Nothing: the measurements are in `benches/dictionary.rs`, the generated code in `dictionaries`.
