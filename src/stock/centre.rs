//! Calculates the path of the tool's centre while the control compensates the tool radius (G41, G42).

use crate::toolpath::Side;

use super::sweep::Shape;

/// A corner is sharp if 1 plus the cosine of the change of direction is at most this value. The tool moves around a
/// sharp corner, and not to the point where the offset paths meet.
const SHARP: f64 = 0.25;

/// A straight piece of the path of a tool, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Start, X Y Z in millimetres.
    pub from: [f64; 3],
    /// End, X Y Z in millimetres.
    pub to: [f64; 3],
    /// The shape of the tool.
    pub shape: Shape,
    /// The side of the programmed path on which the tool is; `None`: the centre of the tool is on the path.
    pub side: Option<Side>,
}

impl Piece {
    /// The unit vector in X and Y that points to the left of the piece; `None`: the piece does not move in X or Y.
    fn left(&self) -> Option<[f64; 2]> {
        let [dx, dy] = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let length = dx.hypot(dy);
        (length > 0.0).then(|| [-dy / length, dx / length])
    }
}

/// Offsets the programmed path by the tool radius. A compensated piece is returned only after the next piece is known,
/// because the end of a compensated piece also depends on the next piece.
#[derive(Clone, Debug, Default)]
pub struct Centre {
    /// The last compensated piece as programmed, and the position of the tool's centre at its start.
    waits: Option<(Piece, [f64; 3])>,
}

impl Centre {
    /// Adds the next piece and returns the pieces whose path is known now, in their order.
    pub fn takes(&mut self, piece: Piece) -> [Option<Piece>; 2] {
        let begins_there = self.waits.is_some_and(|(last, _)| last.to == piece.from);
        let before = self.ends(Some(&piece).filter(|piece| begins_there && piece.side.is_some()));
        let from = before.filter(|_| begins_there).map_or(piece.from, |before| before.to);
        if piece.side.is_none() {
            // a move along Z goes straight up or down from the current position of the tool
            let to = if piece.left().is_none() { [from[0], from[1], piece.to[2]] } else { piece.to };
            return [before, Some(Piece { from, to, ..piece })];
        }
        self.waits = Some((piece, from));
        [before, None]
    }

    /// Ends the waiting piece and returns it. `next` is the compensated piece that follows the waiting piece, if any.
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
