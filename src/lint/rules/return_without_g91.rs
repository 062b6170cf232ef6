//! PF422: the axis words of G28 are an intermediate point. Under G90, `G28 Z0` therefore first moves to Z0 of the part.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        for block in view.blocks(*body) {
            let words = &block.axis_words;
            let Some((word, _)) = words.first().filter(|_| block.reference && !block.incremental) else { continue };
            diags.push(
                Diag::new(Code::PF422, format!("{} goes home through a point of the part", body.name()))
                    .at(word.span, "an absolute position that the tool moves through")
                    .help(match view.is_mill() {
                        true => "write `G91 G28 Z0` and `G90` after it; or go in machine coordinates, `G0 G53 Z0`",
                        false => "write increments, `G28 U0 W0`",
                    }),
            );
        }
    }
}
