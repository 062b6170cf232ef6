//! What an Upon sets: words after it print it, and conditions are asked before it.

use super::model::Form;
use super::property::Target;
use super::step::{Step, each_formula, each_step};
use crate::diag::{Code, Diag};
use crate::span::Span;

/// Conditions of sequences that ask what an Upon sets. A sequence chooses its way before the Upons that print in front of
/// it, so it would go by the value of before.
pub(super) fn check(form: &Form, diags: &mut Vec<Diag>) {
    let mut set: Vec<(Target, Span, &'static str)> = Vec::new();
    for upon in &form.upons {
        each_step(upon.steps.as_deref().unwrap_or_default(), &mut |step| {
            if let Step::Set(target, _, span) = step {
                set.push((*target, *span, upon.var.name()));
            }
        });
    }
    for sequence in form.sequences.values() {
        each_formula(sequence.steps.as_deref().unwrap_or_default(), &mut |formula, at| {
            let Some((_, by, upon)) = set.iter().find(|(target, ..)| formula.asks(*target)) else { return };
            diags.push(
                Diag::new(Code::PF707, format!("what Upon [{upon}] sets is asked before it prints"))
                    .at(at, "asked before the Upon in front of this sequence prints")
                    .at(*by, "set here")
                    .help(format!("ask [{upon}] itself, or set the value in the sequence that asks")),
            );
        });
    }
}
