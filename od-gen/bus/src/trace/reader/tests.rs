use firmware_glue::frame::{CanId, Frame};

use super::*;
use crate::slcan::CanFrame;
use crate::trace::{Seen, What};

/// What a trace has: head and content of each frame, or the text that is wrong.
fn read(text: &str) -> Vec<(String, Option<What>)> {
    let mut reader = Reader::default();
    let read = text.lines().filter_map(|line| match reader.read(line) {
        Ok(Line::Empty) => None,
        Ok(Line::Seen(Seen { head, what })) => Some((head.join(" "), Some(what))),
        Err(bad) => Some((line[bad.at].to_owned(), None)),
    });
    read.collect()
}

fn seen(head: &str, what: What) -> (String, Option<What>) {
    (head.to_owned(), Some(what))
}

fn wrong(text: &str) -> (String, Option<What>) {
    (text.to_owned(), None)
}

fn frame(id: u16, bytes: &[u8]) -> What {
    What::Frame(CanFrame::Standard(CanId::new(id).and_then(|id| Frame::data(id, bytes)).unwrap()))
}

fn remote(id: u16, length: u8) -> What {
    What::Frame(CanFrame::Standard(CanId::new(id).and_then(|id| Frame::remote(id, length)).unwrap()))
}

const fn extended(id: u32, length: u8) -> What {
    What::Frame(CanFrame::Extended { id, length })
}

#[test]
fn traces_of_pcan_view_are_read_by_their_version() {
    for (version, lines) in [
        ("1.0", "1)  1.5  0185  2  E8 03\n2)  1.6  0705  1  RTR\n3)  1.7  FFFFFFFF  4  00 00 00 08"),
        (
            "1.1",
            "1)  1.5  Rx  0185  2  E8 03\n2)  1.6  Tx  0705  1  RTR\n3)  1.7  Warng  FFFFFFFF  4  00 00 00 08",
        ),
        ("1.2", "1)  1.5 1 Rx  0185  2  E8 03\n2)  1.6 1 Tx  0705  1  RTR"),
        ("1.3", "1)  1.5 1 Rx  0185 - 2  E8 03\n2)  1.6 1 Tx  0705 - 1  RTR"),
        ("2.0", "1  1.5 DT  0185 Rx 2  E8 03\n2  1.6 RR  0705 Rx 1\n3  1.7 ST  Rx 00 00 00 00"),
        ("2.1", "1  1.5 DT 1 0185 Rx - 2  E8 03\n2  1.6 RR 1 0705 Rx - 1"),
    ] {
        let found = read(&format!(";$FILEVERSION={version}\n;   a remark\n{lines}\n"));
        let what: Vec<_> = found.iter().map(|(_, what)| *what).collect();
        assert_eq!(what, [Some(frame(0x185, &[0xE8, 3])), Some(remote(0x705, 1))], "{version}");
        assert!(found[0].0.contains("1.5"), "{found:?}");
    }
}

#[test]
fn columns_of_a_trc_file_are_as_it_says() {
    let text = ";$FILEVERSION=2.1\n;$COLUMNS=T,O,I,L,D\nDT 5.0 18DA00F1 2 01 02\nDT 5.1 0123 0\nFB 5.2 0123 9 01\nER 5.3 - 0\nXX 5.4 0123 0\n\
                DT 5.5 0123 2 1\nDT 5.6 0999 0\nDT 5.7 0123 16\n;$COLUMNS=T,?\n;$FILEVERSION=3.0\n";
    assert_eq!(
        read(text),
        [
            seen("5.0", extended(0x18DA_00F1, 2)),
            seen("5.1", frame(0x123, &[])),
            seen("5.2", What::Fd(0x123)),
            seen("5.3", What::Error),
            wrong("XX"),
            wrong("1"),
            wrong("0999"),
            wrong("16"),
            wrong("?"),
            wrong("3.0"),
        ]
    );
}

#[test]
fn traces_of_canalyzer_are_read_in_their_base() {
    let text = "date Fri Mar 1 03:29:50.349 pm 2024\nbase hex  timestamps absolute\nno internal events logged\n// version 9.0.0\n\
                Begin Triggerblock Fri Mar 1 03:29:50.349 pm 2024\n   0.000000 Start of measurement\n\
                0.010000 1  185             Rx   d 2 E8 03  Length = 0 BitCount = 64 ID = 389\n0.02 1 705 Tx r\n0.03 2 705 Tx r 1\n\
                0.04 1 18DA00F1x Rx d 1 FF\n0.05 1 ErrorFrame\n0.06 1  Statistic: D 0 R 0 XD 0\n0.07 CANFD 1 Rx 185 1 0 9 12 00 01\n\
                0.08 CAN 1 Status:chip status error active\n0.09 1 185 Rx d 2 E8\n0.1 1 1850 Rx d 0\n0.11 1 185 Rx q 0\n0.12 1 185 up d 0\nhello\n\
                End TriggerBlock\nbase dec\n0.13 1 389 Rx d 2 232 3\n0.14 1 389 Rx d 1 256\nbase oct\n";
    assert_eq!(
        read(text),
        [
            seen("0.010000 1", frame(0x185, &[0xE8, 3])),
            seen("0.02 1", remote(0x705, 0)),
            seen("0.03 2", remote(0x705, 1)),
            seen("0.04 1", extended(0x18DA_00F1, 1)),
            seen("0.05 1", What::Error),
            seen("0.07 1", What::Fd(0x185)),
            wrong(""),
            wrong("1850"),
            wrong("q"),
            wrong("up"),
            wrong("hello"),
            seen("0.13 1", frame(0x185, &[0xE8, 3])),
            wrong("256"),
            wrong("oct"),
        ]
    );
    assert_eq!(read("base dec timestamps absolute\n0.1 1 5 Rx d 0\n"), [seen("0.1 1", frame(5, &[]))]);
}

#[test]
fn a_trace_without_a_head_is_read_line_by_line() {
    let text = "; a remark\n(1.5) can0 185#E803\nt7051R\n  can0  705   [1]  05\n";
    assert_eq!(
        read(text),
        [seen("(1.5) can0", frame(0x185, &[0xE8, 3])), wrong("t7051R"), seen("can0", frame(0x705, &[5]))]
    );
}
