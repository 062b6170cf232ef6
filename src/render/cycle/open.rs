//! The open cycle from its begin to its end, and the blocks with which the control leaves the cycle.

use super::plain::NextHole;
use crate::compile::Sources;
use crate::cycle::Steps;
use crate::diag::Code;
use crate::lang::SequenceId;
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::form_sets::Kept;
use crate::render::numbers::{as_number, quantised};
use crate::render::said::Said;
use crate::render::shape::{ROTARY, Shape};
use crate::render::targets::set_targets;
use crate::render::upon::run_with_upons;
use crate::render::vars::Vars;
use crate::render::want::Want;
use crate::sema::Target;
use crate::toolpath::{Axes, CycleSpec, Hole, Place};

/// The open cycle.
pub struct ActiveCycle {
    /// The cycle as the job requests it, in program units.
    pub spec: CycleSpec,
    /// Sequence that prints the cycle; `None` if the cycle becomes single moves.
    pub sequence: Option<SequenceId>,
    /// Number of holes of the cycle so far.
    pub holes: u64,
    /// Whether the cycle is active on the control. An active cycle requires the Cancel sequence after its last hole.
    pub in_force: bool,
    /// The branches of the sequence that were printed when the control entered the cycle.
    pub branches: u128,
    /// Values of the job and of the form at the last start of the cycle.
    pub setup: Setup,
    /// Position of the last hole, with the height of the tool after it.
    pub last: Option<Axes>,
    /// Whether the height of the tool after the last hole is certain.
    pub exit_known: bool,
    /// Position of the cycle's last point on the depth axis.
    pub point: Option<f64>,
    /// Return plane at the cycle's first point.
    pub return_plane: Option<f64>,
    /// Level to which the control returns: the tool's height when the cycle was started.
    pub initial_level: f64,
    /// A hole that is not printed yet, because the next event shows whether it is the last hole.
    pub held: Option<(Hole, Place)>,
    /// Feed to restore after the cycle.
    pub feed: Option<f64>,
    /// The height at which the job leaves the last hole.
    pub left: Option<f64>,
    /// Spindle direction to restore after a tap that changed the direction.
    pub turned: Option<f64>,
    /// The depth that the job gives with the last hole.
    pub depth: Option<f64>,
    /// The words of the next hole, if the next hole is as deep as the last hole.
    pub next: NextHole,
}

/// The values of the job and of the form when a cycle was started.
#[derive(Default)]
pub struct Setup {
    vars: Vars,
    kept: Kept,
}

impl Setup {
    /// The current values.
    pub fn new(want: &Want, said: &Said) -> Setup {
        Setup { vars: want.values().clone(), kept: said.kept.clone() }
    }

    /// Whether the current values of `sources` differ from their values when the cycle was started.
    pub fn differs(&self, sources: Sources, want: &Want, said: &Said) -> bool {
        let other = |target| {
            self.kept.of(target) != said.kept.of(target) || self.kept.text_of(target) != said.kept.text_of(target)
        };
        sources.vars.iter().any(|var| self.vars.get(var) != want.get(var) || other(Target::Var(var)))
            || sources.properties().any(|row| other(Target::Property(row)))
    }
}

/// The open cycle and the steps of its holes. Their memory is reused, so that printing a hole allocates nothing.
#[derive(Default)]
pub struct Drilling {
    /// The open cycle.
    pub open: Option<ActiveCycle>,
    /// Steps of a hole that is printed as single moves.
    pub steps: Steps,
}

/// Leaves the cycle: prints the Cancel sequence and updates the known axis positions after the last hole.
pub fn leave_cycle(cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    cancel(cx, drill)?;
    let Some((last, exit_known)) = drill.open.as_ref().and_then(|cycle| Some((cycle.last?, cycle.exit_known))) else {
        return Ok(());
    };
    cx.said.stand.position = last;
    set_targets(&last, shape, cx.want, cx.said)?;
    // a cycle does not turn the part, so the known angles of rotary axes stay valid
    let turned = ROTARY.filter(|&axis| !cx.said.differs_from(&last, 1 << axis, shape));
    let turned = turned.fold(0, |axes, axis| axes | 1 << axis);
    cx.said.forget_letters();
    cx.said.say_motion_again();
    let known = turned | if exit_known { 0b111 } else { 0b111 & !shape.depth_bit() };
    for axis in 0..6 {
        if known & last.given & 1 << axis != 0 {
            let info = &shape.letters[shape.axes[axis]];
            let units = quantised(info, last.values[axis] * shape.scales[axis])?;
            cx.said.word(info, units);
        }
    }
    if !exit_known {
        cx.said.lose_start(shape.depth_bit(), shape); // an increment needs a known start
    }
    Ok(())
}

/// Prints the Cancel sequence if the control is in the cycle.
pub fn cancel(cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let Some(cycle) = &mut drill.open else { return Ok(()) };
    let cancels = cycle.sequence.and_then(|id| program.routine(id)).is_some_and(|routine| routine.cancel);
    if std::mem::take(&mut cycle.in_force)
        && cancels
        && let Some(routine) = shape.routine(SequenceId::Cancel, cx.want, cx.said)
    {
        run_with_upons(routine, cx)?;
        cx.said.say_motion_again();
    }
    Ok(())
}

/// Whether the cycle is a rigid tap, with the feed synchronised to the spindle on the way in and out. A tap without a
/// reversal of the spindle is printed as a face or drill cycle.
pub fn is_rigid(spec: &CycleSpec, shape: &Shape) -> bool {
    let reverses = spec.kind.is_tap() && !spec.norevr && !spec.rapout;
    reverses && spec.rigid.unwrap_or(shape.program.settings.rigid_tap)
}

/// The spindle direction before the cycle; an error if the spindle does not turn.
pub fn turning(direct: Option<f64>, shape: &Shape) -> Done<f64> {
    match direct {
        Some(code) if code != shape.program.settings.spindle[2] => Ok(code),
        _ => fault(Code::PR032, "the spindle does not turn", "give the operation a spindle with a direction"),
    }
}

/// Records the tool position after a hole. `exit`: the height after the cycle, and whether this height is certain. Only
/// needed if the sequence does not print the height.
pub fn left_hole(
    target: &Axes,
    exit: Option<(f64, bool)>,
    shape: &Shape,
    said: &mut Said,
    drill: &mut Drilling,
) -> Done {
    let mut last = *target;
    let depth = &shape.letters[shape.axes[shape.depth]];
    let (exit, known) = exit.unwrap_or_else(|| match said.register(depth) {
        Some((units, decimals)) => {
            let value = as_number(units, decimals);
            (if depth.reversed { -value } else { value }, true)
        }
        None => (target.values[shape.depth], false),
    });
    // the last position of the job is the return plane, even if the control stays lower
    last.set(shape.depth, exit);
    said.stand.position = last;
    if let Some(cycle) = &mut drill.open {
        cycle.last = Some(last);
        cycle.exit_known = known;
    }
    Ok(())
}
