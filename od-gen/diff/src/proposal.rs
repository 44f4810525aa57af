//! Which version numbers a new file should have.

use od_formats::eds::write_eds;
use od_spec::model::{Dictionary, System};

use super::change::{Change, Class};
use super::scope::Scope;

/// The numbers that show a change to tools and masters.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Proposals {
    /// FileVersion and FileRevision of the EDS.
    pub file: Proposal,
    /// RevisionNumber (1018h.3): its upper half, major, and its lower half, minor.
    pub revision: Proposal,
}

/// A number of two parts, of which the first counts more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Proposal {
    /// In the old file.
    pub old: Parts,
    /// In the new file.
    pub new: Parts,
    /// What to do.
    pub advice: Advice,
}

/// The two parts of a number.
pub type Parts = (u16, u16);

/// What to do with a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advice {
    /// Nothing has to be stated.
    Keep,
    /// The new file states it.
    Raised,
    /// Write this one.
    Raise(Parts),
    /// The second part has no larger value: write this one, with a larger first part.
    RaiseFirst(Parts),
    /// The first part has no larger value.
    UsedUp,
}

/// How far a number has to be raised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Step {
    None,
    Second,
    First,
}

/// The numbers of a device, by what has changed.
pub(super) fn proposals<'a>(
    old: (&System, &Dictionary),
    new: (&System, &Dictionary),
    scope: Scope,
    changes: impl Iterator<Item = &'a Change>,
) -> Proposals {
    let class = changes.map(Change::class).max();
    let file = match class {
        None => Step::None,
        Some(Class::Plc) => Step::First,
        // Whatever was compared is in both files.
        Some(_) if !scope.is_everything() || shows_in_eds(old, new) => Step::Second,
        Some(_) => Step::None,
    };
    let revision = match class {
        Some(Class::Plc) => Step::First,
        // What firmware does on the bus is another, or it has forgotten its parameters.
        Some(Class::Addition | Class::Behaviour | Class::Stored) => Step::Second,
        Some(Class::Documents | Class::Firmware) | None => Step::None,
    };
    let of_file = |device: &Dictionary| (device.file.version.into(), device.file.revision.into());
    let of_product = |device: &Dictionary| {
        let [a, b, c, d] = device.info.product_revision.to_be_bytes();
        (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]))
    };
    Proposals {
        file: propose(of_file(old.1), of_file(new.1), file, u8::MAX.into()),
        revision: propose(of_product(old.1), of_product(new.1), revision, u16::MAX),
    }
}

/// Whether the EDS of a device is another one, except for what it says about its own version.
fn shows_in_eds(old: (&System, &Dictionary), new: (&System, &Dictionary)) -> bool {
    let mut comparable = new.1.clone();
    comparable.key.clone_from(&old.1.key);
    comparable.file.version = old.1.file.version;
    comparable.file.revision = old.1.file.revision;
    comparable.file.modified = old.1.file.modified;
    comparable.file.modified_by.clone_from(&old.1.file.modified_by);
    write_eds(old.0, old.1) != write_eds(new.0, &comparable)
}

fn propose(old: Parts, new: Parts, step: Step, most: u16) -> Proposal {
    let first = if old.0 < most { Some((old.0 + 1, 0)) } else { None };
    let advice = match step {
        Step::None => Advice::Keep,
        Step::First if new.0 > old.0 => Advice::Raised,
        Step::Second if new > old => Advice::Raised,
        Step::First => first.map_or(Advice::UsedUp, Advice::Raise),
        Step::Second if old.1 < most => Advice::Raise((old.0, old.1 + 1)),
        Step::Second => first.map_or(Advice::UsedUp, Advice::RaiseFirst),
    };
    Proposal { old, new, advice }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_raised_once_and_only_as_far_as_they_go() {
        let advice = |old, new, step| propose(old, new, step, 255).advice;
        assert_eq!(advice((1, 9), (1, 9), Step::None), Advice::Keep);
        assert_eq!(advice((1, 9), (1, 9), Step::Second), Advice::Raise((1, 10)));
        assert_eq!(advice((1, 9), (1, 10), Step::Second), Advice::Raised);
        assert_eq!(advice((1, 9), (2, 0), Step::Second), Advice::Raised);
        assert_eq!(advice((1, 9), (1, 8), Step::Second), Advice::Raise((1, 10)));
        assert_eq!(advice((1, 9), (1, 10), Step::First), Advice::Raise((2, 0)));
        assert_eq!(advice((1, 9), (2, 0), Step::First), Advice::Raised);
        assert_eq!(advice((1, 255), (1, 255), Step::Second), Advice::RaiseFirst((2, 0)));
        assert_eq!(advice((255, 255), (255, 255), Step::Second), Advice::UsedUp);
        assert_eq!(advice((255, 3), (255, 3), Step::First), Advice::UsedUp);
        assert_eq!(advice((255, 3), (255, 3), Step::Second), Advice::Raise((255, 4)));
    }
}
