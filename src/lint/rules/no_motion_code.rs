//! PF438: a position is printed without a motion code, so the control uses the last motion: rapid, or a feed move with
//! the last feed.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::Motion;
use crate::lint::view::{Purpose, View};
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    let changes = [S::FirstToolChange, S::ToolChange, S::Index].map(Purpose::Sequence);
    for body in view.bodies.iter().filter(|body| view.is_mill() && changes.contains(&body.purpose)) {
        // text of a conversational control may contain the motion
        if body.words().any(|word| matches!(word.kind, WordKind::Text(_))) {
            continue;
        }
        let moves = view.blocks(*body).iter().filter(|block| block.motion == Motion::Unknown && block.in_part());
        let place = |var| matches!(var, Some(VarId::H | VarId::V | VarId::D));
        let word = moves.flat_map(|block| &block.axis_words).find(|(word, _)| place(word.printed_var()));
        if let Some((word, _)) = word {
            diags.push(
                Diag::new(Code::PF438, format!("{} goes to a position without a motion code", body.name()))
                    .at(word.span, "moves at rapid or at feed, like the block before")
                    .help("print `G0` with it"),
            );
        }
    }
}
