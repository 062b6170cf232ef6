//! Selects the branches of a sequence. All conditions of the sequence are evaluated before the sequence prints
//! anything.

use super::ahead;
use super::form_sets::Kept;
use super::no_value::{division_by_zero, no_order};
use super::said::Said;
use super::shape::Shape;
use super::values::Now;
use super::want::Want;
use crate::compile::{List, Node, Routine};
use crate::diag::Diag;
use crate::lang::{SequenceId, TOOLS_AHEAD};
use crate::sema::{Formula, Value, Without};
use crate::span::Span;

impl Shape<'_> {
    /// The sequence with its branches selected for the current values; `None` if the form does not have the sequence.
    #[inline]
    pub fn routine(&self, id: SequenceId, want: &Want, said: &Said) -> Option<&Routine> {
        self.program.routine(id).map(|routine| self.way(routine, want, said))
    }

    /// The routine with its branches selected for the current values.
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

/// Evaluates the conditions of a sequence in order. `set` holds the values from the `@set` directives before these
/// conditions.
fn choose(nodes: &[Node], set: &mut Kept, branches: &mut u128, shape: &Shape, want: &Want, said: &Said) {
    for node in nodes {
        match node {
            Node::Set(target, index) => {
                let now = Now { shape, want, said, letter: b' ', block: None, set };
                // an error in the value is reported when the directive is executed
                let value = shape.program.formulas[*index as usize].value(&now).ok().map(Value::into_owned);
                if let Some(value) = value {
                    set.set(*target, value);
                }
            }
            Node::List(index, _) => set_by_list(&shape.program.lists[*index as usize], set, shape, want, said),
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

/// Applies the values that `@set` assigns inside a list, for the conditions after the list. The conditions inside the list are
/// evaluated for each item when the item is printed.
fn set_by_list(list: &List, set: &mut Kept, shape: &Shape, want: &Want, said: &Said) {
    let Some(flow) = list.routine.flow.as_ref().filter(|flow| sets(&flow.nodes, shape)) else { return };
    let Some(survey) = &shape.options.survey else { return };
    for item in ahead::items(list.each, want.item, survey) {
        choose(&flow.nodes, set, &mut 0, shape, &ahead::of_item(item, survey, shape, want), said);
    }
}

/// Whether any node contains a `@set`.
fn sets(nodes: &[Node], shape: &Shape) -> bool {
    nodes.iter().any(|node| match node {
        Node::Set(..) => true,
        Node::If(all) => all.iter().any(|branch| sets(&branch.nodes, shape)),
        Node::List(index, _) => {
            let inner = &shape.program.lists[*index as usize].routine.flow;
            inner.as_ref().is_some_and(|flow| sets(&flow.nodes, shape))
        }
    })
}

fn holds(condition: &Formula, span: Span, now: &Now) -> bool {
    let wrong = |diag: Diag| now.shape.ways.fault.set(Box::new(diag.at(span, "tested here")));
    if asks_unknown_order(condition, now) {
        _ = wrong(no_order());
        return false;
    }
    match condition.holds(now) {
        Ok(holds) => holds,
        Err(Without::Divisor(divisor)) => {
            _ = wrong(division_by_zero(divisor));
            false
        }
        Err(Without::Value(_)) => false,
    }
}

/// Whether a condition depends on the order of tools while that order is unknown. A condition that properties alone
/// decide does not depend on the order.
fn asks_unknown_order(condition: &Formula, now: &Now) -> bool {
    now.want.tool_order.is_none()
        && now.want.tool_changes > 0
        && now.shape.program.asked.meets(TOOLS_AHEAD)
        && condition.vars().meets(TOOLS_AHEAD)
        && condition.decided(now, &|_| true).is_none()
}
