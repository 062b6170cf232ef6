//! Centres of arcs: as words of the form, as a radius, and as values of variables.

use std::f64::consts::PI;

use super::geometry::Piece;
use crate::compile::{Op, Routine};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};
use crate::render::fault::{Done, fault};
use crate::render::numbers::{as_number, quantised};
use crate::render::printer::Printer;
use crate::render::prints::prints_code;
use crate::render::said::Said;
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::sema;
use crate::sema::{ArcCentre, Settings};
use crate::toolpath::{Axes, PlaneArc, Units};

/// Variables of an arc's centre.
pub const CENTRES: VarSet = VarSet::of(&[VarId::Ival, VarId::Jval, VarId::Kval, VarId::Hctr, VarId::Vctr]);

/// The variables of the centre along each axis.
pub const CENTRE_OF: [&[VarId]; 3] = [&[VarId::Ival, VarId::Hctr], &[VarId::Jval, VarId::Vctr], &[VarId::Kval]];

/// A value rounded to the digits that its axis prints.
pub fn as_printed_back(axis: usize, value: f64, shape: &Shape) -> Done<f64> {
    let info = &shape.letters[shape.axes[axis]];
    let scale = shape.scales[axis];
    let units = quantised(info, value * scale)?;
    let number = as_number(units, info.format.dec.count) / scale;
    Ok(if info.reversed { -number } else { number })
}

/// The letter of the centre word along an axis.
pub fn centre_letter(letters: &[u8], axis: usize, shape: &Shape) -> Option<u8> {
    let natural = match shape.axes[axis] {
        b'X' | b'U' => b'I',
        b'Y' | b'V' => b'J',
        _ => b'K',
    };
    let named = letters.iter().all(|l| b"IJK".contains(l));
    if named { letters.contains(&natural).then_some(natural) } else { letters.get(axis).copied() }
}

/// Divides an arc whose radius word is too coarse. For an arc of nearly half a turn, a change of the radius in the last
/// digit moves the centre far. Several shorter arcs describe the same arc within the form's digits.
pub fn divide_for_radius(whole: &Piece, across: usize, parts: &mut Vec<f64>, shape: &Shape, said: &Said) -> Done {
    const MOST_PARTS: usize = 8; // for each piece that the form would print
    let (most, step) = ((parts.len() + 1) * MOST_PARTS, parts.len() + 1);
    let allowed = if shape.units == Units::Mm { 0.004 } else { 0.00015 };
    let from = said.stand.position;
    while parts.len() + 1 < most {
        let (mut here, mut done, mut worst) = (from, 0.0, 0.0f64);
        for part in parts.iter().copied().chain([1.0]) {
            let piece = whole.part(&from, done, part, across);
            worst = worst.max(centre_moves(&piece, &here, shape)?);
            (here, done) = (piece.target, part);
        }
        if worst <= allowed {
            return Ok(());
        }
        let count = parts.len() + 1 + step.div_ceil(2);
        parts.clear();
        parts.extend((1..count).map(|i| i as f64 / count as f64));
    }
    Ok(())
}

/// Distance between the arc's centre and the centre that the control computes from the radius, for a piece that begins at `here`.
fn centre_moves(piece: &Piece, here: &Axes, shape: &Shape) -> Done<f64> {
    let ccw = piece.arc.sweep > 0.0;
    let Some(letter) = radius_letter(piece, ccw, shape) else { return Ok(0.0) };
    let mut ends = [[0.0; 2]; 2];
    for (end, position) in ends.iter_mut().zip([here, &piece.target]) {
        for (value, &axis) in end.iter_mut().zip(&piece.axes) {
            *value = as_printed_back(axis, position.values[axis], shape)?;
        }
    }
    let info = &shape.letters[letter];
    let radius = as_number(quantised(info, piece.arc.radius)?, info.format.dec.count).abs();
    let longer = piece.arc.sweep.abs() > PI + 1e-9;
    let centre = PlaneArc::centre_by_radius(ends[0], ends[1], if longer { -radius } else { radius }, ccw);
    Ok(centre.map_or(f64::INFINITY, |[a, b]| (a - piece.arc.centre[0]).hypot(b - piece.arc.centre[1])))
}

