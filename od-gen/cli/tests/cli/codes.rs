//! Codes that only the command provokes.

use std::fs;
use std::io::{Read as _, Write as _};
use std::net::TcpListener;

use crate::provoked::{ADAPTER, PROVOKED};
use crate::{Scratch, odgen, stderr};

/// Name and text of each file: a lamp whose 1017h departs from cia301, a template with a mistake, a file that each of five readers
/// refuses for something, two tables, two files that are not concise DCF, a trace with a bad line, a DCF without formulas, three
/// that are no XDD, and an XDD with a fault of each kind.
const FILES: &[(&str, &str)] = &[
    (
        "lamp.od.yaml",
        "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}\n\
         objects:\n  0x1017: {from: cia301, name: heartbeat}\n",
    ),
    ("templates/device.txt", "{{ device.nmae }}\n"),
    ("readers.eds", include_str!("eds/readers.eds")),
    ("cut.bin", "\u{1}"),
    ("long.bin", "\0\0\0\0\u{1}"),
    ("bad.log", "can0 18x#\n"),
    (
        "fixed.dcf",
        "[DeviceInfo]\nBaudRate_125=1\n[DeviceComissioning]\nNodeID=5\nBaudrate=125\n\
         [1014]\nParameterName=EMCY\nDataType=7\nAccessType=rw\nDefaultValue=0x85\n",
    ),
    ("titles.csv", "colour;size\nred;5\n"),
    ("cells.csv", "Index;Name;Type;Access\n2000h;level;UNSIGNED16;always\n2001h;limit;U8;rw\n"),
    ("open.xdd", "<a>"),
    ("typed.xdd", "<!DOCTYPE a><a/>"),
    ("other.xdd", "<a/>"),
    ("faulty.xdd", include_str!("eds/faulty.xdd")),
];

#[test]
fn each_is_provoked() {
    for provocation in PROVOKED {
        let scratch = Scratch::new(provocation.code);
        fs::create_dir(scratch.0.join("templates")).unwrap();
        for (name, text) in FILES {
            scratch.file(name, text);
        }
        let address = if provocation.arguments.contains(&ADAPTER) { adapter() } else { String::new() };
        let arguments: Vec<&str> = provocation
            .arguments
            .iter()
            .map(|argument| if *argument == ADAPTER { address.as_str() } else { argument })
            .collect();
        let said = stderr(&odgen(&scratch.0, &arguments));
        assert!(said.contains(&format!("[{}]", provocation.code)), "{:?}: {said}", provocation.arguments);
    }
}

/// The address of an adapter that says yes to everything, for one client, on a bus with a node 5 that reports only its
/// device type.
fn adapter() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let (mut byte, mut line) = ([0], Vec::new());
        while matches!(stream.read(&mut byte), Ok(1)) {
            line.extend(byte);
            if byte != *b"\r" {
                continue;
            }
            let answer: &[u8] =
                if line.starts_with(b"t6058400010") { b"z\rt58584300100078563412\r" } else { b"\r" };
            if stream.write_all(answer).is_err() {
                return;
            }
            line.clear();
        }
    });
    format!("tcp:{address}")
}
