//! PF207: the comment after the name of a Custom cycle names an unknown kind of cycle.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::suggest::did_you_mean;
use crate::toolpath::CycleKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for sequence in view.form.sequences.values() {
        let Some(kind) = sequence.custom_kind().filter(|kind| CycleKind::parse(kind).is_none()) else { continue };
        // a word that is similar to no kind of cycle is an ordinary comment
        let Some(help) = did_you_mean(kind, CycleKind::NAMES.iter().map(|(name, _)| *name)) else { continue };
        diags.push(
            Diag::new(Code::PF207, format!("`{kind}` is not a kind of cycle"))
                .at(
                    sequence.span,
                    format!("printed only for the kind `{}` of a job", sequence.id.name().to_lowercase()),
                )
                .help(help),
        );
    }
}
