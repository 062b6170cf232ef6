//! PF443: a sequence that is not at the end of the program prints an end-of-program code.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{Purpose, View};
use crate::sema::Word;

/// Sequences that end a program or a part of it.
const ENDS: [SequenceId; 3] = [SequenceId::EndCode, SequenceId::SubEnd, SequenceId::Between];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let ends = |purpose: &Purpose| matches!(purpose, Purpose::Sequence(id) if ENDS.contains(id));
    for body in view.bodies.iter().filter(|body| !ends(&body.purpose)) {
        let is_end = |word: &&Word| view.meaning(word) == Some(Meaning::End);
        if let Some(word) = body.words().find(is_end) {
            diags.push(
                Diag::new(Code::PF443, format!("{} ends the program before the job ends", body.name()))
                    .at(word.span, "nothing after this block is run")
                    .help("remove this code; write M0 or M1 for a stop, and put the end into EndCode"),
            );
        }
    }
}
