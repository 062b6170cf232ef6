//! PF430: a typed work offset is used for every job.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Purpose, View};
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // a safety line in StartCode is overridden before the first move
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
