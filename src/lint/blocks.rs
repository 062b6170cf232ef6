//! The blocks of a body, as a control reads them, with the modes in each block.

use crate::control::{AxisWords, Code, Control, Meaning};
use crate::lang::{Origin, VarId, VarSet};
use crate::sema::{Line, Settings, Word, WordKind};

/// Motion mode of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No block of this body has set the motion yet.
    Unknown,
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2, G3.
    Arc,
    /// A motion of the control's own: [`Control::moves_by_itself`].
    Cycle,
}

/// A line with its modes. A control executes all codes of a block together.
pub struct Block<'a> {
    /// The line that prints the block.
    pub line: &'a Line,
    /// The axis words with their axis: 0 and 1 across, 2 the depth. Empty if the block only sets data, as with G4, G10, G52, G68
    /// and G92, or calls a macro.
    pub axis_words: Vec<(&'a Word, usize)>,
    /// Motion of the block.
    pub motion: Motion,
    /// G91 is active in the block.
    pub incremental: bool,
    /// The block has G28 or G30: its axis words are an intermediate point.
    pub reference: bool,
    /// The block has G53: its axis words are machine coordinates.
    pub machine: bool,
}

impl<'a> Block<'a> {
    /// Are the axis words of this block positions of the part, not of the machine?
    pub fn in_part(&self) -> bool {
        !self.reference && !self.machine
    }

    /// Does the block retract the tool: to the reference point, in machine coordinates, to a plane above the part, or to a typed
    /// height?
    pub fn retracts(&self) -> bool {
        self.axis_words.iter().any(|(word, axis)| {
            let up = |value: f64| if self.incremental { value > 0.0 } else { value >= 0.0 };
            let typed = matches!(word.kind, WordKind::Literal(_, _, value) if up(value));
            // a height from a prompt or the job was chosen on purpose
            let chosen = word.printed_var().is_some_and(|var| var == VarId::Rplane || var.row().origin == Origin::Job);
            *axis == 2 && (typed || !self.in_part() || chosen)
        })
    }
}

/// Does the word print the tool number? On a lathe, `[comp]` contains station and offset register.
pub fn says_tool(word: &Word) -> bool {
    word.printed_vars().meets(VarSet::of(&[VarId::Tool, VarId::Comp]))
}

/// Does the word call external code: a macro, a subprogram, a code of the machine's builder?
pub fn calls(control: &Control, word: &Word) -> bool {
    word.code().is_some_and(|code| control.calls(code))
}

/// Are the axis words of a block with this code no positions, but a time or data: dwell, data, scale, mirror, local zero,
/// rotation?
fn sets(meaning: Meaning) -> bool {
    meaning == Meaning::Dwell || meaning.axes() == AxisWords::Data
}

/// Reads the blocks of a body. `axis`: the axis that a word moves.
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
