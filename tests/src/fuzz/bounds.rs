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

/// Runs a step and says what it used. A program that links an allocator that counts can have one; without it, nothing
/// is used.
pub type Meter = fn(&mut dyn FnMut()) -> Used;

/// The bounds of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) step: &'static str,
    pub(super) peak: Bound,
    pub(super) total: Bound,
}

/// A number of bytes that grows with the size of a text and of what it describes, and not faster.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    /// For an empty text.
    base: u64,
    /// For each byte more.
    per_byte: u64,
    /// For each object or entry that the text describes. A line of a specification may represent many: a run, or an
    /// object that each of its devices has.
    per_described: u64,
}

/// How much a text is, and describes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub(super) bytes: usize,
    /// Objects and entries that the bytes do not bound; 0 where they do.
    pub(super) described: usize,
}

impl Size {
    /// A text that cannot describe more than is in it.
    pub(super) const fn bytes(bytes: usize) -> Self {
        Self { bytes, described: 0 }
    }
}

impl Bound {
    pub(super) const fn new(base: u64, per_byte: u64) -> Self {
        Self { base, per_byte, per_described: 0 }
    }

    pub(super) const fn and_for_each_described(self, per_described: u64) -> Self {
        Self { per_described, ..self }
    }

    const fn of(self, size: Size) -> u64 {
        self.base + self.per_byte * size.bytes as u64 + self.per_described * size.described as u64
    }
}

/// What a step gives, or that it panics.
pub(super) fn caught<T>(step: impl FnOnce() -> T) -> Result<T, String> {
    let reported = |panic: Box<dyn Any + Send>| format!("panicked: {}", foreign::message(panic.as_ref()));
    catch_unwind(AssertUnwindSafe(step)).map_err(reported)
}

impl Bounds {
    /// Takes a step that gives the size of its text; complains if it panics, or takes too much.
    pub(super) fn of_step(&self, meter: Meter, step: impl Fn() -> Size) -> Option<Complaint> {
        let mut outcome = Ok(Size::bytes(0));
        // A panic must not leave the meter running.
        let used = meter(&mut || outcome = caught(&step));
        match outcome {
            Ok(size) => self.complaint(size, used),
            Err(what) => Some(Complaint { step: self.step.to_owned(), what }),
        }
    }

    /// What is too much, if anything is.
    fn complaint(&self, size: Size, used: Used) -> Option<Complaint> {
        let amounts = [("at one time", self.peak, used.peak), ("in all", self.total, used.total)];
        let (which, bound, bytes) = amounts.into_iter().find(|(_, bound, bytes)| *bytes > bound.of(size))?;
        let Bound { base, per_byte, per_described } = bound;
        let of_described = match per_described {
            0 => String::new(),
            _ => format!(", and {per_described} for each of {} objects and entries", size.described),
        };
        let what = format!(
            "{bytes} bytes {which}, more than {base} and {per_byte} for each of {}{of_described}",
            size.bytes
        );
        Some(Complaint { step: format!("{} memory", self.step), what })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_above_a_bound_is_reported() {
        let bounds = Bounds { step: "model", peak: Bound::new(100, 2), total: Bound::new(100, 9) };
        let said = |peak, total| bounds.complaint(Size::bytes(50), Used { peak, total }).map(|one| one.what);
        assert_eq!(said(200, 550), None);
        assert_eq!(
            said(201, 551).as_deref(),
            Some("201 bytes at one time, more than 100 and 2 for each of 50")
        );
        assert_eq!(said(200, 551).as_deref(), Some("551 bytes in all, more than 100 and 9 for each of 50"));
    }

    #[test]
    fn what_is_described_has_room_of_its_own() {
        let peak = Bound::new(100, 2).and_for_each_described(30);
        let bounds = Bounds { step: "model", peak, total: Bound::new(1000, 0) };
        let size = Size { bytes: 50, described: 3 };
        let said = |peak| bounds.complaint(size, Used { peak, total: 0 }).map(|one| one.what);
        assert_eq!(said(290), None);
        let reported = "291 bytes at one time, more than 100 and 2 for each of 50, and 30 for each of 3 objects and entries";
        assert_eq!(said(291).as_deref(), Some(reported));
    }

    #[test]
    fn a_panic_is_reported() {
        let bounds = Bounds { step: "model", peak: Bound::new(0, 0), total: Bound::new(0, 0) };
        let meter: Meter = |step| {
            step();
            Used { peak: 1, total: 1 }
        };
        let said = |step: fn() -> Size| bounds.of_step(meter, step).map(|one| one.what);
        assert_eq!(said(|| panic!("out of {}", "range")).as_deref(), Some("panicked: out of range"));
        assert_eq!(
            said(|| Size::bytes(5)).as_deref(),
            Some("1 bytes at one time, more than 0 and 0 for each of 5")
        );
    }
}
