//! A bus as an observer sees it: what changes, in words, which nodes are there, and whose heartbeat is lost.
//!
//! It neither sends nor waits: frames and times go in, in microseconds from any beginning, and lines come out.

mod beat;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use od_spec::model::EntryId;

use self::beat::{Beat, Heard, Stated};
use crate::restarts::{ERROR_CONTROL, Restarts};
use crate::slcan::CanFrame;
use crate::trace::{Decoder, Described, Service, What};

/// What is reported.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Shows {
    /// How much.
    pub detail: Detail,
    /// Of which services; none of them named means all.
    pub only: BTreeSet<Service>,
}

/// How much is reported of what goes on all the time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Detail {
    /// What changes: a heartbeat with another state, a PDO with other values. SYNC and TIME only where they are asked for.
    #[default]
    Changes,
    /// Every frame.
    Everything,
}

/// Watches a bus.
#[derive(Debug)]
pub struct Monitor<'a> {
    decoder: Decoder<'a>,
    shows: Shows,
    /// What was reported of an identifier last; asking for it is something else.
    last: BTreeMap<(u16, Asked), String>,
    nodes: BTreeMap<u8, Watched>,
    restarts: Restarts,
    frames: u64,
    start: u64,
}

/// Whether a frame has a content or asks for one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Asked {
    No,
    Yes,
}

/// What is known of a node.
#[derive(Debug, Default)]
struct Watched {
    beat: Beat,
    /// The last emergency since it started, and when.
    emergency: Option<(u64, String)>,
    learnt: Learnt,
}

/// What was read from a node.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Learnt {
    #[default]
    Nothing,
    Valid,
    /// It has started again since.
    Outdated,
}

impl<'a> Monitor<'a> {
    /// One that begins at a time.
    pub fn new(decoder: Decoder<'a>, shows: Shows, now: u64) -> Self {
        let nodes = decoder.nodes().iter().map(|node| (node.id, Watched::default())).collect();
        Self {
            decoder,
            shows,
            last: BTreeMap::new(),
            nodes,
            restarts: Restarts::default(),
            frames: 0,
            start: now,
        }
    }

    /// Takes note of a value that was read from a node: identifiers and mappings follow.
    pub fn learn(&mut self, node: u8, entry: EntryId, bytes: &[u8]) {
        self.decoder.learn(node, entry, bytes);
        let learnt = &mut self.nodes.entry(node).or_default().learnt;
        if *learnt == Learnt::Nothing {
            *learnt = Learnt::Valid;
        }
    }

    /// The nodes that have started again since something was read from them.
    pub fn outdated(&self) -> impl Iterator<Item = String> {
        let outdated = self.nodes.iter().filter(|(_, watched)| watched.learnt == Learnt::Outdated);
        outdated.map(|(node, _)| self.name(*node))
    }

    /// Takes what is on the bus; the lines that report it.
    pub fn take(&mut self, what: &What, now: u64) -> Vec<String> {
        self.frames += 1;
        let described = self.decoder.described(what);
        let mut lines = Vec::new();
        let mut is_news = false;
        if let What::Frame(CanFrame::Standard(frame)) = what {
            if let Some((node, _)) = self.restarts.hear(frame) {
                let learnt = &mut self.nodes.entry(node).or_default().learnt;
                if *learnt == Learnt::Valid {
                    *learnt = Learnt::Outdated;
                }
            }
            let id = frame.id().get();
            let node = id.checked_sub(ERROR_CONTROL).and_then(|node| u8::try_from(node).ok());
            if let Some(node) = node.filter(|node| (1..=127).contains(node)) {
                let watched = self.nodes.entry(node).or_default();
                match frame.bytes() {
                    Some([state]) => {
                        if *state == 0 {
                            watched.emergency = None;
                        }
                        match watched.beat.heard(*state, now) {
                            Heard::Again => {}
                            Heard::First => is_news = true,
                            Heard::Back { silent } => {
                                is_news = true;
                                let name = self.name(node);
                                let seconds = seconds(silent);
                                lines.push(self.line(now, &format!("{name}  is back after {seconds}")));
                            }
                        }
                    }
                    Some(_) => {}
                    None => watched.beat.is_guarded(),
                }
            }
            if let (Service::Emergency, Some(node)) = (described.service, described.node) {
                let text =
                    described.text.split_once("EMCY  ").map_or(described.text.as_str(), |(_, text)| text);
                self.nodes.entry(node).or_default().emergency = Some((now, text.to_owned()));
            }
            let asked = if frame.bytes().is_some() { Asked::No } else { Asked::Yes };
            let before = self.last.insert((id, asked), described.text.clone());
            is_news |= before.is_none_or(|before| before != described.text);
        } else {
            is_news = true;
        }
        if self.is_shown(&described, is_news) {
            lines.push(self.line(now, &described.text));
        }
        lines
    }

