//! The variables and properties that the values of a sequence depend on, also through `@set`.

use crate::lang::{VarId, VarSet};
use crate::sema::{Formula, Target};

/// Variables and properties that a value depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    /// Variables.
    pub vars: VarSet,
    /// Properties of the form, one bit for each row: a form has at most 64.
    properties: u64,
}

impl Sources {
    /// The union of both.
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

    /// Is the value constant?
    #[inline]
    pub fn is_empty(self) -> bool {
        self == Sources::default()
    }

    /// The properties.
    pub fn properties(self) -> impl Iterator<Item = u16> {
        (0..64).filter(move |row| self.properties & 1 << row != 0)
    }
}

/// Targets of `@set` in a sequence so far, with the sources of their values.
#[derive(Default)]
struct Carried(Vec<(Target, Sources)>);

impl Carried {
    /// The sources of a variable or property: if it was set, those of the assigned value.
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

/// A step of a sequence: a printed value with its printed letter ([`BARE`] for none), or an assignment.
pub(super) enum Step<'p> {
    Sets(Target, &'p Formula),
    Var(u8, VarId),
    Formula(u8, &'p Formula),
}

/// Placeholder letter of a value without a letter.
pub(super) const BARE: u8 = b' ';

/// The sources of words that a cycle prints at its first hole only. In a cycle with a count these are the words of the counted
/// lines; in a cycle of one line, the values without a letter. A word that the other lines print too does not count. `steps`: the
/// steps of the cycle's sequence, each with whether its line prints at every hole; `counted`: the cycle has a count.
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
