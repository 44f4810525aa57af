//! Whether a node is the device that it is taken for.

use od_spec::model::{Dictionary, EntryId};

use super::scan::{DEVICE_TYPE, REVISION, SERIAL, identity};
use super::{AccessError, Bus, Client, Identity};

/// What a number says of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fact {
    /// Which device it is: device type, vendor, product.
    Device,
    /// Of which revision the device is.
    Revision,
    /// Which one of these devices it is.
    Serial,
}

/// A number of a node that is another one than was stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Contradiction {
    /// What it says.
    pub fact: Fact,
    /// Where it is.
    pub id: EntryId,
    /// What the node says.
    pub reported: u32,
    /// What is stated of it.
    pub stated: u32,
}

/// What is to be said of a node, in addition to what is stated of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remark {
    /// It does not report, or reports as 0, its revision or serial number, which is stated.
    Unreported(EntryId),
    /// It has a higher minor revision: it can do more, and the rest as stated.
    Newer(Contradiction),
    /// It is another one.
    Contradicts(Contradiction),
}

/// Asks a node whether it is the device of a dictionary, with a serial number where one is known: before values are taken for what that
/// dictionary says they are. On another device, revision and serial number say nothing.
///
/// # Errors
/// [`AccessError`], except for a number that the node refuses to report.
pub fn recognize<B: Bus>(
    client: &mut Client<B>,
    node: u8,
    device: &Dictionary,
    serial: Option<u32>,
) -> Result<Vec<Remark>, AccessError> {
    let stated = Identity::of(device);
    let single = |fact, id, number: Option<u32>| Some((fact, id, number.filter(|number| *number != 0)?));
    let revision = single(Fact::Revision, REVISION, stated.number(REVISION));
    let serial = single(Fact::Serial, SERIAL, serial);
    let facts = stated.stated().map(|(id, number)| (Fact::Device, id, number));
    let mut remarks = Vec::new();
    for (fact, id, stated) in facts.chain(revision).chain(serial) {
        let reported = match client.read(node, id) {
            Ok(bytes) => bytes.try_into().map(u32::from_le_bytes).ok(),
            Err(error) if error.is_of_entry() => None,
            Err(error) => return Err(error),
        };
        let differs = reported.filter(|reported| *reported != stated);
        let differs = differs.map(|reported| Contradiction { fact, id, reported, stated });
        match (fact, reported, differs) {
            (Fact::Revision | Fact::Serial, None | Some(0), _) => remarks.push(Remark::Unreported(id)),
            (Fact::Revision, _, Some(one)) if is_extension(one.reported, one.stated) => {
                remarks.push(Remark::Newer(one));
            }
            (Fact::Revision | Fact::Serial, _, Some(one)) => remarks.push(Remark::Contradicts(one)),
            (Fact::Device, _, Some(one)) => return Ok(vec![Remark::Contradicts(one)]),
            (_, _, None) => {}
        }
    }
    Ok(remarks)
}

/// How the revision of a node relates to that of a dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Revision {
    /// It is the same, or the dictionary does not state one.
    Same,
    /// The node has a higher minor revision, which is compatible.
    Newer,
    /// It is another one.
    Other,
    /// The node does not report it.
    Unreported,
}

impl Revision {
    /// That of a node and that of a dictionary.
    pub fn of(node: &Identity, device: &Identity) -> Self {
        let number = |identity: &Identity| identity.revision.filter(|revision| *revision != 0);
        match (number(node), number(device)) {
            (_, None) => Self::Same,
            (None, Some(_)) => Self::Unreported,
            (Some(reported), Some(stated)) if reported == stated => Self::Same,
            (Some(reported), Some(stated)) if is_extension(reported, stated) => Self::Newer,
            (Some(_), Some(_)) => Self::Other,
        }
    }
}

/// CiA 301, 1018h.3: with another major revision (the upper 16 bits) a device behaves otherwise; a higher minor one only adds something.
const fn is_extension(reported: u32, stated: u32) -> bool {
    reported >> 16 == stated >> 16 && reported > stated
}

/// What a node says of itself.
///
/// # Errors
/// [`AccessError`]: it does not answer.
pub fn introduced<B: Bus>(client: &mut Client<B>, node: u8) -> Result<Identity, AccessError> {
    match client.read(node, DEVICE_TYPE) {
        Err(error) if error.is_of_node() => Err(error),
        Ok(_) | Err(_) => Ok(identity(client, node)?),
    }
}
