//! `odgen node` on a bus that loses and breaks frames.

use std::fs;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use insta::assert_snapshot;

use crate::node::HEATER;
use crate::relay::{Change, Relay};
use crate::served::Served;
use crate::{Scratch, code, odgen, stderr, stdout};

/// The first bytes of the node's answers: 2000h as 16 bits, and that it was written.
const TOLD: &str = "t58584B002000";
const TAKEN: &str = "t585860002000";

/// A bus with a heater as node 5, reached through a relay.
struct Bus {
    /// Runs as long as the bus.
    _served: Served,
    relay: Relay,
    scratch: Scratch,
}

impl Bus {
    fn new(name: &str, to_nodes: Change, from_nodes: Change) -> Self {
        Self::of(name, HEATER, to_nodes, from_nodes)
    }

    fn of(name: &str, specification: &str, to_nodes: Change, from_nodes: Change) -> Self {
        let scratch = Scratch::new(name);
        scratch.file("heater.od.yaml", specification);
        let served = Served::start(&scratch, &["heater.od.yaml", "--node", "5"], Stdio::null());
        let relay = Relay::new(served.address(), to_nodes, from_nodes);
        Self { _served: served, relay, scratch }
    }

    /// `odgen node` with node 5: what it says and how it ends, as a text.
    fn node(&self, command: &str, arguments: &[&str]) -> String {
        self.run(&[&[command, "heater.od.yaml", "--node", "5"], arguments].concat())
    }

    fn run(&self, arguments: &[&str]) -> String {
        let of_bus = ["--timeout", "500", "--slcan", &self.relay.address];
        let output = odgen(&self.scratch.0, &[&["node"], arguments, &of_bus].concat());
        let (said, failed) = (stdout(&output), stderr(&output));
        format!("$ odgen node {}\n{said}{failed}-> {}\n", arguments.join(" "), code(&output))
    }
}

/// Nothing is changed.
fn same() -> Change {
    Box::new(|line| Some(line.to_owned()))
}

/// Of lines that begin so, each second one is lost, from the first on.
fn loses(beginning: &'static str) -> Change {
    let mut came = 0;
    Box::new(move |line| {
        came += usize::from(line.starts_with(beginning));
        (!line.starts_with(beginning) || came % 2 == 0).then(|| line.to_owned())
    })
}

/// Lines that begin in the one way begin in the other.
fn begins(beginning: &'static str, other: &'static str) -> Change {
    Box::new(move |line| {
        Some(line.strip_prefix(beginning).map_or_else(|| line.to_owned(), |rest| format!("{other}{rest}")))
    })
}

#[test]
fn a_read_is_repeated_once() {
    let bus = Bus::new("dirt-read", same(), loses(TOLD));
    let said = [bus.node("read", &["2000", "2001"]), bus.node("read", &["2000", "2001", "--retries", "0"])];
    assert_snapshot!("dirt-read", said.concat());
}

#[test]
fn an_entry_with_a_malformed_answer_is_left_out_and_named() {
    // FFh is not an answer of CiA 301.
    let bus = Bus::new("dirt-malformed", same(), begins(TOLD, "t5858FF002000"));
    let mut said = vec![bus.node("read", &["2000", "2001"]), bus.node("backup", &["--out", "kept.yaml"])];
    let kept = fs::read_to_string(bus.scratch.0.join("kept.yaml")).unwrap();
    assert!(kept.contains("highest temperature: 60.0 °C") && !kept.contains("\n  wanted temperature: "));
    bus.scratch
        .file("both.yaml", "od-parameters: 1\nparameters: {wanted temperature: 30.0 °C, place: roof}\n");
    said.extend([
        bus.node("compare", &["both.yaml"]),
        bus.node("restore", &["--yes", "both.yaml"]),
        bus.node("read", &["2004"]),
    ]);
    assert_snapshot!("dirt-malformed", said.concat());
}

