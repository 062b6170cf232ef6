//! Compares a job's cuts with those of a program, one by one.

use std::io::{BufRead, Seek};

use super::cut::{ACROSS, ALL, Cut, DEPTH, Place, Rapid, What, number, over, same, shown, turn_as_far};
use super::finding::{Equivalences, Finding, Verdict};
use super::intended::{Expectation, Expected, Job};
use super::program::Program;
use super::way::{Compared, Way, compare, leaves_well};
use crate::diag::{Code, Diag};
use crate::nc::{RunError, Settings};
use crate::toolpath::{self, Event, Sink, StopKind, Units};

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
    fn hole_begins(&mut self);
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
    /// Where the program's way begins.
    program_start: Rapid,
    /// The job's way, and where it begins if that is known.
    way: Vec<Rapid>,
    start: Option<Rapid>,
    /// The job's rapids before a change of tool or work offset.
    left: Vec<Rapid>,
    left_start: Option<Rapid>,
    lost: bool,
    stops: Vec<StopKind>,
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
    failure: Option<RunError>,
    units: Option<f64>,
    counts: Counts,
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
    /// Compares with this program.
    ///
    /// `lengths`: the machine has tool length offsets. `tolerance` in the job's units; else 0.0001 inch or 0.002 mm.
    pub fn new(
        program: R,
        settings: Settings,
        expectation: Expectation,
        lengths: bool,
        tolerance: Option<f64>,
    ) -> Comparer<R> {
        let origin = Rapid { to: [0.0; 6], unknown: 0b111, rotation: None };
        Comparer {
            job: Job::new(expectation),
            sides: Sides {
                program: Program::new(program, settings, lengths),
                program_start: origin,
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

    /// The program's cut is dealt with.
    pub fn advance(&mut self, cut: &Cut) {
        self.program.take();
        self.program_start = Rapid { to: *self.program.at(), unknown: 0, rotation: cut.state.rotation };
    }

    /// The job's cut is dealt with: its next way begins where it ends.
    pub fn leave(&mut self, cut: &Cut) {
        self.way.clear();
        self.left.clear();
        self.lost = false;
        self.start = Some(Rapid { to: cut.what.end(&cut.from), unknown: 0, rotation: None });
    }

    /// The program's next cut, whose way, beginning and state are as they must be.
    pub fn meet(&mut self, cut: &Cut, hole: Option<&Expected>) -> Result<Cut, Box<Diag>> {
        while let Some(found) = self.next()?.filter(|found| self.enters_again(cut, found)) {
            self.equivalences.entries += 1;
            self.advance(&found);
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
        self.compare_ways(&found)?;
        self.states(cut, &found)?;
        Ok(found)
    }

    /// After the tool was taken out, as to unwind an axis: straight down again to where the cut goes on.
    fn enters_again(&mut self, cut: &Cut, found: &Cut) -> bool {
        let What::Line { to } = found.what else { return false };
        let here = self.start.is_some_and(|start| same(&start.to, &cut.from, ALL, self.tolerance));
        let height_known = found.unknown & 1 << DEPTH == 0;
        if !here || found.unknown & ACROSS != 0 || !same(&cut.from, &to, ALL, self.tolerance) {
            return false;
        }
        let [_, program] = &mut self.ways;
        program.set(Some(self.program_start), &self.program.way, self.tolerance);
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
    fn compare_ways(&mut self, found: &Cut) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let [job, program] = &mut self.ways;
        let split = self.program.before.filter(|_| self.lost).unwrap_or(0);
        if split > 0 || (self.lost && !self.left.is_empty()) {
            job.set(self.left_start, &self.left, tolerance);
            program.set(Some(self.program_start), &self.program.way[..split], tolerance);
            let lower = leaves_well(job, program, tolerance).filter(|_| self.left_start.is_some());
            if let Some((to, limit)) = lower {
                let message =
                    format!("before the change a rapid crosses to {}, below Z{}", shown(&to, 0b111), number(limit));
                return self.differs(Code::PV009, found.line, message, "go up first");
            }
        }
        let rest = &self.program.way[split..];
        // after a change the way begins anywhere
        let begin = match (self.lost, split) {
            (false, _) | (true, 0) => Some(self.program_start),
            (true, _) => None,
        };
        job.set(self.start, &self.way, tolerance);
        program.set(begin, rest, tolerance);
        let known = !self.lost && self.program_start.unknown == 0;
        match compare(job, program, known, tolerance) {
            Compared::Same => Ok(()),
            Compared::AsGood => {
                self.equivalences.ways += u64::from(known);
                Ok(())
            }
            Compared::Turning => {
                let message = "the spindle does not turn as the job says while the tool leaves".to_owned();
                self.differs(Code::PV011, found.line, message, "look at the spindle codes of the cycle")
            }
            Compared::Lower(to, limit) => {
                let message = format!(
                    "a rapid goes to {}, lower than the job's ways here, Z{}",
                    shown(&to, 0b111),
                    number(limit)
                );
                self.differs(
                    Code::PV009,
                    found.line,
                    message,
                    "print the height before the position, or return to [rplane]",
                )
            }
            Compared::Elsewhere(to) => {
                let message = format!("a rapid goes to {}, where the job does not go", shown(&to, 0b111));
                self.differs(Code::PV001, found.line, message, "look at what the form prints for this move")
            }
        }
    }

    /// Tool, work offset, spindle, compensation.
    fn states(&mut self, cut: &Cut, found: &Cut) -> Result<(), Box<Diag>> {
        let (wanted, is) = (&cut.state, &found.state);
        let line = found.line;
        if let Some(missing) = self.stops.iter().find(|kind| !self.program.stops.contains(kind)) {
            let message = format!(
                "the job's {} stop is missing",
                if *missing == StopKind::Program { "program" } else { "optional" }
            );
            return self.differs(Code::PV019, line, message, "print M0 or M1");
        }
        self.stops.clear();
        if let (Some(a), Some(b)) = (wanted.tool, is.tool)
            && a != b
        {
            let message = format!("tool {b} cuts, the job has tool {a} here");
            return self.differs(Code::PV012, line, message, "print T[tool] in the tool change");
        }
        if let (Some(a), Some(b)) = (wanted.work, is.work)
            && a != b
        {
            let message = format!("the work offset is G{b}, the job's is G{a}");
            return self.differs(Code::PV012, line, message, "print G[work] in the tool change, or in `Upon [work]`");
        }
        if !cut.what.feeds() {
            return Ok(());
        }
        if let (Some(a), Some(b)) = (wanted.rotation, is.rotation)
            && a != b
        {
            let message = format!("the spindle is {}, the job wants {}", b.name(), a.name());
            return self.differs(Code::PV011, line, message, "print M[direct] with the speed");
        }
        if let (Some(a), Some(b)) = (wanted.speed, is.speed)
            && (a - b).abs() > (0.01 * a).max(1.0)
        {
            let message = format!("the spindle turns S{}, the job wants {}", number(b), number(a));
            return self.differs(Code::PV011, line, message, "print S[speed]");
        }
        if let (Some(a), Some(b)) = (wanted.side, is.side)
            && a != b
        {
            let name = |side: Option<toolpath::Side>| match side {
                None => "off",
                Some(toolpath::Side::Left) => "left",
                Some(toolpath::Side::Right) => "right",
            };
            let message = format!("cutter compensation is {}, the job wants {}", name(b), name(a));
            return self.differs(Code::PV018, line, message, "look at InFeed and OutFeed");
        }
        self.feeds(cut, found)
    }

    /// The feed, within what its digits are rounded off.
    pub fn feeds(&mut self, cut: &Cut, found: &Cut) -> Result<(), Box<Diag>> {
        let (Some(wanted), Some(is)) = (cut.feed, found.feed) else { return Ok(()) };
        if cut.mode != found.mode {
            let message = "feeds count otherwise: per minute, per turn or inverse time".to_owned();
            return self.differs(Code::PV006, found.line, message, "print G[feedtype]");
        }
        if (wanted - is).abs() <= (0.01 * wanted).max(1e-9) {
            return Ok(());
        }
        let message = format!("the feed is {}, the job's {}", number(is), number(wanted));
        self.differs(Code::PV006, found.line, message, "print F[frate] where the feed changes")
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

impl<R: BufRead + Seek> Intent for Sides<R> {
    fn units(&mut self, units: Units, chord: f64) {
        self.program.want(units);
        self.chord = chord;
        self.tolerance = self.units.unwrap_or(TOLERANCES[usize::from(units == Units::Mm)]);
    }

    fn rapid(&mut self, rapid: Rapid) -> Result<(), Box<Diag>> {
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
                self.advance(&found);
            }
            (_, What::Arc(_)) => {
                let message = "an arc, where the job cuts straight".to_owned();
                return self.differs(Code::PV001, found.line, message, "look at the motion code");
            }
            _ => {
                self.ends(&cut.from, cut.what.end(&cut.from), &found, hole)?;
                self.advance(&found);
            }
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

    fn hole_begins(&mut self) {
        self.pecks.clear();
    }

    fn hole_ends(&mut self, hole: &Expected) -> Result<(), Box<Diag>> {
        if hole.pecks && !self.pecks.is_empty() {
            self.compare_pecks(hole)?;
        }
        self.counts.holes += 1;
        self.last_hole = Some(*hole);
        Ok(())
    }

    fn lost(&mut self, tool: bool) {
        if !self.lost {
            self.left_start = self.start.take();
            self.left.append(&mut self.way);
        }
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
        Ok(())
    }
}
