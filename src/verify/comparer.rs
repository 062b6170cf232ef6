//! Compares a job's cuts with those of a program, one by one.

use std::io::{BufRead, Seek};

use super::cut::{
    ACROSS, ALL, Cut, DEPTH, Place, Rapid, State, What, lies_between, number, over, same, shown, turn_as_far,
};
use super::finding::{Equivalences, Finding, Verdict};
use super::intended::{Expectation, Expected, Job};
use super::program::Program;
use super::way::{Compared, Way, compare, leaves_hole, leaves_low};
use crate::diag::{Code, Diag};
use crate::nc::{RunError, Settings};
use crate::toolpath::{self, Event, FeedMode, Sink, StopKind, Units};

/// What the job's side tells of.
pub(super) trait Intent {
    /// The job's units, and how far short lines may leave an arc.
    fn units(&mut self, units: Units, chord: f64);
    /// A rapid.
    fn rapid(&mut self, rapid: Rapid) -> Result<(), Box<Diag>>;
    /// A cut, in a hole or elsewhere.
    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>>;
    /// A rapid that a program may also feed.
    fn rapid_or_feed(&mut self, cut: &Cut) -> Result<(), Box<Diag>>;
    /// A stop.
    fn stop(&mut self, kind: StopKind);
    /// The motions of a hole begin over it, and end.
    fn hole_begins(&mut self, hole: &Expected);
    fn hole_ends(&mut self, hole: &Expected) -> Result<(), Box<Diag>>;
    /// From here on places are others: another tool or work offset.
    fn lost(&mut self, tool: bool);
    /// Is the tool where the last cut ended?
    fn way_is_empty(&self) -> bool;
    /// The job is over.
    fn finish(&mut self) -> Result<(), Box<Diag>>;
}

/// Compares a program with the events of its job: push them, then ask for the verdict.
pub struct Comparer<R> {
    job: Job,
    pub(super) sides: Sides<R>,
}

/// Both sides where they stand.
pub(super) struct Sides<R> {
    pub program: Program<R>,
    /// The job's way, and where it begins if that is known.
    way: Vec<Rapid>,
    start: Option<Rapid>,
    /// The job's rapids before a change of tool or work offset.
    left: Vec<Rapid>,
    left_start: Option<Rapid>,
    lost: bool,
    pub stops: Vec<StopKind>,
    /// Both ways as corners; kept so that a cut allocates nothing.
    ways: [Way; 2],
    /// The job's cuts in a hole of pecks.
    pub pecks: Vec<Cut>,
    pub tolerance: f64,
    pub chord: f64,
    pub equivalences: Equivalences,
    findings: Vec<Finding>,
    place: toolpath::Place,
    /// The last hole.
    last_hole: Option<Expected>,
    /// Over which hole the job is, and whether its way there leaves the axis of the hole: it must then be that way.
    over: Option<Place>,
    aside: bool,
    left_aside: bool,
    /// What was in force at the program's last cut.
    pub before: State,
    /// The tool was changed since the last cut.
    pub new_tool: bool,
    pub tools: bool,
    failure: Option<RunError>,
    units: Option<f64>,
    pub counts: Counts,
}

/// How much was compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cuts and dwells of the job outside holes.
    pub cuts: u64,
    /// Holes.
    pub holes: u64,
}

/// How near places must be, in inches and millimetres: more than what digits are rounded off.
const TOLERANCES: [f64; 2] = [1e-4, 2e-3];

impl<R: BufRead + Seek> Comparer<R> {
    /// Compares with this program. `tolerance` in the job's units; else 0.0001 inch or 0.002 mm.
    pub fn new(program: R, settings: Settings, expectation: Expectation, tolerance: Option<f64>) -> Comparer<R> {
        Comparer {
            job: Job::new(expectation),
            sides: Sides {
                program: Program::new(program, settings, expectation.tools, expectation.units_due),
                way: Vec::new(),
                start: None,
                left: Vec::new(),
                left_start: None,
                lost: true,
                stops: Vec::new(),
                ways: Default::default(),
                pecks: Vec::new(),
                tolerance: 0.0,
                chord: 0.0,
                equivalences: Equivalences::default(),
                findings: Vec::new(),
                place: toolpath::Place::default(),
                last_hole: None,
                over: None,
                aside: false,
                left_aside: false,
                before: State::default(),
                new_tool: false,
                tools: expectation.tools,
                failure: None,
                units: tolerance,
                counts: Counts::default(),
            },
        }
    }

