//! The drilling cycles of Klartext: 200 to 203, 205 to 207, 209 and 240. The moves of each cycle follow its section
//! "cycle run" in the manuals of TNC 320, 620 and 640.

use std::collections::BTreeMap;

use super::super::strokes::{depths, dwell};
use crate::control::{Code as Name, Motions};
use crate::diag::Code;
use crate::nc::action::{Cycle as Drill, Drilling, Heights, Rotation};
use crate::nc::call::{Canned, Plan, Stand, Step};
use crate::nc::fault::{Done, refuse};
use crate::toolpath::Units;

/// For each cycle: its number, the required parameters, and the optional parameters.
const CYCLES: [(u16, &[u16], &[u16]); 9] = [
    (200, &[200, 201, 206, 202, 203, 204], &[210, 211, 395]),
    (201, &[200, 201, 206, 203, 204], &[211, 208]),
    (202, &[200, 201, 206, 203, 204, 214], &[211, 208, 336]),
    (203, &[200, 201, 206, 202, 203, 204], &[210, 212, 213, 205, 211, 208, 256, 395]),
    (205, &[200, 201, 206, 202, 203, 204], &[212, 205, 258, 259, 257, 256, 211, 379, 253, 208, 395]),
    (206, &[200, 201, 206, 203, 204], &[211]),
    (207, &[200, 201, 239, 203, 204], &[]),
    (209, &[200, 201, 239, 203, 204, 257, 256], &[336, 403]),
    (240, &[200, 343, 201, 206, 203, 204], &[344, 211]),
];

/// The definition of a drilling cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Number of the cycle.
    pub number: u16,
    /// Values of the parameters by their numbers. `MAX` is stored as infinity.
    pub words: BTreeMap<u16, f64>,
}

impl Cycle {
    /// Whether the drilling cycle with this number is supported.
    pub fn is_known(number: u16) -> bool {
        CYCLES.iter().any(|(own, ..)| *own == number)
    }

    /// Checks that the definition has all required parameters, and no parameter that is not supported.
    ///
    /// # Errors
    /// A parameter is missing, or is not supported.
    pub fn check(&self) -> Done {
        let Some((number, needs, takes)) = CYCLES.iter().find(|(own, ..)| *own == self.number) else { return Ok(()) };
        if let Some(missing) = needs.iter().find(|word| !self.words.contains_key(word)) {
            let help = format!("write Q{missing}= with its value in the definition");
            return refuse(Code::PN007, format!("CYCL DEF {number} without Q{missing}"), help);
        }
        for (word, value) in &self.words {
            let is_run = needs.contains(word) || takes.contains(word) && !matches!(word, 379 | 395);
            if !is_run && *value != 0.0 {
                let message = format!("Q{word}={value} in CYCL DEF {number} is not supported");
                return refuse(Code::PN016, message, "write 0, or leave the parameter out");
            }
        }
        if self.get(201) > 0.0 {
            let message = format!("the depth Q201={} is above the surface", self.get(201));
            return refuse(Code::PN011, message, "write Q201 with a minus: the depth is measured from Q203");
        }
        if self.number == 240 && self.get(343) != 0.0 {
            let help = "write the depth Q201, with Q343=0";
            return refuse(Code::PN016, "a depth by the diameter depends on the angle of the tool", help);
        }
        Ok(())
    }

    fn get(&self, word: u16) -> f64 {
        self.words.get(&word).copied().unwrap_or(0.0)
    }

