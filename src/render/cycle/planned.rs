//! A planned hole: its heights, and the variables of its cycle.

use super::open::{Drilling, is_rigid};
use crate::cycle::Plan;
use crate::diag::Code;
use crate::lang::VarId;
use crate::render::fault::{Done, fault};
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::toolpath::{Axes, CycleKind, FeedMode};

/// Two heights that differ by less than this value count as equal.
pub const SAME: f64 = 1e-9;

/// Heights of the hole as positions of the depth axis.
#[derive(Clone, Copy)]
pub struct Heights {
    /// The top of the hole, which is the point that the job gives.
    pub point: f64,
    /// The clearance, or R plane.
    pub clear: f64,
    /// The bottom.
    pub bottom: f64,
    /// Return plane of the tool.
    pub return_plane: f64,
}

impl Heights {
    /// Heights for one start of a thread with several starts. Each further start begins lower by a fraction of the
    /// lead, because the spindle has turned further by that time.
    pub fn of_start(self, start: u32, starts: u32, planes: &Plan) -> Done<Heights> {
        if start == 0 {
            return Ok(self);
        }
        let Some(lead) = planes.lead else {
            let help = "give the operation a spindle speed";
            return fault(Code::PC009, "a tap with several starts, but the spindle does not turn", help);
        };
        let clear = self.clear - lead * f64::from(start) / f64::from(starts);
        let returns = self.return_plane > self.clear + SAME;
        Ok(Heights { clear, return_plane: if returns { self.return_plane } else { clear }, ..self })
    }
}

/// A planned hole.
pub struct Planned {
    /// Position over the hole, at its return plane.
    pub target: Axes,
    /// Planes of the hole, relative to its point.
    pub planes: Plan,
    /// Heights of the hole as positions of the depth axis.
    pub heights: Heights,
}

/// Sets the variables of a cycle for one hole.
pub fn hole_variables(hole: &Planned, shape: &Shape, want: &mut Want, drill: &Drilling) {
    let rigid = drill.open.as_ref().is_some_and(|cycle| is_rigid(&cycle.spec, shape));
    let Some(cycle) = &drill.open else { return };
    let spec = &cycle.spec;
    let settings = &shape.program.settings;
    let [r_level, initial_level] = settings.return_plane;
    // `[retplane]`: G98 if the job returns above the clearance, else G99
    let higher = hole.heights.return_plane > hole.heights.clear + SAME;
    want.set(VarId::Retplane, if higher { initial_level } else { r_level });
    want.set(VarId::D, hole.heights.bottom);
    want.set(VarId::Isfirsthole, f64::from(u8::from(cycle.holes == 0)));
    want.set(VarId::Pointd, hole.heights.point);
    want.set(VarId::Vclear, hole.heights.clear);
    want.set(VarId::Rplane, hole.heights.return_plane);
    want.set(VarId::Depth, hole.heights.point - hole.heights.bottom);
    want.set(VarId::Frate, hole.planes.feed);
    want.set(VarId::Plunge, spec.plunge.unwrap_or(hole.planes.feed));
    // without a step, the hole is made in one stroke; a tap has the default step only if the job names a mode of
    // pecking
    let pecks = !spec.kind.is_tap() || spec.mode.is_some();
    let step = spec.step.or(shape.defaults.step.filter(|_| pecks)).or(Some(hole.heights.clear - hole.heights.bottom));
    want.put(VarId::Vbite, step);
    want.put(VarId::Peck1, spec.first_step.or(step));
    want.put(VarId::Inidep, spec.first_step.or(step));
    want.set(VarId::Sbite, spec.min_step.unwrap_or(shape.defaults.min_step));
    let back = spec.back.unwrap_or(match spec.kind {
        CycleKind::Chipbreak => shape.defaults.back_chipbreak,
        CycleKind::Thru => shape.defaults.back_thru,
        _ => shape.defaults.back_deep,
    });
    want.set(VarId::Sclear, back);
    want.set(VarId::Vleave, back);
    want.set(VarId::Sleave, spec.offset.unwrap_or(shape.defaults.jog));
    let unit = if settings.dwell.milliseconds { 1000.0 } else { 1.0 };
    want.put(VarId::Dwell, hole.planes.dwell.map(|seconds| seconds * unit));
    want.set(VarId::Rigid, f64::from(u8::from(rigid)));
    let per_rev = want.feed_mode() == FeedMode::PerRev;
    let rpm = want.get(VarId::Speed).filter(|&rpm| rpm > 0.0);
    let pitch = if per_rev { Some(hole.planes.feed) } else { rpm.map(|rpm| hole.planes.feed / rpm) };
    want.put(VarId::Pitch, pitch.filter(|_| spec.kind.is_tap()));
}
