//! The drilling cycles G73 to G89, G274 and G284. The heights of these cycles are absolute. M52, M53 and M54 select the
//! return level.

use super::super::strokes::depths;
use crate::control::{Code as Name, Motions};
use crate::diag::Code;
use crate::nc::action::{Cycle as Drill, Drilling, Heights, Rotation};
use crate::nc::call::{Canned, Plan, Stand, Step};
use crate::nc::fault::{Done, refuse};

/// The return level of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Back {
    /// M52: the upper limit of the axis, whose position is known only at the machine.
    Top,
    /// M53: the level that `G71 Z` sets.
    Level(f64),
    /// M54: the R level.
    R,
}

/// A cycle with the active values of its words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// The code of the cycle.
    pub code: Name,
    /// The motions of the cycle.
    pub motions: Motions,
    /// For a tap: whether the feed follows the spindle.
    pub rigid: Option<bool>,
    /// The bottom of the hole: Z.
    pub depth: Option<f64>,
    pub r: Option<f64>,
    /// Q: the length of a peck, or the shift of a boring cycle.
    pub step: Option<f64>,
    /// I and J: the depths of chip breaks and retracts in G83, or the shift of G76.
    pub parts: [Option<f64>; 2],
    /// FA: the feed out of the hole.
    pub feed_out: Option<f64>,
    /// The return level.
    pub back: Option<Back>,
}

impl Cycle {
    /// Calculates the hole.
    ///
    /// # Errors
    /// The cycle lacks a word, or the documentation does not define the result.
    fn hole(&self, stand: &Stand) -> Done<Canned> {
        let name = self.code;
        let Some(r) = self.r else { return self.lacks("R", "write R and Z in the cycle's first block") };
        let Some(bottom) = self.depth else {
            return self.lacks("its depth", "write R and Z in the cycle's first block");
        };
        if bottom > r {
            return refuse(Code::PN011, format!("R {r} is below the bottom {bottom}"), "check R and Z");
        }
        let back = self.return_level(r)?;
        let top = self.back == Some(Back::Top);
        let leaves = if top { Step::Top } else { Step::Rapid(back) };
        let (feed, turning, speed) = (stand.feed, stand.turning, stand.speed);
        let turns = || match turning {
            Rotation::Stop => {
                refuse(Code::PN012, format!("{name} with the spindle stopped"), "write M3 or M4 before the cycle")
            }
            turning => Ok(turning),
        };
        let mut steps = vec![Step::Rapid(r)];
        let (mut peck, mut shift) = (0.0, [0.0; 2]);
        match self.motions {
            Motions::Drill => steps.push(Step::Feed(bottom, feed)),
            Motions::Chipbreak | Motions::Peck => peck = self.pecks([r, bottom], stand, &mut steps)?,
            Motions::Tap | Motions::LeftTap => self.tap([r, bottom], stand, &mut steps)?,
            Motions::FeedOut => {
                steps.extend([Step::Feed(bottom, feed), Step::Feed(r, self.feed_out.unwrap_or(feed))]);
            }
            Motions::StopOut => {
                let turning = turns()?;
                steps.extend([
                    Step::Feed(bottom, feed),
                    Step::Turn(Rotation::Stop, speed),
                    leaves,
                    Step::Turn(turning, speed),
                ]);
            }
            Motions::ShiftOut => {
                let turning = turns()?;
                shift = match (self.step, self.parts) {
                    (_, [i, j]) if i.is_some() || j.is_some() => [i.unwrap_or(0.0), j.unwrap_or(0.0)],
                    (Some(by), _) => [by * stand.bore_shift, 0.0],
                    _ => return self.lacks("its shift", "write Q, or I and J"),
                };
                let up = if top { r } else { back };
                steps.extend([
                    Step::Feed(bottom, feed),
                    Step::Orient(None),
                    Step::Aside([shift[0], shift[1], 0.0]),
                    Step::Aside([0.0, 0.0, up - bottom]),
                    Step::Rapid(up),
                ]);
                steps.extend(top.then_some(Step::Top));
                steps.push(Step::Turn(turning, speed));
            }
            Motions::Back | Motions::ByHand => {
                return refuse(Code::PN016, format!("{name} is not supported"), "program the moves of the cycle");
            }
        }
        let came = steps.iter().rev().find_map(|step| match step {
            Step::Rapid(height) | Step::Feed(height, _) => Some(*height),
            Step::Top => Some(f64::NAN),
            _ => None,
        });
        if came.is_some_and(|height| !height.is_nan() && (height != back || top)) {
            steps.push(leaves);
        }
        let hole = Drilling {
            cycle: Drill { code: name, motions: self.motions, dwells: false, rigid: self.rigid, start: None },
            at: stand.at,
            plane: stand.plane,
            r,
            bottom,
            clear: back,
            dwell: 0.0,
            peck,
            shift,
            level: bottom,
            feed,
            heights: if top { Heights::ButClear } else { Heights::Given },
        };
        Ok(Canned { hole, steps })
    }

