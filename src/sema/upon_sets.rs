//! Checks `@set` in Upon sequences.

use super::model::Form;
use super::property::Target;
use super::step::{Step, each_formula, each_step};
use crate::diag::{Code, Diag};
use crate::span::Span;

/// Reports the conditions of a sequence that use a value set in an Upon sequence. A sequence selects its branches
/// before the Upon sequences in front of it run, so the condition would use the old value.
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
                Diag::new(Code::PF707, format!("a condition tests a value before Upon [{upon}] sets it"))
                    .at(at, "tested before the Upon of this sequence is printed")
                    .at(*by, "set here")
                    .help(format!("test [{upon}] itself, or set the value in the sequence that tests it")),
            );
        });
    }
}
