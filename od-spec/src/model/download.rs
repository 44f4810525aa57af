//! In which order the values of a node are written into it.
//!
//! Some parameters can be changed only while what they belong to is switched off (CiA 301 7.5.2): a PDO's mapping while the
//! PDO does not exist, the number of mapped entries before the entries, an identifier while its message does not exist. So
//! a download has phases: off, set, on; the commands that keep what was written come last. Among the values, conditions between
//! entries may ask for an order of their own.

use std::collections::BTreeMap;
use std::fmt;

use super::{Course, Dictionary, EntryId, Index, Pdo, Stuck, SubIndex, System, Value};
use crate::order::Arrange as _;

/// One SDO download.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Write {
    /// The entry.
    pub id: EntryId,
    /// Its value on the bus, least significant byte first.
    pub bytes: Vec<u8>,
}

/// A value that cannot be written: the device has no such entry, or the entry's type no such value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoSuchValue(pub EntryId);

impl fmt::Display for NoSuchValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no entry {} that could have the value", self.0)
    }
}

impl std::error::Error for NoSuchValue {}

/// The writes that give a node its values, in an order that a device takes in any state of its parameters, as long as it is
/// not operational.
///
/// Values that are not given keep what the node has, with one exception: of a PDO whose mapping is given in part, the whole
/// mapping is written, with the defaults for the rest, so that the PDO carries what was meant whatever it carried before. A
/// PDO that is touched ends with the COB-ID that is given, or else its default.
///
/// Conditions between entries hold after each write where they held before, for a node that begins with its defaults; where no
/// order does that, what the device refuses comes last.
///
/// # Errors
/// A value that no entry of the device can have. Values from [`assign`](crate::assign) always can.
pub fn download(
    system: &System,
    device: &Dictionary,
    values: &BTreeMap<EntryId, Value>,
    node: u8,
) -> Result<Vec<Write>, NoSuchValue> {
    let mut order = Order { device, values, node, writes: BTreeMap::new() };
    for pdo in &device.pdos {
        order.pdo(pdo)?;
    }
    for id in values.keys() {
        order.single(*id)?;
    }
    Ok(order.arranged(system))
}

/// When an entry is written; within a phase, ascending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Phase {
    /// What is to be changed is switched off.
    Off,
    /// Mappings are emptied: their number of entries is 0.
    Empty,
    /// Values.
    Set,
    /// The numbers of mapped entries.
    Count,
    /// What was switched off is switched on again.
    On,
    /// What was written is kept: 1010h stores it, 1020h notes that it is there.
    Keep,
}

/// COB-ID of PDO, EMCY and SDO: the message does not exist (CiA 301 7.5.2.17, 7.5.2.35).
const NOT_VALID: i128 = 1 << 31;
/// COB-ID of SYNC and TIME: the device produces the message (CiA 301 7.5.2.5).
const PRODUCER: i128 = 1 << 30;

/// Communication cycle period, in µs.
const SYNC_PERIOD: EntryId = id(0x1006, 0);
/// Synchronous counter overflow value.
const SYNC_COUNTER: EntryId = id(0x1019, 0);

const fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

struct Order<'a> {
    device: &'a Dictionary,
    values: &'a BTreeMap<EntryId, Value>,
    node: u8,
    writes: BTreeMap<(Phase, EntryId), Vec<u8>>,
}

