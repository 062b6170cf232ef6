//! Arcs: the statements CIRCLE and MOVARC, whose end is the next GOTO.

use super::dialect::{Dialect, Sense};
use super::fault::{Done, fault};
use super::feed::{approach, feed_to_say};
use super::state::{Arcs, Heading, PendingArc, State};
use super::vector::{cross, dot};
use super::words::{Word, numbers};
use crate::diag::Code;
use crate::toolpath::{Arc, Direction, Event, Plane, Units};

/// Maximum number of turns of one helix.
const MOST_TIMES: f64 = 1_000.0;
/// Maximum difference in degrees between ANGLE and the angle that the points of the arc give.
const ANGLE_OFF: f64 = 0.5;

/// Cosine of 8 degrees. An arc counts as tangent to the motion before it if the angle between them is at most 8 degrees.
const TANGENT: f64 = 0.99;

/// Reads CIRCLE/x,y,z[,i,j,k][,r,..]: the centre and the axis. The next GOTO is the end of the arc.
pub(super) fn circle(words: &[Word], sense: Option<Sense>, state: &mut State<'_>) -> Done {
    let State { job, motion, arcs, cycle, .. } = state;
    if job.notes.dialect() == Dialect::Ncl {
        let help = "the tool moves in straight lines from point to point; let NCL write arcs for a smoother program";
        job.notes.warn(Code::PL008, "a CIRCLE of NCL is printed as straight lines through its points", help);
        return Ok(());
    }
    if cycle.is_active() {
        return fault(Code::PC042, "an arc inside a cycle", "end the cycle first, with CYCLE/OFF");
    }
    let (words, times, angle) = extent(words)?;
    let values = numbers(words).unwrap_or_default();
    let (centre, axis, radius) = match values.as_slice() {
        [x, y, z] => ([*x, *y, *z], [0.0, 0.0, 1.0], None),
        [x, y, z, radius] => ([*x, *y, *z], [0.0, 0.0, 1.0], Some(*radius)),
        [x, y, z, i, j, k, rest @ ..] => ([*x, *y, *z], [*i, *j, *k], rest.first().copied()),
        _ => return fault(Code::PL001, "a CIRCLE that can't be read", "write CIRCLE/x,y,z,i,j,k,r"),
    };
    // the post for CAMplete writes the angle after the radius; the angle shows whether the direction is right
    let (sense, angle) = match (job.notes.dialect(), values.as_slice()) {
        (dialect @ Dialect::Camplete, [_, _, _, _, _, _, _, angle, ..]) => (dialect.sense(), Some(*angle)),
        _ => (sense, angle),
    };
    let axis = motion.shift.turned(axis);
    let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length == 0.0 {
        let help = "write the axis of the circle after its centre, such as 0,0,1";
        return fault(Code::PL001, "a circle with an axis of no direction, 0,0,0", help);
    }
    let along = (0..3).find(|&i| axis[i].abs() > 0.999_999 * length);
    let Some(along) = along else {
        return fault(Code::PL004, "an arc in a tilted plane", "let the CAM system write lines for the arc");
    };
    let centre = motion.shift.of(centre);
    arcs.pending = Some(PendingArc { centre, axis: along, up: axis[along] > 0.0, radius, sense, times, angle });
    Ok(())
}

/// Reads the words after the numbers of an arc: TIMES,n and ANGLE,a.
fn extent(words: &[Word]) -> Done<(&[Word], Option<u32>, Option<f64>)> {
    let numbers = words.iter().position(|word| word.number().is_none()).unwrap_or(words.len());
    let (words, mut rest) = words.split_at(numbers);
    let (mut times, mut angle) = (None, None);
    while let [word, value, after @ ..] = rest {
        match value.number() {
            Some(n) if word.is("TIMES") && n.fract() == 0.0 && (1.0..=MOST_TIMES).contains(&n) => {
                times = Some(n as u32)
            }
            Some(a) if word.is("ANGLE") && a > 0.0 && a <= 360.0 * MOST_TIMES => angle = Some(a),
            _ => break,
        }
        rest = after;
    }
    match rest {
        [] => Ok((words, times, angle)),
        [word, ..] => {
            let message = format!("`{word}` after the numbers of an arc");
            fault(Code::PL002, message, "write TIMES,n or ANGLE,degrees after the numbers, or nothing")
        }
    }
}

/// Handles the GOTO after a CIRCLE: the arc ends there.
pub(super) fn arc_to(arc: &PendingArc, to: [f64; 3], rapid: bool, state: &mut State<'_>) -> Done {
    if rapid {
        let help = "remove RAPID or CIRCLE; after CYCLE/OFF, write FEDRAT before the arc";
        return fault(Code::PL004, "a rapid along an arc", help);
    }
    let Some(from) = state.motion.position else {
        return fault(Code::PR005, "the arc begins at an unknown position", "put a GOTO before the arc");
    };
    let away = (0..3).filter(|&i| i != arc.axis).map(|i| (from[i] - arc.centre[i]).powi(2)).sum::<f64>().sqrt();
    let allowed = if state.job.units()? == Units::Inch { 0.001 } else { 0.02 };
    if let Some(radius) = arc.radius.filter(|radius| (radius.abs() - away).abs() > allowed) {
        let message = format!("the CIRCLE has the radius {radius}, the tool is {away:.4} from its centre");
        return fault(Code::PR005, message, "check the motion before the arc");
    }
    let notes = &state.job.notes;
    let sense = match arc.sense.or(notes.said_sense()) {
        Some(sense) => sense,
        None => sense_by_tangent(arc, from, notes.dialect(), &mut state.arcs)?,
    };
    let ccw = (sense == Sense::RightHand) == arc.up;
    arc_event(arc, to, ccw, state)
}

