//! Compares arcs. A program may divide an arc into parts or into short lines.

use super::cut::{ALL, Cut, Place, What, position, same, shown, turns_between, with_turns};
use super::intent::Done;
use super::modal;
use super::sides::Sides;
use super::tables::ANGLE;
use crate::diag::Code;
use crate::nc::{Turn, axes_of, sweep};
use crate::toolpath::{Direction, FeedMode};

/// Greatest deviation of the parts of an arc from its circle, as a multiple of the tolerance. The factor is more than
/// 1, because the centres of arcs are rounded too.
const OFF: f64 = 5.0;

/// Whether a short straight cut that begins at the start of the arc is a chord of the arc. The cut is a chord if its
/// end is on the arc, at most half a turn from the beginning of the arc.
pub(super) fn is_chord(cut: &Cut, turn: &Turn, to: &Place, tolerance: f64) -> bool {
    let [first, second, _] = axes_of(turn.plane);
    let radius = |at: &Place| (at[first] - turn.center[first]).hypot(at[second] - turn.center[second]);
    let angle = sweep(&cut.from, &Turn { to: position(to), turns: 0, ..*turn });
    (radius(to) - radius(&cut.from)).abs() <= tolerance && angle <= sweep(&cut.from, turn).min(std::f64::consts::PI)
}

/// Compares the program's cuts with an arc of the job. The program may make the arc in parts. The program was already
/// run to the first part.
pub(super) fn arc(s: &mut Sides<'_>, cut: &Cut, turn: &Turn) -> Done {
    let (tolerance, chord) = (s.limits.tolerance, s.limits.chord);
    let [first, second, across] = axes_of(turn.plane);
    let radius = (cut.from[first] - turn.center[first]).hypot(cut.from[second] - turn.center[second]);
    let whole = sweep(&cut.from, turn);
    // rounding changes the angle of a small arc more than that of a large one
    let slack_angle = 1e-3 + OFF * tolerance / radius;
    let (mut swept, mut parts) = (0.0, 0);
    // the program may count its angles from another turn than the job
    let mut turns = None;
    loop {
        let Some(found) = s.next()? else {
            let message = format!("the program ends inside the arc to {}", shown(&cut.end(), 0b111));
            return s.differs(Code::PV017, 0, message, "check the arcs of the form");
        };
        if parts > 0 && !s.program.passage.is_plain() {
            let message = "a rapid, a stop or a dwell inside an arc".to_owned();
            return s.differs(Code::PV001, found.line, message, "check the arcs of the form");
        }
        if parts > 0 {
            modal::compare(s, cut, &found, false);
        }
        let end = found.end();
        let part = Turn { to: position(&end), turns: 0, ..*turn };
        // measured from the program's position: rounding may close a circle that is open in the job, or open a closed one
        let straight_up = matches!(found.what, What::Line { .. })
            && [first, second].iter().all(|&axis| (end[axis] - found.from[axis]).abs() < 1e-9);
        let mut angle = if straight_up { 0.0 } else { sweep(&found.from, &part) };
        let mut bulge = radius * (1.0 - (angle.min(std::f64::consts::TAU) / 2.0).cos());
        let slack = match found.what {
            What::Arc(made) => {
                if made.plane != turn.plane || made.direction != turn.direction {
                    let name = if turn.direction == Direction::Cw { "clockwise" } else { "counter-clockwise" };
                    let message = || {
                        let end = shown(&cut.end(), 0b111);
                        format!("the arc to {end} has the opposite direction or another plane: the job's arc is {name}")
                    };
                    let help = "check ClockWise, CounterClockWise and ArcPlane";
                    if !same(&found.end(), &cut.end(), ALL, tolerance) {
                        return s.differs(Code::PV001, found.line, message(), help);
                    }
                    s.found(Code::PV001, found.line, help, message);
                    s.program.take();
                    return Ok(());
                }
                angle = sweep(&found.from, &made);
                bulge = 0.0;
                OFF * tolerance
            }
            _ => chord + tolerance,
        };
        let distance = |at: [f64; 2]| ((at[0] - turn.center[first]).hypot(at[1] - turn.center[second]) - radius).abs();
        let points = (1..8).map(|part| distance(point_of(&found, turn, angle * f64::from(part) / 8.0)));
        let off = points.fold(distance([end[first], end[second]]), f64::max).max(bulge);
        swept += angle;
        let height = cut.from[across] + (turn.to[across] - cut.from[across]) * (swept / whole).min(1.0);
        let ends = same(&end, &cut.end(), ALL, tolerance);
        let turned = with_turns(&end, turns.get_or_insert_with(|| turns_between(&found.from, &cut.from)));
        // the rounding of each part changes its angle
        let is_whole = ends && swept > whole - slack_angle * f64::from(parts + 1);
        let share = if is_whole { 1.0 } else { (swept / whole).min(1.0) };
        if let Some(message) = turns_unevenly(cut, &turned, share, (OFF * tolerance / (radius * whole)).min(1.0)) {
            return s.differs(Code::PV001, found.line, message, "check the angle that the form prints for this arc");
        }
        let in_it = !ends && (parts > 0 || swept < whole - 1e-6);
        // on a steep helix, rounded X and Y change the height by up to this amount
        let steep = ((turn.to[across] - cut.from[across]) / (radius * whole)).abs() * tolerance;
        let off = off.max(((end[across] - height).abs() - 2.0 * steep) * f64::from(u8::from(in_it)));
        if off > slack || swept > whole + slack_angle * f64::from(parts + 1) {
            let message = format!(
                "a cut goes to {}, which is not on the job's arc to {}",
                shown(&end, 0b111),
                shown(&cut.end(), 0b111)
            );
            return s.differs(Code::PV001, found.line, message, "check CtrCode, CtrIncremental? and the radius");
        }
        let share = if cut.mode == FeedMode::InverseTime { angle / whole } else { 1.0 };
        let part = Cut { feed: cut.feed.map(|feed| feed / share), ..cut.clone() };
        modal::feeds(s, &part, &found, false);
        s.program.take();
        parts += 1;
        if is_whole {
            s.report.allowed.arcs += u64::from(parts > 1);
            return Ok(());
        }
    }
}

