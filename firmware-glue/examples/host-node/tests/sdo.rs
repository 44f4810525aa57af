//! The node answers SDO requests of an SLCAN client, and keeps what was written.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::io::{BufRead as _, BufReader, Write as _};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

/// The program, which ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Sends a line and reads up to a carriage return, past the confirmation `z` of a frame.
fn ask(stream: &mut BufReader<TcpStream>, line: &str) -> String {
    stream.get_mut().write_all(format!("{line}\r").as_bytes()).unwrap();
    loop {
        let mut answer = Vec::new();
        stream.read_until(b'\r', &mut answer).unwrap();
        let answer = String::from_utf8(answer).unwrap().trim_end_matches('\r').to_owned();
        // The node starts as soon as a client is there; its boot-up message may come between.
        if answer != "z" && !answer.starts_with("t705") {
            return answer;
        }
    }
}

#[test]
fn a_client_reads_and_writes() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-node"));
    let mut node = Running(command.arg("127.0.0.1:0").stdout(Stdio::piped()).spawn().unwrap());
    let mut said = BufReader::new(node.0.stdout.take().unwrap()).lines().map(Result::unwrap);
    let place = said.next().unwrap();
    let stream = TcpStream::connect(place.strip_prefix("node 5 at tcp:").unwrap()).unwrap();
    let mut client = BufReader::new(stream);

    assert_eq!(ask(&mut client, "O"), "");
    // 2000h is 80.
    assert_eq!(ask(&mut client, "t60584000200000000000"), "t58584F00200050000000");
    // 40 is accepted; 101 is above the maximum (abort code 0609 0031h).
    assert_eq!(ask(&mut client, "t60582F00200028000000"), "t58586000200000000000");
    assert_eq!(said.next().unwrap(), "brightness 40 %");
    assert_eq!(ask(&mut client, "t60582F00200065000000"), "t58588000200031000906");
    assert_eq!(ask(&mut client, "t60584000200000000000"), "t58584F00200028000000");
}
