//! The compiled form.

use sha2::{Digest, Sha256};

use super::letters::LetterTable;
use super::routine::Routine;
use super::work::WorkWords;
use crate::control::Code;
use crate::lang::{Each, SEQUENCES, SequenceId, TextId, TextSet, TextVar, VarId, VarSet};
use crate::sema::{Formula, Settings, Target};
use crate::source::Source;
use crate::span::Span;

/// Number of bytes of a form's hash that are printed.
const HASH_BYTES: usize = 6;

/// One operation. It is small, because a long job executes hundreds of millions of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// Start of a line. `droppable`: the line has no codes except G0 to G3, so that a cycle may leave out its unchanged words.
    Line {
        /// See the variant.
        droppable: bool,
    },
    /// A letter and a variable's value.
    Var {
        /// The letter as the form writes it.
        letter: u8,
        /// The variable.
        var: VarId,
        /// No space before it.
        glued: bool,
    },
    /// A variable's value alone.
    Value {
        /// The variable.
        var: VarId,
        /// No space before it.
        glued: bool,
    },
    /// A variable's value inside a comment of the program, which the control ignores.
    Remark {
        /// The variable.
        var: VarId,
        /// No space before it.
        glued: bool,
    },
    /// A letter and a number as typed.
    Literal {
        /// Row in [`Program::literals`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// Text as typed.
    Text {
        /// Row in [`Program::texts`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// Text in backquotes, which is never changed.
    Quote {
        /// Row in [`Program::texts`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// A letter and a calculated value.
    Formula {
        /// The letter as the form writes it.
        letter: u8,
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// A calculated value alone.
    ValueFormula {
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// A calculated value inside a comment of the program.
    RemarkFormula {
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No space before it.
        glued: bool,
    },
    /// `@set`: a variable or property gets a value.
    Set {
        /// Its row in [`Program::sets`].
        index: u32,
    },
    /// A property that is a text.
    PropertyText {
        /// Its row in the settings.
        row: u16,
        /// In a comment, where more characters are allowed than in words.
        in_comment: bool,
        /// No space before it.
        glued: bool,
    },
    /// A list follows: a row of [`Program::lists`].
    List {
        /// The row.
        index: u32,
    },
    /// A text of the job.
    TextVar {
        /// Which.
        var: TextVar,
        /// In a comment, where more characters are allowed than in words.
        in_comment: bool,
        /// No space before it.
        glued: bool,
    },
    /// Start of a comment with texts of the job. The comment is left out if all of them are empty.
    Comment {
        /// Number of its operations.
        words: u32,
    },
}

/// A literal word.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The letter.
    pub letter: u8,
    /// The whole word as typed.
    pub text: String,
    /// The number after the letter.
    pub value: f64,
    /// The printed code, if the word is one.
    pub code: Option<Code>,
}

/// Lines that print once for each tool, operation or work offset.
#[derive(Clone, Debug)]
pub struct List {
    /// Kind of the items.
    pub each: Each,
    /// Output for one item.
    pub routine: Routine,
}

/// Printing style of a canned cycle (render.md section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleStyle {
    /// One line, `End Cancel`: later holes print only the changes.
    Machine,
    /// One line, plain `End`: the whole line at every hole.
    WholeLine,
    /// Several lines, no count: all lines at every hole.
    Emulated,
    /// The first lines once, the others at every hole.
    Advanced,
    /// `None`: moves are generated.
    Generated,
}

/// A sequence printed when a variable changes.
#[derive(Clone, Debug)]
pub struct Upon {
    /// The variable.
    pub var: VarId,
    /// At every use.
    pub every: bool,
    /// The operations of the Upon sequence.
    pub routine: Routine,
}

/// A compiled form. It is immutable; many renderers may share it.
#[derive(Clone, Debug)]
pub struct Program {
    /// Settings from the commands.
    pub settings: Settings,
    /// All operations.
    pub ops: Vec<Op>,
    /// Location of each operation in the form; used only for errors and the source map.
    pub spans: Vec<Span>,
    /// Literal words.
    pub literals: Vec<Literal>,
    /// Texts.
    pub texts: Vec<String>,
    /// Formulas of values and conditions.
    pub formulas: Vec<Formula>,
    /// The `@set` directives: the variable or property, and the row of its value in `formulas`.
    pub sets: Vec<(Target, u32)>,
    /// The lists of `@for`.
    pub lists: Vec<List>,
    /// The texts of the job that the form uses anywhere.
    pub texts_printed: TextSet,
    /// Name of the form: from `Name`, else from its file.
    pub name: String,
    /// Hash of the form, if the form prints it.
    pub hash: String,
    /// The sequences, by [`SequenceId`].
    pub(super) routines: Vec<Option<Routine>>,
    /// The Upon sequences in the order of the form.
    pub upons: Vec<Upon>,
    /// The variables that some Upon watches.
    pub upon_vars: VarSet,
    /// The variables that the form prints anywhere.
    pub printed: VarSet,
    /// The variables in conditions and calculations.
    pub asked: VarSet,
    /// The form uses G codes for motions: its sequences type G0 to G3, or blocks of moves are generated.
    pub speaks_g: bool,
    /// The form's own sequences switch the spindle along the path (torch, laser), so that no spindle codes are generated.
    pub switches_spindle: bool,
    /// The form's work offset words, and the operations that print them.
    pub work: WorkWords,
    /// Letters of the form, for programs in inches and in millimetres.
    pub letters: [LetterTable; 2],
    /// Comments of the Custom cycles; each names the kind of cycle.
    pub custom: [Option<String>; 3],
}

impl Program {
    /// A sequence, if the form has it.
    #[inline]
    pub fn routine(&self, id: SequenceId) -> Option<&Routine> {
        self.routines[id as usize].as_ref()
    }

    /// The variables that the form prints, evaluates or watches.
    pub fn used(&self) -> VarSet {
        self.printed.with(self.asked).with(self.upon_vars)
    }

    /// Sets the name and the hash from the files of the form: the form itself first, then those that it calls.
    #[must_use]
    pub fn identified(mut self, files: &[Source]) -> Program {
        self.name.clone_from(&self.settings.name);
        if self.name.is_empty() {
            let file = files.first().map_or("", |file| file.name.rsplit(['/', '\\']).next().unwrap_or_default());
            self.name = file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned();
        }
        if self.texts_printed.has(TextId::Formhash) {
            let mut hash = Sha256::new();
            files.iter().for_each(|file| hash.update(&file.text));
            let hash = hash.finalize();
            self.hash = hash.iter().take(HASH_BYTES).map(|byte| format!("{byte:02x}")).collect();
        }
        self
    }

    pub(super) fn no_routines() -> Vec<Option<Routine>> {
        SEQUENCES.iter().map(|_| None).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_are_small() {
        assert!(size_of::<Op>() <= 8);
    }
}
