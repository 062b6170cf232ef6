//! PF442: later passes of a thread print only X, so the tool stays at the end of the thread, unless the control moves
//! the tool back.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId};
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let served = [SequenceId::AutoThread, SequenceId::CanThread].iter().any(|&id| view.body(id).is_some());
    let Some(thread) = view.command(CommandId::Thread).filter(|_| !served) else { return };
    if view.command(CommandId::ThreadPasses).is_none() {
        diags.push(
            Diag::new(Code::PF442, "later passes of a thread print only X")
                .at(
                    thread.line.span,
                    "the tool plunges at the end of the thread if the code does not return the tool by itself",
                )
                .help(
                    "write `ThreadPasses full`, which prints approach, cut, clear and return; or `ThreadPasses x`, if \
                     the code returns by itself",
                ),
        );
    }
}
