//! Will hold `object_dictionary!`, which turns a specification into typed Rust; empty until the Rust backend exists.
