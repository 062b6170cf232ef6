//! PF017: SubEnd prints no return code, so the control continues with the next program.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(end) = view.body(SequenceId::SubEnd) else { return };
    // other text may be the control's own word for a return, as `RET` or `endsub`
    let own = end.words().any(|word| matches!(word.kind, WordKind::Text(_)));
    if end.meaning(|meaning| meaning == Meaning::Return).is_none() && !own {
        diags.push(
            Diag::new(Code::PF017, "SubEnd does not return")
                .at(end.span, "no M99")
                .help("print `M99`, or the word of your control for the return"),
        );
    }
}
