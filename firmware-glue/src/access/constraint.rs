//! Conditions between entries that hold for every configuration.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::command::Command;
use crate::access::dictionary::Dictionary;

/// A condition between entries, such as thresholds that have to stay in order. It is looked at when it is asked for:
/// [`Constrained::write_consistent`] and [`pdo::unpack_consistent`](crate::pdo::unpack_consistent) ask for every value,
/// [`Dictionary::write`] and [`pdo::unpack`](crate::pdo::unpack) do not.
#[derive(Debug, Clone, Copy)]
pub struct Constraint<D> {
    /// Name in the specification.
    pub name: &'static str,
    /// Whether it holds now. Parts that name entries of other devices count as met.
    pub holds: fn(&D) -> bool,
}

/// A dictionary with conditions between its entries.
pub trait Constrained: Dictionary<'static> + 'static {
    /// The conditions, in the order of the specification.
    const CONSTRAINTS: &'static [Constraint<Self>];

    /// The first condition that does not hold; to be asked before parameters are stored or the output stage is enabled.
    fn broken_constraint(&self) -> Option<&'static Constraint<Self>> {
        Self::CONSTRAINTS.iter().find(|constraint| !(constraint.holds)(self))
    }

    /// [`write`](Dictionary::write) that takes back a value with which a condition breaks that held before, and then
    /// answers the client with [`AbortCode::INCOMPATIBLE`]. A client that changes several values has to keep to an order in
    /// which the conditions hold after each of them.
    ///
    /// # Errors
    /// The abort code for the client.
    fn write_consistent<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        data: &[u8],
        application: &mut A,
    ) -> Result<Self::Entry, AbortCode> {
        self.write(index, sub, data, &mut Consistent(application))
    }
}

/// An application that sees no value with which a condition breaks that held before: a service that is given it in place of
/// the application, an SDO server or the PDO engine, refuses such values as [`AbortCode::INCOMPATIBLE`].
#[derive(Debug)]
pub struct Consistent<'a, A>(
    /// The application.
    pub &'a mut A,
);

impl<D: Constrained, A: Application<D>> Application<D> for Consistent<'_, A> {
    fn is_unlocked(&self) -> bool {
        self.0.is_unlocked()
    }

    fn refresh(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.0.refresh(dictionary, entry);
    }

    fn accept(&mut self, dictionary: &mut D, entry: D::Entry, value: &[u8]) -> Result<(), AbortCode> {
        if !stays_consistent(dictionary, entry, value) {
            return Err(AbortCode::INCOMPATIBLE);
        }
        self.0.accept(dictionary, entry, value)
    }

    fn command(&mut self, dictionary: &mut D, command: Command) -> Result<(), AbortCode> {
        self.0.command(dictionary, command)
    }

    fn changed(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.0.changed(dictionary, entry);
    }

    fn read_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        self.0.read_domain(dictionary, entry, offset, buffer)
    }

    fn write_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        self.0.write_domain(dictionary, entry, offset, data, last)
    }
}

/// Whether every condition that holds now would hold with the value.
fn stays_consistent<D: Constrained>(dictionary: &mut D, entry: D::Entry, value: &[u8]) -> bool {
    let at = dictionary.table().found(dictionary.row(entry)).offset();
    // Conditions compute with integers; longer values are in none.
    let mut old = [0; 8];
    let Some(kept) = old.get_mut(..value.len()) else { return true };
    let swap = |dictionary: &mut D, bytes: &mut [u8]| {
        if let Some(place) = dictionary.image_mut().get_mut(at..at + bytes.len()) {
            place.swap_with_slice(bytes);
        }
    };
    kept.copy_from_slice(value);
    D::CONSTRAINTS.iter().all(|constraint| {
        let before = (constraint.holds)(dictionary);
        swap(dictionary, kept);
        let after = (constraint.holds)(dictionary);
        swap(dictionary, kept);
        after || !before
    })
}
