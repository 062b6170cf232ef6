//! PF313: a feed letter prints a speed, as `F[speed]`, or a speed letter prints a feed.

use crate::control::PitchUnit;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, Unit, VarId};
use crate::lint::view::View;
use crate::sema::{Line, Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    pitch_per_minute(view, diags);
    plunge_in_cuts(view, diags);
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        // computed at most once per line
        let mut taps = None;
        for word in &line.words {
            let WordKind::Var(letter, var) = word.kind else { continue };
            let unit = var.row().unit;
            // if a tap has a separate word for the pitch, F is the spindle speed
            if var == VarId::Speed && *taps.get_or_insert_with(|| taps_by_pitch(view, line)) {
                continue;
            }
            let wrong = match letter {
                _ if letter == settings.feed_code => {
                    let pitch = matches!(var, VarId::Pitch | VarId::Wirefeed);
                    !pitch
                        && matches!(
                            unit,
                            Unit::Speed | Unit::Count | Unit::Code | Unit::Time | Unit::Angle | Unit::Length
                        )
                }
                _ if letter == settings.speed_code => {
                    matches!(unit, Unit::Feed | Unit::Length | Unit::Angle | Unit::Time | Unit::Count)
                }
                _ => false,
            };
            if wrong {
                let (what, right) =
                    if letter == settings.feed_code { ("feed", "[frate]") } else { ("speed", "[speed]") };
                diags.push(
                    Diag::new(
                        Code::PF313,
                        format!("{} is the {what}, but [{}] is not a {what}", char::from(letter), var.name()),
                    )
                    .at(word.span, "the control expects another value here")
                    .help(format!("write `{}{right}`", char::from(letter))),
                );
            }
        }
    }
}

/// Whether the line is the block of a tap with a separate pitch word and prints the pitch.
fn taps_by_pitch(view: &View, line: &Line) -> bool {
    let words = &line.words;
    let codes = view.settings.codes();
    let taps = |code| codes.row(code).is_some_and(|row| row.pitch.iter().any(|pitch| pitch.unit == PitchUnit::Turn));
    words.iter().filter_map(Word::code).any(taps) && words.iter().any(|word| word.printed_var() == Some(VarId::Pitch))
}

/// Reports a tap that prints `F[pitch]` while feeds are per minute. The feed must be the pitch times the spindle speed; the pitch alone
/// is far too low.
fn pitch_per_minute(view: &View, diags: &mut Vec<Diag>) {
    let [_, per_turn, _] = view.settings.feed_type;
    for body in view.cycles_for(&[SequenceId::Tap, SequenceId::LTap]).filter(|_| view.is_mill()) {
        let said = body.code(b'G', &[per_turn]).is_some() || body.prints(VarId::Feedtype);
        let feed = |word: &&Word| matches!(word.kind, WordKind::Var(letter, VarId::Pitch) if letter == view.settings.feed_code);
        if let (false, Some(word)) = (said, body.words().find(feed)) {
            let letter = char::from(view.settings.feed_code);
            diags.push(
                Diag::new(Code::PF313, format!("{} feeds by the pitch, but feeds are per minute", body.name()))
                    .at(word.span, "the pitch is a hundredth of the feed, or less: the tap breaks")
                    .help(format!(
                        "write `{letter}[frate]`; or print `G{per_turn}` with it, and G{} in Cancel",
                        view.settings.feed_type[0]
                    )),
            );
        }
    }
}

/// Reports `F[plunge]` in cuts. The plunge feed is for moves down, but cuts move across.
fn plunge_in_cuts(view: &View, diags: &mut Vec<Diag>) {
    use SequenceId as S;
    for body in view.these(&[S::LineCode, S::CwCode, S::CcwCode, S::InFeed, S::OutFeed]) {
        let word = body.words().find(|word| word.printed_var() == Some(VarId::Plunge));
        if let Some(word) = word.filter(|_| !body.prints(VarId::Frate)) {
            diags.push(
                Diag::new(Code::PF313, format!("{} cuts at the plunge feed", body.name()))
                    .at(word.span, "this move is not a plunge")
                    .help("write `F[frate]`: the feed of each move"),
            );
        }
    }
}
