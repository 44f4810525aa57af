//! Messages that a device sends and receives have COB-IDs of their own, on every node: SYNC, TIME, EMCY, the EMCY of other nodes that it listens to, SDO
//! channels and PDOs, as long as they exist. Only RPDOs may share one.

use std::collections::BTreeSet;

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{NOT_VALID, Parameter, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{About, Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Fact, Index, Object, Value};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0504",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "two services with one COB-ID",
    explanation: "Two PDOs that are valid after start-up, a PDO or an SDO channel and SYNC, TIME or EMCY, the \
        emergency message of another node (1028h) and one of these, or two of them use one identifier; an SDO client \
        talks to the server of its own node. The device would disturb its own traffic, and a receiver would take one \
        for the other. What is switched off uses no identifier, and several RPDOs may listen to one message. Give one \
        of them another identifier, or make the PDO `valid: no`.",
    clause: Some("CiA 301, tables 33 and 34 (pre-defined connection set)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}, 2: {cob-id: $NODEID + 0x180, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}, 2: {map: [level]}}}",
    )),
};

/// Bit of 1012h: the device sends TIME itself.
const PRODUCER: i128 = 1 << 30;
/// The first SDO channel, which every node has: requests and answers on node 0.
const FIRST_CHANNEL: [(i128, &str); 2] = [(0x600, "requests"), (0x580, "answers")];

/// What a message is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Message {
    Sync,
    Time,
    Emergency,
    /// The emergency message of this node, which the device listens to.
    EmergencyOf(u8),
    /// Of an SDO server other than the first.
    SdoServer,
    SdoClient,
    /// Of the SDO server that every node has.
    FirstSdoServer,
    Rpdo,
    Tpdo,
}

impl Message {
    /// Whether two messages may have one identifier on a node.
    const fn may_be(self, other: Self, node: u8) -> bool {
        match (self, other) {
            // All of them receive it, whatever node sends it.
            (Self::Rpdo, Self::Rpdo) => true,
            // Its own, of which the device hears nothing.
            (Self::EmergencyOf(sender), Self::Emergency) | (Self::Emergency, Self::EmergencyOf(sender)) => {
                sender == node
            }
            // That its identifiers are kept from all others is said by itself.
            (Self::FirstSdoServer, Self::SdoClient) | (Self::SdoClient, Self::FirstSdoServer) => false,
            (Self::FirstSdoServer, _) | (_, Self::FirstSdoServer) => true,
            (
                Self::Sync
                | Self::Time
                | Self::Emergency
                | Self::EmergencyOf(_)
                | Self::SdoServer
                | Self::SdoClient
                | Self::Rpdo
                | Self::Tpdo,
                _,
            ) => false,
        }
    }
}

/// Where an identifier comes from.
enum Source<'a> {
    /// From an entry with a value.
    Value(&'a Value),
    /// From the node-ID, which is added to this.
    Fixed(i128),
}

/// Something that has a COB-ID.
struct User<'a> {
    message: Message,
    name: String,
    /// The value of the COB-ID; none where it is fixed.
    about: Option<About>,
    source: Source<'a>,
    place: Span,
    is_set: bool,
}

impl<'a> User<'a> {
    fn of(message: Message, name: String, parameter: &Parameter<'a>) -> Self {
        let (value, is_set) = (parameter.value, parameter.entry.is_set());
        Self {
            message,
            name,
            about: Some((parameter.id, Fact::Default).into()),
            source: Source::Value(value),
            place: parameter.place,
            is_set,
        }
    }

    /// The identifier on a node, where the message exists. That 0 cannot be one is said by itself.
    fn identifier(&self, node: u8) -> Option<i128> {
        let raw = match &self.source {
            Source::Value(value) => value.integer_for(node)?,
            Source::Fixed(base) => base + i128::from(node),
        };
        let exists = match self.message {
            // In 1005h, bit 31 says nothing.
            Message::Sync | Message::FirstSdoServer => true,
            // In 1012h, it says that the device listens.
            Message::Time => raw & (NOT_VALID | PRODUCER) != 0,
            Message::Emergency
            | Message::EmergencyOf(_)
            | Message::SdoServer
            | Message::SdoClient
            | Message::Rpdo
            | Message::Tpdo => raw & NOT_VALID == 0,
        };
        Some(raw & 0x1FFF_FFFF).filter(|id| exists && *id != 0)
    }

