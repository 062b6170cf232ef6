//! Prints arcs; an arc that the form can't print becomes lines.

use crate::control;
use crate::render::cx::Cx;
use std::f64::consts::PI;

use super::centres::{CENTRE_OF, as_printed_back, centre_letter};
use super::geometry::Piece;
use super::line::line_to;
use super::measure::measured;
use super::pieces::{chords, ends_meet, pieces};
use super::prepare::{begin_cut, cut_goes_to};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::prints::prints_code;
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::render::targets::{check_limits, set_targets};
use crate::sema::ArcCentre;
use crate::toolpath::{Arc, Axes, Direction, Plane, PlaneArc, Units};

/// The two axes of a plane, in the order in which counter-clockwise angles are positive; the axis perpendicular to the
/// plane; the plane's code.
fn plane_axes(plane: Plane) -> ([usize; 2], usize, control::Code) {
    let (axes, across) = plane.axes();
    let code = match plane {
        Plane::Xy => 17,
        Plane::Xz => 18,
        Plane::Yz => 19,
    };
    (axes, across, control::Code::g(code))
}

/// Prints an arc of the path.
pub fn arc(arc: &Arc, feed: Option<f64>, cx: &mut Cx<'_>, parts: &mut Vec<f64>) -> Done {
    let shape = cx.shape;
    let mut target = begin_cut(&arc.to, Some(feed), cx)?;
    let (axes, across, code) = plane_axes(arc.plane);
    if cx.want.compensated && arc.plane != Plane::Xy && shape.program.settings.machine == Machine::Mill {
        let help = "end the compensation with an `outfeed` before the arc";
        return fault(Code::PR030, "an arc in another plane under cutter compensation", help);
    }
    let Some(from) = in_plane(&cx.said.stand.position, axes) else {
        let help = "begin with a rapid that gives all coordinates";
        return fault(Code::PR005, "the arc begins at an unknown position", help);
    };
    let Some(to) = in_plane(&target, axes) else {
        return fault(Code::PR005, "the arc ends at an unknown position", "give both coordinates of the arc's plane");
    };
    let ccw = arc.direction == Direction::Ccw;
    let centre = centre_of(arc, axes, from, to, ccw, shape)?;
    let coarse = check_radii(axes, from, to, centre, shape)?;
    target.given |= cx.said.stand.position.given;
    cut_goes_to(&target, true, cx)?;
    if cx.said.differs_from(&cx.said.stand.position, 1 << axes[0] | 1 << axes[1], shape)
        && !shape.program.settings.incremental
    {
        // the arc's centre is relative to the start, so the control must be exactly at the start
        let here = cx.said.stand.position;
        set_targets(&here, shape, cx.want, cx.said)?;
        line_to(&here, cx)?;
        set_targets(&target, shape, cx.want, cx.said)?;
    }
    let curve = PlaneArc::new(from, to, centre, ccw, arc.turns);
    let climbs = differs_by(&target, across, cx.said);
    if shape.measures {
        let rise = target.values[across] - cx.said.stand.position.values[across];
        let length = (curve.radius * curve.sweep.abs()).hypot(if climbs { rise } else { 0.0 });
        measured(length, &target, true, cx);
    }
    if !shape.program.settings.limits.is_empty() {
        check_arc(&curve, axes, &target, shape)?;
    }
    let settings = &shape.program.settings;
    let plane = settings.planes.iter().find(|plane| plane.code == code);
    let scale = shape.form_scale;
    let printable = curve.radius >= settings.min_radius * scale
        && curve.radius <= settings.max_radius * scale
        && (settings.helical && shape.linear == 3 || !climbs)
        && (3..6).all(|axis| !differs_by(&target, axis, cx.said));
    let shrinks = ends_meet(&target, axes, shape, cx.said) && curve.sweep.abs() < PI;
    if let Some(differ) = coarse {
        let message = format!(
            "the arc is printed as lines: rounded to the form's decimals, its radii at the start and the end differ \
             by {differ:.4}"
        );
        cx.out.note(Code::PR024, message, "give the axes and centre words more decimals");
    }
    match plane {
        Some(plane) if printable && !shrinks && coarse.is_none() => match has_centre_words(axes, ccw, shape) {
            true => pieces(&Piece { axes, plane, arc: curve, target }, across, cx, parts),
            false => {
                note_lines(axes, ccw, shape, cx.out);
                chords((&curve, axes), &target, cx, parts)
            }
        },
        _ => chords((&curve, axes), &target, cx, parts),
    }
}

