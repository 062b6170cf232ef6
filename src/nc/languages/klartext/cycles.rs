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

/// A feed in the program's units per minute. In inch programs, feeds are written in tenths of an inch.
pub fn per_minute(written: f64, inch: bool) -> f64 {
    if inch { written / 10.0 } else { written }
}

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

    /// Shifts all heights of the cycle by a distance. Returns the new height of the surface.
    pub fn lifted(&mut self, by: f64) -> f64 {
        let surface = self.words.entry(203).or_default();
        *surface += by;
        *surface
    }

    fn get(&self, word: u16) -> f64 {
        self.words.get(&word).copied().unwrap_or(0.0)
    }

    /// A parameter that is a whole number, such as the number of a direction.
    fn whole(&self, word: u16) -> Done<usize> {
        let value = self.get(word);
        if value.fract() == 0.0 && (0.0..=9999.0).contains(&value) {
            return Ok(value as usize);
        }
        refuse(Code::PN018, format!("Q{word}={value} is not a whole number from 0 to 9999"), "write a whole number")
    }

    /// Calculates the hole. `None`: the depth is 0, so the cycle does nothing.
    ///
    /// # Errors
    /// The cycle refuses its parameters.
    fn hole(&self, stand: &Stand) -> Done<Option<Canned>> {
        if self.get(201) == 0.0 {
            return Ok(None);
        }
        let mut work = Work::of(self, stand);
        let motions = match self.number {
            200 | 240 => work.drill()?,
            201 => work.ream(),
            202 => work.bore()?,
            203 => work.universal()?,
            205 => work.deep()?,
            _ => work.tap()?,
        };
        Ok(Some(work.canned(motions)))
    }

    /// The length of the next stroke: the length of the last stroke minus Q212, but at least Q205.
    fn shorter(&self) -> impl Fn(f64, f64) -> f64 + use<> {
        let (less, least) = (self.get(212), self.get(205));
        move |stroke, _| if less > 0.0 { (stroke - less).max(least) } else { stroke }
    }
}

/// The moves of a hole while they are calculated.
struct Work<'c> {
    cycle: &'c Cycle,
    stand: &'c Stand,
    surface: f64,
    bottom: f64,
    /// The clearance above the surface.
    r: f64,
    /// The feed into the hole.
    into: f64,
    /// The feed out of the hole; `None`: at rapid.
    out: Option<f64>,
    /// A millimetre in the units of the program.
    mm: f64,
    steps: Vec<Step>,
    /// The depth of the first peck.
    peck: f64,
    /// The feed that the hole has.
    feed: f64,
}

