//! A form prepared for the rules: its sequences (bodies), the formats of its letters, and its settings.

use crate::compile::LetterTable;
use crate::control::{Code, Control, Meaning, Traits};
use crate::lang::{CommandId, Each, Machine, SequenceId, UnitChoice, VarId, VarSet};
use crate::sema::{Checked, Form, Line, Sequence, Settings, Step, Word, before_remark, each_formula, line_counts};
use crate::span::Span;
use crate::syntax::{self, Piece, SequenceNode, Statement};
use crate::toolpath::CycleKind;

use super::blocks::{self, Block};

/// A form with data that several rules need.
pub struct View<'a> {
    /// Files, syntax trees and their meaning.
    pub checked: &'a Checked,
    /// The analysed form, from all files together.
    pub form: &'a Form,
    /// Settings from the form's commands.
    pub settings: &'a Settings,
    /// How each letter is printed, in the form's own units.
    pub letters: LetterTable,
    /// The bodies of sequences and Upons, in the order of the form.
    pub bodies: Vec<Body<'a>>,
    /// Blocks of each body, in the order of `bodies`.
    blocks: Vec<Vec<Block<'a>>>,
    /// Whether a letter has a format of its own.
    has_format: [bool; 256],
    /// The variables that the form prints outside comments.
    printed: VarSet,
    /// Variables that the form prints, in comments too.
    told: VarSet,
    /// Whether a word of the form begins with this letter.
    has_words: [bool; 256],
    /// Whether some body starts a cycle of the control.
    has_cycles: bool,
}

/// The purpose of a body.
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
    /// Purpose of the body.
    pub purpose: Purpose,
    /// Index of this body in [`View::bodies`].
    index: usize,
    /// The name line of the body.
    pub span: Span,
    /// The lines that print.
    pub lines: &'a [Line],
    /// The directives that select the lines, if there are any.
    pub steps: Option<&'a [Step]>,
    /// The sequence itself; `None` for an Upon.
    pub sequence: Option<&'a Sequence>,
    /// The control whose code table applies.
    codes: &'static Control,
}

impl<'a> View<'a> {
    /// Prepares a form for the rules.
    pub fn new(checked: &'a Checked) -> View<'a> {
        let form = &checked.form;
        let codes = form.settings.codes();
        let sequences = form.sequences.values().map(|sequence| Body {
            purpose: Purpose::Sequence(sequence.id),
            index: 0,
            span: sequence.span,
            lines: &sequence.lines,
            steps: sequence.steps.as_deref(),
            sequence: Some(sequence),
            codes,
        });
        let upons = form.upons.iter().map(|upon| Body {
            purpose: Purpose::Upon(upon.var, upon.every),
            index: 0,
            span: upon.span,
            lines: &upon.lines,
            steps: upon.steps.as_deref(),
            sequence: None,
            codes,
        });
        let bodies: Vec<Body> =
            sequences.chain(upons).enumerate().map(|(index, body)| Body { index, ..body }).collect();
        let (mut printed, mut told, mut has_words) = (VarSet::default(), VarSet::default(), [false; 256]);
        for word in bodies.iter().flat_map(|body| body.words()) {
            printed = printed.with(word.printed_vars());
            told = told.with(word.told_vars());
            word.letter().into_iter().for_each(|letter| has_words[usize::from(letter)] = true);
        }
        for body in &bodies {
            // a variable in a condition counts as printed, because it influences the output
            each_formula(body.steps.unwrap_or_default(), &mut |formula, _| {
                printed = printed.with(formula.vars());
                told = told.with(formula.vars());
            });
        }
        let has_cycles = bodies.iter().any(|body| body.cycle_word().is_some());
        let mut has_format = [false; 256];
        form.formats.keys().chain(form.packed.keys()).for_each(|&letter| has_format[usize::from(letter)] = true);
        let mut view = View {
            checked,
            form,
            settings: &form.settings,
            letters: LetterTable::new(form, form.settings.units == UnitChoice::Mm),
            bodies,
            blocks: Vec::new(),
            has_format,
            printed,
            told,
            has_words,
            has_cycles,
        };
        let axis = |word: &Word| word.letter().and_then(|letter| view.axis(letter));
        view.blocks = view.bodies.iter().map(|body| blocks::read(view.settings, axis, body.lines)).collect();
        view
    }

    /// The body of a sequence.
    pub fn body(&self, id: SequenceId) -> Option<Body<'a>> {
        self.bodies.iter().find(|body| body.purpose == Purpose::Sequence(id)).copied()
    }

