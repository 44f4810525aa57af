//! PDOs that are not described at all (CiA 306 4.6.3.4.1).

use std::collections::BTreeSet;

use super::entry;
use super::made;
use super::shape::{declaration, with_shape};
use crate::ast::{DefaultDecl, EntryDecl, ObjectDecl};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::{Access, DataType, Direction, Index, ObjectKind, SubIndex};
use crate::source::{Span, Spanned};

/// The parameter objects of PDOs that exist without being described: as many as `NrOfRXPDO` and `NrOfTXPDO` say beyond the
/// described ones, at the lowest free indices, with the communication parameters that `CompactPDO` names.
pub(super) fn add(view: &View<'_>, objects: &mut Vec<ObjectDecl>) {
    let Some(info) = view.section(Topic::DeviceInfo) else { return };
    let number = |key: &str| info.value(key).and_then(|text| lenient_integer(text.value)).unwrap_or(0);
    let mask = number("CompactPDO");
    if mask == 0 {
        return;
    }
    let place = info.key("CompactPDO").map_or(info.place(), |entry| entry.value.span);
    for direction in [Direction::Receive, Direction::Transmit] {
        let first = direction.first_communication_index();
        let key = match direction {
            Direction::Receive => "NrOfRXPDO",
            Direction::Transmit => "NrOfTXPDO",
        };
        let total = number(key).clamp(0, 512);
        let has: BTreeSet<u16> = objects.iter().map(|object| object.index.value.0).collect();
        let described = (0..512u16).filter(|at| has.contains(&(first + at))).count();
        let missing = usize::try_from(total).unwrap_or(0).saturating_sub(described);
        let free: Vec<u16> = (0..512u16).filter(|at| !has.contains(&(first + at))).take(missing).collect();
        for at in free {
            objects.push(communication(direction, at, mask, place));
            if !has.contains(&(first + 0x200 + at)) {
                objects.push(mapping(direction, at, place));
            }
        }
    }
}

/// A communication parameter object with the sub-indices that the mask names (bit 0 for sub-index 1).
fn communication(direction: Direction, at: u16, mask: i128, place: Span) -> ObjectDecl {
    let title = direction.pdo();
    let first = direction.first_communication_index();
    let base = match direction {
        Direction::Receive => 0x200,
        Direction::Transmit => 0x180,
    };
    let cob_id = match at {
        0..=3 => format!("$NODEID+0x{:X}", base + 0x100 * at),
        _ => "0x80000000".to_owned(),
    };
    let parameters = [
        (1u8, format!("COB-ID used by {title}"), DataType::Unsigned32),
        (2, "transmission type".to_owned(), DataType::Unsigned8),
        (3, "inhibit time".to_owned(), DataType::Unsigned16),
        (4, "compatibility entry".to_owned(), DataType::Unsigned8),
        (5, "event timer".to_owned(), DataType::Unsigned16),
        (6, "SYNC start value".to_owned(), DataType::Unsigned8),
    ];
    let named: Vec<_> = parameters.into_iter().filter(|(sub, ..)| mask >> (sub - 1) & 1 == 1).collect();
    let highest = named.last().map_or(0, |(sub, ..)| *sub);
    let members = named.into_iter().map(|(sub, name, data_type)| {
        let entry = entry::made_up(&name, data_type, Access::Rw, place);
        let default = (sub == 1).then(|| Spanned::new(DefaultDecl::Value(cob_id.clone()), place));
        (Spanned::new(SubIndex(sub), place), EntryDecl { default, ..entry })
    });
    let name = format!("{title} {} communication parameter", at + 1);
    let members: Vec<_> = members.collect();
    let sub0 = entry::count_of("highest sub-index supported", highest, Access::Const, place);
    let head = EntryDecl { name: Some(made(name, place)), ..EntryDecl::empty(place) };
    let object = ObjectDecl { sub0: Some(Box::new(sub0)), ..declaration(Index(first + at), place, head) };
    with_shape(object, ObjectKind::Record, members)
}

/// A mapping parameter object with room for 64 entries.
fn mapping(direction: Direction, at: u16, place: Span) -> ObjectDecl {
    let first = direction.first_communication_index() + 0x200;
    let title = direction.pdo();
    let members = (1..=64u8).map(|sub| {
        let entry = entry::made_up(&format!("mapped entry {sub}"), DataType::Unsigned32, Access::Rw, place);
        (Spanned::new(SubIndex(sub), place), entry)
    });
    let members: Vec<_> = members.collect();
    let name = made(format!("{title} {} mapping parameter", at + 1), place);
    let sub0 = entry::count_of("number of mapped entries", 0, Access::Rw, place);
    let head = EntryDecl { name: Some(name), ..EntryDecl::empty(place) };
    let object = ObjectDecl { sub0: Some(Box::new(sub0)), ..declaration(Index(first + at), place, head) };
    with_shape(object, ObjectKind::Record, members)
}
