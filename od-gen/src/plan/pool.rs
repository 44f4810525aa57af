//! Lists that name each item by its position.

use std::collections::BTreeMap;
use std::ops::Deref;

use super::NONE;

/// Different items, each with its position. There are never more of them than rows.
pub struct Pool<T> {
    list: Vec<T>,
    positions: BTreeMap<T, u16>,
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self { list: Vec::new(), positions: BTreeMap::new() }
    }
}

impl<T: Ord + Clone> Pool<T> {
    /// The position of an item, which is added if it is not there.
    pub fn position(&mut self, item: T) -> u16 {
        if let Some(at) = self.positions.get(&item) {
            return *at;
        }
        let at = u16::try_from(self.list.len()).unwrap_or(NONE);
        self.positions.insert(item.clone(), at);
        self.list.push(item);
        at
    }
}

impl<T> Deref for Pool<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.list
    }
}
