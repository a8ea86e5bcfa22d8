//! Independent work on several cores.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Returns the number of cores of this computer.
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Maps every item on one of `threads` threads, this one among them. The results are in the order of the items.
///
/// # Panics
/// If `map` panics.
pub fn map_on_threads<T: Sync, R: Send>(threads: usize, items: &[T], map: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut results = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { return results };
            results.push((index, map(item)));
        }
    };
    let mut results = thread::scope(|scope| {
        // A thread that cannot be started leaves its part to the others.
        let helpers = (1..threads).filter_map(|_| thread::Builder::new().spawn_scoped(scope, work).ok());
        let helpers: Vec<_> = helpers.collect();
        let mut results = work();
        for helper in helpers {
            results.extend(helper.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        results
    });
    results.sort_unstable_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_order() {
        let items: Vec<u64> = (0..1000).collect();
        let squares: Vec<u64> = items.iter().map(|item| item * item).collect();
        for threads in [0, 1, 3] {
            assert_eq!(map_on_threads(threads, &items, |item| item * item), squares);
            assert!(map_on_threads(threads, &[], |item: &u64| *item).is_empty());
        }
    }
}
