//! Applies the same work to each of many items, on several threads.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// The results of the work, in the order of the items.
pub fn each<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    each_on(None, items, work)
}

/// Like `each`, on this number of threads; `None`: one thread per core.
pub fn each_on<T: Send, R: Send>(threads: Option<NonZeroUsize>, items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let mut all = Vec::with_capacity(items.len());
    each_in_order(threads, items, work, |result| all.push(result));
    all
}

/// Like `each_on`. `take` gets the results one at a time and in order, each as soon as it is ready.
pub fn each_in_order<T: Send, R: Send>(
    threads: Option<NonZeroUsize>,
    items: Vec<T>,
    work: impl Fn(T) -> R + Sync,
    take: impl FnMut(R) + Send,
) {
    let threads = threads.or(thread::available_parallelism().ok()).map_or(1, usize::from).min(items.len());
    let waiting = Mutex::new(items.into_iter().enumerate());
    let done = Mutex::new((0, BTreeMap::new(), take));
    let run = || loop {
        let next = waiting.lock().unwrap_or_else(PoisonError::into_inner).next();
        let Some((at, item)) = next else { break };
        let result = work(item);
        let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
        let (taken, results, take) = &mut *done;
        results.insert(at, result);
        while let Some(result) = results.remove(taken) {
            *taken += 1;
            take(result);
        }
    };
    let run = &run;
    thread::scope(|scope| {
        for _ in 1..threads {
            // if no further thread is available, the existing threads do the work
            if thread::Builder::new().spawn_scoped(scope, run).is_err() {
                break;
            }
        }
        run();
    });
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_come_in_the_order_of_their_items() {
        assert_eq!(each((0..1000).collect(), |n: i32| n * 2), (0..2000).step_by(2).collect::<Vec<_>>());
        assert!(each(Vec::<i32>::new(), |n| n).is_empty());
    }

    #[test]
    fn results_are_taken_in_order_while_others_are_made() {
        let taken = Mutex::new(Vec::new());
        let work = |n: u64| {
            thread::sleep(Duration::from_millis(n % 3));
            n
        };
        each_in_order(NonZeroUsize::new(3), (0..100).collect(), work, |n| taken.lock().unwrap().push(n));
        assert_eq!(taken.into_inner().unwrap(), (0..100).collect::<Vec<_>>());
    }
}
