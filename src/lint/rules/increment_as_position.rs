//! PF439: a distance is printed while G90 is active, so the control reads the distance as a position.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::blocks::Motion;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.settings.incremental {
        return;
    }
    for body in &view.bodies {
        let held = view.blocks(*body).iter();
        let held = held.filter(|block| !block.incremental && block.in_part() && block.motion != Motion::Cycle);
        let distance = |var| matches!(var, Some(VarId::Hdist | VarId::Vdist | VarId::Ddist));
        let word = held.flat_map(|block| &block.axis_words).find(|(word, _)| distance(word.printed_var()));
        if let Some((word, _)) = word {
            diags.push(
                Diag::new(Code::PF439, format!("{} prints a distance while G90 is on", body.name()))
                    .at(word.span, "the control reads the distance as a position")
                    .help("print the position, as `X[h]`; or `G91` before it and `G90` after it"),
            );
        }
    }
}