/// Pushes an arc that begins at the tool's position.
pub(super) fn arc_event(arc: &PendingArc, to: [f64; 3], ccw: bool, state: &mut State<'_>) -> Done {
    let State { job, motion, arcs, feeds, .. } = state;
    approach(motion, feeds, job)?;
    if job.turns_part() && arc.axis != 1 {
        return fault(Code::PL004, "an arc of a lathe outside the ZX plane", "program the arc in the ZX plane");
    }
    match motion.cutcom.asked {
        Some(Some(_)) => {
            let help = "put a straight motion between CUTCOM and the arc";
            return fault(Code::PL004, "cutter compensation can't begin on an arc", help);
        }
        Some(None) => {
            let help = "no control can end compensation on an arc; if compensation must end earlier, put a straight \
                motion between CUTCOM/OFF and the arc";
            job.notes.warn(
                Code::PL008,
                "CUTCOM/OFF comes before an arc: compensation ends with the straight motion after it",
                help,
            );
        }
        None => {}
    }
    let mut unit = [0.0; 3];
    unit[arc.axis] = if ccw { 1.0 } else { -1.0 };
    let turns = turns(arc, motion.position, to, ccw)?;
    let radius = [to[0] - arc.centre[0], to[1] - arc.centre[1], to[2] - arc.centre[2]];
    arcs.heading = Heading::between([0.0; 3], cross(unit, radius));
    motion.position = Some(to);
    let event = Arc {
        to: job.axes(to)?,
        center: Some(job.axes(arc.centre)?),
        radius: None,
        direction: if ccw { Direction::Ccw } else { Direction::Cw },
        plane: if job.turns_part() { Plane::Xy } else { [Plane::Yz, Plane::Xz, Plane::Xy][arc.axis] },
        turns,
    };
    let feed = feed_to_say(feeds, job)?;
    job.push(Event::Arc { arc: &event, feed })
}

/// Number of full turns before the arc reaches its end for the last time. In NX, TIMES counts each time the arc reaches
/// its end, including the last time. With any other meaning, ramps of NX would have a wrong angle. ANGLE must agree
/// with the angle between the points.
fn turns(arc: &PendingArc, from: Option<[f64; 3]>, to: [f64; 3], ccw: bool) -> Done<u32> {
    let (Some(angle), Some(from)) = (arc.angle, from) else { return Ok(arc.times.unwrap_or(1) - 1) };
    let (first, second) = ((arc.axis + 1) % 3, (arc.axis + 2) % 3);
    let at = |p: [f64; 3]| (p[second] - arc.centre[second]).atan2(p[first] - arc.centre[first]).to_degrees();
    let way = if ccw { at(to) - at(from) } else { at(from) - at(to) };
    let turns = ((angle - way) / 360.0).round();
    let off = (angle - way - 360.0 * turns).abs();
    if off > ANGLE_OFF || arc.times.is_some() {
        let message = format!("an arc of {angle} degrees, but its points are {:.3} apart", way.rem_euclid(360.0));
        return fault(Code::PR005, message, "check the motions before and after it");
    }
    let least = way.rem_euclid(360.0);
    // an arc whose end is its start is a full turn
    let least = if (ANGLE_OFF..=360.0 - ANGLE_OFF).contains(&least) { least } else { 360.0 };
    Ok(((angle - least) / 360.0).round().max(0.0) as u32)
}

/// Finds the direction of circles if the caller did not name the CAM system. An arc begins tangent to the motion before
/// it. This tangent shows the direction of the arc. All arcs must agree with each other and with the known direction of
/// the system.
fn sense_by_tangent(arc: &PendingArc, from: [f64; 3], dialect: Dialect, arcs: &mut Arcs) -> Done<Sense> {
    let mut unit = [0.0; 3];
    unit[arc.axis] = if arc.up { 1.0 } else { -1.0 };
    let radius = [from[0] - arc.centre[0], from[1] - arc.centre[1], from[2] - arc.centre[2]];
    let tangent = Heading::between([0.0; 3], cross(unit, radius));
    let seen = match (tangent, arcs.heading) {
        (Some(tangent), Some(heading)) if dot(tangent.0, heading.0) > TANGENT => Some(Sense::RightHand),
        (Some(tangent), Some(heading)) if dot(tangent.0, heading.0) < -TANGENT => Some(Sense::LeftHand),
        _ => None,
    };
    let help = "name the system with `--dialect`: circles of nx, makino and gener turn clockwise about their axis, \
        circles of solidworks counter-clockwise";
    match (dialect.sense(), arcs.sense, seen) {
        (Some(known), _, Some(now)) if known != now => {
            let message = format!(
                "if this CIRCLE is tangent to the path before it, it turns in the opposite direction to the \
                    circles of {}",
                dialect.title()
            );
            fault(Code::PL006, message, help)
        }
        (_, Some(before), Some(now)) if before != now => fault(
            Code::PL006,
            "if this arc is tangent to the path before it, it turns in the opposite direction to \
                the arcs before it",
            help,
        ),
        (Some(sense), _, _) | (None, Some(sense), _) | (None, None, Some(sense)) => {
            arcs.sense = Some(sense);
            Ok(sense)
        }
        (None, None, None) => fault(Code::PL006, "the direction of this CIRCLE is unknown", help),
    }
}
