//! Motion statements: GOTO, GODLTA, FROM, RAPID, tool axis, shifts.

use super::arcs::arc_to;
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::feed::{approach, feed_on_goto, feed_to_say};
use super::holes::point;
use super::job::{Job, Waiting};
use super::setup::Setups;
use super::setups::must_agree;
use super::state::{Feeds, Heading, Motion, Shift, State};
use super::words::{Word, numbers};
use crate::diag::Code;
use crate::toolpath::{Axes, Event, Infeed};

/// Tolerance for the components of unit vectors.
const SAME: f64 = 1e-6;

/// Handles GOTO/x,y,z[,i,j,k][,feed].
#[inline]
pub(super) fn goto(values: &[f64], state: &mut State<'_>) -> Done {
    let to = point_of("GOTO", values, state)?;
    go(to, state)
}

/// Reads x,y,z[,i,j,k][,feed]: sets the tool axis and the feed, and returns the point.
#[inline]
fn point_of(name: &str, values: &[f64], state: &mut State<'_>) -> Done<[f64; 3]> {
    let (axis, feed) = match values.len() {
        3 => (None, None),
        4 => (None, Some(values[3])),
        6 => (Some([values[3], values[4], values[5]]), None),
        7 => (Some([values[3], values[4], values[5]]), Some(values[6])),
        count => {
            let help = "write x, y, z, then the tool axis i, j, k or the feed";
            return fault(Code::PL001, format!("{name} with {count} numbers"), help);
        }
    };
    if let Some(axis) = axis {
        set_axis(axis, state)?;
    }
    if let Some(feed) = feed {
        feed_on_goto(feed, state)?;
    }
    Ok(state.motion.shift.of([values[0], values[1], values[2]]))
}

pub(super) fn goto_words(words: &[Word], state: &mut State<'_>) -> Done {
    match numbers(words) {
        Some(values) => goto(&values, state),
        None => fault(Code::PL001, "GOTO takes only numbers", "write x, y, z, then the tool axis i, j, k or the feed"),
    }
}

/// Begins a motion to a position. Returns whether it is a rapid; `None` if the motion belongs to a setup that is not selected.
#[inline]
fn begin(to: [f64; 3], state: &mut State<'_>) -> Done<Option<bool>> {
    let motion = &mut state.motion;
    let after_cycle = std::mem::take(&mut motion.rapid_after_cycle) && !motion.rapid;
    let rapid = std::mem::take(&mut motion.rapid) | after_cycle;
    // without a clearance in the file, the tool is at an unknown height above the last hole
    let before = motion.position.or(motion.point);
    motion.point = Some(to);
    let frame = motion.frame.take();
    state.job.begin_motion();
    if let Some(setups) = &mut state.setups {
        let begins = std::mem::take(&mut setups.is_fresh);
        setups.motion(state.job.notes.place.line);
        if !setups.is_chosen() {
            state.arcs.pending = None;
            return Ok(None);
        }
        if begins && !rapid && !state.cycle.is_active() {
            let help = "the program of a setup can't begin inside a cut: such a cut needs a five-axis machine";
            return fault(Code::PL004, "the tool axis turns while the tool cuts", help);
        }
    }
    if let Some(frame) = frame {
        must_agree(frame, state.motion.axis.0)?;
    }
    no_jump(&mut state.motion)?;
    if after_cycle && before.is_some_and(|before| to[2] < before[2]) {
        let message = "the first motion after CYCLE/OFF goes down, without RAPID and without a feed";
        return fault(Code::PL004, message, "write RAPID before it if it is a rapid, or FEDRAT if it is a cut");
    }
    Ok(Some(rapid))
}

/// Checks that no FROM has changed the position since the last motion. Called at the beginning of each motion.
#[inline]
pub(super) fn no_jump(motion: &mut Motion) -> Done {
    motion.has_moved = true;
    let Some(line) = motion.jump.take() else { return Ok(()) };
    let message = format!("the FROM of line {line} gives another position than the motion before it");
    fault(Code::PL004, message, "if the tool must move there, write RAPID and GOTO instead of FROM")
}

