//! The line of a sequence that is being printed, and the frame of its axis words.

use crate::compile::Op;
use crate::lang::VarId;
use crate::render::shape::Shape;
use crate::span::Span;

/// Axis words of a sequence whose frame differs from the frame of the job's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shift {
    /// No axis words.
    None,
    /// The axis words in the open block.
    Block,
    /// All axis words from here to the end of the sequence.
    Body,
}

impl Shift {
    /// Of two shifts, the shift that covers more axis words.
    pub fn max_of(self, other: Shift) -> Shift {
        if self == Shift::Body { self } else { other }
    }
}

/// The line of a sequence whose words are being printed; [`Line::NONE`] for generated blocks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Line {
    /// The first operation of the line.
    begin: Option<usize>,
}

impl Line {
    /// The line of a generated block.
    pub const NONE: Line = Line { begin: None };

    /// The line that begins with this [`Op::Line`].
    pub fn at(op: usize) -> Line {
        Line { begin: Some(op + 1) }
    }

    /// Whether this is the line of a generated block.
    pub fn is_generated(self) -> bool {
        self.begin.is_none()
    }

    /// Whether the line has a word for which `asked` is true. The arguments of `asked` are the word's letter and, if
    /// the word has one, its variable.
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

    /// Location of the line in the form; `None` for a generated block.
    pub fn span(self, shape: &Shape) -> Option<Span> {
        self.begin.map(|begin| shape.program.spans[begin - 1])
    }

    /// Whether the line has axis words.
    pub fn prints_axes(self, shape: &Shape) -> bool {
        self.prints(shape, |letter, _| shape.axis_bit(letter) != 0)
    }
}
