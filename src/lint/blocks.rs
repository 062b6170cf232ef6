//! The blocks of a sequence as a control reads them, with the motion and positioning mode that are active in each block.

use crate::control::{AxisWords, Code, Control, Meaning};
use crate::lang::{Origin, VarId, VarSet};
use crate::sema::{Line, Settings, Word, WordKind};

/// Motion mode of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// No earlier block of this sequence has set the motion mode.
    Unknown,
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2, G3.
    Arc,
    /// The control moves the axes by itself, as in a cycle: [`Control::moves_by_itself`].
    Cycle,
}

/// A line of a sequence with its active modes. A control executes all codes of a block together, in whatever order they are printed.
pub struct Block<'a> {
    /// The line that prints the block.
    pub line: &'a Line,
    /// The words that move an axis, each with its axis: 0 and 1 are the axes of the plane, 2 is the depth axis. Empty
    /// if the block calls a macro or only sets data, as with G4, G10, G52, G68 and G92.
    pub axis_words: Vec<(&'a Word, usize)>,
    /// Motion of the block.
    pub motion: Motion,
    /// G91 is active in the block.
    pub incremental: bool,
    /// Whether the block has G28 or G30, so that its axis words are an intermediate point.
    pub reference: bool,
    /// Whether the block has G53, so that its axis words are machine coordinates.
    pub machine: bool,
}

impl<'a> Block<'a> {
    /// Whether the axis words of this block are positions relative to the part, and not to the machine.
    pub fn in_part(&self) -> bool {
        !self.reference && !self.machine
    }

    /// Whether the block retracts the tool: to the reference point, to machine coordinates, to a plane above the part, or to a
    /// height that is a number in the form.
    pub fn retracts(&self) -> bool {
        self.axis_words.iter().any(|(word, axis)| {
            let up = |value: f64| if self.incremental { value > 0.0 } else { value >= 0.0 };
            let typed = matches!(word.kind, WordKind::Literal(_, _, value) if up(value));
            // a height that comes from a prompt or from the job counts as a retract
            let chosen = word.printed_var().is_some_and(|var| var == VarId::Rplane || var.row().origin == Origin::Job);
            *axis == 2 && (typed || !self.in_part() || chosen)
        })
    }
}

/// Whether the word prints the tool number. On a lathe, `[comp]` contains the station and the offset register.
pub fn says_tool(word: &Word) -> bool {
    word.printed_vars().meets(VarSet::of(&[VarId::Tool, VarId::Comp]))
}

/// Whether the word calls external code: a macro, a subprogram, or a code of the machine's builder.
pub fn calls(control: &Control, word: &Word) -> bool {
    word.code().is_some_and(|code| control.calls(code))
}

/// Whether the axis words of a block with this code are a time or data, and not positions. The codes are those for
/// dwell, data input, scaling, mirroring, local zero and rotation.
fn sets(meaning: Meaning) -> bool {
    meaning == Meaning::Dwell || meaning.axes() == AxisWords::Data
}

/// Reads the blocks of a sequence. `axis` returns the axis that a word moves.
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
