//! The line of a sequence that is printed, and in which frame its axis words stand.

use crate::compile::Op;
use crate::lang::VarId;
use crate::render::shape::Shape;
use crate::span::Span;

/// Which axis words of a sequence stand in another frame than the job's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shift {
    /// No axis words.
    None,
    /// Axis words of the block that is open.
    Block,
    /// All from here on.
    Body,
}

impl Shift {
    /// Of two shifts, the one that reaches farther.
    pub fn max_of(self, other: Shift) -> Shift {
        if self == Shift::Body { self } else { other }
    }
}

/// The line of a sequence whose words are printed; generated blocks have none.
#[derive(Clone, Copy, Debug, Default)]
pub struct Line {
    /// The first operation of the line.
    begin: Option<usize>,
}

impl Line {
    /// The line of a generated block.
    pub const NONE: Line = Line { begin: None };

    /// The line whose [`Op::Line`] this is.
    pub fn at(op: usize) -> Line {
        Line { begin: Some(op + 1) }
    }

    /// Does the line have such a word? Asked of its letter, and of its variable where it has one.
    pub fn prints(self, shape: &Shape, asked: impl Fn(u8, Option<VarId>) -> bool) -> bool {
        let Some(begin) = self.begin else { return false };
        let ops = &shape.program.ops[begin..];
        ops.iter().take_while(|op| !matches!(op, Op::Line { .. })).any(|op| match *op {
            Op::Var { letter, var, .. } => asked(letter, Some(var)),
            Op::Formula { letter, .. } => asked(letter, None),
            Op::Literal { index, .. } => asked(shape.program.literals[index as usize].letter, None),
            _ => false,
        })
    }

    /// Where the line stands in the form; `None`: the block is generated.
    pub fn span(self, shape: &Shape) -> Option<Span> {
        self.begin.map(|begin| shape.program.spans[begin - 1])
    }

    /// Does the line have words of axes?
    pub fn prints_axes(self, shape: &Shape) -> bool {
        self.prints(shape, |letter, _| shape.axis_bit(letter) != 0)
    }
}