/// A default replaces an entry only after it was asked for again, and by name.
#[test]
fn a_rule_asks_again_before_it_takes_a_default() {
    const HIGHEST: &str = "t58584B012000";
    let once = || -> Change {
        let mut came = 0;
        Box::new(move |line| {
            came += usize::from(line.starts_with(HIGHEST));
            let is_first = came == 1 && line.starts_with(HIGHEST);
            Some(if is_first { line.replace(HIGHEST, "t5858FF012000") } else { line.to_owned() })
        })
    };
    let write = |name: &str, broken: Change, more: &[&str]| {
        let bus = Bus::new(name, same(), broken);
        bus.node("write", &[&["2000=30.0 °C", "--yes"], more].concat())
    };
    let said = [
        write("dirt-rule-once", once(), &[]),
        write("dirt-rule-single", once(), &["--retries", "0"]),
        write("dirt-rule-ever", begins(HIGHEST, "t5858FF012000"), &[]),
    ];
    assert_snapshot!("dirt-rule", said.concat());
    let broken = Box::new(|line: &str| {
        let is_of_pdo = line.starts_with("t5858") && matches!(line.get(9..11), Some("18" | "1A"));
        Some(if is_of_pdo { format!("t5858FF{}", &line[7..]) } else { line.to_owned() })
    });
    let bus = Bus::of("dirt-rule-pdo", crate::node::SENSOR, same(), broken);
    let said = bus.node("write", &["1017=500", "--dry-run"]);
    let all = ["1800h.1", "1800h.2", "1A00h", "1A00h.1", "1801h.1", "1801h.2", "1A01h", "1A01h.1"];
    assert!(all.iter().all(|id| said.contains(id)), "{said}");
    assert!(said.contains("note: so are ") && said.contains(" more that cannot be read: "), "{said}");
}

#[test]
fn a_short_answer_is_reported_as_that() {
    let short = Box::new(|line: &str| {
        let cut = line.strip_prefix(TOLD).map(|_| "t58544B002000".to_owned());
        Some(cut.unwrap_or_else(|| line.to_owned()))
    });
    let bus = Bus::new("dirt-short", same(), short);
    assert_snapshot!("dirt-short", bus.node("read", &["2000", "2001"]));
}

#[test]
fn an_answer_without_a_size_is_as_long_as_its_type() {
    let bus = Bus::new("dirt-unsized", same(), begins(TOLD, "t585842002000"));
    let said = [bus.node("read", &["2000"]), bus.node("backup", &["--out", "kept.yaml"])];
    assert_snapshot!("dirt-unsized", said.concat());
    let kept = fs::read_to_string(bus.scratch.0.join("kept.yaml")).unwrap();
    assert!(kept.contains("wanted temperature: 40.0 °C"));
}

#[test]
fn a_write_without_an_answer_is_read_back_before_anything_else() {
    let sent = Arc::new(AtomicUsize::new(0));
    let counted = Arc::clone(&sent);
    let counts = Box::new(move |line: &str| {
        counted.fetch_add(usize::from(line.starts_with("t60582B002000")), Ordering::SeqCst);
        Some(line.to_owned())
    });
    let bus = Bus::new("dirt-write", counts, loses(TAKEN));
    bus.scratch
        .file("low.yaml", "od-parameters: 1\nparameters: {wanted temperature: 20.0 °C, place: roof}\n");
    let mut said = vec![bus.node("write", &["--yes", "2000=30.0 °C", "2004=cellar"])];
    assert_eq!(sent.load(Ordering::SeqCst), 1);
    bus.node("write", &["--yes", "2000=31.0 °C"]);
    said.push(bus.node("restore", &["--yes", "low.yaml"]));
    assert_eq!(sent.load(Ordering::SeqCst), 3);
    let lost = Bus::new("dirt-write-lost", loses("t60582B002000"), same());
    lost.scratch
        .file("low.yaml", "od-parameters: 1\nparameters: {wanted temperature: 20.0 °C, place: roof}\n");
    said.push(lost.node("write", &["--yes", "2000=30.0 °C", "2004=cellar"]));
    lost.node("write", &["--yes", "2000=30.0 °C"]);
    said.push(lost.node("restore", &["--yes", "low.yaml"]));
    assert_snapshot!("dirt-write", said.concat());
}

