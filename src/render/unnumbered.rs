//! Lines without a block number.

use super::said::Said;
use super::shape::Shape;
use super::want::Want;
use crate::compile::Op;
use crate::control::Rules;
use crate::lang::SequenceId;

/// The last line of EndCode that may have a block number. A `%` line never has a block number.
pub fn last_line(shape: &Shape, want: &Want, said: &Said) -> Option<usize> {
    let routine = shape.routine(SequenceId::EndCode, want, said)?;
    let is_line = |i: &usize| matches!(shape.program.ops[*i], Op::Line { .. });
    routine.steps().rev().filter(is_line).find(|&line| !is_percent(line, shape))
}

/// Whether this line is the end of the text: a `%`, or `END PGM` in Klartext. Subprograms come before this line.
pub fn is_closing(line: usize, shape: &Shape) -> bool {
    let is_klartext = shape.program.settings.control().rules() == Rules::Klartext;
    is_percent(line, shape)
        || is_klartext
            && matches!(shape.program.ops.get(line + 1), Some(Op::Quote { index, .. })
                if shape.program.texts[*index as usize].starts_with("END PGM"))
}

/// Whether this line is a `%` line.
pub fn is_percent(line: usize, shape: &Shape) -> bool {
    matches!(shape.program.ops.get(line + 1), Some(Op::Text { index, .. })
        if shape.program.texts[*index as usize].starts_with('%'))
}
