//! `odgen serve`.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::Stdio;
use std::time::Duration;

use crate::node_of_file::{PUMP, without_node};
use crate::plant::presses;
use crate::served::{Served, interrupt};
use crate::{LAMP, Scratch, code, odgen, stderr};

/// A server with a client.
struct WithClient {
    served: Served,
    client: TcpStream,
}

impl WithClient {
    fn lamps(scratch: &Scratch, more: &[&str]) -> Self {
        let arguments = [&["lamp.od.yaml", "--node", "5"], more].concat();
        let served = Served::start(scratch, &arguments, Stdio::piped());
        let nodes = if more.contains(&"6") { "lamp (node 5), lamp (node 6)" } else { "lamp (node 5)" };
        assert!(served.line.starts_with(&format!("serving {nodes} at tcp:127.0.0.1:")), "{}", served.line);
        Self::of(served)
    }

    fn of(served: Served) -> Self {
        let client = TcpStream::connect(served.address().trim_start_matches("tcp:")).unwrap();
        client.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        Self { served, client }
    }

    /// Sends bytes, and reads as many as are expected.
    fn ask(&mut self, bytes: &str, expected: &str) {
        self.client.write_all(bytes.as_bytes()).unwrap();
        let mut answer = vec![0; expected.len()];
        self.client.read_exact(&mut answer).unwrap();
        assert_eq!(String::from_utf8(answer).unwrap(), expected);
    }
}

#[test]
fn clients_talk_to_nodes_by_slcan() {
    let scratch = Scratch::new("serve");
    scratch.file("lamp.od.yaml", LAMP);
    let mut served = WithClient::lamps(&scratch, &["--node", "6", "--log"]);
    served.ask("C\rS6\r\rO\r", "\r\r\r\r");
    served.ask("V\rx\rt6059\r", "V1010\r\u{7}\u{7}");
    // Brightness is 80; 200 is too much.
    served.ask("t60584000200000000000\r", "z\rt58584F00200050000000\r");
    served.ask("t60582F002000C8000000\r", "z\rt58588000200031000906\r");
    served.ask("t60682F00200010000000\r", "z\rt58686000200000000000\r");
    // All nodes begin anew.
    served.ask("t00028100\r", "z\rt705100\rt706100\r");
    served.ask("r7051\r", "z\rt70517F\r");
    served.ask("T000000050\r", "Z\r");
    // A line that is too long, and one after it.
    served.ask(&format!("t{}\rV\r", "0".repeat(100)), "\u{7}V1010\r");
    served.served.child.kill().unwrap();
    let mut log = String::new();
    served.served.child.stderr.take().unwrap().read_to_string(&mut log).unwrap();
    let reported: Vec<&str> =
        log.lines().filter_map(|line| line.split_once(")  ")).map(|(_, reported)| reported).collect();
    assert_eq!(
        reported,
        [
            "705h  lamp (node 5)  boot-up",
            "706h  lamp (node 6)  boot-up",
            "605h  lamp (node 5)  SDO →  read 2000h brightness",
            "585h  lamp (node 5)  SDO ←  2000h brightness = 80 %",
            "605h  lamp (node 5)  SDO →  write 2000h brightness = 200 %",
            "585h  lamp (node 5)  SDO ←  abort 2000h brightness: 0609 0031h: value of parameter written too high",
            "606h  lamp (node 6)  SDO →  write 2000h brightness = 16 %",
            "586h  lamp (node 6)  SDO ←  2000h brightness written",
            "000h  NMT  reset node: all nodes",
            "705h  lamp (node 5)  boot-up",
            "706h  lamp (node 6)  boot-up",
            "705h  lamp (node 5)  node guarding  asked for its state",
            "705h  lamp (node 5)  heartbeat  pre-operational",
            "00000005h  unknown: an identifier of 29 bits, 0 bytes",
        ],
        "{log}"
    );
}

