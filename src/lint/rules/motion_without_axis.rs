//! PF433: a motion sequence does not print all axes, so a move along the missing axis is not made.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Purpose, View};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    use VarId as V;
    let flat = view.is_flat();
    for body in view.these(&[S::RapidCode, S::LineCode, S::CwCode, S::CcwCode]) {
        let arc = body.purpose == Purpose::Sequence(S::CwCode) || body.purpose == Purpose::Sequence(S::CcwCode);
        let has_centre = body.prints_any(&[V::Ival, V::Hctr]) && body.prints_any(&[V::Jval, V::Vctr]);
        if arc && has_centre && body.prints_any(&[V::Endang, V::Sweep]) {
            continue; // the end of the arc is defined by centre and angle
        }
        let axes: &[[V; 2]] = match (view.is_mill() && !arc, body.lines.is_empty()) {
            (_, true) => continue,
            (true, _) => &[[V::H, V::Hdist], [V::V, V::Vdist], [V::D, V::Ddist]],
            (false, _) => &[[V::H, V::Hdist], [V::V, V::Vdist]],
        };
        // a form for a torch or laser need not print the depth
        let axes = if flat { &axes[..2] } else { axes };
        let missing: Vec<String> =
            axes.iter().filter(|vars| !body.prints_any(*vars)).map(|vars| format!("[{}]", vars[0].name())).collect();
        if !missing.is_empty() {
            diags.push(
                Diag::new(Code::PF433, format!("{} does not print {}", body.name(), missing.join(" and ")))
                    .at(body.span, "a move along that axis is an error")
                    .help("print all axes; unchanged words are left out anyway"),
            );
        }
    }
}
