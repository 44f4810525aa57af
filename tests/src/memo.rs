//! What many tests of one program look at is made once.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

use crate::Failure;

/// Values by key, each made when it is asked for first, and kept to the end of the program.
#[derive(Debug)]
pub struct Memo<K, V: 'static>(Mutex<BTreeMap<K, &'static OnceLock<Result<V, String>>>>);

impl<K: Ord, V: 'static> Memo<K, V> {
    /// Nothing yet.
    pub const fn empty() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The value of a key. A caller that asks for it while it is made waits; one that asks for another does not.
    ///
    /// # Errors
    /// It could not be made.
    pub fn get(&self, key: K, make: impl FnOnce() -> Result<V, Failure>) -> Result<&'static V, Failure> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = *known.entry(key).or_insert_with(|| Box::leak(Box::default()));
        drop(known);
        let made = place.get_or_init(|| make().map_err(|error| error.to_string()));
        made.as_ref().map_err(|error| error.as_str().into())
    }
}
