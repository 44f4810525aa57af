//! `odgen serve`.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::{LAMP, Scratch, code, odgen, stderr};

/// A server with a client, ended with the test.
struct Served {
    child: Child,
    client: TcpStream,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Served {
    fn new(scratch: &Scratch) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .args([
                "serve",
                "lamp.od.yaml",
                "--node",
                "5",
                "--node",
                "6",
                "--slcan",
                "tcp:127.0.0.1:0",
                "--log",
            ])
            .current_dir(&scratch.0)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        assert!(line.starts_with("serving lamp (node 5), lamp (node 6) at tcp:127.0.0.1:"), "{line}");
        let client = TcpStream::connect(line.trim().rsplit("tcp:").next().unwrap()).unwrap();
        client.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        Self { child, client }
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
    let mut served = Served::new(&scratch);
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
    served.child.kill().unwrap();
    let mut log = String::new();
    served.child.stderr.take().unwrap().read_to_string(&mut log).unwrap();
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

#[test]
fn an_address_has_its_protocol() {
    let scratch = Scratch::new("serve-address");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["serve", "lamp.od.yaml", "--node", "5", "--slcan", "/dev/ttyUSB0"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("write `--slcan tcp:HOST:PORT`"), "{}", stderr(&output));
}