    fn is_shown(&self, described: &Described, is_news: bool) -> bool {
        let is_asked_for = self.shows.only.contains(&described.service);
        if !is_asked_for && !self.shows.only.is_empty() {
            return false;
        }
        match (self.shows.detail, described.service) {
            (Detail::Everything, _) => true,
            (Detail::Changes, Service::Nmt | Service::Emergency | Service::Sdo | Service::Lss) => true,
            (Detail::Changes, Service::Pdo | Service::Heartbeat | Service::Unknown) => is_news,
            (Detail::Changes, Service::Sync | Service::Time) => is_asked_for,
        }
    }

    /// What has not come. To be called when [`next_deadline`](Self::next_deadline) is there.
    pub fn poll(&mut self, now: u64) -> Vec<String> {
        let mut lost = Vec::new();
        for (node, watched) in &mut self.nodes {
            let stated = stated(&self.decoder, *node);
            if let Some(silence) = watched.beat.lose(stated, self.start, now) {
                lost.push((*node, silence));
            }
        }
        let shown = self.shows.only.is_empty() || self.shows.only.contains(&Service::Heartbeat);
        lost.retain(|_| shown);
        let describe = |(node, silence): (u8, beat::Silence)| {
            let (name, every, silent) = (self.name(node), seconds(silence.period), seconds(silence.since));
            let text = match silence.last {
                Some(_) => format!("{name}  heartbeat lost: none for {silent}, where one came every {every}"),
                None => format!("{name}  no heartbeat for {silent}, where 1017h says one every {every}"),
            };
            self.line(now, &text)
        };
        lost.into_iter().map(describe).collect()
    }

    /// When something is late, unless it comes before.
    pub fn next_deadline(&self) -> Option<u64> {
        let nodes = self.nodes.iter();
        nodes
            .filter_map(|(node, watched)| watched.beat.late_at(stated(&self.decoder, *node), self.start))
            .min()
    }

    /// What was seen: how many frames, and each node with its state, its heartbeat and its last emergency.
    pub fn summary(&self, now: u64) -> String {
        let frames = if self.frames == 1 { "frame" } else { "frames" };
        let mut text = format!("{} {frames} in {}\n", self.frames, seconds(now.saturating_sub(self.start)));
        for (node, watched) in &self.nodes {
            let _ = write!(text, "  {}  {}", self.name(*node), watched.beat.summary(now));
            if let Some((at, emergency)) = &watched.emergency {
                let _ = write!(text, "; last EMCY {} ago: {emergency}", seconds(now.saturating_sub(*at)));
            }
            if watched.learnt == Learnt::Outdated {
                text.push_str("; started again after it was asked");
            }
            text.push('\n');
        }
        text
    }

    fn name(&self, node: u8) -> String {
        let known = self.decoder.nodes().iter().find(|known| known.id == node);
        known.map_or_else(|| format!("node {node} (no dictionary)"), crate::trace::Node::name)
    }

    fn line(&self, now: u64, text: &str) -> String {
        let since = now.saturating_sub(self.start) / 1000;
        format!("({}.{:03})  {text}", since / 1000, since % 1000)
    }
}

/// What 1017h of a node says of its heartbeat, as far as it is known. That it is specified to have none says nothing of this one.
fn stated(decoder: &Decoder<'_>, node: u8) -> Stated {
    let Some(known) = decoder.nodes().iter().find(|known| known.id == node) else { return Stated::Unknown };
    match (known.seen(0x1017, 0), known.parameter(0x1017, 0)) {
        (Some(0), _) => Stated::None,
        (_, Some(time)) if time > 0 => Stated::Every(u64::from(time) * 1000),
        _ => Stated::Unknown,
    }
}

/// `1.5 s`.
fn seconds(micros: u64) -> String {
    let tenths = micros.saturating_add(50_000) / 100_000;
    format!("{}.{} s", tenths / 10, tenths % 10)
}