#[test]
fn a_monitor_asks_on_after_a_malformed_answer() {
    let asked = Arc::new(AtomicUsize::new(0));
    let counted = Arc::clone(&asked);
    let counts = Box::new(move |line: &str| {
        counted.fetch_add(usize::from(line.starts_with("t605840171000")), Ordering::SeqCst);
        Some(line.to_owned())
    });
    let emergency = HEATER.replace("heartbeat producer", "heartbeat producer, emergency");
    let bus = Bus::of("dirt-monitor", &emergency, counts, begins("t585843141000", "t5858FF141000"));
    let said = bus.node("monitor", &["--ask", "--for", "0"]);
    assert!(said.contains("node 5 does not report 1014h, which is taken as specified"), "{said}");
    assert_eq!(asked.load(Ordering::SeqCst), 1, "{said}");
}

/// That a node stores shows in no value.
#[test]
fn a_command_without_an_answer_may_have_come() {
    let bus = Bus::new("dirt-store", same(), loses("t585860101001"));
    assert_snapshot!("dirt-store", bus.run(&["store", "--node", "5", "--yes"]));
}

/// With answers of node 5, other frames come: before the first, the second …
fn brings(frames: &'static [(usize, &'static str)]) -> Change {
    let mut came = 0;
    Box::new(move |line| {
        came += usize::from(line.starts_with("t585"));
        let is_answer = line.starts_with("t585");
        let brought = frames.iter().filter(|(at, _)| is_answer && *at == came);
        let mut lines: Vec<&str> = brought.map(|(_, frame)| *frame).collect();
        lines.push(line);
        Some(lines.join("\r"))
    })
}

const OPERATIONAL: &str = "t705105";
const PRE_OPERATIONAL: &str = "t70517F";
const BOOT_UP: &str = "t705100";

/// What a reset takes away comes back in no answer; its boot-up message may be lost.
#[test]
fn a_node_that_starts_again_in_the_middle_is_reported() {
    let file = "od-parameters: 1\nparameters: {wanted temperature: 40.0 °C, place: at the window}\n";
    let said = |name: &str, frames: &'static [(usize, &'static str)], command: &str, arguments: &[&str]| {
        let bus = Bus::new(&format!("dirt-start-{name}"), same(), brings(frames));
        bus.scratch.file("kept.yaml", file);
        let said = bus.node(command, arguments);
        assert!(!bus.scratch.0.join("none.yaml").exists() || said.contains("-> 0"));
        said
    };
    let backup = ["--out", "none.yaml"];
    let fallen = &[(2, OPERATIONAL), (5, PRE_OPERATIONAL)];
    let reported = [
        said("1", &[(5, BOOT_UP)], "backup", &backup),
        said("2", fallen, "backup", &backup),
        said("3", fallen, "compare", &["kept.yaml"]),
        said("4", fallen, "restore", &["kept.yaml", "--yes"]),
        said("5", fallen, "write", &["2000=30.0 °C", "--yes"]),
        said("9", &[(6, OPERATIONAL), (7, PRE_OPERATIONAL)], "write", &["2000=30.0 °C", "--yes"]),
        // Another master commands it, and to itself it says the same as before.
        said("6", &[(2, OPERATIONAL), (3, "t00028005"), (5, PRE_OPERATIONAL)], "backup", &backup),
        said("7", &[(2, PRE_OPERATIONAL), (5, PRE_OPERATIONAL), (6, OPERATIONAL)], "backup", &backup),
        // It is another node.
        said("8", &[(2, "t706105"), (5, "t70617F")], "backup", &backup),
    ];
    assert_snapshot!("dirt-start", reported.concat());
    let bus = Bus::new("dirt-start-store", same(), brings(&[(2, BOOT_UP)]));
    let stored = bus.run(&["store", "--node", "5", "--yes"]);
    assert!(stored.contains("started again in the middle") && stored.ends_with("-> 1\n"), "{stored}");
}

