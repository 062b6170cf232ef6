//! PF010: no job can use this sequence.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    let has = |id: SequenceId| view.form.sequences.contains_key(&id);
    let cancels = view.form.sequences.values().any(|sequence| sequence.cancel.is_some());
    let turns = view.settings.limits.iter().any(|limit| b"ABC".contains(&limit.letter));
    let no_beam = view.settings.beam.is_none();
    let table = [
        (S::Cancel, !cancels, "no cycle ends with `End Cancel`", "end the cycles of the control with `End Cancel`"),
        (S::Between, !view.settings.subs_first, "with `Subs1st? N` the subprograms come last", "take `Subs1st? N` out"),
        (S::SubStart, !has(S::SubCall), "the form has no SubCall", "add the sequence `SubCall`"),
        (S::SubEnd, !has(S::SubCall), "the form has no SubCall", "add the sequence `SubCall`"),
        (S::CanThread, has(S::AutoThread), "AutoThread prints all threads", "keep AutoThread or CanThread"),
        (
            S::BeginCut,
            no_beam,
            "the tool of a mill is not switched on and off",
            "write `Machine Torch` or `Machine Laser`",
        ),
        (
            S::EndCut,
            no_beam,
            "the tool of a mill is not switched on and off",
            "write `Machine Torch` or `Machine Laser`",
        ),
        (S::Unwind, !turns, "no rotary axis has a travel limit", "write its limits, as `Limits A -360 360`"),
    ];
    for (id, unused, why, help) in table {
        let Some(body) = view.body(id).filter(|_| unused) else { continue };
        diags.push(
            Diag::new(Code::PF010, format!("{} is never printed", id.name()))
                .at(body.span, why)
                .help(format!("{help}, or remove the sequence")),
        );
    }
}
