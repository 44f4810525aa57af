//! `odgen node`: the master of a bus that is reached by SLCAN over TCP.

mod access;
mod keep;
mod machine;
mod network;

use std::net::{TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use od_gen::client::{AccessError, Bus, Client, Contradiction, OpenError, SlcanBus, recognize};
use od_gen::trace;
use od_spec::diag::{Code, Diagnostic, Diagnostics, codes};
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::rule_codes;
use od_spec::source::SourceMap;

use super::ERRORS;
use super::args::{LinkArgs, NodeArgs, NodeCommand, OneNodeArgs};
use super::plant;
use super::report::{Report, Used, node_id};
use super::settings::ParameterFiles;
use machine::Machine;

pub(crate) fn run(args: &NodeArgs, report: &Report) -> u8 {
    let done = match &args.command {
        NodeCommand::Read(args) => access::read(args, report),
        NodeCommand::Write(args) => access::write(args, report),
        NodeCommand::Backup(args) => keep::backup(args, report),
        NodeCommand::Compare(args) => keep::compare(args, report),
        NodeCommand::Restore(args) => keep::restore(args, report),
        NodeCommand::Scan(args) => network::scan(args, report),
        NodeCommand::Nmt(args) => network::nmt(args, report),
        NodeCommand::Store(args) => network::store(args, report),
        NodeCommand::LoadDefaults(args) => network::load_defaults(args, report),
    };
    done.unwrap_or_else(|code| code)
}

/// An adapter that takes no connection for so long is not there.
const PATIENCE: Duration = Duration::from_secs(5);

/// What the specification or the plant of a command line says.
enum Described {
    /// Devices, one of which a node is; with the texts that they were read from, into which messages about values point.
    Devices { used: Box<Used>, sources: SourceMap },
    /// A machine with its nodes.
    Machine(Machine),
}

/// A node of a known device.
#[derive(Clone, Copy)]
struct Target<'a> {
    id: u8,
    /// Where it is on its machine.
    position: Option<&'a str>,
    system: &'a System,
    device: &'a Dictionary,
}

impl Described {
    fn read(args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        if plant::names_plant(&args.spec) {
            return Machine::read(args, report).map(Self::Machine);
        }
        if args.machine.is_some() || args.site.is_some() {
            let help = "name a plant file, or leave out `--machine` and `--site`";
            return Err(report.refuse(plant::no_plant(&args.spec, help)));
        }
        let spec = super::specs::one(Some(&args.spec), std::path::Path::new("."), report)?;
        let (used, sources) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
        Ok(Self::Devices { used: Box::new(used), sources })
    }

    fn sources(&self) -> &SourceMap {
        match self {
            Self::Devices { sources, .. } => sources,
            Self::Machine(machine) => machine.sources(),
        }
    }

    /// The node that is meant: that of the command line, or else of a parameter file or a DCF.
    fn target(
        &self,
        args: &OneNodeArgs,
        files: Option<&ParameterFiles>,
        report: &Report,
    ) -> Result<Target<'_>, u8> {
        let stated = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let stated = stated.or_else(|| files.and_then(ParameterFiles::stated_node));
        let key = args.device.as_deref();
        let used = match self {
            Self::Devices { used, .. } => used,
            Self::Machine(machine) => return machine.target(stated, key, report),
        };
        let system = &used.system;
        let device = match files {
            Some(files) => files.device(system, key, report)?,
            None => report.device_or_only(system, key)?,
        };
        let id = stated.or(used.stated_node_id).ok_or_else(|| {
            report.refuse(
                Diagnostic::without_place(codes::BAD_NODE_ID, "no node-ID is given")
                    .help("add `--node ID`, 1 to 127"),
            )
        })?;
        Ok(Target { id, position: None, system, device })
    }
}

impl<'a> Target<'a> {
    /// Words for its entries and values.
    fn words(self) -> trace::Node<'a> {
        trace::Node::new(self.id, self.system, self.device)
    }

    /// `pmc (node 5)`, of a machine `B pmc (node 12)`.
    fn name(self) -> String {
        let place = self.position.map_or_else(String::new, |position| format!("{position} "));
        format!("{place}{} (node {})", self.device.key, self.id)
    }

    /// What stands before lines that are about it, where others have such lines, too.
    fn mark(self) -> String {
        self.position.map_or_else(String::new, |_| format!("{}: ", self.name()))
    }

    /// What is said about an access that failed.
    fn failed(self, what: &str, id: EntryId, error: &AccessError) -> Diagnostic {
        let message = format!("{}: cannot {what} {}: {error}", self.name(), self.words().entry(id));
        helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), error)
    }
}