impl WithClient {
    /// Sends a frame, and waits for a line with this end; heartbeats of other nodes may come between.
    fn answers(&mut self, frame: &str, expected: &str) {
        self.client.write_all(frame.as_bytes()).unwrap();
        let mut seen = String::new();
        while !seen.ends_with(expected) {
            let mut byte = [0];
            self.client.read_exact(&mut byte).unwrap_or_else(|_| panic!("{seen} without {expected}"));
            seen.push(char::from(byte[0]));
        }
    }
}

impl WithClient {
    /// The brightness of the next TPDO.
    fn brightness(&mut self) -> u8 {
        let mut frame = [0; 8];
        self.client.read_exact(&mut frame).unwrap();
        let frame = str::from_utf8(&frame).unwrap();
        let digits = frame.strip_prefix("t1851").unwrap_or_else(|| panic!("{frame:?}"));
        u8::from_str_radix(digits.trim_end(), 16).unwrap()
    }
}

/// A DCF says what its node is set to, whatever gives the node-ID, and what follows the node-ID moves with it.
#[test]
fn nodes_have_the_values_of_their_dcf() {
    for (name, pump, node, cob_id) in [
        ("own", PUMP.to_owned(), 5, "85"),
        ("without", without_node(), 5, "85"),
        ("moved", PUMP.to_owned(), 9, "89"),
    ] {
        let scratch = Scratch::new(&format!("serve-dcf-{name}"));
        scratch.file("pump.dcf", pump);
        let arguments = ["pump.dcf", "--node", &node.to_string()];
        let mut served = WithClient::of(Served::start(&scratch, &arguments, Stdio::null()));
        served.ask("O\r", "\r");
        let mut ask = |entry: &str, command: &str, value: &str| {
            served.ask(
                &format!("t60{node}840{entry}00000000\r"),
                &format!("z\rt58{node}8{command}{entry}{value}\r"),
            );
        };
        ask("001A00", "4F", "01000000");
        ask("001A01", "43", "10000220");
        ask("002000", "4B", "DC050000");
        ask("001801", "43", &format!("{cob_id}010000"));
    }
}

/// A lamp that reports its brightness and its errors.
fn lamp_that_tells() -> String {
    LAMP.replace("[heartbeat producer]", "[heartbeat producer, emergency]")
        .replace("pdo: receive", "pdo: transmit")
        .replace("receive: {1: {map: [brightness]}}", "transmit: {1: {map: [brightness]}}")
        + "constraints:\n  dim: {require: \"0x2000 != 60\", about: Not at 60.}\n"
}

#[test]
fn a_script_is_carried_out() {
    let scratch = Scratch::new("serve-script");
    scratch.file("lamp.od.yaml", lamp_that_tells());
    let mut served = WithClient::lamps(&scratch, &["--script", "-", "--consistent"]);
    served.ask("O\r", "\r");
    let mut input = served.served.child.stdin.take().unwrap();
    writeln!(input, "# Nothing yet.\n\n5 fault 0x4210\n5 fault 0x4210").unwrap();
    served.ask("", "t08581042090000000000\r");
    served.ask("t60582F0020003C000000\r", "z\rt58588000200043000406\r");
    served.ask("t00020105\r", "z\r");
    writeln!(
        input,
        "5 set 2000=200 %\n  7 clear 1\n5 claer 1\n5 set brightness=60 %\nwait 0.01\n5 clear 0x4210"
    )
    .unwrap();
    served.ask("", "t18513C\rt08580000000000000000\r");
    served.served.child.kill().unwrap();
    let mut log = String::new();
    served.served.child.stderr.take().unwrap().read_to_string(&mut log).unwrap();
    assert!(log.contains("note: node 5: error 4210h is present already"), "{log}");
    assert!(log.contains("node 5: 2000h (brightness) cannot be set to this: 0609 0031h"), "{log}");
    assert!(log.contains("<stdin>:6:3"), "{log}");
    assert!(log.contains("<stdin>:7:3") && log.contains("did you mean `clear`?"), "{log}");
}

