//! What a node has, for a device that no file describes: its objects are asked for index by index.

use firmware_glue::AbortCode;
use od_spec::model::{EntryId, Index, SubIndex};

use super::{AccessError, Bus, Client};

/// An entry that a node has.
#[derive(Debug)]
#[non_exhaustive]
pub struct Found {
    /// Which.
    pub id: EntryId,
    /// What came when it was read.
    pub holds: Holds,
}

/// What an entry holds.
#[derive(Debug)]
pub enum Holds {
    /// Its value.
    Bytes(Vec<u8>),
    /// A value that can only be written.
    WriteOnly,
    /// A value that the node does not give now, or that was lost on the way.
    Unreported(AccessError),
}

/// No device has an object here (CiA 301 v4.02, table 37: reserved).
const NOWHERE: EntryId = EntryId { index: Index(0xFFFF), sub: SubIndex(0) };

/// The highest sub-index of an element.
const LAST: u8 = 254;

/// Asks a node for its objects, by reading them. It writes nothing.
#[derive(Debug)]
pub struct Prober<'c, B: Bus> {
    client: &'c mut Client<B>,
    node: u8,
    /// What the node says of an object that it cannot have.
    absent: AbortCode,
}

impl<'c, B: Bus> Prober<'c, B> {
    /// Learns how a node refuses what it does not have; `None` where it does not refuse it.
    ///
    /// # Errors
    /// [`AccessError`], except for the refusal.
    pub fn new(client: &'c mut Client<B>, node: u8) -> Result<Option<Self>, AccessError> {
        match client.read(node, NOWHERE) {
            Ok(_) => Ok(None),
            Err(AccessError::Refused(absent)) => Ok(Some(Self { client, node, absent })),
            Err(error) => Err(error),
        }
    }

    /// Microseconds from any beginning.
    pub fn now(&self) -> u64 {
        self.client.micros()
    }

    /// The entries of the object at an index, by sub-index; none where there is no object.
    ///
    /// # Errors
    /// [`AccessError`] of a node that does not answer any more.
    pub fn object(&mut self, index: Index) -> Result<Vec<Found>, AccessError> {
        let entry = |sub| EntryId { index, sub: SubIndex(sub) };
        let mut found = Vec::new();
        let listed = match self.entry(entry(0))? {
            Asked::NoObject => return Ok(found),
            Asked::NoEntry => 0,
            Asked::Has(holds) => {
                // Only a single byte can be a number of elements.
                let listed = match &holds {
                    Holds::Bytes(bytes) => <[u8; 1]>::try_from(bytes.as_slice()).ok().map(|[count]| count),
                    Holds::WriteOnly => None,
                    Holds::Unreported(_) => Some(0),
                };
                found.push(Found { id: entry(0), holds });
                let Some(listed) = listed else { return Ok(found) };
                listed
            }
        };
        let mut missing = 0;
        for sub in 1..=LAST {
            match self.entry(entry(sub))? {
                // Some nodes refuse any element at all. What has no value yet is there, as in a list of errors.
                Asked::Has(Holds::Unreported(ref why))
                    if sub > listed
                        && !matches!(why, AccessError::Refused(AbortCode::NO_DATA))
                        && matches!(self.entry(entry(LAST))?, Asked::Has(Holds::Unreported(_))) =>
                {
                    break;
                }
                Asked::Has(holds) => {
                    missing = 0;
                    found.push(Found { id: entry(sub), holds });
                }
                Asked::NoObject | Asked::NoEntry if sub <= listed => {}
                // There may be more than are counted, as in a mapping, and one may be reserved, as 1800h.4 is.
                Asked::NoObject | Asked::NoEntry if missing == 0 => missing = 1,
                Asked::NoObject | Asked::NoEntry => break,
            }
        }
        Ok(found)
    }

    fn entry(&mut self, id: EntryId) -> Result<Asked, AccessError> {
        Ok(match self.client.read(self.node, id) {
            Ok(bytes) => Asked::Has(Holds::Bytes(bytes)),
            Err(AccessError::Refused(AbortCode::NO_OBJECT)) => Asked::NoObject,
            Err(AccessError::Refused(AbortCode::NO_SUB_INDEX)) => Asked::NoEntry,
            Err(AccessError::Refused(code)) if code == self.absent => Asked::NoObject,
            Err(AccessError::Refused(AbortCode::WRITE_ONLY)) => Asked::Has(Holds::WriteOnly),
            Err(error) if error.is_of_node() => return Err(error),
            Err(error) => Asked::Has(Holds::Unreported(error)),
        })
    }
}

/// What a node says of an entry.
enum Asked {
    NoObject,
    NoEntry,
    Has(Holds),
}
