//! The steps of a program download, one after the other.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use od_bus::client::{AccessError, Bus, Client};
use od_bus::program::{Command, FlashStatus, State};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::EntryId;

use super::failure::{Effect, Failure, Step, left};
use super::{Places, little_endian, state, state_in_words};
use crate::commands::node::Target;
use crate::commands::node::args::NodeProgramArgs;
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::report::Report;

/// The node is asked so often.
const INTERVAL: Duration = Duration::from_millis(100);

/// NMT: enter pre-operational. Devices take commands for programs only there.
const PRE_OPERATIONAL: u8 = 128;

/// A download that is under way.
pub(super) struct Download<'a, B> {
    client: &'a mut Client<B>,
    target: Target<'a>,
    places: Places,
    program: u8,
    patience: Duration,
    interrupt: &'a Interrupt,
    report: &'a Report,
    step: Step,
    effect: Effect,
}

/// What is waited for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// The node answers, and its memory is not busy.
    Ready,
    /// The program is in this state. A node that does not report it has taken the command.
    State(State),
    /// The program is in this state, which the node has to report, because it has not answered the command.
    Reported(State),
}

/// What an answer says about what is waited for.
enum Found {
    Wanted,
    NotYet(Failure),
}

impl<'a, B: Bus> Download<'a, B> {
    pub(super) const fn new(
        client: &'a mut Client<B>,
        target: Target<'a>,
        places: Places,
        args: &NodeProgramArgs,
        interrupt: &'a Interrupt,
        report: &'a Report,
    ) -> Self {
        Self {
            client,
            target,
            places,
            program: args.program,
            patience: args.patience,
            interrupt,
            report,
            step: Step::Stop,
            effect: Effect::None,
        }
    }

    /// Does all of it. What was reached in the end is in [`reported`](Self::reported).
    pub(super) fn carry_out(&mut self, data: &[u8]) -> Result<(), Failure> {
        let bus = |error| Failure::Access(self.places.control, AccessError::Bus(error));
        self.client.command(PRE_OPERATIONAL, self.target.id).map_err(bus)?;
        // A device that changes to its boot loader may start again, and leave the command without an answer.
        self.give(Step::Stop, Command::Stop, State::Stopped)?;
        self.wait_for(Wanted::Ready)?;
        self.give(Step::Clear, Command::Clear, State::Missing)?;
        self.wait_for(Wanted::Ready)?;
        self.load(data)?;
        self.check()?;
        self.give(Step::Start, Command::Start, State::Started)?;
        self.wait_for(Wanted::State(State::Started))
    }

    /// Gives a command. Where the answer is missing, the node has to report the state that follows.
    fn give(&mut self, step: Step, command: Command, after: State) -> Result<(), Failure> {
        self.begin(step)?;
        let control = self.places.control;
        match self.client.write(self.target.id, control, &[command.code()]) {
            Ok(()) => {
                self.effect = Effect::Done;
                Ok(())
            }
            Err(error) if error.is_of_entry() => Err(Failure::Access(control, error)),
            Err(error) => {
                self.effect = Effect::Unknown;
                let why = error.to_string();
                if matches!(error, AccessError::Bus(_)) {
                    return Err(Failure::Access(control, error));
                }
                self.wait_for(Wanted::Reported(after))?;
                self.effect = Effect::Done;
                let name = self.target.words().entry(control);
                self.report.note(&format!("{}{name}: {why}; read back, it is: {after}", self.target.mark()));
                Ok(())
            }
        }
    }

