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

/// The number of printed bytes of a form's hash.
const HASH_BYTES: usize = 6;

/// One operation. The type is small in memory, because a long job may run hundreds of millions of operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// Start of a line. `droppable`: the only codes in the line are G0 to G3, so a cycle may leave out unchanged words
    /// of the line.
    Line {
        /// The meaning of `droppable` is explained at `Line`.
        droppable: bool,
    },
    /// A letter and the value of a variable.
    Var {
        /// The letter as the form writes it.
        letter: u8,
        /// The variable.
        var: VarId,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// The value of a variable without a letter.
    Value {
        /// The variable.
        var: VarId,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// The value of a variable inside a comment of the program. The control ignores comments.
    Remark {
        /// The variable.
        var: VarId,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// A letter and a number, printed as written in the form.
    Literal {
        /// Row in [`Program::literals`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// Text, printed as written in the form.
    Text {
        /// Row in [`Program::texts`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// Text in backquotes, which is never changed.
    Quote {
        /// Row in [`Program::texts`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// A letter and a calculated value.
    Formula {
        /// The letter as the form writes it.
        letter: u8,
        /// Row in [`Program::formulas`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// A calculated value without a letter.
    ValueFormula {
        /// Row in [`Program::formulas`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// A calculated value inside a comment of the program.
    RemarkFormula {
        /// Row in [`Program::formulas`].
        index: u32,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// Sets a variable or a property (`@set`).
    Set {
        /// Row in [`Program::sets`].
        index: u32,
    },
    /// A property with a text value.
    PropertyText {
        /// Row of the property in the settings.
        row: u16,
        /// Whether the text is in a comment, where more characters are allowed than in words.
        in_comment: bool,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// Start of a list, which is a row of [`Program::lists`].
    List {
        /// Row of the list.
        index: u32,
    },
    /// A text of the job.
    TextVar {
        /// The text to print, and its width.
        var: TextVar,
        /// Whether the text is in a comment, where more characters are allowed than in words.
        in_comment: bool,
        /// Whether there is no space before the printed text.
        glued: bool,
    },
    /// Start of a comment with texts of the job. If all these texts are empty, the comment is not printed.
    Comment {
        /// Number of operations in the comment.
        words: u32,
    },
}

/// A word with a letter and a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The letter.
    pub letter: u8,
    /// The whole word as written in the form.
    pub text: String,
    /// The number after the letter.
    pub value: f64,
    /// The code, if the word is a G or M code.
    pub code: Option<Code>,
}

/// Lines that print once for each tool, operation or work offset (`@for`).
#[derive(Clone, Debug)]
pub struct List {
    /// Kind of the items.
    pub each: Each,
    /// The operations for one item.
    pub routine: Routine,
}

/// How a canned cycle prints its holes (docs/rendering.md, "Canned cycles").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleStyle {
    /// One line, with `End Cancel`: the whole line is printed at the first hole, and only changed words at later holes.
    Machine,
    /// One line, with `End` alone: the whole line is printed at every hole.
    WholeLine,
    /// Several lines without a count: all lines are printed at every hole.
    Emulated,
    /// Several lines with a count: the first lines are printed once, and the other lines at every hole.
    Advanced,
    /// `None`: postform generates the moves.
    Generated,
}

/// A sequence that is printed when a variable changes, or whenever the variable is used.
#[derive(Clone, Debug)]
pub struct Upon {
    /// The variable that triggers the sequence.
    pub var: VarId,
    /// Whether the sequence is printed at every use of the variable.
    pub every: bool,
    /// The operations of the sequence.
    pub routine: Routine,
}

/// A compiled form, which is immutable, so many renderers may share it.
#[derive(Clone, Debug)]
pub struct Program {
    /// Settings from the commands.
    pub settings: Settings,
    /// All operations.
    pub ops: Vec<Op>,
    /// Location of each operation in the form. Only errors and the source map use the locations.
    pub spans: Vec<Span>,
    /// The words with a letter and a number.
    pub literals: Vec<Literal>,
    /// Texts.
    pub texts: Vec<String>,
    /// Formulas of values and conditions.
    pub formulas: Vec<Formula>,
    /// The `@set` directives: the variable or property to set, and the row of its value in `formulas`.
    pub sets: Vec<(Target, u32)>,
    /// The lists of `@for`.
    pub lists: Vec<List>,
    /// The texts of the job that the form prints or uses.
    pub texts_printed: TextSet,
    /// Name of the form: from the command `Name`, otherwise from the form's file.
    pub name: String,
    /// Hash of the form, if the form prints it.
    pub hash: String,
    /// The sequences, by [`SequenceId`].
    pub(super) routines: Vec<Option<Routine>>,
    /// The Upon sequences in the order of the form.
    pub upons: Vec<Upon>,
    /// The variables that trigger some Upon sequence.
    pub upon_vars: VarSet,
    /// The variables that some sequence prints.
    pub printed: VarSet,
    /// The variables that conditions and calculations use.
    pub asked: VarSet,
    /// Whether the form uses G codes for motions: its sequences print G0 to G3, or postform generates blocks of moves.
    pub speaks_g: bool,
    /// Whether the form's own sequences switch a torch or laser along the path. postform then generates no spindle codes.
    pub switches_spindle: bool,
    /// The words with which the form prints its work offset, and the operations that print it.
    pub work: WorkWords,
    /// The letters of the form, for programs in inches and for programs in millimetres.
    pub letters: [LetterTable; 2],
    /// The comments of the Custom cycles. Each comment names the kind of cycle.
    pub custom: [Option<String>; 3],
}

impl Program {
    /// The routine of a sequence, if the form has the sequence.
    #[inline]
    pub fn routine(&self, id: SequenceId) -> Option<&Routine> {
        self.routines[id as usize].as_ref()
    }

    /// The variables that the form prints or evaluates, or that trigger an Upon sequence.
    pub fn used(&self) -> VarSet {
        self.printed.with(self.asked).with(self.upon_vars)
    }

    /// Sets the name and the hash of the form from its files: the main file first, then the files that it calls.
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
