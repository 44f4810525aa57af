//! Who sends and who receives the PDOs of a machine.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use od_spec::plant::{Bus, MachineType, Message, Plant, Settled, Traffic};

use super::cell::plain;

/// The flag of an identifier of 29 bits, and the identifier without it.
const WIDE: u32 = 1 << 29;
const IDENTIFIER: u32 = 0x1FFF_FFFF;
/// Longest identifier of 11 bits.
const LONGEST_SHORT: u32 = 0x7FF;

/// A PDO on the machines of a type, and who is at its ends.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pdo {
    of_type: usize,
    id: u32,
    sent: Ends,
    received: Ends,
}

/// Who is at one end of a PDO.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Ends {
    /// Nodes, and maybe the master.
    Of(Vec<String>),
    /// No node; the type states what its master does.
    NoNode,
    /// No node, and the type says nothing of a master, which so may be there.
    Unstated,
}

impl Ends {
    fn words(&self) -> String {
        match self {
            Self::Of(who) => who.join(", "),
            Self::NoNode => "**no node**".to_owned(),
            Self::Unstated => "(master)".to_owned(),
        }
    }
}

/// The section about PDOs; nothing where no node has one.
pub(super) fn pdos(text: &mut String, plant: &Plant, settled: &[Settled]) {
    let mut pdos: BTreeMap<Pdo, usize> = BTreeMap::new();
    for kind in &plant.buses {
        let Some(bus) = Bus::of(plant, settled, kind.first) else { continue };
        let Some(of_type) = plant.types.get(kind.of_type) else { continue };
        for pdo in of_bus(&bus, kind.of_type, of_type) {
            *pdos.entry(pdo).or_default() += kind.count;
        }
    }
    if pdos.is_empty() {
        return;
    }
    text.push_str("\n## PDOs\n\nThe sender and the receivers of each PDO, and on how many machines.");
    if pdos.keys().any(|pdo| [&pdo.sent, &pdo.received].contains(&&Ends::Unstated)) {
        text.push_str(
            " In brackets: no node of the machine, so that it can only be the master, of which the type says nothing.",
        );
    }
    text.push_str("\n\n| type | COB-ID | sent by | received by | machines |\n|---|---|---|---|---|\n");
    for (pdo, machines) in &pdos {
        let of_type = plant.types.get(pdo.of_type).map_or_else(String::new, |one| plain(&one.name));
        let (sent, received) = (pdo.sent.words(), pdo.received.words());
        let _ =
            writeln!(text, "| {of_type} | {:03X}h | {sent} | {received} | {machines} |", pdo.id & IDENTIFIER);
    }
}

fn of_bus(bus: &Bus<'_>, type_number: usize, of_type: &MachineType) -> Vec<Pdo> {
    let master = of_type.master.as_ref();
    let of_master = |sends: bool| -> BTreeSet<u32> {
        let list = master.map(|master| if sends { &master.sends } else { &master.receives });
        list.into_iter().flatten().map(|id| identifier(id.value)).collect()
    };
    let (sends, receives) = (of_master(true), of_master(false));
    let pdos = || bus.messages.iter().filter(|message| matches!(message.traffic, Traffic::Pdo(..)));
    let ids: BTreeSet<u32> = pdos()
        .map(|message| message.id)
        .chain(sends.iter().copied())
        .chain(receives.iter().copied())
        .collect();
    let ends = |id: u32, is_sent: bool, by_master: &BTreeSet<u32>| {
        let nodes = pdos().filter(|message| message.id == id && message.is_sent == is_sent);
        let mut who: Vec<String> = nodes.map(|message| words(bus.plant, message)).collect();
        who.extend(by_master.contains(&id).then(|| "master".to_owned()));
        match (who.is_empty(), master) {
            (false, _) => Ends::Of(who),
            (true, Some(_)) => Ends::NoNode,
            (true, None) => Ends::Unstated,
        }
    };
    let pdo = |id| Pdo {
        of_type: type_number,
        id,
        sent: ends(id, true, &sends),
        received: ends(id, false, &receives),
    };
    ids.into_iter().map(pdo).collect()
}

/// As messages have it: what needs 29 bits has the flag that says so.
const fn identifier(id: u32) -> u32 {
    if id > LONGEST_SHORT { id | WIDE } else { id }
}

/// `B pmc TPDO 1`.
fn words(plant: &Plant, message: &Message) -> String {
    let node = plant.nodes.get(message.node);
    let device = node.and_then(|node| plant.devices.get(node.device)).map_or("", |device| &device.key);
    let position = node.map_or_else(String::new, |node| plain(&node.position));
    format!("{position} {device} {}", message.traffic.words())
}
