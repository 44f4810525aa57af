//! Boot-up message, heartbeat producer and node guarding of a slave (CiA 301 9.2.6.2 and 9.2.4).

use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Duration, Instant, earlier};
use crate::bus::frame::Frame;
use crate::bus::node_id::NodeId;
use crate::nmt::{ERROR_CONTROL, State};

/// What a guarded node learns about its master (life guarding).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Guarding {
    /// The master has not asked within the life time (100Ch × 100Dh).
    Lost,
    /// It asks again.
    Resumed,
}

/// Shows other nodes that the node is alive. A heartbeat (1017h not 0) takes precedence over guarding: there is never
/// both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ErrorControl {
    /// When the last message with the state was sent; none while 1017h is 0.
    beat: Option<Instant>,
    toggle: u8,
    life: Life,
}

/// Guarding by a master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Life {
    /// No master has asked yet.
    #[default]
    Unguarded,
    /// It asked then.
    Guarded(Instant),
    /// It has not asked for too long.
    Lost,
}

impl ErrorControl {
    /// Before the boot-up message.
    #[must_use]
    pub const fn new() -> Self {
        Self { beat: None, toggle: 0, life: Life::Unguarded }
    }

    /// The boot-up message, which ends the initialisation. It counts as the first heartbeat; the toggle bit of guarding
    /// begins with 0.
    pub fn boot_up<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, node: NodeId, now: Instant) -> Frame {
        *self = Self::new();
        self.beat = (!heartbeat_time(dictionary).is_zero()).then_some(now);
        message(node, 0)
    }

    /// A heartbeat, if it is time for one. A time written to 1017h counts at once: a heartbeat that was off begins.
    pub fn poll<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        node: NodeId,
        state: State,
        now: Instant,
    ) -> Option<Frame> {
        if state == State::Initialising {
            return None;
        }
        let period = heartbeat_time(dictionary);
        if period.is_zero() {
            self.beat = None;
            return None;
        }
        let sent = match self.beat.map(|sent| sent + period) {
            None => now,
            Some(due) if now < due => return None,
            // The rhythm is kept, but beats that were missed altogether are not made up for.
            Some(due) => {
                if now < due + period {
                    due
                } else {
                    now
                }
            }
        };
        // With the heartbeat, guarding ends.
        self.life = Life::Unguarded;
        self.beat = Some(sent);
        Some(message(node, state.code()))
    }

    /// The answer to a master that guards the node, and whether its guarding resumes. A heartbeat leaves the question
    /// without an answer.
    pub fn guard<'t, D: Dictionary<'t>>(
        &mut self,
        frame: &Frame,
        dictionary: &D,
        node: NodeId,
        state: State,
        now: Instant,
    ) -> Option<(Frame, Option<Guarding>)> {
        let is_question = frame.id() == node.identifier(ERROR_CONTROL) && frame.bytes().is_none();
        if !is_question || state == State::Initialising || !heartbeat_time(dictionary).is_zero() {
            return None;
        }
        let resumed = (self.life == Life::Lost).then_some(Guarding::Resumed);
        self.life = Life::Guarded(now);
        let answer = message(node, self.toggle | state.code());
        self.toggle ^= 0x80;
        Some((answer, resumed))
    }

    /// The master is guarding from its next question on, as after a time in which no master could ask.
    pub const fn forget_master(&mut self) {
        self.life = Life::Unguarded;
    }

    /// Whether the master's questions have stopped: said once. A life time that was set to 0 since ends the guarding, also one that was lost.
    pub fn check_life<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) -> Option<Guarding> {
        if life_time(dictionary).is_zero() && self.is_lost() {
            self.forget_master();
        }
        if now < self.life_ends(dictionary)? {
            return None;
        }
        self.life = Life::Lost;
        Some(Guarding::Lost)
    }

    /// Whether the master's questions have stopped, as [`check_life`](Self::check_life) saw it last.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.life == Life::Lost
    }

    /// When there is something to do next, unless a parameter changes before.
    pub fn next_deadline<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        let period = heartbeat_time(dictionary);
        // Written since the last poll: the heartbeat begins with the next one.
        let due = self.beat.map_or(Instant::ZERO, |sent| sent + period);
        let beat = (!period.is_zero()).then_some(due);
        earlier(beat, self.life_ends(dictionary))
    }

    /// When the master has to have asked again (CiA 301 9.6.3, 100Ch and 100Dh): from its first question on.
    fn life_ends<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        let life_time = life_time(dictionary);
        match self.life {
            Life::Guarded(asked) if !life_time.is_zero() && heartbeat_time(dictionary).is_zero() => {
                Some(asked + life_time)
            }
            Life::Guarded(_) | Life::Unguarded | Life::Lost => None,
        }
    }
}

