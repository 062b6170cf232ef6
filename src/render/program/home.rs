//! The tool goes to the machine's own place.

use super::stops::settle_between_moves;
use crate::diag::Code;
use crate::lang::{SequenceId, VarId};
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::render::targets::set_here;
use crate::render::upon::run_with_upons;
use crate::render::want::Want;

/// Where the machine's own place is, only the form says. Nobody knows where the tool is then.
pub fn home(shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    if want.compensated {
        let help = "end the compensation with an `outfeed` before";
        return fault(Code::PR030, "the tool goes home under cutter compensation", help);
    }
    if shape.program.routine(SequenceId::MoveHome).is_none() {
        let message = "the tool goes home here, and the form does not say where that is";
        let help = "add the sequence `MoveHome` with the control's words, as `G28 G91 Z0.` and `G90`, to its `End`";
        return fault(Code::PR008, message, help);
    }
    settle_between_moves(shape, want, said, out)?;
    set_here(shape, want, said)?;
    let Some(routine) = shape.routine(SequenceId::MoveHome, want, said) else { return Ok(()) };
    run_with_upons(routine, shape, want, said, out)?;
    let known = said.stand.fresh_tool.unwrap_or(0) | said.stand.position.given;
    said.stand.fresh_tool = Some(known);
    said.stand.angles.keep(&said.stand.position);
    said.forget_axes(shape);
    said.forget_place();
    want.forget(&[VarId::H, VarId::V, VarId::D]);
    Ok(())
}
