//! The blocks of a body as a control would read them: which modes hold where each word stands.

use crate::lang::{Origin, VarId, is_called, moves_by_itself};
use crate::sema::{Line, Settings, Word, WordKind};

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
    /// The control moves by itself: [`moves_by_itself`].
    Cycle,
}

/// A line with the modes that hold in it: a control acts on all codes of a block at once.
pub struct Block<'a> {
    /// The line.
    pub line: &'a Line,
    /// The words that say where an axis goes, with its number: 0 and 1 across, 2 the depth. Those of a code that only sets
    /// something, as G4, G10, G52, G68 and G92, and of a macro call, say it of none.
    pub axis_words: Vec<(&'a Word, usize)>,
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
    /// The axis words of this block name a place of the part, not one of the machine.
    pub fn in_part(&self) -> bool {
        !self.reference && !self.machine
    }

    /// Lifts the tool out of the part: to the reference point, in machine coordinates, to a plane above it, or to a
    /// depth that is typed.
    pub fn retracts(&self) -> bool {
        self.axis_words.iter().any(|(word, axis)| {
            let up = |value: f64| if self.incremental { value > 0.0 } else { value >= 0.0 };
            let typed = matches!(word.kind, WordKind::Literal(_, _, value) if up(value));
            // a height that is asked for is one that somebody chose
            let chosen = word.printed_var().is_some_and(|var| var == VarId::Rplane || var.row().origin == Origin::Job);
            *axis == 2 && (typed || !self.in_part() || chosen)
        })
    }
}

/// Codes whose axis words are a time or a setting: dwell, data, scale, mirror, local zero, rotation.
const SETS: &[f64] = &[4.0, 10.0, 50.1, 51.0, 51.1, 52.0, 68.0, 68.2, 68.3, 92.0];

/// Does a word call something that does more than the block says: a macro, a subprogram, a code of the builder?
pub fn calls(word: &Word) -> bool {
    word.typed(b'G').is_some_and(is_called) || word.is_code(b'M', &[97.0, 98.0, 198.0])
}

/// The blocks of a body; `axis`: which axis a word moves.
pub fn read<'a>(settings: &Settings, axis: impl Fn(&Word) -> Option<usize>, lines: &'a [Line]) -> Vec<Block<'a>> {
    let mut motion = Motion::Unknown;
    let mut incremental = settings.incremental;
    let mut blocks = Vec::with_capacity(lines.len());
    for line in lines {
        let (mut reference, mut machine, mut sets) = (false, false, false);
        for word in &line.words {
            match (word.typed(b'G'), &word.kind) {
                (Some(code), _) => match code {
                    0.0 => motion = Motion::Rapid,
                    1.0 => motion = Motion::Line,
                    2.0 | 3.0 => motion = Motion::Arc,
                    28.0 | 30.0 => reference = true,
                    53.0 => machine = true,
                    _ if code == settings.inc_abs[0] => incremental = true,
                    _ if code == settings.inc_abs[1] => incremental = false,
                    80.0 => motion = Motion::Unknown,
                    65.0 | 66.0 => (motion, sets) = (Motion::Cycle, true),
                    _ if SETS.contains(&code) => sets = true,
                    _ if moves_by_itself(code) => motion = Motion::Cycle,
                    _ => {}
                },
                (None, WordKind::Var(b'G', VarId::Incmode)) => incremental = settings.incremental,
                _ => {}
            }
        }
        let words = line.words.iter().filter(|_| !sets);
        let axis_words = words.filter_map(|word| Some((word, axis(word)?))).collect();
        blocks.push(Block { line, axis_words, motion, incremental, reference, machine });
    }
    blocks
}
