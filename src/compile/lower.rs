//! Converts the lines of a form to operations.

use super::find_work::find_work;
use super::letters::LetterTable;
use super::program::{CycleStyle, List, Literal, Op, Program, Upon};
use super::routine::{Branch, Flow, Node, Routine};
use super::sources::Sources;
use super::work::WorkWords;
use std::ops::Range;
use std::sync::Arc;

use crate::control::{Code, Group, Meaning};
use crate::lang::{SequenceId, TextSet, VarId, VarSet};
use crate::sema::{Form, Formula, Line, NamePart, Sequence, Step, WordKind, line_counts};
use crate::span::Span;

/// Compiles a form that was checked and has no errors.
pub fn compile(form: &Form) -> Program {
    let mut program = Program {
        settings: form.settings.clone(),
        ops: Vec::new(),
        spans: Vec::new(),
        literals: Vec::new(),
        texts: Vec::new(),
        formulas: Vec::new(),
        sets: Vec::new(),
        lists: Vec::new(),
        texts_printed: TextSet::default(),
        name: String::new(),
        hash: String::new(),
        routines: Program::no_routines(),
        upons: Vec::new(),
        upon_vars: VarSet::default(),
        printed: VarSet::default(),
        asked: VarSet::default(),
        speaks_g: false,
        switches_spindle: false,
        work: WorkWords::default(),
        letters: [LetterTable::new(form, false), LetterTable::new(form, true)],
        custom: [None, None, None],
    };
    for part in &program.settings.program_name.0 {
        if let NamePart::Text(id) = part {
            program.texts_printed.insert(*id);
        }
    }
    for sequence in form.sequences.values() {
        let routine = lower_sequence(&mut program, sequence);
        program.printed = program.printed.with(routine.vars);
        program.routines[sequence.id as usize] = Some(routine);
        let custom = match sequence.id {
            SequenceId::Custom1 => 0,
            SequenceId::Custom2 => 1,
            SequenceId::Custom3 => 2,
            _ => continue,
        };
        program.custom[custom].clone_from(&sequence.remark);
    }
    for upon in &form.upons {
        let routine = lower(&mut program, &upon.lines, upon.steps.as_deref(), None, upon.span);
        program.printed = program.printed.with(routine.vars);
        program.upon_vars.insert(upon.var);
        program.upons.push(Upon { var: upon.var, every: upon.every, routine });
    }
    program.speaks_g = speaks_g(&program);
    program.switches_spindle = program.settings.beam.is_some() || switches_spindle(&program);
    program.work = find_work(&program);
    program
}

fn speaks_g(program: &Program) -> bool {
    let generated = [SequenceId::RapidCode, SequenceId::LineCode].iter().any(|&id| program.routine(id).is_none());
    let motion = |word: &Literal| {
        let code = Code::of(word.letter, word.value).filter(|_| word.letter == b'G');
        let meaning = code.and_then(|code| program.settings.codes().meaning(code));
        let moves = |meaning: Meaning| matches!(meaning.group(), Some(Group::Motion | Group::Plane));
        meaning.is_some_and(|meaning| moves(meaning) && meaning != Meaning::CycleEnd)
    };
    generated || program.literals.iter().any(motion)
}

/// Whether the form's own sequences switch the torch or laser. This is so in two cases: the sequences for parts of the
/// path print both M5 and M3 or M4, or a sequence for moves prints the speed.
fn switches_spindle(program: &Program) -> bool {
    use SequenceId as S;
    const PARTS: [SequenceId; 14] = [
        S::BeginLeadin,
        S::EndLeadin,
        S::BeginLeadout,
        S::EndLeadout,
        S::BeginPlunge,
        S::EndPlunge,
        S::BeginRetract,
        S::EndRetract,
        S::BeginSideStep,
        S::EndSideStep,
        S::BeginZLevel,
        S::EndZLevel,
        S::BeginRow,
        S::EndRow,
    ];
    const MOVES: [SequenceId; 4] = [S::RapidCode, S::LineCode, S::CwCode, S::CcwCode];
    let routines = |ids: &'static [SequenceId]| ids.iter().filter_map(|&id| program.routine(id));
    let types = |turns: bool| {
        let answers = |op: &Op| match op {
            Op::Literal { index, .. } => {
                let Literal { letter, value, .. } = program.literals[*index as usize];
                let code = Code::of(letter, value).filter(|_| letter == b'M');
                let group = code.and_then(|code| program.settings.codes().group(code));
                group == Some(Group::Spindle) && turns == (value != program.settings.spindle[2])
            }
            _ => false,
        };
        routines(&PARTS).any(|routine| program.ops[routine.ops.clone()].iter().any(answers))
    };
    types(true) && types(false) || routines(&MOVES).any(|routine| routine.vars.has(VarId::Speed))
}

