//! PF314: `X[v]`: the position of one axis under the letter of another.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::WordKind;

/// The variables of each axis.
const OF_AXIS: [[VarId; 3]; 3] = [
    [VarId::H, VarId::Hdist, VarId::Lasth],
    [VarId::V, VarId::Vdist, VarId::Lastv],
    [VarId::D, VarId::Ddist, VarId::Lastd],
];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        // the depth of a hole on a lathe is along its first axis, by a variable of its own
        let own = OF_AXIS.iter().position(|vars| vars.contains(&var)).filter(|&own| own < 2 || view.is_mill());
        let (Some(axis), Some(own)) = (view.axis(letter), own) else { continue };
        if axis != own {
            let letters = view.settings.axes;
            diags.push(
                Diag::new(Code::PF314, format!("[{}] is a position along {}", var.name(), char::from(letters[own])))
                    .at(word.span, format!("printed under {}", char::from(letter)))
                    .help(format!("write `{}[{}]`", char::from(letters[own]), var.name())),
            );
        }
    }
}
