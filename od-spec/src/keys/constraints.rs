//! Conditions between entries.

use super::shape::{Key, Keys, NAMES, Shape};
use super::table::keys;

macro_rules! constraint_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "devices": NAMES => devices: Option<Vec<Name>>, "devices it is for; all whose entries it names unless given";
            "require" required: Shape::Condition => require: Option<Spanned<Expr>>, "the condition", "\"pmc:0x6510.4 < 0x30FA.3 <= 750\"";
            "when": Shape::Condition => when: Option<Spanned<Expr>>, "the condition counts only while this one holds", "\"0x606A == 0\"";
            "about": Shape::Words => about: Words, "why";
        } }
    };
}
pub(crate) use constraint_keys;

constraint_keys! { keys
    /// A constraint.
    CONSTRAINT = "a constraint"
}