fn lower_sequence(program: &mut Program, sequence: &Sequence) -> Routine {
    let mut routine = lower(program, &sequence.lines, sequence.steps.as_deref(), sequence.count, sequence.span);
    routine.cancel = sequence.cancel.is_some();
    let lines = sequence.steps.as_ref().map_or(sequence.lines.len(), |steps| line_counts(steps).1);
    routine.style = match (sequence.is_none, sequence.count, lines) {
        (true, ..) => CycleStyle::Generated,
        (_, Some(_), _) => CycleStyle::Advanced,
        (_, None, 0 | 1) if routine.cancel => CycleStyle::Machine,
        (_, None, 0 | 1) => CycleStyle::WholeLine,
        _ => CycleStyle::Emulated,
    };
    routine
}

/// Converts the lines of a body to operations. The first `count` lines are printed at the first hole only.
fn lower(program: &mut Program, lines: &[Line], steps: Option<&[Step]>, count: Option<usize>, span: Span) -> Routine {
    let start = program.ops.len();
    let flow = match steps {
        None => {
            lines.iter().for_each(|line| lower_line(program, line));
            None
        }
        Some(steps) => Some(Arc::new(Flow { nodes: lower_steps(program, lines, steps, &mut 0) })),
    };
    let mut routine = routine(start..program.ops.len(), flow, count, span);
    routine.look_at(program);
    program.texts_printed = program.texts_printed.with(routine.texts);
    routine
}

/// A routine whose operations are not analysed yet.
fn routine(ops: Range<usize>, flow: Option<Arc<Flow>>, count: Option<usize>, span: Span) -> Routine {
    Routine {
        repeat: ops.start,
        ops,
        left_out: None,
        branches: 0,
        flow,
        count,
        vars: VarSet::default(),
        texts: TextSet::default(),
        first_only: Sources::default(),
        cancel: false,
        stays: false,
        style: CycleStyle::Emulated,
        returns: false,
        span,
    }
}

fn lower_steps(program: &mut Program, lines: &[Line], steps: &[Step], branches: &mut u32) -> Vec<Node> {
    let mut nodes = Vec::new();
    for step in steps {
        match step {
            Step::Lines(range) => lines[range.clone()].iter().for_each(|line| lower_line(program, line)),
            Step::Set(target, value, span) => {
                let index = asked(program, value);
                program.ops.push(Op::Set { index: program.sets.len() as u32 });
                program.sets.push((*target, index));
                program.spans.push(*span);
                nodes.push(Node::Set(*target, index));
            }
            Step::For(each, steps, span) => {
                let index = program.lists.len() as u32;
                program.ops.push(Op::List { index });
                program.spans.push(*span);
                let start = program.ops.len();
                // reserve the row now, because the lists inside this list get later rows
                program.lists.push(List { each: *each, routine: routine(start..start, None, None, *span) });
                let inner = lower_steps(program, lines, steps, branches);
                let ops = start..program.ops.len();
                let mut body = routine(ops.clone(), Some(Arc::new(Flow { nodes: inner })), None, *span);
                body.look_at(program);
                program.texts_printed = program.texts_printed.with(body.texts);
                program.printed = program.printed.with(body.vars);
                program.lists[index as usize].routine = body;
                nodes.push(Node::List(index, ops));
            }
            Step::If(arms) => {
                let branches = arms.iter().map(|arm| {
                    let number = *branches;
                    *branches += 1;
                    let condition = arm.condition.as_ref().map(|condition| asked(program, condition));
                    let start = program.ops.len();
                    let nodes = lower_steps(program, lines, &arm.steps, branches);
                    Branch { number, condition, ops: start..program.ops.len(), nodes, span: arm.span }
                });
                nodes.push(Node::If(branches.collect()));
            }
        }
    }
    nodes
}

