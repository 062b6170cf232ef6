//! PF406: a cycle that does not print the position drills every hole at one place.

use crate::diag::{Code, Diag};
use crate::lang::{Machine, SequenceId, VarId};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.form.settings.machine != Machine::Mill {
        return; // a lathe drills at its centre
    }
    for sequence in view.form.sequences.values() {
        let threads = matches!(sequence.id, SequenceId::AutoThread | SequenceId::CanThread | SequenceId::Cancel);
        if !sequence.id.row().is_cycle || threads || sequence.is_none {
            continue;
        }
        let prints = |var| sequence.lines.iter().flat_map(|line| &line.words).filter_map(Word::var).any(|v| v == var);
        let missing: Vec<&str> = [VarId::H, VarId::V].into_iter().filter(|&v| !prints(v)).map(VarId::name).collect();
        if missing.is_empty() {
            continue;
        }
        let names = missing.iter().map(|name| format!("[{name}]")).collect::<Vec<_>>().join(" and ");
        diags.push(
            Diag::new(Code::PF406, format!("{} does not print {names}", sequence.id.name()))
                .at(sequence.span, "the control would stay where it is for every hole")
                .help("print the position, as `X[h] Y[v]`"),
        );
    }
}
