//! The drilling cycles of 840D and 828D, CYCLE81 to CYCLE89 and CYCLE840, as in the Programming Guide Cycles, section 2.1.

use super::super::strokes::{depths, dwell};
use super::arguments::{self, Argument, LEVELS, check_arguments};
use crate::control::{Code as Name, Motions};
use crate::diag::Code;
use crate::nc::action::{Cycle as Drill, Drilling, Heights, Rotation};
use crate::nc::call::{Canned, Plan, Stand, Step};
use crate::nc::fault::{Done, refuse};
use crate::toolpath::Units;

/// The pitches of metric coarse threads by nominal diameter, from ISO 261.
const COARSE: [(f64, f64); 21] = [
    (3.0, 0.5),
    (4.0, 0.7),
    (5.0, 0.8),
    (6.0, 1.0),
    (8.0, 1.25),
    (10.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (33.0, 3.5),
    (36.0, 4.0),
    (39.0, 4.0),
    (42.0, 4.5),
    (45.0, 4.5),
    (48.0, 5.0),
];

/// A call of a drilling cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Number of the cycle: 81 to 89, or 840.
    pub number: u16,
    /// The arguments in their order. An argument that is left out is `None`.
    pub arguments: Vec<Option<f64>>,
}

/// The heights that all cycles have.
struct Levels {
    /// The return level: RTP.
    back: f64,
    /// The reference plane at the top of the part: RFP.
    reference: f64,
    /// The height at which the feed begins: RFP + SDIS.
    r: f64,
    bottom: f64,
}

impl Cycle {
    /// Whether the cycle with this number is supported.
    pub fn is_known(number: u16) -> bool {
        arguments::of_cycle(number).is_some()
    }

    /// A call of a cycle.
    ///
    /// # Errors
    /// The cycle is not run with one of its arguments.
    pub fn new(number: u16, arguments: Vec<Option<f64>>) -> Done<Cycle> {
        let call = format!("CYCLE{number}");
        check_arguments(&call, &arguments[..arguments.len().min(LEVELS.len())], 0, &LEVELS)?;
        check_arguments(&call, &arguments, LEVELS.len(), arguments::of_cycle(number).unwrap_or_default())?;
        Ok(Cycle { number, arguments })
    }

    /// The arguments that postform does not simulate, with their values, unless the value is 0.
    pub fn not_simulated(&self) -> impl Iterator<Item = String> {
        let own = arguments::of_cycle(self.number).unwrap_or_default();
        self.arguments.iter().skip(LEVELS.len()).zip(own).filter_map(|(value, argument)| match (argument, value) {
            (Argument::Unsimulated(name), Some(value)) if *value != 0.0 => Some(format!("{name} {value}")),
            _ => None,
        })
    }

    fn get(&self, at: usize) -> f64 {
        self.arguments.get(at).copied().flatten().unwrap_or(0.0)
    }

    fn said(&self, at: usize) -> Option<f64> {
        self.arguments.get(at).copied().flatten()
    }

    fn levels(&self) -> Done<Levels> {
        let name = format!("CYCLE{}", self.number);
        let (Some(back), Some(reference)) = (self.said(0), self.said(1)) else {
            let help = "write RTP and RFP, the first two arguments of the cycle";
            return refuse(Code::PN007, format!("{name} without its retract or reference plane"), help);
        };
        let bottom = match (self.said(3), self.said(4)) {
            (Some(depth), None) => depth,
            (None, Some(below)) => reference - below.abs(),
            (Some(depth), Some(below)) if below == 0.0 || (depth - (reference - below.abs())).abs() < 1e-9 => depth,
            (Some(depth), Some(below)) => {
                let message =
                    format!("{name} has two depths: DP {depth}, and DPR {below}, which is {}", reference - below.abs());
                return refuse(
                    Code::PN016,
                    message,
                    "write only DP or only DPR: which of them is used depends on the control",
                );
            }
            (None, None) => {
                return refuse(
                    Code::PN007,
                    format!("{name} without its depth"),
                    "write DP, the fourth argument of the cycle",
                );
            }
        };
        let clearance = self.get(2);
        if bottom > reference || back < reference {
            let message = format!("{name} goes from {reference} to {bottom} and back to {back}");
            return refuse(Code::PN011, message, "write a depth below RFP, and a retract plane above it");
        }
        Ok(Levels { back, reference, r: reference + clearance, bottom })
    }

