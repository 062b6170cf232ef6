//! PF421: Unwind interrupts a cut and must bring the tool above the point of interruption before the tool goes down.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(body) = view.body(SequenceId::Unwind) else { return };
    let mut down: Option<&Word> = None;
    for block in view.blocks(body).iter().filter(|block| block.in_part()) {
        let words = &block.axis_words;
        let across = words.iter().find(|(word, axis)| *axis < 2 && word.printed_var().is_some());
        let depth =
            words.iter().find(|(word, axis)| *axis == 2 && matches!(word.printed_var(), Some(VarId::D | VarId::Lastd)));
        if let (Some((over, _)), Some(down)) = (across, down) {
            diags.push(
                Diag::new(Code::PF421, "Unwind goes down before it is above the position where it stopped")
                    .at(down.span, "down here")
                    .at(over.span, "moves across here, inside the part")
                    .help("print `X[lasth] Y[lastv]` first, the depth after it"),
            );
            return;
        }
        down = down.or(depth.map(|(word, _)| *word));
    }
}
