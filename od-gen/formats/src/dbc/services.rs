//! The services other than PDOs: NMT, SYNC, TIME, EMCY, heartbeat. SDO is left to tools that know it: what it carries
//! depends on the index.

use od_spec::model::{EntryId, ErrorCode, Index, SubIndex};

use super::Node;
use super::message::{Identifier, Message, Owner};
use super::names::{SignalName, node_name, signal_names};
use super::signals::{Signal, of_entry_at};
use crate::nmt;

const ERROR_REGISTER: EntryId = EntryId { index: Index(0x1001), sub: SubIndex(0) };

/// The messages of services, each with its identifier.
pub(super) fn messages(nodes: &[Node<'_>]) -> Vec<Message> {
    let mut messages = vec![nmt_message(nodes)];
    messages.extend(sync(nodes));
    messages.extend(time(nodes));
    for node in nodes {
        messages.extend(emergency(node));
        messages.push(heartbeat(node));
    }
    messages
}

fn signal(name: &str, first: u32, bits: u32) -> Signal {
    Signal::unsigned(SignalName::plain(name), (first, bits))
}

fn words(words: &[(u8, &str)]) -> Vec<(i128, String)> {
    words.iter().map(|(number, word)| (i128::from(*number), (*word).to_owned())).collect()
}

fn nmt_message(nodes: &[Node<'_>]) -> Message {
    let command = Signal { values: words(&nmt::COMMANDS), ..signal("NMT_command", 0, 8) };
    let mut names = vec![(0, "all nodes".to_owned())];
    names.extend(nodes.iter().map(|node| (i128::from(node.id), node.name())));
    let node_id = Signal { values: names, ..signal("NMT_node_id", 8, 8) };
    Message {
        receivers: nodes.iter().map(node_name).collect(),
        length: 2,
        signals: vec![command, node_id],
        comment: "NMT: what the master commands one node or all".to_owned(),
        ..Message::of(Owner::Bus("NMT"), Identifier::Standard(0), "NMT".to_owned())
    }
}

/// SYNC, where a node knows it; with a counter where a node says that there is one.
fn sync(nodes: &[Node<'_>]) -> Option<Message> {
    let of = |node: &Node<'_>| Identifier::of_cob_id(node.parameter(0x1005, 0)?);
    let id = nodes.iter().find_map(of)?;
    let has_counter = nodes.iter().any(|node| node.parameter(0x1019, 0).is_some_and(|highest| highest > 0));
    let counter = Signal { limits: ("1".to_owned(), "240".to_owned()), ..signal("SYNC_counter", 0, 8) };
    // In multiples of a millisecond, as tools have it.
    let cycle =
        nodes.iter().filter_map(|node| node.parameter(0x1006, 0)).find(|microseconds| *microseconds > 0);
    let whole = cycle.filter(|microseconds| microseconds % 1000 == 0).map(|microseconds| microseconds / 1000);
    Some(Message {
        receivers: nodes.iter().filter(|node| of(node) == Some(id)).map(node_name).collect(),
        length: usize::from(has_counter),
        signals: if has_counter { vec![counter] } else { Vec::new() },
        comment: "SYNC: synchronous PDOs go with it".to_owned(),
        cycle: whole.and_then(|milliseconds| u16::try_from(milliseconds).ok()),
        ..Message::of(Owner::Bus("SYNC"), id, "SYNC".to_owned())
    })
}

fn time(nodes: &[Node<'_>]) -> Option<Message> {
    let of = |node: &Node<'_>| Identifier::of_cob_id(node.parameter(0x1012, 0)?);
    let id = nodes.iter().find_map(of)?;
    let milliseconds = Signal {
        unit: "ms".to_owned(),
        comment: "after midnight".to_owned(),
        ..signal("TIME_of_day", 0, 28)
    };
    let days = Signal {
        unit: "d".to_owned(),
        comment: "since 1984-01-01".to_owned(),
        ..signal("TIME_days", 32, 16)
    };
    Some(Message {
        receivers: nodes.iter().filter(|node| of(node) == Some(id)).map(node_name).collect(),
        length: 6,
        signals: vec![milliseconds, days],
        comment: "TIME: the time of day".to_owned(),
        ..Message::of(Owner::Bus("TIME"), id, "TIME".to_owned())
    })
}

/// EMCY, where the device sends it.
fn emergency(node: &Node<'_>) -> Option<Message> {
    let cob_id = node.parameter(0x1014, 0).filter(|cob_id| cob_id >> 31 == 0)?;
    let id = Identifier::of_cob_id(cob_id)?;
    let mut codes: Vec<(i128, String)> = node
        .system
        .errors
        .iter()
        .filter(|error| error.devices.includes(&node.device.key))
        .map(|error| (i128::from(error.code), error.name.clone()))
        .collect();
    if !codes.iter().any(|(code, _)| *code == i128::from(ErrorCode::NONE)) {
        codes.insert(0, (i128::from(ErrorCode::NONE), "no error, or reset".to_owned()));
    }
    let mut signals = vec![Signal { values: codes, ..signal("EMCY_error_code", 0, 16) }];
    let (named, of_register): (Vec<_>, Vec<_>) = of_entry_at(node, ERROR_REGISTER, 8, 16).into_iter().unzip();
    let names = signal_names(&named).into_iter();
    // It comes with a message; nothing of it is there at the start.
    signals.extend(names.zip(of_register).map(|(name, signal)| Signal { name, start: None, ..signal }));
    signals.push(Signal {
        comment: "five bytes of the maker".to_owned(),
        ..signal("EMCY_manufacturer", 24, 40)
    });
    Some(Message {
        sender: Some(node_name(node)),
        length: 8,
        signals,
        comment: format!("EMCY of {}", node.name()),
        ..Message::of(
            Owner::Node { node: node.id, what: "EMCY".to_owned() },
            id,
            format!("{}_EMCY", node_name(node)),
        )
    })
}

/// Boot-up, heartbeat and the answer to node guarding.
fn heartbeat(node: &Node<'_>) -> Message {
    let mut signals = vec![Signal { values: words(&nmt::STATES), ..signal("NMT_state", 0, 7) }];
    if node.parameter(0x100C, 0).is_some() {
        signals.push(Signal {
            comment: "changes with each answer to node guarding".to_owned(),
            ..signal("toggle", 7, 1)
        });
    }
    let id = 0x700 + u16::from(node.id);
    let cycle = node.parameter(0x1017, 0).filter(|milliseconds| *milliseconds > 0);
    Message {
        sender: Some(node_name(node)),
        length: 1,
        signals,
        comment: format!("boot-up and heartbeat of {}", node.name()),
        cycle: cycle.and_then(|milliseconds| u16::try_from(milliseconds).ok()),
        ..Message::of(
            Owner::Node { node: node.id, what: "heartbeat".to_owned() },
            Identifier::Standard(id),
            format!("{}_heartbeat", node_name(node)),
        )
    }
}