    /// Calculates the hole with the active feed and spindle speed.
    ///
    /// # Errors
    /// The cycle refuses its arguments, or the documentation does not define the result.
    fn hole(&self, stand: &Stand) -> Done<Canned> {
        let levels = self.levels()?;
        let (feed, speed, turning) = (stand.feed, stand.speed, stand.turning);
        let seconds = |value: f64| if value < 0.0 { -value * 60.0 / speed } else { value };
        let Levels { back, r, bottom, .. } = levels;
        let mut steps = vec![Step::Rapid(r)];
        let (mut motions, mut peck, mut hole_feed) = (Motions::Drill, 0.0, feed);
        let bottom_dwell = self.bottom_dwell().map_or(0.0, |at| seconds(self.get(at)));
        let turns = |at: usize| match self.get(at) as i32 {
            3 => Some(Rotation::Cw),
            4 => Some(Rotation::Ccw),
            _ => None,
        };
        let starts = |rotation: Option<Rotation>| {
            rotation.filter(|rotation| *rotation != turning).map(|rotation| Step::Turn(rotation, speed))
        };
        match self.number {
            81 | 82 => {
                steps.push(Step::Feed(bottom, feed));
                steps.extend(dwell(bottom_dwell));
            }
            83 => {
                let breaks = self.get(11) == 0.0;
                motions = if breaks { Motions::Chipbreak } else { Motions::Peck };
                peck = self.pecks(&levels, breaks, stand, seconds, &mut steps)?;
            }
            84 | 840 => {
                let tap = self.tap(&levels, stand, seconds, &mut steps)?;
                (motions, hole_feed) = tap;
            }
            85 => {
                motions = Motions::FeedOut;
                let (into, out) = (self.get(6), self.get(7));
                if into <= 0.0 || out <= 0.0 {
                    return refuse(
                        Code::PN007,
                        "CYCLE85 without its feeds",
                        "write FFR and RFF, the last two arguments of the cycle",
                    );
                }
                hole_feed = into;
                steps.push(Step::Feed(bottom, into));
                steps.extend(dwell(bottom_dwell));
                steps.push(Step::Feed(r, out));
            }
            86 => {
                motions = Motions::ShiftOut;
                steps.splice(0..0, starts(turns(6)));
                steps.push(Step::Feed(bottom, feed));
                steps.extend(dwell(bottom_dwell));
                steps.extend([Step::Orient(Some(self.get(10))), Step::Aside([self.get(7), self.get(8), self.get(9)])]);
                let mut lifted = [0.0; 3];
                lifted[2] = r - (bottom + self.get(9));
                steps.extend([Step::Aside(lifted), Step::Rapid(r)]);
            }
            87 | 88 => {
                motions = Motions::ByHand;
                let by = if self.number == 87 { 5 } else { 6 };
                steps.splice(0..0, starts(turns(by)));
                steps.push(Step::Feed(bottom, feed));
                steps.extend(dwell(bottom_dwell));
                steps.extend([Step::Turn(Rotation::Stop, speed), Step::Stop]);
            }
            _ => {
                motions = Motions::FeedOut;
                steps.push(Step::Feed(bottom, feed));
                steps.extend(dwell(bottom_dwell));
                steps.push(Step::Feed(r, feed));
            }
        }
        if !matches!(steps.last(), Some(Step::Rapid(height) | Step::Feed(height, _)) if *height == back) {
            steps.push(Step::Rapid(back));
        }
        steps.extend(self.after_tap(stand));
        // CYCLE840 needs a compensating chuck
        let rigid = matches!(self.number, 84 | 840).then_some(self.number == 84);
        let hole = Drilling {
            cycle: Drill {
                code: Name { letter: b'c', tenths: self.number * 10 },
                motions,
                dwells: bottom_dwell > 0.0,
                rigid,
                // POSS
                start: (self.number == 84).then(|| self.get(9)),
            },
            at: stand.at,
            plane: stand.plane,
            r,
            bottom,
            clear: back,
            dwell: bottom_dwell,
            peck,
            shift: if self.number == 86 { [self.get(7), self.get(8)] } else { [0.0; 2] },
            level: bottom,
            feed: hole_feed,
            heights: Heights::Given,
        };
        Ok(Canned { hole, steps })
    }

