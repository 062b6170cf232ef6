//! What a wire EDM machine does between cuts: the codes by which a form threads and cuts the wire, in the job's order and at
//! its places.

use std::io::{BufRead, Seek};

use super::cut::{ALL, same};
use super::expectation::Expectation;
use super::state::Sides;
use crate::compile::{Op, Program};
use crate::diag::Code;
use crate::lang::SequenceId;
use crate::toolpath::EdmAction;

/// A code: its letter, and ten times its number.
pub(super) type Coded = (u8, u16);

/// The codes of each action.
pub(super) type Codes = Vec<(EdmAction, Vec<Coded>)>;

/// All actions, with the sequence that prints each and what it does.
const ACTIONS: [(EdmAction, SequenceId, &str); 4] = [
    (EdmAction::Thread, SequenceId::EdmThread, "threads the wire"),
    (EdmAction::Cut, SequenceId::EdmCut, "cuts the wire"),
    (EdmAction::PreDrill, SequenceId::EdmPreDrillThread, "drills a start hole"),
    (EdmAction::Submerge, SequenceId::SubmergeTank, "fills the tank"),
];

/// The M codes that a form's sequences of these actions type.
pub(super) fn codes_of(program: &Program) -> Codes {
    let literal = |op: &Op| match op {
        Op::Literal { index, .. } => program.literals.get(*index as usize),
        _ => None,
    };
    let codes = |id: SequenceId| -> Vec<Coded> {
        let ops = program.routine(id).map_or(&[][..], |routine| &program.ops[routine.ops.clone()]);
        let typed = ops.iter().filter_map(literal).filter(|literal| literal.letter == b'M');
        typed.map(|literal| (b'M', (literal.value * 10.0).round() as u16)).collect()
    };
    ACTIONS.iter().map(|(action, id, _)| (*action, codes(*id))).collect()
}

impl Expectation {
    /// The codes of an action.
    pub(super) fn wire_codes(&self, action: EdmAction) -> impl Iterator<Item = Coded> {
        let row = self.wire.iter().flatten().find(|(own, _)| *own == action);
        row.map(|(_, codes)| codes.clone()).unwrap_or_default().into_iter()
    }
}

/// What a code does, in words.
fn what(codes: &Codes, code: Coded) -> &'static str {
    let action = codes.iter().find(|(_, codes)| codes.contains(&code)).map(|(action, _)| *action);
    ACTIONS.iter().find(|(own, ..)| Some(*own) == action).map_or("", |(_, _, what)| what)
}

/// The codes since the last cut: those of the job's actions, at their places.
pub(super) fn compare<R: BufRead + Seek>(s: &mut Sides<R>, line: u64) {
    if s.job.does.is_empty() && s.program.passage.does.is_empty() {
        return;
    }
    let what = |code: Coded| what(&s.program.wire, code);
    let [wanted, is] = [&s.job, &s.program.passage].map(|side| &side.does);
    let differs = wanted.iter().zip(is).position(|(a, b)| {
        let [a_stands, b_stands] = [s.job.standing(a), s.program.passage.standing(b)];
        let apart = a_stands.zip(b_stands).is_some_and(|(a, b)| !same(&a.to, &b.to, ALL, s.limits.tolerance));
        a.what != b.what || apart
    });
    let Some(at) = differs.or((wanted.len() != is.len()).then(|| wanted.len().min(is.len()))) else { return };
    let name = |code: Coded| format!("M{}", f64::from(code.1) / 10.0);
    let (wanted, is) = (wanted.get(at).map(|mark| mark.what), is.get(at).map(|mark| (mark.what, mark.line)));
    let message = match (wanted, is) {
        (Some(wanted), Some((is, _))) if wanted == is => {
            format!("{} {} at another place than the job's", name(is), what(is))
        }
        (Some(wanted), Some((is, _))) => {
            format!("{} {}, where the job's {} {}", name(is), what(is), name(wanted), what(wanted))
        }
        (Some(wanted), None) => format!("{}, which {}, is missing", name(wanted), what(wanted)),
        (None, Some((is, _))) => format!("{} {}, and the job does not", name(is), what(is)),
        (None, None) => return,
    };
    let line = is.map_or(line, |(_, line)| line);
    s.found(Code::PV025, line, "look at EdmThread, EdmCut, EdmPreDrillThread and SubmergeTank", || message.clone());
}
