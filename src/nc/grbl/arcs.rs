//! Arcs of Grbl: G2 and G3.

use super::error::refuse;
use crate::nc::action::{Action, Turn};
use crate::nc::arcs::{CENTERS, axes_of, center_of};
use crate::nc::block::Block;
use crate::nc::codes::letters;
use crate::nc::fault::Done;
use crate::nc::out::Out;
use crate::nc::state::State;
use crate::toolpath::{Direction, Units};

impl State {
    /// Makes an arc or helix. The centre is measured from the start of the arc. A centre word for the axis
    /// perpendicular to the plane is ignored.
    pub(super) fn grbl_arc(&mut self, direction: Direction, block: &Block, out: &mut Out<'_>) -> Done {
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let [first, second, _] = axes_of(self.modes.plane);
        let from = self.place.position;
        let to = self.target(block)?;
        let tolerance = self.control.arc_tolerance(self.modes.units == Units::Inch);
        let words = [first, second].map(|axis| block.get(CENTERS[axis]));
        let mut center = [from[0], from[1], from[2]];
        if let Some(radius) = block.get(b'R') {
            if block.has(letters("IJK")) {
                return refuse(36);
            }
            let (a, b) = ([from[first], from[second]], [to[first], to[second]]);
            if from[..3] == to[..3] {
                return refuse(33);
            }
            let Ok(at) = center_of(a, b, radius, direction, tolerance.chord) else { return refuse(34) };
            (center[first], center[second]) = (at[0], at[1]);
        } else if words == [None; 2] {
            return refuse(35);
        } else {
            center[first] += words[0].unwrap_or(0.0);
            center[second] += words[1].unwrap_or(0.0);
            let radius = |at: &[f64; 6]| (at[first] - center[first]).hypot(at[second] - center[second]);
            if tolerance.refuses(radius(&from), radius(&to)) {
                return refuse(33);
            }
        }
        self.place.reaches(to);
        let (plane, machine) = (self.modes.plane, self.place.at_machine);
        out.push(Action::Arc(Turn { to, center, plane, direction, turns: 0, feed, machine }));
        Ok(())
    }
}
