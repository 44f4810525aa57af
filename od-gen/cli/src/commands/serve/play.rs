//! What happens to virtual nodes as time goes on: the commands of a script, and values on their way.

use std::collections::BTreeMap;
use std::time::Duration;

use firmware_glue::EntryId;
use firmware_glue::emcy::Raised;
use od_bus::runtime::VirtualNode;

use super::course::{Course, Now};
use super::script::{Act, Step};

/// How often a value that changes with time gets another one, in microseconds.
const TICK: u64 = 10_000;

/// Carries out commands. The caller gives the time, in microseconds.
#[derive(Default)]
pub(super) struct Play {
    /// Until when the script waits.
    pause: Option<u64>,
    /// What changes with time, by the position of its node.
    courses: BTreeMap<(usize, EntryId), Going>,
}

/// A value on its way, since when, and what it is by now.
struct Going {
    course: Course,
    since: u64,
    last: Vec<u8>,
}

/// What a node does not do: its position, and why.
pub(super) type Refused = (usize, String);

impl Play {
    /// Does what is due: the next commands up to one that waits, and the values that change with time.
    pub(super) fn go_on(
        &mut self,
        now: u64,
        nodes: &mut [VirtualNode<'_>],
        next: impl FnMut() -> Option<Step>,
    ) -> Vec<Refused> {
        let mut refused = self.act(now, nodes, next);
        refused.extend(self.go(now, nodes));
        refused
    }

    /// When it has something to do next, unless a command comes before.
    pub(super) fn next_deadline(&self, now: u64) -> Option<u64> {
        let tick = (!self.courses.is_empty()).then_some(now + TICK);
        self.pause.into_iter().chain(tick).min()
    }

    /// Does what the script says, up to where it waits.
    fn act(
        &mut self,
        now: u64,
        nodes: &mut [VirtualNode<'_>],
        mut next: impl FnMut() -> Option<Step>,
    ) -> Vec<Refused> {
        let mut refused = Vec::new();
        if self.pause.is_some_and(|until| now < until) {
            return refused;
        }
        self.pause = None;
        while let Some(step) = next() {
            let (at, act) = match step {
                Step::Wait(time) => {
                    let time = u64::try_from(time.as_micros()).unwrap_or(u64::MAX);
                    self.pause = Some(now.saturating_add(time));
                    break;
                }
                Step::Act { at, act } => (at, act),
            };
            let Some(node) = nodes.get_mut(at) else { continue };
            let why = match act {
                Act::Fault(emergency) => match node.raise(emergency, now) {
                    Raised::New => None,
                    Raised::Present => Some(format!("error {:04X}h is present already", emergency.code())),
                    Raised::NotKept => {
                        Some(format!("error {:04X}h is one too many: it cannot be cleared", emergency.code()))
                    }
                },
                Act::Clear(code) => {
                    (!node.clear(code, now)).then(|| format!("error {code:04X}h is not present"))
                }
                Act::Set { entry, value, name } => {
                    self.courses.remove(&(at, entry));
                    set(node, entry, &value, &name, now)
                }
                Act::Go(course) => {
                    let going = Going { course, since: now, last: Vec::new() };
                    self.courses.insert((at, going.course.entry), going);
                    None
                }
                Act::Stop(entry) => {
                    self.courses.remove(&(at, entry));
                    None
                }
            };
            refused.extend(why.map(|why| (at, why)));
        }
        refused
    }

    /// Lets values go on that change with time; one that the entry cannot have ends its course.
    fn go(&mut self, now: u64, nodes: &mut [VirtualNode<'_>]) -> Vec<Refused> {
        let mut refused = Vec::new();
        self.courses.retain(|(at, entry), going| {
            let Some(node) = nodes.get_mut(*at) else { return true };
            let passed = Duration::from_micros(now.saturating_sub(going.since));
            let (value, is_there) = match going.course.at(passed) {
                Now::Going(value) => (value, false),
                Now::There(value) => (value, true),
            };
            let mut why = None;
            if value != going.last {
                why = set(node, *entry, &value, &going.course.name, now);
                going.last = value;
            }
            let is_over = is_there || why.is_some();
            refused.extend(why.map(|why| (*at, why)));
            !is_over
        });
        refused
    }
}

/// Gives an entry a value; returns why it cannot have it.
fn set(node: &mut VirtualNode<'_>, entry: EntryId, value: &[u8], name: &str, now: u64) -> Option<String> {
    let refusal = node.set(entry, value, now).err()?;
    Some(format!("{name} cannot be set to this: {refusal}"))
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use od_bus::runtime::{self, Bus, LiveDictionary};
    use od_spec::diag::Diagnostics;
    use od_spec::model::{DataType, Value};
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use super::super::course::Shape;
    use super::*;

    /// A lamp that sends its brightness with every change.
    const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, emergency]}
objects:
  0x2000: {name: brightness, type: unsigned8, access: rw, pdo: transmit, default: 80, max: 100}
pdos:
  lamp:
    transmit: {1: {map: [brightness]}}
";
    const BRIGHTNESS: EntryId = EntryId { index: 0x2000, sub: 0 };
    const MILLISECOND: u64 = 1000;

    /// What a node has sent and refused; the time only goes on when the test says so.
    struct Stage<'t> {
        bus: Bus<'t>,
        play: Play,
        steps: VecDeque<Step>,
        now: u64,
        refused: Vec<Refused>,
    }

