//! PF404: a sequence of several lines starts a cycle of the control. Without a count, each line drills the hole again.

use crate::diag::{Code, Diag};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (sequence, body) in view.hole_cycles() {
        let Some((word, code)) = body.cycle_word() else { continue };
        let ends = view.works_once(code) || !body.leaves_cycle();
        if ends || sequence.count.is_some() || body.most_lines() < 2 {
            continue;
        }
        let below = &view.blocks(body)[body.line_of(word) + 1..];
        let (what, help) = match (below.iter().any(|block| !block.axis_words.is_empty()), sequence.cancel) {
            (true, _) => {
                let help = format!("write `{} 1`, if the first line is for the first hole only", body.name());
                (format!("{code} drills again at each position in the lines below"), help)
            }
            (false, Some(_)) => continue, // Cancel ends the cycle
            (false, None) => (
                "the cycle stays active: the control also drills at the next position".to_owned(),
                "write `End Cancel`, or print G80 in the last line".to_owned(),
            ),
        };
        diags.push(
            Diag::new(Code::PF404, format!("{} starts a cycle of the control, but has no count", body.name()))
                .at(word.span, what)
                .at(sequence.span, "all lines are printed at every hole")
                .help(help),
        );
    }
}
