use std::fmt::Write as _;

use firmware_glue::EntryId;
use firmware_glue::emcy::Emergency;
use od_bus::runtime::{self, LiveDictionary, VirtualNode};
use od_bus::slcan::CanFrame;
use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::*;

const LAMP: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, emergency]}
units:
  percent: {symbol: \"%\"}
types:
  status: {base: unsigned8, bits: {0: on, 1: warm, 2: too hot for the glass, 3: switched by hand, 4..7: reserved}}
objects:
  0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, pdo: transmit, default: 80}
  0x2001: {name: status, type: status, access: ro, pdo: transmit, default: [on]}
  0x2002: {name: time that the lamp has been on since it was made, type: unsigned32, access: ro, pdo: transmit, default: 7}
  0x2003: {name: place, type: visible-string, access: rw, capacity: 20, default: at the window}
pdos:
  lamp:
    transmit: {1: {map: [brightness, status, 0x2002]}}
errors:
  0x4210: {name: too hot, about: It is over 80 degrees.}
";

/// What is on a screen of this size, line by line.
fn screen(view: &mut View<'_>, width: u16, height: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw::draw(frame, view)).unwrap();
    let buffer = terminal.backend().buffer();
    let mut text = String::new();
    for y in 0..height {
        let line: String = (0..width).map(|x| buffer[(x, y)].symbol()).collect();
        let _ = writeln!(text, "|{line}|");
    }
    text
}

fn press(view: &mut View<'_>, keys: &[KeyCode]) -> Wish {
    keys.iter().fold(Wish::Stay, |_, key| view.key(KeyEvent::from(*key)))
}

#[test]
fn the_view_shows_what_nodes_have_and_follows_keys() {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.od.yaml", LAMP);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let system = compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let device = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = device.lists();
    let table = lists.table().unwrap();
    let node = |id| VirtualNode::new(id, LiveDictionary::new(&device, &table, id).unwrap()).unwrap();
    let mut bus = Bus::new(vec![node(5), node(6)]);
    let known = || vec![Node::new(5, &system, &system.devices[0]), Node::new(6, &system, &system.devices[0])];
    let mut view = View::new("serving lamp (node 5), lamp (node 6) at tcp:127.0.0.1:3333", known(), &bus);
    let mut shown = vec![("before it starts", screen(&mut view, 72, 12))];
    // It starts, gets other values, and has an error.
    bus.poll(0);
    let node = &mut bus.nodes_mut()[0];
    node.set(EntryId { index: 0x2000, sub: 0 }, &[60], 0).unwrap();
    node.set(EntryId { index: 0x2001, sub: 0 }, &[0x0F], 0).unwrap();
    node.set(EntryId { index: 0x2003, sub: 0 }, b"on the roof", 0).unwrap();
    node.raise(Emergency::new(0x4210), 0);
    let mut decoder = Decoder::new(known());
    for frame in bus.poll(0) {
        let described = decoder.described(&What::Frame(CanFrame::Standard(frame)));
        if described.service == Service::Emergency {
            view.rows.emergency(5, described.text.split_once("EMCY  ").unwrap().1);
        }
    }
    view.rows.look(&bus);
    (view.hosts, view.frames_per_second) = (1, 125);
    shown.push(("started", screen(&mut view, 72, 20)));
    press(&mut view, &[KeyCode::Char('/'), KeyCode::Char('B'), KeyCode::Char('r')]);
    shown.push(("typing", screen(&mut view, 72, 6)));
    press(&mut view, &[KeyCode::Enter]);
    view.note = Some("node 5: error 4210h is present already".to_owned());
    shown.push(("typed", screen(&mut view, 110, 6)));
    press(&mut view, &[KeyCode::Char('/'), KeyCode::Esc, KeyCode::Char('a'), KeyCode::End]);
    shown.push(("the end of all", screen(&mut view, 72, 8)));
    press(&mut view, &[KeyCode::PageUp, KeyCode::Up, KeyCode::Down, KeyCode::Down]);
    shown.push(("narrow", screen(&mut view, 30, 8)));
    shown.push(("tiny", screen(&mut view, 3, 2)));
    let text: Vec<String> = shown.iter().map(|(what, screen)| format!("{what}\n{screen}")).collect();
    insta::assert_snapshot!(text.join("\n"));
    assert_eq!(press(&mut view, &[KeyCode::Char('x')]), Wish::Stay);
    assert_eq!(press(&mut view, &[KeyCode::Char('q')]), Wish::End);
    let interrupt = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
    assert_eq!(view.key(interrupt), Wish::End);
}