    const fn is_formula(&self) -> bool {
        matches!(self.source, Source::Value(Value::NodeId(_)) | Source::Fixed(_))
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let users = users(subject);
    let (mut blamed, mut identifiers) = (BTreeSet::new(), Vec::new());
    for node in subject.nodes() {
        identifiers.clear();
        let used = |(at, user): (usize, &User<'_>)| Some((user.identifier(node)?, at));
        identifiers.extend(users.iter().enumerate().filter_map(used));
        identifiers.sort_unstable();
        for shared in identifiers.chunk_by(|(first, _), (second, _)| first == second) {
            for (before, (_, at)) in shared.iter().enumerate() {
                let second = &users[*at];
                let mut others = shared[..before].iter().map(|(_, at)| &users[*at]);
                let clash = others.find(|first| !first.message.may_be(second.message, node));
                // One finding for each, on the first node where it clashes.
                if let Some(first) = clash.filter(|_| blamed.insert(*at)) {
                    findings.push_each(finding(subject, first, second, node));
                }
            }
        }
    }
}

/// The services, the SDO channels, and then the PDOs.
fn users<'a>(subject: &Subject<'a>) -> Vec<User<'a>> {
    let (subject, device) = (*subject, subject.device);
    let services = [(0x1005, Message::Sync), (0x1012, Message::Time), (0x1014, Message::Emergency)];
    let services = services.into_iter().filter_map(|(index, message)| {
        let parameter = subject.parameter(index, 0)?;
        let service = match message {
            Message::Sync => "SYNC",
            Message::Time => "TIME",
            _ => "EMCY",
        };
        Some(User::of(message, format!("{service} ({})", parameter.id), &parameter))
    });
    let senders = device.objects.get(&Index(0x1028)).into_iter().flat_map(Object::counted);
    let senders = senders.filter_map(|entry| {
        let (sender, parameter) = (entry.sub.0, subject.parameter(0x1028, entry.sub.0)?);
        let name = format!("EMCY of node {sender} ({})", parameter.id);
        Some(User::of(Message::EmergencyOf(sender), name, &parameter))
    });
    let first_channel = FIRST_CHANNEL.map(|(base, what)| User {
        message: Message::FirstSdoServer,
        name: format!("{what} of the first SDO channel"),
        about: None,
        source: Source::Fixed(base),
        place: device.span,
        is_set: false,
    });
    let pdos = device.pdos.iter().filter_map(|pdo| {
        let parameter = subject.communication(pdo, 1)?;
        let message = match pdo.direction {
            Direction::Receive => Message::Rpdo,
            Direction::Transmit => Message::Tpdo,
        };
        Some(User::of(message, title(pdo), &parameter))
    });
    services.chain(senders).chain(first_channel).chain(channels(&subject)).chain(pdos).collect()
}

/// The two directions of each SDO channel other than the first; it exists while both are valid.
fn channels<'a>(subject: &Subject<'a>) -> impl Iterator<Item = User<'a>> {
    let subject = *subject;
    let exists = move |parameter: &Parameter<'_>| {
        let valid = |node| parameter.value.integer_for(node).is_some_and(|raw| raw & NOT_VALID == 0);
        subject.nodes().any(valid)
    };
    let channels = subject.device.objects.range(Index(0x1201)..Index(0x1300)).map(|(index, _)| *index);
    let both = channels.filter_map(move |index| {
        let (first, second) = (subject.parameter(index.0, 1)?, subject.parameter(index.0, 2)?);
        (exists(&first) && exists(&second)).then_some([first, second])
    });
    both.flatten().map(|parameter| {
        let message = match parameter.id.index.0 {
            0x1280.. => Message::SdoClient,
            _ => Message::SdoServer,
        };
        User::of(message, format!("the SDO channel ({})", parameter.id), &parameter)
    })
}

fn finding(subject: &Subject<'_>, first: &User<'_>, second: &User<'_>, node: u8) -> Diagnostic {
    let differ = first.is_formula() != second.is_formula();
    let on_node = if differ && subject.node.is_none() { format!(" on node {node}") } else { String::new() };
    // What a library says has no place in the specification.
    let is_placed = |user: &User<'_>| user.place != subject.device.span;
    let is_firsts = first.is_set && !second.is_set || is_placed(first) && !is_placed(second);
    let (blamed, namesake) = if is_firsts { (first, second) } else { (second, first) };
    let message =
        format!("{} and {} of `{}` have one COB-ID{on_node}", first.name, second.name, subject.device.key);
    let help = subject.help(Help {
        specification: "give one of them another COB-ID, or switch one off: for a PDO `valid: no` (bit 31)",
        eds: "give one of them another COB-ID, or switch one off: bit 31 (except SYNC and TIME)",
        setting: "give one of them another COB-ID, or switch one off: bit 31 (except SYNC and TIME)",
    });
    let diagnostic = Diagnostic::new(CODE, blamed.place, message).label(blamed.name.clone()).help(help);
    let diagnostic = Diagnostic { about: blamed.about, ..diagnostic };
    if is_placed(namesake) { diagnostic.with(namesake.place, namesake.name.clone()) } else { diagnostic }
}