#[test]
fn a_monitor_reports_which_node_starts_again_after_it_was_asked() {
    let monitor = |name: &str, frames: &'static [(usize, &'static str)]| {
        let bus = Bus::of(&format!("dirt-monitor-{name}"), crate::node::SENSOR, same(), brings(frames));
        bus.node("monitor", &["--ask", "--for", "0", "--only", "heartbeat"])
    };
    for (name, frames, is_told) in [
        ("first", &[(1, BOOT_UP)][..], false),
        ("started", &[(3, BOOT_UP)], true),
        ("fallen", &[(3, OPERATIONAL), (4, PRE_OPERATIONAL)], true),
        ("commanded", &[(2, OPERATIONAL), (3, "t00028000"), (4, PRE_OPERATIONAL)], false),
    ] {
        let said = monitor(name, frames);
        assert_eq!(said.contains("; started again after it was asked\n"), is_told, "{name}: {said}");
        assert_eq!(said.contains("error[OD0716]: sensor (node 5) started again"), is_told, "{name}: {said}");
        assert!(said.ends_with(if is_told { "-> 1\n" } else { "-> 0\n" }), "{name}: {said}");
    }
}

/// A bus with heaters as nodes 5 and 6, which have a file each.
fn house(name: &str, to_nodes: Change, from_nodes: Change) -> Bus {
    let scratch = Scratch::new(name);
    scratch.file("heater.od.yaml", HEATER);
    let plant = "\
od-plant: 1
title: House
devices: {heater: heater.od.yaml}
types:
  flat: {bit-rate: 125, positions: {attic: {heater: 4}, bath: {heater: 5}, hall: {heater: 6}}}
sites: {North: {type: flat, machines: {1: {}}}}
";
    scratch.file("house.yaml", plant);
    let served = Served::start(&scratch, &["heater.od.yaml", "--node", "5", "--node", "6"], Stdio::null());
    let relay = Relay::new(served.address(), to_nodes, from_nodes);
    let bus = Bus { _served: served, relay, scratch };
    fs::create_dir(bus.scratch.0.join("kept")).unwrap();
    for (name, node) in [("attic", 4), ("bath", 5), ("hall", 6)] {
        bus.scratch.file(
            &format!("kept/{name}-heater.yaml"),
            format!("od-parameters: 1\ndevice: heater\nnode: {node}\nparameters: {{wanted temperature: 30.0 °C, place: roof}}\n"),
        );
    }
    bus
}

/// What was judged is what it had before.
#[test]
fn a_node_that_starts_again_before_its_turn_is_not_written_to() {
    let mut is_brought = false;
    let brings = Box::new(move |line: &str| {
        let first = line.starts_with(TAKEN) && !std::mem::replace(&mut is_brought, line.starts_with(TAKEN));
        Some(if first { format!("t706100\r{line}") } else { line.to_owned() })
    });
    let bus = house("dirt-turn", same(), brings);
    let said = bus.run(&["restore", "house.yaml", "kept", "--yes", "--skip", "4"]);
    assert!(said.contains("  bath heater (node 5)  restored\n"), "{said}");
    assert!(said.contains("  hall heater (node 6)  started again in the middle\n"), "{said}");
    let has = bus.run(&["read", "heater.od.yaml", "--node", "6", "2000"]);
    assert!(has.contains("= 40.0 °C") && said.ends_with("-> 1\n"), "{said}{has}");
}

