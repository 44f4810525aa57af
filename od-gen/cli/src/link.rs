//! How a bus is reached: what `--slcan` and `--socketcan` say.

use std::path::PathBuf;

use od_spec::diag::{Diagnostic, codes};
use od_spec::visible::visible;

/// Bits per second of a serial port, unless the command line says others.
const BAUD: u32 = 115_200;

/// Who asks: the same notations are not good for both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// Nodes, to which clients come.
    Nodes,
    /// A master, which goes to an adapter.
    Master,
}

/// Where a bus is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Link {
    /// SLCAN over TCP: `HOST:PORT`.
    Tcp(String),
    /// SLCAN at a serial port.
    Serial { path: PathBuf, baud: u32 },
    /// SLCAN at a pseudo-terminal that is made, under a name of one's own where one is given.
    Pty { name: Option<PathBuf> },
    /// A CAN interface of Linux.
    SocketCan(String),
}

impl Link {
    /// What the two options say; the second one has the last word.
    pub(crate) fn of(slcan: &str, socketcan: Option<&str>, side: Side) -> Result<Self, Diagnostic> {
        if let Some(interface) = socketcan {
            return Ok(Self::SocketCan(interface.to_owned()));
        }
        let (kind, rest) = slcan.split_once(':').unwrap_or((slcan, ""));
        match (kind, side) {
            ("tcp", _) if !rest.is_empty() => Ok(Self::Tcp(rest.to_owned())),
            ("serial", Side::Master) if !rest.is_empty() => Ok(serial(rest)),
            ("pty", Side::Nodes) => {
                Ok(Self::Pty { name: Some(rest).filter(|name| !name.is_empty()).map(PathBuf::from) })
            }
            ("serial", Side::Nodes) => Err(refusal(
                slcan,
                "a port that is made here",
                "`odgen serve` is the adapter: write `--slcan pty`, and open the port that it names",
            )),
            ("pty", Side::Master) => Err(refusal(
                slcan,
                "a port that is there",
                "write `--slcan serial:PATH` with the port that `odgen serve --slcan pty` names",
            )),
            (_, Side::Nodes) => Err(refusal(
                slcan,
                "an address",
                "write `--slcan tcp:HOST:PORT`, such as `tcp:127.0.0.1:3333`, or `--slcan pty`",
            )),
            (_, Side::Master) => Err(refusal(
                slcan,
                "an address",
                "write `--slcan tcp:HOST:PORT`, such as `tcp:127.0.0.1:3333`, or `--slcan serial:PORT`, such as `serial:/dev/ttyACM0`",
            )),
        }
    }
}

fn refusal(found: &str, expected: &str, help: &str) -> Diagnostic {
    let message = format!("found `{}`, expected {expected}", visible(found));
    Diagnostic::without_place(codes::BAD_NOTATION, message).help(help)
}

/// `/dev/ttyACM0`, `/dev/ttyUSB0@1000000`.
fn serial(text: &str) -> Link {
    let stated = text.rsplit_once('@').and_then(|(path, baud)| Some((path, baud.parse().ok()?)));
    let (path, baud) = stated.unwrap_or((text, BAUD));
    Link::Serial { path: PathBuf::from(path), baud }
}

/// What is said where this program cannot do it.
#[cfg(not(target_os = "linux"))]
pub(crate) fn not_here(what: &str) -> Diagnostic {
    Diagnostic::without_place(codes::NO_CONNECTION, format!("odgen has no {what} on this system"))
        .help("use SLCAN over TCP: `--slcan tcp:HOST:PORT`")
}

/// What is said of a CAN interface that cannot be used.
#[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "there are none"))]
pub(crate) fn no_interface(name: &str, error: &std::io::Error) -> Diagnostic {
    let message = format!("cannot use the CAN interface {}: {error}", visible(name));
    Diagnostic::without_place(codes::NO_CONNECTION, message).help(
        "`ip link` lists the interfaces; `ip link set can0 up type can bitrate 125000` starts one, as root",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_has_its_links() {
        let of = |slcan, side| Link::of(slcan, None, side).map_err(|refused| refused.code.id);
        let port = |path: &str, baud| Ok(Link::Serial { path: path.into(), baud });
        assert_eq!(of("tcp:[::1]:3333", Side::Master), Ok(Link::Tcp("[::1]:3333".to_owned())));
        assert_eq!(of("serial:/dev/ttyACM0", Side::Master), port("/dev/ttyACM0", 115_200));
        assert_eq!(of("serial:/dev/a@b@1000000", Side::Master), port("/dev/a@b", 1_000_000));
        assert_eq!(of("serial:/dev/by@id", Side::Master), port("/dev/by@id", 115_200));
        assert_eq!(of("pty", Side::Nodes), Ok(Link::Pty { name: None }));
        assert_eq!(of("pty:bus", Side::Nodes), Ok(Link::Pty { name: Some("bus".into()) }));
        for (wrong, side) in [
            ("", Side::Master),
            ("tcp:", Side::Master),
            ("serial:", Side::Master),
            ("pty", Side::Master),
            ("serial:/dev/ttyACM0", Side::Nodes),
            ("/dev/ttyACM0", Side::Master),
        ] {
            assert_eq!(of(wrong, side), Err(codes::BAD_NOTATION.id), "{wrong}");
        }
        assert_eq!(
            Link::of("tcp:x", Some("can0"), Side::Master).ok(),
            Some(Link::SocketCan("can0".to_owned()))
        );
    }
}
