//! PF430: a sequence prints a fixed work offset, so every job uses this work offset.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Purpose, View};
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // a work offset in the safety line of StartCode is allowed, because the job's work offset replaces it before the
    // first move
    let bodies = view.bodies.iter().filter(|body| body.purpose != Purpose::Sequence(SequenceId::StartCode));
    for body in bodies {
        let is_work = |word: &&Word| view.meaning(word) == Some(Meaning::Work);
        let (Some(word), false) = (body.words().find(is_work), body.prints(VarId::Work)) else { continue };
        diags.push(
            Diag::new(Code::PF430, format!("{} always uses the same work offset", body.name()))
                .at(word.span, "a fixed work offset")
                .help("write `G[work]`: then the job selects the work offset"),
        );
    }
}
