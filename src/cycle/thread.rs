//! Passes of a single-point thread.

use super::problem::Problem;
use crate::diag::Code;

/// Maximum number of passes of one thread. If a thread needs more passes, a decimal point in the job is probably
/// misplaced.
const MOST_PASSES: usize = 1000;

/// A last pass that would cut less than this fraction of the first pass is left out. The pass before this last pass
/// then cuts the remainder.
const REST: f64 = 1e-3;

/// The depth of each pass of a thread, measured from the crest, in the units of `depth`.
///
/// A last pass that would cut only a rounding error of the job is left out. The pass before this last pass then cuts to
/// the whole depth.
///
/// All passes have an equal chip area: pass k cuts to the depth `first * sqrt(k)`, and the last pass cuts to the whole
/// depth. `passes` sets the first cut to `depth / sqrt(passes)`; without `passes`, `first` is required. Each pass
/// except the last cuts at least `least`.
///
/// # Errors
/// Neither `passes` nor `first` is given, or there are too many passes.
///
/// ```
/// use postform::internals::cycle::thread_passes;
/// assert_eq!(thread_passes(4.0, None, Some(4), 0.0).map(|p| p.len()), Ok(4));
/// assert_eq!(thread_passes(4.0, Some(2.0), None, 0.0).map(|p| p.len()), Ok(4));
/// ```
pub fn thread_passes(depth: f64, first: Option<f64>, passes: Option<usize>, least: f64) -> Result<Vec<f64>, Problem> {
    let first = match (passes, first) {
        (Some(passes), _) if passes > 0 => depth / (passes as f64).sqrt(),
        (_, Some(first)) if first > 0.0 => first,
        _ => {
            return Err(Problem::new(
                Code::PC033,
                "the passes of the thread are missing",
                "give `passes` or `first_depth`",
            ));
        }
    };
    let mut list: Vec<f64> = Vec::new();
    loop {
        let reached = list.last().copied().unwrap_or(0.0);
        let next = (first * ((list.len() + 1) as f64).sqrt()).max(reached + least);
        if next >= depth - first * REST {
            list.push(depth);
            return Ok(list);
        }
        if list.len() == MOST_PASSES {
            let message = format!("more than {MOST_PASSES} passes in one thread");
            return Err(Problem::new(Code::PC028, message, "give a larger `first_depth` or `min_depth`"));
        }
        list.push(next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        /// Compares passes with the formula: no pass is too deep, no pass is less deep than the pass before it, and the
        /// last pass has the full depth.
        #[test]
        fn passes_follow_the_formula(depth in 0.01..5.0f64, first in 0.001..5.0f64, count in 1usize..60, by_count: bool, least in 0.0..0.02f64) {
            let passes = by_count.then_some(count);
            let first = if by_count { None } else { Some(first.max(depth / 25.0)) };
            let list = thread_passes(depth, first, passes, least).unwrap();
            prop_assert_eq!(*list.last().unwrap(), depth);
            prop_assert!(list.windows(2).all(|w| w[0] < w[1]));
            let cut = first.unwrap_or(depth / (count as f64).sqrt());
            for (k, pass) in list.iter().enumerate().take(list.len() - 1) {
                let formula = cut * ((k + 1) as f64).sqrt();
                prop_assert!(*pass >= formula - 1e-9 && *pass < depth);
                if least == 0.0 { prop_assert!((pass - formula).abs() < 1e-9); }
            }
            if by_count && least == 0.0 { prop_assert_eq!(list.len(), count); }
        }
    }

    /// A depth and a first pass with few digits, which give seven passes.
    #[test]
    fn what_the_digits_leave_is_no_pass() {
        assert_eq!(thread_passes(0.07937254, Some(0.03), None, 0.0).unwrap().len(), 7);
        assert_eq!(thread_passes(0.0794, Some(0.03), None, 0.0).unwrap().len(), 7);
        assert_eq!(thread_passes(0.08, Some(0.03), None, 0.0).unwrap().len(), 8);
    }

    #[test]
    fn a_thread_that_says_nothing_is_refused() {
        assert_eq!(thread_passes(1.0, None, None, 0.0).unwrap_err().code, Code::PC033);
        assert_eq!(thread_passes(1.0, Some(1e-6), None, 0.0).unwrap_err().code, Code::PC028);
    }
}
