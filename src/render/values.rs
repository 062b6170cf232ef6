//! The values that variables print now, for words, calculations and conditions.

use super::said::Said;
use super::shape::Shape;
use super::vars::MOVED;
use super::want::Want;
use crate::lang::{TextId, VarId};
use crate::sema::Values;

/// What is asked for values, on behalf of a letter: angles differ by the axis that prints them.
pub struct Now<'r, 'p> {
    pub shape: &'r Shape<'p>,
    pub want: &'r Want,
    pub said: &'r Said,
    /// The letter of the word, or a blank.
    pub letter: u8,
    /// Number of the open block, where one is made.
    pub block: Option<i64>,
    /// What the form sets on its way through a sequence, before it prints any of it.
    pub set: &'r [(VarId, f64)],
}

impl Now<'_, '_> {
    /// The value of a variable, if it has one.
    #[inline]
    pub fn get(&self, var: VarId) -> Option<f64> {
        if let Some(value) = self.said.kept.of(var) {
            return Some(value);
        }
        let stand = &self.said.stand;
        match var {
            VarId::Rotangle | VarId::Lastrotangle => {
                let axis = self.shape.rotary().find(|&axis| self.shape.axes[axis] == self.letter);
                axis.and_then(|axis| stand.angles.printed(var, axis)).or(self.want.get(var))
            }
            _ => {
                let increment = MOVED.iter().position(|&moved| moved == var);
                self.want.get(var).filter(|_| !increment.is_some_and(|axis| stand.is_astray(axis)))
            }
        }
    }
}

impl Values for Now<'_, '_> {
    fn number(&self, var: VarId) -> Option<f64> {
        if let Some((_, value)) = self.set.iter().rev().find(|(own, _)| *own == var) {
            return Some(*value);
        }
        match (self.get(var), var) {
            (None, VarId::Maxrpm) => rpm_as_limit(self.shape, self.want),
            (None, VarId::Block) => self.block.map(|number| number as f64),
            (value, _) => value,
        }
    }

    fn text(&self, id: TextId) -> &str {
        self.want.texts.get(id)
    }
}

/// Revolutions are their own limit.
pub fn rpm_as_limit(shape: &Shape, want: &Want) -> Option<f64> {
    let turns = want.get(VarId::Speedtype) == Some(shape.program.settings.speed_type[1]);
    want.get(VarId::Speed).filter(|_| turns)
}

/// What the form itself has set: it holds from there to the end of the program.
#[derive(Clone, Debug, Default)]
pub struct Kept(Vec<(VarId, f64)>);

impl Kept {
    /// The value of a variable, if the form has set it.
    #[inline]
    pub fn of(&self, var: VarId) -> Option<f64> {
        if self.0.is_empty() {
            return None;
        }
        self.0.iter().find(|(own, _)| *own == var).map(|(_, value)| *value)
    }

    /// The form sets it.
    pub fn set(&mut self, var: VarId, value: f64) {
        match self.0.iter_mut().find(|(own, _)| *own == var) {
            Some(row) => row.1 = value,
            None => self.0.push((var, value)),
        }
    }
}
