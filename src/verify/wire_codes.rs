//! The form's codes for threading and cutting a wire.

use crate::compile::{Op, Program};
use crate::lang::SequenceId;
use crate::toolpath::EdmAction;

/// A code: its letter, and its number times ten.
pub(super) type Coded = (u8, u16);

/// The codes that the form prints for each action.
pub(super) type Codes = Vec<(EdmAction, Vec<Coded>)>;

/// Each action of the wire, with the sequence that prints the action, and a description.
const ACTIONS: [(EdmAction, SequenceId, &str); 4] = [
    (EdmAction::Thread, SequenceId::EdmThread, "threads the wire"),
    (EdmAction::Cut, SequenceId::EdmCut, "cuts the wire"),
    (EdmAction::PreDrill, SequenceId::EdmPreDrillThread, "drills a start hole"),
    (EdmAction::Submerge, SequenceId::SubmergeTank, "fills the tank"),
];

/// The M codes that the form's sequences print for the actions of the wire.
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

/// The description of the action that a code belongs to.
pub(super) fn what(codes: &Codes, code: Coded) -> &'static str {
    let action = codes.iter().find(|(_, codes)| codes.contains(&code)).map(|(action, _)| *action);
    ACTIONS.iter().find(|(own, ..)| Some(*own) == action).map_or("", |(_, _, what)| what)
}
