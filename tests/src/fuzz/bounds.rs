//! How much memory and work a step may take for a text of some size.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::Complaint;
use crate::foreign;

/// What a step has used of the heap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Used {
    /// Most bytes at one time.
    pub peak: u64,
    /// All bytes that were asked for, one after the other: a measure of the work that is the same in every run.
    pub total: u64,
}

/// Runs a step and says what it used. Who links an allocator that counts can have one; without it, nothing is used.
pub type Meter = fn(&mut dyn FnMut()) -> Used;

/// The bounds of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) step: &'static str,
    pub(super) peak: Bound,
    pub(super) total: Bound,
}

/// A number of bytes that grows with the size of a text, and not faster.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    /// For an empty text.
    base: u64,
    /// For each byte more.
    per_byte: u64,
}

impl Bound {
    pub(super) const fn new(base: u64, per_byte: u64) -> Self {
        Self { base, per_byte }
    }

    const fn of(self, size: u64) -> u64 {
        self.base + self.per_byte * size
    }
}

/// What a step gives, or that it panics.
pub(super) fn caught<T>(step: impl FnOnce() -> T) -> Result<T, String> {
    let told = |panic: Box<dyn Any + Send>| format!("panicked: {}", foreign::message(panic.as_ref()));
    catch_unwind(AssertUnwindSafe(step)).map_err(told)
}

impl Bounds {
    /// Takes a step with a text of some size; complains if it panics, or takes too much.
    pub(super) fn of_step(&self, meter: Meter, size: usize, step: impl Fn()) -> Option<Complaint> {
        let mut outcome = Ok(());
        // A panic must not leave the meter running.
        let used = meter(&mut || outcome = caught(&step));
        match outcome {
            Ok(()) => self.complaint(size, used),
            Err(what) => Some(Complaint { step: self.step.to_owned(), what }),
        }
    }

    /// What is too much, if anything is.
    fn complaint(&self, size: usize, used: Used) -> Option<Complaint> {
        let size = u64::try_from(size).unwrap_or(u64::MAX);
        let amounts = [("at one time", self.peak, used.peak), ("in all", self.total, used.total)];
        let (which, bound, bytes) = amounts.into_iter().find(|(_, bound, bytes)| *bytes > bound.of(size))?;
        let Bound { base, per_byte } = bound;
        Some(Complaint {
            step: format!("{} memory", self.step),
            what: format!("{bytes} bytes {which}, more than {base} and {per_byte} for each of {size}"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_above_a_bound_is_told() {
        let bounds = Bounds { step: "model", peak: Bound::new(100, 2), total: Bound::new(100, 9) };
        let said = |peak, total| bounds.complaint(50, Used { peak, total }).map(|one| one.what);
        assert_eq!(said(200, 550), None);
        assert_eq!(
            said(201, 551).as_deref(),
            Some("201 bytes at one time, more than 100 and 2 for each of 50")
        );
        assert_eq!(said(200, 551).as_deref(), Some("551 bytes in all, more than 100 and 9 for each of 50"));
    }

    #[test]
    fn a_panic_is_told() {
        let bounds = Bounds { step: "model", peak: Bound::new(0, 0), total: Bound::new(0, 0) };
        let meter: Meter = |step| {
            step();
            Used { peak: 1, total: 1 }
        };
        let said = |step: fn()| bounds.of_step(meter, 5, step).map(|one| one.what);
        assert_eq!(said(|| panic!("out of {}", "range")).as_deref(), Some("panicked: out of range"));
        assert_eq!(said(|| ()).as_deref(), Some("1 bytes at one time, more than 0 and 0 for each of 5"));
    }
}
