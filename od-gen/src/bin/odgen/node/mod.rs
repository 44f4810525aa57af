//! `odgen node`: the master of a bus that is reached by SLCAN over TCP.

mod access;
mod keep;
mod network;

use std::net::{TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use od_gen::client::{AccessError, Client, Contradiction, OpenError, SlcanBus, recognize};
use od_gen::trace;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::source::SourceMap;

use super::ERRORS;
use super::args::{LinkArgs, NodeArgs, NodeCommand, OneNodeArgs};
use super::report::{Report, Used, node_id};

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

/// What the specification of a command line says.
struct Described {
    used: Used,
    /// The texts that it was read from: messages about values point into them.
    sources: SourceMap,
}

/// A node of a known device.
#[derive(Clone, Copy)]
struct Target<'a> {
    id: u8,
    system: &'a System,
    device: &'a Dictionary,
}

impl Described {
    fn read(args: &OneNodeArgs, report: &Report) -> Result<Self, u8> {
        let spec = super::specs::one(Some(&args.spec), std::path::Path::new("."), report)?;
        let (used, sources) = report.compile_with_sources(&spec).ok_or(ERRORS)?;
        Ok(Self { used, sources })
    }

    /// The node that is meant: that of the command line, or else of a parameter file or a DCF.
    fn target(
        &self,
        args: &OneNodeArgs,
        device: Option<&str>,
        of_file: Option<u8>,
        report: &Report,
    ) -> Result<Target<'_>, u8> {
        let system = &self.used.system;
        let device = report.device_or_only(system, args.device.as_deref().or(device))?;
        let stated = args.node.as_deref().map(node_id).transpose().map_err(|one| report.refuse(one))?;
        let id = stated.or(of_file).or(self.used.stated_node_id).ok_or_else(|| {
            report.refuse(
                Diagnostic::without_place(codes::BAD_NODE_ID, "no node-ID is given")
                    .help("add `--node ID`, 1 to 127"),
            )
        })?;
        Ok(Target { id, system, device })
    }
}

impl<'a> Target<'a> {
    /// Words for its entries and values.
    fn words(self) -> trace::Node<'a> {
        trace::Node::new(self.id, self.system, self.device)
    }

    /// `pmc (node 5)`.
    fn name(self) -> String {
        format!("{} (node {})", self.device.key, self.id)
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

/// Connects to the bus of a node, which has to be the device that it is taken for: elsewhere the same entries mean other things.
fn reach(args: &OneNodeArgs, target: Target<'_>, report: &Report) -> Result<Client<SlcanBus>, u8> {
    let mut client = connect(&args.link, report)?;
    if args.any_device {
        return Ok(client);
    }
    let found = recognize(&mut client, target.id, target.device).map_err(|error| {
        let message = format!("cannot ask node {} what it is: {error}", target.id);
        report.refuse(helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), &error))
    })?;
    match found {
        None => Ok(client),
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