/// 100Ch × 100Dh; no time is off.
fn life_time<'t, D: Dictionary<'t>>(dictionary: &D) -> Duration {
    let parameters = Parameters::of(dictionary);
    Duration::from_millis(parameters.word(0x100C, 0).into()).times(parameters.byte(0x100D, 0).into())
}

/// 1017h; no time is off.
fn heartbeat_time<'t, D: Dictionary<'t>>(dictionary: &D) -> Duration {
    Duration::from_millis(Parameters::of(dictionary).word(0x1017, 0).into())
}

fn message(node: NodeId, state: u8) -> Frame {
    let id = node.identifier(ERROR_CONTROL);
    Frame::data(id, &[state]).unwrap_or(Frame::full(id, [0; 8]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::parameters::set;
    use crate::access::test_table::{TestDictionary, dictionary, value};

    fn node() -> NodeId {
        NodeId::new(5).expect("a node-ID")
    }

    fn at(millis: u64) -> Instant {
        Instant::from_millis(millis)
    }

    fn device(heartbeat: u32, guard_time: u32, factor: u32) -> TestDictionary {
        dictionary(&[
            value(0x100C, 0, 2, guard_time),
            value(0x100D, 0, 1, factor),
            value(0x1017, 0, 2, heartbeat),
        ])
    }

    fn question() -> Frame {
        Frame::remote(node().identifier(0x700), 1).expect("a length")
    }

    #[test]
    fn the_boot_up_message_is_the_first_heartbeat() {
        let device = device(100, 0, 0);
        let mut control = ErrorControl::new();
        let boot_up = control.boot_up(&device, node(), at(7));
        assert_eq!((boot_up.id().get(), boot_up.bytes()), (0x705, Some(&[0][..])));
        assert_eq!(control.next_deadline(&device), Some(at(107)));
        assert_eq!(control.poll(&device, node(), State::PreOperational, at(106)), None);
        let beat = control.poll(&device, node(), State::PreOperational, at(107)).expect("a heartbeat");
        assert_eq!((beat.id().get(), beat.bytes()), (0x705, Some(&[127][..])));
        // Late: the rhythm is kept.
        assert!(control.poll(&device, node(), State::Operational, at(230)).is_some());
        assert_eq!(control.next_deadline(&device), Some(at(307)));
        // Very late: one heartbeat, and a new rhythm.
        assert!(control.poll(&device, node(), State::Stopped, at(1000)).is_some());
        assert_eq!(control.poll(&device, node(), State::Stopped, at(1000)), None);
        assert_eq!(control.next_deadline(&device), Some(at(1100)));
    }

    #[test]
    fn a_heartbeat_time_counts_as_soon_as_it_is_written() {
        let mut device = device(0, 0, 0);
        let mut control = ErrorControl::new();
        control.boot_up(&device, node(), at(0));
        assert_eq!(control.poll(&device, node(), State::PreOperational, at(5000)), None);
        assert_eq!(control.next_deadline(&device), None);
        set(&mut device, 0x1017, 0, 1000);
        assert!(control.next_deadline(&device).is_some_and(|due| due <= at(5000)));
        assert!(control.poll(&device, node(), State::PreOperational, at(5000)).is_some());
        set(&mut device, 0x1017, 0, 10);
        assert_eq!(control.poll(&device, node(), State::PreOperational, at(5009)), None);
        assert!(control.poll(&device, node(), State::PreOperational, at(5010)).is_some());
        set(&mut device, 0x1017, 0, 0);
        assert_eq!(control.poll(&device, node(), State::PreOperational, at(9000)), None);
        assert_eq!(control.next_deadline(&device), None);
    }

    #[test]
    fn nothing_is_sent_before_the_boot_up_message() {
        let device = device(1, 1, 1);
        let mut control = ErrorControl::new();
        assert_eq!(control.poll(&device, node(), State::Initialising, at(100)), None);
        assert!(control.guard(&question(), &device, node(), State::Initialising, at(100)).is_none());
    }

    #[test]
    fn guarding_answers_with_a_toggle_bit_that_only_a_boot_up_resets() {
        let device = device(0, 0, 0);
        let mut control = ErrorControl::new();
        let states = |control: &mut ErrorControl, state| {
            let (answer, event) =
                control.guard(&question(), &device, node(), state, at(1)).expect("an answer");
            assert_eq!((answer.id().get(), event), (0x705, None));
            answer.bytes().and_then(<[u8]>::first).copied()
        };
        control.boot_up(&device, node(), at(0));
        assert_eq!(states(&mut control, State::PreOperational), Some(0x7F));
        assert_eq!(states(&mut control, State::Operational), Some(0x85));
        assert_eq!(states(&mut control, State::Stopped), Some(0x04));
        assert_eq!(states(&mut control, State::PreOperational), Some(0xFF));
        assert_eq!(states(&mut control, State::PreOperational), Some(0x7F));
        control.boot_up(&device, node(), at(0));
        assert_eq!(states(&mut control, State::PreOperational), Some(0x7F));
        let others =
            Frame::remote(NodeId::new(6).expect("a node-ID").identifier(0x700), 1).expect("a length");
        assert!(control.guard(&others, &device, node(), State::Stopped, at(1)).is_none());
        let data = Frame::data(node().identifier(0x700), &[5]).expect("a byte");
        assert!(control.guard(&data, &device, node(), State::Stopped, at(1)).is_none());
    }

    #[test]
    fn a_master_that_stops_asking_is_noticed_once_and_after_its_first_question_only() {
        let device = device(0, 100, 3);
        let mut control = ErrorControl::new();
        control.boot_up(&device, node(), at(0));
        assert_eq!(control.check_life(&device, at(100_000)), None);
        control.guard(&question(), &device, node(), State::Operational, at(100_000));
        assert_eq!(control.next_deadline(&device), Some(at(100_300)));
        assert_eq!(control.check_life(&device, at(100_299)), None);
        assert_eq!(control.check_life(&device, at(100_300)), Some(Guarding::Lost));
        assert_eq!(control.check_life(&device, at(100_400)), None);
        let answer = control.guard(&question(), &device, node(), State::Operational, at(100_500));
        assert_eq!(answer.and_then(|(_, event)| event), Some(Guarding::Resumed));
        assert_eq!(control.check_life(&device, at(100_800)), Some(Guarding::Lost));
    }

    #[test]
    fn a_heartbeat_takes_precedence_over_guarding() {
        let mut device = device(0, 100, 3);
        let mut control = ErrorControl::new();
        control.boot_up(&device, node(), at(0));
        assert!(control.guard(&question(), &device, node(), State::PreOperational, at(0)).is_some());
        set(&mut device, 0x1017, 0, 50);
        assert!(control.guard(&question(), &device, node(), State::PreOperational, at(10)).is_none());
        assert!(control.poll(&device, node(), State::PreOperational, at(10)).is_some());
        assert_eq!(control.check_life(&device, at(100_000)), None);
        set(&mut device, 0x1017, 0, 0);
        assert_eq!(control.check_life(&device, at(100_000)), None, "no question since the heartbeat");
    }
}
