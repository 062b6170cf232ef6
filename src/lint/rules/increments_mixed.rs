//! PF504: a motion sequence prints positions, although the form prints incremental moves.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    if !view.settings.incremental {
        return;
    }
    for body in view.these(&[S::RapidCode, S::LineCode, S::CwCode, S::CcwCode, S::InFeed, S::OutFeed]) {
        let blocks = view.blocks(body);
        let absolute = blocks.iter().filter(|block| block.incremental && block.in_part()).find_map(|block| {
            let mut words = block.axis_words.iter().map(|(word, _)| word);
            words.find(|word| matches!(word.printed_var(), Some(VarId::H | VarId::V | VarId::D)))
        });
        if let Some(word) = absolute {
            diags.push(
                Diag::new(
                    Code::PF504,
                    format!("{} prints a position, but the other moves are increments", body.name()),
                )
                .at(word.span, "the control adds the value to the position of the tool")
                .help("print distances, as `X[hdist] Y[vdist] Z[ddist]`"),
            );
        }
    }
}
