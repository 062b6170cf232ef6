//! What a sequence prints: codes, axes, angles; and what a move would lose in it.

use super::fault::{Done, fault_at};
use super::numbers::tenths;
use super::renderer::Renderer;
use crate::compile::{LetterKind, Op, Routine};
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{Origin, VarId};
use crate::toolpath::Axes;

impl Renderer<'_> {
    /// Does a sequence print a code of this letter as typed that answers this?
    pub(super) fn says_code(&self, routine: &Routine, letter: u8, asked: impl Fn(f64) -> bool) -> bool {
        routine.ops.clone().any(|i| match self.shape.program.ops[i] {
            Op::Literal { index, .. } => {
                let literal = &self.shape.program.literals[index as usize];
                self.shape.letters[literal.letter].printed == letter && asked(literal.value)
            }
            _ => false,
        })
    }

    /// Does a sequence print its motion code: as typed, or by a variable?
    pub(super) fn says_motion(&self, routine: &Routine) -> bool {
        let by_variable = |i: usize| match self.shape.program.ops[i] {
            Op::Var { letter, var, .. } => {
                self.shape.letters[letter].kind == LetterKind::GCode
                    && (var == VarId::Direct || var.row().origin == Origin::Job)
            }
            _ => false,
        };
        self.says_code(routine, b'G', |code| self.group_of(b'G', tenths(code)) == Some(Group::Motion))
            || routine.ops.clone().any(by_variable)
    }

    /// Does a sequence print a motion code, or one of no group, which may move by itself?
    pub(super) fn says_own_motion(&self, routine: &Routine) -> bool {
        let own = |code: f64| matches!(self.group_of(b'G', tenths(code)), None | Some(Group::Motion));
        self.says_motion(routine) || self.says_code(routine, b'G', own)
    }

    /// Does a sequence come to words of axes before it says a motion? A block with a code of no group, as G28, goes by
    /// itself.
    pub(super) fn goes_unsaid(&self, routine: &Routine) -> bool {
        let is_line = |i: &usize| matches!(self.shape.program.ops[*i], Op::Line { .. });
        let mut start = routine.ops.start;
        while start < routine.ops.end {
            let end = (start + 1..routine.ops.end).find(is_line).unwrap_or(routine.ops.end);
            let line = Routine { ops: start..end, ..routine.clone() };
            if self.says_motion(&line) {
                return false;
            }
            if self.names_axes(&line, false) && !self.says_own_motion(&line) {
                return true;
            }
            start = end;
        }
        false
    }

    /// The variables that say where a linear axis goes.
    fn words_of(&self, axis: usize) -> &'static [VarId] {
        match (axis, self.shape.linear) {
            (0, _) => &[VarId::H, VarId::Hdist],
            (1, _) => &[VarId::V, VarId::Vdist],
            (2, 4) => &[VarId::H2],
            (3, 4) => &[VarId::V2],
            (2, _) => &[VarId::D, VarId::Ddist],
            _ => &[],
        }
    }

    /// Does a sequence print where a linear axis goes?
    pub(super) fn says_axis(&self, routine: &Routine, axis: usize) -> bool {
        self.words_of(axis).iter().any(|&var| routine.vars.has(var))
    }

    /// Does a sequence print words of axes? `typed`: with numbers of its own, so that the tool leaves its place.
    pub(super) fn names_axes(&self, routine: &Routine, typed: bool) -> bool {
        routine.ops.clone().any(|i| {
            let letter = match self.shape.program.ops[i] {
                Op::Var { letter, .. } if !typed => letter,
                Op::Literal { index, .. } => self.shape.program.literals[index as usize].letter,
                _ => return false,
            };
            self.shape.letters[letter].kind == LetterKind::Axis
        })
    }

    /// Does a sequence print the angle of a rotary axis?
    pub(super) fn says_angle(&self, routine: &Routine, axis: usize) -> bool {
        routine.ops.clone().any(|i| {
            matches!(self.shape.program.ops[i], Op::Var { letter, var: VarId::Rotangle | VarId::Lastrotangle, .. }
                if letter == self.shape.axes[axis] || !self.shape.axes.contains(&letter))
        })
    }

    /// A motion sequence must print every axis that moves: a word that the form leaves out is a move that is lost.
    pub(super) fn sequence_says(&self, routine: &Routine, target: &Axes) -> Done {
        let moves = |axis: usize| target.get(axis).is_some() && target.get(axis) != self.position.get(axis);
        let lost = (0..self.shape.linear).find(|&axis| moves(axis) && !self.says_axis(routine, axis));
        let turns = self.turned_axes(target).find(|&axis| !self.says_angle(routine, axis));
        let word = match (lost, turns) {
            (Some(axis), _) => format!("[{}]", self.words_of(axis)[0].name()),
            (None, Some(axis)) => format!("{}[rotangle]", char::from(self.shape.axes[axis])),
            (None, None) => return Ok(()),
        };
        let message = format!("this move changes {word}, which the sequence does not print");
        fault_at(Code::PR017, message, format!("add the word of {word} to the sequence"), Some(routine.span))
    }
}