/// It got its values, and perhaps has lost them.
#[test]
fn a_node_that_starts_again_after_its_turn_is_reported_with_what_was_sent() {
    let mut is_brought = false;
    let brings = Box::new(move |line: &str| {
        let of_hall = line.starts_with("t586860002000");
        let first = of_hall && !std::mem::replace(&mut is_brought, of_hall);
        Some(if first { format!("{BOOT_UP}\r{line}") } else { line.to_owned() })
    });
    let bus = house("dirt-turn-after", same(), brings);
    let said = bus.run(&["restore", "house.yaml", "kept", "--yes", "--skip", "4"]);
    assert!(
        said.contains("  bath heater (node 5)  started again in the middle, 2 values were sent\n"),
        "{said}"
    );
    assert!(said.contains("  hall heater (node 6)  restored\n") && said.ends_with("-> 1\n"), "{said}");
}

#[test]
fn each_node_of_a_machine_is_reported_with_its_state() {
    // The first node answers until it is made to take the first value.
    let mut is_gone = false;
    let goes = Box::new(move |line: &str| {
        is_gone |= line.starts_with("t60582B002000");
        (!(is_gone && line.starts_with("t605"))).then(|| line.to_owned())
    });
    let bus = house("dirt-machine", goes, same());
    let said = [
        // A node that is not there: nothing is sent to the others.
        bus.run(&["restore", "house.yaml", "kept", "--yes"]),
        bus.run(&["restore", "house.yaml", "kept", "--yes", "--skip", "4"]),
    ];
    assert_snapshot!("dirt-machine", said.concat());
}

/// Interrupts a command at a line, as Ctrl-C does.
#[cfg(unix)]
struct CtrlC(Arc<std::sync::Mutex<Option<u32>>>);

#[cfg(unix)]
impl CtrlC {
    fn new() -> Self {
        Self(Arc::default())
    }

    /// The command is interrupted at the first line that is one.
    fn at(&self, mut is_it: impl FnMut(&str) -> bool + Send + 'static) -> Change {
        let (process, mut is_done) = (Arc::clone(&self.0), false);
        Box::new(move |line| {
            if !is_done && is_it(line) {
                is_done = true;
                let id = loop {
                    if let Some(id) = *process.lock().unwrap() {
                        break id;
                    }
                    thread::yield_now();
                };
                let id = rustix::process::Pid::from_raw(i32::try_from(id).unwrap()).unwrap();
                rustix::process::kill_process(id, rustix::process::Signal::INT).unwrap();
            }
            Some(line.to_owned())
        })
    }

    /// Runs `odgen node`.
    fn run(&self, bus: &Bus, arguments: &[&str]) -> Output {
        let child = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .arg("node")
            .args(arguments)
            .args(["--slcan", &bus.relay.address])
            .current_dir(&bus.scratch.0)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        *self.0.lock().unwrap() = Some(child.id());
        child.wait_with_output().unwrap()
    }
}

/// An interrupt in the middle of a mapping: the PDO is completed, and what comes after it is not sent.
#[cfg(unix)]
#[test]
fn an_interrupt_lets_the_step_in_hand_come_to_its_end() {
    let (command, mut taken) = (CtrlC::new(), 0);
    // The node has taken the third parameter of the PDO: its mapping is without an entry.
    let from_nodes = command.at(move |line| {
        taken += usize::from(line.starts_with("t5858600"));
        taken == 2
    });
    let bus = Bus::of("dirt-interrupt", crate::node::SENSOR, same(), from_nodes);
    let settings = ["1800.1=0x80000185", "1A00=0", "1A00.1=0x20010010", "1A00=1", "1800.1=0x185", "flow=7"];
    let output =
        command.run(&bus, &[&["write", "heater.od.yaml", "--node", "5", "--yes"][..], &settings].concat());
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let said = stderr(&output);
    let unsent: Vec<&str> = said.lines().filter(|line| line.contains("not sent any more")).collect();
    // The signal may come a write later, and never before the PDO is whole.
    assert_eq!(unsent, ["note: not sent any more: 2001h flow"], "{said}");
    assert!(!said.contains("not switched on again"), "{said}");
    let has = bus.node("read", &["1A00", "1800.1", "flow"]);
    assert!(has.contains("number of mapped entries = 1"), "{has}");
    assert!(has.contains("= 0x00000185") && has.contains("flow = 0"), "{has}");
}

