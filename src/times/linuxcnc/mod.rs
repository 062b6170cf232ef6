//! Corners as in the trajectory planner of LinuxCNC 2.9. The rules come from measurements on LinuxCNC's simulator: 225
//! runs of 45 programs in each of the path modes. A corner between two moves is one of four kinds: tangent, a stop, an
//! overlap (a parabolic blend, at half the acceleration), or a small inserted arc.

mod joint;
mod piece;

use super::corner::PathMode;
use super::curve::Curve;
use super::leg::Leg;
use super::queue::Queue;
use super::rates::{Rates, Way};
use joint::{Joint, joint};
use piece::{End, Piece};

/// Maximum number of lines that are joined into one.
const MOST_JOINED: usize = 100;

/// The state between two moves.
#[derive(Clone, Debug)]
pub(super) struct Linuxcnc {
    mode: PathMode,
    /// The last move. The end of the last move depends on the next move.
    last: Option<Piece>,
    /// The square of the greatest speed at the beginning of the last move.
    most_entry: f64,
    /// A feed, and consecutive cuts at this feed that may be joined into one line.
    chain: (f64, Vec<Way>),
    /// Row of the last of these cuts in the times of blocks.
    chain_row: usize,
}

impl Linuxcnc {
    pub fn new(mode: PathMode) -> Linuxcnc {
        Linuxcnc { mode, last: None, most_entry: 0.0, chain: (0.0, Vec::new()), chain_row: 0 }
    }

    pub fn path_mode(&mut self, mode: PathMode, rates: &Rates, queue: &mut Queue) {
        self.end_chain(rates, queue);
        self.mode = mode;
    }

    /// Adds a line. `feed` is the feed of a cut in millimetres per second; `None`: a rapid.
    pub fn line(&mut self, way: &Way, feed: Option<f64>, rates: &Rates, queue: &mut Queue) {
        let tolerance = self.joined_within();
        let Some(feed) = feed.filter(|_| tolerance > 0.0 && way[3..] == [0.0; 3]) else {
            self.end_chain(rates, queue);
            return self.add(Piece::line(way, feed, rates), queue.row(), rates, queue);
        };
        if self.chain.0 != feed || !self.joins(way, tolerance) {
            self.end_chain(rates, queue);
        }
        self.chain.0 = feed;
        self.chain.1.push(*way);
        self.chain_row = queue.row();
    }

    /// Adds an arc at a feed in millimetres per second.
    pub fn arc(&mut self, curve: &Curve, feed: f64, rates: &Rates, queue: &mut Queue) {
        let sagitta = curve.radius() * (1.0 - (curve.sweep.abs() / 2.0).min(std::f64::consts::PI).cos());
        if curve.plane == [0, 1] && sagitta < self.joined_within() {
            // the arc becomes two lines that meet at its middle
            for half in curve.parts(2) {
                self.line(&half, Some(feed), rates, queue);
            }
            return;
        }
        self.end_chain(rates, queue);
        self.add(Piece::arc(curve, feed, rates), queue.row(), rates, queue);
    }

    /// Ends the moves, at a stop or at the end of the program. With G64, the last move is also calculated with half of
    /// the acceleration, like a move that blends into the next one.
    pub fn stop(&mut self, rates: &Rates, queue: &mut Queue) {
        self.end_chain(rates, queue);
        if let Some(mut last) = self.last.take() {
            last.is_last = true;
            last.end = if matches!(self.mode, PathMode::Blend(_)) { End::Overlap } else { End::Stop };
            queue.push(last.leg(self.most_entry));
        }
        self.most_entry = 0.0;
    }

    /// Greatest allowed distance of a joined line from the points that it replaces: P of G64.
    fn joined_within(&self) -> f64 {
        match self.mode {
            PathMode::Blend(tolerance) => tolerance.unwrap_or(0.0),
            _ => 0.0,
        }
    }

    /// Whether this cut can be joined to the waiting cuts. All points of the waiting cuts must be near the line to the
    /// end of this cut.
    fn joins(&self, way: &Way, tolerance: f64) -> bool {
        let chain = &self.chain.1;
        let add = |at: [f64; 3], way: &Way| std::array::from_fn(|axis| at[axis] + way[axis]);
        let end = chain.iter().fold([0.0; 3], add);
        let end: [f64; 3] = add(end, way);
        let square: f64 = end.iter().map(|part| part * part).sum();
        if chain.len() > MOST_JOINED || square == 0.0 {
            return false;
        }
        let mut at = [0.0; 3];
        chain.iter().all(|way| {
            at = add(at, way);
            let share = (0..3).map(|axis| at[axis] * end[axis]).sum::<f64>() / square;
            let share = share.clamp(0.0, 1.0);
            (0..3).map(|axis| (at[axis] - end[axis] * share).powi(2)).sum::<f64>() <= tolerance * tolerance
        })
    }

    fn end_chain(&mut self, rates: &Rates, queue: &mut Queue) {
        let (feed, chain) = std::mem::take(&mut self.chain);
        if chain.is_empty() {
            return;
        }
        let way: Way = std::array::from_fn(|axis| chain.iter().map(|way| way[axis]).sum());
        self.add(Piece::line(&way, Some(feed), rates), self.chain_row, rates, queue);
    }

    fn add(&mut self, piece: Option<Piece>, row: usize, rates: &Rates, queue: &mut Queue) {
        let Some(mut next) = piece else { return };
        next.row = row;
        let Some(mut last) = self.last.take() else {
            self.last = Some(next);
            return;
        };
        let entry = match joint(&mut last, &mut next, self.mode, rates) {
            Joint::Stop => {
                last.end = End::Stop;
                queue.push(last.leg(self.most_entry));
                0.0
            }
            Joint::Tangent(most) => {
                last.end = End::Tangent;
                queue.push(last.leg(self.most_entry));
                most * most
            }
            Joint::Overlap(seconds) => {
                queue.push(last.leg(self.most_entry));
                queue.overlap(seconds, last.is_cut, last.row);
                0.0
            }
            Joint::Arc { length, speed, acceleration, swallows } => {
                last.end = End::Tangent;
                let square = speed * speed;
                let most_entry = if swallows {
                    square.min(self.most_entry)
                } else {
                    queue.push(last.leg(self.most_entry));
                    square.min(last.speed() * last.speed())
                };
                queue.push(Leg {
                    length,
                    speed: square,
                    acceleration,
                    most_entry,
                    entry: 0.0,
                    is_cut: last.is_cut,
                    row: last.row,
                });
                square
            }
        };
        self.most_entry = entry.min(next.speed() * next.speed());
        self.last = Some(next);
    }
}
