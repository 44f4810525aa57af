//! What was changed before a model could be written.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::diag::{Diagnostic, Severity};
use od_spec::model::{Fact, Index};

use super::node::Spot;
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

/// A rule that the model breaks.
#[derive(Debug, Clone)]
pub(super) struct Broken {
    /// What was found first.
    pub first: String,
    /// The objects that break it; `None` where it is not only objects that do.
    pub at: Option<BTreeSet<Index>>,
}

/// What the language would refuse of a model: what is allowed all the same, and what is changed.
#[derive(Debug, Clone, Default)]
pub(super) struct Remarks {
    pub repairs: Vec<Repair>,
    /// Rules that the model breaks, by code.
    pub allowed: BTreeMap<&'static str, Broken>,
    /// What it breaks them with.
    pub broken_with: BTreeSet<Spot>,
}

impl Remarks {
    /// The same where every rule may be broken.
    pub(super) fn with_all_rules_allowed(&self) -> Self {
        let rules = od_spec::all_codes()
            .into_iter()
            .filter(|code| code.severity == Severity::Error && od_spec::can_be_allowed(code));
        let allowed = rules.map(|code| (code.id, Broken { first: code.title.to_owned(), at: None }));
        Self { repairs: self.repairs.clone(), allowed: allowed.collect(), broken_with: BTreeSet::new() }
    }

    /// Allows a rule to be broken, at an object if the finding is about a part of one. What is not an error of a rule
    /// needs no leave.
    pub(super) fn allow(&mut self, finding: &Diagnostic, spot: Option<Spot>) {
        if finding.code.severity != Severity::Error {
            return;
        }
        self.broken_with.extend(spot);
        let broken = self
            .allowed
            .entry(finding.code.id)
            .or_insert_with(|| Broken { first: finding.message.clone(), at: Some(BTreeSet::new()) });
        match spot {
            Some(spot) => broken.at.iter_mut().for_each(|at| at.extend([spot.index()])),
            None => broken.at = None,
        }
    }

    /// What was changed, by place, in the order in which it was.
    pub(super) fn by_place(&self) -> BTreeMap<Place, Vec<&Repair>> {
        let mut places: BTreeMap<Place, Vec<&Repair>> = BTreeMap::new();
        for repair in &self.repairs {
            places.entry(repair.place).or_default().push(repair);
        }
        places
    }
}
