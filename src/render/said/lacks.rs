//! Records of printed conditions, and the conditions that the control still lacks.

use super::line::Line;
use super::state::Said;
use crate::control::Group;
use crate::lang::{VarId, VarSet};
use crate::render::shape::Shape;
use crate::render::want::Want;

/// The conditions of the spindle.
const SPINDLE: VarSet = VarSet::of(&[VarId::Speed, VarId::Direct, VarId::Speedtype]);

impl Said {
    /// Conditions that the next move needs, but that are not printed yet.
    pub fn lacks(&self, want: &Want, shape: &Shape) -> VarSet {
        let mut set = VarSet::default();
        for (var, said) in self.conditions.each() {
            if self.due(var, want).is_some_and(|value| said != Some(value)) {
                set.insert(var);
            }
        }
        if self.lacks_beside(want) {
            set.insert(VarId::Cool);
        }
        if shape.program.switches_spindle { set.without(SPINDLE) } else { set }
    }

    /// Records that a word with this variable was printed in this line.
    #[inline]
    pub fn condition_word(&mut self, letter: u8, var: VarId, value: f64, line: Line, want: &Want, shape: &Shape) {
        if self.conditions.put(var, Some(value)) {
            self.switched = true;
            if var == VarId::Speed {
                self.speed_is_the_jobs();
            }
            self.typed(var, value, line, want, shape);
        } else {
            self.speed_word(letter, value, line, want, shape);
        }
    }

    /// Records a printed word. A word with the speed's letter counts as the speed.
    #[inline]
    pub fn speed_word(&mut self, letter: u8, value: f64, line: Line, want: &Want, shape: &Shape) {
        if letter == shape.program.settings.speed_code {
            self.conditions.put(VarId::Speed, Some(value));
            self.switched = true;
            self.typed(VarId::Speed, value, line, want, shape);
        }
    }

    /// Records a word that was a parameter of a code. If the word has the speed's letter, the speed becomes unknown and
    /// is printed again before the next move.
    pub fn parameter_of_code(&mut self, letter: u8, shape: &Shape) {
        if letter == shape.program.settings.speed_code {
            self.conditions.put(VarId::Speed, None);
            self.differs = true;
        }
    }

    /// Records that a code of this group was printed in this line.
    pub(super) fn condition_code(&mut self, group: Group, value: f64, line: Line, want: &Want, shape: &Shape) {
        self.switched |= !matches!(group, Group::Motion | Group::Return);
        let var = match group {
            Group::Work => match &shape.program.work {
                words if words.by_code() => VarId::Work,
                words if words.shares_its_codes => {
                    self.conditions.put(VarId::Work, None);
                    return;
                }
                // on an Okuma, G56 is a length offset
                _ => return,
            },
            Group::Spindle => VarId::Direct,
            Group::Coolant => return self.coolant_said(value, line, want, shape),
            Group::FeedMode => VarId::Feedtype,
            Group::SpeedMode => VarId::Speedtype,
            _ => return,
        };
        self.conditions.put(var, Some(value));
        self.typed(var, value, line, want, shape);
    }

    /// Records a code at which the control stops the spindle. If the spindle must turn, its direction is printed again.
    pub fn spindle_stopped(&mut self, want: &Want, shape: &Shape) {
        let off = shape.program.settings.spindle[2];
        if self.due(VarId::Direct, want).is_some_and(|value| value != off) {
            self.conditions.put(VarId::Direct, None);
            self.differs = true;
        }
    }

    /// Records a program stop or optional stop, from any source. At a stop, many controls turn off spindle and coolant;
    /// both are therefore printed again before the next cut or rapid.
    pub fn stopped(&mut self, want: &Want, shape: &Shape) {
        let settings = &shape.program.settings;
        let off = [settings.spindle[2], settings.coolant[1]];
        self.beside.doubt();
        for var in [VarId::Speed, VarId::Direct, VarId::Cool] {
            if self.due(var, want).is_some_and(|value| !off.contains(&value)) {
                self.conditions.put(var, None);
            }
        }
        if let Some(sub) = &mut self.sub {
            sub.stops = true;
        }
        self.differs = true;
    }
}
