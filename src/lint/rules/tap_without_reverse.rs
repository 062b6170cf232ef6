//! PF419: a tap that is fed out while the spindle still turns the way it cut tears the thread out.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Motion;
use crate::lint::view::View;

use super::spindle_before_change::starts_spindle;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.cycles_for(&[SequenceId::Tap, SequenceId::LTap]) {
        if body.moves_by_itself() {
            continue;
        }
        let mut cut = false;
        let mut reversed = false;
        for block in view.blocks(body) {
            reversed |= cut && block.line.words.iter().any(starts_spindle);
            let words = block.axis_words(view);
            let Some((word, _)) = words.iter().find(|(_, axis)| *axis == 2) else { continue };
            match (block.motion, word.printed_var()) {
                (Motion::Line, Some(VarId::D)) => cut = true,
                (Motion::Line | Motion::Rapid, _) if cut && !reversed => {
                    diags.push(
                        Diag::new(Code::PF419, format!("{} comes out with the spindle turning as it cut", body.name()))
                            .at(word.span, "out of the hole")
                            .help("reverse the spindle at the bottom, as `M3` for a left-hand tap; or use the control's cycle"),
                    );
                    break;
                }
                _ => {}
            }
        }
    }
}
