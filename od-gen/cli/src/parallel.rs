//! Work on all cores, results in the order of what there was to do.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Does the work on each item. Whenever an item is finished, `each` gets the number of finished ones, and the results that are
/// next in order. One core works without a thread of its own, which not every system has.
pub(crate) fn in_order<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
    mut each: impl FnMut(usize, Vec<R>),
) {
    let workers = thread::available_parallelism().map_or(1, NonZero::get).min(items.len());
    if workers <= 1 {
        return (1..).zip(items).for_each(|(finished, item)| each(finished, vec![work(item)]));
    }
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, work, next) = (sender.clone(), &work, &next);
            scope.spawn(move || {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(at) else { return };
                    if sender.send((at, work(item))).is_err() {
                        return;
                    }
                }
            });
        }
        // The channel ends with the last worker.
        drop(sender);
        let (mut waiting, mut given) = (BTreeMap::new(), 0);
        for (finished, (at, result)) in (1..).zip(receiver) {
            waiting.insert(at, result);
            let mut ready = Vec::new();
            while let Some(result) = waiting.remove(&given) {
                ready.push(result);
                given += 1;
            }
            each(finished, ready);
        }
    });
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let items: Vec<u64> = (0..20).collect();
        let (mut results, mut counts) = (Vec::new(), Vec::new());
        // The first ones take longest.
        let work = |item: &u64| {
            thread::sleep(Duration::from_millis(20 - item));
            item * 2
        };
        in_order(&items, work, |finished, ready| {
            counts.push(finished);
            results.extend(ready);
        });
        assert_eq!(results, items.iter().map(|item| item * 2).collect::<Vec<_>>());
        assert_eq!(counts, (1..=20).collect::<Vec<_>>());
        in_order(&[], |(): &()| (), |_, _| unreachable!());
    }

    #[test]
    fn items_are_worked_on_at_the_same_time() {
        let workers = thread::available_parallelism().map_or(1, NonZero::get);
        // No thread passes before all have come.
        let barrier = Barrier::new(workers);
        let mut results = 0;
        in_order(&vec![(); workers], |()| barrier.wait(), |_, ready| results += ready.len());
        assert_eq!(results, workers);
    }
}
