//! Conditions that were printed, and those that the control lacks.

use super::state::Said;
use crate::control::Group;
use crate::lang::{VarId, VarSet};
use crate::render::shape::Shape;
use crate::render::want::Want;

/// The conditions of the spindle.
const SPINDLE: VarSet = VarSet::of(&[VarId::Speed, VarId::Direct, VarId::Speedtype]);

impl Said {
    /// Conditions that the job wants and nothing printed yet: the next move counts as using them.
    pub fn lacks(&self, want: &Want, shape: &Shape) -> VarSet {
        let mut set = VarSet::default();
        for (var, said) in self.conditions.each() {
            if want.get(var).is_some_and(|value| said != Some(value)) {
                set.insert(var);
            }
        }
        if self.lacks_beside(want) {
            set.insert(VarId::Cool);
        }
        if shape.program.switches_spindle { set.without(SPINDLE) } else { set }
    }

    /// A word with this variable was printed.
    #[inline]
    pub fn condition_word(&mut self, letter: u8, var: VarId, value: f64, shape: &Shape) {
        if var == VarId::Work {
            return self.work_word(letter, value, shape);
        }
        if self.conditions.put(var, Some(value)) {
            self.switched = true;
        } else {
            self.speed_word(letter, Some(value), shape);
        }
    }

    /// A word of this letter was printed: is it the speed?
    #[inline]
    pub fn speed_word(&mut self, letter: u8, value: Option<f64>, shape: &Shape) {
        if letter == shape.program.settings.speed_code {
            self.conditions.put(VarId::Speed, value);
            self.switched |= value.is_some();
        }
    }

    /// The work offset was printed by the letter that it has, and not as the argument of something else.
    fn work_word(&mut self, letter: u8, value: f64, shape: &Shape) {
        let own = shape.program.work_word.as_ref().map_or(b'G', |word| word.letter);
        if own == letter || own == shape.letters[letter].printed {
            self.conditions.put(VarId::Work, Some(value));
            self.switched = true;
        }
    }

    /// A code of this group was printed.
    pub(super) fn condition_code(&mut self, group: Group, value: f64, shape: &Shape) {
        self.switched |= !matches!(group, Group::Motion | Group::Return);
        let var = match group {
            Group::Work => match &shape.program.work_word {
                None => VarId::Work,
                Some(word) if word.shares_its_codes => {
                    self.conditions.put(VarId::Work, None);
                    return;
                }
                // G56 of an Okuma is a length
                Some(_) => return,
            },
            Group::Spindle => VarId::Direct,
            Group::Coolant => VarId::Cool,
            Group::FeedMode => VarId::Feedtype,
            Group::SpeedMode => VarId::Speedtype,
            _ => return,
        };
        self.conditions.put(var, Some(value));
    }

    /// The program stops, or may. Many controls stop spindle and coolant with it: before the next move that cuts or
    /// crosses they are said again, whoever printed the stop.
    pub fn stopped(&mut self, want: &Want, shape: &Shape) {
        let settings = &shape.program.settings;
        let off = [settings.spindle[2], settings.coolant[1]];
        self.beside.doubt();
        for var in [VarId::Speed, VarId::Direct, VarId::Cool] {
            if want.get(var).is_some_and(|value| !off.contains(&value)) {
                self.conditions.put(var, None);
            }
        }
        if let Some(sub) = &mut self.sub {
            sub.stops = true;
        }
        self.differs = true;
    }
}
