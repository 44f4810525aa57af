//! `odgen node program`, on virtual nodes.

use std::process::{Output, Stdio};

use insta::assert_snapshot;

use crate::relay::{Change, Relay};
use crate::served::Served;
use crate::{Scratch, code, odgen, stderr, stdout};

/// A device that takes two programs.
const PUMP: &str = "\
od-spec: 1
title: Pump
uses: [cia301, cia302]
vendor: {name: Makers of pumps, number: 0x1234}
devices:
  pump:
    name: Pump
    bit-rates: [125]
    product: 7
    product-revision: 0x00010002
    device-type: 0
    features: [device type, identity, heartbeat producer, \"program download\": 2, program identification, flash status]
";

/// The node takes commands for programs (1F51h.1, 1F51h.2).
const TAKEN: &str = "t585860511F01";
/// The node ends a transfer in blocks.
const WHOLE: &str = "t5858A1";

/// A bus with a pump as node 5, reached through a relay.
struct Bus {
    served: Served,
    relay: Relay,
    scratch: Scratch,
}

impl Bus {
    fn new(name: &str, to_nodes: Change, from_nodes: Change) -> Self {
        Self::of(name, PUMP, to_nodes, from_nodes)
    }

    fn of(name: &str, specification: &str, to_nodes: Change, from_nodes: Change) -> Self {
        let scratch = Scratch::new(name);
        scratch.file("pump.od.yaml", specification);
        let program: Vec<u8> = (0..=255).cycle().take(2000).collect();
        scratch.file("pump.bin", program);
        scratch.file("empty.bin", "");
        let served = Served::start(&scratch, &["pump.od.yaml", "--node", "5"], Stdio::null());
        let relay = Relay::new(served.address(), to_nodes, from_nodes);
        Self { served, relay, scratch }
    }

    fn output(&self, arguments: &[&str], address: &str) -> Output {
        odgen(&self.scratch.0, &[&["node"], arguments, &["--slcan", address]].concat())
    }

    /// `odgen node program` with node 5, through the relay.
    fn program(&self, arguments: &[&str]) -> String {
        let command = ["program", "pump.od.yaml", "--node", "5"];
        let output = self.output(&[&command, arguments].concat(), &self.relay.address);
        reported(&["program", &arguments.join(" ")].join(" "), &output)
    }

    /// The same where something is missing, which need not be waited for.
    fn in_vain(&self, patience: &str) -> String {
        self.program(&["pump.bin", "--yes", "--patience", patience, "--timeout", "300"])
    }

    /// Another command of `odgen node` with node 5, past the relay.
    fn node(&self, command: &str, arguments: &[&str]) -> String {
        let whole = [&[command, "pump.od.yaml", "--node", "5"], arguments].concat();
        reported(&format!("{command} {}", arguments.join(" ")), &self.output(&whole, self.served.address()))
    }

    /// What the node says of its programs.
    fn now(&self) -> String {
        self.node("read", &["1F51.1", "1F51.2", "1F56.1", "1F57.1"])
    }
}

fn reported(command: &str, output: &Output) -> String {
    format!("$ {command}\n{}{}-> {}\n", stdout(output), stderr(output), code(output))
}

/// Nothing is changed.
fn same() -> Change {
    Box::new(|line| Some(line.to_owned()))
}

/// The lines that begin so are lost, from the one with this number to the next number.
fn loses(beginning: &'static str, from: usize, to: usize) -> Change {
    let mut came = 0;
    Box::new(move |line| {
        came += usize::from(line.starts_with(beginning));
        let is_lost = line.starts_with(beginning) && (from..to).contains(&came);
        (!is_lost).then(|| line.to_owned())
    })
}

#[test]
fn a_program_is_loaded_and_started() {
    let bus = Bus::new("program", same(), same());
    let said = [
        bus.now(),
        bus.program(&["pump.bin", "--dry-run"]),
        bus.program(&["pump.bin"]),
        bus.now(),
        bus.program(&["pump.bin", "--yes"]),
        bus.now(),
        bus.program(&["pump.bin", "--yes", "--program", "2"]),
        bus.program(&["pump.bin", "--yes", "--program", "3"]),
        bus.program(&["empty.bin", "--yes"]),
        bus.program(&["missing.bin", "--yes"]),
    ];
    assert_snapshot!("program", said.concat());
}

#[test]
fn another_device_gets_no_program() {
    let bus = Bus::new("program-other", same(), same());
    bus.scratch.file("other.od.yaml", PUMP.replace("product: 7", "product: 8"));
    let command = ["program", "other.od.yaml", "pump.bin", "--node", "5", "--yes"];
    let output = bus.output(&command, &bus.relay.address);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("error[OD0717]"), "{}", stderr(&output));
    assert_snapshot!("program-other", bus.now());
}

#[test]
fn commands_in_a_wrong_order_are_refused() {
    let bus = Bus::new("program-order", same(), same());
    let write = |value| bus.node("write", &[value, "--yes"]);
    let said = [
        // It runs, and what is not deleted is not written.
        write("1F51.1=clear"),
        write("1F51.1=stop"),
        write("1F51.1=clear"),
        // There is none.
        write("1F51.1=start"),
        write("1F51.1=reset program"),
        bus.now(),
        reported("nmt start", &bus.output(&["nmt", "start", "--node", "5"], bus.served.address())),
        write("1F51.2=stop"),
    ];
    assert_snapshot!("program-order", said.concat());
}

