//! `odgen node scan` and `nmt`: what needs no dictionary.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

use od_bus::client::{Answer, BusError, Heard, Identity, Revision};
use od_formats::nmt;
use od_spec::diag::{Diagnostic, codes};

use super::args::{NmtName, NodeNmtArgs, NodeScanArgs};
use super::connect;
use super::specify::{self, Wanted};
use crate::exit::ERRORS;
use crate::report::{Report, node_id, print, shown};
use crate::specs;

/// A node starts within this time.
const START: Duration = Duration::from_secs(5);

/// What is said where nothing goes over the bus.
pub(super) fn broken(error: &BusError) -> Diagnostic {
    Diagnostic::without_place(codes::ACCESS_FAILED, error.to_string())
        .help("check adapter, bit rate and wires")
}

/// Lists the nodes that are heard, each with the devices that it can be. Two devices with one node-ID are a fault of the bus.
pub(super) fn scan(args: &NodeScanArgs, report: &Report) -> Result<u8, u8> {
    let mut known: Vec<(String, Identity)> = Vec::new();
    let paths = if args.specs.is_empty() {
        Vec::new()
    } else {
        specs::all(&args.specs, std::path::Path::new("."), report)?
    };
    for path in paths {
        let system = report.compile(&path).ok_or(ERRORS)?;
        known.extend(system.devices.iter().map(|device| {
            (format!("{} ({}) of {}", device.key, device.name, shown(&path)), Identity::of(device))
        }));
    }
    let mut client = connect(&args.link, report)?;
    let specify = |client: &mut _, node, file: &PathBuf| {
        let wanted = Wanted { node, bit_rate: args.link.bit_rate, file, args: &args.specify };
        specify::specify(client, wanted, report)
    };
    if let (Some(file), Some(node)) = (&args.specify.write_spec, &args.specify.node) {
        let node = node_id(node).map_err(|diagnostic| report.refuse(diagnostic))?;
        return specify(&mut client, node, file);
    }
    let within = Duration::from_millis(args.link.timeout.into());
    let found = od_bus::client::scan(&mut client, within).map_err(|error| report.refuse(broken(&error)))?;
    if found.is_empty() {
        let message = "no node answers, and none is heard";
        return Err(report.refuse(Diagnostic::without_place(codes::ACCESS_FAILED, message).help(
            "check bit rate, wires and power; a node that is stopped, and sends no heartbeat, is not heard",
        )));
    }
    let text: String = found.iter().map(|heard| described(heard, &known)).collect();
    let code = print(&text);
    let shared = found.iter().filter(|heard| heard.answer == Answer::Two);
    let shared: Vec<String> = shared.map(|heard| heard.node.to_string()).collect();
    if shared.is_empty() {
        return match &args.specify.write_spec {
            None => Ok(code),
            Some(file) => {
                let node = only(&found).map_err(|diagnostic| report.refuse(*diagnostic))?;
                specify(&mut client, node, file).map(|written| code.max(written))
            }
        };
    }
    let message = format!("two devices have one node-ID: {}", shared.join(", "));
    Err(report.refuse(Diagnostic::without_place(codes::BAD_NODE_ID, message).help(
        "switch one of them off, and give the other one a node-ID of its own: by its switches, or by LSS",
    )))
}

/// The only node that answers.
fn only(found: &[Heard]) -> Result<u8, Box<Diagnostic>> {
    let answering: Vec<u8> =
        found.iter().filter(|heard| heard.answer != Answer::None).map(|heard| heard.node).collect();
    if let [only] = answering.as_slice() {
        return Ok(*only);
    }
    let message = match answering.len() {
        0 => "no node answers, and a specification is made from answers".to_owned(),
        count => format!("a specification is of one node, and {count} answer"),
    };
    Err(Box::new(Diagnostic::without_place(codes::BAD_NODE_ID, message).help("add `--node ID`")))
}

/// The lines about a node.
fn described(heard: &Heard, known: &[(String, Identity)]) -> String {
    let state = heard.state.map(|state| {
        let word = nmt::word(&nmt::STATES, state);
        word.map_or_else(|| format!("unknown state {state}"), ToOwned::to_owned)
    });
    let identity = match &heard.answer {
        Answer::Of(identity) => identity,
        Answer::None | _ => {
            let what = if heard.answer == Answer::Two { "answers twice" } else { "does not answer" };
            let state = state.map_or_else(String::new, |state| format!(", heard: {state}"));
            return format!("node {}  {what}{state}\n", heard.node);
        }
    };
    let mut parts = numbers(identity);
    parts.extend(state);
    let mut text = format!("node {}  {}\n", heard.node, parts.join(", "));
    let mut fits = known.iter().filter(|(_, known)| identity.fits(known)).peekable();
    if fits.peek().is_none() && !known.is_empty() {
        text.push_str("    none of the specifications fits\n");
    }
    for (device, known) in fits {
        let remark = match Revision::of(identity, known) {
            Revision::Same => "",
            Revision::Newer => ", of a newer revision, which is compatible",
            Revision::Other => ", of another revision",
            Revision::Unreported => ", of an unknown revision",
        };
        let _ = writeln!(text, "    can be {device}{remark}");
    }
    text
}

/// `device type 0x00000000`, `vendor 0x00001234`: what a node says of itself.
pub(super) fn numbers(identity: &Identity) -> Vec<String> {
    let Identity { device_type, vendor, product, revision, serial, name, .. } = identity;
    let of = [
        ("device type", device_type),
        ("vendor", vendor),
        ("product", product),
        ("revision", revision),
        ("serial number", serial),
    ];
    let numbers =
        of.iter().filter_map(|(what, number)| number.map(|number| format!("{what} 0x{number:08X}")));
    numbers.chain(name.as_ref().map(|name| format!("name \"{name}\""))).collect()
}

/// Sends a command; after a reset, waits for the node to be there again.
pub(super) fn nmt(args: &NodeNmtArgs, report: &Report) -> Result<u8, u8> {
    let node = match args.node.as_str() {
        "all" => 0,
        text => node_id(text).map_err(|diagnostic| report.refuse(diagnostic))?,
    };
    let (byte, is_reset) = match args.command {
        NmtName::Start => (1, false),
        NmtName::Stop => (2, false),
        NmtName::PreOperational => (128, false),
        NmtName::ResetNode => (129, true),
        NmtName::ResetCommunication => (130, true),
    };
    let mut client = connect(&args.link, report)?;
    client.command(byte, node).map_err(|error| report.refuse(broken(&error)))?;
    if node == 0 {
        return Ok(print("sent to all nodes, which do not answer\n"));
    }
    if !is_reset {
        return Ok(print(&format!("sent to node {node}, which does not answer to it\n")));
    }
    if client.booted(node, START).map_err(|error| report.refuse(broken(&error)))? {
        return Ok(print(&format!("node {node} has started again\n")));
    }
    let message = format!("node {node} was commanded to start again, and no boot-up message came within 5 s");
    Err(report.refuse(
        Diagnostic::without_place(codes::ACCESS_FAILED, message).help("check node-ID, bit rate and power"),
    ))
}
