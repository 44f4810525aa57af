//! The messages of a bus: their senders, their receivers, and what they carry.

use std::collections::BTreeMap;

use od_spec::model::{Direction, EntryId, Pdo, PdoTarget};

use super::message::{Identifier, Message, Owner};
use super::names::node_name;
use super::signals::of_pdo;
use super::{LeftOut, Node, Silent, Why, services};

/// What goes over a bus, and what does not.
pub(super) struct Traffic {
    /// By identifier.
    pub messages: Vec<Message>,
    /// What the file cannot hold.
    pub left_out: Vec<LeftOut>,
    /// PDOs that are never sent as the nodes are set.
    pub silent: BTreeMap<u8, Silent>,
}

/// The messages of a bus, and what is not a message.
pub(super) fn messages(nodes: &[Node<'_>]) -> Traffic {
    let mut bus = Bus::default();
    for message in services::messages(nodes) {
        bus.add(message);
    }
    // The sender of a frame says what is in it; its receivers come after.
    for direction in [Direction::Transmit, Direction::Receive] {
        for node in nodes {
            for pdo in node.device.pdos_of(direction) {
                bus.add_pdo(node, pdo);
            }
        }
    }
    let Bus { by_id, left_out, silent } = bus;
    Traffic { messages: by_id.into_values().collect(), left_out, silent }
}

/// The states that an entry shows, or the commands that it takes, as all of its bits show them.
fn coding_of_machines(node: &Node<'_>, id: EntryId) -> Option<String> {
    let machines = node.system.machines.values().filter(|machine| machine.devices.includes(&node.device.key));
    let lines = machines.flat_map(|machine| {
        let states = machine.states.iter().filter(move |_| machine.status == id);
        let states = states.map(|state| ("state", state.name.as_str(), state.pattern.mask_and_value()));
        let commands = machine.commands.iter().filter(move |_| machine.command == id);
        let commands =
            commands.map(|command| ("command", command.name.as_str(), command.pattern.mask_and_value()));
        states.chain(commands)
    });
    lines
        .map(|(what, name, (mask, value))| format!("{what} {name}: {id} AND {mask:04X}h = {value:04X}h"))
        .reduce(|all, line| all + "\n" + &line)
}

#[derive(Default)]
struct Bus {
    by_id: BTreeMap<Identifier, Message>,
    left_out: Vec<LeftOut>,
    silent: BTreeMap<u8, Silent>,
}

impl Bus {
    fn add_pdo(&mut self, node: &Node<'_>, pdo: &Pdo) {
        let cob_id = pdo.cob_id.as_ref().filter(|_| pdo.valid && !pdo.map.is_empty());
        let raw = cob_id.and_then(|cob_id| u32::try_from(cob_id.integer_for(node.id)?).ok());
        let label = format!("{}{}", pdo.direction.pdo(), pdo.number);
        let what = format!("{label} of {}", node.name());
        let Some(id) = raw.and_then(Identifier::of_cob_id) else {
            let of_node = || Silent { node: node.name(), pdos: Vec::new() };
            self.silent.entry(node.id).or_insert_with(of_node).pdos.push(label);
            return;
        };
        let bits = pdo.bits();
        let (true, Ok(length)) = (bits <= 64, usize::try_from(bits.div_ceil(8))) else {
            self.left_out.push(LeftOut { what, why: Why::TooLong { bits } });
            return;
        };
        let mut comment = vec![what];
        comment.extend(pdo.about.get(node.system.language()).map(str::to_owned));
        comment.extend(pdo.transmission.map(|transmission| format!("transmission type {transmission}")));
        comment.extend(pdo.map.iter().filter_map(|mapped| match mapped.target {
            PdoTarget::Entry(id) => coding_of_machines(node, id),
            PdoTarget::Dummy(_) => None,
        }));
        let owner = Owner::Pdo { node: node.id, direction: pdo.direction };
        let of_node = node_name(node);
        let mut message = Message {
            length,
            signals: of_pdo(node, pdo),
            comment: comment.join("\n"),
            ..Message::of(owner, id, format!("{of_node}_{label}"))
        };
        match pdo.direction {
            Direction::Transmit => {
                message.sender = Some(of_node);
                message.cycle = pdo.event_timer.filter(|milliseconds| *milliseconds > 0);
            }
            Direction::Receive => message.receivers.push(of_node),
        }
        self.add(message);
    }

    /// Adds a message; a PDO that is received goes with the one that has its identifier.
    fn add(&mut self, message: Message) {
        let Some(known) = self.by_id.get_mut(&message.id) else {
            self.by_id.insert(message.id, message);
            return;
        };
        let is_joined = match (&known.owner, &message.owner) {
            (
                Owner::Pdo { direction: Direction::Transmit, .. },
                Owner::Pdo { direction: Direction::Receive, .. },
            ) => true,
            (
                Owner::Pdo { direction: Direction::Receive, .. },
                Owner::Pdo { direction: Direction::Receive, .. },
            ) => known.is_laid_out_as(&message),
            _ => false,
        };
        let first_line = |message: &Message| message.comment.lines().next().unwrap_or_default().to_owned();
        if !is_joined {
            let why = Why::TakenIdentifier { id: message.id.number(), by: first_line(known) };
            self.left_out.push(LeftOut { what: first_line(&message), why });
            return;
        }
        known.comment.push_str("\ntaken as ");
        known.comment.push_str(&first_line(&message));
        for receiver in message.receivers {
            if !known.receivers.contains(&receiver) {
                known.receivers.push(receiver);
            }
        }
    }
}