#[test]
fn a_lost_answer_is_made_up_by_what_the_node_says() {
    // Those to stop, to delete and to start.
    let bus = Bus::new("program-lost", same(), loses(TAKEN, 1, 4));
    let said = [bus.program(&["pump.bin", "--yes", "--timeout", "300"]), bus.now()];
    assert_snapshot!("program-lost", said.concat());
}

#[test]
fn a_program_that_is_not_known_to_be_whole_is_not_started() {
    let bus = Bus::new("program-end", same(), loses(WHOLE, 1, 2));
    let said = [bus.in_vain("1"), bus.now(), bus.program(&["pump.bin", "--yes"])];
    assert_snapshot!("program-end", said.concat());
}

#[test]
fn each_step_that_fails_says_what_the_node_has() {
    // The commands to stop, to delete and to load, a piece in the middle, the command to start, and everything afterwards.
    let cases = [
        ("program-no-stop", "t60582F511F0100", "1"),
        ("program-no-clear", "t60582F511F0103", "1"),
        ("program-no-load", "t6058C6501F01", "1"),
        // The node gives up first.
        ("program-no-end", "t605845", "4"),
        ("program-no-start", "t60582F511F0101", "1"),
    ];
    let said = std::thread::scope(|scope| {
        let tried = cases.map(|(name, beginning, patience)| {
            scope.spawn(move || {
                let bus = Bus::new(name, loses_from(beginning), same());
                [bus.in_vain(patience), bus.now()].concat()
            })
        });
        tried.map(|one| one.join().unwrap())
    });
    for ((name, ..), said) in cases.iter().zip(said) {
        assert_snapshot!(*name, said);
    }
}

/// All lines are lost, from the first that begins so.
fn loses_from(beginning: &'static str) -> Change {
    let mut is_broken = false;
    Box::new(move |line| {
        is_broken |= line.starts_with(beginning);
        (!is_broken || line == "C").then(|| line.to_owned())
    })
}

#[test]
fn a_node_that_refuses_is_left_as_it_is() {
    // It is made to hear that it is to be operational.
    let to_nodes: Change = Box::new(|line| Some(line.replace("t00028005", "t00020105")));
    let bus = Bus::new("program-refused", to_nodes, same());
    assert_snapshot!("program-refused", [bus.program(&["pump.bin", "--yes"]), bus.now()].concat());
}

#[test]
fn a_program_that_the_node_does_not_accept_is_not_started() {
    let mut is_loaded = false;
    let from_nodes: Change = Box::new(move |line| {
        is_loaded |= line.starts_with(WHOLE);
        let status = if is_loaded { "t585843571F0106" } else { "t585843571F0100" };
        Some(line.replace("t585843571F0100", status).replace("t585843571F0102", "t585843571F0100"))
    });
    let bus = Bus::new("program-faulty", same(), from_nodes);
    assert_snapshot!("program-faulty", [bus.program(&["pump.bin", "--yes"]), bus.now()].concat());
}

#[test]
fn a_memory_that_stays_busy_is_given_up() {
    let from_nodes: Change = Box::new(|line| Some(line.replace("t585843571F0100", "t585843571F0101")));
    let bus = Bus::new("program-busy", same(), from_nodes);
    assert_snapshot!("program-busy", bus.program(&["pump.bin", "--yes", "--patience", "1"]));
}

#[test]
fn a_device_without_status_and_identification_gets_its_program() {
    let bare = PUMP.replace(", program identification, flash status", "");
    let bus = Bus::of("program-bare", &bare, same(), same());
    let said = [bus.program(&["pump.bin", "--yes"]), bus.node("read", &["1F51.1"])];
    assert_snapshot!("program-bare", said.concat());
}

/// An interrupt in the middle of the program: the transfer is ended, and the node is not left waiting for more.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_transfer() {
    use std::process::Command;
    use std::sync::{Arc, Mutex};

    let command: Arc<Mutex<Option<u32>>> = Arc::default();
    let (process, mut is_sent) = (Arc::clone(&command), false);
    let from_nodes: Change = Box::new(move |line| {
        // The node has taken the first block.
        if line.starts_with("t5858A2") && !is_sent {
            let id = loop {
                if let Some(id) = *process.lock().unwrap() {
                    break id;
                }
                std::thread::yield_now();
            };
            let id = rustix::process::Pid::from_raw(i32::try_from(id).unwrap()).unwrap();
            rustix::process::kill_process(id, rustix::process::Signal::INT).unwrap();
            is_sent = true;
        }
        Some(line.to_owned())
    });
    let bus = Bus::new("program-interrupt", same(), from_nodes);
    bus.scratch.file("long.bin", vec![0x55; 4_000_000]);
    let child = Command::new(env!("CARGO_BIN_EXE_odgen"))
        .args(["node", "program", "pump.od.yaml", "long.bin", "--node", "5", "--yes"])
        .args(["--slcan", &bus.relay.address])
        .current_dir(&bus.scratch.0)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    *command.lock().unwrap() = Some(child.id());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let said = [reported("program long.bin --yes", &output), bus.now(), bus.program(&["pump.bin", "--yes"])];
    assert_snapshot!("program-interrupt", said.concat());
}