    /// The bodies of these sequences that the form has.
    pub fn these<'s>(&'s self, ids: &'s [SequenceId]) -> impl Iterator<Item = Body<'a>> + 's {
        ids.iter().filter_map(|&id| self.body(id))
    }

    /// The canned cycles that make holes and have lines of their own.
    pub fn hole_cycles(&self) -> impl Iterator<Item = (&'a Sequence, Body<'a>)> + '_ {
        self.bodies.iter().filter_map(|body| {
            let sequence = body.sequence.filter(|sequence| sequence.id.makes_holes() && !sequence.is_none)?;
            Some((sequence, *body))
        })
    }

    /// The canned cycles of these kinds. A Custom cycle has the kind that its comment names.
    pub fn cycles_for<'s>(&'s self, ids: &'s [SequenceId]) -> impl Iterator<Item = Body<'a>> + 's {
        self.hole_cycles().filter(|(sequence, _)| ids.contains(&serves(sequence))).map(|(_, body)| body)
    }

    /// Whether the form is for a mill.
    pub fn is_mill(&self) -> bool {
        self.settings.machine == Machine::Mill
    }

    /// The traits of the form's control.
    pub fn traits(&self) -> &'static Traits {
        self.settings.control().traits()
    }

    /// The meaning of a word's code on the form's control, if the word is a code.
    pub fn meaning(&self, word: &Word) -> Option<Meaning> {
        self.settings.codes().meaning(word.code()?)
    }

    /// The axes along which a move by this code cancels the tool length offset on the form's control, as bits.
    pub fn ends_length(&self, word: &Word) -> u8 {
        let row = word.code().and_then(|code| self.settings.control().row(code));
        row.map_or(0, |row| row.runs.ends_length)
    }

    /// Whether a word starts a cycle of the control.
    pub fn starts_cycle(&self, word: &Word) -> bool {
        self.meaning(word).is_some_and(Meaning::is_cycle)
    }

    /// Whether the form never prints the depth axis. Forms for torches and lasers never print the depth axis.
    pub fn is_flat(&self) -> bool {
        if self.settings.beam.is_some() {
            return true;
        }
        let own = [SequenceId::RapidCode, SequenceId::LineCode];
        let all = own.iter().all(|&id| self.body(id).is_some_and(|body| !body.lines.is_empty()));
        self.is_mill() && all && !self.words().any(|word| self.is_depth(word))
    }

    /// Whether a word moves the depth axis.
    pub fn is_depth(&self, word: &Word) -> bool {
        word.letter().and_then(|letter| self.axis(letter)) == Some(2)
    }

    /// Whether a cycle of a lathe cuts once and then ends, as G74 to G76 on a Fanuc.
    pub fn works_once(&self, code: Code) -> bool {
        let meaning = self.settings.control().of_lathe().meaning(code);
        !self.is_mill() && matches!(meaning, Some(Meaning::FacePecks | Meaning::GroovePecks | Meaning::ThreadCycle))
    }

    /// Whether the form's own lengths are in millimetres.
    pub fn is_metric(&self) -> bool {
        self.settings.units == UnitChoice::Mm
    }

    /// The variables that the form prints outside comments.
    pub fn printed(&self) -> VarSet {
        self.printed
    }

    /// Whether the form prints this variable, in comments too.
    pub fn tells(&self, var: VarId) -> bool {
        self.told.has(var)
    }

    /// Whether a body has words with this letter.
    pub fn has_words_of(&self, letter: u8) -> bool {
        self.has_words[usize::from(letter)]
    }

    /// Whether a body has a cycle of the control.
    pub fn has_cycles(&self) -> bool {
        self.has_cycles
    }

    /// The commands of all files, with their identifiers.
    pub fn commands(&self) -> impl Iterator<Item = (CommandId, &'a Statement)> + '_ {
        let statements = self.checked.trees.iter().flat_map(|tree| tree.statements());
        statements.filter_map(|statement| Some((CommandId::parse(&statement.name.text)?, statement)))
    }

    /// The statement of a command, if the form has it.
    pub fn command(&self, id: CommandId) -> Option<&'a Statement> {
        self.commands().find(|(own, _)| *own == id).map(|(_, statement)| statement)
    }

    /// The tree node of a sequence.
    pub fn node(&self, span: Span) -> Option<&'a SequenceNode> {
        self.checked.trees.iter().flat_map(|tree| tree.sequences()).find(|node| node.name.line.span == span)
    }

    /// The lines of all sequences as written in the form.
    pub fn written_lines(&self) -> impl Iterator<Item = &'a syntax::Body> + use<'a> {
        self.checked.trees.iter().flat_map(|tree| tree.sequences()).flat_map(|node| &node.body)
    }

    /// The words as written in the form, without comments that extend to the end of the block.
    pub fn written(&self) -> impl Iterator<Item = &'a syntax::Word> + '_ {
        self.written_lines().flat_map(|body| self.codes(&body.words))
    }

    /// The words of a line that come before a comment that extends to the end of the block.
    pub fn codes<'s>(&self, words: &'s [syntax::Word]) -> &'s [syntax::Word] {
        &words[..before_remark(words, &self.settings.comment)]
    }

    /// The pieces of all words as written in the form.
    pub fn pieces(&self) -> impl Iterator<Item = &'a Piece> + '_ {
        self.written().flat_map(|word| &word.pieces)
    }

    /// The words of all bodies.
    pub fn words(&self) -> impl Iterator<Item = &'a Word> + '_ {
        self.bodies.iter().flat_map(|body| body.words())
    }

    /// The blocks of a body with their modes.
    pub fn blocks(&self, body: Body<'a>) -> &[Block<'a>] {
        &self.blocks[body.index]
    }

    /// The letter that the word has in the program, after `Rename`.
    pub fn printed_letter(&self, word: &Word) -> Option<u8> {
        word.letter().map(|letter| self.letters[letter].printed)
    }

    /// The letter whose format applies to the word. A lower-case letter without a format uses the format of its capital letter.
    pub fn format_letter(&self, word: &Word) -> Option<u8> {
        let letter = word.letter()?;
        Some(if self.has_format[usize::from(letter)] { letter } else { letter.to_ascii_uppercase() })
    }

    /// The axis that a word with this letter moves: 0 and 1 are the axes of the plane, 2 is the depth axis. `None`: the letter moves no axis.
    pub fn axis(&self, letter: u8) -> Option<usize> {
        self.settings.axes.iter().position(|&axis| axis == self.letters[letter].printed)
    }

    /// Whether the letter turns a rotary axis.
    pub fn is_rotary(&self, letter: u8) -> bool {
        let printed = self.letters[letter].printed;
        b"ABC".contains(&printed) && self.axis(letter).is_none() && !self.settings.axes2.contains(&printed)
    }
}

