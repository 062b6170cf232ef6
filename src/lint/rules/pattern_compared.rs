//! PF714: a text is compared by `=` with a pattern. `*` matches any text only after `like`.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Formula, Step};
use crate::syntax::Comparison;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        branches(body.steps.unwrap_or_default(), diags);
    }
}

fn branches(steps: &[Step], diags: &mut Vec<Diag>) {
    for step in steps {
        match step {
            Step::For(_, inner, _) => branches(inner, diags),
            Step::If(arms) => {
                for arm in arms {
                    arm.condition.iter().for_each(|condition| {
                        condition.each(&mut |part| {
                            if let Some((comparison, pattern)) = pattern(part) {
                                let not = if comparison == Comparison::Unequal { "not " } else { "" };
                                diags.push(
                                    Diag::new(Code::PF714, format!("\"{pattern}\" is compared as plain text"))
                                        .at(arm.span, "`*` is a plain character here")
                                        .help(format!(
                                            "write `{not}[toolname] like \"{pattern}\"`, with the text to compare"
                                        )),
                                );
                            }
                        });
                    });
                    branches(&arm.steps, diags);
                }
            }
            Step::Lines(_) | Step::Set(..) => {}
        }
    }
}

/// Finds a comparison by `=` of a text of the job with a text that looks like a pattern.
fn pattern(part: &Formula) -> Option<(Comparison, &str)> {
    let Formula::Compare(comparison, sides) = part else { return None };
    let of = |text: &Formula| matches!(text, Formula::TextVar(_) | Formula::PropertyText(_));
    match &**sides {
        [of_job, Formula::Text(text)] | [Formula::Text(text), of_job] if of(of_job) && text.contains('*') => {
            Some((*comparison, text))
        }
        _ => None,
    }
}
