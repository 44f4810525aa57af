//! Objects that a standard fixes: shape, type, access, sub-indices.

use crate::case::{Case, Right};

pub(crate) fn wrong() -> Vec<Case> {
    vec![]
}

pub(crate) fn right() -> Vec<Right> {
    vec![]
}
