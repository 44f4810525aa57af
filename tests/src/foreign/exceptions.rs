//! Differences that are as they should be, each with its reason.

use od_gen::yaml::{Place, Repair};
use od_spec::model::{Dictionary, EntryId, Fact};

use super::{Checked, Difference, Stated, Step};

/// What the second model of a comparison was made by.
#[derive(Debug, Clone, Copy)]
pub(super) enum Round<'a> {
    /// By an import, with what it says it has changed.
    Import(&'a [Repair]),
    /// By putting the file right.
    Fix,
}

/// A difference of one file that is as it should be.
#[derive(Debug)]
struct Exception {
    file: &'static str,
    fact: Stated,
    reason: &'static str,
}

const EXCEPTIONS: [Exception; 0] = [];

/// The exceptions of files that are not among those that were read, or that nothing was found for.
pub fn unused(found: &[(&str, &Checked)]) -> Vec<String> {
    let is_used = |exception: &Exception| {
        found.iter().filter(|(file, _)| *file == exception.file).any(|(_, checked)| {
            checked.excepted.iter().any(|(reason, _)| *reason == exception.reason)
        })
    };
    let idle = EXCEPTIONS.iter().filter(|one| !is_used(one));
    idle.map(|one| format!("{}: {}: {}", one.file, one.fact, one.reason)).collect()
}

/// Takes away what is as it should be, and tells of the rest.
pub(super) fn except(
    round: Round<'_>,
    file: &str,
    before: &Dictionary,
    found: Vec<Difference>,
    checked: &mut Checked,
) {
    let step = match round {
        Round::Import(_) => Step::Import,
        Round::Fix => Step::Fixing,
    };
    let _ = before;
    for difference in found {
        let listed = EXCEPTIONS.iter().find(|one| one.file == file && one.fact == difference.fact);
        let general = match round {
            Round::Import(repairs) => {
                is_renamed(&difference, repairs).then_some("a name that clashes, or that an EDS cannot hold")
            }
            Round::Fix => None,
        };
        match general.or(listed.map(|one| one.reason)) {
            Some(reason) => match checked.excepted.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, count)) => *count += 1,
                None => checked.excepted.push((reason, 1)),
            },
            None => checked.problem(step, difference.to_string()),
        }
    }
}

/// Whether the import tells that it has given the place another name.
fn is_renamed(difference: &Difference, repairs: &[Repair]) -> bool {
    let Some(id) = difference.place.filter(|_| difference.fact == Stated::Name) else { return false };
    let is_about = |place: &Place| match place {
        Place::Object(index) => id == EntryId { index: *index, sub: od_spec::model::SubIndex(0) },
        Place::Entry(entry) => *entry == id,
        Place::Device => false,
    };
    repairs.iter().any(|repair| repair.fact == Some(Fact::Name) && is_about(&repair.place))
}