impl<'a> Body<'a> {
    /// Calls `take` for each list (`@for`), also for a list inside a list: the kind of its items, its steps and its
    /// location.
    pub fn each_list(&self, take: &mut dyn FnMut(Each, &'a [Step], Span)) {
        each_list(self.steps.unwrap_or_default(), take);
    }

    /// Maximum number of lines that the body prints. Of each condition, only one branch is counted.
    pub fn most_lines(&self) -> usize {
        self.steps.map_or(self.lines.len(), |steps| line_counts(steps).1)
    }

    /// Name of the body, for messages.
    pub fn name(&self) -> String {
        match self.purpose {
            Purpose::Sequence(id) => id.name().to_owned(),
            Purpose::Upon(var, false) => format!("Upon [{}]", var.name()),
            Purpose::Upon(var, true) => format!("Upon Every [{}]", var.name()),
        }
    }

    /// Words of the body, line after line.
    pub fn words(&self) -> impl Iterator<Item = &'a Word> + use<'a> {
        self.lines.iter().flat_map(|line| &line.words)
    }

    /// The index of the line that contains this word.
    pub fn line_of(&self, word: &Word) -> usize {
        self.lines.iter().position(|line| line.words.iter().any(|own| std::ptr::eq(own, word))).unwrap_or(0)
    }

    /// Whether the body prints this variable outside comments.
    pub fn prints(&self, var: VarId) -> bool {
        self.words().any(|word| word.printed_vars().has(var))
    }

    /// Whether the body prints one of these variables outside comments.
    pub fn prints_any(&self, vars: &[VarId]) -> bool {
        vars.iter().any(|&var| self.prints(var))
    }

    /// The word that is one of these codes, as `G43`.
    pub fn code(&self, letter: u8, codes: &[f64]) -> Option<&'a Word> {
        self.words().find(|word| word.is_code(letter, codes))
    }

