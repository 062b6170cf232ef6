//! PF423: a position is printed while G91 is active, so the control adds the position to the current position.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::blocks::Motion;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    if view.settings.incremental {
        return;
    }
    let absolute = [V::H, V::V, V::D, V::Lasth, V::Lastv, V::Lastd, V::Rplane, V::Vclear, V::Rotangle];
    for body in &view.bodies {
        let blocks = view.blocks(*body);
        let held = blocks.iter().filter(|block| block.incremental && block.in_part() && block.motion != Motion::Cycle);
        let found = held.flat_map(|block| &block.line.words).find(|word| {
            let moves = word.letter().is_some_and(|letter| view.axis(letter).is_some() || view.is_rotary(letter));
            moves && word.printed_var().is_some_and(|var| absolute.contains(&var))
        });
        if let Some(word) = found {
            diags.push(
                Diag::new(Code::PF423, format!("{} prints a position while G91 is on", body.name()))
                    .at(word.span, "the control adds the value to the position of the tool")
                    .help("print `G90` before it"),
            );
        }
    }
}
