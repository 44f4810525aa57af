//! Values that a device starts with.

use crate::case::{Case, Right};

pub(crate) fn wrong() -> Vec<Case> {
    vec![]
}

pub(crate) fn right() -> Vec<Right> {
    vec![]
}
