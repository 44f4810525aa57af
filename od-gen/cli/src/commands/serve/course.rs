//! Values that change with time: ramps and waves.

use std::f64::consts::TAU;
use std::time::Duration;

use firmware_glue::EntryId;
use od_spec::model::{DataType, Family, Value};

/// How a value goes from one to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// Once, and then it stays there.
    Ramp,
    /// There and back along straight lines, again and again.
    Triangle,
    /// There and back along a sine, again and again.
    Sine,
}

impl Shape {
    /// The word of a shape.
    pub(super) const ALL: [(&'static str, Self); 3] =
        [("ramp", Self::Ramp), ("triangle", Self::Triangle), ("sine", Self::Sine)];
}

/// A value that changes with time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    /// The entry.
    pub(super) entry: EntryId,
    /// What a person calls it.
    pub(super) name: String,
    data_type: DataType,
    shape: Shape,
    ends: Ends,
    /// Of a ramp all of it, of a wave there and back.
    time: Duration,
}

/// Where it begins and where it goes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Ends {
    Integers(i128, i128),
    Reals(f64, f64),
}

/// What a value is at a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Now {
    /// On its way.
    Going(Vec<u8>),
    /// Where it stays.
    There(Vec<u8>),
}

/// No course takes longer: what numbers are multiplied with has its limit.
pub(super) const LONGEST: Duration = Duration::from_secs(1_000_000);

impl Course {
    /// From one value to another within a time, which is not 0 and not longer than [`LONGEST`]; `None` where there is nothing between the values.
    pub(super) fn new(
        entry: EntryId,
        name: String,
        data_type: DataType,
        shape: Shape,
        (from, to): (&Value, &Value),
        time: Duration,
    ) -> Option<Self> {
        let ends = match data_type.family() {
            Family::Signed | Family::Unsigned => Ends::Integers(from.integer()?, to.integer()?),
            Family::Real => Ends::Reals(from.real()?.number(), to.real()?.number()),
            Family::Boolean
            | Family::VisibleString
            | Family::UnicodeString
            | Family::OctetString
            | Family::Time
            | Family::Domain => return None,
        };
        Some(Self { entry, name, data_type, shape, ends, time })
    }

