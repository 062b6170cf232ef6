//! PF011: a command makes a setting that this form does not use.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, Used, VarId};
use crate::lint::view::View;
use crate::sema::ArcCentre;
use crate::syntax::Statement;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        let Some(why) = unused(view, id, statement) else { continue };
        diags.push(
            Diag::new(Code::PF011, format!("{} changes nothing here", id.name()))
                .at(statement.line.span, why)
                .help("remove the command, or add the sequence or word that uses it"),
        );
    }
}

/// The reason why a command has no effect; `None` if the form uses its setting.
fn unused(view: &View, id: CommandId, statement: &Statement) -> Option<String> {
    let settings = view.settings;
    let has = |id: &SequenceId| view.form.sequences.contains_key(id);
    let prints = |var: VarId| view.printed().has(var);
    let (unused, why) = match id.row().used {
        Used::Always => return None,
        Used::Printed(var) => (!prints(var), format!("nothing prints [{}]", var.name())),
        Used::Cycles(var) => {
            let why = format!("nothing prints [{}], and no cycle uses it", var.name());
            (!prints(var) && !view.has_cycles(), why)
        }
        Used::With(ids) => {
            let names: Vec<_> = ids.iter().map(|id| id.name()).collect();
            (!ids.iter().any(has), format!("the form has no {}", names.join(" and no ")))
        }
        Used::Unless(ids, why) => (ids.iter().any(has), why.to_owned()),
        Used::Arcs => {
            let centres = [VarId::Ival, VarId::Jval, VarId::Kval];
            let asks = id == CommandId::CtrIncremental && centres.into_iter().any(prints);
            let served = [SequenceId::CwCode, SequenceId::CcwCode].iter().all(has);
            (served && !asks, "sequences print all arcs".to_owned())
        }
        Used::Numbered => (settings.numbers.letter.is_none(), "no blocks are numbered".to_owned()),
        Used::Modal => (!settings.modality, "every word is printed under `Modality? N`".to_owned()),
        Used::Threads => (settings.thread.is_none(), "there is no Thread command".to_owned()),
        Used::Letter => {
            let letters = statement.args.iter().flat_map(|arg| arg.text.bytes());
            // the second letter of Rename replaces the first letter in the output, so only the first letter is checked
            let most = if id == CommandId::Rename { 1 } else { usize::MAX };
            let printed = letters.take(most).any(|letter| is_printed(view, letter));
            (!printed, "nothing prints this letter".to_owned())
        }
    };
    unused.then_some(why)
}

/// Whether this letter is printed by a word of a sequence or by a generated block.
fn is_printed(view: &View, letter: u8) -> bool {
    let settings = view.settings;
    let centres = match &settings.centre {
        ArcCentre::Letters(letters) => letters.contains(&letter),
        ArcCentre::Radius(own) => *own == letter,
    };
    let generated = [settings.feed_code, settings.speed_code, settings.dwell.letter, settings.cdc_code];
    view.has_words_of(letter)
        || centres
        || generated.contains(&letter)
        || settings.axes.contains(&letter)
        || settings.axes2.contains(&letter)
        || b"GMABCRIJK".contains(&letter)
        || settings.numbers.letter == Some(letter)
}
