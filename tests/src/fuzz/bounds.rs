//! How much memory and work a step may take for a text of some size.

use super::Complaint;

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
    pub(super) base: u64,
    /// For each byte more.
    pub(super) per_byte: u64,
}

impl Bound {
    const fn of(self, size: u64) -> u64 {
        self.base + self.per_byte * size
    }
}

impl Bounds {
    /// What is too much, if anything is.
    pub(super) fn complaint(&self, size: usize, used: Used) -> Option<Complaint> {
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
        let bounds = Bounds {
            step: "model",
            peak: Bound { base: 100, per_byte: 2 },
            total: Bound { base: 100, per_byte: 9 },
        };
        let said = |peak, total| bounds.complaint(50, Used { peak, total }).map(|one| one.what);
        assert_eq!(said(200, 550), None);
        assert_eq!(
            said(201, 551).as_deref(),
            Some("201 bytes at one time, more than 100 and 2 for each of 50")
        );
        assert_eq!(said(200, 551).as_deref(), Some("551 bytes in all, more than 100 and 9 for each of 50"));
    }
}
