//! PF711: the lines of a list use no value of its items, so the lines are the same for each item.

use crate::diag::{Code, Diag};
use crate::lint::view::{Body, View};
use crate::sema::{Step, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        body.each_list(&mut |each, steps, span| {
            let each = each.name();
            if steps.is_empty() {
                diags.push(
                    Diag::new(Code::PF711, format!("@for {each} has no lines"))
                        .at(span, "nothing prints")
                        .help(format!("write the lines for each {each} above its @end, or remove @for and @end")),
                );
            } else if !says_anything(steps, *body) {
                diags.push(
                    Diag::new(Code::PF711, format!("the lines of @for {each} print the same for each {each}"))
                        .at(span, "no line of the list changes")
                        .help("print a variable of the item, as `(T[tool] D[toold])`, or remove the list"),
                );
            }
        });
    }
}

/// Whether the lines print a value that may differ between the items.
fn says_anything(steps: &[Step], body: Body) -> bool {
    steps.iter().any(|step| match step {
        Step::Lines(lines) => body.lines[lines.clone()].iter().flat_map(|line| &line.words).any(|word| {
            !matches!(
                word.kind,
                WordKind::Literal(..)
                    | WordKind::Text(_)
                    | WordKind::Note(_)
                    | WordKind::Quote(_)
                    | WordKind::Comment(_)
            )
        }),
        Step::If(_) | Step::For(..) | Step::Set(..) => true,
    })
}