impl Order<'_> {
    /// The value that the entry is to have: the given one, or its default.
    fn intended(&self, id: EntryId) -> Option<&Value> {
        self.values.get(&id).or_else(|| self.device.entry(id)?.default.as_ref())
    }

    fn intended_integer(&self, id: EntryId) -> Option<i128> {
        self.intended(id)?.integer_for(self.node)
    }

    fn is_writable(&self, id: EntryId) -> bool {
        self.device.entry(id).is_some_and(|entry| entry.access.is_writable())
    }

    fn write(&mut self, phase: Phase, id: EntryId, value: &Value) -> Result<(), NoSuchValue> {
        let entry = self.device.entry(id).ok_or(NoSuchValue(id))?;
        let bytes = value.bytes_for(entry.data_type, self.node).ok_or(NoSuchValue(id))?;
        self.writes.insert((phase, id), bytes);
        Ok(())
    }

    /// A number on the way to the value that is meant. An entry whose limits do not allow it has nothing to switch off.
    fn pass(&mut self, phase: Phase, id: EntryId, raw: i128) -> Result<(), NoSuchValue> {
        let can = self.device.entry(id).is_some_and(|entry| entry.access.is_writable() && entry.allows(raw));
        if can { self.write(phase, id, &Value::Integer(raw)) } else { Ok(()) }
    }

    /// A PDO: off, its mapping emptied, parameters, mapping, number of entries, on.
    fn pdo(&mut self, pdo: &Pdo) -> Result<(), NoSuchValue> {
        let (communication, mapping) = (pdo.communication_index(), pdo.mapping_index());
        let is_given = |index: u16| self.values.keys().any(|id| id.index.0 == index);
        let remapped = is_given(mapping);
        if !remapped && !is_given(communication) {
            return Ok(());
        }
        let cob_id = id(communication, 1);
        if self.is_writable(cob_id)
            && let Some(raw) = self.intended_integer(cob_id)
        {
            self.switched_off(cob_id, raw, raw | NOT_VALID)?;
        }
        if remapped {
            self.mapping(mapping)?;
        }
        Ok(())
    }

    /// The writes by phase; in that of the values, conditions between them are kept.
    fn arranged(self, system: &System) -> Vec<Write> {
        let values = self.writes.keys().filter(|(phase, _)| *phase == Phase::Set);
        let values = values.filter_map(|(_, id)| Some((*id, self.intended(*id)?)));
        let ordered = match Course::new(system, self.device, self.node).order(values) {
            Ok(ordered) => ordered,
            Err(Stuck { ordered, left }) => ordered.into_iter().chain(left).collect(),
        };
        let rank: BTreeMap<EntryId, usize> = ordered.into_iter().zip(0..).collect();
        let mut writes: Vec<((Phase, EntryId), Vec<u8>)> = self.writes.into_iter().collect();
        writes.arrange_by_key(|((phase, id), _)| {
            let at = if *phase == Phase::Set { rank.get(id).copied() } else { None };
            (*phase, at, *id)
        });
        writes.into_iter().map(|((_, id), bytes)| Write { id, bytes }).collect()
    }

    fn mapping(&mut self, mapping: u16) -> Result<(), NoSuchValue> {
        let number = id(mapping, 0);
        let count = self.intended_integer(number).unwrap_or_default();
        self.pass(Phase::Empty, number, 0)?;
        for sub in (1..=u8::MAX).take_while(|sub| i128::from(*sub) <= count) {
            let mapped = id(mapping, sub);
            if self.is_writable(mapped)
                && let Some(value) = self.intended(mapped).cloned()
            {
                self.write(Phase::Set, mapped, &value)?;
            }
        }
        if count != 0 && self.is_writable(number) {
            self.write(Phase::Count, number, &Value::Integer(count))?;
        }
        Ok(())
    }

    /// A value that the entry can take only while it is off; once, if it means "off" itself.
    fn switched_off(&mut self, id: EntryId, intended: i128, off: i128) -> Result<(), NoSuchValue> {
        if intended != off {
            self.pass(Phase::Off, id, off)?;
        }
        self.write(if intended == off { Phase::Off } else { Phase::On }, id, &Value::Integer(intended))
    }

    /// A given value, unless it has been written with its PDO.
    fn single(&mut self, id: EntryId) -> Result<(), NoSuchValue> {
        let Some(value) = self.values.get(&id) else { return Ok(()) };
        let of_pdo = self.device.pdos.iter().any(|pdo| {
            let is_cob_id = id.index.0 == pdo.communication_index() && id.sub.0 == 1;
            is_cob_id || id.index.0 == pdo.mapping_index() && id.sub.0 == 0
        });
        match (id.index.0, id.sub.0, value.integer_for(self.node)) {
            _ if of_pdo => Ok(()),
            (0x1005 | 0x1012, 0, Some(raw)) => self.switched_off(id, raw, raw & !PRODUCER),
            (0x1014, 0, Some(raw)) | (0x1028, 1.., Some(raw)) | (0x1200..=0x12FF, 1 | 2, Some(raw)) => {
                self.switched_off(id, raw, raw | NOT_VALID)
            }
            // No node is watched twice, not even in between.
            (0x1016, 1.., Some(_)) => {
                self.pass(Phase::Off, id, 0)?;
                self.write(Phase::Set, id, value)
            }
            (0x1019, 0, _) => {
                self.pass(Phase::Off, SYNC_PERIOD, 0)?;
                self.write(Phase::Set, id, value)?;
                match self.intended_integer(SYNC_PERIOD).filter(|period| *period != 0) {
                    Some(period) => self.pass(Phase::On, SYNC_PERIOD, period),
                    None => Ok(()),
                }
            }
            // Written with the counter.
            (0x1006, 0, _) if self.values.contains_key(&SYNC_COUNTER) => Ok(()),
            (0x1010 | 0x1020, ..) => self.write(Phase::Keep, id, value),
            _ => self.write(Phase::Set, id, value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;
    use crate::{NoFiles, compile};

    const SPECIFICATION: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp:
    name: Lamp
    bit-rates: [125]
    features: [sync producer, sync counter, emergency, heartbeat consumer, heartbeat producer, verify configuration]
objects:
  0x1016: {from: cia301, array: {count: 2}}
  0x2000: {name: brightness, type: unsigned8, access: rw, pdo: receive}
  0x2001: {name: label, type: visible-string, access: rw, capacity: 8}
  0x2002: {name: low, type: unsigned8, access: rw, default: 20}
  0x2003: {name: high, type: unsigned8, access: rw, default: 40}
  0x2004: {name: calibration, type: unsigned8, access: rw, default: 2, writable-when: \"0x2005 == 1\"}
  0x2005: {name: service, type: unsigned8, access: rw, default: 0}
pdos:
  lamp:
    receive: {1: {map: [0x2000]}}
constraints:
  thresholds keep their order: {require: \"0x2002 < 0x2003\"}
";

    fn lamp() -> System {
        let mut sources = SourceMap::new();
        let root = sources.add("lamp.od.yaml", SPECIFICATION);
        let compiled = compile(&mut sources, root, &mut NoFiles);
        compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
    }

    /// The download as text, an entry and a number each.
    fn order(values: &[(EntryId, i128)]) -> Vec<String> {
        let values = values.iter().map(|(id, raw)| (*id, Value::Integer(*raw))).collect();
        let system = lamp();
        let writes = download(&system, &system.devices[0], &values, 5).unwrap();
        let number =
            |bytes: &[u8]| bytes.iter().rev().fold(0u64, |number, byte| number << 8 | u64::from(*byte));
        writes.iter().map(|write| format!("{}={:X}h", write.id, number(&write.bytes))).collect()
    }

    #[test]
    fn a_pdo_is_off_while_it_changes_and_its_mapping_is_written_whole() {
        assert_eq!(
            order(&[(id(0x1600, 2), 0x2000_0008), (id(0x1600, 0), 2), (id(0x2000, 0), 1)]),
            [
                "1400h.1=80000205h",
                "1600h=0h",
                "1600h.1=20000008h",
                "1600h.2=20000008h",
                "2000h=1h",
                "1600h=2h",
                "1400h.1=205h"
            ]
        );
    }

    #[test]
    fn a_pdo_that_stays_off_is_not_switched_on() {
        assert_eq!(order(&[(id(0x1400, 1), 0x8000_0205)]), ["1400h.1=80000205h"]);
        assert_eq!(order(&[(id(0x1400, 2), 1)]), ["1400h.1=80000205h", "1400h.2=1h", "1400h.1=205h"]);
        assert_eq!(
            order(&[(id(0x1600, 0), 0)]),
            ["1400h.1=80000205h", "1600h=0h", "1400h.1=205h"],
            "a mapping of nothing"
        );
    }

    #[test]
    fn messages_are_off_while_their_identifiers_change() {
        assert_eq!(order(&[(id(0x1014, 0), 0x90)]), ["1014h=80000090h", "1014h=90h"]);
        assert_eq!(order(&[(id(0x1005, 0), 0x4000_0081)]), ["1005h=81h", "1005h=40000081h"]);
        assert_eq!(order(&[(id(0x1005, 0), 0x81)]), ["1005h=81h"]);
        assert_eq!(
            order(&[(id(0x1006, 0), 1000), (id(0x1019, 0), 10)]),
            ["1006h=0h", "1019h=Ah", "1006h=3E8h"]
        );
        assert_eq!(
            order(&[(id(0x1016, 1), 0x0006_03E8), (id(0x1016, 2), 0x0007_03E8)]),
            ["1016h.1=0h", "1016h.2=0h", "1016h.1=603E8h", "1016h.2=703E8h"]
        );
    }

    #[test]
    fn what_keeps_the_values_comes_last() {
        assert_eq!(
            order(&[(id(0x1020, 1), 1), (id(0x1020, 2), 2), (id(0x1400, 2), 1), (id(0x2000, 0), 3)]),
            ["1400h.1=80000205h", "1400h.2=1h", "2000h=3h", "1400h.1=205h", "1020h.1=1h", "1020h.2=2h"]
        );
    }

    #[test]
    fn conditions_between_values_are_kept_on_the_way() {
        assert_eq!(order(&[(id(0x2002, 0), 50), (id(0x2003, 0), 60)]), ["2003h=3Ch", "2002h=32h"]);
        assert_eq!(order(&[(id(0x2002, 0), 5), (id(0x2003, 0), 10)]), ["2002h=5h", "2003h=Ah"]);
        assert_eq!(order(&[(id(0x2004, 0), 3), (id(0x2005, 0), 1)]), ["2005h=1h", "2004h=3h"]);
        assert_eq!(
            order(&[(id(0x2004, 0), 3), (id(0x2005, 0), 2)]),
            ["2005h=2h", "2004h=3h"],
            "what the device refuses comes last"
        );
    }

    #[test]
    fn formulas_are_resolved_and_what_does_not_fit_is_reported() {
        let system = lamp();
        let write = |id, value| download(&system, &system.devices[0], &BTreeMap::from([(id, value)]), 5);
        let writes = write(id(0x1014, 0), Value::NodeId(0x80)).unwrap();
        assert_eq!(writes.last().map(|write| write.bytes.as_slice()), Some(&[0x85, 0, 0, 0][..]));
        assert_eq!(write(id(0x2000, 0), Value::Integer(256)), Err(NoSuchValue(id(0x2000, 0))));
        assert_eq!(write(id(0x3000, 0), Value::Integer(1)), Err(NoSuchValue(id(0x3000, 0))));
        let label = write(id(0x2001, 0), Value::Text("lamp".to_owned())).unwrap();
        assert_eq!(label, [Write { id: id(0x2001, 0), bytes: b"lamp".to_vec() }]);
    }
}
