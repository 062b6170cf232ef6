//! PF419: a tap that is fed out while the spindle still turns the way it cut tears the thread out.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Motion;
use crate::lint::view::{View, cycle_word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in view.these(&[SequenceId::Tap, SequenceId::LTap]) {
        let own_codes =
            body.words().any(|word| word.typed(b'G').is_some_and(|code| code >= 100.0 || code == 33.0 || code == 33.1));
        if cycle_word(&body).is_some() || own_codes {
            continue;
        }
        let mut cut = false;
        let mut reversed = false;
        for block in view.blocks(body) {
            reversed |= cut
                && block.line.words.iter().any(|word| {
                    word.is_code(b'M', &[3.0, 4.0, 13.0, 14.0]) || word.printed_var() == Some(VarId::Direct)
                });
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
