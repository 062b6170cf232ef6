//! Arcs: what the form can print of them, in whole, in parts, or as chords.

use std::f64::consts::PI;

use super::codes::Shift;
use super::fault::{Done, fault, fault_at};
use super::geometry::PlaneArc;
use super::motion::MOVE_VARS;
use super::move_words::AxisUnits;
use super::numbers::{as_number, quantised};
use super::renderer::{LastMove, Renderer};
use super::words::Mode;
use crate::compile::Routine;
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId, VarSet};
use crate::sema::{self, ArcCentre};
use crate::toolpath::{Arc, Axes, Direction, Plane, Units};

/// The axes of a plane in the order that makes counter-clockwise positive, the axis across it, the plane's code.
fn plane_axes(plane: Plane) -> ([usize; 2], usize, f64) {
    match plane {
        Plane::Xy => ([0, 1], 2, 17.0),
        Plane::Xz => ([2, 0], 1, 18.0),
        Plane::Yz => ([1, 2], 0, 19.0),
    }
}

/// Variables that say where an arc's centre is.
pub(super) const CENTRES: VarSet = VarSet::of(&[VarId::Ival, VarId::Jval, VarId::Kval, VarId::Hctr, VarId::Vctr]);

/// The variables of the centre along each axis.
const CENTRE_OF: [&[VarId]; 3] = [&[VarId::Ival, VarId::Hctr], &[VarId::Jval, VarId::Vctr], &[VarId::Kval]];

/// Does a sequence say where an arc ends by its centre and the angle there?
fn ends_by_angle(routine: &Routine, axes: [usize; 2]) -> bool {
    let angle = routine.vars.has(VarId::Endang) || routine.vars.has(VarId::Sweep);
    angle && axes.iter().all(|&axis| CENTRE_OF[axis].iter().any(|&var| routine.vars.has(var)))
}

/// An arc or a part of one, ready to print.
pub(super) struct Piece<'a> {
    pub(super) axes: [usize; 2],
    pub(super) plane: &'a sema::Code,
    pub(super) arc: PlaneArc,
    pub(super) target: Axes,
}

impl Piece<'_> {
    /// The piece from one part of the sweep to another, of an arc that begins at `from`.
    pub(super) fn part(&self, from: &Axes, done: f64, part: f64, across: usize) -> Piece<'_> {
        let arc = &self.arc;
        let mut target = *from;
        if part == 1.0 {
            target = self.target;
        } else {
            // after whole turns it is where it began, to the last digit: else a turn would be an arc of no length
            let turns = arc.sweep * part / (2.0 * PI);
            if (turns - turns.round()).abs() > 1e-9 {
                let point = arc.point(part);
                target.values[self.axes[0]] = point[0];
                target.values[self.axes[1]] = point[1];
            }
            let rise = self.target.values[across] - from.values[across];
            target.values[across] = from.values[across] + rise * part;
        }
        let piece = PlaneArc { start: arc.start + arc.sweep * done, sweep: arc.sweep * (part - done), ..*arc };
        Piece { axes: self.axes, plane: self.plane, arc: piece, target }
    }
}

