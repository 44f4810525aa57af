//! What a scalar of the language holds: numbers, conditions, and names with placeholders.

pub mod expr;
pub mod name_pattern;
pub mod scalar;