/// The letter of a piece's radius; `None` if centre words define the centre.
fn radius_letter(piece: &Piece, ccw: bool, shape: &Shape) -> Option<u8> {
    let program = shape.program;
    match program.routine(if ccw { SequenceId::CcwCode } else { SequenceId::CwCode }) {
        Some(routine) if routine.vars.meets(CENTRES) => None,
        Some(routine) => routine.steps().find_map(|i| match program.ops[i] {
            Op::Var { letter, var: VarId::Arcrad, .. } => Some(letter),
            _ => None,
        }),
        None => match centre_by(&program.settings, piece.arc.sweep.abs()) {
            ArcCentre::Radius(letter) => Some(*letter),
            ArcCentre::Letters(_) => None,
        },
    }
}

/// Checks that the control reads centre words as the form prints them: relative to the arc's start, or as positions.
pub fn check_centres(shape: &Shape, said: &Said) -> Done {
    match said.centres_misread_by(shape) {
        None => Ok(()),
        Some(code) => {
            let message = format!("the control is in {code} here, and would read another centre of the arc");
            fault(Code::PR041, message, "remove the code from the form, or reverse `CtrIncremental?`")
        }
    }
}

/// Checks `RevSigns`: a form that reverses one axis must also reverse the centre word of that axis and exchange the arc
/// codes. Generated blocks and blocks of sequences are checked.
pub fn check_signs(piece: &Piece, routine: Option<&Routine>, code: &sema::Code, ccw: bool, shape: &Shape) -> Done {
    const VALUES: [VarId; 3] = [VarId::Ival, VarId::Jval, VarId::Kval];
    let settings = &shape.program.settings;
    let reversed = |axis: usize| shape.letters[shape.axes[axis]].reversed;
    let centre = |axis: usize| match (routine, centre_by(settings, piece.arc.sweep.abs())) {
        (Some(routine), _) => routine.steps().find_map(|i| match shape.program.ops[i] {
            Op::Var { letter, var, .. } if var == VALUES[axis] => Some(letter),
            _ => None,
        }),
        (None, ArcCentre::Letters(letters)) => centre_letter(letters, axis, shape),
        (None, ArcCentre::Radius(_)) => None,
    };
    // both centre words reversed: some controls measure from the centre to the start
    let other = |axis: &usize| centre(*axis).is_some_and(|letter| shape.letters[letter].reversed != reversed(*axis));
    let others = piece.axes.iter().copied().filter(other).count();
    if others == 1 || others == 2 && !settings.centre_incremental {
        let axis = piece.axes.into_iter().find(other).map_or(' ', |axis| char::from(shape.axes[axis]));
        let message = format!("the signs of {axis} and of its centre word differ");
        return fault(Code::PR036, message, "reverse both signs, as `RevSigns X I`, or none");
    }
    let mirrored = reversed(piece.axes[0]) != reversed(piece.axes[1]);
    let own = if ccw != mirrored { 3.0 } else { 2.0 };
    let typed = |number: f64| routine.is_some_and(|routine| prints_code(routine, |code| code.is_g(number), shape));
    let wrong = match routine {
        Some(_) => typed(5.0 - own) && !typed(own),
        None => code.value() == 5.0 - own,
    };
    if wrong && (0..shape.linear).any(reversed) {
        let message = match mirrored {
            true => {
                "one axis of the arc's plane is reversed, but the arc codes are not exchanged: the arc would turn in \
                 the opposite direction"
            }
            false => {
                "the arc codes are exchanged, but not exactly one axis of the arc's plane is reversed: the arc would \
                 turn in the opposite direction"
            }
        };
        let help = "if one axis of the plane is reversed, exchange the codes, `CW G3` and `CCW G2`; leave other \
            planes out of `ArcPlane`";
        return fault(Code::PR036, message, help);
    }
    Ok(())
}

