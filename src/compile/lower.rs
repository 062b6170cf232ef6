//! Lowering: lines of words become operations.

use super::letters::LetterTable;
use super::program::{CycleStyle, Literal, Op, Program, Routine, Upon};
use super::work;
use crate::control::{Code, Control, Group, Meaning};
use crate::lang::{SequenceId, TextSet, VarId, VarSet};
use crate::sema::{Form, Line, Sequence, Word, WordKind};
use crate::span::Span;

/// Compiles a form that was checked without errors.
pub fn compile(form: &Form) -> Program {
    let mut program = Program {
        settings: form.settings.clone(),
        ops: Vec::new(),
        spans: Vec::new(),
        literals: Vec::new(),
        texts: Vec::new(),
        texts_printed: TextSet::default(),
        name: String::new(),
        hash: String::new(),
        routines: Program::no_routines(),
        upons: Vec::new(),
        upon_vars: VarSet::default(),
        printed: VarSet::default(),
        speaks_g: false,
        switches_spindle: false,
        work_word: work::of(form),
        letters: [LetterTable::new(form, false), LetterTable::new(form, true)],
        custom: [None, None, None],
    };
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
        let routine = lower(&mut program, &upon.lines, upon.span);
        program.printed = program.printed.with(routine.vars);
        program.upon_vars.insert(upon.var);
        program.upons.push(Upon { var: upon.var, every: upon.every, routine });
    }
    program.speaks_g = speaks_g(&program);
    program.switches_spindle = switches_spindle(&program);
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

/// Do sequences of parts of the path type both M3 or M4 and M5, or does a sequence of moves print the speed?
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
    let mut routine = lower(program, &sequence.lines, sequence.span);
    routine.cancel = sequence.cancel.is_some();
    routine.style = match (sequence.is_none, sequence.count, sequence.lines.len()) {
        (true, ..) => CycleStyle::Generated,
        (_, Some(_), _) => CycleStyle::Advanced,
        (_, None, 0 | 1) if routine.cancel => CycleStyle::Machine,
        (_, None, 0 | 1) => CycleStyle::WholeLine,
        _ => CycleStyle::Emulated,
    };
    if let Some(count) = sequence.count {
        let mut begins = (routine.ops.clone()).filter(|&i| matches!(program.ops[i], Op::Line { .. }));
        routine.repeat = begins.nth(count).unwrap_or(routine.ops.end);
        let repeated = vars_of(&program.ops[routine.repeat..routine.ops.end]);
        routine.setup_vars = vars_of(&program.ops[routine.ops.start..routine.repeat]).without(repeated);
    }
    routine
}

fn lower(program: &mut Program, lines: &[Line], span: Span) -> Routine {
    let start = program.ops.len();
    let mut prints_g98 = false;
    let mut texts = TextSet::default();
    for line in lines {
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
                    prints_g98 |= *letter == b'G' && *value == program.settings.return_plane[1];
                    let literal = Literal { letter: *letter, text: text.clone(), value: *value, code };
                    Op::Literal { index: push(&mut program.literals, literal), glued }
                }
                WordKind::Text(text) | WordKind::Note(text) => {
                    Op::Text { index: push(&mut program.texts, text.clone()), glued }
                }
                WordKind::Quote(text) => Op::Quote { index: push(&mut program.texts, text.clone()), glued },
                WordKind::TextVar(var) | WordKind::RemarkText(var) => {
                    texts.insert(var.id);
                    Op::TextVar { var: *var, in_comment: matches!(word.kind, WordKind::RemarkText(_)), glued }
                }
                WordKind::Comment(words) => Op::Comment { words: *words as u32 },
            };
            program.ops.push(op);
            program.spans.push(word.span);
        }
    }
    program.texts_printed = program.texts_printed.with(texts);
    let ops = start..program.ops.len();
    let vars = vars_of(&program.ops[ops.clone()]);
    Routine {
        repeat: start,
        vars,
        texts,
        setup_vars: VarSet::default(),
        cancel: false,
        stays: stays_in_cycle(program.settings.codes(), lines),
        style: CycleStyle::Emulated,
        returns: prints_g98 || vars.has(VarId::Retplane) || vars.has(VarId::Rplane),
        span,
        ops,
    }
}

/// Do these lines leave the control in a motion of its own? The last code that says so counts.
fn stays_in_cycle(control: &Control, lines: &[Line]) -> bool {
    let mut codes = lines.iter().flat_map(|line| &line.words).filter_map(Word::code);
    let ends = |code: Code| control.meaning(code).is_some_and(Meaning::ends_cycle);
    codes.rfind(|&code| control.moves_by_itself(code) || ends(code)).is_some_and(|code| control.moves_by_itself(code))
}

/// Adds a row to a table and returns its index.
fn push<T>(table: &mut Vec<T>, item: T) -> u32 {
    table.push(item);
    (table.len() - 1) as u32
}

/// No G or M code but G0 to G3.
fn is_motion_or_no_code(word: &WordKind) -> bool {
    match word {
        WordKind::Literal(b'G' | b'g', _, value) => [0.0, 1.0, 2.0, 3.0].contains(value),
        WordKind::Literal(letter, ..) | WordKind::Var(letter, _) => !b"GgMm".contains(letter),
        WordKind::Value(_) | WordKind::Remark(_) | WordKind::Text(_) | WordKind::Note(_) => true,
        WordKind::Quote(_) | WordKind::TextVar(_) | WordKind::RemarkText(_) | WordKind::Comment(_) => true,
    }
}

fn vars_of(ops: &[Op]) -> VarSet {
    let mut set = VarSet::default();
    for op in ops {
        if let Op::Var { var, .. } | Op::Value { var, .. } = op {
            set.insert(*var);
        }
    }
    set
}
