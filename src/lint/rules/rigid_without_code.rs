//! PF446: a rigid tap without M29. On a Fanuc, a parameter decides whether the feed of G84 alone follows the spindle.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::SequenceId;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let (settings, codes) = (view.settings, view.settings.codes());
    let is_ahead = |meaning| meaning == Meaning::RigidAhead;
    let ahead = codes.rows().find(|row| is_ahead(row.meaning));
    // without a control in the form, M29 may be unnecessary: a Haas taps rigidly by G84 alone
    let Some(ahead) = ahead.filter(|_| settings.rigid_tap && settings.control.is_some()) else { return };
    if view.words().any(|word| view.meaning(word).is_some_and(is_ahead)) {
        return;
    }
    for body in view.cycles_for(&[SequenceId::Tap, SequenceId::LTap]) {
        let Some((word, code)) = body.cycle_word() else { continue };
        if codes.row(code).is_some_and(|row| row.runs.rigid.is_some()) {
            continue;
        }
        let (name, ahead) = (body.name(), ahead.code);
        diags.push(
            Diag::new(Code::PF446, format!("the form's tap is rigid (`RigidTap? Y`), but {name} prints no {ahead}"))
                .at(word.span, format!("without {ahead}, a parameter of the control decides whether this tap is rigid"))
                .help(format!(
                    "print `{ahead} S[speed]` on its own line before {code}; if {code} alone is rigid on this machine, write \
                     `rigid = true` into its row in a control file: `postform explain PF446` shows the row"
                )),
        );
    }
}
