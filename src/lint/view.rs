//! A form as rules look at it: its bodies in one list, what its letters print, what it is for.

use crate::compile::LetterTable;
use crate::lang::{CommandId, Machine, SequenceId, VarId, VarSet};
use crate::sema::{Checked, Form, Line, Sequence, Settings, UnitChoice, Word};
use crate::span::Span;
use crate::syntax::{Piece, SequenceNode, Statement};

use super::blocks::{self, Block};

/// A form with what many rules ask of it.
pub struct View<'a> {
    /// Files, trees, and what they mean.
    pub checked: &'a Checked,
    /// What they mean.
    pub form: &'a Form,
    /// Its commands.
    pub settings: &'a Settings,
    /// What its letters print, in its own units.
    pub letters: LetterTable,
    /// Sequences and Upons in the order of the form.
    pub bodies: Vec<Body<'a>>,
}

/// What a body is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A sequence or canned cycle.
    Sequence(SequenceId),
    /// `Upon [var]`, `Upon Every [var]`.
    Upon(VarId, bool),
}

/// The lines of one sequence.
#[derive(Clone, Copy)]
pub struct Body<'a> {
    /// What for.
    pub purpose: Purpose,
    /// The name line.
    pub span: Span,
    /// The lines that print.
    pub lines: &'a [Line],
    /// The sequence itself; none for an Upon.
    pub sequence: Option<&'a Sequence>,
}

impl<'a> View<'a> {
    /// A view of a form.
    pub fn new(checked: &'a Checked) -> View<'a> {
        let form = &checked.form;
        let sequences = form.sequences.values().map(|sequence| Body {
            purpose: Purpose::Sequence(sequence.id),
            span: sequence.span,
            lines: &sequence.lines,
            sequence: Some(sequence),
        });
        let upons = form.upons.iter().map(|upon| Body {
            purpose: Purpose::Upon(upon.var, upon.every),
            span: upon.span,
            lines: &upon.lines,
            sequence: None,
        });
        View {
            checked,
            form,
            settings: &form.settings,
            letters: LetterTable::new(form, form.settings.units == UnitChoice::Mm),
            bodies: sequences.chain(upons).collect(),
        }
    }

    /// A sequence's body.
    pub fn body(&self, id: SequenceId) -> Option<Body<'a>> {
        self.bodies.iter().find(|body| body.purpose == Purpose::Sequence(id)).copied()
    }

