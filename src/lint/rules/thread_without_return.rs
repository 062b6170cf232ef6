//! PF442: later passes of a thread print only X. The tool then stays at the end of the thread, unless the control moves it back.

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
                    "the tool would plunge at the end of the thread, unless this code returns by itself",
                )
                .help(
                    "write `ThreadPasses full`, which prints approach, cut, clear and return; or `ThreadPasses x`, if \
                     the code returns by itself",
                ),
        );
    }
}
