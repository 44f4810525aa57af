//! The SLCAN driver of the demo firmware, on the host: it hears and says the same lines as `od_bus::slcan`.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::convert::Infallible;

use embedded_can::nb::Can;
use firmware_glue::frame::{CanId, Frame};
use od_bus::slcan::{self, Adapter};
use slcan_of_demo::{Slcan, Wire};

#[expect(unreachable_pub, reason = "a module of a firmware")]
#[path = "../../../firmware-glue/examples/pitch-controller/src/slcan.rs"]
mod slcan_of_demo;

/// A serial line: what the host has sent, and what it is sent.
#[derive(Debug, Default)]
struct Line {
    heard: VecDeque<u8>,
    said: Vec<u8>,
    /// How many bytes it takes before the host reads.
    room: usize,
}

impl Line {
    fn new(heard: &str, room: usize) -> RefCell<Self> {
        RefCell::new(Self { heard: heard.bytes().collect(), room, ..Self::default() })
    }

    fn said(line: &RefCell<Self>) -> String {
        String::from_utf8(line.borrow().said.clone()).expect("ASCII")
    }
}

impl Wire for &RefCell<Line> {
    fn receive(&mut self) -> Option<u8> {
        self.borrow_mut().heard.pop_front()
    }

    fn send(&mut self, byte: u8) -> nb::Result<(), Infallible> {
        let mut line = self.borrow_mut();
        line.room = line.room.checked_sub(1).ok_or(nb::Error::WouldBlock)?;
        line.said.push(byte);
        Ok(())
    }
}

/// What a driver answers to a text, and the frames in it.
fn hear(text: &str) -> (String, Vec<Frame>) {
    let line = Line::new(text, usize::MAX);
    let mut driver = Slcan::new(&line);
    let mut frames = Vec::new();
    while let Ok(message) = driver.receive() {
        frames.extend(Frame::of_driver(&message));
    }
    (Line::said(&line), frames)
}

/// What `od_bus::slcan` answers to it.
fn expected(text: &str) -> (String, Vec<Frame>) {
    let (mut adapter, mut answers, mut frames) = (Adapter::new(), Vec::new(), Vec::new());
    for line in text.split_terminator('\r') {
        let reply = adapter.take(line);
        answers.extend(reply.answer);
        if let Some(slcan::CanFrame::Standard(frame)) = reply.send {
            frames.push(frame);
        }
    }
    (String::from_utf8(answers).expect("ASCII"), frames)
}

fn frames() -> impl Iterator<Item = Frame> {
    let ids = [0, 1, 0x80, 0x1AB, 0x605, 0x7FF].into_iter().filter_map(CanId::new);
    ids.flat_map(|id| {
        let bytes = [0, 9, 0x0A, 0x9F, 0xA0, 0xF0, 0x7E, 0xFF];
        (0..=8_u8).flat_map(move |length| {
            [Frame::data(id, &bytes[..usize::from(length)]), Frame::remote(id, length)].into_iter().flatten()
        })
    })
}

#[test]
fn frames_are_the_same_lines_in_both_directions() {
    let (mut count, mut text) = (0, "O\r".to_owned());
    for frame in frames() {
        count += 1;
        text += &slcan::line(&frame);
        let line = Line::new("O\r", usize::MAX);
        let mut driver = Slcan::new(&line);
        assert!(driver.receive().is_err(), "nothing but a command");
        driver.transmit(&frame.for_driver().expect("the driver has all")).expect("there is room");
        assert_eq!(Line::said(&line), format!("\r{}", slcan::line(&frame)));
    }
    assert_eq!(hear(&text).1.len(), count);
    assert_eq!(hear(&text), (format!("\r{}", "z\r".repeat(count)), frames().collect()));
}

#[test]
fn commands_are_answered_alike() {
    for text in [
        "C\rS6\rO\rt60581122334455667788\rC\rt6050\r",
        "\r\r\rO\rO0\rOO\rS6\rt\rt6\rt60\rt605\rt6059\rt60511\rt605111\rt6051112\rr60501\rr6058\r",
        "S9\rS\rS66\rs\rt8000\rO\rt8000\rtFFF0\rt60g0\rt605x\rt6051+1\rt605 0\rt60510G\r",
        "O\rt605DDDD\rT605\ru\r?\rt7FF8FFFFFFFFFFFFFFFF\r",
    ] {
        assert_eq!(hear(text), expected(text), "{text:?}");
    }
    assert_eq!(hear("O\rT000006050\rZ1\rV\rN\r").0, "\r\x07\x07V1010\rNDEMO\r");
}

#[test]
fn a_host_that_does_not_read_loses_nothing() {
    let line = Line::new("O\r", 3);
    let mut driver = Slcan::new(&line);
    assert!(driver.receive().is_err(), "nothing but a command");
    let (mut taken, mut expected) = (0, "\r".to_owned());
    for frame in frames() {
        if driver.transmit(&frame.for_driver().expect("the driver has all")).is_ok() {
            assert_eq!(taken, expected.matches('\r').count() - 1, "once full, it takes no more");
            expected += &slcan::line(&frame);
            taken += 1;
        }
    }
    assert!((8..frames().count()).contains(&taken), "{taken}");
    assert_eq!(Line::said(&line), expected[..3]);
    // A request that cannot be answered waits.
    let requests = 100;
    line.borrow_mut().heard.extend("t6050\r".repeat(requests).bytes());
    let mut heard = 0;
    while driver.receive().is_ok() {
        heard += 1;
    }
    assert!(heard < requests && !line.borrow().heard.is_empty());
    line.borrow_mut().room = usize::MAX;
    while driver.receive().is_ok() {
        heard += 1;
    }
    assert_eq!(heard, requests);
    assert_eq!(Line::said(&line), expected + &"z\r".repeat(requests));
}
