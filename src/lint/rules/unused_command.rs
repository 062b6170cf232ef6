//! PF011: a command whose setting nothing in this form asks for.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, VarId};
use crate::lint::view::View;
use crate::sema::ArcCentre;
use crate::syntax::Statement;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (id, statement) in view.commands() {
        let Some(why) = unused(view, id, statement) else { continue };
        diags.push(
            Diag::new(Code::PF011, format!("{} changes nothing here", id.name()))
                .at(statement.line.span, why)
                .help("take it out, or add what it is for"),
        );
    }
}

/// Why a command changes nothing; `None`: it may change something.
fn unused(view: &View, id: CommandId, statement: &Statement) -> Option<&'static str> {
    use CommandId as C;
    use SequenceId as S;
    let settings = view.settings;
    let has = |id: SequenceId| view.form.sequences.contains_key(&id);
    let prints = |var: VarId| view.printed().has(var);
    let (unused, why) = match id {
        C::First | C::Last => (settings.numbers.letter.is_none(), "no blocks are numbered"),
        C::ModalLetters | C::ModalGs | C::Force => (!settings.modality, "every word is printed under `Modality? N`"),
        C::Flush => (!prints(VarId::Flush), "nothing prints [flush]"),
        C::LComp => (!prints(VarId::Lcomp), "nothing prints [lcomp]"),
        C::InchMm => (!prints(VarId::Unitmode), "nothing prints [unitmode]"),
        C::ReturnPlane => {
            (!prints(VarId::Retplane) && !view.has_cycles(), "nothing prints [retplane], and no cycle asks for it")
        }
        C::RigidTap => (!has(S::Tap) && !has(S::LTap), "the form has no Tap and no LTap"),
        C::ThreadPasses => (settings.thread.is_none(), "there is no Thread command"),
        C::Thread => (has(S::AutoThread) || has(S::CanThread), "a sequence serves all threads"),
        C::SubsFirst | C::RenumSubs => (!has(S::SubStart), "the form has no SubStart"),
        C::CtrCode | C::CtrCode180 | C::CtrCode360 | C::CtrIncremental | C::CircDir | C::SecondCircle => {
            let variables = [VarId::Ival, VarId::Jval, VarId::Kval];
            let asks = id == C::CtrIncremental && variables.into_iter().any(prints);
            (has(S::CwCode) && has(S::CcwCode) && !asks, "sequences print all arcs")
        }
        C::CDCCode => (has(S::InFeed), "InFeed prints the compensation"),
        C::Rename | C::Dummy | C::RevSigns => {
            let letters = statement.args.iter().map(|arg| arg.text.bytes());
            let asked: Vec<u8> = match id {
                C::Rename => letters.flatten().take(1).collect(),
                _ => letters.flatten().collect(),
            };
            (!asked.iter().any(|&letter| is_printed(view, letter)), "nothing prints this letter")
        }
        _ => return None,
    };
    unused.then_some(why)
}

/// Does anything print this letter: a word of a body, or a generated block?
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
