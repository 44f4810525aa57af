//! What was changed before a model could be written.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::diag::Diagnostic;
use od_spec::model::{Dictionary, Fact, Index};

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
    /// Codes that reading says as well: what cannot be read cannot be allowed.
    of_reading: BTreeSet<&'static str>,
}

impl Remarks {
    /// Allows a rule to be broken, at an object if the finding is about one; `false` where it is no rule's finding, and where it was allowed
    /// before and that was not enough.
    pub(super) fn allow(
        &mut self,
        error: &Diagnostic,
        index: Option<Index>,
        before: &BTreeSet<&'static str>,
    ) -> bool {
        if before.contains(error.code.id) {
            self.allowed.remove(error.code.id);
            self.of_reading.insert(error.code.id);
        }
        if !od_spec::can_be_allowed(error.code) || self.of_reading.contains(error.code.id) {
            return false;
        }
        let broken = self
            .allowed
            .entry(error.code.id)
            .or_insert_with(|| Broken { first: error.message.clone(), at: Some(BTreeSet::new()) });
        match index {
            Some(index) => broken.at.iter_mut().for_each(|at| at.extend([index])),
            None => broken.at = None,
        }
        true
    }

    /// Nothing is allowed at objects that are gone.
    pub(super) fn forget_what_is_gone(&mut self, device: &Dictionary) {
        for broken in self.allowed.values_mut() {
            broken.at.iter_mut().for_each(|at| at.retain(|index| device.objects.contains_key(index)));
        }
        self.allowed.retain(|_, broken| broken.at.as_ref().is_none_or(|at| !at.is_empty()));
    }

    /// What has been decided so far; it grows with every decision.
    pub(super) fn decisions(&self) -> (usize, usize, usize) {
        (self.repairs.len(), self.of_reading.len(), self.allowed.len())
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
