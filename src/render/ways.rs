//! Which way through a sequence is taken now: its conditions are asked before any of it prints.

use super::kept::Kept;
use super::said::Said;
use super::shape::Shape;
use super::values::Now;
use super::want::Want;
use crate::compile::{Node, Routine};
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::sema::{Formula, Value, Without};
use crate::span::Span;

impl Shape<'_> {
    /// The way through a sequence that is taken now, if the form has the sequence.
    #[inline]
    pub fn routine(&self, id: SequenceId, want: &Want, said: &Said) -> Option<&Routine> {
        self.program.routine(id).map(|routine| self.way(routine, want, said))
    }

    /// The way through a routine that is taken now.
    #[inline]
    pub fn way<'s>(&'s self, routine: &'s Routine, want: &Want, said: &Said) -> &'s Routine {
        if routine.flow.is_none() { routine } else { self.chosen(routine, want, said) }
    }

    fn chosen<'s>(&'s self, routine: &'s Routine, want: &Want, said: &Said) -> &'s Routine {
        let mut branches = 0;
        if let Some(flow) = &routine.flow {
            choose(&flow.nodes, &mut Kept::default(), &mut branches, self, want, said);
        }
        let key = (routine.ops.start, routine.ops.end, branches);
        self.ways
            .known
            .get(&key)
            .unwrap_or_else(|| self.ways.known.insert(key, Box::new(routine.way(branches, self.program))))
    }
}

/// Asks the conditions of a sequence in their order; `set` is what its directives have set before.
fn choose(nodes: &[Node], set: &mut Kept, branches: &mut u128, shape: &Shape, want: &Want, said: &Said) {
    for node in nodes {
        match node {
            Node::Set(target, index) => {
                let now = Now { shape, want, said, letter: b' ', block: None, set };
                // printing it says what is wrong
                let value = shape.program.formulas[*index as usize].value(&now).ok().map(Value::into_owned);
                if let Some(value) = value {
                    set.set(*target, value);
                }
            }
            // asked for each of them, when it prints
            Node::List(_) => {}
            Node::If(all) => {
                let taken = all.iter().find(|branch| {
                    let now = Now { shape, want, said, letter: b' ', block: None, set };
                    branch
                        .condition
                        .is_none_or(|index| holds(&shape.program.formulas[index as usize], branch.span, &now))
                });
                if let Some(branch) = taken {
                    *branches |= 1 << branch.number;
                    choose(&branch.nodes, set, branches, shape, want, said);
                }
            }
        }
    }
}

fn holds(condition: &Formula, span: Span, now: &Now) -> bool {
    match condition.holds(now) {
        Ok(holds) => holds,
        Err(Without::Divisor(divisor)) => {
            _ = now.shape.ways.fault.set(Box::new(division_by_zero(divisor).at(span, "asked here")));
            false
        }
        Err(Without::Value(_)) => false,
    }
}

/// The error of a division by zero.
#[cold]
pub fn division_by_zero(divisor: Span) -> Diag {
    Diag::new(Code::PR051, "a division by zero")
        .at(divisor, "this is 0 here")
        .help("ask before it, as `@if [pitch] > 0`")
}
