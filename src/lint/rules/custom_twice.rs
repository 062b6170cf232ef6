//! PF208: a Custom cycle is asked last: a kind that has its sequence, or an earlier Custom, never comes to it.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

use super::custom_kind::customs;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let customs = customs(view);
    let own = [
        ("drill", SequenceId::Drill),
        ("tap", SequenceId::Tap),
        ("ltap", SequenceId::LTap),
        ("bore", SequenceId::Bore),
        ("back", SequenceId::Back),
        ("ream", SequenceId::Ream),
        ("deep", SequenceId::Peck),
        ("chipbreak", SequenceId::Chipbreak),
        ("custom1", SequenceId::Custom1),
        ("custom2", SequenceId::Custom2),
        ("custom3", SequenceId::Custom3),
    ];
    for (sequence, kind) in &customs {
        // Custom1 is asked before Custom2, wherever they stand
        let earlier = customs.iter().find(|(other, same)| other.id < sequence.id && same.eq_ignore_ascii_case(kind));
        let named = own.iter().find(|(name, _)| name.eq_ignore_ascii_case(kind)).and_then(|(_, id)| view.body(*id));
        let named = named.filter(|body| body.span != sequence.span);
        let server = named.map(|body| body.span).or(earlier.map(|(other, _)| other.span));
        if let Some(server) = server {
            diags.push(
                Diag::new(Code::PF208, format!("another sequence serves `{kind}`"))
                    .at(sequence.span, "this one is never asked for it")
                    .at(server, "this one is printed")
                    .help("keep one of them"),
            );
        }
    }
}