    /// The argument that contains the dwell at the bottom; `None`: the hole has no dwell.
    fn bottom_dwell(&self) -> Option<usize> {
        match self.number {
            // DTD, or DTB if DTD is 0
            83 => Some(if self.get(15) == 0.0 { 8 } else { 15 }),
            84 | 840 | 87 => None,
            _ => Some(5),
        }
    }

    /// Adds the strokes of CYCLE83, which may become shorter with the depth. After each stroke the chips are broken or
    /// cleared. Returns the length of the first stroke.
    fn pecks(
        &self,
        levels: &Levels,
        breaks: bool,
        stand: &Stand,
        seconds: impl Fn(f64) -> f64,
        steps: &mut Vec<Step>,
    ) -> Done<f64> {
        let Levels { reference, r, bottom, .. } = *levels;
        let mm = if stand.units == Units::Inch { 1.0 / 25.4 } else { 1.0 };
        let first = match (self.said(5), self.said(6).filter(|by| *by != 0.0)) {
            (Some(depth), None) => reference - depth,
            (None, Some(by)) => by.abs(),
            (Some(depth), Some(by)) if (reference - depth - by.abs()).abs() < 1e-9 => by.abs(),
            (Some(_), Some(_)) => {
                return refuse(Code::PN016, "CYCLE83 has two first depths", "write FDEP or FDPR, not both");
            }
            (None, None) => return refuse(Code::PN007, "CYCLE83 without its first depth", "write FDEP or FDPR"),
        };
        let (less, least) = (self.get(7), self.get(13));
        let next = |stroke: f64, left: f64| {
            let shorter = match less {
                0.0 => stroke,
                factor if factor < 0.0 => stroke * -factor,
                amount => {
                    let shorter = (stroke - amount).max(amount);
                    // the last two strokes have the same length
                    if shorter < left && left < 2.0 * shorter { left / 2.0 } else { shorter }
                }
            };
            shorter.max(least)
        };
        let factor = Some(self.get(10)).filter(|factor| *factor > 0.0).unwrap_or(1.0);
        let feed = stand.feed;
        let wait = dwell(seconds(self.get(8)));
        let at_bottom = self.bottom_dwell().and_then(|at| dwell(seconds(self.get(at))));
        let all = depths(reference, bottom, first, next)?;
        let last = all.len() - 1;
        for (count, depth) in all.into_iter().enumerate() {
            steps.push(Step::Feed(depth, if count == 0 { feed * factor } else { feed }));
            if count == last {
                steps.extend(at_bottom);
                break;
            }
            steps.extend(wait);
            if breaks {
                let by = Some(self.get(14)).filter(|by| *by > 0.0).unwrap_or(mm);
                steps.push(Step::Feed(depth + by, feed));
                continue;
            }
            steps.push(Step::Rapid(r));
            steps.extend(dwell(seconds(self.get(9))));
            let drilled = (reference - depth) / mm;
            let usual = if drilled <= 30.0 { 0.6 } else { (drilled / 50.0).min(7.0) } * mm;
            let above = Some(self.get(16)).filter(|above| *above > 0.0).unwrap_or(usual);
            steps.push(Step::Rapid((depth + above).min(r)));
        }
        Ok(first)
    }

    /// The pitch of a tap in the program's units. The pitch of a left-hand thread is negative.
    fn pitch(&self, size: usize, pitch: usize, table: usize, stand: &Stand) -> Done<f64> {
        let mm = if stand.units == Units::Inch { 1.0 / 25.4 } else { 1.0 };
        let by_size = match self.get(size) {
            0.0 => None,
            size => match COARSE.iter().find(|(diameter, _)| *diameter == size.abs()) {
                Some((_, pitch)) => Some(pitch * size.signum() * mm),
                None => return refuse(Code::PN018, format!("MPIT {size} is not a thread from M3 to M48"), "write PIT"),
            },
        };
        let by_unit = match self.get(table) {
            0.0 => 1.0,
            1.0 => mm,
            other => {
                return refuse(
                    Code::PN016,
                    format!("PTAB {other} is not supported"),
                    "write the pitch in the program's units",
                );
            }
        };
        let said = Some(self.get(pitch) * by_unit).filter(|pitch| *pitch != 0.0);
        match (by_size, said) {
            (Some(a), Some(b)) if (a - b).abs() > 1e-9 => {
                refuse(Code::PN018, "MPIT and PIT contradict each other", "write one of them")
            }
            (Some(pitch), _) | (None, Some(pitch)) => Ok(pitch),
            (None, None) => refuse(Code::PN007, "a tap without its pitch", "write PIT, or MPIT for a metric thread"),
        }
    }

