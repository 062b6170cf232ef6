//! Compares a job's cuts with those of a program, one by one.

use std::io::{BufRead, Seek};

use super::cut::{ACROSS, ALL, Cut, Place, Rapid, State, What, number, over, same, same_dwell, shown};
use super::finding::{Equivalences, Finding, Verdict};
use super::intended::{Expectation, Expected, Job};
use super::program::Program;
use super::way::Way;
use crate::diag::{Code, Diag};
use crate::nc::{RunError, Settings};
use crate::toolpath::{self, Event, Flow, Sink, Stop, StopKind, Units};

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
    pub way: Vec<Rapid>,
    pub start: Option<Rapid>,
    /// The job's rapids before a change of tool or work offset.
    pub left: Vec<Rapid>,
    pub left_start: Option<Rapid>,
    pub lost: bool,
    pub stops: Vec<StopKind>,
    /// Both ways as corners; kept so that a cut allocates nothing.
    pub ways: [Way; 2],
    /// The job's cuts in a hole of pecks.
    pub pecks: Vec<Cut>,
    pub tolerance: f64,
    pub chord: f64,
    pub equivalences: Equivalences,
    findings: Vec<Finding>,
    place: toolpath::Place,
    /// The last hole.
    pub last_hole: Option<Expected>,
    /// Over which hole the job is, and whether its way there leaves the axis of the hole: it must then be that way.
    over: Option<Place>,
    pub aside: bool,
    pub left_aside: bool,
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
    /// Has seen enough when a difference is found, or when the program can't be read: [`Comparer::verdict`] tells.
    fn event(&mut self, event: Event<'_>, place: toolpath::Place) -> Flow {
        self.sides.place = place;
        let Err(diag) = self.job.event(event, &mut self.sides) else { return Flow::Continue(()) };
        if self.sides.is_decided() {
            return Flow::Break(Stop::Enough);
        }
        Flow::Break(Stop::from(diag).placed(|| place.into()))
    }
}

impl<R: BufRead + Seek> Sides<R> {
    /// Is the verdict known before the end of the job?
    fn is_decided(&self) -> bool {
        !self.findings.is_empty() || self.failure.is_some()
    }

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
                if !same_dwell(wanted, is) {
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
