//! Compares the cuts of a job with the cuts of a program, one by one.

use std::io::{Read, Seek};

use super::beside::Compensated;
use super::cut::{ACROSS, Cut, DEPTH, Place, Rapid, What, is_straight, over, same, same_ends, shown};
use super::expectation::Expectation;
use super::intended::Job;
use super::intent::{Done, Expected, Intent, Straight, Threaded};
use super::passage::{Frame, Passage, TOO_LONG};
use super::program::Program;
use super::report::{Counts, Report};
use super::sides::{Holes, Limits, Sides, Unnamed};
use super::strokes::Strokes;
use super::tables::PLACES;
use super::verdict::{Equivalences, Unproven, Verdict};
use super::wire_codes::Coded;
use super::{align, arcs, begin, fast_path, holes, lines, pauses, rapids, threads, wire};
use crate::control::ToolLength;
use crate::diag::{Code, Diag};
use crate::lang::Machine;
use crate::nc::RunSettings;
use crate::render::TraceLine;
use crate::toolpath::{self, Event, Flow, Sink, Stop, StopKind, Units};

/// Factor by which the tolerance is increased. A difference equal to the tolerance is allowed, but binary rounding may
/// make it a little larger than the tolerance.
const BINARY: f64 = 1.0 + 1e-6;

/// Compares a program with the events of its job. Push the events, then call [`Comparer::verdict`].
///
/// Job and program are not kept in memory. The program is read only as far as the events require, so job and program
/// may be streams.
pub struct Comparer<'a> {
    job: Job,
    sides: Sides<'a>,
    /// Whether the program begins in the units of the job.
    in_units_of_job: bool,
    /// Whether the first operation has begun.
    begun: bool,
}

impl<'a> Comparer<'a> {
    /// A comparison with this program. `tolerance` is in the job's units; the default is 0.0001 inch or 0.002 mm.
    /// `in_units_of_job`: the program begins in the units of the job, until it sets its own units.
    pub fn new(
        program: impl Read + Seek + 'a,
        settings: RunSettings,
        expectation: Expectation,
        tolerance: Option<f64>,
        in_units_of_job: bool,
    ) -> Comparer<'a> {
        let program = Program::new(program, settings, &expectation);
        let tools = expectation.tools;
        let has_registers = matches!(
            settings.control.traits().tool_length,
            ToolLength::CodeAndRegister | ToolLength::Code | ToolLength::Register
        );
        let unnamed = if expectation.lengths_due || !has_registers { Unnamed::Open } else { Unnamed::NoneSoFar };
        let switches = expectation.beam.is_some();
        let own = [expectation.feeds.clone(), expectation.speeds.clone()];
        let job = Job::new(expectation, settings.control);
        let frame = Frame { tool: None, work: job.state.work };
        Comparer {
            job,
            in_units_of_job,
            begun: false,
            sides: Sides {
                program,
                job: Passage::new(None, frame),
                hole: Holes::default(),
                limits: Limits { required: tolerance, ..Limits::default() },
                ways: Default::default(),
                before: super::cut::Shared::default(),
                agreed: None,
                slipped: None,
                threaded: None,
                slips: 0,
                tools,
                unnamed,
                switches,
                machine: Machine::Mill,
                own,
                report: Report::default(),
                failure: None,
            },
        }
    }

    /// Whether the control refused a block of the program that runs ahead of the job. The refusal is reported at the
    /// job's next cut.
    pub(super) fn is_stuck(&self) -> bool {
        self.sides.program.has_failed()
    }

    /// Runs the program ahead while text is waiting. The program does not run before the first operation, because the
    /// job may still change the settings of the run.
    pub(super) fn run_on(&mut self, waits: &dyn Fn() -> bool) {
        if self.begun {
            self.sides.program.run_on(waits);
        }
    }

    /// The number of cuts and holes compared so far.
    pub fn counts(&self) -> Counts {
        self.sides.report.counts
    }

    /// Number of findings so far.
    pub(super) fn found(&self) -> usize {
        self.sides.report.findings.len() + self.sides.program.hazards.len()
    }

    /// Completes new findings: adds the form line that printed the block of each finding.
    pub(super) fn locate(&mut self, origin: impl Fn(u64) -> Option<TraceLine>) {
        let hazards = self.sides.program.hazards.iter_mut();
        for finding in self.sides.report.findings.iter_mut().chain(hazards).filter(|finding| finding.form.is_none()) {
            if let Some(origin) = origin(finding.line) {
                finding.locate(origin);
            }
        }
    }

    /// Warnings of the control since the last call.
    pub fn warnings(&mut self) -> Vec<Diag> {
        self.sides.program.warnings()
    }

    /// Whether the verdict is final. If `true`, the rest of the job can't change the verdict.
    pub fn is_decided(&self) -> bool {
        self.found() > 0 || self.sides.report.unproven.is_some()
    }

    /// The verdict. Call this function after the last event, or after an event that found a difference.
    ///
    /// # Errors
    /// The program can't be read.
    pub fn verdict(self) -> Result<Verdict, std::io::Error> {
        let Sides { mut program, mut report, failure, .. } = self.sides;
        if let Some(error) = failure {
            return Err(error);
        }
        let unproven = report.unproven();
        let Report { mut findings, allowed, .. } = report;
        findings.append(&mut program.hazards);
        findings.sort_by_key(|finding| finding.line);
        Ok(match unproven {
            _ if !findings.is_empty() => Verdict::Different(findings),
            Some(unproven) => Verdict::NotProven(Box::new(unproven)),
            None if allowed == Equivalences::default() => Verdict::Identical,
            None => Verdict::Equivalent(allowed),
        })
    }
}

