//! What a scalar of the language holds: numbers, conditions, and names with placeholders; and words for what has a number.

pub mod expr;
pub mod name_pattern;
pub mod scalar;
pub mod words;
