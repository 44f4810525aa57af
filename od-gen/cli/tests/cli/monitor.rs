//! `odgen node monitor`, against `odgen serve`.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, Command, Stdio};

use crate::served::{Served, interrupt};
use crate::{LAMP, Scratch, code, odgen, stderr};

/// A lamp that sends its brightness, its errors and a heartbeat.
fn lamp() -> String {
    LAMP.replace("[heartbeat producer]", "[heartbeat producer, emergency]")
        .replace("pdo: receive", "pdo: transmit")
        .replace("receive: {1: {map: [brightness]}}", "transmit: {1: {map: [brightness]}}")
        .replace("objects:\n", "objects:\n  0x1017: {from: cia301, default: 300 ms}\n")
        + "errors:\n  0x4210: {name: too hot, about: It is over 80 degrees.}\n"
}

/// Nodes, and a monitor that watches them.
struct Watched {
    served: Served,
    monitor: Child,
    reported: BufReader<std::process::ChildStdout>,
    _scratch: Scratch,
}

impl Watched {
    fn new(name: &str, nodes: &[&str], more: &[&str]) -> Self {
        let scratch = Scratch::new(name);
        scratch.file("lamp.od.yaml", lamp());
        let served =
            Served::start(&scratch, &["lamp.od.yaml", "--node", "5", "--script", "-"], Stdio::null());
        let mut monitor = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .args([&["node", "monitor"], nodes, &["--slcan", served.address()], more].concat())
            .current_dir(&scratch.0)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let reported = BufReader::new(monitor.stdout.take().unwrap());
        Self { served, monitor, reported, _scratch: scratch }
    }

    fn say(&mut self, commands: &str) {
        self.served.child.stdin.as_mut().unwrap().write_all(commands.as_bytes()).unwrap();
    }

    /// The next line, without its time.
    fn line(&mut self) -> String {
        let mut line = String::new();
        self.reported.read_line(&mut line).unwrap();
        let line = line.trim_end();
        line.split_once(")  ")
            .filter(|_| line.starts_with('('))
            .map_or(line, |(_, reported)| reported)
            .to_owned()
    }

    fn lines(&mut self, expected: &[&str]) {
        for expected in expected {
            assert_eq!(self.line(), *expected);
        }
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        let _ = self.monitor.kill();
        let _ = self.monitor.wait();
    }
}

#[test]
fn what_goes_over_the_bus_is_reported_until_it_is_ended() {
    let mut watched = Watched::new("monitor", &["lamp.od.yaml", "--node", "5"], &["--ask"]);
    // It has asked by then, and heartbeats come by themselves.
    watched.lines(&["705h  lamp (node 5)  heartbeat  pre-operational"]);
    let address = watched.served.address().to_owned();
    let scratch = Scratch::new("monitor-nmt");
    let output = odgen(&scratch.0, &["node", "nmt", "start", "--node", "5", "--slcan", &address]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    watched.lines(&["000h  NMT  start: lamp (node 5)", "705h  lamp (node 5)  heartbeat  operational"]);
    watched.say("5 set brightness=60 %\n5 fault 0x4210\n");
    watched.lines(&[
        "185h  lamp (node 5)  TPDO1  2000h brightness = 60 %",
        "085h  lamp (node 5)  EMCY  4210h too hot – It is over 80 degrees; error register 0x09 (generic error, temperature)",
    ]);
    if !interrupt(&watched.monitor) {
        return;
    }
    let summary = watched.line();
    assert!(summary.contains(" frames in "), "{summary}");
    let node = watched.line();
    assert!(node.starts_with("  lamp (node 5)  operational, heard 0."), "{node}");
    assert!(
        node.contains(" ago, every 0.") && node.contains(" s; last EMCY ") && node.contains("4210h too hot"),
        "{node}"
    );
    assert_eq!((watched.line().as_str(), watched.monitor.wait().unwrap().code()), ("", Some(0)));
}

#[test]
fn without_a_specification_there_are_no_names_and_the_time_is_limited() {
    let mut watched = Watched::new("monitor-plain", &[], &["--for", "3", "--only", "heartbeat"]);
    watched.lines(&["705h  node 5 (no dictionary)  heartbeat  pre-operational"]);
    let summary = watched.line();
    let (_, time) = summary.split_once(" frames in ").unwrap();
    let seconds: f64 = time.split(' ').next().unwrap().parse().unwrap();
    assert!(seconds >= 3.0, "{summary}");
    assert!(watched.line().starts_with("  node 5 (no dictionary)  pre-operational, heard "));
    let mut notes = String::new();
    watched.monitor.stderr.take().unwrap().read_to_string(&mut notes).unwrap();
    assert!(notes.contains("note: no node is named"), "{notes}");
    assert_eq!(watched.monitor.wait().unwrap().code(), Some(0));
}

#[test]
fn a_bus_that_breaks_away_is_reported_with_what_was_seen() {
    let mut watched = Watched::new("monitor-broken", &["lamp.od.yaml", "--node", "5"], &[]);
    watched.lines(&["705h  lamp (node 5)  heartbeat  pre-operational"]);
    watched.served.child.kill().unwrap();
    assert!(watched.line().contains(" in "));
    let mut notes = String::new();
    watched.monitor.stderr.take().unwrap().read_to_string(&mut notes).unwrap();
    assert!(notes.contains("`--ask` reads them from the nodes"), "{notes}");
    assert!(notes.contains("error[OD0716]: the"), "{notes}");
    assert_eq!(watched.monitor.wait().unwrap().code(), Some(1));
}
