//! What was changed before a model could be written.

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

/// The repairs of a model.
#[derive(Debug, Clone, Default)]
pub(super) struct Remarks {
    pub repairs: Vec<Repair>,
}

impl Remarks {
    /// What is to be said at a place.
    pub(super) fn at(&self, place: &Place) -> impl Iterator<Item = String> {
        self.repairs.iter().filter(move |repair| repair.place == *place).map(Repair::comment)
    }
}