    /// The program counts in these units until it says others.
    pub fn begin_in(&mut self, units: Units) {
        self.sides.program.begin_in(units);
    }

    /// How much was compared so far.
    pub fn counts(&self) -> Counts {
        self.sides.counts
    }

    /// Warnings of the control since the last call.
    pub fn warnings(&mut self) -> Vec<Diag> {
        self.sides.program.warnings()
    }

    /// The verdict, after the last event or after one that found a difference.
    ///
    /// # Errors
    /// The program can't be read.
    pub fn verdict(self) -> Result<Verdict, std::io::Error> {
        let Sides { mut program, mut findings, equivalences, failure, .. } = self.sides;
        if let Some(RunError::Io(error)) = failure {
            return Err(error);
        }
        findings.append(&mut program.hazards);
        findings.sort_by_key(|finding| finding.line);
        Ok(if !findings.is_empty() {
            Verdict::Different(findings)
        } else if equivalences == Equivalences::default() {
            Verdict::Identical
        } else {
            Verdict::Equivalent(equivalences)
        })
    }
}

impl<R: BufRead + Seek> Sink for Comparer<R> {
    /// An error when a difference is found: [`Comparer::verdict`] tells it; nothing more need be pushed.
    fn event(&mut self, event: Event<'_>, place: toolpath::Place) -> Result<(), Box<Diag>> {
        self.sides.place = place;
        self.job.event(event, &mut self.sides).map_err(|mut diag| {
            diag.place.get_or_insert_with(|| place.to_string());
            diag
        })
    }
}

impl<R: BufRead + Seek> Sides<R> {
    /// A difference ends the comparison: what comes after it is moved against each other anyway.
    pub fn differs<T>(&mut self, code: Code, line: u64, message: String, help: &'static str) -> Result<T, Box<Diag>> {
        let block = if line > 0 { self.program.text() } else { String::new() };
        let diag = Box::new(Diag::new(code, message.clone()).help(help));
        self.findings.push(Finding { code, message, help, place: Some(self.place), line, block });
        Err(diag)
    }

    /// The program's next cut.
    pub fn next(&mut self) -> Result<Option<Cut>, Box<Diag>> {
        match self.program.peek() {
            Ok(cut) => Ok(cut),
            Err(RunError::Refused(diag, line)) => {
                let message = format!("the control refuses the program: {} ({})", diag.message, diag.code.name());
                self.differs(Code::PV015, line, message, "see what simulate says of the program")
            }
            Err(RunError::Io(error)) => {
                let diag = Diag::new(Code::PV015, error.to_string());
                self.failure = Some(RunError::Io(error));
                Err(Box::new(diag))
            }
        }
    }

    /// The job's cut is dealt with: its next way begins where it ends.
    pub fn leave(&mut self, cut: &Cut) {
        self.way.clear();
        self.left.clear();
        self.lost = false;
        self.new_tool = false;
        self.aside = false;
        self.start = Some(Rapid { to: cut.what.end(&cut.from), unknown: 0, rotation: None });
    }