    /// Adds the steps of CYCLE84 or CYCLE840: the feed into the hole, the reversal of the spindle, and the feed out.
    /// Returns the motions and the feed.
    fn tap(
        &self,
        levels: &Levels,
        stand: &Stand,
        seconds: impl Fn(f64) -> f64,
        steps: &mut Vec<Step>,
    ) -> Done<(Motions, f64)> {
        let Levels { r, bottom, .. } = *levels;
        let per_turn = stand.per_turn;
        let feed_at = |pitch: f64, speed: f64| if per_turn { pitch.abs() } else { pitch.abs() * speed };
        let rigid = self.number == 84;
        if !rigid {
            let inwards = stand.turning;
            if inwards == Rotation::Stop {
                return refuse(Code::PN012, "CYCLE840 with the spindle stopped", "write M3 or M4 before CYCLE840");
            }
            let outwards = match self.get(6) as i32 {
                3 => Rotation::Cw,
                4 => Rotation::Ccw,
                _ => inwards.reversed(),
            };
            let speed = stand.speed;
            let feed = if self.get(8) == 0.0 { feed_at(self.pitch(9, 10, 12, stand)?, speed) } else { stand.feed };
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell(seconds(self.get(5))));
            steps.extend([Step::Turn(outwards, speed), Step::Feed(r, feed)]);
            return Ok((if inwards == Rotation::Cw { Motions::Tap } else { Motions::LeftTap }, feed));
        }
        let pitch = self.pitch(7, 8, 13, stand)?;
        let speed = self.get(10);
        if speed <= 0.0 {
            return refuse(Code::PN007, "CYCLE84 without its speed", "write SST, the eleventh argument of the cycle");
        }
        let out_speed = Some(self.get(11)).filter(|speed| *speed > 0.0).unwrap_or(speed);
        let (inwards, motions) =
            if pitch > 0.0 { (Rotation::Cw, Motions::Tap) } else { (Rotation::Ccw, Motions::LeftTap) };
        let (feed, out_feed) = (feed_at(pitch, speed), feed_at(pitch, out_speed));
        let [into, outwards] = [Step::Turn(inwards, speed), Step::Turn(inwards.reversed(), out_speed)];
        let mm = if stand.units == Units::Inch { 1.0 / 25.4 } else { 1.0 };
        let all = match self.get(15) as i32 {
            0 => vec![bottom],
            1 | 2 if self.get(16) > 0.0 => depths(r, bottom, self.get(16), |stroke, _| stroke)?,
            1 | 2 => {
                return refuse(
                    Code::PN007,
                    "CYCLE84 with pecks, but without the depth of a peck",
                    "write DAM, the 17th argument of the cycle",
                );
            }
            other => {
                return refuse(Code::PN016, format!("CYCLE84 with VARI {other} is not supported"), "write 0, 1 or 2");
            }
        };
        let last = all.len() - 1;
        for (count, depth) in all.into_iter().enumerate() {
            steps.extend([into, Step::Feed(depth, feed)]);
            if count < last {
                let by = Some(self.get(17)).filter(|by| *by > 0.0).unwrap_or(mm);
                let up = if self.get(15) as i32 == 1 { (depth + by).min(r) } else { r };
                steps.extend([outwards, Step::Feed(up, out_feed)]);
            }
        }
        steps.extend(dwell(seconds(self.get(5))));
        steps.extend([outwards, Step::Feed(r, out_feed)]);
        Ok((motions, feed))
    }

    /// The rotation of the spindle after a tap: SDAC. If SDAC has no direction, CYCLE84 leaves the spindle stopped.
    fn after_tap(&self, stand: &Stand) -> Option<Step> {
        let rotation = match (self.number, self.get(if self.number == 84 { 6 } else { 7 }) as i32) {
            (84 | 840, 3) => Rotation::Cw,
            (84 | 840, 4) => Rotation::Ccw,
            (84, _) | (840, 5) => Rotation::Stop,
            (840, _) => stand.turning,
            _ => return None,
        };
        Some(Step::Turn(rotation, stand.speed))
    }
}

impl Plan for Cycle {
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>> {
        self.hole(stand).map(Some)
    }
}
