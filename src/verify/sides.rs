//! The two sides of a comparison (job and program), and functions that report differences.

use super::beside::Mark;
use super::cut::{Cut, Place, Rapid, Shared};
use super::form_values::Own;
use super::intent::{Expected, Threaded};
use super::passage::{Frame, Passage};
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

/// Tolerances in the job's units.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limits {
    /// The tolerance that the caller requires, if any.
    pub required: Option<f64>,
    /// Distance up to which two positions are equal.
    pub tolerance: f64,
    /// How far short lines may deviate from the arc that they replace.
    pub chord: f64,
    /// The smallest step that the form can print along a hole. A retract by this step shows that the tool left the
    /// bottom of the hole.
    pub increment: f64,
}

/// The current hole of the job, the holes before it, and the strokes so far in the current hole.
#[derive(Debug, Default)]
pub(super) struct Holes {
    /// The hole that the job makes now. If the tool moves away from the axis of this hole, the moves must be as in the
    /// job.
    pub over: Option<Expected>,
    /// The last hole of the current tool.
    pub last: Option<Expected>,
    /// The last hole of the previous tool, while the current tool has made no hole. Or the last hole that was cut, if
    /// the operator makes the current hole by hand.
    pub before: Option<Expected>,
    /// The greatest height of the job's tool at the current hole and at the earlier holes of the cycle.
    pub highest: Option<f64>,
    /// Whether the program has made a cut in the current hole.
    pub cut: bool,
    /// Whether the last hole was a usual one, so that the next hole may be compared by its position only.
    pub is_usual: bool,
    /// The job's cuts in a pecked hole.
    pub pecks: Vec<Cut>,
    /// The height where the feed began in the hole of the last cut. `None`: the cut was not in a hole, or only the form
    /// defines the moves in the hole.
    pub inside: Option<f64>,
    /// The strokes of the job's pecks in this hole.
    pub strokes: Strokes,
}

impl Holes {
    /// Whether the tool is in a hole at a mark (such as a stop): still in the last hole, or already in the current
    /// hole.
    pub fn holds<T>(&self, passage: &Passage, mark: &Mark<T>, tolerance: f64) -> bool {
        let next = self.over.filter(|hole| !hole.custom).map(|hole| hole.plane);
        self.inside.is_some_and(|plane| passage.below_since(mark, plane - tolerance))
            || next.is_some_and(|plane| passage.below_until(mark, plane - tolerance))
    }
}

/// How a tool is compared for which the job contains no length register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unnamed {
    /// The job leaves the register open.
    Open,
    /// The job is an NC program, and no tool has a length register so far.
    NoneSoFar,
    /// The job is an NC program in which other tools have length registers: the tool cuts without its length offset.
    Off,
}

/// The state of a comparison, with the side of the job and the side of the program.
pub(super) struct Sides<'a> {
    pub program: Program<'a>,
    /// The passage of the job: its rapids, stops, dwells and changes since its last cut.
    pub job: Passage,
    pub hole: Holes,
    pub limits: Limits,
    /// Buffers that are reused, so that no comparison allocates memory.
    pub ways: [RapidPath; 2],
    /// The state at the program's last cut.
    pub before: Shared,
    /// The last modal states of job and program that were equal.
    pub agreed: Option<[Shared; 2]>,
    /// The ends of the last cuts of job and program, if these ends differ. Next cuts that begin at these ends
    /// correspond to each other.
    pub slipped: Option<[Place; 2]>,
    /// The last thread, until another cut follows, and the number of passes that the program has in addition to the
    /// job's passes.
    pub threaded: Option<(Threaded, usize)>,
    /// Number of consecutive cuts whose ends differ.
    pub slips: u32,
    /// Whether the machine loads tools.
    pub tools: bool,
    /// How tools of the job without a length register are compared.
    pub unnamed: Unnamed,
    /// Whether the machine has a torch or laser. Such a machine has no tool change.
    pub switches: bool,
    /// The type of machine.
    pub machine: Machine,
    /// The feeds and then the speeds that the form itself defines.
    pub own: [Own; 2],
    pub report: Report,
    pub failure: Option<std::io::Error>,
}

impl Sides<'_> {
    /// Reports a difference. The next cuts of job and program still correspond, so the comparison continues.
    pub fn found(&mut self, code: Code, line: u64, help: &'static str, message: impl Fn() -> String) {
        let program = &self.program;
        let block = || program.text_of(line);
        let place = self.report.place;
        self.report.add(&Difference { code, help, message: &message, line, block: &block, place });
    }

    /// Reports a difference and ends the comparison, because the next cuts of job and program do not correspond.
    pub fn differs<T>(&mut self, code: Code, line: u64, message: String, help: &'static str) -> Result<T, Box<Diag>> {
        let diag = Box::new(Diag::new(code, message.clone()).help(help));
        self.found(code, line, help, || message.clone());
        Err(diag)
    }

    /// Records that nothing is proven after this line of the program.
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
                let (why, help) = unknown_code(&diag, self.program.control());
                self.unproven(why, help, line)
            }
            Err(RunError::Refused(diag, line)) => {
                let control = self.program.control().name();
                let message = format!("{control} refuses the program: {} ({})", diag.message, diag.code.name());
                let help = "`postform simulate PROGRAM --control NAME` shows the block and the correction; \
                            `postform render --no-verify -o PROGRAM` writes the program";
                self.differs(Code::PV015, line, message, help)
            }
            Err(RunError::Io(error)) if error.kind() == std::io::ErrorKind::Unsupported => {
                let told = self.unproven(error.to_string(), "verify the program as a file", 0);
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

    /// Ends the job's cut. The job's next path begins at the end of the cut.
    pub fn leave(&mut self, cut: &Cut, hole: Option<&Expected>) {
        self.hole.inside = hole.filter(|hole| !hole.custom).map(|hole| hole.plane);
        self.leave_at(cut.end());
    }

    /// Begins the job's next path at the end of a cut.
    #[inline]
    pub fn leave_at(&mut self, to: Place) {
        self.job.begin(Rapid { to, unknown: 0, kept: 0, spin: None });
    }

    /// The frame of the program's last cut.
    pub fn frame_before(&self) -> Frame {
        Frame { tool: self.before.tool, work: self.before.work }
    }

    /// The current item of the job.
    pub fn at(&self) -> toolpath::Place {
        self.report.place
    }
}
