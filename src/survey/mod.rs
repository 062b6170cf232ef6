//! What lies ahead in a job: its tools, operations and work offsets, how far its cuts reach, how long they are. Forms that print
//! such things before the first move have the job read twice: a survey is made by the first reading.

mod motion;
mod totals;

pub use totals::{Reach, Totals};

use std::collections::HashMap;

use crate::cycle::Defaults;
use crate::lang::{Machine, work_code};
use crate::toolpath::{Call, Event, First, Flow, Place, Sink, Spindle, Stop, Tool, ToolChange, Units, key};
use motion::Motion;

/// What a form gives where a job names nothing.
#[derive(Clone, Debug)]
pub struct Terms {
    /// What cycles take that name nothing, for jobs in inches and in millimetres.
    pub defaults: [Defaults; 2],
    /// The work offset of a job that names none, as the form counts it.
    pub work: f64,
    /// How the form counts work offsets: the first one.
    pub first_work: f64,
    /// Only the order of the tools is asked for, which some jobs say in their head.
    pub only_order: bool,
}

/// An operation of the job.
#[derive(Clone, Debug)]
pub struct Operation {
    /// How it begins; its first move is left out.
    pub begins: ToolChange,
    /// Its tool: a row of [`Survey::tools`].
    pub tool: Option<usize>,
    /// The spindle when it begins.
    pub spindle: Spindle,
    /// Sums of its moves.
    pub totals: Totals,
}

/// A tool of the job.
#[derive(Clone, Debug)]
pub struct ToolUse {
    /// The tool.
    pub tool: Tool,
    /// The operation that uses it first: a row of [`Survey::operations`].
    pub first: usize,
    /// Sums of the moves made with it.
    pub totals: Totals,
}

/// A work offset of the job.
#[derive(Clone, Debug)]
pub struct WorkUse {
    /// The offset, as the form counts it.
    pub work: f64,
    /// Sums of the moves made in it.
    pub totals: Totals,
}

/// What lies ahead in a job. Lengths are in the job's units.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Sums of the whole job.
    pub whole: Totals,
    /// The operations in their order.
    pub operations: Vec<Operation>,
    /// The tools in the order of their first use, each once.
    pub tools: Vec<ToolUse>,
    /// The work offsets in the order of their first use, each once.
    pub works: Vec<WorkUse>,
    /// The numbers of the tools as they are changed, one for each change.
    pub changes: Vec<f64>,
}

/// A subprogram's sums, and what it calls.
#[derive(Clone, Debug, Default)]
struct Sub {
    totals: Totals,
    calls: Vec<Call>,
}

/// Makes a survey of the events of a job.
#[derive(Debug)]
pub struct Surveyor {
    terms: Terms,
    survey: Survey,
    motion: Motion,
    /// Sums since the operation or the work offset changed.
    now: Totals,
    work: f64,
    tool_rows: HashMap<u64, usize>,
    subs: HashMap<u64, Sub>,
    /// The subprogram that is open.
    open: Option<(u64, Sub)>,
}

impl Surveyor {
    /// Nothing is read yet.
    pub fn new(terms: Terms) -> Surveyor {
        let (defaults, work) = (terms.defaults[0], terms.work);
        Surveyor {
            terms,
            survey: Survey::default(),
            motion: Motion::new(defaults, Machine::Mill),
            now: Totals::default(),
            work,
            tool_rows: HashMap::new(),
            subs: HashMap::new(),
            open: None,
        }
    }

    /// The survey, when the job was read.
    pub fn finish(mut self) -> Survey {
        self.flush();
        self.survey
    }

    fn tool_of_now(&self) -> Option<usize> {
        self.survey.operations.last().and_then(|operation| operation.tool)
    }

    /// Adds what was summed up to all that it is a part of.
    fn flush(&mut self) {
        if let Some((_, sub)) = &mut self.open {
            sub.totals.add(&std::mem::take(&mut self.now), 1.0);
            return;
        }
        let mut now = std::mem::take(&mut self.now);
        if now.is_still() {
            return;
        }
        if now.works.is_empty() {
            now.works.push(self.work);
        }
        let tool = self.tool_of_now();
        let survey = &mut self.survey;
        survey.whole.add(&now, 1.0);
        if let Some(operation) = survey.operations.last_mut() {
            operation.totals.add(&now, 1.0);
        }
        if let Some(tool) = tool {
            survey.tools[tool].totals.add(&now, 1.0);
        }
        let row = survey.works.iter().position(|row| row.work == self.work).unwrap_or_else(|| {
            survey.works.push(WorkUse { work: self.work, totals: Totals::default() });
            survey.works.len() - 1
        });
        survey.works[row].totals.add(&now, 1.0);
    }