impl Sink for Comparer<'_> {
    /// Compares one event. Returns a break when nothing more can be compared; then [`Comparer::verdict`] returns the
    /// reason.
    fn event(&mut self, event: Event<'_>, place: toolpath::Place) -> Flow {
        self.sides.report.place = place;
        if let (Event::Start(start), true) = (&event, self.in_units_of_job) {
            self.sides.program.begin_in(start.units);
        }
        if matches!(event, Event::ToolChange(_)) && !std::mem::replace(&mut self.begun, true) {
            self.sides.program.begin_behind(self.job.subprograms_first());
        }
        let done = self.job.event(event, &mut self.sides).and_then(|()| self.sides.can_hold());
        let Err(diag) = done else { return Flow::Continue(()) };
        if diag.code == Code::PV020 {
            let help = diag.help.clone().unwrap_or_default();
            let unproven = Unproven { why: diag.message.clone(), help, place: Some(place), ..Unproven::default() };
            self.sides.report.unproven.get_or_insert(unproven);
        }
        if self.sides.report.is_decided() || self.sides.failure.is_some() {
            return Flow::Break(Stop::Enough);
        }
        self.sides.report.wrong = Some(diag.clone());
        Flow::Break(Stop::from(diag).placed(|| place.into()))
    }
}

impl Intent for Sides<'_> {
    fn units(&mut self, units: Units, chord: f64, increment: f64) {
        self.program.want(units);
        let tolerance = self.limits.required.unwrap_or(PLACES[usize::from(units == Units::Mm)]) * BINARY;
        self.limits = Limits { tolerance, chord, increment, ..self.limits };
    }

    fn rapid(&mut self, rapid: Rapid) -> Done {
        // a rapid to the current position is ignored
        let here = self.job.here();
        if here.is_some_and(|here| here.to == rapid.to && here.unknown == rapid.unknown) {
            return Ok(());
        }
        self.job.aside |= self.hole.over.is_some_and(|over| !same(&over.at, &rapid.to, ACROSS, self.limits.tolerance));
        self.job.rapid(rapid);
        Ok(())
    }

    #[inline]
    fn goes_on(&mut self, cut: &Straight<'_>) -> bool {
        fast_path::goes_on(self, cut)
    }

    fn cut(&mut self, cut: &Cut, hole: Option<&Expected>) -> Done {
        self.threaded = None;
        match hole {
            Some(_) => self.hole.cut = true,
            None => self.hole.highest = None,
        }
        if let Some(hole) = hole.filter(|hole| !hole.pecks)
            && fast_path::drills(self, cut, hole)?
        {
            return Ok(());
        }
        if let Some(hole) = hole.filter(|hole| hole.pecks) {
            if !self.hole.pecks.is_empty() || begin::meet(self, cut, Some(hole))?.is_some() {
                self.peck(cut, hole);
            }
            return Ok(());
        }
        if hole.is_none() && align::leaves_out(self, cut)? {
            return Ok(());
        }
        let Some(found) = begin::meet(self, cut, hole)? else { return Ok(()) };
        // the job drills this hole in one stroke, the program in pecks
        let tolerance = self.limits.tolerance;
        if let Some(hole) = hole.filter(|hole| hole.drilled_in_one && found.end()[DEPTH] > hole.bottom + tolerance) {
            self.peck(cut, hole);
            return Ok(());
        }
        self.report.counts.cuts += u64::from(hole.is_none());
        match (cut.what, found.what) {
            // a helix whose circle is smaller than the program's digits
            (What::Arc(turn), What::Line { .. }) if is_straight(cut, &turn, self.limits.tolerance) => {
                let straight = Cut { what: What::Line { to: cut.end() }, ..cut.clone() };
                lines::line(self, &straight, &found, hole)?;
            }
            (What::Arc(turn), _) => arcs::arc(self, cut, &turn)?,
            (_, What::Arc(_)) => {
                let message = "an arc instead of the job's straight cut".to_owned();
                return self.differs(Code::PV001, found.line, message, "check the motion code");
            }
            _ => lines::line(self, cut, &found, hole)?,
        }
        self.leave(cut, hole);
        Ok(())
    }

    fn rapid_or_feed(&mut self, cut: &Cut) -> Done {
        let end = cut.end();
        let found = self.next()?;
        let tolerance = self.limits.tolerance;
        let feeds = found.is_some_and(|found| same_ends(cut, &found, tolerance));
        if feeds {
            self.report.allowed.slow += 1;
            return self.cut(&Cut { feed: None, ..cut.clone() }, None);
        }
        self.rapid(Rapid { to: end, unknown: 0, kept: 0, spin: None })
    }

    fn compensation(&mut self, on: Option<Compensated>) {
        self.job.side = on;
    }

    fn wait(&mut self, seconds: f64) {
        let mark = self.job.mark(seconds, 0, self.at());
        self.job.waits.push(mark);
    }

    fn stop(&mut self, kind: StopKind) {
        let mark = self.job.mark(kind, 0, self.at());
        self.job.stops.push(mark);
    }

    fn next_hole(&mut self, at: [f64; 2]) -> bool {
        fast_path::drills_again(self, at)
    }

    fn hole_begins(&mut self, hole: &Expected) {
        self.hole.is_usual = false;
        self.hole.over = Some(*hole);
        let here = hole.at[DEPTH].max(hole.plane);
        self.hole.highest = Some(self.hole.highest.map_or(here, |highest| highest.max(here)));
        self.hole.pecks.clear();
        self.hole.strokes = Strokes::over(hole.plane);
        self.hole.cut = false;
    }

    fn hole_ends(&mut self, hole: &Expected) -> Done {
        if !self.hole.pecks.is_empty() {
            holes::compare_pecks(self, hole)?;
        }
        self.report.counts.holes += 1;
        self.report.allowed.custom += u64::from(hole.custom);
        self.hole.over = None;
        self.hole.before = self.hole.before.or(self.hole.last).filter(|_| !self.hole.cut);
        self.hole.last = Some(*hole);
        Ok(())
    }

    fn begins_at(&mut self, first: &Place, axes: u8) {
        if let Some(leg) = self.job.leg() {
            leg.first = Some((*first, axes));
        }
    }

    fn changed(&mut self, frame: Frame, length: Option<f64>, tool: bool) {
        self.job.new_tool |= tool;
        self.job.change(frame);
        if let Some(leg) = self.job.leg() {
            leg.lengths.push(length);
            leg.loads |= tool;
        }
        if tool {
            self.hole.highest = None;
            let last = self.hole.last.take();
            self.hole.before = self.hole.before.or(last);
        }
    }

    fn tool_name(&mut self, name: &str, number: f64) {
        self.program.know_tool(name, number);
    }

    fn home(&mut self, length: Option<f64>) {
        self.job.goes_home(length);
    }

    fn thread(&mut self, cut: &Cut, thread: &Threaded) -> Done {
        threads::thread(self, cut, thread)
    }

    fn is_of_lathe(&mut self, by_diameter: bool) {
        self.machine = Machine::Lathe;
        self.program.is_of_lathe(by_diameter);
    }

    fn is_of_wire(&mut self) {
        self.machine = Machine::Edm;
        self.program.is_of_wire();
    }

    fn wire(&mut self, code: Coded) {
        let mark = self.job.mark(code, 0, self.at());
        self.job.does.push(mark);
    }

    fn place(&self) -> toolpath::Place {
        self.report.place
    }

    fn comes_from(&mut self, place: toolpath::Place) {
        self.report.place = place;
    }

    fn finish(&mut self) -> Done {
        if let Some(found) = align::after_the_last(self)? {
            let end = shown(&found.end(), 0b111);
            if found.by_cycle {
                let again =
                    self.hole.last.is_some_and(|last| same(&last.at, &found.from, ACROSS, self.limits.tolerance));
                let code = if again { Code::PV003 } else { Code::PV013 };
                let message = format!("the canned cycle drills at {} after the end of the job", over(&found.from));
                return self.differs(code, found.line, message, "end the cycle: print G80 in Cancel");
            }
            let message = format!("a cut to {end} after the end of the job");
            return self.differs(Code::PV016, found.line, message, "check EndCode");
        }
        pauses::compare(self);
        wire::compare(self, 0);
        rapids::end(self);
        self.program.ended();
        self.report.finished = true;
        Ok(())
    }
}

impl Sides<'_> {
    /// Fails if the job does more between two cuts than postform keeps in memory. The length of the program's passage
    /// is checked when the program runs to its next cut.
    #[inline]
    fn can_hold(&mut self) -> Done {
        if self.job.is_too_long() {
            return self.unproven(TOO_LONG.into(), "split the job", 0);
        }
        Ok(())
    }

    /// Keeps one of the job's cuts in a pecked hole. The cuts are compared when the job's hole is complete.
    fn peck(&mut self, cut: &Cut, hole: &Expected) {
        let Limits { increment, tolerance, .. } = self.limits;
        let strokes = &mut self.hole.strokes;
        self.job.rapids.iter().for_each(|rapid| strokes.comes_to(rapid.to[DEPTH]));
        strokes.comes_to(cut.from[DEPTH]);
        strokes.cut(cut.end()[DEPTH], increment, tolerance);
        self.hole.pecks.push(cut.clone());
        self.leave(cut, Some(hole));
    }
}
