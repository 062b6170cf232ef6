//! PF207: the remark of a Custom cycle names the kind of cycle that it serves.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, did_you_mean};
use crate::lint::view::View;
use crate::sema::{Sequence, kind_of_remark};
use crate::toolpath::CycleKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, kind) in customs(view) {
        let kinds = || CycleKind::NAMES.iter().map(|(name, _)| *name);
        if kinds().any(|name| name.eq_ignore_ascii_case(kind)) {
            continue;
        }
        let help = did_you_mean(kind, kinds()).unwrap_or_else(|| {
            format!("take one of {}; or let a comment begin with `#`", kinds().collect::<Vec<_>>().join(", "))
        });
        diags.push(
            Diag::new(Code::PF207, format!("`{kind}` is no kind of cycle"))
                .at(sequence.span, format!("only `{}` of a job is printed by this", sequence.id.name().to_lowercase()))
                .help(help),
        );
    }
}

/// The Custom cycles with the first word of their remarks.
pub(super) fn customs<'a>(view: &View<'a>) -> Vec<(&'a Sequence, &'a str)> {
    let ids = [SequenceId::Custom1, SequenceId::Custom2, SequenceId::Custom3];
    let sequences = view.form.sequences.values().filter(|sequence| ids.contains(&sequence.id));
    sequences.filter_map(|sequence| Some((sequence, kind_of_remark(sequence.remark.as_deref()?)?))).collect()
}
