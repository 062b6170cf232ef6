//! PF423: under G91 a control adds a position to where it stands.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::blocks::Motion;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    if view.settings.incremental {
        return;
    }
    let absolute = [V::H, V::V, V::D, V::Lasth, V::Lastv, V::Lastd, V::Rplane, V::Vclear];
    for body in &view.bodies {
        let blocks = view.blocks(*body);
        let found = blocks.iter().filter(|block| block.incremental && block.in_part() && block.motion != Motion::Cycle).find_map(|block| {
            let words = block.axis_words(view).into_iter().map(|(word, _)| word);
            words.into_iter().find(|word| word.printed_var().is_some_and(|var| absolute.contains(&var)))
        });
        if let Some(word) = found {
            diags.push(
                Diag::new(Code::PF423, format!("{} prints a position while G91 is on", body.name()))
                    .at(word.span, "the control adds it to where the tool stands")
                    .help("print `G90` before it"),
            );
        }
    }
}