    /// Calculates the hole. `None`: the depth is 0, so the cycle does nothing.
    ///
    /// # Errors
    /// The cycle refuses its parameters.
    fn hole(&self, stand: &Stand) -> Done<Option<Canned>> {
        let (surface, depth) = (self.get(203), self.get(201));
        if depth == 0.0 {
            return Ok(None);
        }
        let inch = stand.units == Units::Inch;
        let mm = if inch { 1.0 / 25.4 } else { 1.0 };
        let (r, bottom) = (surface + self.get(200), surface + depth);
        let clear = r.max(surface + self.get(204));
        let (turning, speed) = (stand.turning, stand.speed);
        // in inch programs, feeds are written in tenths of an inch
        let of_feed = |word: u16| if inch { self.get(word) / 10.0 } else { self.get(word) };
        let into = of_feed(206);
        let mut feed = into;
        let mut steps = vec![Step::Rapid(r)];
        let at_bottom = dwell(self.get(211));
        let mut peck = 0.0;
        // out of the hole: an infinite feed means a rapid, and 0 means the feed into the hole
        let out_feed = if self.get(208) == 0.0 { into } else { of_feed(208) };
        let retract = |steps: &mut Vec<Step>, height: f64| match out_feed.is_finite() && out_feed < 99_999.0 {
            true => steps.push(Step::Feed(height, out_feed)),
            false => steps.push(Step::Rapid(height)),
        };
        let motions = match self.number {
            200 | 240 => {
                peck = if self.number == 200 { self.get(202) } else { -depth };
                let all = depths(surface, bottom, peck, |stroke, _| stroke)?;
                let pecks = all.len() > 1;
                self.pecks(&all, r, into, &mut steps, |steps| steps.push(Step::Rapid(r)), |_, _| 0.2 * mm);
                if pecks { Motions::Peck } else { Motions::Drill }
            }
            201 => {
                steps.push(Step::Feed(bottom, into));
                steps.extend(at_bottom);
                retract(&mut steps, r);
                Motions::FeedOut
            }
            202 => {
                steps.push(Step::Feed(bottom, into));
                steps.extend(at_bottom);
                let by = 0.2 * mm;
                let aside = match self.get(214) as i32 {
                    0 => [0.0; 3],
                    1 => [-by, 0.0, 0.0],
                    2 => [0.0, -by, 0.0],
                    3 => [by, 0.0, 0.0],
                    4 => [0.0, by, 0.0],
                    other => return refuse(Code::PN018, format!("Q214={other} is not a direction"), "write 0 to 4"),
                };
                steps.extend([Step::Orient(self.get(336)), Step::Aside(aside)]);
                match out_feed.is_finite() && out_feed < 99_999.0 {
                    true => steps.push(Step::Feed(r, out_feed)),
                    false => steps.push(Step::Aside([0.0, 0.0, r - bottom])),
                }
                steps.extend([Step::Rapid(r), Step::Turn(turning, speed)]);
                Motions::ShiftOut
            }
            203 => {
                peck = self.get(202);
                let all = depths(surface, bottom, peck, self.shorter())?;
                let breaks = self.get(213) as usize;
                let last = all.len() - 1;
                for (count, depth) in all.iter().enumerate() {
                    steps.push(Step::Feed(*depth, into));
                    if count == last {
                        break;
                    }
                    if breaks > 0 && (count + 1) % breaks != 0 {
                        retract(&mut steps, depth + self.get(256));
                        continue;
                    }
                    retract(&mut steps, r);
                    steps.extend(dwell(self.get(210)));
                    steps.push(Step::Rapid((depth + 0.2 * mm).min(r)));
                }
                steps.extend(at_bottom);
                retract(&mut steps, r);
                match (last, breaks) {
                    (0, _) => Motions::Drill,
                    (_, 0) => Motions::Peck,
                    _ => Motions::Chipbreak,
                }
            }
            205 => {
                peck = self.get(202);
                let all = depths(surface, bottom, peck, self.shorter())?;
                let (first, last) = (self.get(258), self.get(259));
                let count = all.len();
                let above = |at: usize| {
                    let part = if count > 2 { at as f64 / (count - 2) as f64 } else { 0.0 };
                    if last == 0.0 { first } else { first + (last - first) * part }
                };
                let chip = self.get(257);
                let mut from = surface;
                for (at, depth) in all.iter().enumerate() {
                    if chip > 0.0 {
                        let parts = depths(from, *depth, chip, |stroke, _| stroke)?;
                        for part in &parts[..parts.len() - 1] {
                            steps.extend([Step::Feed(*part, into), Step::Rapid(part + self.get(256))]);
                        }
                    }
                    steps.push(Step::Feed(*depth, into));
                    from = *depth;
                    if at + 1 < count {
                        steps.extend([Step::Rapid(r), Step::Rapid((depth + above(at)).min(r))]);
                    }
                }
                steps.extend(at_bottom);
                if count > 1 {
                    Motions::Peck
                } else if chip > 0.0 {
                    Motions::Chipbreak
                } else {
                    Motions::Drill
                }
            }
            _ => {
                let pitch = self.get(239);
                let rigid = self.number != 206;
                let inwards = match rigid {
                    true if pitch > 0.0 => Rotation::Cw,
                    true => Rotation::Ccw,
                    false => turning,
                };
                if inwards == Rotation::Stop || speed <= 0.0 {
                    let message = format!("CYCL DEF {} with the spindle stopped", self.number);
                    return refuse(Code::PN012, message, "write M3, and S in TOOL CALL, before the cycle");
                }
                if rigid && pitch == 0.0 {
                    return refuse(Code::PN018, "a pitch of 0", "write the pitch in Q239");
                }
                feed = if rigid { pitch.abs() * speed } else { into };
                let factor = Some(self.get(403)).filter(|factor| *factor > 0.0).unwrap_or(1.0);
                let out_speed = if self.number == 209 { speed * factor } else { speed };
                let out_feed = feed * out_speed / speed;
                let [go_in, go_out] = [Step::Turn(inwards, speed), Step::Turn(inwards.reversed(), out_speed)];
                let chip = if self.number == 209 { self.get(257) } else { 0.0 };
                let all = if chip > 0.0 { depths(surface, bottom, chip, |stroke, _| stroke)? } else { vec![bottom] };
                if rigid && turning != inwards {
                    steps.push(go_in);
                }
                for (at, depth) in all.iter().enumerate() {
                    if at > 0 {
                        let up = match self.get(256) {
                            0.0 => r,
                            turns => (all[at - 1] + turns * pitch.abs()).min(r),
                        };
                        steps.extend([go_out, Step::Feed(up, out_feed), go_in]);
                    }
                    steps.push(Step::Feed(*depth, feed));
                }
                if !rigid {
                    steps.extend(at_bottom);
                }
                steps.extend([go_out, Step::Feed(r, out_feed), go_in]);
                if inwards == Rotation::Cw { Motions::Tap } else { Motions::LeftTap }
            }
        };
        let came = steps.iter().rev().find_map(|step| match step {
            Step::Rapid(height) | Step::Feed(height, _) => Some(*height),
            _ => None,
        });
        if came != Some(clear) {
            steps.push(Step::Rapid(clear));
        }
        let hole = Drilling {
            cycle: Drill {
                code: Name { letter: b'q', tenths: self.number * 10 },
                motions,
                dwells: self.get(211) > 0.0,
            },
            at: stand.at,
            plane: stand.plane,
            r,
            bottom,
            clear,
            dwell: self.get(211),
            peck,
            shift: [0.0; 2],
            level: bottom,
            feed,
            heights: Heights::Given,
        };
        Ok(Some(Canned { hole, steps }))
    }

    /// The length of the next stroke: the length of the last stroke minus Q212, but at least Q205.
    fn shorter(&self) -> impl Fn(f64, f64) -> f64 + use<> {
        let (less, least) = (self.get(212), self.get(205));
        move |stroke, _| if less > 0.0 { (stroke - less).max(least) } else { stroke }
    }

    /// Adds the strokes of a hole. After each stroke except the last, the tool leaves the hole.
    fn pecks(
        &self,
        all: &[f64],
        r: f64,
        feed: f64,
        steps: &mut Vec<Step>,
        comes_out: impl Fn(&mut Vec<Step>),
        above: impl Fn(usize, usize) -> f64,
    ) {
        for (at, depth) in all.iter().enumerate() {
            steps.push(Step::Feed(*depth, feed));
            if at + 1 < all.len() {
                comes_out(steps);
                steps.extend(dwell(self.get(210)));
                steps.push(Step::Rapid((depth + above(at, all.len())).min(r)));
            }
        }
        steps.extend(dwell(self.get(211)));
    }
}

impl Plan for Cycle {
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>> {
        self.hole(stand)
    }
}
