//! Compares the actions of a wire EDM machine between cuts. The form's codes for threading and cutting the wire must come
//! in the job's order and at the job's positions.

use super::cut::{ALL, same};
use super::sides::Sides;
use super::wire_codes::{self, Coded};
use crate::diag::Code;

/// Compares the program's codes since the last cut with the job's actions, and compares the positions of codes and
/// actions.
pub(super) fn compare(s: &mut Sides<'_>, line: u64) {
    if s.job.does.is_empty() && s.program.passage.does.is_empty() {
        return;
    }
    let what = |code: Coded| wire_codes::what(&s.program.wire, code);
    let [wanted, is] = [&s.job, &s.program.passage].map(|side| &side.does);
    let differs = wanted.iter().zip(is).position(|(a, b)| {
        let [a_stands, b_stands] = [s.job.standing(a), s.program.passage.standing(b)];
        let apart = match (a_stands, b_stands) {
            (Some(a), Some(b)) => !same(&a.to, &b.to, ALL, s.limits.tolerance),
            (a, _) => a.is_some(), // the position is known only at the machine
        };
        a.what != b.what || apart
    });
    let Some(at) = differs.or((wanted.len() != is.len()).then(|| wanted.len().min(is.len()))) else { return };
    let name = |code: Coded| format!("M{}", f64::from(code.1) / 10.0);
    let (wanted, is) = (wanted.get(at).map(|mark| mark.what), is.get(at).map(|mark| (mark.what, mark.line)));
    let message = match (wanted, is) {
        (Some(wanted), Some((is, _))) if wanted == is => {
            format!("{} {} at another position than in the job", name(is), what(is))
        }
        (Some(wanted), Some((is, _))) => {
            format!("{} {}, but the job's {} {}", name(is), what(is), name(wanted), what(wanted))
        }
        (Some(wanted), None) => format!("{}, which {}, is missing", name(wanted), what(wanted)),
        (None, Some((is, _))) => format!("{} {}, but the job does not", name(is), what(is)),
        (None, None) => return,
    };
    let line = is.map_or(line, |(_, line)| line);
    s.found(Code::PV025, line, "check EdmThread, EdmCut, EdmPreDrillThread and SubmergeTank", || message.clone());
}