/// Moves to a position as a rapid, a feed move, an arc or a hole, depending on the current state.
#[inline]
fn go(to: [f64; 3], state: &mut State<'_>) -> Done {
    let Some(rapid) = begin(to, state)? else { return Ok(()) };
    if let Some(arc) = state.arcs.pending.take() {
        return arc_to(&arc, to, rapid, state);
    }
    if state.cycle.is_active() {
        if !rapid {
            return point(to, state);
        }
        state.job.close_holes()?;
    }
    let State { job, motion, arcs, feeds, .. } = state;
    if !rapid {
        approach(motion, feeds, job)?;
    }
    let axes = job.axes(to)?;
    // needed for arcs if the caller did not name the CAM system
    if job.notes.said_sense().is_none() {
        arcs.heading = motion.position.and_then(|from| Heading::between(from, to)).or(arcs.heading);
    }
    let across = motion.position.is_none_or(|from| from[..2] != to[..2]);
    motion.position = Some(to);
    // controls start and end compensation in a move across; a move along the depth only waits for the next move across
    if motion.cutcom.asked.is_some() && across {
        return compensate(axes, rapid, motion, feeds, job);
    }
    if rapid {
        // the spindle statement of a tool may come after the tool's first rapids
        if !job.has_operation() || job.changes() && job.spindle.now.speed.is_none() {
            return job.wait(Waiting::Rapid(axes));
        }
        return job.push(Event::Rapid(axes));
    }
    let feed = feed_to_say(feeds, job)?;
    job.push(Event::Line { to: axes, feed })
}

/// Handles GOHOME. With a point: a rapid to this point, first up, then across, then down. Without a point: a move to the
/// machine's home position.
pub(super) fn gohome(words: &[Word], state: &mut State<'_>) -> Done {
    if words.is_empty() {
        state.motion.position = None;
        return state.job.between(Event::Home);
    }
    // GOHOME is a rapid, so it has no feed
    let Some(values) = numbers(words).filter(|values| matches!(values.len(), 3 | 6)) else {
        let help = "write GOHOME/x,y,z, or only GOHOME";
        return fault(Code::PL001, "a GOHOME that can't be read", help);
    };
    let to = point_of("GOHOME", &values, state)?;
    // the direction away from the part: up on mills, outward on lathes
    let away = if state.job.turns_part() { 0 } else { 2 };
    if let Some(from) = state.motion.position.filter(|from| from[away] != to[away]) {
        let mut corner = if to[away] > from[away] { from } else { to };
        corner[away] = to[away].max(from[away]);
        state.motion.rapid = true;
        go(corner, state)?;
    }
    state.motion.rapid = true;
    go(to, state)
}

/// Pushes the motion that turns cutter compensation on or off.
fn compensate(to: Axes, rapid: bool, motion: &mut Motion, feeds: &Feeds, job: &mut Job<'_>) -> Done {
    let feed = if rapid { feed_to_say(feeds, job).ok().flatten() } else { feed_to_say(feeds, job)? };
    let side = motion.cutcom.asked.take().flatten();
    motion.cutcom.on = side.is_some();
    match side {
        Some(side) => job.push(Event::Infeed { infeed: &Infeed { to, side, rapid }, feed }),
        None => job.push(Event::Outfeed { to, feed, rapid }),
    }
}

pub(super) fn godlta(words: &[Word], state: &mut State<'_>) -> Done {
    let Some(from) = state.motion.point else {
        return fault(Code::PL001, "GODLTA from an unknown position", "begin with a GOTO or FROM");
    };
    let values = numbers(words).unwrap_or_default();
    let delta = match values.as_slice() {
        [along] => state.motion.axis.0.map(|component| component * along),
        [x, y, z] => [*x, *y, *z],
        [x, y, z, feed] => {
            feed_on_goto(*feed, state)?;
            [*x, *y, *z]
        }
        _ => return fault(Code::PL001, "GODLTA takes one, three or four numbers", "write dx, dy, dz"),
    };
    let delta = state.motion.shift.turned(delta);
    go([from[0] + delta[0], from[1] + delta[1], from[2] + delta[2]], state)
}

/// Handles FROM, which sets the tool's first position without a motion. After a motion, FROM with another position is refused
/// at the next motion, unless the tool changes before it.
pub(super) fn from(words: &[Word], state: &mut State<'_>) -> Done {
    if state.cycle.is_active() {
        state.job.notes.warn(Code::PC058, "FROM inside a cycle", "remove FROM, or end the cycle before it");
    }
    let Some(values) = numbers(words) else {
        return fault(Code::PL001, "FROM takes a position", "write x, y, z");
    };
    let to = point_of("FROM", &values, state)?;
    let motion = &mut state.motion;
    if motion.has_moved && motion.position.is_some_and(|position| position != to) {
        motion.jump = Some(state.job.notes.place.line);
    }
    (motion.position, motion.point) = (Some(to), Some(to));
    Ok(())
}

