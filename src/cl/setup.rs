//! Setups of a file with several tool axes. The operator turns the part between setups, so each setup is a separate
//! job. The z axis of a setup's frame is the tool axis of the setup.

use std::fmt;

use super::fault::{Done, fault};
use super::job::Job;
use super::vector::cross;
use crate::diag::Code;

/// Tolerance for the components of unit vectors.
const SAME: f64 = 1e-6;
/// Tolerance between the components of a tool axis and those of the z axis of its coordinate system.
const LIKE: f64 = 1e-3;
/// Maximum number of setups. A file for five-axis motion would have one setup for each motion.
const MOST: usize = 1000;
/// Maximum number of setups that a message lists.
const MOST_SAID: usize = 8;

/// A sequence of motions with one tool axis.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Setup {
    /// The tool axis in the file's coordinates, as a unit vector: the z axis of the setup.
    pub axis: [f64; 3],
    /// The x axis of the setup. If the file has a CSYS with the same z axis, the x axis of that CSYS is used. Otherwise
    /// the x axis is horizontal and points to the right for a view along the tool.
    pub x: [f64; 3],
    /// The origin of the setup's positions, if the file gives an origin for each setup (MCS). Otherwise the origin of the
    /// setup is that of the file.
    pub origin: Option<[f64; 3]>,
    /// The lines of the first and the last motion.
    pub lines: (u64, u64),
    /// Number of motions.
    pub motions: u64,
}

impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |v: [f64; 3]| v.map(|c| (c * 1e6).round() / 1e6 + 0.0).map(|c| c.to_string()).join(" ");
        let Setup { motions, lines: (first, last), .. } = self;
        write!(f, "tool axis {}, x axis {}, ", shown(self.axis), shown(self.x))?;
        if let Some(origin) = self.origin {
            write!(f, "origin {}, ", shown(origin))?;
        }
        write!(f, "{motions} motions in lines {first} to {last}")
    }
}

/// A frame, as its x, y and z axes in the file's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame([[f64; 3]; 3]);

impl Frame {
    /// Converts a vector in the file's coordinates to this frame.
    pub fn of(&self, vector: [f64; 3]) -> [f64; 3] {
        self.0.map(|direction| direction.iter().zip(vector).map(|(a, b)| a * b).sum())
    }
}

/// Whether the z axis of a coordinate system is parallel to a tool axis and has the same direction.
pub(super) fn lies_along(z: [f64; 3], axis: [f64; 3]) -> bool {
    z.iter().zip(axis).all(|(a, b)| (a - b).abs() < LIKE)
}

/// The setups so far, and the number of the selected one.
#[derive(Debug)]
pub(super) struct Setups {
    /// The selected setup, from 1; `None` if setups are only listed.
    chosen: Option<usize>,
    found: Vec<Setup>,
    /// The x and z axes of the current CSYS.
    csys: Option<[[f64; 3]; 2]>,
    /// Whether the current setup follows another setup and has no motion so far.
    pub is_fresh: bool,
}

impl Setups {
    pub fn new(chosen: Option<usize>) -> Setups {
        let mut setups = Setups { chosen, found: Vec::new(), csys: None, is_fresh: false };
        setups.turn([0.0, 0.0, 1.0]);
        setups
    }

    /// Handles a new tool axis. A setup without motions is removed. Returns whether another setup begins.
    pub fn turn(&mut self, axis: [f64; 3]) -> bool {
        let x = self.x_of(axis);
        self.begin(Setup { axis, x, origin: None, lines: (0, 0), motions: 0 }, |last| same(last.axis, axis))
    }

    /// Handles MCS, which gives the x and z axes and the origin of the positions after it. A setup without motions is
    /// removed. Returns whether another setup begins.
    pub fn mcs(&mut self, x: [f64; 3], axis: [f64; 3], origin: [f64; 3]) -> bool {
        let is_last = |last: &Setup| same(last.axis, axis) && same(last.x, x) && last.origin == Some(origin);
        self.begin(Setup { axis, x, origin: Some(origin), lines: (0, 0), motions: 0 }, is_last)
    }

    fn begin(&mut self, setup: Setup, is_last: impl Fn(&Setup) -> bool) -> bool {
        if self.found.last().is_some_and(|last| last.motions == 0) {
            self.found.pop();
            self.is_fresh = false;
        }
        let begins = !self.found.last().is_some_and(is_last) && self.found.len() < MOST;
        if begins {
            // the first setup is not fresh, because a file may begin with a cut
            self.is_fresh = !self.found.is_empty();
            self.found.push(setup);
        }
        begins
    }

