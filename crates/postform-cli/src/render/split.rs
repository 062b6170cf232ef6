//! Parts of a job that become separate programs.

use postform::diag::{Code, Diag};
use postform::toolpath::{Event, Flow, Place, Sink};
use postform::{Error, Job, Reading};

use super::super::args::SplitArg;

/// A part of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// The operations with a tool.
    Tool(u32),
    /// An operation, counted from 1.
    Operation(u64),
    /// The operations in a work offset; `None`: those before the first work offset.
    Work(Option<f64>),
    /// A setup of a CL file, counted from 1.
    Setup(usize),
}

impl Part {
    /// Restricts the reading of a job to this part.
    pub fn select(self, reading: &mut Reading) {
        match self {
            Part::Tool(tool) => reading.select.only = vec![tool],
            Part::Operation(operation) => reading.select.operation = Some(operation),
            Part::Work(work) => reading.select.work = Some(work),
            Part::Setup(setup) => reading.setup = Some(setup),
        }
    }

    /// Whether the part consists of selected operations. The operations of a setup are a job of their own.
    pub fn selects_operations(self) -> bool {
        !matches!(self, Part::Setup(_))
    }

    /// The part's name in file names: `T3`, `OP02`, `G54`, `SETUP1`.
    pub fn name(self) -> String {
        match self {
            Part::Tool(tool) => format!("T{tool}"),
            Part::Operation(operation) => format!("OP{operation:02}"),
            // a number below 50 is a fixture number
            Part::Work(Some(work)) if work < 50.0 => format!("W{work}"),
            Part::Work(Some(work)) => format!("G{work}"),
            Part::Work(None) => "W0".to_owned(),
            Part::Setup(setup) => format!("SETUP{setup}"),
        }
    }
}

/// The parts of a job.
pub struct Parts {
    /// In the order of the job.
    pub parts: Vec<Part>,
    /// The number of the job's program.
    pub number: Option<f64>,
    /// Number of operations that are in none of the parts, because they are not selected.
    pub left_out: u64,
}

/// Reads a job and lists its parts.
///
/// # Errors
/// The job can't be read, or a part has no distinct name.
pub fn parts(job: &mut Job<'_>, by: SplitArg) -> Result<Parts, Error> {
    let setups = if by == SplitArg::Setup { job.setups()?.len() } else { 0 };
    if setups > 0 {
        // each setup is a job of its own, with the same head
        job.reading.setup = Some(1);
    }
    let found = Parts { parts: Vec::new(), number: None, left_out: 0 };
    let mut seen = Seen { by, operations: 0, in_subprogram: false, work: None, found };
    job.read(&mut seen)?;
    let mut found = seen.found;
    match by {
        SplitArg::Setup => found.parts = (1..=setups).map(Part::Setup).collect(),
        _ => found.left_out = job.report().left_out,
    }
    Ok(found)
}

/// Collects the parts of a job.
struct Seen {
    by: SplitArg,
    operations: u64,
    in_subprogram: bool,
    work: Option<f64>,
    found: Parts,
}

impl Sink for Seen {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        let part = match event {
            Event::Start(start) => {
                self.found.number = start.program;
                return Flow::Continue(());
            }
            Event::ToolChange(change) => {
                self.operations += 1;
                self.work = change.work.or(self.work);
                match self.by {
                    SplitArg::Tool => match change.tool.as_ref().map(|tool| tool.number) {
                        Some(number) if number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0 => {
                            Part::Tool(number as u32)
                        }
                        _ => return wrong("it has no tool", "split the job by operation", place),
                    },
                    SplitArg::Operation => Part::Operation(self.operations),
                    SplitArg::Work => Part::Work(self.work),
                    SplitArg::Setup => return Flow::Continue(()),
                }
            }
            Event::SubStart(_) | Event::SubEnd => {
                self.in_subprogram = matches!(event, Event::SubStart(_));
                return Flow::Continue(());
            }
            Event::Work(work) if self.by == SplitArg::Work && self.work != Some(work) && !self.in_subprogram => {
                let help = "make one operation per work offset, or split the job by tool or operation";
                return wrong("its work offset changes", help, place);
            }
            _ => return Flow::Continue(()),
        };
        // each operation is a part of its own
        if matches!(part, Part::Operation(_)) || !self.found.parts.contains(&part) {
            self.found.parts.push(part);
        }
        Flow::Continue(())
    }
}

fn wrong(why: &str, help: &str, place: Place) -> Flow {
    let message = format!("the operation can't be put into one part of the job: {why}");
    Flow::Break(Diag::new(Code::PR061, message).help(help).place(place).into())
}
