//! The views in which a picture can be drawn.

use super::{Picture, Register};
use crate::nc::FIRST_NAMED_TOOL;

/// The direction from which a picture is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From above: X to the right, Y up.
    Top,
    /// From the front, where the operator stands: X to the right, Z up.
    Front,
    /// From the right: Y to the right, Z up.
    Side,
    /// From the right, front and above.
    Iso,
    /// A lathe: Z to the right, X up.
    Lathe,
}

impl View {
    /// All views, with their names.
    pub const ALL: [(View, &'static str); 5] =
        [(View::Top, "top"), (View::Front, "front"), (View::Side, "side"), (View::Iso, "iso"), (View::Lathe, "lathe")];

    /// Name of the view.
    pub fn name(self) -> &'static str {
        View::ALL.iter().find(|(view, _)| *view == self).map_or("", |(_, name)| name)
    }

    /// Projects a position to the drawing: the first coordinate is to the right, the second up.
    pub fn project(self, at: [f64; 3]) -> [f64; 2] {
        const SQRT_6: f64 = 2.449_489_742_783_178;
        let [x, y, z] = at;
        match self {
            View::Top => [x, y],
            View::Front => [x, z],
            View::Side => [y, z],
            View::Iso => [(x + y) * std::f64::consts::FRAC_1_SQRT_2, (y - x + 2.0 * z) / SQRT_6],
            View::Lathe => [z, x],
        }
    }
}

impl Picture {
    /// A tool as text: its number, or its name if the number is unknown.
    pub(super) fn tool_text(&self, tool: f64) -> String {
        let name = self.tool_names.get((tool - FIRST_NAMED_TOOL) as usize).filter(|_| tool >= FIRST_NAMED_TOOL);
        name.map_or_else(|| format!("T{tool}"), |name| format!("T \"{name}\""))
    }

    /// The default view: the lathe view for lathe programs, the isometric view for all other programs.
    pub fn usual_view(&self) -> View {
        let still = self.moves.iter().all(|found| found.to[1].is_nan() || found.to[1] == 0.0);
        let plane = self.changes.iter().rev().find(|change| change.register == Register::Plane);
        let turns = plane.is_some_and(|change| change.value == 18.0);
        if still && turns && !self.moves.is_empty() { View::Lathe } else { View::Iso }
    }
}
