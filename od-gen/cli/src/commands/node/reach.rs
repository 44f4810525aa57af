//! The way to a bus: adapters by TCP or at a serial port, and CAN interfaces.

use std::net::{TcpStream, ToSocketAddrs as _};
use std::path::Path;
use std::time::Duration;

use od_bus::client::{Bus, Client, Contradiction, Manner, OpenError, Port, Recognized, SlcanBus, recognize};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Index, SubIndex};

use super::args::{LinkArgs, OneNodeArgs};
use super::network::broken;
use super::{Target, helped};
use crate::link::{Link, Side};
use crate::report::Report;

/// A bus, however it is reached.
pub(super) type AnyBus = Box<dyn Bus>;

/// 1018h.4.
pub(super) const SERIAL_NUMBER: EntryId = EntryId { index: Index(0x1018), sub: SubIndex(4) };

/// An adapter that takes no connection for so long is not there.
const PATIENCE: Duration = Duration::from_secs(5);

/// Connects to the bus of a node, which has to be the device that it is taken for: elsewhere the same entries mean other things.
pub(super) fn reach(args: &OneNodeArgs, target: Target<'_>, report: &Report) -> Result<Client<AnyBus>, u8> {
    let mut client = connect(&args.link, report)?;
    is_meant(&mut client, args, target, report)?;
    Ok(client)
}

/// Demands that a node is the device that it is taken for.
pub(super) fn is_meant<B: Bus>(
    client: &mut Client<B>,
    args: &OneNodeArgs,
    target: Target<'_>,
    report: &Report,
) -> Result<(), u8> {
    if args.any_device {
        return Ok(());
    }
    let found = recognize(client, target.id, target.device, target.serial).map_err(|error| {
        let node = target.position.map_or_else(|| format!("node {}", target.id), |_| target.name());
        let message = format!("cannot ask {node} what it is: {error}");
        report.refuse(helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), &error))
    })?;
    match found {
        Recognized::Fits { untold } => {
            for id in untold {
                report.note(&format!(
                    "{} does not tell {}: whether it is the one that is meant is not known",
                    target.name(),
                    target.words().entry(id)
                ));
            }
            Ok(())
        }
        Recognized::Contradicts(Contradiction { id, told, stated, .. }) => {
            let entry = target.words().entry(id);
            let (is, whose) = if id == SERIAL_NUMBER {
                ("another", "stated for it")
            } else {
                ("no", "in the specification")
            };
            let message = format!(
                "node {} is {is} `{}`: {entry} is 0x{told:08X} there, 0x{stated:08X} {whose}",
                target.id, target.device.key
            );
            Err(report.refuse(Diagnostic::without_place(codes::OTHER_DEVICE, message).help(
                "check node-ID, device and specification; `odgen node scan SPEC…` tells who is on the bus, `--any-device` goes on all the same",
            )))
        }
    }
}

/// The exit code, after a message, where a node has started since the client is there: what it had may be half from before.
pub(super) fn has_started<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    report: &Report,
) -> Result<(), u8> {
    let started = client.started().map_err(|error| report.refuse(broken(&error)))?;
    if !started.contains(&target.id) {
        return Ok(());
    }
    let message = format!("{} started again in the middle", target.name());
    let help = "find out why, and repeat the command: what the node had not stored is lost";
    Err(report.refuse(Diagnostic::without_place(codes::ACCESS_FAILED, message).help(help)))
}

/// Connects to a bus, with a client of its nodes.
pub(super) fn connect(link: &LinkArgs, report: &Report) -> Result<Client<AnyBus>, u8> {
    let client = Client::new(bus(link, report)?, Duration::from_millis(link.timeout.into()));
    Ok(client.with_retries(link.retries))
}

/// Connects to a bus; an adapter opens its channel.
pub(super) fn bus(args: &LinkArgs, report: &Report) -> Result<AnyBus, u8> {
    let link = Link::of(&args.slcan, args.socketcan.as_deref(), Side::Master)
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    match &link {
        Link::Tcp(address) => {
            let no_one = "name an address at which an adapter speaks SLCAN; `odgen serve` is such a one";
            let adapter = Adapter { place: address, no_one, args, report };
            adapter.opened(stream(address).map_err(|error| adapter.refuse(&error, no_one))?)
        }
        Link::Serial { path, baud } => serial(path, *baud, args, report),
        Link::SocketCan(interface) => interface_of(interface, args, report),
        // The other side makes one.
        Link::Pty { .. } => Err(super::ERRORS),
    }
}

/// An adapter, and what is said where it cannot be used.
struct Adapter<'a> {
    place: &'a str,
    /// What can be done where nobody is there.
    no_one: &'static str,
    args: &'a LinkArgs,
    report: &'a Report,
}

impl Adapter<'_> {
    fn refuse(&self, error: &dyn std::fmt::Display, help: &'static str) -> u8 {
        let message = format!("cannot use the adapter at {}: {error}", self.place);
        self.report.refuse(Diagnostic::without_place(codes::NO_CONNECTION, message).help(help))
    }

    /// Opens its channel.
    fn opened<P: Port + 'static>(&self, port: P) -> Result<AnyBus, u8> {
        let bus = SlcanBus::open(port, self.args.bit_rate).map_err(|error| {
            let help = match error {
                OpenError::Bus(_) | OpenError::Silent => self.no_one,
                OpenError::BitRate(_) | OpenError::NoSuchBitRate(_) => {
                    "write `--bit-rate KBIT` as the adapter has it"
                }
                OpenError::Refused | _ => {
                    "some adapters need `--bit-rate KBIT`; another program may have it open"
                }
            };
            self.refuse(&error, help)
        })?;
        if bus.manner() == Manner::MayBeSilent {
            let place = self.place;
            self.report.note(&format!(
                "what is at {place} answers no command; some adapters never do, and need `--bit-rate KBIT`"
            ));
        }
        Ok(Box::new(bus))
    }
}

fn serial(path: &Path, baud: u32, args: &LinkArgs, report: &Report) -> Result<AnyBus, u8> {
    let no_one = "check the name of the port, and that you may use it: on Linux, members of the group of the port may (`ls -l`), often `dialout`";
    let place = crate::report::shown(path);
    let adapter = Adapter { place: &place, no_one, args, report };
    let port = od_bus::client::Serial::open(path, baud).map_err(|error| adapter.refuse(&error, no_one))?;
    adapter.opened(port)
}

#[cfg(target_os = "linux")]
fn interface_of(name: &str, args: &LinkArgs, report: &Report) -> Result<AnyBus, u8> {
    if args.bit_rate.is_some() {
        let message = format!("the system sets the bit rate of {name}, and not this command");
        return Err(report.refuse(
            Diagnostic::without_place(codes::BAD_NOTATION, message).help(
                "take `--bit-rate` out; `ip link set can0 up type can bitrate 125000` sets it, as root",
            ),
        ));
    }
    let opened = od_bus::socketcan::Interface::open(name);
    let interface = opened.map_err(|error| report.refuse(crate::link::no_interface(name, &error)))?;
    Ok(Box::new(interface))
}

#[cfg(not(target_os = "linux"))]
fn interface_of(_: &str, _: &LinkArgs, report: &Report) -> Result<AnyBus, u8> {
    Err(report.refuse(crate::link::not_here("CAN interfaces (SocketCAN)")))
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
