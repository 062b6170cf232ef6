//! Queries on the output of a sequence: codes, axes, angles.

use super::shape::Shape;
use crate::compile::{LetterKind, Op, Routine};
use crate::control::{Code, Group};
use crate::lang::{Origin, VarId};

/// Whether a sequence contains a typed code for which `asked` is true.
pub fn prints_code(routine: &Routine, asked: impl Fn(Code) -> bool, shape: &Shape) -> bool {
    routine.steps().any(|i| match shape.program.ops[i] {
        Op::Literal { index, .. } => shape.program.literals[index as usize].code.is_some_and(&asked),
        _ => false,
    })
}

/// Whether a sequence prints a word of this letter.
pub fn prints_letter(routine: &Routine, asked: u8, shape: &Shape) -> bool {
    routine.steps().any(|i| match shape.program.ops[i] {
        Op::Var { letter, .. } | Op::Formula { letter, .. } => letter == asked,
        Op::Literal { index, .. } => shape.program.literals[index as usize].letter == asked,
        _ => false,
    })
}

/// Whether a sequence prints its motion code, either typed or by a variable.
pub fn prints_motion(routine: &Routine, shape: &Shape) -> bool {
    let by_variable = |i: usize| match shape.program.ops[i] {
        Op::Var { letter, var, .. } => {
            shape.letters[letter].kind == LetterKind::GCode && (var == VarId::Direct || var.row().origin == Origin::Job)
        }
        _ => false,
    };
    prints_code(routine, |code| shape.group_of(code) == Some(Group::Motion), shape) || routine.steps().any(by_variable)
}

/// Whether a sequence prints a motion code, or a code without a modal group, which may move the axes by itself.
pub fn prints_own_motion(routine: &Routine, shape: &Shape) -> bool {
    let own = |code: Code| code.letter == b'G' && matches!(shape.group_of(code), None | Some(Group::Motion));
    prints_motion(routine, shape) || prints_code(routine, own, shape)
}

/// Whether a sequence prints axis words before its first motion code. A block with a code without a modal group, such
/// as G28, does not count, because the code moves the axes by itself.
pub fn moves_without_motion(routine: &Routine, shape: &Shape) -> bool {
    let is_line = |i: &usize| matches!(shape.program.ops[*i], Op::Line { .. });
    for start in routine.steps().filter(is_line) {
        let end = (start + 1..routine.ops.end).find(is_line).unwrap_or(routine.ops.end);
        let line = Routine { ops: start..end, ..routine.clone() };
        if prints_motion(&line, shape) {
            return false;
        }
        if prints_axis_words(&line, false, shape) && !prints_own_motion(&line, shape) {
            return true;
        }
    }
    false
}

/// Whether a sequence prints the work offset. An argument of a macro does not count as a work offset.
pub fn says_work(routine: &Routine, shape: &Shape) -> bool {
    routine.steps().any(|op| shape.program.work.says(op))
}

/// Whether a sequence prints the speed mode (G96, G97), either typed or by a variable.
pub fn says_speed_mode(routine: &Routine, shape: &Shape) -> bool {
    routine.vars.has(VarId::Speedtype)
        || prints_code(routine, |code| shape.group_of(code) == Some(Group::SpeedMode), shape)
}

/// The variables of a linear axis' target.
pub fn words_of(axis: usize, shape: &Shape) -> &'static [VarId] {
    match (axis, shape.linear) {
        (0, _) => &[VarId::H, VarId::Hdist],
        (1, _) => &[VarId::V, VarId::Vdist],
        (2, 4) => &[VarId::H2],
        (3, 4) => &[VarId::V2],
        (2, _) => &[VarId::D, VarId::Ddist],
        _ => &[],
    }
}

/// Whether a sequence prints the target of a linear axis.
pub fn prints_axis(routine: &Routine, axis: usize, shape: &Shape) -> bool {
    words_of(axis, shape).iter().any(|&var| routine.vars.has(var))
}

/// Whether a sequence prints axis words. `typed`: only words with typed or calculated numbers, which move the tool away
/// from its position.
pub fn prints_axis_words(routine: &Routine, typed: bool, shape: &Shape) -> bool {
    routine.steps().any(|i| {
        let letter = match shape.program.ops[i] {
            Op::Var { letter, .. } if !typed => letter,
            Op::Literal { index, .. } => shape.program.literals[index as usize].letter,
            Op::Formula { letter, .. } => letter,
            _ => return false,
        };
        // a word of an ignored axis does not move the tool
        shape.letters[letter].kind == LetterKind::Axis && !shape.is_ignored(letter)
    })
}

/// Whether a sequence prints the angle of a rotary axis.
pub fn prints_angle(routine: &Routine, axis: usize, shape: &Shape) -> bool {
    routine.steps().any(|i| {
        matches!(shape.program.ops[i], Op::Var { letter, var: VarId::Rotangle | VarId::Lastrotangle, .. }
            if letter == shape.axes[axis] || !shape.axes.contains(&letter))
    })
}