/// Handles RAPID. RAPID applies to one motion, which may be part of the same statement.
pub(super) fn rapid(words: &[Word], state: &mut State<'_>) -> Done {
    state.motion.rapid = true;
    match words {
        [] => Ok(()),
        [Word::Name(goto), rest @ ..] if goto == "GOTO" => goto_words(rest, state),
        [word, ..] => fault(Code::PL002, format!("RAPID can't take `{word}`"), "write RAPID without other words"),
    }
}

/// Pushes a tool axis if it differs from the current one. A machine that can't tilt refuses this event.
#[inline]
fn set_axis(to: [f64; 3], state: &mut State<'_>) -> Done {
    let State { job, motion, setups, .. } = state;
    let axis = &mut motion.axis;
    if to == axis.0 || job.turns_part() {
        return Ok(());
    }
    let length = to.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length < SAME {
        return fault(Code::PL001, "a tool axis without direction", "give i, j, k of a unit vector");
    }
    let unit = to.map(|c| c / length);
    if unit.iter().zip(axis.0).all(|(a, b)| (a - b).abs() < SAME) {
        return Ok(());
    }
    axis.0 = unit;
    match setups {
        Some(setups) => another_setup(setups, motion, job),
        None => job.between(Event::Tilt(unit)),
    }
}

/// Handles a new tool axis in a file with several setups. The motions after the new axis are read in the frame of their
/// setup, or skipped.
fn another_setup(setups: &mut Setups, motion: &mut Motion, job: &mut Job<'_>) -> Done {
    job.close_holes()?;
    if setups.has_own_frame() {
        if !setups.is_chosen() {
            return Ok(());
        }
        let help = "the tool axis turns inside a tool path: this path needs a five-axis machine";
        return fault(Code::PL004, "the tool axis is not the z axis of the MCS", help);
    }
    let begins = setups.turn(motion.axis.0);
    enter_setup(begins, setups, motion, job)?;
    if begins && setups.is_chosen() {
        job.begin_setup();
    }
    Ok(())
}

/// Handles the beginning of a setup, and the return to a setup because the setup after it has no motion.
pub(super) fn enter_setup(begins: bool, setups: &Setups, motion: &mut Motion, job: &mut Job<'_>) -> Done {
    if begins && motion.cutcom.is_in_use() {
        let help = "end compensation before the axis turns";
        return fault(Code::PL004, "the tool axis turns under cutter compensation", help);
    }
    (motion.position, motion.point, motion.jump) = (None, None, None);
    motion.shift.frame = setups.frame().filter(|_| setups.is_chosen());
    job.aside = !setups.is_chosen();
    Ok(())
}

/// Handles TLAXIS, which sets the tool axis. In files for three axes TLAXIS has no effect.
pub(super) fn tlaxis(words: &[Word], state: &mut State<'_>) -> Done {
    match numbers(words).as_deref() {
        Some([i, j, k]) => set_axis([*i, *j, *k], state),
        _ => fault(Code::PL001, "TLAXIS takes a vector", "write i, j, k"),
    }
}

/// Handles MULTAX. In files of Autodesk's post for CAMplete, the tool axis is upright after MULTAX/OFF: the points have
/// no tool axis then.
pub(super) fn multax(words: &[Word], state: &mut State<'_>) -> Done {
    state.motion.many_axes = words.first().is_some_and(|word| word.is("ON"));
    if state.motion.many_axes || state.job.notes.dialect() != Dialect::Camplete {
        return Ok(());
    }
    set_axis([0.0, 0.0, 1.0], state)
}

/// Handles TRANS, whose values are added to all positions, and ORIGIN, whose values are subtracted.
pub(super) fn trans(words: &[Word], shift: &mut Shift, origin: bool) -> Done {
    match numbers(words).as_deref() {
        Some([x, y, z]) => {
            *(if origin { &mut shift.origin } else { &mut shift.trans }) = [*x, *y, *z];
            Ok(())
        }
        _ => fault(Code::PL001, "a shift takes three numbers", "write x, y, z"),
    }
}
