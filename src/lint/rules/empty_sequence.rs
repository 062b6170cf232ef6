//! PF012: a sequence without a line prints nothing, and what it stands for is lost with it. `None` says so on purpose, where that
//! makes sense.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{Body, View};
use crate::sema::{Sequence, Step, each_step};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        if body.sequence.is_some_and(|sequence| sequence.is_none) {
            let lost = body.sequence.and_then(without);
            diags.extend(lost.map(|what| {
                Diag::new(Code::PF012, format!("{} says None", body.name()))
                    .at(body.span, what)
                    .help("write what the machine needs, or take the sequence out")
            }));
            continue;
        }
        if !body.lines.is_empty() || sets(body) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF012, format!("{} has no lines", body.name()))
                .at(body.span, "nothing is printed where it is due")
                .help(match body.sequence.and_then(without) {
                    Some(_) => "write its lines, or take it out, so that postform prints what is needed",
                    None => "write its lines, or take it out, so that postform prints what is needed; `None` says that nothing is wanted",
                }),
        );
    }
}

/// Does a directive set a value? Another sequence prints it.
fn sets(body: &Body) -> bool {
    let mut sets = false;
    each_step(body.steps.unwrap_or_default(), &mut |step| sets |= matches!(step, Step::Set(..)));
    sets
}

/// What comes of a sequence that says `None`, where that is not what anybody wants.
fn without(sequence: &Sequence) -> Option<&'static str> {
    Some(match sequence.id {
        SequenceId::OptStop => "the job's optional stop is lost",
        SequenceId::MoveHome => "the job's way home is lost",
        SequenceId::WorkChange
        | SequenceId::SpindleChange
        | SequenceId::CoolantChange
        | SequenceId::FeedModeChange
        | SequenceId::DwellBlock => "postform prints the block itself",
        _ => return None,
    })
}
