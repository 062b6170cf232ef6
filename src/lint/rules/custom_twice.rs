//! PF208: a Custom cycle is never used, because its kind of cycle has a separate sequence or an earlier Custom cycle.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::toolpath::CycleKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let customs: Vec<_> = view
        .form
        .sequences
        .values()
        .filter_map(|sequence| Some((sequence, CycleKind::parse(sequence.custom_kind()?)?)))
        .collect();
    for (sequence, kind) in &customs {
        // Custom1 has priority over Custom2, in whatever order the form has them
        let earlier = customs.iter().find(|(other, same)| other.id < sequence.id && same == kind);
        let named = kind.sequence().and_then(|id| view.body(id)).filter(|body| body.span != sequence.span);
        let server = named.map(|body| body.span).or(earlier.map(|(other, _)| other.span));
        if let Some(server) = server {
            diags.push(
                Diag::new(Code::PF208, format!("`{}` is printed by another sequence", kind.name()))
                    .at(sequence.span, "never printed for this kind")
                    .at(server, "printed for this kind")
                    .help("keep one of them"),
            );
        }
    }
}
