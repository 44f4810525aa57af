//! The example of each rule, tried: what it refuses is refused by this rule and no other, what it accepts is accepted.

use crate::{codes, rules, said_of_example};

#[test]
fn the_example_of_a_rule_is_refused_by_it_and_accepted_when_fixed() {
    for rule in rules() {
        let id = rule.id;
        let example = rule.example.unwrap_or_else(|| panic!("{id} has no example"));
        assert_eq!(codes(&said_of_example(example.before)), [id], "before:\n{}", example.before);
        let after = said_of_example(example.after);
        assert!(after.is_empty(), "{id}, after: {:?}\n{}", codes(&after), example.after);
    }
}
