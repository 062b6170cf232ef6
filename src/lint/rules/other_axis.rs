//! PF314: the position of one axis is printed with the letter of another axis, as `X[v]`.

use crate::control::Centres;
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

/// The variables for the distance to the centre of an arc, one for each axis.
const CENTRES: [VarId; 3] = [VarId::Ival, VarId::Jval, VarId::Kval];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        // on a lathe, holes are along the first axis, and their depth is another variable
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
    // each axis has a fixed letter for its centre word: I for X, J for Y, K for Z
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        let letter = view.letters[letter].printed;
        if !b"IJK".contains(&letter) {
            continue;
        }
        let letter_of = |axis: usize| match view.settings.axes[axis] {
            b'X' => Some(b'I'),
            b'Y' => Some(b'J'),
            b'Z' => Some(b'K'),
            _ => None,
        };
        let own = CENTRES.iter().position(|&own| own == var).and_then(letter_of).filter(|&own| own != letter);
        if let Some(own) = own {
            diags.push(
                Diag::new(
                    Code::PF314,
                    format!("[{}] is the centre along {}", var.name(), char::from(b"XYZ"[usize::from(own - b'I')])),
                )
                .at(word.span, format!("printed under {}", char::from(letter)))
                .help(format!("write `{}[{}]`", char::from(own), var.name())),
            );
        }
        // if centres are relative to the start of the arc, the position of the centre is wrong here
        let axis = [VarId::Hctr, VarId::Vctr].iter().position(|&own| own == var);
        let counts = view.settings.centre_incremental && view.traits().centres == Centres::Incremental;
        if let Some(axis) = axis.filter(|_| counts) {
            let own = letter_of(axis).unwrap_or(letter);
            diags.push(
                Diag::new(
                    Code::PF314,
                    format!(
                        "[{}] is a position, but {} is a distance from the start of the arc",
                        var.name(),
                        char::from(letter)
                    ),
                )
                .at(word.span, "the arc would have another centre")
                .help(format!("write `{}[{}]`", char::from(own), CENTRES[axis].name())),
            );
        }
    }
    // in a cycle of the control, R is the clearance plane, and the word of the depth axis is the bottom
    for line in view
        .bodies
        .iter()
        .flat_map(|body| body.lines)
        .filter(|line| line.words.iter().any(|word| view.starts_cycle(word)))
    {
        for word in &line.words {
            let WordKind::Var(letter, var) = word.kind else { continue };
            let better = match (view.axis(letter), letter, var) {
                (Some(2), _, VarId::Vclear | VarId::Rplane) => "[d]",
                (None, b'R', VarId::D | VarId::Depth) => "[vclear]",
                _ => continue,
            };
            diags.push(
                Diag::new(Code::PF314, format!("[{}] under {}", var.name(), char::from(letter)))
                    .at(word.span, "the R plane and the bottom are exchanged")
                    .help(format!("write `{}{better}`", char::from(letter))),
            );
        }
    }
}