    /// The program's next cut, whose way, beginning and state are as they must be.
    pub fn meet(&mut self, cut: &Cut, hole: Option<&Expected>) -> Result<Cut, Box<Diag>> {
        while self.next()?.is_some_and(|found| self.enters_again(cut, &found)) {
            self.equivalences.entries += 1;
            self.program.take();
        }
        let Some(found) = self.next()? else {
            return match hole {
                Some(hole) => {
                    let message = format!("the hole at {} is not drilled: the program is over", over(&hole.at));
                    self.differs(Code::PV002, 0, message, "look at the cycle, and at what ends it")
                }
                None => {
                    let end = cut.what.end(&cut.from);
                    let to = shown(&end, 0b111);
                    let tolerance = self.tolerance;
                    let by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
                    if cut.what.feeds() && self.program.way.iter().any(by_rapid) {
                        let message = format!("a rapid goes to {to}, where the job cuts");
                        return self.differs(Code::PV007, 0, message, "print the feed code (G1) for this move");
                    }
                    let message = format!("the program is over, and the cut to {to} is missing");
                    self.differs(Code::PV017, 0, message, "look at what the form prints for this move")
                }
            };
        };
        self.kinds(cut, &found)?;
        self.begins(cut, &found, hole)?;
        self.compare_ways(found.line)?;
        self.states(cut, &found, hole.is_some_and(|hole| hole.is_tap))?;
        Ok(found)
    }

    /// After the tool was taken out, as to unwind an axis: straight down again to where the cut goes on.
    fn enters_again(&mut self, cut: &Cut, found: &Cut) -> bool {
        let What::Line { to } = found.what else { return false };
        let here = self.start.is_some_and(|start| same(&start.to, &cut.from, ALL, self.tolerance))
            || self.program.way.iter().any(|rapid| rapid.unknown & 1 << DEPTH != 0);
        let height_known = found.unknown & 1 << DEPTH == 0;
        if !here || found.unknown & ACROSS != 0 || !same(&cut.from, &to, ALL, self.tolerance) {
            return false;
        }
        let [_, program] = &mut self.ways;
        program.set(Some(self.program.start()), &self.program.way, self.tolerance);
        let above = !height_known || found.from[DEPTH] > to[DEPTH];
        same(&found.from, &to, ACROSS, self.tolerance) && above && program.stays_above(to[DEPTH])
    }

    fn kinds(&mut self, cut: &Cut, found: &Cut) -> Result<(), Box<Diag>> {
        let help = "look at the dwell of the cycle or block";
        match (cut.what, found.what) {
            (What::Dwell(seconds), What::Line { .. } | What::Arc(_)) => {
                let message = format!("the dwell of {} s is missing", number(seconds));
                self.differs(Code::PV010, found.line, message, help)
            }
            (What::Line { .. } | What::Arc(_), What::Dwell(seconds)) => {
                let message = format!("a dwell of {} s that the job does not have", number(seconds));
                self.differs(Code::PV010, found.line, message, help)
            }
            _ => Ok(()),
        }
    }

    /// Both cuts begin at one place.
    fn begins(&mut self, cut: &Cut, found: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let unknown = found.unknown & !cut.unknown & ALL;
        if unknown == 0 && same(&cut.from, &found.from, ALL, tolerance) {
            return Ok(());
        }
        let end = cut.what.end(&cut.from);
        let angles = (3..6).filter(|&axis| cut.from[axis] != found.from[axis]).map(|axis| 1 << axis).sum::<u8>();
        let (wanted, is) = (shown(&cut.from, 0b111 | angles), shown(&found.from, 0b111 | angles));
        let line = found.line;
        // the rapid went where the cut goes
        let cuts_by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
        if cut.what.feeds() && self.program.way.iter().any(cuts_by_rapid) && !same(&end, &cut.from, ALL, tolerance) {
            let message = format!("a rapid goes to {}, where the job cuts", shown(&end, 0b111));
            return self.differs(Code::PV007, line, message, "print the feed code (G1) for this move");
        }
        let found_end = found.what.end(&found.from);
        if self.way.iter().any(|rapid| same(&rapid.to, &found_end, ALL, tolerance)) && found.what.feeds() {
            let message = format!("a feed move goes to {}, where the job has a rapid", shown(&found_end, 0b111));
            return self.differs(Code::PV008, line, message, "print the rapid code (G0) for this move");
        }
        if found.by_cycle && hole.is_none() {
            let place = over(&found.from);
            let message =
                format!("the canned cycle is still in force: it drills at {place}, where the job has no hole");
            return self.differs(Code::PV013, line, message, "end the cycle: print G80 in Cancel, and `End Cancel`");
        }
        let Some(hole) = hole else {
            let message = format!("a cut begins at {is}, the job's at {wanted}");
            return self.differs(Code::PV001, line, message, "look at what the form prints for the moves before it");
        };
        if !same(&hole.at, &found.from, ACROSS, tolerance) {
            let at = over(&hole.at);
            if self.last_hole.is_some_and(|last| same(&last.at, &found.from, ACROSS, tolerance)) {
                let message = format!("the hole at {} is drilled twice", over(&found.from));
                return self.differs(Code::PV003, line, message, "look for a second position line in the cycle");
            }
            let message = format!("the hole at {at} is not drilled: the next cut begins at {is}");
            return self.differs(Code::PV002, line, message, "print [h] and [v] in the cycle's position line");
        }
        if unknown & 1 << DEPTH != 0 {
            let message =
                format!("the hole at {} is drilled from a height that only the machine knows", over(&hole.at));
            return self.differs(Code::PV005, line, message, "print [d] before the cycle");
        }
        let message = format!(
            "the feed begins at Z{}, the job's clearance plane is Z{}",
            number(found.from[DEPTH]),
            number(cut.from[DEPTH])
        );
        self.differs(Code::PV005, line, message, "print R[vclear] in the cycle, at every hole where it changes")
    }

