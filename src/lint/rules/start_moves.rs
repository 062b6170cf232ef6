//! PF013: StartCode moves an axis. The position of the tool is unknown at the start of a program.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(start) = view.body(SequenceId::StartCode).filter(|_| view.is_mill()) else { return };
    for block in view.blocks(start) {
        let Some((word, _)) = block.axis_words.first().copied().filter(|_| block.in_part()) else { continue };
        diags.push(
            Diag::new(Code::PF013, "StartCode moves an axis")
                .at(word.span, "no tool is loaded, and no offset is active")
                .help(
                    "make the move in 1stToolChange, after the tool and its offsets; or move to the reference point, \
                     with G28 or G53",
                ),
        );
    }
}