    fn counted(&self, work: f64) -> f64 {
        work_code(self.terms.first_work, work).unwrap_or(work)
    }

    fn change_work(&mut self, work: f64) {
        self.flush();
        self.work = self.counted(work);
    }

    fn operation(&mut self, change: &ToolChange) {
        self.flush();
        let before = self.tool_of_now();
        let tool = match &change.tool {
            None => before,
            Some(tool) => {
                let row = *self.tool_rows.entry(key(tool.number)).or_insert_with(|| {
                    let first = self.survey.operations.len();
                    self.survey.tools.push(ToolUse { tool: tool.clone(), first, totals: Totals::default() });
                    self.survey.tools.len() - 1
                });
                if Some(row) != before {
                    self.survey.changes.push(tool.number);
                }
                Some(row)
            }
        };
        if self.terms.only_order {
            // nothing else of it is asked for
            self.survey.operations.clear();
        }
        let begins = ToolChange { first: First::Nothing, ..change.clone() };
        self.motion.operation(change, tool != before);
        let totals = Totals { operations: 1, ..Totals::default() };
        self.survey.operations.push(Operation { begins, tool, spindle: self.motion.spindle(), totals });
        self.survey.whole.operations += 1;
        if let Some(tool) = tool {
            self.survey.tools[tool].totals.operations += 1;
        }
        if let Some(work) = change.work {
            self.work = self.counted(work);
        }
        let works = &mut self.survey.works;
        match works.iter_mut().find(|row| row.work == self.work) {
            Some(row) => row.totals.operations += 1,
            None => {
                let totals = Totals { operations: 1, ..Totals::default() };
                works.push(WorkUse { work: self.work, totals });
            }
        }
    }

    /// A call adds what the subprogram does, in the work offset of the call.
    fn call(&mut self, call: &Call) {
        if let Some((_, sub)) = &mut self.open {
            sub.calls.push(*call);
            self.motion.forget_place();
            return;
        }
        self.flush();
        let mut called = Totals::default();
        self.add_called(call, &mut called, &mut Vec::new());
        let before = self.work;
        self.work = call.work.map_or(before, |work| self.counted(work));
        self.now = called;
        self.flush();
        self.work = before;
        self.motion.forget_place();
    }

    /// A subprogram that calls itself is refused when the job is printed: it adds nothing here.
    fn add_called(&self, call: &Call, into: &mut Totals, open: &mut Vec<u64>) {
        let sub = key(call.sub);
        let Some(Sub { totals, calls }) = self.subs.get(&sub).filter(|_| !open.contains(&sub) && open.len() < DEEPEST)
        else {
            return;
        };
        into.add(totals, call.times);
        open.push(sub);
        for inner in calls {
            self.add_called(&Call { times: inner.times * call.times, ..*inner }, into, open);
        }
        open.pop();
    }
}

/// How deep calls are followed.
const DEEPEST: usize = 8;

impl Sink for Surveyor {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        match event {
            Event::Start(start) => {
                if let (true, Some(order)) = (self.terms.only_order, &start.tool_order) {
                    self.survey.changes.clone_from(order);
                    return Flow::Break(Stop::Enough);
                }
                let defaults = self.terms.defaults[usize::from(start.units == Units::Mm)];
                self.motion = Motion::new(defaults, start.machine);
            }
            Event::ToolChange(change) => self.operation(change),
            _ if self.terms.only_order => {}
            Event::Work(work) => self.change_work(work),
            Event::SubStart(number) => {
                self.flush();
                self.motion.forget_place();
                self.open = Some((key(number), Sub::default()));
            }
            Event::SubEnd => {
                self.flush();
                self.subs.extend(self.open.take());
                self.motion.forget_place();
            }
            Event::SubCall(call) => self.call(call),
            event => self.motion.event(&event, &mut self.now),
        }
        Flow::Continue(())
    }
}