    /// The ways to a cut.
    fn compare_ways(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let split = self.program.before.filter(|_| self.lost).unwrap_or(0);
        if self.lost {
            self.compare_leaving(split, line)?;
        }
        let [job, program] = &mut self.ways;
        let rest = &self.program.way[split..];
        // after a change the way begins anywhere
        let begin = if self.lost && self.program.before.is_some() { None } else { Some(self.program.start()) };
        job.set(self.start, &self.way, tolerance);
        program.set(begin, rest, tolerance);
        let known = !self.lost && self.program.start().unknown == 0;
        match compare(job, program, known, tolerance) {
            Compared::Same => Ok(()),
            Compared::AsGood { step_by_step } if step_by_step || !self.aside => {
                self.equivalences.ways += u64::from(known);
                Ok(())
            }
            Compared::AsGood { .. } => self.stays_at_wall(line),
            Compared::Turning => self.turns_otherwise(line),
            Compared::Lower(to, limit) => {
                let message = format!(
                    "a rapid goes to {}, lower than the job's ways here, Z{}",
                    shown(&to, 0b111),
                    number(limit)
                );
                self.differs(Code::PV009, line, message, "print the height before the position, or return to [rplane]")
            }
            Compared::Elsewhere(to) => {
                let message = format!("a rapid goes to {}, where the job does not go", shown(&to, 0b111));
                self.differs(Code::PV001, line, message, "look at what the form prints for this move")
            }
        }
    }

    fn stays_at_wall(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let message = "the tool does not leave the wall of the hole as the job says".to_owned();
        self.differs(Code::PV001, line, message, "print the cycle's orientation and shift, as G76 Q[sleave]")
    }

    fn turns_otherwise(&mut self, line: u64) -> Result<(), Box<Diag>> {
        let message = "the spindle does not turn as the job says while the tool leaves".to_owned();
        self.differs(Code::PV011, line, message, "look at the spindle codes of the cycle")
    }

