//! `odgen serve --watch`: what virtual nodes have, live in the terminal.

mod draw;
mod rows;
#[cfg(test)]
mod tests;

use std::io;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use od_bus::runtime::Bus;
use od_bus::trace::{Decoder, Node, Service, What};
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

use super::event::Event;
use rows::Rows;

/// So often it is drawn at most.
const INTERVAL: Duration = Duration::from_millis(100);
/// Frames are counted for so long.
const SECOND: Duration = Duration::from_secs(1);

/// What the user wants after a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wish {
    /// To go on.
    Stay,
    /// To end.
    End,
}

/// What keys are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Keys {
    /// Moving about.
    Moving,
    /// The text that entries are chosen by.
    Typing,
}

/// What is shown, in addition to the values themselves.
struct View<'a> {
    title: String,
    rows: Rows<'a>,
    /// The first row that is shown.
    top: usize,
    /// Rows on a page, as it was drawn last.
    page: usize,
    keys: Keys,
    /// What happened last that nothing else shows.
    note: Option<String>,
    hosts: usize,
    frames_per_second: usize,
}

impl<'a> View<'a> {
    fn new(title: &str, nodes: Vec<Node<'a>>, bus: &Bus<'_>) -> Self {
        Self {
            title: title.to_owned(),
            rows: Rows::new(nodes, bus),
            top: 0,
            page: 1,
            keys: Keys::Moving,
            note: None,
            hosts: 0,
            frames_per_second: 0,
        }
    }

    fn key(&mut self, key: KeyEvent) -> Wish {
        if key.kind == KeyEventKind::Release {
            return Wish::Stay;
        }
        // Who presses a key has read it.
        self.note = None;
        if key.modifiers.contains(KeyModifiers::CONTROL) {
            return if key.code == KeyCode::Char('c') { Wish::End } else { Wish::Stay };
        }
        match (self.keys, key.code) {
            (Keys::Typing, KeyCode::Char(letter)) => self.filter(|filter| filter.push(letter)),
            (Keys::Typing, KeyCode::Backspace) => self.filter(|filter| {
                filter.pop();
            }),
            (Keys::Typing, KeyCode::Enter) => self.keys = Keys::Moving,
            (Keys::Typing, KeyCode::Esc) => {
                self.keys = Keys::Moving;
                self.filter(String::clear);
            }
            (Keys::Moving, KeyCode::Char('q') | KeyCode::Esc) => return Wish::End,
            (Keys::Moving, KeyCode::Char('/')) => self.keys = Keys::Typing,
            (Keys::Moving, KeyCode::Char('a')) => {
                self.rows.turn();
                self.top = 0;
            }
            (_, KeyCode::Up) => self.top = self.top.saturating_sub(1),
            (_, KeyCode::Down) => self.top = self.top.saturating_add(1),
            (_, KeyCode::PageUp) => self.top = self.top.saturating_sub(self.page),
            (_, KeyCode::PageDown) => self.top = self.top.saturating_add(self.page),
            (_, KeyCode::Home) => self.top = 0,
            // Drawing knows where that is.
            (_, KeyCode::End) => self.top = usize::MAX,
            _ => {}
        }
        Wish::Stay
    }

    fn filter(&mut self, change: impl FnOnce(&mut String)) {
        change(&mut self.rows.filter);
        self.top = 0;
    }
}

/// The view on a terminal, which is as it was before when this ends.
pub(super) struct Watch<'a> {
    view: View<'a>,
    decoder: Decoder<'a>,
    terminal: DefaultTerminal,
    drawn: Option<Duration>,
    /// Frames since a time.
    counted: (usize, Duration),
}

impl<'a> Watch<'a> {
    /// Takes the terminal.
    pub(super) fn open(
        title: &str,
        known: impl Fn() -> Vec<Node<'a>>,
        bus: &Bus<'_>,
        events: SyncSender<Event>,
    ) -> io::Result<Self> {
        let view = View::new(title, known(), bus);
        let decoder = Decoder::new(known());
        let terminal = ratatui::try_init().inspect_err(|_| drop(ratatui::try_restore()))?;
        std::thread::spawn(move || {
            while let Ok(event) = event::read() {
                let event::Event::Key(key) = event else { continue };
                if events.send(Event::Key(key)).is_err() {
                    return;
                }
            }
        });
        Ok(Self { view, decoder, terminal, drawn: None, counted: (0, Duration::ZERO) })
    }

    /// A frame was on the bus.
    pub(super) fn frame(&mut self, what: &What) {
        self.counted.0 += 1;
        let described = self.decoder.described(what);
        if let (Service::Emergency, Some(node)) = (described.service, described.node) {
            let text = described.text.split_once("EMCY  ").map_or(described.text.as_str(), |(_, text)| text);
            self.view.rows.emergency(node, text);
        }
    }

    /// Something is to be said.
    pub(super) fn note(&mut self, text: &str) {
        self.view.note = Some(text.to_owned());
    }

    /// Takes a key.
    pub(super) fn key(&mut self, key: KeyEvent) -> Wish {
        self.drawn = None;
        self.view.key(key)
    }

    /// Draws what there is now, if it is time; what the terminal does not take is drawn the next time.
    pub(super) fn draw(&mut self, bus: &Bus<'_>, hosts: usize, now: Duration) {
        if self.drawn.is_some_and(|drawn| now.saturating_sub(drawn) < INTERVAL) {
            return;
        }
        self.drawn = Some(now);
        let (count, since) = self.counted;
        let passed = now.saturating_sub(since);
        if passed >= SECOND {
            let millis = usize::try_from(passed.as_millis()).unwrap_or(usize::MAX).max(1);
            self.view.frames_per_second = count.saturating_mul(1000) / millis;
            self.counted = (0, now);
        }
        self.view.hosts = hosts;
        self.view.rows.look(bus);
        let view = &mut self.view;
        let _ = self.terminal.draw(|frame| draw::draw(frame, view));
    }
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        let _ = ratatui::try_restore();
    }
}
