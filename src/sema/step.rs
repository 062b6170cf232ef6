//! The steps of a sequence: lines that print, and directives.

use std::ops::Range;

use super::formula::Formula;
use super::property::Target;
use crate::lang::Each;
use crate::span::Span;

/// A step of a sequence.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Lines of the sequence that print.
    Lines(Range<usize>),
    /// Branches. The steps of the first branch with a true condition print. If no condition is true, nothing prints.
    If(Vec<Arm>),
    /// A list. The steps print once for each item.
    For(Each, Vec<Step>, Span),
    /// Sets a variable or property. The value applies to everything after the directive.
    Set(Target, Formula, Span),
}

/// A branch of an `@if`.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Location of the directive.
    pub span: Span,
    /// Condition of the branch; `None` for `@else`.
    pub condition: Option<Formula>,
    /// Steps inside the branch.
    pub steps: Vec<Step>,
}

/// Minimum and maximum number of lines that a sequence prints.
pub fn line_counts(steps: &[Step]) -> (usize, usize) {
    let mut both = (0, 0);
    for step in steps {
        let (least, most) = match step {
            Step::Lines(lines) => (lines.len(), lines.len()),
            Step::Set(..) => (0, 0),
            Step::For(_, steps, _) => (0, line_counts(steps).1),
            Step::If(arms) => {
                let counts = arms.iter().map(|arm| line_counts(&arm.steps));
                let both = counts.reduce(|all, own| (all.0.min(own.0), all.1.max(own.1))).unwrap_or_default();
                let else_is_said = arms.last().is_some_and(|arm| arm.condition.is_none());
                (if else_is_said { both.0 } else { 0 }, both.1)
            }
        };
        both = (both.0 + least, both.1 + most);
    }
    both
}

/// Calls `take` for every step, each followed by the steps inside it.
pub fn each_step<'a>(steps: &'a [Step], take: &mut dyn FnMut(&'a Step)) {
    for step in steps {
        take(step);
        match step {
            Step::Lines(_) | Step::Set(..) => {}
            Step::For(_, steps, _) => each_step(steps, take),
            Step::If(arms) => arms.iter().for_each(|arm| each_step(&arm.steps, take)),
        }
    }
}

/// Calls `take` for all formulas of the steps, each with the location of its directive.
pub fn each_formula<'a>(steps: &'a [Step], take: &mut dyn FnMut(&'a Formula, Span)) {
    each_step(steps, &mut |step| match step {
        Step::Lines(_) | Step::For(..) => {}
        Step::Set(_, value, span) => take(value, *span),
        Step::If(arms) => {
            for arm in arms {
                arm.condition.iter().for_each(|condition| take(condition, arm.span));
            }
        }
    });
}

/// The first `@for` in the steps, if there is one.
pub fn first_list(steps: &[Step]) -> Option<(Each, Span)> {
    steps.iter().find_map(|step| match step {
        Step::For(each, _, span) => Some((*each, *span)),
        Step::If(arms) => arms.iter().find_map(|arm| first_list(&arm.steps)),
        Step::Lines(_) | Step::Set(..) => None,
    })
}