    /// The way away from the last cut of a tool or work offset, or of the program.
    fn compare_leaving(&mut self, until: usize, line: u64) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let [job, program] = &mut self.ways;
        if self.left_start.is_none() {
            return Ok(()); // nothing was cut before
        }
        job.set(self.left_start, &self.left, tolerance);
        program.set(Some(self.program.start()), &self.program.way[..until], tolerance);
        match leaves_hole(job, program, tolerance) {
            Some(Compared::Turning) => return self.turns_otherwise(line),
            Some(_) if self.left_aside => return self.stays_at_wall(line),
            _ => {}
        }
        let [job, program] = &mut self.ways;
        let Some((to, limit)) = leaves_low(job, program, tolerance) else { return Ok(()) };
        let message = format!("after the last cut a rapid goes to {}, below Z{}", shown(&to, 0b111), number(limit));
        self.differs(Code::PV009, line, message, "go up first, as high as the job does")
    }

    /// A straight cut, as one or in parts that lie on it.
    fn line(&mut self, cut: &Cut, first: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let end = cut.what.end(&cut.from);
        let mut found = *first;
        let mut parts = 1;
        loop {
            let to = found.what.end(&found.from);
            let is_part = !same(&to, &end, ALL, self.tolerance) && lies_between(&cut.from, &to, &end, self.tolerance);
            if !is_part {
                break;
            }
            self.feeds(&in_parts(cut, &found), &found, hole.is_some_and(|hole| hole.is_tap))?;
            self.program.take();
            let next = self.next()?.filter(|next| {
                matches!(next.what, What::Line { .. })
                    && self.program.way.is_empty()
                    && self.program.stops.is_empty()
                    && lies_between(&to, &next.what.end(&next.from), &end, self.tolerance)
            });
            let Some(next) = next else {
                return self.ends(&cut.from, end, &found, hole);
            };
            found = next;
            parts += 1;
        }
        self.ends(&cut.from, end, &found, hole)?;
        self.feeds(&in_parts(cut, &found), &found, hole.is_some_and(|hole| hole.is_tap))?;
        self.equivalences.parts += u64::from(parts > 1);
        self.program.take();
        Ok(())
    }

    /// Both straight cuts end at one place.
    fn ends(&mut self, from: &Place, end: Place, found: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let is = found.what.end(&found.from);
        let line = found.line;
        if same(&end, &is, ALL, self.tolerance) {
            if turn_as_far([from, &end], [&found.from, &is]) {
                return Ok(());
            }
            let message = format!("the part turns the other way, or more often, on the way to {}", shown(&end, ALL));
            return self.differs(Code::PV001, line, message, "look at the travel of the rotary axis (`Limits`)");
        }
        if hole.is_some() && same(&end, &is, ACROSS, self.tolerance) {
            // out of the hole at feed, and farther than the job
            if is[DEPTH] > end[DEPTH] && end[DEPTH] > from[DEPTH] {
                self.equivalences.outs += 1;
                return Ok(());
            }
            let message = format!(
                "the hole at {} is cut to Z{}, the job's to Z{}",
                over(&end),
                number(is[DEPTH]),
                number(end[DEPTH])
            );
            return self.differs(Code::PV004, line, message, "print Z[d] at every hole where it changes");
        }
        let message = format!("a cut goes to {}, the job's to {}", shown(&is, 0b111), shown(&end, 0b111));
        self.differs(Code::PV001, line, message, "look at what the form prints for this move")
    }
}

/// The cut as one of its parts must be: in inverse time a part has a part of the time.
fn in_parts(cut: &Cut, part: &Cut) -> Cut {
    let length = |cut: &Cut| {
        let end = cut.what.end(&cut.from);
        (0..6).map(|axis| (end[axis] - cut.from[axis]).powi(2)).sum::<f64>().sqrt()
    };
    let share = length(part) / length(cut);
    match cut.mode {
        FeedMode::InverseTime => Cut { feed: cut.feed.map(|feed| feed / share), ..*cut },
        _ => *cut,
    }
}

impl<R: BufRead + Seek> Intent for Sides<R> {
    fn units(&mut self, units: Units, chord: f64) {
        self.program.want(units);
        self.chord = chord;
        self.tolerance = self.units.unwrap_or(TOLERANCES[usize::from(units == Units::Mm)]);
    }

