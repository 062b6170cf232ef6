//! Warns of cuts on a mill after the job turned the spindle off.

use super::printer::Printer;
use super::shape::Shape;
use super::want::Want;
use crate::diag::Code;
use crate::lang::{Machine, VarId};
use crate::toolpath::CycleKind;

/// Warns of the first cut with the spindle off in each operation.
#[inline]
pub fn warn_of_standing(shape: &Shape, want: &mut Want, out: &mut Printer) {
    if !want.standing_told && stands(shape, want) {
        tell(want, out);
    }
}

/// Whether the spindle of a mill is off, or has the speed 0, in a cut that needs the spindle. A tap starts the spindle
/// by itself, and a manual cycle does not cut.
fn stands(shape: &Shape, want: &Want) -> bool {
    let settings = &shape.program.settings;
    let off = want.get(VarId::Direct) == Some(settings.spindle[2]) && !want.cycle.is_some_and(CycleKind::is_tap);
    let stands = off || want.get(VarId::Speed) == Some(0.0);
    stands
        && !shape.program.switches_spindle
        && settings.machine == Machine::Mill
        && want.cycle != Some(CycleKind::Manual)
}

#[cold]
fn tell(want: &mut Want, out: &mut Printer) {
    want.standing_told = true;
    let message = format!("tool {} cuts with the spindle off", want.tool.unwrap_or_default());
    let help = "start the spindle before the cut: SPINDL/3000,RPM,CLW in a CL file, `spindle` in a job; ignore this \
        for a tool that does not turn";
    out.note(Code::PR055, message, help);
}