#[test]
fn a_fault_sets_the_bits_that_are_stated_for_it() {
    let scratch = Scratch::new("serve-register");
    // Its class, 50xxh, says nothing of the kind.
    let stated = lamp_that_tells() + "errors:\n  0x5000: {name: supply, register: voltage}\n";
    scratch.file("lamp.od.yaml", stated);
    let mut served = WithClient::lamps(&scratch, &["--script", "-"]);
    served.ask("O\r", "\r");
    let mut input = served.served.child.stdin.take().unwrap();
    writeln!(input, "5 fault 0x5000").unwrap();
    served.ask("", "t08580050050000000000\r");
    writeln!(input, "5 fault 0x5001").unwrap();
    served.ask("", "t08580150050000000000\r");
    writeln!(input, "5 clear 0x5000").unwrap();
    served.ask("", "t08580000010000000000\r");
}

#[test]
fn a_script_with_mistakes_is_refused_as_a_whole() {
    let scratch = Scratch::new("serve-mistakes");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file(
        "day.txt",
        "wait 1\nwait -1\n5\n6 clear 1\n5 fault 0\n5 fault 0x10000\n5 set bright=1\n5 set 2000\nclear 5\n5 set 2000=x\n",
    );
    let arguments = ["serve", "lamp.od.yaml", "--node", "5", "--script", "day.txt", "--format", "short"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!((code(&output), output.stdout.as_slice()), (1, &b""[..]));
    insta::assert_snapshot!(stderr(&output));
}

#[test]
fn an_address_has_its_protocol() {
    let scratch = Scratch::new("serve-address");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["serve", "lamp.od.yaml", "--node", "5", "--slcan", "/dev/ttyUSB0"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("write `--slcan tcp:HOST:PORT`"), "{}", stderr(&output));
}

#[test]
fn the_nodes_of_a_machine_are_served_as_the_plant_sets_them() {
    let scratch = presses("serve-plant");
    let served = Served::start(&scratch, &["plant.yaml", "--machine", "6"], Stdio::null());
    let nodes = "drive (node 11), supply (node 2), drive (node 22)";
    assert!(served.line.starts_with(&format!("serving {nodes} at tcp:")), "{}", served.line);
    let mut served = WithClient::of(served);
    // Node 22: lowest voltage, which is 520.0 V, and the serial number.
    served.ask("O\r", "\r");
    served.answers("t61684000300000000000\r", "t59684B00300050140000\r");
    served.answers("t61684018100400000000\r", "t59684318100467120000\r");
    // Node 2: calibration, a locked entry.
    served.answers("t60284001200000000000\r", "65000000\r");
}

#[test]
fn a_machine_is_one_of_a_plant() {
    let scratch = presses("serve-machine");
    let mut reported = String::new();
    for arguments in [
        &["plant.yaml"][..],
        &["plant.yaml", "--machine", "66"],
        &["plant.yaml", "--machine", "6", "--site", "Hal"],
        &["plant.yaml", "--node", "5"],
        &["plant.yaml", "press.od.yaml"],
        &["press.od.yaml", "--machine", "6"],
        &["gone.yaml", "--machine", "6"],
    ] {
        for command in ["serve", "decode"] {
            let output = odgen(&scratch.0, &[&[command][..], arguments, &["--format", "short"]].concat());
            let line = format!("{} {}", code(&output), stderr(&output));
            if command == "serve" {
                reported += &line;
            }
            assert!(reported.ends_with(&line), "{command} {arguments:?}: {line}");
        }
    }
    insta::assert_snapshot!(reported);
}

#[test]
fn a_trace_of_a_machine_is_decoded() {
    let scratch = presses("decode-plant");
    scratch.file("bus.log", "(1.0) can0 616#4000300000000000\n(1.1) can0 596#4B00300050140000\n");
    let output = odgen(&scratch.0, &["decode", "plant.yaml", "--machine", "6", "--trace", "bus.log"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    let reported = crate::stdout(&output);
    assert!(reported.contains("596h  drive (node 22)  SDO ←  3000h lowest voltage = 520.0 V"), "{reported}");
}

/// At which time a value is what is tested in the source's folder, with a clock of the test.
#[test]
fn values_run_and_stop() {
    let scratch = Scratch::new("serve-ramps");
    scratch.file("lamp.od.yaml", lamp_that_tells());
    let mut served = WithClient::lamps(&scratch, &["--script", "-"]);
    served.ask("O\r", "\r");
    served.ask("t00020105\r", "z\r");
    let mut input = served.served.child.stdin.take().unwrap();
    writeln!(input, "5 ramp brightness=0 %..5 % in 0.3").unwrap();
    // Each step in its order, from the beginning to the end; a busy machine leaves some out.
    let mut steps = vec![served.brightness()];
    while steps.last() != Some(&5) {
        steps.push(served.brightness());
    }
    assert!(steps[0] == 0 && steps.is_sorted_by(|one, next| one < next), "{steps:?}");
    // It is unknown where it stops, but there it stays: the next thing that comes is what is set.
    writeln!(input, "5 triangle 2000=10..12 in 0.2").unwrap();
    served.answers("", "t18510B\r");
    writeln!(input, "5 stop 2000\n5 set 2000=99").unwrap();
    served.answers("", "t185163\r");
    // 101 % is more than the lamp has: the ramp ends there, and says so.
    writeln!(input, "5 ramp 2000=100..200 in 0.1").unwrap();
    served.ask("", "t185164\r");
    let mut log = BufReader::new(served.served.child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("2000h (brightness) cannot be set to this: 0609 0031h") {
        line.clear();
        assert!(log.read_line(&mut line).unwrap() > 0, "the end of the log");
    }
}

#[test]
fn ramps_with_mistakes_are_refused_as_a_whole() {
    let scratch = Scratch::new("serve-wrong-ramps");
    scratch.file(
        "lamp.od.yaml",
        LAMP.replace(
            "pdos:",
            "  0x2001: {name: label, type: visible-string, access: rw, capacity: 9}\npdos:",
        ),
    );
    scratch.file(
        "day.txt",
        "5 ramp brightness=0 %..100 % in 2\n\
         5 ramp\n\
         5 ramp 2000=0..100\n\
         5 ramp 2000=0..100 in\n\
         5 ramp 2000=0..100 in 0\n\
         5 ramp 2000=0..100 in 1000001\n\
         5 ramp 2000=0..100 in -1\n\
         5 ramp 2000=0..100 for 5\n\
         5 ramp 2000=100 in 5\n\
         5 ramp 2000=..100 in 5\n\
         5 ramp 2000 in 5\n\
         5 ramp bright=0..100 in 5\n\
         5 ramp 2000=zero..100 in 5\n\
         5 ramp 2000=0 %..hundred in 5\n\
         5 ramp 2000=0..256 in 5\n\
         5 sine label=a..b in 5\n\
         5 rmap 2000=0..1 in 5\n\
         5 stop\n\
         5 stop bright\n",
    );
    let arguments = ["serve", "lamp.od.yaml", "--node", "5", "--script", "day.txt", "--format", "short"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!((code(&output), output.stdout.as_slice()), (1, &b""[..]));
    insta::assert_snapshot!(stderr(&output));
}

#[test]
fn places_that_cannot_be_are_reported() {
    let scratch = Scratch::new("serve-places");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("taken", "");
    let serve = |more: &[&str]| {
        let output = odgen(&scratch.0, &[&["serve", "lamp.od.yaml", "--node", "5"], more].concat());
        format!("$ odgen serve {}\n{}-> {}\n", more.join(" "), stderr(&output), code(&output))
    };
    let node = |more: &[&str]| {
        let output = odgen(&scratch.0, &[&["node", "scan"], more].concat());
        format!("$ odgen node scan {}\n{}-> {}\n", more.join(" "), stderr(&output), code(&output))
    };
    insta::assert_snapshot!(
        [
            serve(&["--slcan", "serial:/dev/ttyACM0"]),
            serve(&["--watch"]),
            serve(&["--watch", "--log"]),
            node(&["--slcan", "pty"]),
            node(&["--slcan", "serial:"]),
        ]
        .concat()
    );
    if cfg!(target_os = "linux") {
        insta::assert_snapshot!(
            "places_that_cannot_be_on_linux",
            [
                serve(&["--slcan", "pty:taken"]),
                serve(&["--socketcan", "no-bus"]),
                serve(&["--socketcan", "no-bus", "--slcan", "pty"]),
                node(&["--socketcan", "no-bus"]),
                node(&["--socketcan", "no-bus", "--bit-rate", "125"]),
                node(&["--slcan", "serial:no-port"]),
                node(&["--slcan", "serial:taken@9600"]),
            ]
            .concat()
        );
    }
}

#[cfg(target_os = "linux")]
mod terminal {
    use super::*;
    use crate::stdout;

    /// Nodes at a serial port without wires, which are ended as a person does.
    fn served(scratch: &Scratch, link: &str) -> (Served, String) {
        scratch.file("lamp.od.yaml", LAMP);
        let served = Served::at(scratch, &["lamp.od.yaml", "--node", "5"], link, Stdio::null());
        let port = served.line.trim().rsplit(' ').next().unwrap().to_owned();
        (served, port)
    }

    #[test]
    fn hosts_come_and_go_at_a_pseudo_terminal() {
        let scratch = Scratch::new("serve-pty");
        let (mut served, port) = served(&scratch, "pty:bus");
        assert_eq!(port, "serial:bus");
        let node = |arguments: &[&str]| {
            let output = odgen(&scratch.0, &[&["node"], arguments, &["--slcan", &port]].concat());
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            stdout(&output)
        };
        assert_eq!(
            node(&["write", "lamp.od.yaml", "--node", "5", "brightness=60 %", "--yes"]),
            "2000h brightness: 80 % → 60 %\nlost with a reset: 2000h brightness\n2000h brightness = 60 %  [3C]  written\n"
        );
        assert_eq!(node(&["read", "lamp.od.yaml", "--node", "5", "2000"]), "2000h brightness = 60 %  [3C]\n");
        assert_eq!(
            node(&["nmt", "reset-node", "--node", "5", "--bit-rate", "125"]),
            "node 5 has started again\n"
        );
        // A host leaves half a line, an open channel, and frames that it does not read.
        let mut host =
            std::fs::OpenOptions::new().read(true).write(true).open(scratch.0.join("bus")).unwrap();
        host.write_all(b"O\rt60584000200000000000\rt605840").unwrap();
        std::thread::sleep(Duration::from_millis(200));
        drop(host);
        std::thread::sleep(Duration::from_millis(200));
        // The next one finds an adapter that was just switched on: nothing to read, and the channel closed.
        let mut next =
            std::fs::OpenOptions::new().read(true).write(true).open(scratch.0.join("bus")).unwrap();
        next.write_all(b"t6050\rV\r").unwrap();
        let mut said = [0; 7];
        next.read_exact(&mut said).unwrap();
        assert_eq!(&said, b"\x07V1010\r");
        drop(next);
        std::thread::sleep(Duration::from_millis(200));
        assert_eq!(node(&["read", "lamp.od.yaml", "--node", "5", "2000"]), "2000h brightness = 80 %  [50]\n");
        // An end that is asked for takes the link away.
        assert!(interrupt(&served.child));
        assert_eq!(served.child.wait().unwrap().code(), Some(0));
        assert!(scratch.0.join("bus").symlink_metadata().is_err());
    }

    #[test]
    fn a_link_that_a_killed_server_has_left_is_taken_over() {
        let scratch = Scratch::new("serve-pty-again");
        for _ in 0..2 {
            let (served, port) = served(&scratch, "pty:bus");
            assert_eq!(port, "serial:bus");
            // It is killed with the test's hold on it.
            drop(served);
            assert!(scratch.0.join("bus").symlink_metadata().is_ok());
        }
    }

    #[test]
    fn a_host_that_reads_nothing_holds_up_no_other() {
        let scratch = Scratch::new("serve-pty-deaf");
        let (_served, port) = served(&scratch, "pty");
        let path = port.trim_start_matches("serial:");
        let mut deaf = std::fs::OpenOptions::new().read(true).write(true).open(path).unwrap();
        for _ in 0..20_000 {
            deaf.write_all(b"V\r").unwrap();
        }
        drop(deaf);
        std::thread::sleep(Duration::from_millis(300));
        let output =
            odgen(&scratch.0, &["node", "read", "lamp.od.yaml", "--node", "5", "2000", "--slcan", &port]);
        assert_eq!((code(&output), stdout(&output).as_str()), (0, "2000h brightness = 80 %  [50]\n"));
    }
}

#[test]
fn nodes_that_answer_each_other_without_end_leave_room_for_clients() {
    let scratch = Scratch::new("serve-storm");
    let lamp = LAMP.replace("pdo: receive", "pdo: both").replace(
        "receive: {1: {map: [brightness]}}",
        "receive: {1: {map: [brightness]}}\n    transmit: {1: {map: [brightness]}}",
    );
    scratch.file("lamp.od.yaml", lamp);
    let mut served = WithClient::lamps(&scratch, &["--node", "6"]);
    served.ask("O\r", "\r");
    // Each hears what the other one says, and says it again.
    for command in ["t60582300140105020080\r", "t60582300140186010000\r"] {
        served.answers(command, "t58586000140100000000\r");
    }
    for command in ["t60682300140106020080\r", "t60682300140185010000\r"] {
        served.answers(command, "t58686000140100000000\r");
    }
    served.client.write_all(b"t00020100\r").unwrap();
    served.client.write_all(b"t60582F00200005000000\r").unwrap();
    served.answers("", "t58586000200000000000\r");
    // A client that does not listen is not in the way of the storm, and is heard.
    served.answers("C\r", "\r");
    let address = served.served.address().to_owned();
    let mut other = TcpStream::connect(address.trim_start_matches("tcp:")).unwrap();
    other.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    other.write_all(b"V\r").unwrap();
    let mut answer = [0; 6];
    other.read_exact(&mut answer).unwrap();
    assert_eq!(&answer, b"V1010\r");
}

#[cfg(unix)]
#[test]
fn clients_are_let_in_again_when_there_were_too_many() {
    let scratch = Scratch::new("serve-many");
    scratch.file("lamp.od.yaml", LAMP);
    let served = Served::limited(&scratch, &["lamp.od.yaml", "--node", "5"], 24);
    let address = served.address().trim_start_matches("tcp:").to_owned();
    let many: Vec<_> = (0..40).map(|_| TcpStream::connect(&address).unwrap()).collect();
    std::thread::sleep(Duration::from_millis(300));
    drop(many);
    std::thread::sleep(Duration::from_millis(300));
    let mut client = TcpStream::connect(&address).unwrap();
    client.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    client.write_all(b"V\r").unwrap();
    let mut answer = [0; 6];
    client.read_exact(&mut answer).unwrap();
    assert_eq!(&answer, b"V1010\r");
}

#[test]
fn more_clients_than_there_is_room_for_are_left_at_once() {
    let scratch = Scratch::new("serve-clients");
    scratch.file("lamp.od.yaml", LAMP);
    let served = Served::start(&scratch, &["lamp.od.yaml", "--node", "5"], Stdio::null());
    let address = served.address().trim_start_matches("tcp:").to_owned();
    let answered = || {
        let mut client = TcpStream::connect(&address).unwrap();
        client.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        let _ = client.write_all(b"V\r");
        let mut answer = [0; 6];
        (client.read_exact(&mut answer).is_ok() && &answer == b"V1010\r").then_some(client)
    };
    let mut clients: Vec<TcpStream> = (0..64).map(|_| answered().unwrap()).collect();
    assert!(answered().is_none());
    drop(clients.pop());
    // That it has gone is noticed by another thread.
    assert!((0..10_000).any(|_| answered().is_some()));
}

/// An EDS in which limits, mappings and types contradict each other.
const CONTRADICTIONS: &str = "[DeviceInfo]\nVendorNumber=7\nProductName=Scale\nBaudRate_125=1\n\
    [1003]\nParameterName=errors\nObjectType=8\nSubNumber=2\n\
    [1003sub0]\nParameterName=number\nDataType=5\nAccessType=ro\nDefaultValue=8\n\
    [1003sub1]\nParameterName=error\nDataType=7\nAccessType=ro\n\
    [1200]\nParameterName=SDO\nObjectType=9\nSubNumber=3\n\
    [1200sub0]\nParameterName=number\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [1200sub1]\nParameterName=requests\nDataType=7\nAccessType=rw\nDefaultValue=0x80000000\n\
    [1200sub2]\nParameterName=answers\nDataType=7\nAccessType=rw\nDefaultValue=0x80000000\n\
    [1800]\nParameterName=TPDO\nObjectType=9\nSubNumber=3\n\
    [1800sub0]\nParameterName=number\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [1800sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x180\n\
    [1800sub2]\nParameterName=type\nDataType=5\nAccessType=rw\nDefaultValue=255\n\
    [1801]\nParameterName=TPDO\nObjectType=9\nSubNumber=3\n\
    [1801sub0]\nParameterName=number\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
    [1801sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x280\n\
    [1801sub2]\nParameterName=type\nDataType=5\nAccessType=rw\nDefaultValue=255\n\
    [1A00]\nParameterName=mapping\nObjectType=9\nSubNumber=3\n\
    [1A00sub0]\nParameterName=number\nDataType=5\nAccessType=rw\nDefaultValue=2\n\
    [1A00sub1]\nParameterName=first\nDataType=7\nAccessType=rw\nDefaultValue=0x20000008\n\
    [1A00sub2]\nParameterName=second\nDataType=7\nAccessType=rw\nDefaultValue=0\n\
    [1A01]\nParameterName=mapping\nObjectType=9\nSubNumber=2\n\
    [1A01sub0]\nParameterName=number\nDataType=5\nAccessType=rw\nDefaultValue=1\n\
    [1A01sub1]\nParameterName=first\nDataType=7\nAccessType=rw\nDefaultValue=0x20000010\n\
    [2000]\nParameterName=load\nDataType=5\nAccessType=rw\nDefaultValue=3\nLowLimit=5\nHighLimit=1\nPDOMapping=1\n\
    [2001]\nParameterName=names\nObjectType=8\nSubNumber=2\n\
    [2001sub0]\nParameterName=number\nDataType=9\nAccessType=ro\nDefaultValue=Test\n\
    [2001sub1]\nParameterName=name\nDataType=5\nAccessType=rw\nDefaultValue=9\n";

/// What is wrong is reported in one line; the rest of the file is a node.
#[test]
fn a_file_that_contradicts_itself_is_served_as_it_is() {
    let scratch = Scratch::new("serve-contradictions");
    scratch.file("scale.eds", CONTRADICTIONS);
    let mut served = WithClient::of(Served::start(&scratch, &["scale.eds", "--node", "5"], Stdio::piped()));
    served.ask("O\r", "\r");
    let mut ask = |request: &str, answer: &str| {
        served.ask(&format!("t6058{request}\r"), &format!("z\rt5858{answer}\r"));
    };
    // Every node has the first SDO channel, also where 1200h says that it is off.
    ask("4000120100000000", "4300120100000080");
    // No error has occurred yet.
    ask("4003100000000000", "4F03100000000000");
    ask("40001A0000000000", "4F001A0002000000");
    ask("40001A0100000000", "43001A0108000020");
    ask("40011A0100000000", "43011A0110000020");
    ask("4001200000000000", "4301200054657374");
    // Limits that permit nothing limit nothing.
    ask("2F00200007000000", "6000200000000000");
    ask("4000200000000000", "4F00200007000000");
    served.served.child.kill().unwrap();
    let mut said = String::new();
    served.served.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    let count = |word: &str| said.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((count("error"), count("note: scale.eds: ")), (0, 1), "{said}");
}

#[test]
fn an_address_for_other_machines_is_reported() {
    let scratch = Scratch::new("serve-open");
    scratch.file("lamp.od.yaml", LAMP);
    for (place, is_told) in [("tcp:0.0.0.0:0", true), ("tcp:127.0.0.1:0", false)] {
        let mut served = Served::at(&scratch, &["lamp.od.yaml", "--node", "5"], place, Stdio::piped());
        assert!(served.line.contains(" at tcp:"), "{}", served.line);
        served.child.kill().unwrap();
        let mut said = String::new();
        served.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(said.contains("other machines reach"), is_told, "{said}");
    }
}
