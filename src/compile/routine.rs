//! Routines: the operations of a sequence, and its branches.

use std::ops::Range;
use std::sync::Arc;

use super::program::{CycleStyle, Op, Program};
use super::sources::{BARE, Sources, Step, of_first_hole};
use crate::control::Code;
use crate::lang::{TextSet, VarId, VarSet};
use crate::sema::Target;
use crate::span::Span;

/// The operations of a sequence.
#[derive(Clone, Debug)]
pub struct Routine {
    /// Range in [`Program::ops`].
    pub ops: Range<usize>,
    /// The parts of `ops` that belong to branches that were not taken, in their order.
    pub left_out: Option<Arc<[Range<usize>]>>,
    /// The branches that were taken, one bit for each. The value is 0 if no branches were selected; `ops` then contains
    /// all branches.
    pub branches: u128,
    /// The branches of the sequence; `None` if it has no directives.
    pub flow: Option<Arc<Flow>>,
    /// Number of lines that are printed at the first hole only, if the sequence is a cycle with a count.
    pub count: Option<usize>,
    /// Start of the lines that a cycle with a count repeats. For all other sequences, the start of the sequence.
    pub repeat: usize,
    /// The variables that the routine prints outside comments.
    pub vars: VarSet,
    /// The texts of the job that the routine prints.
    pub texts: TextSet,
    /// The sources (variables and properties) of the words that a cycle prints only at its first hole.
    pub first_only: Sources,
    /// Whether the sequence ends with `End Cancel`.
    pub cancel: bool,
    /// Whether a cycle or a macro is still active after the last line, so that the control moves the axes by itself.
    pub stays: bool,
    /// How the sequence prints holes, if it is a canned cycle.
    pub style: CycleStyle,
    /// Whether the routine prints `[retplane]`, `[rplane]` or G98, so that the tool returns to the return plane.
    pub returns: bool,
    /// Location of the line with the name of the sequence.
    pub span: Span,
}

/// The branches of a sequence.
#[derive(Clone, Debug)]
pub struct Flow {
    /// The parts of the sequence in their order.
    pub nodes: Vec<Node>,
}

/// A part of a sequence that contains a directive.
#[derive(Clone, Debug)]
pub enum Node {
    /// Sets a variable or property. Later conditions may use the value that was set.
    Set(Target, u32),
    /// Branches. The first branch whose condition is true is taken.
    If(Vec<Branch>),
    /// A list: its row in [`Program::lists`], and the range of its operations, which have a routine of their own.
    List(u32, Range<usize>),
}

/// A branch.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Number of the bit of this branch.
    pub number: u32,
    /// Row of the branch's condition in [`Program::formulas`]. `None` for `@else`.
    pub condition: Option<u32>,
    /// Range of the branch's operations.
    pub ops: Range<usize>,
    /// The parts of the branch.
    pub nodes: Vec<Node>,
    /// Location of the directive.
    pub span: Span,
}

impl Routine {
    /// Whether the routine prints this variable or uses it in a condition.
    pub fn asks(&self, var: VarId, program: &Program) -> bool {
        self.vars.has(var) || self.tests(VarSet::of(&[var]), program)
    }

    /// Whether the routine uses any of these variables in a condition.
    pub fn tests(&self, vars: VarSet, program: &Program) -> bool {
        fn of(nodes: &[Node], vars: VarSet, program: &Program) -> bool {
            nodes.iter().any(|node| match node {
                Node::If(branches) => branches.iter().any(|branch| {
                    branch.condition.is_some_and(|row| program.formulas[row as usize].vars().meets(vars))
                        || of(&branch.nodes, vars, program)
                }),
                _ => false,
            })
        }
        self.flow.as_ref().is_some_and(|flow| of(&flow.nodes, vars, program))
    }

    /// Determines the properties of the routine from all its operations.
    pub(super) fn look_at(&mut self, program: &Program) {
        let (mut vars, mut texts) = (VarSet::default(), TextSet::default());
        let (mut lines, mut returns) = (0, false);
        let control = program.settings.codes();
        let mut repeat = self.ops.start;
        for i in self.steps() {
            let op = program.ops[i];
            if let Op::Line { .. } = op {
                if self.count == Some(lines) {
                    repeat = i;
                }
                lines += 1;
            }
            vars = vars.with(vars_of(op, program));
            if let Op::TextVar { var, .. } = op {
                texts.insert(var.id);
            }
            if let Op::Literal { index, .. } = op {
                let literal = &program.literals[index as usize];
                returns |= literal.letter == b'G' && literal.value == program.settings.return_plane[1];
            }
        }
        if self.count.is_some_and(|count| count >= lines) {
            repeat = self.ops.end;
        }
        self.repeat = repeat;
        self.vars = vars;
        self.texts = texts;
        self.stays = control.leaves_cycle(self.steps().filter_map(|i| typed_code(program.ops[i], program)));
        self.returns = returns || self.vars.has(VarId::Retplane) || self.vars.has(VarId::Rplane);
        let steps = self.steps().filter_map(|i| Some((step(program.ops[i], program)?, i >= repeat)));
        self.first_only = of_first_hole(steps, self.count.is_some());
    }

