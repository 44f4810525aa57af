//! `odgen node store` and `load-defaults`: a signature, which makes a node do something with a group of its parameters.

use od_bus::client::{AccessError, Client, introduced};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Index, SubIndex};

use super::args::NodeGroupArgs;
use super::network::numbers;
use super::reach::{AnyBus, not_asked};
use super::{Described, connect, has_started, no_node_id, reach};
use crate::interrupt::Interrupt;
use crate::report::{Report, node_id, print};

/// What is said of a command whose answer was lost or broken.
const PERHAPS: &str = "the command may have come all the same";

pub(super) fn store(args: &NodeGroupArgs, report: &Report) -> Result<u8, u8> {
    let addressed = Addressed::new(args, report)?;
    let done = format!("{} has stored its parameters", addressed.name);
    sign(addressed, args, (0x1010, *b"save"), ("store its parameters", &done), report)
}

pub(super) fn load_defaults(args: &NodeGroupArgs, report: &Report) -> Result<u8, u8> {
    let addressed = Addressed::new(args, report)?;
    let done = format!(
        "{} takes its defaults with the next reset: `odgen node nmt reset-node --node {}`",
        addressed.name, addressed.node
    );
    sign(addressed, args, (0x1011, *b"load"), ("load its defaults", &done), report)
}

/// A node that is about to get a command.
struct Addressed {
    client: Client<AnyBus>,
    node: u8,
    name: String,
    /// What it says of itself, where its kind was not stated.
    about: String,
}

impl Addressed {
    /// It is the device that is named, or else shown as what it is.
    fn new(args: &NodeGroupArgs, report: &Report) -> Result<Self, u8> {
        if let Some(spec) = &args.spec {
            let described = Described::read(spec, &args.node, report)?;
            let target = described.target(&args.node, None, report)?;
            let client = reach(&args.node, target, report)?;
            return Ok(Self { client, node: target.id, name: target.name(), about: String::new() });
        }
        let stated = args.node.node.as_deref().map_or_else(|| Err(no_node_id()), node_id);
        let node = stated.map_err(|diagnostic| report.refuse(diagnostic))?;
        let mut client = connect(&args.node.link, report)?;
        let name = format!("node {node}");
        let identity =
            introduced(&mut client, node).map_err(|error| report.refuse(not_asked(&name, &error)))?;
        let about = format!("    {}\n", numbers(&identity).join(", "));
        Ok(Self { client, node, name, about })
    }
}

/// Writes a signature.
fn sign(
    addressed: Addressed,
    args: &NodeGroupArgs,
    (index, signature): (u16, [u8; 4]),
    (what, done): (&str, &str),
    report: &Report,
) -> Result<u8, u8> {
    let Addressed { mut client, node, name, about } = addressed;
    let id = EntryId { index: Index(index), sub: SubIndex(args.group) };
    args.confirm.ask(
        &format!("{name} is commanded to {what} ({id})\n{about}"),
        &format!("let {name} {what}"),
        &Interrupt::noted(),
        report,
    )?;
    has_started(&mut client, node, &name, report)?;
    // What the node was commanded to do is waited for.
    let _interrupt = Interrupt::noted_with_hangup();
    client.write(node, id, &signature).map_err(|error| {
        let message = format!("{name} does not {what} ({id}): {error}");
        let diagnostic = Diagnostic::without_place(codes::ACCESS_FAILED, message);
        report.refuse(match error {
            AccessError::Silent => diagnostic
                .note(PERHAPS)
                .help("check node-ID, bit rate and power; storing may take long: `--timeout MS`"),
            error if error.is_of_entry() => diagnostic,
            _ => diagnostic.note(PERHAPS),
        })
    })?;
    let code = print(&format!("{done}\n"));
    has_started(&mut client, node, &name, report).map(|()| code)
}
