//! Current values of variables, for words, calculations and conditions.

use super::form_sets::Kept;
use super::said::Said;
use super::shape::Shape;
use super::vars::MOVED;
use super::want::Want;
use crate::lang::{Coolant, TextId, VarId};
use crate::sema::{PropertyKind, Target, Values};

/// Sources of values, and the letter that prints them. The letter matters for angles, because rotary axes have
/// different angles.
pub struct Now<'r, 'p> {
    pub shape: &'r Shape<'p>,
    pub want: &'r Want,
    pub said: &'r Said,
    /// Letter of the word, or a space.
    pub letter: u8,
    /// Number of the open block, if there is one.
    pub block: Option<i64>,
    /// Values from `@set` in the sequence, known before the sequence prints.
    pub set: &'r Kept,
}

impl Now<'_, '_> {
    /// The value of a variable, if the variable has a value.
    #[inline]
    pub fn get(&self, var: VarId) -> Option<f64> {
        if let Some(value) = self.said.kept.of(Target::Var(var)) {
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
        if let Some(value) = self.set.of(Target::Var(var)) {
            return Some(value);
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

    fn coolant(&self) -> Coolant {
        self.want.coolant
    }

    fn property(&self, row: u16) -> f64 {
        let target = Target::Property(row);
        let set = self.set.of(target).or_else(|| self.said.kept.of(target));
        let settings = &self.shape.program.settings;
        let is_length = settings.properties[usize::from(row)].kind == PropertyKind::Length;
        let scales = is_length && self.want.properties.is_in_forms_units(row);
        let scale = if scales { self.shape.form_scale } else { 1.0 };
        set.unwrap_or_else(|| self.want.properties.get(row).number() * scale)
    }

    fn property_text(&self, row: u16) -> &str {
        let set = self.set.text_of(Target::Property(row));
        set.unwrap_or_else(|| property_text(row, self.want, self.said))
    }
}

/// The text of a property: the form's `@set` value, otherwise the job's value.
pub fn property_text<'r>(row: u16, want: &'r Want, said: &'r Said) -> &'r str {
    said.kept.text_of(Target::Property(row)).unwrap_or_else(|| want.properties.get(row).text())
}

/// The spindle limit if the job gives no limit: the speed itself. `None` for a surface speed.
pub fn rpm_as_limit(shape: &Shape, want: &Want) -> Option<f64> {
    want.get(VarId::Speed).filter(|_| !want.is_surface(shape))
}
