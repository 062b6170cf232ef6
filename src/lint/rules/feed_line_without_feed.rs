//! PF418: a feed move does not print a feed, so the control uses the last feed.

use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId, VarSet};
use crate::lint::blocks::Motion;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    let feed = view.settings.feed_code;
    for body in &view.bodies {
        let id = body.sequence.map(|sequence| sequence.id);
        // the feed of a thread is its pitch, and PF412 checks cycles of the control
        if matches!(id, Some(S::AutoThread | S::CanThread)) || body.cycle_word().is_some() {
            continue;
        }
        let feeds = matches!(id, Some(S::LineCode | S::CwCode | S::CcwCode));
        let mut said = false;
        for block in view.blocks(*body) {
            said |= block.line.words.iter().any(|word| {
                let own = word.letter() == Some(feed);
                own || word.printed_vars().meets(VarSet::of(&[
                    VarId::Frate,
                    VarId::Plunge,
                    VarId::Pitch,
                    VarId::Invtime,
                ]))
            });
            let cuts = matches!(block.motion, Motion::Line | Motion::Arc) || (feeds && block.motion == Motion::Unknown);
            let words = &block.axis_words;
            if let (false, true, Some((word, _))) = (said, cuts, words.first()) {
                let letter = char::from(feed);
                let own = matches!(id, Some(S::LineCode | S::CwCode | S::CcwCode | S::InFeed | S::OutFeed));
                let what = if own {
                    "each change of the feed is printed as a separate block"
                } else {
                    "at the feed of the move before"
                };
                diags.push(
                    Diag::new(Code::PF418, format!("{} feeds without a feed word", body.name()))
                        .at(word.span, what)
                        .help(format!("print the feed, as `{letter}[frate]`")),
                );
                break;
            }
        }
    }
}
