//! PF414: a sequence that starts the cycle of another one: a drill that taps, a back bore that comes from above.

use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{View, serves};

/// The codes that mills have for each cycle.
const OWN: &[(SequenceId, &[f64])] = &[
    (SequenceId::Drill, &[81.0, 82.0]),
    (SequenceId::Peck, &[83.0]),
    (SequenceId::Chipbreak, &[73.0, 83.0]),
    (SequenceId::Tap, &[84.0]),
    (SequenceId::LTap, &[74.0, 84.0]),
    (SequenceId::Bore, &[76.0, 85.0, 86.0, 88.0, 89.0]),
    (SequenceId::Back, &[87.0]),
    (SequenceId::Ream, &[85.0, 89.0]),
];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if !view.is_mill() {
        return;
    }
    for (sequence, body) in view.hole_cycles() {
        let Some((_, own)) = OWN.iter().find(|(id, _)| *id == serves(sequence)) else { continue };
        // these have G74 for it, and G84 would turn the tap the wrong way
        let own = if serves(sequence) == SequenceId::LTap && view.is_for(&["fanuc", "haas"]) { &own[..1] } else { own };
        let Some((word, code)) = body.cycle_word().filter(|(_, code)| !own.contains(code) && code.fract() == 0.0)
        else {
            continue;
        };
        let known = own.iter().map(|code| format!("G{code}")).collect::<Vec<_>>().join(" or ");
        diags.push(
            Diag::new(Code::PF414, format!("G{code} is not the cycle of {}", body.name()))
                .at(word.span, format!("{} is {known}", body.name()))
                .help("look at the control's manual; `# postform: allow PF414` says that it is meant so"),
        );
    }
}