    /// The routine with these branches only.
    pub fn way(&self, branches: u128, program: &Program) -> Routine {
        let mut left_out = Vec::new();
        if let Some(flow) = &self.flow {
            leave_out(&flow.nodes, branches, &mut left_out);
        }
        let mut way = Routine { left_out: Some(left_out.into()), branches, flow: None, ..self.clone() };
        way.look_at(program);
        way
    }

    /// The operations of the routine that are not left out.
    #[inline]
    pub fn steps(&self) -> Steps<'_> {
        self.steps_in(self.ops.clone())
    }

    /// The operations in this range that are not left out.
    #[inline]
    pub fn steps_in(&self, part: Range<usize>) -> Steps<'_> {
        let left_out = self.left_out.as_deref().unwrap_or_default();
        Steps { left: part, left_out }
    }
}

/// Iterates over the indices of a routine's operations.
#[derive(Clone, Debug)]
pub struct Steps<'r> {
    left: Range<usize>,
    left_out: &'r [Range<usize>],
}

impl Iterator for Steps<'_> {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        while let [first, rest @ ..] = self.left_out
            && first.start <= self.left.start
        {
            self.left.start = self.left.start.max(first.end);
            self.left_out = rest;
        }
        self.left.next()
    }
}

impl DoubleEndedIterator for Steps<'_> {
    fn next_back(&mut self) -> Option<usize> {
        loop {
            let last = self.left.next_back()?;
            if !self.left_out.iter().any(|part| part.contains(&last)) {
                return Some(last);
            }
        }
    }
}

/// Collects the ranges of branches that are not taken.
fn leave_out(nodes: &[Node], branches: u128, left_out: &mut Vec<Range<usize>>) {
    for node in nodes {
        let all = match node {
            Node::If(all) => all,
            Node::List(_, ops) => {
                left_out.push(ops.clone());
                continue;
            }
            Node::Set(..) => continue,
        };
        for branch in all {
            if branches & 1 << branch.number == 0 {
                left_out.push(branch.ops.clone());
            } else {
                leave_out(&branch.nodes, branches, left_out);
            }
        }
    }
}

/// The variables that an operation prints outside comments.
fn vars_of(op: Op, program: &Program) -> VarSet {
    match op {
        Op::Var { var, .. } | Op::Value { var, .. } => VarSet::of(&[var]),
        Op::Formula { index, .. } | Op::ValueFormula { index, .. } => program.formulas[index as usize].vars(),
        _ => VarSet::default(),
    }
}

/// The G or M code of an operation, if the form contains the code as a number. A slash for block delete may precede the
/// code.
fn typed_code(op: Op, program: &Program) -> Option<Code> {
    match op {
        Op::Literal { index, .. } => {
            let literal = &program.literals[index as usize];
            Code::of(literal.letter, literal.value).filter(|_| literal.letter.is_ascii_uppercase())
        }
        Op::Text { index, .. } => {
            let word = program.texts[index as usize].strip_prefix('/')?;
            let letter = *word.as_bytes().first()?;
            Code::of(letter, word.get(1..)?.parse().ok()?).filter(|_| letter.is_ascii_uppercase())
        }
        _ => None,
    }
}

/// Converts an operation that prints or sets a value. `None` for other operations.
fn step(op: Op, program: &Program) -> Option<Step<'_>> {
    let printed = |letter: u8| program.letters[0][letter].printed;
    let formula = |index: u32| &program.formulas[index as usize];
    Some(match op {
        Op::Set { index } => {
            let (target, value) = program.sets[index as usize];
            Step::Sets(target, formula(value))
        }
        Op::Var { letter, var, .. } => Step::Var(printed(letter), var),
        Op::Formula { letter, index, .. } => Step::Formula(printed(letter), formula(index)),
        Op::Value { var, .. } => Step::Var(BARE, var),
        Op::ValueFormula { index, .. } => Step::Formula(BARE, formula(index)),
        _ => return None,
    })
}
