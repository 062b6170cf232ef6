//! PF415: a cycle prints `G0 Z[d]`, a rapid to the bottom of a hole that is not yet drilled.

use crate::control::{self, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Motion;
use crate::lint::view::{View, serves};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        if serves(sequence) == SequenceId::Back || body.cycle_word().is_some() || !view.is_mill() {
            continue; // a back bore moves down through an existing hole
        }
        for block in view.blocks(body) {
            let words = &block.axis_words;
            let down = words.iter().find(|(word, axis)| *axis == 2 && word.printed_var() == Some(VarId::D));
            // the first line has the motion of the previous hole's last line, usually a retract at rapid
            let rapid = matches!(block.motion, Motion::Rapid | Motion::Unknown);
            // an unknown code in a block with the clearance plane is a cycle of this control
            let codes = view.settings.codes();
            let unknown = |code: control::Code| {
                let known = codes.meaning(code).is_some_and(|meaning| meaning != Meaning::Unsaid);
                code >= control::Code::g(70) && code.letter == b'G' && !known
            };
            let words_of = &block.line.words;
            let has_plane = words_of.iter().any(|word| word.printed_var() == Some(VarId::Vclear));
            if has_plane && words_of.iter().any(|word| word.code().is_some_and(unknown)) {
                break;
            }
            if let (true, true, Some((word, _))) = (rapid, block.in_part(), down) {
                diags.push(
                    Diag::new(Code::PF415, format!("{} goes to the bottom of the hole at rapid", body.name()))
                        .at(word.span, "no feed motion code is active here")
                        .help("go to `Z[vclear]` at rapid, then feed: `G1 Z[d] F[frate]`"),
                );
            }
        }
    }
}