    /// Begins a step, unless the user wants an end.
    fn begin(&mut self, step: Step) -> Result<(), Failure> {
        (self.step, self.effect) = (step, Effect::None);
        if self.interrupt.is_wanted() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// Sends the program.
    fn load(&mut self, data: &[u8]) -> Result<(), Failure> {
        self.begin(Step::Load)?;
        let mut progress = Progress::new("loaded", "bytes", data.len(), self.report.audience());
        let (mut most, interrupt) = (0, self.interrupt);
        let reported = |sent: usize| {
            // Segments that were lost are sent again.
            if sent / PIECE > most / PIECE {
                progress.show(sent);
            }
            most = most.max(sent);
            if interrupt.is_wanted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let loaded = self.client.load(self.target.id, self.places.data, data, self.patience, reported);
        progress.clear();
        let Err(error) = loaded else { return Ok(()) };
        self.effect = match &error {
            _ if most == 0 => Effect::None,
            AccessError::Silent | AccessError::Bus(_) if most >= data.len() => Effect::Unknown,
            _ => Effect::Partly,
        };
        let is_ours = matches!(error, AccessError::Wrong(_)) && interrupt.is_wanted();
        Err(if is_ours { Failure::Interrupted } else { Failure::Access(self.places.data, error) })
    }

    /// Demands that the node has written the program, as far as it reports it.
    fn check(&mut self) -> Result<(), Failure> {
        self.effect = Effect::Done;
        self.wait_for(Wanted::Ready)?;
        let Some(flash) = self.places.flash else { return Ok(()) };
        match self.read(flash) {
            Ok(Some(number)) if FlashStatus(number).fault() != 0 => {
                Err(Failure::Flash(flash, FlashStatus(number)))
            }
            Ok(_) => Ok(()),
            Err(error) if error.is_of_entry() => {
                let name = self.target.words().entry(flash);
                self.report.note(&format!(
                    "{}{name} cannot be read ({error}): whether the program was written is not known",
                    self.target.mark()
                ));
                Ok(())
            }
            Err(error) => Err(Failure::Access(flash, error)),
        }
    }

    /// Asks the node again and again, until it says what is wanted or the time is over.
    fn wait_for(&mut self, wanted: Wanted) -> Result<(), Failure> {
        let asks = usize::try_from(self.patience.as_millis() / INTERVAL.as_millis()).unwrap_or(usize::MAX);
        let mut progress =
            Progress::new("asked", "times whether the node is ready", asks, self.report.audience());
        let until = Instant::now() + self.patience;
        let mut asked = 0;
        let ended = loop {
            let why = match self.ask(wanted) {
                Ok(Found::Wanted) => break Ok(()),
                Ok(Found::NotYet(why)) => why,
                Err(failure) => break Err(failure),
            };
            asked += 1;
            if asked >= asks || Instant::now() >= until {
                break Err(why);
            }
            if self.interrupt.is_wanted() {
                break Err(Failure::Interrupted);
            }
            progress.show(asked);
            // Frames that come meanwhile do not fill the adapter.
            if let Err(error) = self.client.booted(self.target.id, INTERVAL) {
                break Err(Failure::Access(self.places.control, AccessError::Bus(error)));
            }
        };
        progress.clear();
        ended
    }

    /// Asks the node once.
    fn ask(&mut self, wanted: Wanted) -> Result<Found, Failure> {
        let id = match wanted {
            Wanted::Ready => self.places.flash.unwrap_or(self.places.control),
            Wanted::State(_) | Wanted::Reported(_) => self.places.control,
        };
        let number = match self.read(id) {
            Ok(number) => number,
            Err(error @ AccessError::Bus(_)) => return Err(Failure::Access(id, error)),
            Err(error) if !error.is_of_entry() => return Ok(Found::NotYet(Failure::Access(id, error))),
            Err(error) => {
                return match wanted {
                    // It answers, and does not report it.
                    Wanted::Ready | Wanted::State(_) => Ok(Found::Wanted),
                    Wanted::Reported(_) => Err(Failure::Access(id, error)),
                };
            }
        };
        let is_busy = number.is_some_and(|number| FlashStatus(number).is_busy());
        Ok(match wanted {
            Wanted::Ready if is_busy && self.places.flash.is_some() => Found::NotYet(Failure::Busy(id)),
            Wanted::Ready => Found::Wanted,
            Wanted::State(wanted) | Wanted::Reported(wanted) => match number.and_then(state) {
                Some(reported) if reported == wanted => Found::Wanted,
                // The manufacturer knows more kinds of running, such as one on trial.
                Some(State::Other(MANUFACTURER..)) if wanted == State::Started => Found::Wanted,
                reported => Found::NotYet(Failure::State(id, reported)),
            },
        })
    }

    fn read(&mut self, id: EntryId) -> Result<Option<u32>, AccessError> {
        self.target.read(self.client, id).map(|bytes| little_endian(&bytes))
    }

    /// What is said of a failure: what failed, what the node has, and what it says now.
    pub(super) fn reported(&mut self, failure: &Failure) -> Diagnostic {
        let what = match self.effect {
            Effect::None | Effect::Unknown | Effect::Partly => self.step.verb(),
            Effect::Done => "go on with",
        };
        let message =
            format!("{}: cannot {what} program {}: {}", self.target.name(), self.program, failure.why());
        let diagnostic = Diagnostic::without_place(codes::ACCESS_FAILED, message)
            .note(left(self.step, self.effect))
            .help("give the command again, which begins anew; `--patience SECONDS` waits longer");
        match self.now(failure) {
            Some(now) => diagnostic.note(now),
            None => diagnostic,
        }
    }

    /// What the node says of the program now.
    fn now(&mut self, failure: &Failure) -> Option<String> {
        if matches!(failure, Failure::Access(_, AccessError::Bus(_))) {
            return None;
        }
        let places = self.places;
        let state = self.said(places.control, |number| state_in_words(state(number)));
        let flash = places.flash.map(|id| self.said(id, |number| FlashStatus(number).to_string()));
        Some(format!(
            "asked now, {}",
            [Some(state), flash].into_iter().flatten().collect::<Vec<_>>().join("; ")
        ))
    }

    /// `1F51h.1: stopped`.
    fn said(&mut self, id: EntryId, words: impl Fn(u32) -> String) -> String {
        let said = match self.read(id) {
            Ok(number) => number.map_or_else(|| "not a number".to_owned(), words),
            Err(error) => error.to_string(),
        };
        format!("{id}: {said}")
    }
}

/// The first value of 1F51h whose meaning is the manufacturer's.
const MANUFACTURER: u8 = 0x80;

/// The progress is shown after so many bytes.
const PIECE: usize = 256;
