//! PF012: a sequence has no lines, so it prints nothing. A sequence without lines is probably a mistake. If a sequence
//! is meant to print nothing, it must contain the word `None`.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{Body, View};
use crate::sema::{Sequence, Step, each_step};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        if body.sequence.is_some_and(|sequence| sequence.is_none) {
            let lost = body.sequence.and_then(without);
            diags.extend(lost.map(|what| {
                Diag::new(Code::PF012, format!("the body of {} is None", body.name()))
                    .at(body.span, what)
                    .help("write the blocks that the machine needs, or remove the sequence")
            }));
            continue;
        }
        if !body.lines.is_empty() || sets(body) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF012, format!("{} has no lines", body.name()))
                .at(body.span, "nothing is printed for this event")
                .help(match body.sequence.and_then(without) {
                    Some(_) => "write lines, or remove the sequence: then postform prints the block itself",
                    None => {
                        "write lines, or remove the sequence: then postform prints the block itself; write `None` to \
                        print nothing"
                    }
                }),
        );
    }
}

/// Whether the sequence contains a `@set`. A sequence with a `@set` is not empty: it sets a value that another sequence
/// prints.
fn sets(body: &Body) -> bool {
    let mut sets = false;
    each_step(body.steps.unwrap_or_default(), &mut |step| sets |= matches!(step, Step::Set(..)));
    sets
}

/// The output that is lost if this sequence contains only `None`. The function returns an output only for sequences in
/// which `None` is probably a mistake.
fn without(sequence: &Sequence) -> Option<&'static str> {
    Some(match sequence.id {
        SequenceId::OptStop => "the job's optional stop is lost",
        SequenceId::MoveHome => "the job's move home is lost",
        SequenceId::WorkChange
        | SequenceId::SpindleChange
        | SequenceId::CoolantChange
        | SequenceId::FeedModeChange
        | SequenceId::DwellBlock => "postform prints the block itself",
        _ => return None,
    })
}