/// A message with what can be done about the failure.
fn helped(diagnostic: Diagnostic, error: &AccessError) -> Diagnostic {
    match error {
        AccessError::Silent => diagnostic
            .help("check node-ID, bit rate and power; a node that is stopped does not answer; `--timeout MS` waits longer"),
        _ => diagnostic,
    }
}

/// What a check says of values that go over a bus, sorted: nothing about the files that tools load at boot, whose lines hold no text with
/// a `;` and whose order is fixed, nor what `besides` names.
fn on_the_bus(found: &Diagnostics, besides: &[&Code]) -> Diagnostics {
    let of_files = [rule_codes::NO_ORDER, rule_codes::NOT_FOR_EDS];
    let mut about = Diagnostics::new();
    for one in found.iter().filter(|one| !of_files.contains(&one.code) && !besides.contains(&one.code)) {
        about.push(one.clone());
    }
    about.sort();
    about
}

/// Connects to the bus of a node, which has to be the device that it is taken for: elsewhere the same entries mean other things.
fn reach(args: &OneNodeArgs, target: Target<'_>, report: &Report) -> Result<Client<SlcanBus>, u8> {
    let mut client = connect(&args.link, report)?;
    is_meant(&mut client, args, target, report)?;
    Ok(client)
}

/// Demands that a node is the device that it is taken for.
fn is_meant<B: Bus>(
    client: &mut Client<B>,
    args: &OneNodeArgs,
    target: Target<'_>,
    report: &Report,
) -> Result<(), u8> {
    if args.any_device {
        return Ok(());
    }
    let found = recognize(client, target.id, target.device).map_err(|error| {
        let node = target.position.map_or_else(|| format!("node {}", target.id), |_| target.name());
        let message = format!("cannot ask {node} what it is: {error}");
        report.refuse(helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), &error))
    })?;
    match found {
        None => Ok(()),
        Some(Contradiction { id, told, stated, .. }) => {
            let entry = target.words().entry(id);
            let message = format!(
                "node {} is no `{}`: {entry} is 0x{told:08X} there, 0x{stated:08X} in the specification",
                target.id, target.device.key
            );
            Err(report.refuse(Diagnostic::without_place(codes::OTHER_DEVICE, message).help(
                "check node-ID, device and specification; `odgen node scan SPEC…` tells who is on the bus, `--any-device` goes on all the same",
            )))
        }
    }
}

/// Connects to the adapter and opens its channel.
fn connect(link: &LinkArgs, report: &Report) -> Result<Client<SlcanBus>, u8> {
    let address = link.slcan.strip_prefix("tcp:").ok_or_else(|| {
        let message = format!("found `{}`, expected an address", link.slcan);
        report.refuse(Diagnostic::without_place(codes::BAD_NOTATION, message).help(
            "write `--slcan tcp:HOST:PORT`, such as `tcp:127.0.0.1:3333`; a serial adapter gets one by `socat TCP-LISTEN:3333 /dev/ttyACM0,raw,b115200`",
        ))
    })?;
    let refuse = |error: &dyn std::fmt::Display, help: &'static str| {
        let message = format!("cannot use the adapter at {address}: {error}");
        report.refuse(Diagnostic::without_place(codes::NO_CONNECTION, message).help(help))
    };
    let no_one = "name an address at which an adapter speaks SLCAN; `odgen serve` is such a one";
    let stream = stream(address).map_err(|error| refuse(&error, no_one))?;
    let bus = SlcanBus::open(stream, link.bit_rate).map_err(|error| {
        let help = match error {
            OpenError::Bus(_) | OpenError::Silent => no_one,
            OpenError::BitRate(_) | OpenError::NoSuchBitRate(_) => {
                "write `--bit-rate KBIT` as the adapter has it"
            }
            OpenError::Refused | _ => {
                "some adapters need `--bit-rate KBIT`; another program may have it open"
            }
        };
        refuse(&error, help)
    })?;
    Ok(Client::new(bus, Duration::from_millis(link.timeout.into())))
}

/// A connection to the first of the addresses that takes one.
fn stream(address: &str) -> std::io::Result<TcpStream> {
    let mut why = std::io::Error::new(std::io::ErrorKind::NotFound, "there is no such host");
    for address in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(error) => why = error,
        }
    }
    Err(why)
}