    /// The word that starts a cycle of the control, with its code.
    pub fn cycle_word(&self) -> Option<(&'a Word, Code)> {
        let starts = |code: &Code| self.codes.meaning(*code).is_some_and(Meaning::is_cycle);
        self.words().find_map(|word| Some((word, word.code().filter(starts)?)))
    }

    /// The first word whose code has this meaning.
    pub fn meaning(&self, is: impl Fn(Meaning) -> bool) -> Option<&'a Word> {
        self.words().find(|word| word.code().and_then(|code| self.codes.meaning(code)).is_some_and(&is))
    }

    /// Whether some code of the body makes the control move the axes without axis words, as a cycle does.
    pub fn moves_by_itself(&self) -> bool {
        self.words().any(|word| word.code().is_some_and(|code| self.codes.moves_by_itself(code)))
    }

    /// Whether a cycle of the control is still active after the last word of the body.
    pub fn leaves_cycle(&self) -> bool {
        self.codes.leaves_cycle(self.words().filter_map(Word::code))
    }

    /// Whether one of these variables is printed before or in the block that starts a cycle of the control. If no block
    /// starts a cycle, all lines of the body are searched.
    pub fn begins_with(&self, vars: &[VarId]) -> bool {
        let starts = |word: &Word| word.code().and_then(|code| self.codes.meaning(code)).is_some_and(Meaning::is_cycle);
        let cycle = self.lines.iter().position(|line| line.words.iter().any(starts));
        let mut words = self.lines[..cycle.map_or(self.lines.len(), |at| at + 1)].iter().flat_map(|line| &line.words);
        words.any(|word| word.printed_vars().meets(VarSet::of(vars)))
    }
}

/// The sequence for the kind of hole that a canned cycle makes. For a Custom cycle, this is the sequence that the
/// comment of the cycle names. For any other cycle, this is the cycle itself.
pub fn serves(sequence: &Sequence) -> SequenceId {
    let kind = sequence.custom_kind().and_then(CycleKind::parse);
    kind.and_then(CycleKind::sequence).unwrap_or(sequence.id)
}

fn each_list<'a>(steps: &'a [Step], take: &mut dyn FnMut(Each, &'a [Step], Span)) {
    for step in steps {
        match step {
            Step::For(each, inner, span) => {
                take(*each, inner, *span);
                each_list(inner, take);
            }
            Step::If(arms) => arms.iter().for_each(|arm| each_list(&arm.steps, take)),
            Step::Lines(_) | Step::Set(..) => {}
        }
    }
}
