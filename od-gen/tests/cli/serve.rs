//! `odgen serve`.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::process::Stdio;
use std::time::Duration;

use crate::plant::presses;
use crate::served::Served;
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
    // A line that is too long, and one behind it.
    served.ask(&format!("t{}\rV\r", "0".repeat(100)), "\u{7}V1010\r");
    served.served.child.kill().unwrap();
    let mut log = String::new();
    served.served.child.stderr.take().unwrap().read_to_string(&mut log).unwrap();
    let told: Vec<&str> =
        log.lines().filter_map(|line| line.split_once(")  ")).map(|(_, told)| told).collect();
    assert_eq!(
        told,
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

/// A lamp that tells its brightness and its errors.
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
    let mut told = String::new();
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
                told += &line;
            }
            assert!(told.ends_with(&line), "{command} {arguments:?}: {line}");
        }
    }
    insta::assert_snapshot!(told);
}

#[test]
fn a_trace_of_a_machine_is_decoded() {
    let scratch = presses("decode-plant");
    scratch.file("bus.log", "(1.0) can0 616#4000300000000000\n(1.1) can0 596#4B00300050140000\n");
    let output = odgen(&scratch.0, &["decode", "plant.yaml", "--machine", "6", "--trace", "bus.log"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    let told = crate::stdout(&output);
    assert!(told.contains("596h  drive (node 22)  SDO ←  3000h lowest voltage = 520.0 V"), "{told}");
}
