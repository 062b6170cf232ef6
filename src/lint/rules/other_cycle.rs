//! PF414: a sequence starts a cycle for another kind of hole, for example a tap in Drill.

use crate::control::{Hole, Row};
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{View, serves};

/// The kind of hole that each sequence has to make.
const HOLES: &[(SequenceId, Hole)] = &[
    (SequenceId::Drill, Hole::Drill),
    (SequenceId::Peck, Hole::Peck),
    (SequenceId::Chipbreak, Hole::Chipbreak),
    (SequenceId::Tap, Hole::Tap),
    (SequenceId::LTap, Hole::LeftTap),
    (SequenceId::Bore, Hole::Bore),
    (SequenceId::Back, Hole::Back),
    (SequenceId::Ream, Hole::Ream),
];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return;
    }
    let codes = view.settings.codes();
    for (sequence, body) in view.hole_cycles() {
        let Some((_, hole)) = HOLES.iter().find(|(id, _)| *id == serves(sequence)) else { continue };
        let makes = |row: &Row| row.makes.contains(hole);
        let other = |row: &Row| !row.makes.is_empty() && !makes(row);
        let Some((word, code)) = body.cycle_word().filter(|(_, code)| codes.row(*code).is_some_and(other)) else {
            continue;
        };
        let own = codes.rows().filter(|row| makes(row));
        let known = own.map(|row| row.code.to_string()).collect::<Vec<_>>().join(" or ");
        if known.is_empty() {
            continue; // the control has no cycle for this kind of hole
        }
        diags.push(
            Diag::new(Code::PF414, format!("{code} is not the code for {}", body.name()))
                .at(word.span, format!("{} is {known}", body.name()))
                .help("check the manual of the control; if the code is right, write `# postform: allow PF414`"),
        );
    }
}