#[cfg(unix)]
#[test]
fn an_interrupt_while_values_are_read_is_reported() {
    for arguments in [
        &["backup", "heater.od.yaml", "--node", "5", "--out", "kept.yaml"][..],
        &["compare", "heater.od.yaml", "--node", "5", "place.yaml"],
    ] {
        let command = CtrlC::new();
        // A question about the identity of the node: values are read after it.
        let bus = Bus::new("dirt-interrupt-read", command.at(|line| line.starts_with("t6058401810")), same());
        bus.scratch.file("place.yaml", "od-parameters: 1\nparameters: {place: roof}\n");
        let output = command.run(&bus, arguments);
        assert_eq!(code(&output), 130, "{}", stderr(&output));
        assert!(stderr(&output).contains("heater (node 5): interrupted before all was read"));
        assert!(!bus.scratch.0.join("kept.yaml").exists());
    }
}

/// That a node stores takes its time: its answer is waited for.
#[cfg(unix)]
#[test]
fn an_interrupt_while_a_node_stores_lets_it_answer() {
    let command = CtrlC::new();
    let bus = Bus::new("dirt-interrupt-store", command.at(|line| line.starts_with("t60582310")), same());
    let output = command.run(&bus, &["store", "--node", "5", "--yes"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).ends_with("node 5 has stored its parameters\n"));
}

/// The mapping of a PDO is lost on its way, while the PDO is switched off.
#[test]
fn a_pdo_is_not_left_off_by_a_lost_frame() {
    let mapping = "t605823001A01";
    let bus = Bus::of("dirt-pdo-restore", crate::node::SENSOR, loses(mapping), same());
    bus.scratch.file(
        "flow.yaml",
        "od-parameters: 1\nparameters: {TPDO 1 mapping parameter: {mapped entry 1: 0x20010010}, TPDO 2 communication parameter: {COB-ID used by TPDO: 0x80000285}}\n",
    );
    let said = bus.node("restore", &["--yes", "flow.yaml"]);
    assert!(
        said.contains("does not have the value, which is written again") && said.ends_with("-> 0\n"),
        "{said}"
    );
    let has = bus.node("read", &["1A00", "1800.1"]);
    assert!(has.contains("= 0x20010010") && has.contains("= 0x00000185"), "{has}");
    // What a user writes is not written again. That the PDO is off is said.
    let bus = Bus::of("dirt-pdo-write", crate::node::SENSOR, loses(mapping), same());
    let settings = ["1800.1=0x80000185", "1A00=0", "1A00.1=0x20010010", "1A00=1", "1800.1=0x185"];
    let said = bus.node("write", &[&["--yes"], &settings[..]].concat());
    let off = "note: switched off and not switched on again: 1800h.1 TPDO 1 communication parameter: COB-ID used by TPDO\n";
    assert!(said.contains(off) && said.ends_with("-> 1\n"), "{said}");
}

/// One message is enough, and what was not done is said.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_reported_once() {
    let bus = Bus::new("dirt-full", same(), same());
    bus.scratch
        .file("other.yaml", "od-parameters: 1\nparameters: {wanted temperature: 30.0 °C, place: roof}\n");
    for (command, more, words) in [
        ("compare", &["other.yaml"][..], ""),
        (
            "write",
            &["--yes", "2000=30.0 °C"],
            "note: nothing was sent, because what would be changed cannot be shown",
        ),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .args(["node", command, "heater.od.yaml", "--node", "5", "--slcan", &bus.relay.address])
            .args(more)
            .current_dir(&bus.scratch.0)
            .stdout(full)
            .output()
            .unwrap();
        let said = stderr(&output);
        assert_eq!(
            (code(&output), said.matches("cannot write to standard output").count()),
            (1, 1),
            "{said}"
        );
        assert!(said.contains(words), "{said}");
    }
}
