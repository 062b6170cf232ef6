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

/// How much of a form's hash is printed.
const HASH_BYTES: usize = 6;

/// One operation. Small, because a long job runs them by the hundred million.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// A line begins. `droppable`: it has no code but G0 to G3, so a cycle may drop its unchanged words.
    Line {
        /// See above.
        droppable: bool,
    },
    /// A letter and a variable's value.
    Var {
        /// The letter as the form writes it.
        letter: u8,
        /// The variable.
        var: VarId,
        /// No blank before it.
        glued: bool,
    },
    /// A variable's value alone.
    Value {
        /// The variable.
        var: VarId,
        /// No blank before it.
        glued: bool,
    },
    /// A variable's value inside a comment of the program: no control reads it.
    Remark {
        /// The variable.
        var: VarId,
        /// No blank before it.
        glued: bool,
    },
    /// A letter and a number as typed.
    Literal {
        /// Row in [`Program::literals`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// Text as typed.
    Text {
        /// Row in [`Program::texts`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// Text in backquotes, which nothing changes.
    Quote {
        /// Row in [`Program::texts`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// A letter and a calculated value.
    Formula {
        /// The letter as the form writes it.
        letter: u8,
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// A calculated value alone.
    ValueFormula {
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// A calculated value inside a comment of the program.
    RemarkFormula {
        /// Its row in [`Program::formulas`].
        index: u32,
        /// No blank before it.
        glued: bool,
    },
    /// A variable of the form has another value from here on.
    Set {
        /// Its row in [`Program::sets`].
        index: u32,
    },
    /// A property that is a text.
    PropertyText {
        /// Its row in the settings.
        row: u16,
        /// In a comment, which holds more characters than words do.
        in_comment: bool,
        /// No blank before it.
        glued: bool,
    },
    /// What follows is a list: a row of [`Program::lists`].
    List {
        /// The row.
        index: u32,
    },
    /// A text of the job.
    TextVar {
        /// Which.
        var: TextVar,
        /// In a comment, which holds more characters than words do.
        in_comment: bool,
        /// No blank before it.
        glued: bool,
    },
    /// A comment begins that holds texts of the job: where all of them are empty it is left out.
    Comment {
        /// How many operations it has.
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
    /// The code that it prints, if it is one.
    pub code: Option<Code>,
}

/// Lines that print once for each tool, operation or work offset.
#[derive(Clone, Debug)]
pub struct List {
    /// What it goes through.
    pub each: Each,
    /// What it prints for one of them.
    pub routine: Routine,
}

/// How a canned cycle prints (render.md section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleStyle {
    /// One line, `End Cancel`: later holes print what changed.
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
    /// What the commands say.
    pub settings: Settings,
    /// All operations.
    pub ops: Vec<Op>,
    /// The place of each operation; read on errors and for the source map only.
    pub spans: Vec<Span>,
    /// Literal words.
    pub literals: Vec<Literal>,
    /// Texts.
    pub texts: Vec<String>,
    /// What is calculated: values and conditions.
    pub formulas: Vec<Formula>,
    /// What `@set` gives values: the variable or property, and the value's row in `formulas`.
    pub sets: Vec<(Target, u32)>,
    /// What `@for` goes through.
    pub lists: Vec<List>,
    /// The texts of the job that the form prints anywhere.
    pub texts_printed: TextSet,
    /// Name of the form: as it says, else as its file is called.
    pub name: String,
    /// What tells it from other forms, where it prints that.
    pub hash: String,
    /// The sequences, by [`SequenceId`].
    pub(super) routines: Vec<Option<Routine>>,
    /// The Upon sequences in the order of the form.
    pub upons: Vec<Upon>,
    /// The variables that some Upon watches.
    pub upon_vars: VarSet,
    /// The variables that the form prints anywhere.
    pub printed: VarSet,
    /// The variables that conditions and calculations ask.
    pub asked: VarSet,
    /// The form says motions by G codes: its sequences type G0 to G3, or blocks of moves are generated.
    pub speaks_g: bool,
    /// The form's own sequences switch the spindle along the path (torch, laser): none is generated between them.
    pub switches_spindle: bool,
    /// How the form prints its work offset, and which operations do.
    pub work: WorkWords,
    /// What the form says of each letter, for programs in inches and in millimetres.
    pub letters: [LetterTable; 2],
    /// Remarks of the Custom cycles: the kind that each serves.
    pub custom: [Option<String>; 3],
}

impl Program {
    /// A sequence, if the form has it.
    #[inline]
    pub fn routine(&self, id: SequenceId) -> Option<&Routine> {
        self.routines[id as usize].as_ref()
    }

    /// The variables whose values it prints or asks for.
    pub fn used(&self) -> VarSet {
        self.printed.with(self.asked).with(self.upon_vars)
    }

    /// Gives it its name and what tells it from other forms, from its files: the form first, then those that it calls.
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
