//! PF428: coolant is turned on before the tool change or before the spindle turns.

use crate::control::{self, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::Word;

use super::spindle_before_change::{changes, starts_spindle};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (body, change) in changes(view) {
        let spindle = body.lines.iter().position(|line| line.words.iter().any(|word| starts_spindle(view, word)));
        // the code of this kind of coolant stops the spindle, so the coolant must be turned on before the spindle
        // starts
        let first = view.settings.coolant_kinds.iter().any(|kind| {
            let row = control::Code::of(b'M', kind.on).and_then(|code| view.settings.control().row(code));
            row.is_some_and(|row| row.stops_spindle)
        });
        let ready = spindle.filter(|_| !first).map_or(change, |spindle| spindle.max(change));
        let on = |word: &&Word| {
            matches!(view.meaning(word), Some(Meaning::Flood | Meaning::Mist))
                || word.printed_var() == Some(VarId::Cool)
        };
        let mut lines = body.lines[..ready].iter().flat_map(|line| &line.words);
        if let Some(word) = lines.find(on) {
            diags.push(
                Diag::new(Code::PF428, format!("{} turns the coolant on too early", body.name()))
                    .at(word.span, "the tool is not in the spindle yet, or the spindle is off")
                    .help("print `M[cool]` last"),
            );
        }
    }
}
