//! Conditions between entries.

use super::shape::{DEVICES, Key, Keys, Shape};
use super::table::keys;

macro_rules! constraint_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "devices": DEVICES => devices: Option<Vec<Name>>, "devices it applies to; unless given, all that have the entries which it names";
            "require" required: Shape::Condition => require: Option<Spanned<ConditionDecl>>, "the condition", "\"pmc:0x6510.4 < 0x30FA.3 <= 750\"";
            "when": Shape::Condition => when: Option<Spanned<ConditionDecl>>, "the condition applies only while this one is true", "\"0x606A == 0\"";
            "n": Shape::OneOrMore(&Shape::Numbers) => numbers: Vec<Spanned<NumberRange>>, "makes one constraint for each of these numbers; `{n}` in name, conditions and `about` is the number", "0..11";
            "about": Shape::Words => about: Words, "the reason";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
        } }
    };
}
pub(crate) use constraint_keys;

constraint_keys! { keys
    /// A constraint.
    CONSTRAINT = "a constraint"
}
