//! PF419: a tap is retracted before the spindle reverses, which tears the thread.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Motion;
use crate::lint::view::{Body, View};

use super::spindle_before_change::starts_spindle;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use Meaning as M;
    for (id, back) in [
        (SequenceId::Tap, [M::SpindleCcw, M::SpindleCcwCoolant]),
        (SequenceId::LTap, [M::SpindleCw, M::SpindleCwCoolant]),
    ] {
        for body in view.cycles_for(&[id]).filter(|body| !body.moves_by_itself()) {
            diags.extend(tears(view, &body, back));
        }
    }
}

/// Finds the move that tears the thread: a retract at rapid, or a retract before a code of `back` reverses the spindle.
fn tears(view: &View, body: &Body, back: [Meaning; 2]) -> Option<Diag> {
    let (mut cut, mut reversed) = (false, false);
    for block in view.blocks(*body) {
        if cut && let Some(word) = block.line.words.iter().find(|word| starts_spindle(view, word)) {
            reversed = view.meaning(word).is_none_or(|code| back.contains(&code));
        }
        let words = &block.axis_words;
        let Some((word, _)) = words.iter().find(|(_, axis)| *axis == 2) else { continue };
        let (how, help) = match (block.motion, word.printed_var()) {
            (Motion::Line, Some(VarId::D)) => {
                cut = true;
                continue;
            }
            (Motion::Line | Motion::Rapid, _) if cut && !reversed => (
                "with the spindle in the cutting direction",
                format!("reverse the spindle at the bottom, with the code that {}", back[0].about()),
            ),
            (Motion::Rapid, _) if cut => ("at rapid", "feed out: `G1 Z[vclear]`".to_owned()),
            // the tap leaves the thread without damage
            _ if cut => return None,
            _ => continue,
        };
        let diag = Diag::new(Code::PF419, format!("{} comes out {how}", body.name())).at(word.span, "out of the hole");
        return Some(diag.help(format!("{help}; or use the control's cycle")));
    }
    None
}
