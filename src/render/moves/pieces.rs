//! Prints arcs as blocks: as a whole, in parts, or as chords.

use crate::render::cx::{Cx, Writer};
use std::f64::consts::PI;

use super::centres::{
    CENTRE_OF, CENTRES, as_printed_back, centre_values, centre_words, check_centres, check_signs, divide_for_radius,
    set_arc_variables,
};
use super::geometry::Piece;
use super::line::line_to;
use crate::compile::Routine;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::body::{Mode, run};
use crate::render::fault::{Done, fault, fault_at};
use crate::render::prelude::{check_prints, feed_block, plane_block};
use crate::render::prints::{prints_axis, prints_own_motion};
use crate::render::said::{LastMove, Said};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::want::Want;
use crate::render::words::{AxisUnits, axis_units, axis_words, feed_word, motion_word};
use crate::sema;
use crate::sema::ArcCentre;
use crate::toolpath::{Axes, PlaneArc};

/// Whether a sequence defines the arc's end by the centre and an angle.
fn ends_by_angle(routine: &Routine, axes: [usize; 2]) -> bool {
    let angle = routine.vars.has(VarId::Endang) || routine.vars.has(VarId::Sweep);
    angle && axes.iter().all(|&axis| CENTRE_OF[axis].iter().any(|&var| routine.vars.has(var)))
}

/// Prints an arc in as many parts as the form requires.
pub fn pieces(whole: &Piece, across: usize, cx: &mut Cx<'_>, parts: &mut Vec<f64>) -> Done {
    let shape = cx.shape;
    let settings = &shape.program.settings;
    let arc = &whole.arc;
    let turn = 2.0 * PI;
    parts.clear();
    if settings.by_quadrants {
        arc.quadrant_parts(parts);
    } else {
        let sequence = if arc.sweep > 0.0 { SequenceId::CcwCode } else { SequenceId::CwCode };
        let routine = shape.routine(sequence, cx.want, cx.said);
        // a sequence with a radius and no centre can print at most half a turn
        let radius_only = match routine {
            Some(routine) => routine.vars.has(VarId::Arcrad) && !routine.vars.meets(CENTRES),
            None => matches!(settings.centre, ArcCentre::Radius(_)),
        };
        let full = arc.sweep.abs() > turn - 1e-9;
        let most = if !radius_only || (routine.is_none() && full && settings.centre_full.is_some()) {
            turn
        } else if routine.is_none() && settings.centre_over_180.is_some() && !full {
            turn - 1e-6
        } else {
            PI
        };
        // radius words can't print a full circle; they can print an arc over 180 degrees only if the form has a format
        // for it
        arc.equal_parts(most, parts);
        divide_for_radius(whole, across, parts, shape, cx.said)?;
    }
    parts.push(1.0);
    let (from, mut done) = (cx.said.stand.position, 0.0);
    let whole_feed = cx.want.feed();
    for &part in parts.iter() {
        share_of_time(whole_feed, part - done, shape, cx.want);
        print_piece(&whole.part(&from, done, part, across), cx)?;
        done = part;
    }
    share_of_time(whole_feed, 1.0, shape, cx.want);
    Ok(())
}

/// With inverse time feeds, each part of a divided move gets a share of the move's time.
fn share_of_time(whole: Option<f64>, part: f64, shape: &Shape, want: &mut Want) {
    if want.inverse_time() {
        want.keep_feed(whole.map(|feed| feed / part), shape);
    }
}

/// Prints one arc as a generated block, or by the form's arc sequence.
fn print_piece(piece: &Piece, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let settings = &program.settings;
    if ends_meet(&piece.target, piece.axes, shape, cx.said) && piece.arc.sweep.abs() < PI {
        set_targets(&piece.target, shape, cx.want, cx.said)?;
        return line_to(&piece.target, cx); // as an arc, this short move would be a full circle
    }
    // for a turret on the other side, the arc is mirrored
    let ccw = (piece.arc.sweep > 0.0) != piece.axes.iter().any(|&axis| shape.scales[axis] < 0.0);
    let centre = centre_values(piece, shape, cx.said)?;
    set_targets(&piece.target, shape, cx.want, cx.said)?;
    set_arc_variables(piece, &centre, shape, cx.want);
    let kind = if ccw { LastMove::Ccw } else { LastMove::Cw };
    let restate = match cx.said.last_move {
        LastMove::Line => !settings.arc_with_line,
        last => last == kind && !settings.arc_with_same,
    };
    let code = if ccw { &settings.ccw } else { &settings.cw };
    if restate && cx.said.motion_in_force(code) {
        cx.said.say_motion_again();
    }
    if cx.said.last_move == LastMove::Rapid && !settings.force.is_empty() {
        cx.said.force(shape);
    }
    let routine = shape.routine(if ccw { SequenceId::CcwCode } else { SequenceId::CwCode }, cx.want, cx.said);
    check_signs(piece, routine, code, ccw, shape)?;
    check_centres(shape, cx.said)?;
    if let Some(routine) = routine {
        let [a, b] = piece.axes;
        let polar =
            ends_by_angle(routine, piece.axes) && !(prints_axis(routine, a, shape) && prints_axis(routine, b, shape));
        let by_angle = if polar { 1 << a | 1 << b } else { 0 };
        check_prints(routine, &Axes { given: piece.target.given & !by_angle, ..piece.target }, shape, cx.said)?;
        upons(routine.vars, cx)?;
        plane_block(piece.plane.code, routine, &mut cx.writer())?;
        check_arc_code(routine, code, shape, cx.said)?;
        feed_block(code, routine, &mut cx.writer())?;
        run(routine, Mode::ArcMotion, &mut cx.writer())?;
        if polar {
            // the position is known, but the registers of these axes hold older values
            for axis in piece.axes {
                cx.said.forget(&shape.letters[shape.axes[axis]]);
            }
            cx.said.say_motion_again(); // G12 belongs to no known modal group
        }
    } else {
        arc_block(piece, (code, ccw), &centre, &mut cx.writer())?;
    }
    cx.said.stand.position = piece.target;
    cx.said.last_move = kind;
    Ok(())
}