impl<'c> Work<'c> {
    fn of(cycle: &'c Cycle, stand: &'c Stand) -> Work<'c> {
        let inch = stand.units == Units::Inch;
        let (surface, into) = (cycle.get(203), per_minute(cycle.get(206), inch));
        // out of the hole: MAX and 99999 mean a rapid, and 0 means the feed into the hole
        let out = if cycle.get(208) == 0.0 { cycle.get(206) } else { cycle.get(208) };
        let r = surface + cycle.get(200);
        Work {
            cycle,
            stand,
            surface,
            bottom: surface + cycle.get(201),
            r,
            into,
            out: Some(out).filter(|out| *out < 99_999.0).map(|out| per_minute(out, inch)),
            mm: if inch { 1.0 / 25.4 } else { 1.0 },
            steps: vec![Step::Rapid(r)],
            peck: 0.0,
            feed: into,
        }
    }

    /// Moves up out of the hole, or out of a stroke.
    fn retract(&mut self, height: f64) {
        self.steps.push(self.out.map_or(Step::Rapid(height), |feed| Step::Feed(height, feed)));
    }

    /// Feeds to the bottom and dwells there.
    fn goes_down(&mut self) {
        self.steps.push(Step::Feed(self.bottom, self.into));
        self.steps.extend(dwell(self.cycle.get(211)));
    }

    /// Cycles 200 and 240: pecks with full retracts, or one stroke.
    fn drill(&mut self) -> Done<Motions> {
        self.peck = if self.cycle.number == 200 { self.cycle.get(202) } else { self.surface - self.bottom };
        let all = depths(self.surface, self.bottom, self.peck, |stroke, _| stroke)?;
        for (at, depth) in all.iter().enumerate() {
            self.steps.push(Step::Feed(*depth, self.into));
            if at + 1 < all.len() {
                self.steps.push(Step::Rapid(self.r));
                self.steps.extend(dwell(self.cycle.get(210)));
                self.steps.push(Step::Rapid((depth + 0.2 * self.mm).min(self.r)));
            }
        }
        self.steps.extend(dwell(self.cycle.get(211)));
        Ok(if all.len() > 1 { Motions::Peck } else { Motions::Drill })
    }

    /// Cycle 201: feeds in and out.
    fn ream(&mut self) -> Motions {
        self.goes_down();
        self.retract(self.r);
        Motions::FeedOut
    }

    /// Cycle 202: the tool moves away from the wall before it leaves the hole.
    fn bore(&mut self) -> Done<Motions> {
        self.goes_down();
        let by = 0.2 * self.mm;
        let aside = match self.cycle.whole(214)? {
            0 => [0.0; 3],
            1 => [-by, 0.0, 0.0],
            2 => [0.0, -by, 0.0],
            3 => [by, 0.0, 0.0],
            4 => [0.0, by, 0.0],
            other => return refuse(Code::PN018, format!("Q214={other} is not a direction"), "write 0 to 4"),
        };
        self.steps.extend([Step::Orient(Some(self.cycle.get(336))), Step::Aside(aside)]);
        match self.out {
            Some(feed) => self.steps.push(Step::Feed(self.r, feed)),
            None => self.steps.push(Step::Aside([0.0, 0.0, self.r - self.bottom])),
        }
        self.steps.extend([Step::Rapid(self.r), Step::Turn(self.stand.turning, self.stand.speed)]);
        Ok(Motions::ShiftOut)
    }

    /// Cycle 203: pecks with a number of chip breaks before each full retract.
    fn universal(&mut self) -> Done<Motions> {
        self.peck = self.cycle.get(202);
        let all = depths(self.surface, self.bottom, self.peck, self.cycle.shorter())?;
        let breaks = self.cycle.whole(213)?;
        let last = all.len() - 1;
        for (count, depth) in all.iter().enumerate() {
            self.steps.push(Step::Feed(*depth, self.into));
            if count == last {
                break;
            }
            if breaks > 0 && (count + 1) % breaks != 0 {
                self.retract(depth + self.cycle.get(256));
                continue;
            }
            self.retract(self.r);
            self.steps.extend(dwell(self.cycle.get(210)));
            self.steps.push(Step::Rapid((depth + 0.2 * self.mm).min(self.r)));
        }
        self.steps.extend(dwell(self.cycle.get(211)));
        self.retract(self.r);
        Ok(match (last, breaks) {
            (0, _) => Motions::Drill,
            (_, 0) => Motions::Peck,
            _ => Motions::Chipbreak,
        })
    }

    /// Cycle 205: pecks with full retracts, and chip breaks inside each peck.
    fn deep(&mut self) -> Done<Motions> {
        self.peck = self.cycle.get(202);
        let all = depths(self.surface, self.bottom, self.peck, self.cycle.shorter())?;
        let (first, last, chip) = (self.cycle.get(258), self.cycle.get(259), self.cycle.get(257));
        let count = all.len();
        let above = |at: usize| {
            let part = if count > 2 { at as f64 / (count - 2) as f64 } else { 0.0 };
            if last == 0.0 { first } else { first + (last - first) * part }
        };
        let mut from = self.surface;
        for (at, depth) in all.iter().enumerate() {
            if chip > 0.0 {
                let parts = depths(from, *depth, chip, |stroke, _| stroke)?;
                for part in &parts[..parts.len() - 1] {
                    self.steps.extend([Step::Feed(*part, self.into), Step::Rapid(part + self.cycle.get(256))]);
                }
            }
            self.steps.push(Step::Feed(*depth, self.into));
            from = *depth;
            if at + 1 < count {
                self.steps.extend([Step::Rapid(self.r), Step::Rapid((depth + above(at)).min(self.r))]);
            }
        }
        self.steps.extend(dwell(self.cycle.get(211)));
        // older controls have no Q208 in this cycle, and retract at rapid
        if self.cycle.words.contains_key(&208) {
            self.retract(self.r);
        }
        Ok(if count > 1 {
            Motions::Peck
        } else if chip > 0.0 {
            self.peck = chip;
            Motions::Chipbreak
        } else {
            Motions::Drill
        })
    }

    /// Cycles 206, 207 and 209: taps with a floating holder, rigid taps, and rigid taps with chip breaks.
    fn tap(&mut self) -> Done<Motions> {
        let (number, pitch) = (self.cycle.number, self.cycle.get(239));
        let (turning, speed) = (self.stand.turning, self.stand.speed);
        let rigid = number != 206;
        let inwards = match rigid {
            true if pitch > 0.0 => Rotation::Cw,
            true => Rotation::Ccw,
            false => turning,
        };
        if inwards == Rotation::Stop || speed <= 0.0 {
            let message = format!("CYCL DEF {number} with the spindle stopped");
            return refuse(Code::PN012, message, "write M3, and S in TOOL CALL, before the cycle");
        }
        if rigid && pitch == 0.0 {
            return refuse(Code::PN018, "a pitch of 0", "write the pitch in Q239");
        }
        self.feed = if rigid { pitch.abs() * speed } else { self.into };
        let factor = Some(self.cycle.get(403)).filter(|factor| *factor > 0.0).unwrap_or(1.0);
        let out_speed = if number == 209 { speed * factor } else { speed };
        let out_feed = self.feed * out_speed / speed;
        let [go_in, go_out] = [Step::Turn(inwards, speed), Step::Turn(inwards.reversed(), out_speed)];
        let chip = if number == 209 { self.cycle.get(257) } else { 0.0 };
        let all = match chip > 0.0 {
            true => depths(self.surface, self.bottom, chip, |stroke, _| stroke)?,
            false => vec![self.bottom],
        };
        if rigid && turning != inwards {
            self.steps.push(go_in);
        }
        for (at, depth) in all.iter().enumerate() {
            if at > 0 {
                let up = match self.cycle.get(256) {
                    0.0 => self.r,
                    turns => (all[at - 1] + turns * pitch.abs()).min(self.r),
                };
                self.steps.extend([go_out, Step::Feed(up, out_feed), go_in]);
            }
            self.steps.push(Step::Feed(*depth, self.feed));
        }
        if !rigid {
            self.steps.extend(dwell(self.cycle.get(211)));
        }
        self.steps.extend([go_out, Step::Feed(self.r, out_feed), go_in]);
        Ok(if inwards == Rotation::Cw { Motions::Tap } else { Motions::LeftTap })
    }

    /// The hole with its moves; the last move goes to the second clearance.
    fn canned(mut self, motions: Motions) -> Canned {
        let clear = self.r.max(self.surface + self.cycle.get(204));
        let came = self.steps.iter().rev().find_map(|step| match step {
            Step::Rapid(height) | Step::Feed(height, _) => Some(*height),
            _ => None,
        });
        if came != Some(clear) {
            self.steps.push(Step::Rapid(clear));
        }
        let dwell = self.cycle.get(211);
        // cycle 206 needs a compensating chuck
        let rigid = motions.taps().then_some(self.cycle.number != 206);
        let hole = Drilling {
            cycle: Drill {
                code: Name { letter: b'q', tenths: self.cycle.number * 10 },
                motions,
                dwells: dwell > 0.0,
                rigid,
                start: (self.cycle.number == 209).then(|| self.cycle.get(336)),
            },
            at: self.stand.at,
            plane: self.stand.plane,
            r: self.r,
            bottom: self.bottom,
            clear,
            dwell,
            peck: self.peck,
            shift: [0.0; 2],
            level: self.bottom,
            feed: self.feed,
            heights: Heights::Given,
        };
        Canned { hole, steps: self.steps }
    }
}

impl Plan for Cycle {
    fn plan(&self, stand: &Stand) -> Done<Option<Canned>> {
        self.hole(stand)
    }
}
