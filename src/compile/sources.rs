//! What the values of a sequence are made of: variables and properties of the form, also through what its directives set.

use crate::lang::{VarId, VarSet};
use crate::sema::{Formula, Target};

/// What values are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    /// Variables.
    pub vars: VarSet,
    /// Properties of the form, a bit for each row: a form has at most 64.
    properties: u64,
}

impl Sources {
    /// Either's.
    #[must_use]
    fn with(self, other: Sources) -> Sources {
        Sources { vars: self.vars.with(other.vars), properties: self.properties | other.properties }
    }

    fn of(target: Target) -> Sources {
        match target {
            Target::Var(var) => Sources { vars: VarSet::of(&[var]), properties: 0 },
            Target::Property(row) => {
                Sources { vars: VarSet::default(), properties: 1_u64.checked_shl(row.into()).unwrap_or_default() }
            }
        }
    }

    /// Is there none?
    #[inline]
    pub fn is_empty(self) -> bool {
        self == Sources::default()
    }

    /// The properties.
    pub fn properties(self) -> impl Iterator<Item = u16> {
        (0..64).filter(move |row| self.properties & 1 << row != 0)
    }
}

/// What the directives of a sequence have set so far, and of what.
#[derive(Default)]
struct Carried(Vec<(Target, Sources)>);

impl Carried {
    /// A value that was set is made of what it was calculated from.
    fn of(&self, target: Target) -> Sources {
        let set = self.0.iter().rfind(|(own, _)| *own == target);
        set.map_or_else(|| Sources::of(target), |(_, sources)| *sources)
    }

    fn of_var(&self, var: VarId) -> Sources {
        self.of(Target::Var(var))
    }

    fn of_formula(&self, formula: &Formula) -> Sources {
        let mut sources = Sources::default();
        formula.each(&mut |part| {
            let target = match part {
                Formula::Var(var) | Formula::Has(var) | Formula::True(var) => Target::Var(*var),
                Formula::Cools(_) => Target::Var(VarId::Cool),
                Formula::Property(row) | Formula::PropertyHolds(row) => Target::Property(*row),
                _ => return,
            };
            sources = sources.with(self.of(target));
        });
        sources
    }
}

/// What a step of a sequence prints, by the letter that is printed ([`BARE`] for none), or sets.
pub(super) enum Step<'p> {
    Sets(Target, &'p Formula),
    Var(u8, VarId),
    Formula(u8, &'p Formula),
}

/// A value without a letter.
pub(super) const BARE: u8 = b' ';

/// What the values are made of that a cycle prints at its first hole only: those of its counted lines, or, where it is one
/// line, those without a letter. A word that its other lines print as well is said at every hole. `steps`: those of the
/// cycle's sequence, each with whether it stands in a line for every hole; `counted`: some do not.
pub(super) fn of_first_hole<'p>(steps: impl Iterator<Item = (Step<'p>, bool)>, counted: bool) -> Sources {
    let mut carried = Carried::default();
    let (mut first, mut again) = (Vec::new(), Vec::new());
    for (step, repeats) in steps {
        let word = match step {
            Step::Sets(target, value) => {
                carried.0.push((target, carried.of_formula(value)));
                continue;
            }
            Step::Var(letter, var) => (letter, carried.of_var(var)),
            Step::Formula(letter, formula) => (letter, carried.of_formula(formula)),
        };
        match counted {
            true if repeats => again.push(word),
            false if word.0 != BARE => {}
            _ => first.push(word),
        }
    }
    let only_first = first.into_iter().filter(|word| word.0 == BARE || !again.contains(word));
    only_first.fold(Sources::default(), |all, (_, sources)| all.with(sources))
}
