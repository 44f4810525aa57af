//! The way to a bus: adapters by TCP or at a serial port, and CAN interfaces.

use std::net::{TcpStream, ToSocketAddrs as _};
use std::path::Path;
use std::time::Duration;

use od_bus::client::{
    AccessError, Bus, Client, Contradiction, Fact, Manner, OpenError, Port, Remark, Restart, SlcanBus,
    recognize,
};
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
    let remarks = recognize(client, target.id, target.device, target.serial).map_err(|error| {
        let node = target.position.map_or_else(|| format!("node {}", target.id), |_| target.name());
        report.refuse(not_asked(&node, &error))
    })?;
    let mut meant = Ok(());
    for remark in remarks {
        match remark {
            Remark::Unreported(id) => report.note(&format!(
                "{} does not report {}: whether it is the one that is meant is not known",
                target.name(),
                target.words().entry(id)
            )),
            Remark::Newer(one) => report.note(&format!(
                "{} has a newer revision, which is compatible: {}",
                target.name(),
                differs(target, &one)
            )),
            Remark::Contradicts(one) => match consent(args, one.fact) {
                Some(option) => {
                    report.note(&format!(
                        "accepted with `{option}`: {}: {}",
                        target.name(),
                        differs(target, &one)
                    ));
                }
                None => meant = Err(report.refuse(contradiction(target, &one))),
            },
        }
    }
    meant
}

/// The option by which the user goes on with a node that is another one in this.
fn consent(args: &OneNodeArgs, fact: Fact) -> Option<&'static str> {
    match fact {
        Fact::Device => None,
        Fact::Revision => args.any_revision.then_some("--any-revision"),
        Fact::Serial => args.any_serial.then_some("--any-serial"),
    }
}

/// `1018h.4 Identity object: Serial number is 0x00001268 there, 0x00001267 stated for it`.
fn differs(target: Target<'_>, one: &Contradiction) -> String {
    let whose = match one.fact {
        Fact::Device | Fact::Revision => "in the specification",
        Fact::Serial => "stated for it",
    };
    let entry = target.words().entry(one.id);
    format!("{entry} is 0x{:08X} there, 0x{:08X} {whose}", one.reported, one.stated)
}

/// What is said of a node that is another one.
fn contradiction(target: Target<'_>, one: &Contradiction) -> Diagnostic {
    let (is, help) = match one.fact {
        Fact::Device => (
            "no",
            "check node-ID, device and specification; `odgen node scan SPEC…` shows which nodes are on the bus, `--any-device` goes on all the same",
        ),
        Fact::Revision => (
            "another",
            "name a specification with the same upper 16 bits and no higher lower ones, or go on with `--any-revision`",
        ),
        Fact::Serial => (
            "another",
            "check node-ID and wiring; a spare part has a number of its own: correct it in the plant, or go on with `--any-serial`",
        ),
    };
    let device = &target.device.key;
    let message = format!("node {} is {is} `{device}`: {}", target.id, differs(target, one));
    Diagnostic::without_place(codes::OTHER_DEVICE, message).help(help)
}

/// What is said of a node that does not say what it is.
pub(super) fn not_asked(node: &str, error: &AccessError) -> Diagnostic {
    let message = format!("cannot ask {node} what it is: {error}");
    helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), error)
}

/// The exit code, after a message, where a node has started since the client is there: what it had may be half from before.
pub(super) fn has_started<B: Bus>(
    client: &mut Client<B>,
    node: u8,
    name: &str,
    report: &Report,
) -> Result<(), u8> {
    let how = match client.restarted(node).map_err(|error| report.refuse(broken(&error)))? {
        None => return Ok(()),
        Some(Restart::BootUp) => "",
        Some(Restart::FellBack) => ": its heartbeat fell back to pre-operational, and no command was heard",
    };
    let message = format!("{name} started again in the middle{how}");
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
    /// What can be done where nothing answers.
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
