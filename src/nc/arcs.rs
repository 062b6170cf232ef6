//! Arcs: G2 and G3.

use super::action::{Action, Turn};
use super::block::Block;
use super::codes::letters;
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::control::Tolerance;
use crate::diag::Code;
use crate::toolpath::{Direction, Plane, Units};

/// The indexes of the axes of a plane: the first axis, the second axis, and the axis perpendicular to the plane.
pub(crate) fn axes_of(plane: Plane) -> [usize; 3] {
    match plane {
        Plane::Xy => [0, 1, 2],
        Plane::Xz => [2, 0, 1],
        Plane::Yz => [1, 2, 0],
    }
}

/// The letters of the words for the centre of an arc, by axis.
pub(super) const CENTERS: [u8; 3] = *b"IJK";

impl State {
    /// Makes an arc or helix.
    pub(super) fn arc(&mut self, direction: Direction, block: &Block, out: &mut Out<'_>) -> Done {
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let [first, second, across] = axes_of(self.modes.plane);
        let from = self.place.position;
        let to = self.target(block)?;
        let words = [first, second].map(|axis| block.get(CENTERS[axis]));
        let mut center = [from[0], from[1], from[2]];
        match (block.get(b'R'), words) {
            (Some(_), _) if block.has(letters("IJK")) => {
                return refuse(Code::PN009, "an arc with R and with a centre", "write R, or I J K");
            }
            (Some(radius), _) => {
                let (a, b) = ([from[first], from[second]], [to[first], to[second]]);
                let at = center_of(a, b, radius, direction, self.arc_tolerance().chord)?;
                (center[first], center[second]) = (at[0], at[1]);
            }
            (None, [None, None]) => {
                return refuse(
                    Code::PN009,
                    "an arc without its centre",
                    "write R, or the centre as I J K of its plane",
                );
            }
            (None, words) => {
                for (axis, word) in [first, second].into_iter().zip(words) {
                    if !self.modes.centers_known {
                        let message = format!(
                            "the control file of {} does not give the origin of I and J (incremental or \
                                absolute)",
                            self.control.name()
                        );
                        return refuse(
                            Code::PN016,
                            message,
                            "write G91.1 before the first arc, or G90.1 if they are absolute",
                        );
                    }
                    if self.modes.centers_absolute {
                        let Some(value) = word else {
                            let help = "write both coordinates of the centre: G90.1 requires this";
                            return refuse(Code::PN009, "half a centre", help);
                        };
                        center[axis] = value;
                    } else {
                        center[axis] += word.unwrap_or(0.0);
                    }
                }
                self.check_radii(from, to, center)?;
            }
        }
        if block.get(CENTERS[across]).is_some() {
            let message = format!("{} is not a centre word of this plane", char::from(CENTERS[across]));
            return refuse(Code::PN009, message, "write the centre in the letters of the plane, or change the plane");
        }
        let turns = match block.get(b'P') {
            None => f64::from(block.turns + 1),
            Some(p) if p.fract() == 0.0 && (1.0..=1e6).contains(&p) && self.control.is_linuxcnc() => p,
            Some(p) => {
                return refuse(Code::PN018, format!("an arc with P{p}"), "only LinuxCNC has P, the number of turns");
            }
        };
        // the arc makes these full turns and then sweeps less than a full turn; if it ends at its start, it makes one
        // more full turn
        let machine = self.place.at_machine;
        let turn = Turn { to, center, plane: self.modes.plane, direction, turns: turns as u32 - 1, feed, machine };
        self.place.reaches(to);
        out.push(Action::Arc(turn));
        Ok(())
    }

    fn arc_tolerance(&self) -> Tolerance {
        self.control.arc_tolerance(self.modes.units == Units::Inch)
    }

    /// Checks that both ends of an arc lie on one circle.
    fn check_radii(&self, from: [f64; 6], to: [f64; 6], center: [f64; 3]) -> Done {
        let [first, second, _] = axes_of(self.modes.plane);
        let radius = |at: &[f64; 6]| (at[first] - center[first]).hypot(at[second] - center[second]);
        let (start, end) = (radius(&from), radius(&to));
        if start == 0.0 || self.arc_tolerance().refuses(start, end) {
            let message = format!("the arc begins at radius {start:.5} and ends at {end:.5}");
            return refuse(Code::PN009, message, "check the end, the centre, and G90.1 or G91.1");
        }
        Ok(())
    }
}

/// The centre of an arc with the given radius. With a negative radius, the arc takes the longer of the two ways around.
///
/// The radius may be too short by `slack`.
pub(super) fn center_of(from: [f64; 2], to: [f64; 2], radius: f64, direction: Direction, slack: f64) -> Done<[f64; 2]> {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let chord = dx.hypot(dy);
    if chord == 0.0 {
        return refuse(Code::PN009, "a full circle with R", "write its centre: R does not define a full circle");
    }
    let half = chord / 2.0;
    if half > radius.abs() + slack {
        let message = format!("R{radius} is too small: the ends are {chord:.5} apart");
        return refuse(Code::PN009, message, format!("R must be at least {half:.5}"));
    }
    let height = (radius * radius - half * half).max(0.0).sqrt();
    // the centre is to the left of the chord if the shorter of the two arcs is counterclockwise
    let left = (direction == Direction::Ccw) == (radius > 0.0);
    let side = if left { 1.0 } else { -1.0 };
    Ok([from[0] + dx / 2.0 - side * height * dy / chord, from[1] + dy / 2.0 + side * height * dx / chord])
}
