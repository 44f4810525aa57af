//! A place for what a firmware makes as it starts.

/// A place in a `static` for what a firmware makes as it starts: a dictionary, a node. It is zero until then, and so costs no flash.
/// An `Option` may mark that it is empty by any bytes of the type, and then lies in flash with all of its size, to be copied at start-up.
///
/// ```
/// use firmware_glue::Late;
///
/// let mut place = Late::Empty;
/// assert_eq!(place.made(), None);
/// place.make(5);
/// assert_eq!(place.made(), Some(&mut 5));
/// ```
#[derive(Debug)]
#[repr(u8)]
pub enum Late<T> {
    /// Nothing was made yet.
    Empty,
    /// It was made.
    Made(T),
}

impl<T> Late<T> {
    /// Puts it there.
    pub fn make(&mut self, value: T) {
        *self = Self::Made(value);
    }

    /// What was made.
    pub const fn made(&mut self) -> Option<&mut T> {
        match self {
            Self::Made(value) => Some(value),
            Self::Empty => None,
        }
    }
}
