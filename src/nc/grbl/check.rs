//! Checks that the words of a block may be used together, before any of them takes effect.

use super::error::refuse;
use crate::control::Meaning;
use crate::nc::arcs::axes_of;
use crate::nc::block::Block;
use crate::nc::codes::{ARCS, Group, Motion, STRAIGHT, bit, is_one_of, letters};
use crate::nc::fault::Done;
use crate::nc::state::State;
use crate::toolpath::{FeedMode, Plane};

/// The highest block number that Grbl accepts.
const MOST_NUMBER: f64 = 10_000_000.0;
/// Number of work offsets: G54 to G59.
const OFFSETS: f64 = 6.0;
/// The bits of the words X, Y and Z.
const LINEAR: [u32; 3] = [bit(b'X'), bit(b'Y'), bit(b'Z')];

/// Checks a block and returns its motion, if it has one.
///
/// # Errors
/// The error of Grbl for the first problem. The checks are in Grbl's order.
pub(super) fn check(block: &Block, state: &State) -> Done<Motion> {
    if block.get(b'N').is_some_and(|number| number > MOST_NUMBER) {
        return refuse(27);
    }
    let word = block.row(Group::Motion);
    let motion = word.or(state.modes.motion).filter(|row| row.meaning != Meaning::CycleEnd);
    let (has_axes, length) = (block.has_axes(), block.g_meaning(Group::Length));
    let moves = word.is_some_and(|row| row.meaning != Meaning::CycleEnd) || has_axes && !block.axes_are_taken();
    let cuts = moves && motion.is_some_and(|row| row.meaning != Meaning::Rapid);
    let mode = feed_mode(block, state);
    if mode == FeedMode::InverseTime && cuts && !block.has(bit(b'F')) {
        return refuse(22);
    }
    if block.g_meaning(Group::Once) == Some(Meaning::Dwell) && !block.has(bit(b'P')) {
        return refuse(28);
    }
    if length == Some(Meaning::LengthData) && block.given & letters("XYZ") != bit(b'Z') {
        return refuse(37);
    }
    check_once(block, motion)?;
    if motion.is_none() {
        return if has_axes && length.is_none() { refuse(31) } else { Ok(None) };
    }
    if cuts {
        check_cut(block, motion, mode, state)?;
    }
    Ok(motion.filter(|_| moves && has_axes))
}

/// Checks the codes that take effect only in their block.
fn check_once(block: &Block, motion: Motion) -> Done {
    match block.g_meaning(Group::Once) {
        Some(Meaning::SetOffsets | Meaning::Preset) if !block.has_axes() => refuse(26),
        Some(Meaning::SetOffsets) if !block.has(letters("PL")) => refuse(28),
        Some(Meaning::SetOffsets) if block.get(b'P').is_some_and(|p| p.trunc() > OFFSETS) => refuse(29),
        Some(Meaning::SetOffsets) => match block.get(b'L') {
            Some(20.0) => Ok(()),
            Some(2.0) if !block.has(bit(b'R')) => Ok(()),
            _ => refuse(20),
        },
        Some(Meaning::Machine) if !is_one_of(motion, &STRAIGHT) => refuse(30),
        _ => Ok(()),
    }
}

/// Checks that a cut has a feed, and that an arc or a probing move has an end.
fn check_cut(block: &Block, motion: Motion, mode: FeedMode, state: &State) -> Done {
    let kept = if mode == FeedMode::PerMinute && state.modes.feed_mode == mode { state.drive.feed } else { 0.0 };
    if block.get(b'F').unwrap_or(kept) == 0.0 {
        return refuse(22);
    }
    if motion.is_some_and(|row| row.meaning == Meaning::Line) {
        return Ok(());
    }
    if !block.has_axes() {
        return refuse(26);
    }
    let [first, second, _] = axes_of(plane(block, state)).map(|axis| LINEAR[axis]);
    if is_one_of(motion, &ARCS) && !block.has(first | second) {
        return refuse(32);
    }
    Ok(())
}

fn feed_mode(block: &Block, state: &State) -> FeedMode {
    match block.g_meaning(Group::FeedMode) {
        Some(Meaning::InverseTime) => FeedMode::InverseTime,
        Some(_) => FeedMode::PerMinute,
        None => state.modes.feed_mode,
    }
}

fn plane(block: &Block, state: &State) -> Plane {
    block.plane().unwrap_or(state.modes.plane)
}
