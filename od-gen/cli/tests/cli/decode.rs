//! `odgen decode`.

use std::io::Write as _;
use std::process::{Command, Stdio};

use insta::assert_snapshot;

use crate::{LAMP, PITCH, ROOF_FAN, Scratch, code, odgen, stderr, stdout};

/// Decodes a trace with the PMC as node 5 and the PMM as node 1.
fn of_pitch(name: &str, trace: &str) -> (String, String, i32) {
    let scratch = Scratch::new(name);
    scratch.file("trace.log", trace);
    let arguments = ["decode", PITCH, "--node", "5=pmc", "--node", "1=pmm", "--trace", "trace.log"];
    let output = odgen(&scratch.0, &arguments);
    (stdout(&output), stderr(&output), code(&output))
}

#[test]
fn every_service_is_reported() {
    let (reported, said, code) = of_pitch(
        "decode-services",
        "\
(1700000000.000000) can0 000#8005
(1700000000.000100) can0 705#00
(1700000000.000200) can0 705#7F
(1700000000.000300) can0 705#R1
(1700000000.000400) can0 000#0100
  can0  080   [0]
  can0  080   [1]  2A
(000.500000)  can0  RX - -  085   [8]  10 23 03 00 00 00 00 01   '.#......'
can0 085#0000000000000000
can0 085#3412010000000000
can0 085#1023
t185237020A5F
can0 205#0600
can0 100#E0930400F03B
can0 7E5#0401000000000000
can0 7E5#4078563412000000
can0 7E4#4F00000000000000
",
    );
    assert_eq!((said.as_str(), code), ("", 0));
    assert_snapshot!("decode-services", reported);
}

#[test]
fn foreign_frames_are_reported_to_be_unknown() {
    let (reported, said, code) = of_pitch(
        "decode-foreign",
        "\
# Node 9 and others have no dictionary.
can0 18DA00F1#01
can0 181##30102
can0 20000004#0000000000000000
can0 285#0102
can0 409#00
can0 709#05
can0 089#3081010000000000
can0 123#0011
can0 123#R2
",
    );
    assert_eq!((said.as_str(), code), ("", 0));
    assert_snapshot!("decode-foreign", reported);
}

#[test]
fn sdo_transfers_are_reported_with_their_values() {
    let (reported, said, code) = of_pitch(
        "decode-sdo",
        "\
can0 605#4041600000000000
can0 585#4B41600037020000
can0 605#2340600000000000
can0 585#8040600010000706
can0 605#2240600006000000
can0 585#6040600000000000
can0 605#4008100000000000
can0 585#4108100003000000
can0 605#6000000000000000
can0 585#09504D4300000000
can0 605#4000900000000000
can0 585#8000900000000206
can0 605#4041600300000000
can0 585#8041600311000906
can0 605#A00810000A000000
can0 585#C208100003000000
can0 605#A300000000000000
can0 585#81504D4300000000
can0 605#A2010A0000000000
can0 585#D100000000000000
can0 605#A100000000000000
can0 605#E000000000000000
can0 605#40
",
    );
    assert_eq!((said.as_str(), code), ("", 0));
    assert_snapshot!("decode-sdo", reported);
}

/// A client gives the first TPDO another content; a reset takes it back.
#[test]
fn mappings_follow_what_clients_write() {
    let (reported, said, code) = of_pitch(
        "decode-mapping",
        "\
can0 185#3702
can0 605#23001801850100C0
can0 585#6000180100000000
can0 185#3702
can0 605#2F001A0000000000
can0 585#60001A0000000000
can0 605#23001A0110006460
can0 585#60001A0100000000
can0 605#23001A0120006460
can0 585#80001A0141000406
can0 605#23001A0110004160
can0 585#60001A0100000000
can0 605#23001A0220006460
can0 585#60001A0200000000
can0 605#2F001A0002000000
can0 585#60001A0000000000
can0 605#2300180185010040
can0 585#6000180100000000
can0 185#3702D2040000
can0 185#3702D204
can0 000#8105
can0 185#3702
",
    );
    assert_eq!((said.as_str(), code), ("", 0));
    assert_snapshot!("decode-mapping", reported);
}

#[test]
fn lines_that_cannot_be_read_are_reported_with_their_place() {
    let (reported, said, code) = of_pitch("decode-bad", "can0 080#\ncan0 18x#\n\nt1819\ncan0 705#05\n");
    assert_eq!(code, 1);
    assert_snapshot!("decode-bad", format!("{reported}---\n{said}"));
}

#[test]
fn a_trace_comes_from_standard_input() {
    let scratch = Scratch::new("decode-stdin");
    let mut child = Command::new(env!("CARGO_BIN_EXE_odgen"))
        .args(["decode", PITCH, "--node", "5=pmc"])
        .current_dir(&scratch.0)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // As an adapter with SLCAN sends them.
    child.stdin.take().unwrap().write_all(b"t00020105\rt705105\rr7050\r").unwrap();
    let output = child.wait_with_output().unwrap();
    assert_snapshot!("decode-stdin", stdout(&output));
}

#[test]
fn nodes_are_named_or_are_those_of_dcfs() {
    let scratch = Scratch::new("decode-nodes");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("fan.dcf", ROOF_FAN);
    scratch.file("trace.log", "can0 721#05\ncan0 705#7F\n");
    let decode = |arguments: &[&str]| {
        let output = odgen(&scratch.0, &[&["decode", "--trace", "trace.log"], arguments].concat());
        format!("{}{}", stdout(&output), stderr(&output))
    };
    let all = [
        decode(&["lamp.od.yaml"]),
        decode(&["lamp.od.yaml", "--node", "0"]),
        decode(&["lamp.od.yaml", "--node", "5=torch"]),
        decode(&["lamp.od.yaml", "--node", "5", "--node", "5"]),
        decode(&[PITCH, "--node", "5"]),
        decode(&["lamp.od.yaml", "--node", "5"]),
        decode(&["fan.dcf"]),
    ];
    assert_snapshot!("decode-nodes", all.join("---\n"));
}

#[test]
fn lines_of_an_adapter_are_reported_as_they_come() {
    let scratch = Scratch::new("decode-returns");
    scratch.file("lamp.od.yaml", LAMP);
    let mut child = Command::new(env!("CARGO_BIN_EXE_odgen"))
        .args(["decode", "lamp.od.yaml", "--node", "5", "--format", "short"])
        .current_dir(&scratch.0)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut output = std::io::BufReader::new(child.stdout.take().unwrap());
    // There is no line feed, and the pipe stays open.
    for (line, reported) in [
        ("t705100\r", "705h  lamp (node 5)  boot-up\n"),
        ("t705105\r\n", "705h  lamp (node 5)  heartbeat  operational\n"),
        ("\n\rt7051", ""),
        ("7F\r", "705h  lamp (node 5)  heartbeat  pre-operational\n"),
    ] {
        std::io::Write::write_all(&mut input, line.as_bytes()).unwrap();
        let mut said = String::new();
        if !reported.is_empty() {
            std::io::BufRead::read_line(&mut output, &mut said).unwrap();
        }
        assert_eq!(said, reported);
    }
    // A line that does not end in time is wrong, and not kept.
    let endless = [b"t705100 ".as_slice(), &vec![b'x'; 1 << 20], b"\rwhat\r"].concat();
    std::io::Write::write_all(&mut input, &endless).unwrap();
    drop(input);
    let said = String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap();
    assert!(said.contains("<stdin>:6:1: error[OD0714]: expected a line of at most 4096 bytes"), "{said}");
    assert!(said.contains("<stdin>:7:1: error[OD0714]"), "{said}");
}