impl Renderer<'_> {
    /// An arc of the path.
    pub(super) fn arc(&mut self, arc: &Arc, feed: Option<f64>) -> Done {
        let mut target = self.reach(&arc.to, false)?;
        self.take_feed(feed)?;
        let (axes, across, code) = plane_axes(arc.plane);
        if self.compensated && arc.plane != Plane::Xy && self.shape.program.settings.machine == Machine::Mill {
            let help = "end the compensation with an `outfeed` before";
            return fault(Code::PR006, "an arc in another plane under cutter compensation", help);
        }
        let Some(from) = self.in_plane(&self.position, axes) else {
            let help = "begin with a rapid that gives all coordinates";
            return fault(Code::PR005, "the arc begins at an unknown position", help);
        };
        let Some(to) = self.in_plane(&target, axes) else {
            return fault(Code::PR005, "the arc ends at an unknown position", "give both coordinates of its plane");
        };
        let ccw = arc.direction == Direction::Ccw;
        let centre = self.centre(arc, axes, from, to, ccw)?;
        let coarse = self.check_radii(axes, from, to, centre)?;
        target.given |= self.position.given;
        if self.attention {
            self.attend_here(true)?;
        }
        self.stands_at_cut()?;
        self.set_targets(&target)?;
        if self.shape.watches_moves {
            self.upons(MOVE_VARS)?;
        }
        if self.differs(&self.position, 1 << axes[0] | 1 << axes[1]) && !self.shape.program.settings.incremental {
            // the control must begin where its centre is counted from
            let here = self.position;
            self.set_targets(&here)?;
            self.line_to(&here)?;
            self.set_targets(&target)?;
        }
        let shape = PlaneArc::new(from, to, centre, ccw, arc.turns);
        let climbs = self.differs_by(&target, across);
        if self.shape.measures {
            let rise = target.values[across] - self.position.values[across];
            self.measured((shape.radius * shape.sweep.abs()).hypot(if climbs { rise } else { 0.0 }), true);
        }
        if !self.shape.program.settings.limits.is_empty() {
            self.check_arc(&shape, axes, &target)?;
        }
        let settings = &self.shape.program.settings;
        let plane = settings.planes.iter().find(|plane| plane.value == code);
        let scale = self.shape.form_scale;
        let printable = shape.radius >= settings.min_radius * scale
            && shape.radius <= settings.max_radius * scale
            && (settings.helical && self.shape.linear == 3 || !climbs)
            && (3..6).all(|axis| !self.differs_by(&target, axis));
        let shrinks = self.ends_meet(&target, axes) && shape.sweep.abs() < PI;
        if let Some(differ) = coarse {
            let message = format!("the arc is printed as lines: in the form's digits its radii differ by {differ:.4}");
            self.out.note(Code::PR024, message, "give the axes and centre words more decimals");
        }
        match plane {
            Some(plane) if printable && !shrinks && coarse.is_none() => match self.has_centre_words(axes, ccw) {
                true => self.pieces(&Piece { axes, plane, arc: shape, target }, across),
                false => {
                    self.note_lines(axes, ccw);
                    self.chords(&shape, axes, &target)
                }
            },
            _ => self.chords(&shape, axes, &target),
        }
    }

    /// Travel limits where the arc reaches farthest.
    fn check_arc(&self, arc: &PlaneArc, axes: [usize; 2], target: &Axes) -> Done {
        let mut parts = Vec::new();
        arc.quadrant_parts(&mut parts);
        for part in parts {
            let (mut at, point) = (*target, arc.point(part));
            (at.values[axes[0]], at.values[axes[1]]) = (point[0], point[1]);
            self.check_limits(&at)?;
        }
        Ok(())
    }

    fn in_plane(&self, position: &Axes, axes: [usize; 2]) -> Option<[f64; 2]> {
        Some([position.get(axes[0])?, position.get(axes[1])?])
    }

    /// Does the target move along this axis at all?
    fn differs_by(&self, target: &Axes, axis: usize) -> bool {
        target.get(axis).is_some() && target.get(axis) != self.position.get(axis)
    }

    fn centre(&self, arc: &Arc, axes: [usize; 2], from: [f64; 2], to: [f64; 2], ccw: bool) -> Done<[f64; 2]> {
        if let Some(centre) = &arc.center {
            return match (centre.get(axes[0]), centre.get(axes[1])) {
                (Some(a), Some(b)) => Ok([a * self.shape.scale, b * self.shape.scale]),
                _ => fault(Code::PR005, "the arc's centre lacks a coordinate of its plane", "give both"),
            };
        }
        let radius = arc.radius.unwrap_or(0.0) * self.shape.scale;
        match PlaneArc::centre_by_radius(from, to, radius, ccw) {
            Some(centre) => Ok(centre),
            None => fault(
                Code::PR005,
                format!("no arc of radius {} joins the ends", radius.abs()),
                "the ends are one point, or farther apart than the diameter: give the `center`",
            ),
        }
    }

    /// A value as the axis prints it.
    pub(super) fn printed(&self, axis: usize, value: f64) -> Done<f64> {
        let info = &self.shape.letters[self.shape.axes[axis]];
        let scale = self.shape.scales[axis];
        let units = quantised(info, value * scale)?;
        let number = as_number(units, info.format.dec.count) / scale;
        Ok(if info.reversed { -number } else { number })
    }

    /// Controls alarm, or cut something else, when start and end have different radii: the job's is an error. Whether
    /// the form's digits make it so: then lines say it better.
    fn check_radii(&self, axes: [usize; 2], from: [f64; 2], to: [f64; 2], centre: [f64; 2]) -> Done<Option<f64>> {
        let allowed = if self.shape.units == Units::Mm { 0.01 } else { 0.0005 } + 1e-9;
        let radius = |point: [f64; 2]| (point[0] - centre[0]).hypot(point[1] - centre[1]);
        let (start, end) = (radius(from), radius(to));
        if (start - end).abs() > allowed {
            let message = format!("the arc's radius is {start:.6} at its start and {end:.6} at its end");
            return fault(Code::PR005, message, "look at the centre: both ends must be equally far from it");
        }
        let mut radii = [0.0; 2];
        for (radius, point) in radii.iter_mut().zip([from, to]) {
            let a = self.printed(axes[0], point[0])? - self.printed(axes[0], centre[0])?;
            let b = self.printed(axes[1], point[1])? - self.printed(axes[1], centre[1])?;
            *radius = a.hypot(b);
        }
        let differ = (radii[0] - radii[1]).abs();
        Ok((differ > allowed).then_some(differ))
    }

    /// Do both ends print alike? A short arc would then become a full circle.
    fn ends_meet(&self, target: &Axes, axes: [usize; 2]) -> bool {
        axes.iter().all(|&axis| {
            let printed = |value: f64| self.printed(axis, value).ok();
            printed(target.values[axis]) == printed(self.position.values[axis])
        })
    }

    fn has_centre_words(&self, axes: [usize; 2], ccw: bool) -> bool {
        if let Some(routine) = self.shape.program.routine(if ccw { SequenceId::CcwCode } else { SequenceId::CwCode }) {
            let says = |axis: usize| CENTRE_OF[axis].iter().any(|&var| routine.vars.has(var));
            let planes = [Plane::Xy, Plane::Xz, Plane::Yz].map(plane_axes);
            let own = planes.into_iter().find(|plane| plane.0 == axes).map(|plane| plane.2);
            let elsewhere = self.says_code(routine, b'G', |code| self.is_plane(code) && Some(code) != own);
            return !elsewhere && (routine.vars.has(VarId::Arcrad) || axes.iter().all(|&axis| says(axis)));
        }
        match &self.shape.program.settings.centre {
            ArcCentre::Radius(_) => true,
            ArcCentre::Letters(letters) => axes.iter().all(|&axis| self.centre_letter(letters, axis).is_some()),
        }
    }

    /// Says once that a sequence can't print an arc which it is there for.
    fn note_lines(&mut self, axes: [usize; 2], ccw: bool) {
        let id = if ccw { SequenceId::CcwCode } else { SequenceId::CwCode };
        if self.shape.program.routine(id).is_some() && !self.out.notes().iter().any(|note| note.code == Code::PR024) {
            let [first, second] = axes.map(|axis| ["[ival]", "[jval]", "[kval]"][axis]);
            let message = format!("the arc is printed as lines: {} does not print {first} and {second}", id.name());
            self.out.note(Code::PR024, message, "print both, or the radius as [arcrad]");
        }
    }

    /// Prints an arc in as many parts as the form needs.
    fn pieces(&mut self, whole: &Piece, across: usize) -> Done {
        let settings = &self.shape.program.settings;
        let arc = &whole.arc;
        let turn = 2.0 * PI;
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        if settings.by_quadrants {
            arc.quadrant_parts(&mut parts);
        } else {
            let sequence = if arc.sweep > 0.0 { SequenceId::CcwCode } else { SequenceId::CwCode };
            let routine = self.shape.program.routine(sequence);
            // a sequence that prints the radius and no centre can't say more than half a turn
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
            // radius words can't say a full circle, and over 180 degrees only when the form has a way
            arc.equal_parts(most, &mut parts);
            self.divide_for_radius(whole, across, &mut parts)?;
        }
        parts.push(1.0);
        let (from, mut done) = (self.position, 0.0);
        let whole_feed = self.feed;
        for &part in &parts {
            self.share_of_time(whole_feed, part - done);
            self.piece(&whole.part(&from, done, part, across))?;
            done = part;
        }
        self.share_of_time(whole_feed, 1.0);
        self.parts = parts;
        Ok(())
    }

    /// In inverse time a part of a move has a part of its time.
    fn share_of_time(&mut self, whole: Option<f64>, part: f64) {
        if self.inverse_time() {
            self.keep_feed(whole.map(|feed| feed / part));
        }
    }

    /// Prints one arc block or the form's sequence for it.
    fn piece(&mut self, piece: &Piece) -> Done {
        let program = self.shape.program;
        let settings = &program.settings;
        if self.ends_meet(&piece.target, piece.axes) && piece.arc.sweep.abs() < PI {
            self.set_targets(&piece.target)?;
            return self.line_to(&piece.target); // as an arc it would be a full circle
        }
        // a turret on the other side sees the arc in a mirror
        let ccw = (piece.arc.sweep > 0.0) != piece.axes.iter().any(|&axis| self.shape.scales[axis] < 0.0);
        let centre = self.centre_values(piece)?;
        self.set_targets(&piece.target)?;
        self.set_arc_variables(piece, &centre);
        let kind = if ccw { LastMove::Ccw } else { LastMove::Cw };
        let restate = match self.last_move {
            LastMove::Line => !settings.arc_with_line,
            last => last == kind && !settings.arc_with_same,
        };
        let code = if ccw { &settings.ccw } else { &settings.cw };
        if restate && self.motion_in_force(code) {
            self.registers.forget_group(Group::Motion);
        }
        if self.last_move == LastMove::Rapid && !settings.force.is_empty() {
            self.force();
        }
        self.shifted = Shift::None;
        let routine = program.routine(if ccw { SequenceId::CcwCode } else { SequenceId::CwCode });
        self.check_signs(piece, routine, code, ccw)?;
        if let Some(routine) = routine {
            let [a, b] = piece.axes;
            let polar =
                ends_by_angle(routine, piece.axes) && !(self.says_axis(routine, a) && self.says_axis(routine, b));
            let said = if polar { 1 << a | 1 << b } else { 0 };
            self.sequence_says(routine, &Axes { given: piece.target.given & !said, ..piece.target })?;
            self.upons(routine.vars)?;
            self.plane_block(piece.plane.value, routine)?;
            self.says_arc(routine, code)?;
            self.feed_block(code, routine)?;
            self.shifted = Shift::None;
            self.run(routine.ops.clone(), Mode::ArcMotion)?;
            if polar {
                // the control knows where it is, and the letters of these axes say something older
                for axis in piece.axes {
                    self.registers.forget(self.shape.letters[self.shape.axes[axis]].printed);
                }
                self.registers.forget_group(Group::Motion); // G12 is a motion that no group knows
            }
        } else {
            self.arc_block(piece, code, &centre, ccw)?;
        }
        self.position = piece.target;
        self.last_move = kind;
        Ok(())
    }

    /// A sequence of arcs must print a code of its own: an arc code in a block before it would have no end.
    fn says_arc(&self, routine: &Routine, code: &sema::Code) -> Done {
        if !self.shape.program.speaks_g || self.motion_in_force(code) || self.says_own_motion(routine) {
            return Ok(());
        }
        let message = format!("the sequence prints no G{}, and the control is in another motion", code.value);
        fault_at(Code::PR017, message, format!("begin its block with G{}", code.value), Some(routine.span))
    }

    /// The generated block: plane, motion code, axes, centre, direction, feed.
    fn arc_block(&mut self, piece: &Piece, code: &sema::Code, centre: &[f64; 2], ccw: bool) -> Done {
        let settings = &self.shape.program.settings;
        if self.shape.program.settings.machine == Machine::Mill {
            self.motion_word(piece.plane)?; // a lathe and a wire have but one
        }
        if !self.differs(&piece.target, 0x3f) {
            // a whole circle has no axis words: controls want its code said again
            self.registers.forget_group(Group::Motion);
        }
        self.motion_word(code)?;
        let mut axes = AxisUnits::default();
        self.axis_units(&piece.target, &mut axes)?;
        self.axis_words(&piece.target, &axes)?;
        if let Some(word) = &settings.second_circle {
            self.out.end_block();
            self.out.text(word, false);
        }
        self.centre_words(piece, centre)?;
        if let Some([cw, ccw_word]) = &settings.circle_direction {
            let word = if ccw { ccw_word } else { cw };
            self.out.text(word, false);
        }
        self.feed_word()?;
        self.out.end_block();
        Ok(())
    }

    /// An arc that the form can't print, as lines within its tolerance.
    fn chords(&mut self, arc: &PlaneArc, axes: [usize; 2], target: &Axes) -> Done {
        let mut from = self.position;
        for axis in self.turned_axes(target) {
            match self.angle(axis) {
                Some(angle) => from.set(axis, angle),
                None => {
                    return fault(
                        Code::PR005,
                        "the arc turns from an unknown angle",
                        "begin with a rapid that says it",
                    );
                }
            }
        }
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        arc.equal_parts(arc.chord_angle(self.shape.program.settings.tolerance * self.shape.form_scale), &mut parts);
        let (whole_feed, share) = (self.feed, 1.0 / (parts.len() + 1) as f64);
        self.share_of_time(whole_feed, share);
        for &part in &parts {
            let mut to = *target;
            for axis in 0..6 {
                if from.given & 1 << axis != 0 {
                    to.values[axis] = from.values[axis] + (target.values[axis] - from.values[axis]) * part;
                }
            }
            let point = arc.point(part);
            to.values[axes[0]] = point[0];
            to.values[axes[1]] = point[1];
            self.set_targets(&to)?;
            self.line_to(&to)?;
        }
        self.parts = parts;
        self.set_targets(target)?;
        self.line_to(target)?;
        self.share_of_time(whole_feed, 1.0);
        Ok(())
    }
}
