//! A dictionary for firmware that has no lock of its own.

use core::cell::RefCell;

use critical_section::Mutex;

/// A dictionary that interrupts and threads share. Every access is one short critical section.
#[derive(Debug)]
pub struct Shared<D>(Mutex<RefCell<D>>);

impl<D> Shared<D> {
    /// Wraps a dictionary.
    pub const fn new(dictionary: D) -> Self {
        Self(Mutex::new(RefCell::new(dictionary)))
    }

    /// Works on the dictionary while nothing else can: what is read is consistent, what is written appears at once.
    /// Keep it short; interrupts wait.
    ///
    /// # Panics
    /// When called from inside itself.
    pub fn with<R>(&self, work: impl FnOnce(&mut D) -> R) -> R {
        critical_section::with(|section| work(&mut self.0.borrow_ref_mut(section)))
    }

    /// A copy of the dictionary, taken at one moment.
    ///
    /// # Panics
    /// When called from inside [`with`](Self::with).
    pub fn snapshot(&self) -> D
    where
        D: Clone,
    {
        self.with(|dictionary| dictionary.clone())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn several_values_change_at_once() {
        static PAIR: Shared<(u32, u32)> = Shared::new((0, 0));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..1000 {
                        PAIR.with(|pair| {
                            pair.0 += 1;
                            pair.1 += 1;
                        });
                        let (left, right) = PAIR.snapshot();
                        assert_eq!(left, right);
                    }
                });
            }
        });
        assert_eq!(PAIR.snapshot(), (4000, 4000));
    }
}
