//! The variables and properties on which the values in a sequence depend, directly or through `@set`.

use crate::lang::{VarId, VarSet};
use crate::sema::{Formula, Target};

/// The variables and properties on which a value depends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    /// The variables.
    pub vars: VarSet,
    /// The properties of the form: one bit for each row. A form has at most 64 properties.
    properties: u64,
}

impl Sources {
    /// The sources of both values.
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

    /// Whether the value is constant.
    #[inline]
    pub fn is_empty(self) -> bool {
        self == Sources::default()
    }

    /// The rows of the properties.
    pub fn properties(self) -> impl Iterator<Item = u16> {
        (0..64).filter(move |row| self.properties & 1 << row != 0)
    }
}

/// The variables and properties that the sequence has set by `@set` so far, with the sources of their values.
#[derive(Default)]
struct Carried(Vec<(Target, Sources)>);

impl Carried {
    /// The sources of a variable or property. After `@set`, these are the sources of the value that was set.
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

/// A step of a sequence: a printed value with its letter ([`BARE`] if the value has no letter), or an assignment.
pub(super) enum Step<'p> {
    Sets(Target, &'p Formula),
    Var(u8, VarId),
    Formula(u8, &'p Formula),
}

/// The letter of a step for values without a letter.
pub(super) const BARE: u8 = b' ';

/// The sources of the words that a cycle prints at its first hole only. In a cycle with a count, these words are the
/// words of the counted lines. In a cycle of one line, they are the values without a letter. Words that other lines
/// print too are not included. `steps`: the steps of the cycle, each with a flag that is true if the line of the step
/// is printed at every hole. `counted`: whether the cycle has a count.
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