    /// The error for a word that the cycle needs.
    fn lacks<T>(&self, what: &str, help: &'static str) -> Done<T> {
        refuse(Code::PN007, format!("{} without {what}", self.code), help)
    }

    /// The height to which the tool returns after the hole.
    fn return_level(&self, r: f64) -> Done<f64> {
        match self.back {
            None => {
                let help = "write M53 with G71 Z, or M54: without them the return level is unknown";
                self.lacks("M52, M53 or M54", help)
            }
            Some(Back::Level(level)) if level < r => {
                let message = format!("the level {level} of G71 is below R {r}");
                refuse(Code::PN011, message, "write a higher G71 Z")
            }
            Some(Back::Level(level)) => Ok(level),
            Some(Back::R | Back::Top) => Ok(r),
        }
    }

    /// Adds the strokes of a peck cycle. Returns the depth of a stroke.
    fn pecks(&self, [r, bottom]: [f64; 2], stand: &Stand, steps: &mut Vec<Step>) -> Done<f64> {
        let breaks = self.motions == Motions::Chipbreak;
        let (each, full) = match (self.step, self.parts) {
            (Some(each), [None, None]) => (each, if breaks { f64::INFINITY } else { 0.0 }),
            (None, [Some(each), Some(full)]) if !breaks => (each, full),
            _ => return self.lacks("Q", "write Q, or I and J with G83"),
        };
        let all = depths(r, bottom, each, |stroke, _| stroke)?;
        let last = all.len() - 1;
        let mut since = r;
        for (at, depth) in all.into_iter().enumerate() {
            steps.push(Step::Feed(depth, stand.feed));
            if at == last {
                break;
            }
            if since - depth + 1e-9 >= full {
                steps.push(Step::Rapid(r));
                since = depth;
            }
            steps.push(Step::Rapid((depth + stand.back_off).min(r)));
        }
        Ok(each)
    }

    /// Adds the steps of a tap.
    fn tap(&self, [r, bottom]: [f64; 2], stand: &Stand, steps: &mut Vec<Step>) -> Done {
        let inwards = if self.motions == Motions::Tap { Rotation::Cw } else { Rotation::Ccw };
        if self.step.is_some() {
            let message = format!("{} with Q is not supported", self.code);
            return refuse(Code::PN016, message, "leave Q out: the pecks of a tap are unknown");
        }
        if stand.turning != inwards {
            steps.push(Step::Turn(inwards, stand.speed));
        }
        steps.extend([
            Step::Feed(bottom, stand.feed),
            Step::Turn(inwards.reversed(), stand.speed),
            Step::Feed(r, stand.feed),
            Step::Turn(inwards, stand.speed),
        ]);
        Ok(())
    }
}

impl Plan for Cycle {
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>> {
        self.hole(stand).map(Some)
    }
}
