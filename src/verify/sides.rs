//! What the two sides of a comparison are made of, and how a difference is told.

use super::cut::{Cut, Place, Rapid, Shared};
use super::form_values::Own;
use super::intent::{Expected, Threaded};
use super::passage::{Frame, Mark, Passage};
use super::program::{Doubt, Program};
use super::rapid_path::RapidPath;
use super::report::{Difference, Report};
use super::strokes::Strokes;
use super::unproven_codes::{is_unknown, unknown_code};
use super::verdict::Unproven;
use crate::diag::{Code, Diag};
use crate::lang::Machine;
use crate::nc::RunError;
use crate::toolpath;

/// How near things must be, in the job's units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limits {
    /// How far places may be from one another and be the same.
    pub tolerance: f64,
    /// How far short lines may be from their arc.
    pub chord: f64,
    /// One digit of the form along a hole: what shows that the tool left the bottom.
    pub increment: f64,
}

/// The hole that the job is in, and the last one.
#[derive(Debug, Default)]
pub(super) struct Holes {
    /// The hole over which the job is: its way aside from there must then be that way.
    pub over: Option<Expected>,
    /// The tool's last hole.
    pub last: Option<Expected>,
    /// The last hole of the tool before, while this one has none; or the last one that was cut, where the operator makes this.
    pub before: Option<Expected>,
    /// The greatest height at which the job goes to this hole and those before it.
    pub highest: Option<f64>,
    /// The hole is cut by the program.
    pub cut: bool,
    /// Cuts of a hole in pecks.
    pub pecks: Vec<Cut>,
    /// Where the feed of the hole began in which the last cut was; `None`: it was in none, or in one that only the form knows.
    pub inside: Option<f64>,
    /// What the job's pecks of this hole come to.
    pub strokes: Strokes,
}

impl Holes {
    /// Does the tool stand in a hole at a mark: in the last one, and not out of it since, or on its way into this one?
    pub fn holds<T>(&self, passage: &Passage, mark: &Mark<T>, tolerance: f64) -> bool {
        let next = self.over.filter(|hole| !hole.custom).map(|hole| hole.plane);
        self.inside.is_some_and(|plane| passage.below_since(mark, plane - tolerance))
            || next.is_some_and(|plane| passage.below_until(mark, plane - tolerance))
    }
}

/// The state of a comparison: the job's side and the program's.
pub(super) struct Sides<'a> {
    pub program: Program<'a>,
    /// What the job does since its last cut, as a passage.
    pub job: Passage,
    pub hole: Holes,
    pub limits: Limits,
    /// Kept from comparison to comparison, so that none allocates.
    pub ways: [RapidPath; 2],
    /// What was in force at the program's last cut.
    pub before: Shared,
    /// States of job and program that were found to agree.
    pub agreed: Option<[Shared; 2]>,
    /// The last cuts ended at different places: the next begin there, and are in step.
    pub slipped: Option<[Place; 2]>,
    /// The last thread, while no other cut came: how many passes of it the program made beyond those of the job.
    pub threaded: Option<(Threaded, usize)>,
    /// How many cuts ended at different places since the last that did not.
    pub slips: u32,
    /// The machine loads tools.
    pub tools: bool,
    /// A torch or a laser: what it cuts with is no tool that someone changes.
    pub switches: bool,
    /// What it is.
    pub machine: Machine,
    /// Feeds and speeds that the form says itself.
    pub own: [Own; 2],
    pub report: Report,
    pub failure: Option<std::io::Error>,
}

impl Sides<'_> {
    /// A difference after which the two sides are in step still.
    pub fn found(&mut self, code: Code, line: u64, help: &'static str, message: impl Fn() -> String) {
        let program = &self.program;
        let block = || program.text_of(line);
        let place = self.report.place;
        self.report.add(&Difference { code, help, message: &message, line, block: &block, place });
    }

    /// A difference that ends the comparison: what comes after it is moved against each other anyway.
    pub fn differs<T>(&mut self, code: Code, line: u64, message: String, help: &'static str) -> Result<T, Box<Diag>> {
        let diag = Box::new(Diag::new(code, message.clone()).help(help));
        self.found(code, line, help, || message.clone());
        Err(diag)
    }

    /// Says that nothing is proven from this line of the program on.
    pub fn unproven<T>(&mut self, why: String, help: &str, line: u64) -> Result<T, Box<Diag>> {
        let diag = Box::new(Diag::new(Code::PV020, why.clone()).help(help));
        let block = self.program.number_of(line);
        let place = Some(self.report.place);
        let unproven = Unproven { why, help: help.into(), line, block, place, ..Unproven::default() };
        self.report.unproven.get_or_insert(unproven);
        Err(diag)
    }

    /// The program's next cut.
    pub fn next(&mut self) -> Result<Option<Cut>, Box<Diag>> {
        self.run_to_cut()?;
        Ok(self.program.cut().cloned())
    }

    /// Runs the program to its next cut.
    pub fn run_to_cut(&mut self) -> Result<(), Box<Diag>> {
        match self.program.run_to_cut().map(drop) {
            Ok(()) => match self.program.doubt().map(Doubt::told) {
                Some((why, help, line)) => self.unproven(why.into(), help, line),
                None => Ok(()),
            },
            Err(RunError::Refused(diag, line)) if is_unknown(diag.code, self.program.control()) => {
                let why = unknown_code(&diag, self.program.control());
                let help = "describe the code in a file of the control, or see what it does at the machine";
                self.unproven(why, help, line)
            }
            Err(RunError::Refused(diag, line)) => {
                let control = self.program.control().name();
                let message = format!("{control} refuses the program: {} ({})", diag.message, diag.code.name());
                let help = "`postform simulate PROGRAM --control NAME` shows the block and what to write";
                self.differs(Code::PV015, line, message, help)
            }
            Err(RunError::Io(error)) if error.kind() == std::io::ErrorKind::Unsupported => {
                let told =
                    self.unproven(error.to_string(), "verify the program as a file, which can be gone back in", 0);
                if let Some(unproven) = &mut self.report.unproven {
                    unproven.in_a_file = true;
                }
                told
            }
            Err(RunError::Io(error)) => {
                let diag = Diag::new(Code::PV015, error.to_string());
                self.failure = Some(error);
                Err(Box::new(diag))
            }
        }
    }

    /// The job's cut is dealt with: its next way begins where it ends.
    pub fn leave(&mut self, cut: &Cut, hole: Option<&Expected>) {
        self.hole.inside = hole.filter(|hole| !hole.custom).map(|hole| hole.plane);
        self.job.begin(Rapid { to: cut.end(), unknown: 0, spin: None });
    }

    /// The frame in which the program's last cut was.
    pub fn frame_before(&self) -> Frame {
        Frame { tool: self.before.tool, work: self.before.work }
    }

    /// Where the job is.
    pub fn at(&self) -> toolpath::Place {
        self.report.place
    }
}