    /// The bytes of the value so long after the beginning: of a ramp the last step that was reached, of a wave the nearest one.
    pub(super) fn at(&self, passed: Duration) -> Now {
        match self.shape {
            Shape::Ramp if passed >= self.time => Now::There(self.reached(1, 1)),
            Shape::Ramp => Now::Going(self.reached(passed.as_micros(), self.time.as_micros())),
            Shape::Triangle => {
                let (whole, at) = (self.time.as_micros(), self.within(passed));
                Now::Going(self.nearest((2 * at).min(2 * (whole - at)), whole))
            }
            Shape::Sine => {
                #[expect(
                    clippy::cast_precision_loss,
                    reason = "a part of a whole, as exactly as a number has it"
                )]
                let part = self.within(passed) as f64 / self.time.as_micros() as f64;
                Now::Going(self.part((1.0 - (TAU * part).cos()) / 2.0))
            }
        }
    }

    /// Microseconds since a wave began anew.
    const fn within(&self, passed: Duration) -> u128 {
        passed.as_micros() % self.time.as_micros()
    }

    /// The value at a fraction of the way, or the step before it.
    fn reached(&self, done: u128, whole: u128) -> Vec<u8> {
        self.step(done, whole, 0)
    }

    /// The value at a fraction of the way, or the nearest step.
    fn nearest(&self, done: u128, whole: u128) -> Vec<u8> {
        self.step(done, whole, 1)
    }

    /// The value at a fraction of the way, moved on by so many halves of a step.
    fn step(&self, done: u128, whole: u128, halves: i128) -> Vec<u8> {
        match self.ends {
            Ends::Integers(from, to) => {
                let (done, whole) = (i128::try_from(done).unwrap_or(0), i128::try_from(whole).unwrap_or(1));
                let way = to - from;
                self.bytes(from + (2 * way * done + halves * way.signum() * whole) / (2 * whole))
            }
            #[expect(
                clippy::cast_precision_loss,
                reason = "a part of a whole, as exactly as a number has it"
            )]
            Ends::Reals(..) => self.part(done as f64 / whole as f64),
        }
    }

    /// The value at a part of the way, from 0 to 1.
    fn part(&self, part: f64) -> Vec<u8> {
        match self.ends {
            #[expect(
                clippy::cast_precision_loss,
                clippy::cast_possible_truncation,
                reason = "a sine has no exact values"
            )]
            Ends::Integers(from, to) => {
                let step = ((to - from) as f64 * part).round() as i128;
                self.bytes((from + step).clamp(from.min(to), from.max(to)))
            }
            Ends::Reals(from, to) => {
                let number = from.mul_add(1.0 - part, to * part);
                #[expect(clippy::cast_possible_truncation, reason = "the nearest that the type has")]
                match self.data_type {
                    DataType::Real32 => (number as f32).to_le_bytes().to_vec(),
                    _ => number.to_le_bytes().to_vec(),
                }
            }
        }
    }

    fn bytes(&self, raw: i128) -> Vec<u8> {
        // It lies between two values of the type.
        Value::Integer(raw).bytes_for(self.data_type, 0).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENTRY: EntryId = EntryId { index: 0x2000, sub: 0 };

    fn course(data_type: DataType, shape: Shape, from: i128, to: i128) -> Course {
        let (from, to) = (Value::Integer(from), Value::Integer(to));
        Course::new(ENTRY, String::new(), data_type, shape, (&from, &to), Duration::from_secs(2)).unwrap()
    }

    fn raw(now: Now) -> i128 {
        let (Now::Going(bytes) | Now::There(bytes)) = now;
        Value::from_bytes(DataType::Integer16, &bytes).unwrap().integer().unwrap()
    }

    #[test]
    fn a_ramp_is_straight_and_ends() {
        let up = course(DataType::Integer16, Shape::Ramp, -100, 100);
        let values = [0, 9, 10, 1000, 1999].map(|at| raw(up.at(Duration::from_millis(at))));
        // A step is taken when it is reached, and not before.
        assert_eq!(values, [-100, -100, -99, 0, 99]);
        assert_eq!(up.at(Duration::from_secs(2)), Now::There(vec![100, 0]));
        assert_eq!(up.at(Duration::from_secs(200)), Now::There(vec![100, 0]));
        let down = course(DataType::Integer16, Shape::Ramp, 100, -100);
        assert_eq!([0, 9, 10, 1999].map(|at| raw(down.at(Duration::from_millis(at)))), [100, 100, 99, -99]);
    }

    #[test]
    fn waves_go_there_and_back() {
        for shape in [Shape::Triangle, Shape::Sine] {
            let wave = course(DataType::Integer16, shape, 10, 1010);
            let values = [0, 500, 1000, 1500, 2000, 3000].map(|at| raw(wave.at(Duration::from_millis(at))));
            assert_eq!(values, [10, 510, 1010, 510, 10, 1010], "{shape:?}");
        }
    }

    #[test]
    fn the_widest_types_do_not_overflow() {
        let (from, to) = (Value::Integer(i64::MIN.into()), Value::Integer(i64::MAX.into()));
        for shape in [Shape::Ramp, Shape::Triangle, Shape::Sine] {
            let wide =
                Course::new(ENTRY, String::new(), DataType::Integer64, shape, (&from, &to), LONGEST).unwrap();
            for passed in [Duration::ZERO, LONGEST / 2, LONGEST * 2 / 3, Duration::MAX] {
                let (Now::Going(bytes) | Now::There(bytes)) = wide.at(passed);
                assert_eq!(bytes.len(), 8, "{shape:?} {passed:?}");
            }
        }
    }

    #[test]
    fn reals_have_everything_between_and_texts_nothing() {
        let one = |text| Value::Real(od_spec::model::Real::read(text, DataType::Real32).unwrap());
        let time = Duration::from_secs(2);
        let course = |from: &Value, to: &Value, data_type| {
            Course::new(ENTRY, String::new(), data_type, Shape::Ramp, (from, to), time)
        };
        let ramp = course(&one("1.5"), &one("2.5"), DataType::Real32).unwrap();
        assert_eq!(ramp.at(Duration::from_secs(1)), Now::Going(2.0f32.to_le_bytes().to_vec()));
        let (a, b) = (Value::Text("a".to_owned()), Value::Text("b".to_owned()));
        assert_eq!(course(&a, &b, DataType::VisibleString), None);
        assert_eq!(course(&Value::Integer(0), &Value::Integer(1), DataType::Boolean), None);
    }
}
