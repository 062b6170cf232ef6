//! PF208: a Custom cycle is asked last: a kind that has its sequence, or an earlier Custom, never comes to it.

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
        // Custom1 is asked before Custom2, wherever they stand
        let earlier = customs.iter().find(|(other, same)| other.id < sequence.id && same == kind);
        let named = kind.sequence().and_then(|id| view.body(id)).filter(|body| body.span != sequence.span);
        let server = named.map(|body| body.span).or(earlier.map(|(other, _)| other.span));
        if let Some(server) = server {
            diags.push(
                Diag::new(Code::PF208, format!("another sequence serves `{}`", kind.name()))
                    .at(sequence.span, "this one is never asked for it")
                    .at(server, "this one is printed")
                    .help("keep one of them"),
            );
        }
    }
}
