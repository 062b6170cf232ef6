//! Converts moves to points of a continuous line. Arcs become straight pieces.

use super::frame::on_part;
use super::{Kind, Picture};
use crate::nc::{Turn, axes_of, sweep};
use crate::toolpath::Direction;

/// Largest angle of a piece of an arc, in radians: 3 degrees. A piece then deviates from the arc by 1/3000 of the radius.
const FINEST: f64 = std::f64::consts::PI / 60.0;
/// Largest angle of a piece, in radians, if the arc is small in the picture.
const COARSEST: f64 = std::f64::consts::PI / 6.0;
/// Greatest deviation of a piece from the arc, as a fraction of the size of the picture.
const ERROR: f64 = 1.0 / 4000.0;
/// Maximum number of pieces of one arc. A helix may have a million turns.
const MOST_PIECES: f64 = 20_000.0;

/// A straight piece of a move. Each piece begins at the end of the previous piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// End of the piece, X Y Z in the picture's units.
    pub to: [f64; 3],
    /// The move that contains the piece, as an index into [`Picture::moves`].
    pub of: u32,
}

/// The moves of a picture as points.
#[derive(Clone, Debug, Default)]
pub struct Strips {
    /// Start of the first piece.
    pub start: [f64; 3],
    /// The pieces, in the order of the run.
    pub pieces: Vec<Piece>,
    /// Least and greatest X Y Z of all known positions.
    pub extents: [[f64; 3]; 2],
    /// The height at which moves with an unknown Z are drawn.
    pub ceiling: f64,
}

impl Strips {
    /// The longest side of the box around all points; 1 for an empty picture.
    pub fn size(&self) -> f64 {
        let [least, greatest] = self.extents;
        let size = (0..3).map(|axis| greatest[axis] - least[axis]).fold(0.0, f64::max);
        if size > 0.0 { size } else { 1.0 }
    }
}

impl Picture {
    /// Converts the moves to points. A move with an unknown Z is drawn above everything else. If X or Y of the end of a
    /// move is unknown, the point does not move along that axis.
    pub fn strips(&self) -> Strips {
        let [least, greatest] = self.ends();
        let size = (0..3).map(|axis| greatest[axis] - least[axis]).fold(0.0, f64::max);
        let ceiling = greatest[2] + size * 0.1;
        let first = |axis: usize| {
            let known = self.moves.iter().map(|found| found.to[axis]).find(|value| value.is_finite());
            known.unwrap_or(0.0)
        };
        let start = [first(0), first(1), ceiling];
        let mut strips =
            Strips { start, pieces: Vec::with_capacity(self.moves.len()), extents: [least, greatest], ceiling };
        let mut at = start;
        let mut turns = self.turned.iter().peekable();
        let mut angles = [0.0; 3];
        for (of, found) in (0..).zip(&self.moves) {
            let to = [0, 1, 2].map(|axis| match (found.to[axis], axis) {
                (value, _) if value.is_finite() => value,
                (_, 2) => ceiling,
                _ => at[axis],
            });
            let first = strips.pieces.len();
            if let (Kind::Arc, Some(turn)) = (found.kind, self.arcs.get(found.arc as usize)) {
                round(at, to, turn, size * ERROR, &mut |to| strips.pieces.push(Piece { to, of }));
            }
            if let Some(turned) = turns.next_if(|turned| turned.from == of) {
                if found.kind != Kind::Arc {
                    turning(at, to, angles, turned.to, &mut |to| strips.pieces.push(Piece { to, of }));
                }
                strips.pieces.push(Piece { to, of });
                let pieces = &mut strips.pieces[first..];
                let count = pieces.len() as f64;
                for (i, piece) in (1_u32..).zip(pieces) {
                    piece.to = on_part(piece.to, between(angles, turned.to, f64::from(i) / count));
                }
                angles = turned.to;
            } else {
                strips.pieces.push(Piece { to, of });
                if angles != [0.0; 3] {
                    strips.pieces[first..].iter_mut().for_each(|piece| piece.to = on_part(piece.to, angles));
                }
            }
            at = to;
        }
        self.measure(&mut strips);
        strips
    }

    /// Computes the box around all known positions.
    fn measure(&self, strips: &mut Strips) {
        if !self.turned.is_empty() {
            strips.extents = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        }
        for piece in &strips.pieces {
            let known = &self.moves[piece.of as usize].to;
            // if rotary axes turn, a position on the part is unknown as soon as one coordinate is unknown
            let all = self.turned.is_empty() || known.iter().all(|value| value.is_finite());
            for axis in (0..3).filter(|&axis| all && known[axis].is_finite()) {
                strips.extents[0][axis] = strips.extents[0][axis].min(piece.to[axis]);
                strips.extents[1][axis] = strips.extents[1][axis].max(piece.to[axis]);
            }
        }
        if !strips.extents[0][0].is_finite() {
            strips.extents = self.ends();
        }
    }

    /// The box around the ends of all moves.
    fn ends(&self) -> [[f64; 3]; 2] {
        let mut extents = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for found in &self.moves {
            for (axis, &value) in found.to.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                extents[0][axis] = extents[0][axis].min(value);
                extents[1][axis] = extents[1][axis].max(value);
            }
        }
        for axis in (0..3).filter(|&axis| !extents[0][axis].is_finite()).collect::<Vec<_>>() {
            (extents[0][axis], extents[1][axis]) = (0.0, 0.0);
        }
        extents
    }
}

fn between<const N: usize>(from: [f64; N], to: [f64; N], share: f64) -> [f64; N] {
    std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

/// Adds the points of a straight move during which rotary axes turn. On the part, this move is a curve.
fn turning(from: [f64; 3], to: [f64; 3], angles: [f64; 3], turned: [f64; 3], push: &mut impl FnMut([f64; 3])) {
    let most = (0..3).map(|axis| (turned[axis] - angles[axis]).abs()).fold(0.0, f64::max).to_radians();
    let pieces = (most / FINEST).ceil().clamp(1.0, MOST_PIECES);
    for i in 1..pieces as u32 {
        push(between(from, to, f64::from(i) / pieces));
    }
}

/// Adds the points of an arc between its ends, without the end.
pub fn round(from: [f64; 3], to: [f64; 3], turn: &Turn, error: f64, push: &mut impl FnMut([f64; 3])) {
    let [first, second, across] = axes_of(turn.plane);
    let wide = |at: [f64; 3]| [at[0], at[1], at[2], 0.0, 0.0, 0.0];
    let swept = sweep(&wide(from), &Turn { to: wide(to), ..*turn });
    let (dx, dy) = (from[first] - turn.center[first], from[second] - turn.center[second]);
    let radius = dx.hypot(dy);
    let end = (to[first] - turn.center[first]).hypot(to[second] - turn.center[second]);
    let step = (2.0 * (1.0 - error / radius).clamp(-1.0, 1.0).acos()).clamp(FINEST, COARSEST);
    let pieces = (swept / step).ceil().clamp(1.0, MOST_PIECES);
    let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
    let begin = dy.atan2(dx);
    for i in 1..pieces as u32 {
        let share = f64::from(i) / pieces;
        let angle = begin + sign * swept * share;
        // the radii at the two ends may differ within a tolerance
        let radius = radius + (end - radius) * share;
        let mut at = from;
        at[first] = turn.center[first] + radius * angle.cos();
        at[second] = turn.center[second] + radius * angle.sin();
        at[across] = from[across] + (to[across] - from[across]) * share;
        push(at);
    }
}
