//! A cycle between its begin and its end, and how the control leaves it.

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

/// A cycle between its begin and its end.
pub struct ActiveCycle {
    /// What the job asks for, in program units.
    pub spec: CycleSpec,
    /// The sequence that prints the cycle; `None`: single moves do.
    pub sequence: Option<SequenceId>,
    /// Holes so far.
    pub holes: u64,
    /// The control is in the cycle: it needs its Cancel.
    pub in_force: bool,
    /// Which way through the sequence the control is in.
    pub branches: u128,
    /// Values at the last start.
    pub setup: Setup,
    /// The last hole: where, and the height at which the tool left it.
    pub last: Option<Axes>,
    /// The exit height is certain.
    pub exit_known: bool,
    /// Depth position of the last point.
    pub point: Option<f64>,
    /// Return plane of the first point.
    pub return_plane: Option<f64>,
    /// Where the control returns to: the tool's height when the cycle was started.
    pub initial_level: f64,
    /// A hole that waits: only the next event tells whether it is the last.
    pub held: Option<(Hole, Place)>,
    /// The feed that comes back after the cycle.
    pub feed: Option<f64>,
    /// The height at which the job leaves the last hole.
    pub left: Option<f64>,
    /// The spindle's direction that comes back after a tap that turned it.
    pub turned: Option<f64>,
}

/// The values of the job and of the form when a cycle was started.
#[derive(Default)]
pub struct Setup {
    vars: Vars,
    kept: Kept,
}

impl Setup {
    /// The values of now.
    pub fn new(want: &Want, said: &Said) -> Setup {
        Setup { vars: want.values().clone(), kept: said.kept.clone() }
    }

    /// Is any of these another one now?
    pub fn differs(&self, sources: Sources, want: &Want, said: &Said) -> bool {
        let other = |target| {
            self.kept.of(target) != said.kept.of(target) || self.kept.text_of(target) != said.kept.text_of(target)
        };
        sources.vars.iter().any(|var| self.vars.get(var) != want.get(var) || other(Target::Var(var)))
            || sources.properties().any(|row| other(Target::Property(row)))
    }
}

/// The open cycle, and the steps of its holes; kept so that a hole allocates nothing.
#[derive(Default)]
pub struct Drilling {
    /// The open cycle.
    pub open: Option<ActiveCycle>,
    /// The steps of a hole that is made of moves.
    pub steps: Steps,
}

/// The control leaves the cycle: Cancel, and what is known of the axes after the last hole.
pub fn leave_cycle(cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    cancel(cx, drill)?;
    let Some((last, exit_known)) = drill.open.as_ref().and_then(|cycle| Some((cycle.last?, cycle.exit_known))) else {
        return Ok(());
    };
    cx.said.stand.position = last;
    set_targets(&last, shape, cx.want, cx.said)?;
    // a cycle turns no part: what the control holds of its angles, it holds still
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
        cx.said.displaced(shape.depth_bit(), shape); // an increment must know from where
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

/// A rigid tap keeps step with the spindle, in and out. One that does not reverse is made as a face or drill.
pub fn is_rigid(spec: &CycleSpec, shape: &Shape) -> bool {
    let reverses = spec.kind.is_tap() && !spec.norevr && !spec.rapout;
    reverses && spec.rigid.unwrap_or(shape.program.settings.rigid_tap)
}

/// The direction before the cycle, which must be one.
pub fn turning(direct: Option<f64>, shape: &Shape) -> Done<f64> {
    match direct {
        Some(code) if code != shape.program.settings.spindle[2] => Ok(code),
        _ => fault(Code::PR032, "the spindle does not turn", "give the operation a spindle with a direction"),
    }
}

/// Where the tool is after a hole; `exit` is the height, if the sequence does not print it, and whether it is sure.
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
    // what the job means by its last position is the return plane, also where the control stays lower
    last.set(shape.depth, exit);
    said.stand.position = last;
    if let Some(cycle) = &mut drill.open {
        cycle.last = Some(last);
        cycle.exit_known = known;
    }
    Ok(())
}