/// Adds a formula that is evaluated. Returns its row.
fn asked(program: &mut Program, formula: &Formula) -> u32 {
    program.texts_printed = program.texts_printed.with(formula.texts());
    program.asked = program.asked.with(formula.vars());
    push(&mut program.formulas, formula.clone())
}

/// Adds a formula whose value is printed. Returns its row.
fn formula(program: &mut Program, formula: &Formula) -> u32 {
    program.printed = program.printed.with(formula.vars());
    asked(program, formula)
}

fn lower_line(program: &mut Program, line: &Line) {
    program.ops.push(Op::Line { droppable: line.words.iter().all(|w| is_motion_or_no_code(&w.kind)) });
    program.spans.push(line.span);
    for word in &line.words {
        let glued = word.glued;
        let op = match &word.kind {
            WordKind::Var(letter, var) => Op::Var { letter: *letter, var: *var, glued },
            WordKind::Value(var) => Op::Value { var: *var, glued },
            WordKind::Remark(var) => {
                program.printed.insert(*var);
                Op::Remark { var: *var, glued }
            }
            WordKind::Literal(letter, text, value) => {
                let code = Code::of(program.letters[0][*letter].printed, *value);
                let literal = Literal { letter: *letter, text: text.clone(), value: *value, code };
                Op::Literal { index: push(&mut program.literals, literal), glued }
            }
            WordKind::Text(text) | WordKind::Note(text) => {
                Op::Text { index: push(&mut program.texts, text.clone()), glued }
            }
            WordKind::Quote(text) => Op::Quote { index: push(&mut program.texts, text.clone()), glued },
            WordKind::Formula(Some(letter), of) => Op::Formula { letter: *letter, index: formula(program, of), glued },
            WordKind::Formula(None, of) => Op::ValueFormula { index: formula(program, of), glued },
            WordKind::RemarkFormula(of) => Op::RemarkFormula { index: formula(program, of), glued },
            WordKind::TextVar(var) | WordKind::RemarkText(var) => {
                Op::TextVar { var: *var, in_comment: matches!(word.kind, WordKind::RemarkText(_)), glued }
            }
            WordKind::PropertyText(row) | WordKind::RemarkProperty(row) => {
                let in_comment = matches!(word.kind, WordKind::RemarkProperty(_));
                Op::PropertyText { row: *row, in_comment, glued }
            }
            WordKind::Comment(words) => Op::Comment { words: *words as u32 },
        };
        program.ops.push(op);
        program.spans.push(word.span);
    }
}

/// Adds a row to a table. Returns its index.
fn push<T>(table: &mut Vec<T>, item: T) -> u32 {
    table.push(item);
    (table.len() - 1) as u32
}

/// Whether the word is G0, G1, G2 or G3, or is neither a G code nor an M code.
fn is_motion_or_no_code(word: &WordKind) -> bool {
    match word {
        WordKind::Literal(b'G' | b'g', _, value) => [0.0, 1.0, 2.0, 3.0].contains(value),
        WordKind::Literal(letter, ..) | WordKind::Var(letter, _) | WordKind::Formula(Some(letter), _) => {
            !b"GgMm".contains(letter)
        }
        WordKind::Formula(None, _) | WordKind::RemarkFormula(_) => true,
        WordKind::Value(_) | WordKind::Remark(_) | WordKind::Text(_) | WordKind::Note(_) => true,
        WordKind::Quote(_) | WordKind::TextVar(_) | WordKind::RemarkText(_) | WordKind::Comment(_) => true,
        WordKind::PropertyText(_) | WordKind::RemarkProperty(_) => true,
    }
}
