//! Constraints that were written as one for several numbers.

use od_spec::model::Constraint;

/// What represents the number of a constraint of a series.
pub(crate) const NUMBER: &str = "n";

/// What a constraint is called in the documents: those of a series have one name.
pub(crate) fn title(constraint: &Constraint) -> String {
    match &constraint.series {
        Some(series) => series.name.replace("{n}", NUMBER),
        None => constraint.name.clone(),
    }
}
