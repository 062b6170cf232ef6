//! The path of the tool's centre while the control compensates its radius (G41, G42).

use crate::toolpath::Side;

use super::sweep::Shape;

/// At sharper corners (1 plus the cosine of the change of direction) the control moves around the corner and not to a point.
const SHARP: f64 = 0.25;

/// A straight piece of the path of a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Start, X Y Z in millimetres.
    pub from: [f64; 3],
    /// End.
    pub to: [f64; 3],
    /// The tool.
    pub shape: Shape,
    /// The side on which the tool is beside the programmed path; `None`: its centre is on the path.
    pub side: Option<Side>,
}

impl Piece {
    /// The unit vector to the left in X and Y; `None` for a piece without motion in X and Y.
    fn left(&self) -> Option<[f64; 2]> {
        let [dx, dy] = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let length = dx.hypot(dy);
        (length > 0.0).then(|| [-dy / length, dx / length])
    }
}

/// Moves the path beside the program's. A compensated piece is passed on when the next one is known, because its end depends
/// on both.
#[derive(Clone, Debug, Default)]
pub struct Centre {
    /// The last compensated piece as programmed, and the start of its centre.
    waits: Option<(Piece, [f64; 3])>,
}

impl Centre {
    /// Takes the next piece and returns the pieces whose path is known, in their order.
    pub fn takes(&mut self, piece: Piece) -> [Option<Piece>; 2] {
        let begins_there = self.waits.is_some_and(|(last, _)| last.to == piece.from);
        let before = self.ends(Some(&piece).filter(|piece| begins_there && piece.side.is_some()));
        let from = before.filter(|_| begins_there).map_or(piece.from, |before| before.to);
        if piece.side.is_none() {
            // a retract goes straight up from where the tool is
            let to = if piece.left().is_none() { [from[0], from[1], piece.to[2]] } else { piece.to };
            return [before, Some(Piece { from, to, ..piece })];
        }
        self.waits = Some((piece, from));
        [before, None]
    }

    /// The piece that waits for the next one, which is `next` if it is compensated, too.
    pub fn ends(&mut self, next: Option<&Piece>) -> Option<Piece> {
        let (piece, from) = self.waits.take()?;
        let sign = if piece.side == Some(Side::Left) { 1.0 } else { -1.0 };
        let (before, after) = (piece.left(), next.and_then(Piece::left));
        let mut to = piece.to;
        if let (Some(a), Some(b)) = (before.or(after), after.or(before)) {
            let along = 1.0 + a[0] * b[0] + a[1] * b[1];
            let aside = if along > SHARP { [(a[0] + b[0]) / along, (a[1] + b[1]) / along] } else { b };
            to[0] += sign * piece.shape.radius * aside[0];
            to[1] += sign * piece.shape.radius * aside[1];
        }
        Some(Piece { from, to, ..piece })
    }
}
