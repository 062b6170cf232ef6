//! PF434: cutter compensation is not turned on, not turned off, or lacks its offset register.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::view::{Body, View};
use crate::sema::Word;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [left, right, off] = view.settings.cdc;
    let side = |body: &Body, codes: &[f64]| body.prints(VarId::Side) || body.code(b'G', codes).is_some();
    let mut say = |at: Span, message: String, label: &str, help: String| {
        diags.push(Diag::new(Code::PF434, message).at(at, label).help(help));
    };
    if let Some(body) = view.body(SequenceId::InFeed).filter(|body| !body.lines.is_empty()) {
        let name = body.name();
        let in_letter =
            |word: &Word, letters: &[u8]| view.printed_letter(word).is_some_and(|own| letters.contains(&own));
        let register = body.words().any(|word| in_letter(word, b"DH")) || body.prints_any(&[VarId::Dcomp, VarId::Comp]);
        let typed = |word: &&Word| word.typed(b'D').is_some_and(|number| number > 0.0);
        let length = |word: &&Word| word.printed_var() == Some(VarId::Lcomp) && in_letter(word, b"D");
        if !side(&body, &[left, right]) {
            let message = format!("{name} does not turn compensation on");
            say(body.span, message, "no G41, no G42", "print `G[side]`".into());
        } else if !register && view.is_mill() {
            say(body.span, format!("{name} has no diameter register"), "no D", "print `D[dcomp]`".into());
        } else if let Some(word) = body.words().find(typed) {
            let message = format!("{name} uses the same diameter register for every tool");
            say(word.span, message, "as typed", "write `D[dcomp]`".into());
        } else if let Some(word) = body.words().find(length) {
            let message = format!("{name} uses the length register of the tool as its diameter register");
            say(word.span, message, "the register of the length", "write `D[dcomp]`".into());
        }
    }
    if let Some(body) = view.body(SequenceId::OutFeed).filter(|body| !body.lines.is_empty())
        && !side(&body, &[off])
    {
        let message = format!("{} does not turn compensation off", body.name());
        say(body.span, message, "no G40", format!("print `G{off}`"));
    }
}
