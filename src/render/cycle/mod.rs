//! Begin and end of canned cycles.

mod choose;
mod generated;
pub mod hole;
pub mod open;
mod plain;
mod planned;
mod remarks;
mod sequence;

use crate::cycle::check;
use crate::diag::Code;
use crate::lang::{Machine, VarId};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::toolpath::{CycleSpec, SpindleTurn};
use choose::{choose_sequence, scaled};
use hole::make_hole;
use open::{ActiveCycle, Drilling, Setup, is_rigid, leave_cycle, turning};
use plain::NextHole;
use remarks::warn_of;

/// Begins a cycle. A cycle prints nothing before its first hole.
pub fn cycle_begin(spec: &CycleSpec, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    if shape.program.settings.machine == Machine::Edm {
        return fault(Code::PR008, "a wire EDM machine has no canned cycles", "take the cycle out of the job");
    }
    if cx.want.compensated {
        let message = "a canned cycle under cutter compensation: no control allows this";
        return fault(Code::PC041, message, "end the compensation with an `outfeed` before the cycle");
    }
    if cx.want.inverse_time() {
        let message = "a canned cycle in an operation with inverse time feeds";
        return fault(Code::PR006, message, "give the holes a separate operation with feeds per minute");
    }
    check(spec)?;
    let spec = scaled(spec, shape);
    let sequence = choose_sequence(&spec, shape, cx.out)?;
    warn_of(&spec, sequence, shape, cx.want, cx.out);
    let turned = turn_for_tap(&spec, shape, cx.want, cx.said)?;
    cx.want.cycle = Some(spec.kind);
    drill.open = Some(ActiveCycle {
        spec,
        sequence,
        holes: 0,
        in_force: false,
        branches: 0,
        setup: Setup::default(),
        last: None,
        exit_known: false,
        point: None,
        return_plane: None,
        initial_level: 0.0,
        held: None,
        feed: cx.want.feed(),
        left: None,
        turned,
        depth: None,
        next: NextHole::Unknown,
    });
    Ok(())
}

/// Sets the spindle direction for a tap. For a tap in a floating holder, the spindle must turn in the tap's direction;
/// for a rigid tap, the control turns the spindle. If the tap changes the spindle direction, returns the direction to
/// restore after the cycle.
fn turn_for_tap(spec: &CycleSpec, shape: &Shape, want: &mut Want, said: &mut Said) -> Done<Option<f64>> {
    let [cw, ccw, off] = shape.program.settings.spindle;
    let inwards = match spec.kind.inwards() {
        Some(SpindleTurn::Ccw) => ccw,
        Some(_) => cw,
        None => return Ok(None),
    };
    let (rigid, before) = (is_rigid(spec, shape), want.get(VarId::Direct));
    if let (None, Some(sub)) = (before, &mut said.sub) {
        if inwards == ccw {
            let message = "a left-hand tap in a subprogram without a spindle direction";
            return fault(Code::PR033, message, "give the direction in the subprogram, or tap in the main program");
        }
        sub.taps = true;
    }
    if before == Some(off) && !rigid {
        turning(before, shape)?;
    }
    if before.is_none_or(|code| code == inwards || ![cw, ccw].contains(&code)) {
        return Ok(None);
    }
    if !rigid && shape.program.switches_spindle {
        let message = "the tap needs the opposite spindle direction, but sequences of the form turn the spindle";
        return fault(
            Code::PR006,
            message,
            "give the direction of the spindle in the job, or use the tap for the other direction",
        );
    }
    want.set(VarId::Direct, inwards);
    if rigid {
        said.conditions.put(VarId::Direct, Some(inwards));
    }
    want.changed = true;
    Ok(before)
}

/// Ends the open cycle, if any: prints a hole that is held back, prints the Cancel sequence, and updates the known
/// state.
pub fn close_cycle(cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    let Some(cycle) = &mut drill.open else { return Ok(()) };
    if let Some((hole, place)) = cycle.held.take() {
        let now = std::mem::replace(&mut cx.out.place, place);
        cx.want.set(VarId::Lasthole, 1.0);
        make_hole(&hole, cx, drill)?;
        cx.want.set(VarId::Lasthole, 0.0);
        cx.out.place = now;
    }
    leave_cycle(cx, drill)?;
    let Some(cycle) = drill.open.take() else { return Ok(()) };
    cx.want.cycle = None;
    let stands = cx.said.stand.position.get(shape.depth);
    let as_left = |height: f64| cycle.exit_known && stands.is_some_and(|at| (at - height).abs() < 1e-9);
    cx.said.stand.left_hole =
        cycle.left.filter(|&height| !as_left(height)).map(|height| (cx.said.stand.position, height));
    cx.want.keep_feed(cycle.feed, shape);
    if let Some(direct) = cycle.turned {
        cx.want.set(VarId::Direct, direct);
        cx.want.changed = true;
        // a rigid tap turned the spindle both ways without printing either direction
        cx.said.conditions.put(VarId::Direct, None);
    }
    cx.want.put(VarId::Dwell, None);
    Ok(())
}
