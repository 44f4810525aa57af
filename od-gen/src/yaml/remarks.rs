//! What was changed before a model could be written.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::diag::Diagnostic;
use od_spec::model::Fact;

use super::options::Place;

/// Something that the written specification says otherwise than the model did, because the language would refuse it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Repair {
    /// What it is about.
    pub place: Place,
    /// The fact that was changed or left out; `None` where the object or entry as a whole is left out.
    pub fact: Option<Fact>,
    /// What the model says.
    pub original: String,
    /// What the specification says in its place; `None` where it says nothing.
    pub now: Option<String>,
    /// Why: what the language would say to the original.
    pub because: String,
}

impl Repair {
    /// A comment for the place.
    pub fn comment(&self) -> String {
        let Self { fact, original, now, because, .. } = self;
        let what = match fact {
            Some(fact) => format!("{}: {original}", fact.word()),
            None => original.clone(),
        };
        match now {
            Some(_) => format!("original: {what}; changed: {because}"),
            None => format!("original: {what}; left out: {because}"),
        }
    }
}

/// What the language would refuse of a model: what is allowed all the same, and what is changed.
#[derive(Debug, Clone, Default)]
pub(super) struct Remarks {
    pub repairs: Vec<Repair>,
    /// Rules that the model breaks, by code, with the first thing that each found.
    pub allowed: BTreeMap<&'static str, String>,
}

impl Remarks {
    /// Allows a rule to be broken; `false` where it is no rule's finding, where names have to differ, and where it was
    /// allowed before and that was not enough.
    pub(super) fn allow(&mut self, error: &Diagnostic, before: &BTreeSet<&str>) -> bool {
        let is_name = error.code == od_spec::rule_codes::DUPLICATE_NAME;
        if is_name || !od_spec::can_be_allowed(error.code) || before.contains(error.code.id) {
            return false;
        }
        let reason = || format!("as in the original: {}", error.message);
        self.allowed.entry(error.code.id).or_insert_with(reason);
        true
    }

    /// How much is said.
    pub(super) fn count(&self) -> usize {
        self.repairs.len() + self.allowed.len()
    }

    /// What is to be said at a place.
    pub(super) fn at(&self, place: &Place) -> impl Iterator<Item = String> {
        self.repairs.iter().filter(move |repair| repair.place == *place).map(Repair::comment)
    }
}