    /// Whether the positions of the current setup are in its own frame, which MCS gives.
    pub fn has_own_frame(&self) -> bool {
        self.found.last().is_some_and(|last| last.origin.is_some())
    }

    /// Handles CSYS, which gives the x and z axes of a coordinate system.
    pub fn csys(&mut self, x: [f64; 3], z: [f64; 3]) {
        self.csys = Some([x, z]);
        if let Some(Setup { axis, .. }) = self.found.last().filter(|last| last.motions == 0) {
            let axis = *axis;
            self.turn(axis);
        }
    }

    /// The x axis of a setup. If the z axis of the CSYS is the tool axis, the result is the x axis of the CSYS.
    /// Otherwise the x axis is horizontal, as Fanuc defines it for G68.3.
    fn x_of(&self, axis: [f64; 3]) -> [f64; 3] {
        if let Some([x, z]) = self.csys
            && lies_along(z, axis)
        {
            // make it perpendicular to the tool axis of the motions
            return unit(cross(cross(axis, x), axis)).unwrap_or(x);
        }
        unit(cross([0.0, 0.0, 1.0], axis)).unwrap_or([1.0, 0.0, 0.0])
    }

    /// Counts a motion at this line.
    pub fn motion(&mut self, line: u64) {
        if let Some(last) = self.found.last_mut() {
            last.motions += 1;
            self.is_fresh = false;
            last.lines = (if last.motions == 1 { line } else { last.lines.0 }, line);
        }
    }

    /// Whether the current setup is the selected one.
    pub fn is_chosen(&self) -> bool {
        self.chosen == Some(self.found.len())
    }

    /// Whether the setups are only listed.
    pub fn are_listed(&self) -> bool {
        self.chosen.is_none()
    }

    /// Handles the end of the file.
    pub fn end(&self, job: &mut Job<'_>) -> Done {
        let Some(chosen) = self.chosen else { return Ok(()) };
        let found = self.found();
        if (1..=found.len()).contains(&chosen) {
            return job.finish();
        }
        let list: Vec<String> =
            found.iter().take(MOST_SAID).enumerate().map(|(i, setup)| format!("{}: {setup}", i + 1)).collect();
        let help = format!("it has {}: {}", found.len(), list.join("; "));
        fault(Code::PL004, format!("the file has no setup {chosen}"), help)
    }

    /// The frame to which the positions of the current setup are converted. `None`: they are in this frame.
    pub fn frame(&self) -> Option<Frame> {
        let Setup { axis, x, .. } = self.found.last().filter(|last| last.origin.is_none())?;
        Some(Frame([*x, cross(*axis, *x), *axis]))
    }

    /// The setups that have motions.
    pub fn found(&self) -> &[Setup] {
        let moved = self.found.iter().rposition(|setup| setup.motions > 0).map_or(0, |last| last + 1);
        &self.found[..moved]
    }
}

/// Whether two unit vectors are equal.
fn same(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME)
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    (length > SAME).then(|| v.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_that_nothing_moved_along_is_no_setup() {
        let mut setups = Setups::new(Some(2));
        setups.turn([1.0, 0.0, 0.0]);
        setups.turn([0.0, 0.0, 1.0]);
        setups.motion(5);
        assert!(!setups.is_chosen());
        setups.turn([0.0, -1.0, 0.0]);
        setups.turn([0.0, 0.0, 1.0]);
        setups.motion(6);
        assert_eq!(setups.found().len(), 1);
        setups.turn([0.0, -1.0, 0.0]);
        assert!(setups.is_chosen());
        setups.motion(7);
        assert_eq!(setups.found()[1].to_string(), "tool axis 0 -1 0, x axis 1 0 0, 1 motions in lines 7 to 7");
    }

    #[test]
    fn a_frame_turns_its_axis_upright() {
        let mut setups = Setups::new(Some(1));
        setups.turn([0.6, 0.0, 0.8]);
        let frame = setups.frame().unwrap();
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(frame.of([0.6, 0.0, 0.8]), [0.0, 0.0, 1.0]));
        // x is horizontal: the setup's x axis is the y axis of the part
        assert!(near(frame.of([0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]));
        // the CSYS of the CAM system has priority
        setups.csys([0.8, 0.0, -0.6], [0.6, 0.0, 0.8]);
        assert!(near(setups.frame().unwrap().of([0.0, 1.0, 0.0]), [0.0, 1.0, 0.0]));
    }
}
