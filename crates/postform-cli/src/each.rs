//! The same work for each of many things, on as many threads as there are to be had.

use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// What the work makes of each item, in their order.
pub fn each<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    each_on(None, items, work)
}

/// The same on so many threads; `None`: one a core.
pub fn each_on<T: Send, R: Send>(threads: Option<NonZeroUsize>, items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let threads = threads.or(thread::available_parallelism().ok()).map_or(1, usize::from).min(items.len());
    let waiting = Mutex::new(items.into_iter().enumerate());
    let done = Mutex::new(Vec::new());
    let run = || loop {
        let next = waiting.lock().unwrap_or_else(PoisonError::into_inner).next();
        let Some((at, item)) = next else { break };
        let result = work(item);
        done.lock().unwrap_or_else(PoisonError::into_inner).push((at, result));
    };
    let run = &run;
    thread::scope(|scope| {
        for _ in 1..threads {
            // where no thread is to be had, the others do the work
            if thread::Builder::new().spawn_scoped(scope, run).is_err() {
                break;
            }
        }
        run();
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::each;

    #[test]
    fn results_come_in_the_order_of_their_items() {
        assert_eq!(each((0..1000).collect(), |n: i32| n * 2), (0..2000).step_by(2).collect::<Vec<_>>());
        assert!(each(Vec::<i32>::new(), |n| n).is_empty());
    }
}
