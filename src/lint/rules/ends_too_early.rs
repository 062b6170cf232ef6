//! PF443: the end of the program in a sequence that stands before it.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::{Purpose, View};
use crate::sema::Word;

/// Sequences with which a program or a part of it ends.
const ENDS: [SequenceId; 3] = [SequenceId::EndCode, SequenceId::SubEnd, SequenceId::Between];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let ends = |purpose: &Purpose| matches!(purpose, Purpose::Sequence(id) if ENDS.contains(id));
    for body in view.bodies.iter().filter(|body| !ends(&body.purpose)) {
        let is_end = |word: &&Word| view.meaning(word) == Some(Meaning::End);
        if let Some(word) = body.words().find(is_end) {
            diags.push(
                Diag::new(Code::PF443, format!("{} ends the program, and the job goes on", body.name()))
                    .at(word.span, "nothing after it is done")
                    .help("take it out; a stop is M0 or M1, the end belongs into EndCode"),
            );
        }
    }
}
