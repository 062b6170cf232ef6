//! The blocks of a body as a control would read them: which modes hold where each word stands.

use crate::control::{AxisWords, Code, Control, Meaning};
use crate::lang::{Origin, VarId, VarSet};
use crate::sema::{Line, Settings, Word, WordKind};

/// How the tool moves in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No block of this body has said the motion yet.
    Unknown,
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2, G3.
    Arc,
    /// The control moves by itself: [`Control::moves_by_itself`].
    Cycle,
}

/// A line with the modes that hold in it: a control acts on all codes of a block at once.
pub struct Block<'a> {
    /// The line that prints the block.
    pub line: &'a Line,
    /// The words that say where an axis goes, with its number: 0 and 1 across, 2 the depth. Those of a code that only sets
    /// something, as G4, G10, G52, G68 and G92, and of a macro call, say it of none.
    pub axis_words: Vec<(&'a Word, usize)>,
    /// How the block moves.
    pub motion: Motion,
    /// G91 holds in the block.
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

/// Does a word say which tool? On a lathe `[comp]` is station and offset register.
pub fn says_tool(word: &Word) -> bool {
    word.printed_vars().meets(VarSet::of(&[VarId::Tool, VarId::Comp]))
}

/// Does a word call something that does more than the block says: a macro, a subprogram, a code of the builder?
pub fn calls(control: &Control, word: &Word) -> bool {
    word.code().is_some_and(|code| control.calls(code))
}

/// Are the axis words of a block a time or a setting of this code: dwell, data, scale, mirror, local zero, rotation?
fn sets(meaning: Meaning) -> bool {
    meaning == Meaning::Dwell || meaning.axes() == AxisWords::Data
}

/// The blocks of a body; `axis`: which axis a word moves.
pub fn read<'a>(settings: &Settings, axis: impl Fn(&Word) -> Option<usize>, lines: &'a [Line]) -> Vec<Block<'a>> {
    let control = settings.codes();
    let mut motion = Motion::Unknown;
    let mut incremental = settings.incremental;
    let mut blocks = Vec::with_capacity(lines.len());
    for line in lines {
        let (mut reference, mut machine, mut data) = (false, false, false);
        for word in &line.words {
            if matches!(word.kind, WordKind::Var(b'G', VarId::Incmode)) {
                incremental = settings.incremental;
            }
            let Some(code) = word.code().filter(|code| code.letter == b'G') else { continue };
            let is = |value: f64| Code::of(b'G', value) == Some(code);
            let meaning = control.meaning(code);
            match meaning {
                _ if is(settings.inc_abs[0]) => incremental = true,
                _ if is(settings.inc_abs[1]) => incremental = false,
                Some(Meaning::Rapid) => motion = Motion::Rapid,
                Some(Meaning::Line) => motion = Motion::Line,
                Some(Meaning::ArcCw | Meaning::ArcCcw) => motion = Motion::Arc,
                Some(Meaning::Reference) => reference = true,
                Some(Meaning::Machine) => machine = true,
                Some(Meaning::CycleEnd) => motion = Motion::Unknown,
                _ if control.moves_by_itself(code) => motion = Motion::Cycle,
                _ => {}
            }
            data |= meaning.is_some_and(sets);
        }
        let words = line.words.iter().filter(|_| !data);
        let axis_words = words.filter_map(|word| Some((word, axis(word)?))).collect();
        blocks.push(Block { line, axis_words, motion, incremental, reference, machine });
    }
    blocks
}
