//! The blocks of a body as a control would read them: which modes hold where each word stands.

use crate::lang::{Origin, VarId};
use crate::sema::{Line, Word, WordKind};

use super::view::{Body, View, is_cycle_code};

/// How the tool moves in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Nobody has said it yet in this body.
    Unknown,
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2, G3.
    Arc,
    /// A cycle of the control, a thread or a macro: it moves by itself.
    Cycle,
}

/// A line with the modes that hold in it: a control acts on all codes of a block at once.
pub struct Block<'a> {
    /// The line.
    pub line: &'a Line,
    /// How it moves.
    pub motion: Motion,
    /// G91 holds.
    pub incremental: bool,
    /// The block has G28 or G30: its axis words are a point on the way to the reference point.
    pub reference: bool,
    /// The block has G53: its axis words are machine coordinates.
    pub machine: bool,
}

impl<'a> Block<'a> {
    /// The words that say where an axis goes, with its number: 0 and 1 across, 2 the depth.
    pub fn axis_words(&self, view: &View) -> Vec<(&'a Word, usize)> {
        let words = self.line.words.iter().take_while(|word| !is_remark(view, word));
        words.filter_map(|word| Some((word, word.letter().and_then(|letter| view.axis(letter))?))).collect()
    }

    /// The axis words of this block name a place of the part, not one of the machine.
    pub fn in_part(&self) -> bool {
        !self.reference && !self.machine
    }

    /// Lifts the tool out of the part: to the reference point, in machine coordinates, to a plane above it, or to a
    /// depth that is typed.
    pub fn retracts(&self, view: &View) -> bool {
        self.axis_words(view).iter().any(|(word, axis)| {
            let up = |value: f64| if self.incremental { value > 0.0 } else { value >= 0.0 };
            let typed = matches!(word.kind, WordKind::Literal(_, _, value) if up(value));
            // a height that is asked for is one that somebody chose
            let chosen = word.printed_var().is_some_and(|var| var == VarId::Rplane || var.row().origin == Origin::Job);
            *axis == 2 && (typed || !self.in_part() || chosen)
        })
    }
}

/// Does a comment to the end of the block begin here?
fn is_remark(view: &View, word: &Word) -> bool {
    let [open, close] = &view.settings.comment;
    close.is_empty() && matches!(&word.kind, WordKind::Text(text) if text.starts_with(open.as_str()))
}

/// The blocks of a body.
pub fn read<'a>(view: &View<'a>, body: Body<'a>) -> Vec<Block<'a>> {
    let settings = view.settings;
    let mut motion = Motion::Unknown;
    let mut incremental = settings.incremental;
    let mut blocks = Vec::with_capacity(body.lines.len());
    for line in body.lines {
        let (mut reference, mut machine) = (false, false);
        for word in &line.words {
            if is_remark(view, word) {
                break; // a comment of the program
            }
            match word.kind {
                WordKind::Literal(b'G', _, code) => match code {
                    0.0 => motion = Motion::Rapid,
                    1.0 => motion = Motion::Line,
                    2.0 | 3.0 => motion = Motion::Arc,
                    28.0 | 30.0 => reference = true,
                    53.0 => machine = true,
                    _ if code == settings.inc_abs[0] => incremental = true,
                    _ if code == settings.inc_abs[1] => incremental = false,
                    80.0 => motion = Motion::Unknown,
                    // threads feed by their pitch, macros as they like
                    32.0 | 33.0 | 33.1 | 63.0 | 65.0 | 66.0 => motion = Motion::Cycle,
                    _ if is_cycle_code(code) => motion = Motion::Cycle,
                    _ => {}
                },
                WordKind::Var(b'G', VarId::Incmode) => incremental = settings.incremental,
                _ => {}
            }
        }
        blocks.push(Block { line, motion, incremental, reference, machine });
    }
    blocks
}