/// The message about a part of an arc at whose end the part is not turned in proportion to the arc. `end`: this end,
/// with the turns of the job. `share`: the part of the arc before this end; rounding may change it by `slack`.
fn turns_unevenly(cut: &Cut, end: &Place, share: f64, slack: f64) -> Option<String> {
    let whole = cut.end();
    let even: Place = std::array::from_fn(|axis| cut.from[axis] + share * (whole[axis] - cut.from[axis]));
    let is_even = |axis: &usize| {
        let near = ANGLE + slack * (whole[*axis] - cut.from[*axis]).abs();
        (end[*axis] - even[*axis]).abs() <= near
    };
    let axes: u8 = (3..6).filter(|axis| !is_even(axis)).map(|axis| 1 << axis).sum();
    (axes != 0).then(|| {
        let [is, wanted] = [end, &even].map(|place| shown(place, axes));
        format!("an arc turns the part to {is} at {}, but the job's arc to {wanted}", shown(end, 0b111))
    })
}

/// The point in the plane of the arc that a part of the arc reaches after this angle. For a straight part, the point is
/// the end of the part.
fn point_of(found: &Cut, turn: &Turn, angle: f64) -> [f64; 2] {
    let [first, second, _] = axes_of(turn.plane);
    match found.what {
        What::Arc(made) => {
            let sign = if made.direction == Direction::Ccw { 1.0 } else { -1.0 };
            let (sin, cos) = (sign * angle).sin_cos();
            let [x, y] = [found.from[first] - made.center[first], found.from[second] - made.center[second]];
            [made.center[first] + x * cos - y * sin, made.center[second] + x * sin + y * cos]
        }
        _ => {
            let end = found.end();
            [end[first], end[second]]
        }
    }
}
