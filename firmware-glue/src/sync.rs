//! SYNC producer: the beat that synchronous PDOs follow (CiA 301 9.6.3, 1005h, 1006h, 1019h).

use crate::access::communication::cob_id::{PRODUCER, can_id};
use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Duration, Instant};
use crate::bus::frame::{CanId, Frame};

/// Sends SYNC while bit 30 of 1005h is set and 1006h has a period. The first goes at once, whenever it begins; counters (1019h) begin with 1.
#[derive(Debug, Clone, Copy, Default)]
pub struct SyncProducer {
    settings: Option<Settings>,
    /// When the last one was due.
    sent: Option<Instant>,
    /// The counter of the last one.
    counter: u8,
}

/// A SYNC that is to be sent: PDOs of the sender follow it, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sync {
    /// What is sent.
    pub frame: Frame,
    /// Its counter, if it has one.
    pub counter: Option<u8>,
}

/// The parameters of a producer that is switched on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Settings {
    id: CanId,
    period: Duration,
    /// The highest counter; 0 for none.
    highest: u8,
}

impl Settings {
    fn of<'t, D: Dictionary<'t>>(dictionary: &D) -> Option<Self> {
        let parameters = Parameters::of(dictionary);
        let cob_id = parameters.number(0x1005, 0).filter(|cob_id| cob_id & PRODUCER != 0)?;
        let period = Duration::from_micros(parameters.number(0x1006, 0)?.into());
        let highest = parameters.byte(0x1019, 0);
        if period.is_zero() { None } else { Some(Self { id: can_id(cob_id)?, period, highest }) }
    }
}

impl SyncProducer {
    /// Nothing was sent yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { settings: None, sent: None, counter: 0 }
    }

    /// The node is in a state without SYNC: afterwards, it begins anew.
    pub const fn stop(&mut self) {
        *self = Self::new();
    }

    /// The SYNC that is to be sent now.
    pub fn poll<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) -> Option<Sync> {
        let settings = Settings::of(dictionary);
        if self.settings != settings {
            // The counter goes on with another period: those who count do not begin anew.
            let goes_on = self.settings.map(|old| old.highest) == settings.map(|new| new.highest);
            *self = Self { settings, sent: None, counter: if goes_on { self.counter } else { 0 } };
        }
        let Settings { id, period, highest } = settings?;
        let due = self.sent.map_or(now, |sent| sent + period);
        if now < due {
            return None;
        }
        // The beat is kept, but what was missed altogether is not made up for.
        self.sent = Some(if now < due + period { due } else { now });
        if highest == 0 {
            return Frame::data(id, &[]).map(|frame| Sync { frame, counter: None });
        }
        self.counter = if self.counter >= highest { 1 } else { self.counter + 1 };
        Frame::data(id, &[self.counter]).map(|frame| Sync { frame, counter: Some(self.counter) })
    }

    /// When the next one is due.
    pub fn next_deadline<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        let settings = Settings::of(dictionary)?;
        if self.settings != Some(settings) {
            return Some(Instant::ZERO);
        }
        Some(self.sent.map_or(Instant::ZERO, |sent| sent + settings.period))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec;
    use std::vec::Vec;

    use super::*;
    use crate::access::parameters::set;
    use crate::access::test_table::{TestDictionary, dictionary, value};

    fn device(cob_id: u32, period: u32, highest: u32) -> TestDictionary {
        dictionary(&[value(0x1005, 0, 4, cob_id), value(0x1006, 0, 4, period), value(0x1019, 0, 1, highest)])
    }

    fn at(micros: u64) -> Instant {
        Instant::from_micros(micros)
    }

    /// Identifier, data and time of what is sent, asked every 100 µs.
    fn sent(
        producer: &mut SyncProducer,
        device: &TestDictionary,
        times: core::ops::Range<u64>,
    ) -> Vec<(u64, u16, Vec<u8>)> {
        let times = times.step_by(100);
        let frames = times.filter_map(|now| Some((now, producer.poll(device, at(now))?.frame)));
        frames.map(|(now, frame)| (now, frame.id().get(), frame.bytes().expect("data").to_vec())).collect()
    }

    #[test]
    fn it_beats_while_bit_30_is_set() {
        let (mut device, mut producer) = (device(0x80, 1000, 0), SyncProducer::new());
        assert_eq!((sent(&mut producer, &device, 0..5000), producer.next_deadline(&device)), (vec![], None));
        set(&mut device, 0x1005, 0, 0x4000_0081);
        assert_eq!(producer.next_deadline(&device), Some(Instant::ZERO));
        let beat = [(5000, 0x81, vec![]), (6000, 0x81, vec![]), (7000, 0x81, vec![])];
        assert_eq!(sent(&mut producer, &device, 5000..7500), beat);
        assert_eq!(producer.next_deadline(&device), Some(at(8000)));
        set(&mut device, 0x1006, 0, 0);
        assert_eq!(
            (sent(&mut producer, &device, 7500..9000), producer.next_deadline(&device)),
            (vec![], None)
        );
        set(&mut device, 0x1006, 0, 500);
        assert_eq!(sent(&mut producer, &device, 9000..9600), [(9000, 0x81, vec![]), (9500, 0x81, vec![])]);
    }

    #[test]
    fn the_beat_is_kept_and_what_was_missed_is_not_made_up_for() {
        let (device, mut producer) = (device(0x4000_0080, 1000, 0), SyncProducer::new());
        for (now, is_due) in [
            (0, true),
            (1700, true),
            (1900, false),
            (2000, true),
            (9500, true),
            (9600, false),
            (10_500, true),
        ] {
            assert_eq!(producer.poll(&device, at(now)).is_some(), is_due, "{now}");
        }
    }

    #[test]
    fn counters_run_from_1_to_1019h() {
        let (mut device, mut producer) = (device(0x4000_0080, 1000, 3), SyncProducer::new());
        let counters = |sent: Vec<(u64, u16, Vec<u8>)>| {
            sent.into_iter().flat_map(|(_, _, data)| data).collect::<Vec<_>>()
        };
        assert_eq!(counters(sent(&mut producer, &device, 0..4500)), [1, 2, 3, 1, 2]);
        set(&mut device, 0x1006, 0, 2000);
        assert_eq!(counters(sent(&mut producer, &device, 4500..9000)), [3, 1, 2], "another period");
        producer.stop();
        assert_eq!(counters(sent(&mut producer, &device, 9000..9100)), [1]);
        assert_eq!(producer.poll(&device, at(11_000)).and_then(|sync| sync.counter), Some(2));
    }

    #[test]
    fn identifiers_of_29_bits_and_missing_periods_send_nothing() {
        let mut producer = SyncProducer::new();
        assert_eq!(sent(&mut producer, &device(0x6000_0080, 1000, 0), 0..5000), []);
        assert_eq!(sent(&mut producer, &dictionary(&[value(0x1005, 0, 4, 0x4000_0080)]), 0..5000), []);
    }
}