    impl Stage<'_> {
        /// Carries out commands at once, and plays so many milliseconds of time; returns the brightnesses that were sent.
        fn play(&mut self, steps: Vec<Step>, milliseconds: u64) -> Vec<u8> {
            self.steps.extend(steps);
            let mut sent = Vec::new();
            for _ in 0..=milliseconds {
                let refused = self.play.go_on(self.now, self.bus.nodes_mut(), || self.steps.pop_front());
                self.refused.extend(refused);
                let frames = self.bus.poll(self.now);
                sent.extend(
                    frames
                        .iter()
                        .filter(|frame| frame.id().get() == 0x185)
                        .map(|frame| frame.bytes().unwrap()[0]),
                );
                self.now += MILLISECOND;
            }
            sent
        }
    }

    fn go(shape: Shape, from: u8, to: u8, time: Duration) -> Step {
        let ends = (&Value::Integer(from.into()), &Value::Integer(to.into()));
        let name = "2000h (brightness)".to_owned();
        let course = Course::new(BRIGHTNESS, name, DataType::Unsigned8, shape, ends, time).unwrap();
        Step::Act { at: 0, act: Act::Go(course) }
    }

    fn set_to(value: u8) -> Step {
        let name = "2000h (brightness)".to_owned();
        Step::Act { at: 0, act: Act::Set { entry: BRIGHTNESS, value: vec![value], name } }
    }

    fn on_stage(test: impl FnOnce(&mut Stage<'_>)) {
        let mut sources = SourceMap::new();
        let root = sources.add("lamp.od.yaml", LAMP);
        let compiled = compile(&mut sources, root, &mut NoFiles);
        let system = compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
        let device = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
        let lists = device.lists();
        let table = lists.table().unwrap();
        let node = VirtualNode::new(5, LiveDictionary::new(&device, &table, 5).unwrap()).unwrap();
        let mut bus = Bus::new(vec![node]);
        bus.poll(0);
        let start =
            firmware_glue::frame::CanId::new(0).and_then(|id| firmware_glue::frame::Frame::data(id, &[1, 5]));
        bus.take(start.unwrap(), 0);
        let mut stage =
            Stage { bus, play: Play::default(), steps: VecDeque::new(), now: 0, refused: Vec::new() };
        // What it has when it starts.
        stage.play(Vec::new(), 1);
        test(&mut stage);
    }

    #[test]
    fn values_run_and_stop() {
        on_stage(|stage| {
            // Each step comes once and in its order, and the last one is the end.
            let ramp = go(Shape::Ramp, 0, 5, Duration::from_millis(300));
            assert_eq!(stage.play(vec![ramp], 299), [0, 1, 2, 3, 4]);
            assert_eq!(stage.play(Vec::new(), 1000), [5]);
            let triangle = go(Shape::Triangle, 10, 12, Duration::from_millis(200));
            assert_eq!(stage.play(vec![triangle], 249), [10, 11, 12, 11, 10, 11]);
            // It stays where it stops.
            assert_eq!(stage.play(vec![Step::Act { at: 0, act: Act::Stop(BRIGHTNESS) }], 1000), [0u8; 0]);
            assert_eq!(stage.play(vec![set_to(99)], 1000), [99]);
            // What is set ends a course.
            let sine = go(Shape::Sine, 0, 100, Duration::from_millis(500));
            assert_eq!(stage.play(vec![sine, set_to(98)], 1000), [98]);
            assert_eq!(stage.refused, []);
        });
    }

    #[test]
    fn a_value_that_the_entry_cannot_have_ends_its_course_and_is_refused_once() {
        on_stage(|stage| {
            let ramp = go(Shape::Ramp, 100, 200, Duration::from_secs(1));
            assert_eq!(stage.play(vec![ramp], 1000), [100]);
            let refused = "2000h (brightness) cannot be set to this: ";
            assert!(
                matches!(&stage.refused[..], [(0, why)] if why.starts_with(refused)),
                "{:?}",
                stage.refused
            );
            assert_eq!(stage.play(vec![set_to(97)], 10), [97]);
        });
    }

    #[test]
    fn a_script_waits_and_a_course_begins_with_its_first_value() {
        on_stage(|stage| {
            let ramp = go(Shape::Ramp, 20, 10, Duration::from_millis(10));
            let wait = Step::Wait(Duration::from_millis(100));
            assert_eq!(stage.play(vec![set_to(1), wait, set_to(2), ramp], 98), [1]);
            assert_eq!(stage.play.next_deadline(stage.now), Some(stage.now + MILLISECOND));
            assert_eq!(stage.play(Vec::new(), 100), [20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10]);
            assert_eq!(stage.play.next_deadline(stage.now), None);
        });
    }
}
