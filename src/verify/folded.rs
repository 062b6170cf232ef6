//! Compares holes in programs for two different controls. The strokes of the two programs may differ if both programs
//! make the same hole.

use super::cut::{Cut, DEPTH, What, same};
use super::program::Program;
use super::strokes::Strokes;
use crate::nc::RunError;

/// X and Y, as bits.
const ACROSS: u8 = 0b11;

/// The largest number of strokes of a hole.
const MOST: usize = 100_000;

/// Whether a cut goes straight down or up.
pub(super) fn is_stroke(cut: &Cut, tolerance: f64) -> bool {
    matches!(cut.what, What::Line { .. }) && cut.unknown == 0 && same(&cut.from, &cut.end(), ACROSS, tolerance)
}

/// Whether both programs begin a hole with a stroke down from the same position and height.
pub(super) fn begin_alike(a: &Cut, b: &Cut, tolerance: f64) -> bool {
    let down = |cut: &Cut| is_stroke(cut, tolerance) && cut.end()[DEPTH] < cut.from[DEPTH] - tolerance;
    down(a) && down(b) && same(&a.from, &b.from, ACROSS | 1 << DEPTH, tolerance)
}

/// Whether two feeds or speeds differ by rounding only: by at most 0.1 %, or by at most 0.5 % if one is a whole number.
pub(super) fn rounded_alike(a: Option<f64>, b: Option<f64>) -> bool {
    const LAST_DIGITS: f64 = 0.001;
    const WHOLE: f64 = 0.005;
    let (Some(a), Some(b)) = (a, b) else { return false };
    let apart = (a - b).abs();
    let to_whole = |whole: f64, other: f64| whole.fract() == 0.0 && other.round() == whole;
    apart <= LAST_DIGITS * a.abs() || apart <= WHOLE * a.abs() && (to_whole(a, b) || to_whole(b, a))
}

/// The cuts down in a hole.
pub(super) struct Drilled {
    /// The depth of each cut.
    pub depths: Vec<f64>,
    /// The strokes that these cuts make.
    pub strokes: Strokes,
}

impl Drilled {
    fn cut(&mut self, cut: &Cut, tolerance: f64) {
        let to = cut.end()[DEPTH];
        self.strokes.comes_to(cut.from[DEPTH]);
        self.strokes.cut(to, tolerance, tolerance);
        if to < cut.from[DEPTH] {
            self.depths.push(to);
        }
    }
}

/// Runs the program to the end of its current hole. Returns its cuts down.
///
/// # Errors
/// The program can't be read, or its control refuses a block.
pub(super) fn hole(program: &mut Program<'_>, first: &Cut, tolerance: f64) -> Result<Drilled, RunError> {
    let mut drilled = Drilled { depths: Vec::new(), strokes: Strokes::over(first.from[DEPTH]) };
    drilled.cut(first, tolerance);
    program.take();
    loop {
        let Some(next) = program.run_to_cut()?.cloned() else { return Ok(drilled) };
        let over = |at| same(at, &first.from, ACROSS, tolerance);
        let stays = program.passage.rapids.iter().all(|rapid| rapid.unknown == 0 && over(&rapid.to));
        let is_same = (next.feed == first.feed || rounded_alike(next.feed, first.feed))
            && next.mode == first.mode
            && drilled.depths.len() < MOST;
        let here = is_stroke(&next, tolerance) && over(&next.from) && stays && is_same;
        if !here || !program.passage.stops.is_empty() || program.passage.changed() {
            return Ok(drilled);
        }
        program.passage.rapids.iter().for_each(|rapid| drilled.strokes.comes_to(rapid.to[DEPTH]));
        drilled.cut(&next, tolerance);
        program.take();
    }
}