    /// The bodies of these sequences, as far as the form has them.
    pub fn these<'s>(&'s self, ids: &'s [SequenceId]) -> impl Iterator<Item = Body<'a>> + 's {
        ids.iter().filter_map(|&id| self.body(id))
    }

    /// The canned cycles that make holes, with their own lines.
    pub fn hole_cycles(&self) -> impl Iterator<Item = (&'a Sequence, Body<'a>)> + '_ {
        self.bodies.iter().filter_map(|body| {
            let sequence = body.sequence.filter(|s| s.id.row().is_cycle && !s.is_none)?;
            let threads = matches!(sequence.id, SequenceId::AutoThread | SequenceId::CanThread | SequenceId::Cancel);
            (!threads).then_some((sequence, *body))
        })
    }

    /// Is the form for a mill?
    pub fn is_mill(&self) -> bool {
        self.settings.machine == Machine::Mill
    }

    /// Is the form for one of these controls?
    pub fn is_for(&self, controls: &[&str]) -> bool {
        controls.contains(&self.settings.control.as_str())
    }

    /// Do the form's own lengths count millimetres?
    pub fn is_metric(&self) -> bool {
        self.settings.units == UnitChoice::Mm
    }

    /// The variables that bodies print, outside comments.
    pub fn printed(&self) -> VarSet {
        let mut printed = VarSet::default();
        self.words().filter_map(Word::printed_var).for_each(|var| printed.insert(var));
        printed
    }

    /// The commands of all files with what they are.
    pub fn commands(&self) -> impl Iterator<Item = (CommandId, &'a Statement)> + '_ {
        let statements = self.checked.trees.iter().flat_map(|tree| tree.statements());
        statements.filter_map(|statement| Some((CommandId::parse(&statement.name.text)?, statement)))
    }

    /// Where the form gives a command, if it does.
    pub fn command(&self, id: CommandId) -> Option<&'a Statement> {
        self.commands().find(|(own, _)| *own == id).map(|(_, statement)| statement)
    }

    /// The sequence as it is written.
    pub fn node(&self, span: Span) -> Option<&'a SequenceNode> {
        self.checked.trees.iter().flat_map(|tree| tree.sequences()).find(|node| node.name.line.span == span)
    }

    /// The pieces of words as they are written.
    pub fn pieces(&self) -> impl Iterator<Item = &'a Piece> + '_ {
        self.checked.trees.iter().flat_map(|tree| tree.words()).flat_map(|word| &word.pieces)
    }

    /// The words of all bodies.
    pub fn words(&self) -> impl Iterator<Item = &'a Word> + '_ {
        self.bodies.iter().flat_map(|body| body.words())
    }

    /// The blocks of a body with the modes that hold in each.
    pub fn blocks(&self, body: Body<'a>) -> Vec<Block<'a>> {
        blocks::read(self, body)
    }

    /// The axis that a word of this letter moves: 0 and 1 across, 2 the depth; `None` for others.
    pub fn axis(&self, letter: u8) -> Option<usize> {
        self.settings.axes.iter().position(|&axis| axis == self.letters[letter].printed)
    }

    /// Does the letter turn a rotary axis?
    pub fn is_rotary(&self, letter: u8) -> bool {
        let printed = self.letters[letter].printed;
        b"ABC".contains(&printed) && self.axis(letter).is_none() && !self.settings.axes2.contains(&printed)
    }
}

impl<'a> Body<'a> {
    /// As messages name it.
    pub fn name(&self) -> String {
        match self.purpose {
            Purpose::Sequence(id) => id.name().to_owned(),
            Purpose::Upon(var, false) => format!("Upon [{}]", var.name()),
            Purpose::Upon(var, true) => format!("Upon Every [{}]", var.name()),
        }
    }

    /// Its words.
    pub fn words(&self) -> impl Iterator<Item = &'a Word> + use<'a> {
        self.lines.iter().flat_map(|line| &line.words)
    }

    /// Does it print this variable, for the control to read?
    pub fn prints(&self, var: VarId) -> bool {
        self.words().any(|word| word.printed_var() == Some(var))
    }

    /// Does it print one of these?
    pub fn prints_any(&self, vars: &[VarId]) -> bool {
        vars.iter().any(|&var| self.prints(var))
    }

    /// The word that prints a code as typed, `G43`.
    pub fn code(&self, letter: u8, codes: &[f64]) -> Option<&'a Word> {
        self.words().find(|word| word.is_code(letter, codes))
    }
}

/// The machine-cycle codes of controls: G73, G74, G76 and G81 to G89.
pub fn is_cycle_code(code: f64) -> bool {
    [73.0, 74.0, 76.0].contains(&code) || (81.0..90.0).contains(&code)
}

/// The words that a cycle of the control begins with: those up to the end of its block, or all where there is none.
pub fn first_block<'a>(body: &Body<'a>) -> impl Iterator<Item = &'a Word> + use<'a> {
    let cycle =
        body.lines.iter().position(|line| line.words.iter().any(|word| word.typed(b'G').is_some_and(is_cycle_code)));
    let lines = &body.lines[..cycle.map_or(body.lines.len(), |at| at + 1)];
    lines.iter().flat_map(|line| &line.words)
}

/// Does one of these words print one of these variables?
pub fn says<'a>(mut words: impl Iterator<Item = &'a Word>, vars: &[VarId]) -> bool {
    words.any(|word| word.printed_var().is_some_and(|var| vars.contains(&var)))
}

/// The word that starts a cycle of the control, if the body has one.
pub fn cycle_word<'a>(body: &Body<'a>) -> Option<(&'a Word, f64)> {
    body.words().find_map(|word| word.typed(b'G').filter(|&code| is_cycle_code(code)).map(|code| (word, code)))
}
