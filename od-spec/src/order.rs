//! Sorting by one routine for all types: that of the standard library is compiled once more for each type and order, which
//! makes a large part of a program that has many.

use std::cmp::Ordering;

/// Sorts what is in a slice; what is equal keeps its order.
pub trait Arrange<T> {
    /// By an order of two items.
    fn arrange_by(&mut self, compare: impl Fn(&T, &T) -> Ordering);

    /// By a key of each item.
    fn arrange_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K) {
        self.arrange_by(|one, other| key(one).cmp(&key(other)));
    }
}

impl<T> Arrange<T> for [T] {
    fn arrange_by(&mut self, compare: impl Fn(&T, &T) -> Ordering) {
        if self.is_sorted_by(|one, other| compare(one, other).is_le()) {
            return;
        }
        let mut order: Vec<usize> = (0..self.len()).collect();
        sort(&mut order, &|one, other| compare(&self[one], &self[other]));
        // `order` has the old place of each new one: items go round in circles until each is at its own.
        for start in 0..order.len() {
            let mut place = start;
            loop {
                let from = std::mem::replace(&mut order[place], place);
                if from == start {
                    break;
                }
                self.swap(place, from);
                place = from;
            }
        }
    }
}

fn sort(places: &mut [usize], compare: &dyn Fn(usize, usize) -> Ordering) {
    places.sort_by(|one, other| compare(*one, *other));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_order_of_the_standard_library() {
        let mut random = 1_u64;
        for length in 0..200 {
            let mut items: Vec<(u64, usize)> = (0..length)
                .map(|at| {
                    random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    ((random >> 40) % 20, at)
                })
                .collect();
            let mut expected = items.clone();
            expected.sort_by_key(|(key, _)| *key);
            items.arrange_by_key(|(key, _)| *key);
            assert_eq!(items, expected);
        }
    }
}
