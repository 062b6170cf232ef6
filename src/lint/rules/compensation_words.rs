//! PF434: compensation that is not turned on, not off, or without its register.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Body, View};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [left, right, off] = view.settings.cdc;
    let side = |body: &Body, codes: &[f64]| body.prints(VarId::Side) || body.code(b'G', codes).is_some();
    let mut say = |body: &Body, message: &str, label: &str, help: String| {
        diags.push(Diag::new(Code::PF434, format!("{} {message}", body.name())).at(body.span, label).help(help));
    };
    if let Some(body) = view.body(SequenceId::InFeed).filter(|body| !body.lines.is_empty()) {
        let register = body.words().any(|word| view.printed_letter(word).is_some_and(|letter| b"DH".contains(&letter)))
            || body.prints_any(&[VarId::Dcomp, VarId::Comp]);
        if !side(&body, &[left, right]) {
            say(&body, "does not turn compensation on", "no G41, no G42", "print `G[side]`".into());
        } else if !register && view.is_mill() {
            say(&body, "does not say which diameter", "no D", "print `D[dcomp]`".into());
        }
    }
    if let Some(body) = view.body(SequenceId::OutFeed).filter(|body| !body.lines.is_empty())
        && !side(&body, &[off])
    {
        say(&body, "does not turn compensation off", "no G40", format!("print `G{off}`"));
    }
}
