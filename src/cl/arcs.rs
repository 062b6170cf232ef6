//! Arcs: CIRCLE and MOVARC before a GOTO, and CATIA's TLON.

use super::dialect::{Dialect, Sense};
use super::motion::numbers;
use super::reader::{Done, Reader, fault};
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::{Arc, Axes, Direction, Event, Plane, Units};

/// A direction in space, of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading(pub [f64; 3]);

impl Heading {
    /// From one point to another.
    pub(super) fn between(from: [f64; 3], to: [f64; 3]) -> Option<Heading> {
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        (length > 1e-9).then(|| Heading(way.map(|c| c / length)))
    }
}

/// A circle that the next GOTO cuts along.
#[derive(Clone, Copy, Debug)]
pub(super) struct PendingArc {
    centre: [f64; 3],
    /// Which of x, y, z its axis is, and whether it points up.
    axis: usize,
    up: bool,
    /// The radius, where it is said.
    radius: Option<f64>,
    /// The sense, where the statement itself has one.
    sense: Option<Sense>,
}

/// Cosine of the angle under which an arc still leaves the motion before it along its tangent: 8 degrees.
const TANGENT: f64 = 0.99;

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Reader<'_> {
    /// CIRCLE/x,y,z[,i,j,k][,r,..]: the centre, the axis; its end is the next GOTO.
    pub(super) fn circle(&mut self, words: &[Word], sense: Option<Sense>) -> Done {
        if self.dialect() == Dialect::Ncl {
            let help = "its points follow as lines; let NCL write arcs for a smoother program";
            self.warn(Code::PL008, "a CIRCLE of NCL is printed as lines to its points", help);
            return Ok(());
        }
        if self.cycle.is_active() {
            return fault(Code::PC042, "an arc inside a cycle", "end the cycle before with CYCLE/OFF");
        }
        let values = numbers(words).unwrap_or_default();
        let (centre, axis, radius) = match values.as_slice() {
            [x, y, z] => ([*x, *y, *z], [0.0, 0.0, 1.0], None),
            [x, y, z, radius] => ([*x, *y, *z], [0.0, 0.0, 1.0], Some(*radius)),
            [x, y, z, i, j, k, rest @ ..] => ([*x, *y, *z], [*i, *j, *k], rest.first().copied()),
            _ => return fault(Code::PL001, "a CIRCLE that can't be read", "write CIRCLE/x,y,z,i,j,k,r"),
        };
        let along = (0..3).find(|&i| axis[i].abs() > 0.999_999);
        let Some(along) = along else {
            return fault(Code::PL004, "an arc in a tilted plane", "let the CAM system write lines for it");
        };
        let centre = [centre[0] + self.offset[0], centre[1] + self.offset[1], centre[2] + self.offset[2]];
        self.arc = Some(PendingArc { centre, axis: along, up: axis[along] > 0.0, radius, sense });
        Ok(())
    }

    /// The GOTO after a CIRCLE.
    pub(super) fn arc_to(&mut self, arc: &PendingArc, to: [f64; 3], rapid: bool) -> Done {
        if rapid {
            return fault(Code::PL004, "a rapid along an arc", "take RAPID out, or CIRCLE");
        }
        let Some(from) = self.position else {
            return fault(Code::PR005, "the arc begins at an unknown position", "put a GOTO before it");
        };
        let away = (0..3).filter(|&i| i != arc.axis).map(|i| (from[i] - arc.centre[i]).powi(2)).sum::<f64>().sqrt();
        let allowed = if self.units_so_far()? == Units::Inch { 0.001 } else { 0.02 };
        if let Some(radius) = arc.radius.filter(|radius| (radius.abs() - away).abs() > allowed) {
            let message = format!("the CIRCLE has the radius {radius}, the tool is {away:.4} from its centre");
            return fault(Code::PR005, message, "look at the motion before it");
        }
        // GENER's own circles are left-handed, but only a file that is said to be GENER's is taken for one
        let gener = self.options.dialect.filter(|dialect| *dialect == Dialect::Gener).map(|_| Sense::LeftHand);
        let sense = match arc.sense.or(self.dialect().sense()).or(gener) {
            Some(sense) => sense,
            None => self.sense_by_tangent(arc, from)?,
        };
        let ccw = (sense == Sense::RightHand) == arc.up;
        self.arc_event(arc, to, ccw)
    }

    fn arc_event(&mut self, arc: &PendingArc, to: [f64; 3], ccw: bool) -> Done {
        if self.compensation.is_some() {
            let help = "put a straight motion between CUTCOM and the arc";
            return fault(Code::PL004, "cutter compensation can't begin or end on an arc", help);
        }
        let mut unit = [0.0; 3];
        unit[arc.axis] = if ccw { 1.0 } else { -1.0 };
        let radius = [to[0] - arc.centre[0], to[1] - arc.centre[1], to[2] - arc.centre[2]];
        self.heading = Heading::between([0.0; 3], cross(unit, radius));
        self.position = Some(to);
        let event = Arc {
            to: Axes::new(&to),
            center: Some(Axes::new(&arc.centre)),
            radius: None,
            direction: if ccw { Direction::Ccw } else { Direction::Cw },
            plane: [Plane::Yz, Plane::Xz, Plane::Xy][arc.axis],
            turns: 0,
        };
        let feed = self.feed_to_say()?;
        self.push(Event::Arc { arc: &event, feed })
    }

    /// Which way circles turn in a file of an unknown system: its arcs leave the motion before them along their
    /// tangent, and all must agree.
    fn sense_by_tangent(&mut self, arc: &PendingArc, from: [f64; 3]) -> Done<Sense> {
        let mut unit = [0.0; 3];
        unit[arc.axis] = if arc.up { 1.0 } else { -1.0 };
        let radius = [from[0] - arc.centre[0], from[1] - arc.centre[1], from[2] - arc.centre[2]];
        let tangent = Heading::between([0.0; 3], cross(unit, radius));
        let seen = match (tangent, self.heading) {
            (Some(tangent), Some(heading)) if dot(tangent.0, heading.0) > TANGENT => Some(Sense::RightHand),
            (Some(tangent), Some(heading)) if dot(tangent.0, heading.0) < -TANGENT => Some(Sense::LeftHand),
            _ => None,
        };
        let help = "say with `--dialect` whose circles these are: those of nx, makino and gener turn clockwise about their \
                    axis, those of solidworks counter-clockwise";
        match (self.sense, seen) {
            (Some(before), Some(now)) if before != now => {
                fault(Code::PL006, "this arc turns the other way than those before it, if it is tangent", help)
            }
            (Some(sense), _) | (None, Some(sense)) => {
                self.sense = Some(sense);
                Ok(sense)
            }
            (None, None) => fault(Code::PL006, "which way this CIRCLE turns is not known", help),
        }
    }

    /// INDIRV: the direction in which the next TLON leaves.
    pub(super) fn indirv(&mut self, words: &[Word]) -> Done {
        match numbers(words).as_deref() {
            Some([i, j, k]) => {
                self.direction = Some([*i, *j, *k]);
                Ok(())
            }
            _ => fault(Code::PL001, "INDIRV takes a vector", "write i, j, k"),
        }
    }

    /// TLON,GOFWD/(CIRCLE/x,y,z,r),ON,[n,INTOF,](LINE/x,y,z,x,y,z): an arc to the line's second point.
    pub(super) fn tlon(&mut self, words: &[Word]) -> Done {
        let number = |at: usize| words.get(at).and_then(Word::number);
        let circle = words.iter().position(|word| word.is("CIRCLE"));
        let line = words.iter().position(|word| word.is("LINE"));
        let point = |at: usize| Some([number(at)?, number(at + 1)?, number(at + 2)?]);
        let read = circle.zip(line).and_then(|(circle, line)| Some((point(circle + 1)?, point(line + 4)?)));
        let (Some((centre, to)), Some(direction)) = (read, self.direction.take()) else {
            let help = "only INDIRV, then TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z) is";
            return fault(Code::PL004, "a TLON that can't be read", help);
        };
        let Some(from) = self.position else {
            return fault(Code::PR005, "the arc begins at an unknown position", "put a GOTO before it");
        };
        if self.cycle.is_active() {
            return fault(Code::PC042, "an arc inside a cycle", "end the cycle before with CYCLE/OFF");
        }
        if self.rapid {
            return fault(Code::PL004, "a rapid along an arc", "take RAPID out");
        }
        let shift = |p: [f64; 3]| [p[0] + self.offset[0], p[1] + self.offset[1], p[2] + self.offset[2]];
        let (centre, to) = (shift(centre), shift(to));
        let radius = [from[0] - centre[0], from[1] - centre[1], 0.0];
        let turn = cross(radius, direction)[2];
        if turn.abs() < 0.1 * radius[0].hypot(radius[1]) * direction[0].hypot(direction[1]) {
            let help = "INDIRV must lie along the arc";
            return fault(Code::PL004, "INDIRV points to the centre, so nothing says which way the arc turns", help);
        }
        self.point = Some(to);
        self.arc_event(&PendingArc { centre, axis: 2, up: true, radius: None, sense: None }, to, turn > 0.0)
    }
}