/// Whether the start and the end of the arc print as the same position. With equal printed ends, the control would read
/// a short arc as a full circle.
pub fn ends_meet(target: &Axes, axes: [usize; 2], shape: &Shape, said: &Said) -> bool {
    axes.iter().all(|&axis| {
        let printed = |value: f64| as_printed_back(axis, value, shape).ok();
        printed(target.values[axis]) == printed(said.stand.position.values[axis])
    })
}

/// Checks that an arc sequence prints its own arc code. If an earlier block printed the arc code, that earlier block
/// would be an arc without an end.
fn check_arc_code(routine: &Routine, code: &sema::Code, shape: &Shape, said: &Said) -> Done {
    if !shape.program.speaks_g || said.motion_in_force(code) || prints_own_motion(routine, shape) {
        return Ok(());
    }
    let message = format!("the sequence does not print G{}, but another motion code is active", code.value());
    fault_at(
        Code::PR017,
        message,
        format!("begin the block of the sequence with G{}", code.value()),
        Some(routine.span),
    )
}

/// Prints a generated block: plane, motion code, axes, centre, direction, feed.
fn arc_block(piece: &Piece, (code, ccw): (&sema::Code, bool), centre: &[f64; 2], writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let settings = &shape.program.settings;
    if shape.program.settings.machine == Machine::Mill {
        motion_word(piece.plane, writer)?; // a lathe and a wire EDM machine have only one plane
    }
    if !writer.said.differs_from(&piece.target, 0x3f, shape) {
        // a full circle has no axis words, and controls require its code in the block
        writer.said.say_motion_again();
    }
    motion_word(code, writer)?;
    let mut axes = AxisUnits::default();
    axis_units(&piece.target, &mut axes, shape, writer.said)?;
    axis_words(&piece.target, &axes, shape, writer.said, writer.out)?;
    if let Some(word) = &settings.second_circle {
        writer.out.end_block();
        writer.out.text(word, false);
    }
    centre_words(piece, centre, shape, writer.out)?;
    if let Some([cw, ccw_word]) = &settings.circle_direction {
        let word = if ccw { ccw_word } else { cw };
        writer.out.text(word, false);
    }
    feed_word(writer)?;
    writer.out.end_block();
    Ok(())
}

/// Prints lines within the form's tolerance in place of an arc that the form can't print.
pub fn chords((arc, axes): (&PlaneArc, [usize; 2]), target: &Axes, cx: &mut Cx<'_>, parts: &mut Vec<f64>) -> Done {
    let shape = cx.shape;
    let mut from = cx.said.stand.position;
    for axis in cx.said.turned_axes(target, shape) {
        match cx.said.stand.angle(axis) {
            Some(angle) => from.set(axis, angle),
            None => {
                return fault(
                    Code::PR005,
                    "the arc turns from an unknown angle",
                    "begin with a rapid that gives the angle",
                );
            }
        }
    }
    parts.clear();
    arc.equal_parts(arc.chord_angle(shape.program.settings.tolerance * shape.form_scale), parts);
    let (whole_feed, share) = (cx.want.feed(), 1.0 / (parts.len() + 1) as f64);
    share_of_time(whole_feed, share, shape, cx.want);
    for &part in parts.iter() {
        let mut to = *target;
        for axis in 0..6 {
            if from.given & 1 << axis != 0 {
                to.values[axis] = from.values[axis] + (target.values[axis] - from.values[axis]) * part;
            }
        }
        let point = arc.point(part);
        to.values[axes[0]] = point[0];
        to.values[axes[1]] = point[1];
        set_targets(&to, shape, cx.want, cx.said)?;
        line_to(&to, cx)?;
    }
    set_targets(target, shape, cx.want, cx.said)?;
    line_to(target, cx)?;
    share_of_time(whole_feed, 1.0, shape, cx.want);
    Ok(())
}