/// The arc's centre in the way that the form requires: relative to the printed start of the arc, or absolute.
pub fn centre_values(piece: &Piece, shape: &Shape, said: &Said) -> Done<[f64; 2]> {
    let mut values = piece.arc.centre;
    let mirrored = |axis: usize| shape.scales[axis] < 0.0;
    if shape.program.settings.centre_incremental {
        for (value, &axis) in values.iter_mut().zip(&piece.axes) {
            // the control starts at the printed position, not at the exact position of the job
            *value -= as_printed_back(axis, said.stand.position.values[axis], shape)?;
        }
    }
    for (value, &axis) in values.iter_mut().zip(&piece.axes) {
        *value = if mirrored(axis) { -*value } else { *value };
    }
    Ok(values)
}

pub fn centre_words(piece: &Piece, centre: &[f64; 2], shape: &Shape, out: &mut Printer) -> Done {
    let sweep = piece.arc.sweep.abs();
    match centre_by(&shape.program.settings, sweep) {
        ArcCentre::Radius(letter) => {
            let radius = if sweep > PI + 1e-9 { -piece.arc.radius } else { piece.arc.radius };
            arc_word(*letter, radius, shape, out)
        }
        ArcCentre::Letters(letters) => {
            // axis order: I J, I K, J K
            let mut order = [0, 1];
            if piece.axes[0] > piece.axes[1] {
                order = [1, 0];
            }
            for i in order {
                if let Some(letter) = centre_letter(letters, piece.axes[i], shape) {
                    arc_word(letter, centre[i], shape, out)?;
                }
            }
            Ok(())
        }
    }
}

/// Prints a centre word. A centre word is always printed and never stored in a register.
pub fn arc_word(letter: u8, value: f64, shape: &Shape, out: &mut Printer) -> Done {
    let info = &shape.letters[letter];
    let units = quantised(info, value)?;
    out.letter(info, units, false)
}

pub fn set_arc_variables(piece: &Piece, centre: &[f64; 2], shape: &Shape, want: &mut Want) {
    const VALUES: [VarId; 3] = [VarId::Ival, VarId::Jval, VarId::Kval];
    const CENTRES: [Option<VarId>; 3] = [Some(VarId::Hctr), Some(VarId::Vctr), None];
    for var in VALUES.into_iter().chain(CENTRES.into_iter().flatten()) {
        want.put(var, None);
    }
    for (i, &axis) in piece.axes.iter().enumerate() {
        want.set(VALUES[axis], centre[i]);
        if let Some(var) = CENTRES[axis] {
            want.set(var, piece.arc.centre[i] * shape.scales[axis].signum());
        }
    }
    let degrees = |angle: f64| (angle.to_degrees() % 360.0 + 360.0) % 360.0;
    // for a turret on the other side, angles are mirrored
    let way = if piece.axes.iter().any(|&axis| shape.scales[axis] < 0.0) { -1.0 } else { 1.0 };
    let (start, sweep) = (piece.arc.start * way, piece.arc.sweep * way);
    want.set(VarId::Arcrad, piece.arc.radius);
    want.set(VarId::Startang, degrees(start));
    want.set(VarId::Endang, degrees(start + sweep));
    want.set(VarId::Sweep, sweep.to_degrees());
}

/// The form's centre format for an arc with this sweep angle.
fn centre_by(settings: &Settings, sweep: f64) -> &ArcCentre {
    let over = sweep > PI + 1e-9;
    let full = sweep > 2.0 * PI - 1e-9;
    match (&settings.centre_full, &settings.centre_over_180) {
        (Some(words), _) if full => words,
        (_, Some(words)) if over && !full => words,
        _ => &settings.centre,
    }
}