/// Checks the travel limits at the extreme points of an arc.
fn check_arc(arc: &PlaneArc, axes: [usize; 2], target: &Axes, shape: &Shape) -> Done {
    let mut parts = Vec::new();
    arc.quadrant_parts(&mut parts);
    for part in parts {
        let (mut at, point) = (*target, arc.point(part));
        (at.values[axes[0]], at.values[axes[1]]) = (point[0], point[1]);
        check_limits(&at, shape)?;
    }
    Ok(())
}

fn in_plane(position: &Axes, axes: [usize; 2]) -> Option<[f64; 2]> {
    Some([position.get(axes[0])?, position.get(axes[1])?])
}

/// Whether the target differs from the tool's position along this axis.
fn differs_by(target: &Axes, axis: usize, said: &Said) -> bool {
    target.get(axis).is_some() && target.get(axis) != said.stand.position.get(axis)
}

fn centre_of(arc: &Arc, axes: [usize; 2], from: [f64; 2], to: [f64; 2], ccw: bool, shape: &Shape) -> Done<[f64; 2]> {
    if let Some(centre) = &arc.center {
        return match (centre.get(axes[0]), centre.get(axes[1])) {
            (Some(a), Some(b)) => Ok([a * shape.scale, b * shape.scale]),
            _ => fault(Code::PR005, "the arc's centre lacks a coordinate of its plane", "give both"),
        };
    }
    let radius = arc.radius.unwrap_or(0.0) * shape.scale;
    match PlaneArc::centre_by_radius(from, to, radius, ccw) {
        Some(centre) => Ok(centre),
        None => fault(
            Code::PR005,
            format!("no arc of radius {} joins the ends", radius.abs()),
            "the ends are equal, or farther apart than the diameter: give the `center`",
        ),
    }
}

/// Checks that an arc has equal radii at its start and end. If these radii differ, controls stop with an alarm or cut
/// another path. Radii that differ in the job are an error. If the radii differ only because the form rounds, returns
/// the difference: the arc then becomes lines.
fn check_radii(axes: [usize; 2], from: [f64; 2], to: [f64; 2], centre: [f64; 2], shape: &Shape) -> Done<Option<f64>> {
    let allowed = if shape.units == Units::Mm { 0.01 } else { 0.0005 } + 1e-9;
    let radius = |point: [f64; 2]| (point[0] - centre[0]).hypot(point[1] - centre[1]);
    let (start, end) = (radius(from), radius(to));
    if (start - end).abs() > allowed {
        let message = format!("the arc's radius is {start:.6} at its start and {end:.6} at its end");
        return fault(Code::PR005, message, "check the centre: both ends must be at the same distance from it");
    }
    let mut radii = [0.0; 2];
    for (radius, point) in radii.iter_mut().zip([from, to]) {
        let a = as_printed_back(axes[0], point[0], shape)? - as_printed_back(axes[0], centre[0], shape)?;
        let b = as_printed_back(axes[1], point[1], shape)? - as_printed_back(axes[1], centre[1], shape)?;
        *radius = a.hypot(b);
    }
    let differ = (radii[0] - radii[1]).abs();
    Ok((differ > allowed).then_some(differ))
}

fn has_centre_words(axes: [usize; 2], ccw: bool, shape: &Shape) -> bool {
    if let Some(routine) = shape.program.routine(if ccw { SequenceId::CcwCode } else { SequenceId::CwCode }) {
        let says = |axis: usize| CENTRE_OF[axis].iter().any(|&var| routine.vars.has(var));
        let planes = [Plane::Xy, Plane::Xz, Plane::Yz].map(plane_axes);
        let own = planes.into_iter().find(|plane| plane.0 == axes).map(|plane| plane.2);
        let elsewhere = prints_code(routine, |code| shape.is_plane(code) && Some(code) != own, shape);
        return !elsewhere && (routine.vars.has(VarId::Arcrad) || axes.iter().all(|&axis| says(axis)));
    }
    match &shape.program.settings.centre {
        ArcCentre::Radius(_) => true,
        ArcCentre::Letters(letters) => axes.iter().all(|&axis| centre_letter(letters, axis, shape).is_some()),
    }
}

/// Reports once that an arc becomes lines because the form's arc sequence has no centre words for it.
fn note_lines(axes: [usize; 2], ccw: bool, shape: &Shape, out: &mut Printer) {
    let id = if ccw { SequenceId::CcwCode } else { SequenceId::CwCode };
    if shape.program.routine(id).is_some() && !out.notes().iter().any(|note| note.code == Code::PR024) {
        let [first, second] = axes.map(|axis| ["[ival]", "[jval]", "[kval]"][axis]);
        let message = format!("the arc is printed as lines: {} does not print {first} and {second}", id.name());
        out.note(Code::PR024, message, "print both, or the radius as [arcrad]");
    }
}