    fn rapid(&mut self, rapid: Rapid) -> Result<(), Box<Diag>> {
        // a rapid of no length is none
        let here = self.way.last().or(self.start.as_ref());
        if here.is_some_and(|here| here.to == rapid.to && here.unknown == rapid.unknown) && rapid.rotation.is_none() {
            return Ok(());
        }
        self.aside |= self.over.is_some_and(|over| !same(&over, &rapid.to, ACROSS, self.tolerance));
        self.way.push(rapid);
        Ok(())
    }

    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        if hole.is_some_and(|hole| hole.pecks) {
            if self.pecks.is_empty() {
                self.meet(cut, hole)?;
            }
            self.pecks.push(*cut);
            self.leave(cut);
            return Ok(());
        }
        let found = self.meet(cut, hole)?;
        self.counts.cuts += u64::from(hole.is_none());
        match (cut.what, found.what) {
            (What::Arc(turn), _) => self.arc(cut, &turn)?,
            (What::Dwell(wanted), What::Dwell(is)) => {
                if (wanted - is).abs() > (0.01 * wanted).max(0.001) {
                    let message = format!("the dwell is {} s, the job's {} s", number(is), number(wanted));
                    return self.differs(Code::PV010, found.line, message, "look at the unit of the dwell (`Dwell`)");
                }
                self.program.take();
            }
            (_, What::Arc(_)) => {
                let message = "an arc, where the job cuts straight".to_owned();
                return self.differs(Code::PV001, found.line, message, "look at the motion code");
            }
            _ => self.line(cut, &found, hole)?,
        }
        self.leave(cut);
        Ok(())
    }

    fn rapid_or_feed(&mut self, cut: &Cut) -> Result<(), Box<Diag>> {
        let end = cut.what.end(&cut.from);
        let found = self.next()?;
        let feeds = found.is_some_and(|found| {
            same(&found.from, &cut.from, ALL, self.tolerance)
                && same(&found.what.end(&found.from), &end, ALL, self.tolerance)
        });
        if feeds {
            self.equivalences.slow += 1;
            return self.cut(&Cut { feed: None, ..*cut }, None);
        }
        self.rapid(Rapid { to: end, unknown: 0, rotation: None })
    }

    fn stop(&mut self, kind: StopKind) {
        self.stops.push(kind);
    }

    fn hole_begins(&mut self, hole: &Expected) {
        self.over = Some(hole.at);
        self.pecks.clear();
    }

    fn hole_ends(&mut self, hole: &Expected) -> Result<(), Box<Diag>> {
        if hole.pecks && !self.pecks.is_empty() {
            self.compare_pecks(hole)?;
        }
        self.counts.holes += 1;
        self.over = None;
        self.last_hole = Some(*hole);
        Ok(())
    }

    fn lost(&mut self, tool: bool) {
        if !self.lost {
            self.left_start = self.start.take();
            self.left_aside = std::mem::take(&mut self.aside);
        }
        self.left.append(&mut self.way);
        self.new_tool |= tool;
        self.lost = true;
        self.way.clear();
        self.start = None;
        if tool {
            self.last_hole = None;
        }
    }

    fn way_is_empty(&self) -> bool {
        self.way.is_empty() && !self.lost
    }

    fn finish(&mut self) -> Result<(), Box<Diag>> {
        if let Some(found) = self.next()?.filter(|found| found.what.feeds()) {
            let end = shown(&found.what.end(&found.from), 0b111);
            if found.by_cycle {
                let again = self.last_hole.is_some_and(|last| same(&last.at, &found.from, ACROSS, self.tolerance));
                let code = if again { Code::PV003 } else { Code::PV013 };
                let message = format!("the canned cycle drills at {}, and the job is over", over(&found.from));
                return self.differs(code, found.line, message, "end the cycle: print G80 in Cancel");
            }
            let message = format!("a cut to {end}, and the job is over");
            return self.differs(Code::PV016, found.line, message, "look at EndCode");
        }
        let until = match (self.lost, self.program.before) {
            (true, Some(split)) => split,
            _ => self.program.way.len(),
        };
        if !self.lost {
            self.left_start = self.start.take();
            self.left_aside = self.aside;
        }
        self.left.append(&mut self.way);
        self.compare_leaving(until, 0)?;
        self.program.ended();
        Ok(())
    }
}
