//! Collects the contents of a job before it is printed: tools, operations and work offsets, the extents and the length
//! of the cuts. Some forms print these contents before the first move. For these forms the job is read twice, and the
//! first reading makes the survey.

mod motion;
mod subprograms;
mod totals;

pub use totals::{Reach, Totals};

use std::collections::HashMap;

use indexmap::IndexSet;

use crate::cycle::Defaults;
use crate::lang::{Machine, work_code};
use crate::times::Rates;
use crate::toolpath::{Call, Event, First, Flow, Place, Sink, Spindle, Stop, Tool, ToolChange, Units, key};
use motion::Motion;
use subprograms::Subprograms;

/// Values of the form that are used if a job lacks them.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Default values of cycles: the first for jobs in inches, the second for jobs in millimetres.
    pub defaults: [Defaults; 2],
    /// The work offset of a job that names no work offset, in the numbering of the form.
    pub work: f64,
    /// The number that the form uses for the first work offset.
    pub first_work: f64,
    /// Whether only the order of the tools is needed. Some jobs contain the order of the tools in their head.
    pub only_order: bool,
    /// The speeds of the machine, for calculating times with its accelerations.
    pub rates: Option<Rates>,
}

/// An operation of the job.
#[derive(Clone, Debug)]
pub struct Operation {
    /// The tool change at the beginning of the operation, without the first move.
    pub begins: ToolChange,
    /// The tool of the operation: an index into [`Survey::tools`].
    pub tool: Option<usize>,
    /// The last tool change before the operation: an index into [`Survey::changes`].
    pub change: usize,
    /// The state of the spindle at the beginning of the operation.
    pub spindle: Spindle,
    /// The work offset in which the operation begins.
    pub work: f64,
    /// The totals of all moves of the operation.
    pub totals: Totals,
}

/// A tool of the job.
#[derive(Clone, Debug)]
pub struct ToolUse {
    /// The tool.
    pub tool: Tool,
    /// The operation that uses the tool first: an index into [`Survey::operations`].
    pub first: usize,
    /// The totals of all moves with the tool.
    pub totals: Totals,
    /// The operations that use the tool: indexes into [`Survey::operations`].
    pub operations: Vec<usize>,
}

/// A work offset of the job.
#[derive(Clone, Debug)]
pub struct WorkUse {
    /// The offset, in the numbering of the form.
    pub work: f64,
    /// The totals of all moves in the work offset.
    pub totals: Totals,
    /// The operations in the offset: indexes into [`Survey::operations`].
    pub operations: Vec<usize>,
}

/// The contents of a job. Lengths are in the job's units.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// The totals of the whole job.
    pub whole: Totals,
    /// The operations in their order.
    pub operations: Vec<Operation>,
    /// The tools in the order of their first use. Each tool is contained once.
    pub tools: Vec<ToolUse>,
    /// The work offsets in the order of their first use. Each offset is contained once.
    pub works: Vec<WorkUse>,
    /// The tool numbers in the order of the tool changes: one number for each change.
    pub changes: Vec<f64>,
}

/// Makes a survey from the events of a job.
#[derive(Debug)]
pub struct Surveyor {
    terms: Terms,
    survey: Survey,
    motion: Motion,
    /// Sums since the last change of the operation or the work offset.
    now: Totals,
    work: f64,
    tool_rows: HashMap<u64, usize>,
    work_rows: HashMap<u64, usize>,
    subs: Subprograms,
}

impl Surveyor {
    /// A surveyor before the first event.
    pub fn new(terms: Terms) -> Surveyor {
        let (defaults, work) = (terms.defaults[0], terms.work);
        Surveyor {
            terms,
            survey: Survey::default(),
            motion: Motion::new(defaults, Machine::Mill, Units::Mm, None),
            now: Totals::default(),
            work,
            tool_rows: HashMap::new(),
            work_rows: HashMap::new(),
            subs: Subprograms::default(),
        }
    }

    /// Returns the survey. To be called after the last event of the job.
    pub fn finish(mut self) -> Survey {
        self.flush();
        let Survey { operations, works, .. } = &mut self.survey;
        for (at, operation) in operations.iter().enumerate() {
            let rows = operation.totals.works.iter().filter_map(|work| self.work_rows.get(work));
            rows.for_each(|&row| works[row].operations.push(at));
        }
        works.iter_mut().for_each(|row| row.totals.operations = row.operations.len() as u64);
        self.survey
    }

    fn tool_of_now(&self) -> Option<usize> {
        self.survey.operations.last().and_then(|operation| operation.tool)
    }

    /// Adds the current sums to the sums of the job, the operation, the tool and the work offset.
    fn flush(&mut self) {
        self.motion.stop(&mut self.now);
        let now = std::mem::take(&mut self.now);
        match self.subs.is_open() {
            true => self.subs.add(&now),
            false => self.add(self.work, now),
        }
    }

    /// Adds moves of the main program that are made in a work offset.
    fn add(&mut self, work: f64, mut moves: Totals) {
        if moves.is_still() {
            return;
        }
        moves.works = IndexSet::from([key(work)]);
        let tool = self.tool_of_now();
        let survey = &mut self.survey;
        survey.whole.add(&moves, 1.0);
        if let Some(operation) = survey.operations.last_mut() {
            operation.totals.add(&moves, 1.0);
        }
        if let Some(tool) = tool {
            survey.tools[tool].totals.add(&moves, 1.0);
        }
        let row = self.row_of(work);
        self.survey.works[row].totals.add(&moves, 1.0);
    }

    fn counted(&self, work: f64) -> f64 {
        work_code(self.terms.first_work, work).unwrap_or(work)
    }

    fn change_work(&mut self, work: f64) {
        self.flush();
        let work = self.counted(work);
        match self.subs.is_open() {
            true => self.subs.change_work(work),
            false => self.work = work,
        }
    }

    fn operation(&mut self, change: &ToolChange) {
        self.flush();
        let before = self.tool_of_now();
        let new = change.changes_to(before.map(|row| self.survey.tools[row].tool.number));
        self.survey.changes.extend(new.map(|tool| tool.number));
        let tool = match &change.tool {
            None => before,
            Some(tool) => {
                let row = *self.tool_rows.entry(key(tool.number)).or_insert_with(|| {
                    let first = self.survey.operations.len();
                    let totals = Totals::default();
                    self.survey.tools.push(ToolUse { tool: tool.clone(), first, totals, operations: Vec::new() });
                    self.survey.tools.len() - 1
                });
                Some(row)
            }
        };
        if self.terms.only_order {
            // the order of the tools is all that is needed
            self.survey.operations.clear();
        }
        let begins = ToolChange { first: First::Nothing, ..change.clone() };
        if let Some(work) = change.work {
            self.work = self.counted(work);
        }
        self.motion.operation(change, new.is_some());
        self.survey.operations.push(Operation {
            begins,
            tool,
            change: self.survey.changes.len().saturating_sub(1),
            spindle: self.motion.spindle(),
            work: self.work,
            totals: Totals::of_operation(),
        });
        self.survey.whole.operations += 1;
        if let Some(tool) = tool {
            let row = self.survey.operations.len() - 1;
            let used = &mut self.survey.tools[tool];
            used.totals.operations += 1;
            used.operations.push(row);
        }
        self.row_of(self.work);
    }

    /// The index of a work offset. A new row is added at the first use of the offset.
    fn row_of(&mut self, work: f64) -> usize {
        let works = &mut self.survey.works;
        *self.work_rows.entry(key(work)).or_insert_with(|| {
            works.push(WorkUse { work, totals: Totals::default(), operations: Vec::new() });
            works.len() - 1
        })
    }

    /// Adds the moves of a subprogram. The moves are in the work offset of the call, unless the subprogram selects its
    /// own work offset.
    fn call(&mut self, call: &Call) {
        self.flush();
        self.motion.forget_place();
        let call = Call { work: call.work.map(|work| self.counted(work)), ..*call };
        let mut way = Totals::default();
        way.moves.moves_to(&call.at);
        if self.subs.is_open() {
            return self.subs.call(&call, &way);
        }
        let work = call.work.unwrap_or(self.work);
        self.add(work, way);
        for part in self.subs.parts_of(call.sub).to_vec() {
            let mut called = Totals::default();
            called.add(&part.totals, call.times);
            self.add(part.work.unwrap_or(work), called);
        }
    }
}

impl Sink for Surveyor {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        match event {
            Event::Start(start) => {
                if let (true, Some(order)) = (self.terms.only_order, &start.tool_order) {
                    self.survey.changes.clone_from(order);
                    return Flow::Break(Stop::Enough);
                }
                let defaults = self.terms.defaults[usize::from(start.units == Units::Mm)];
                self.motion = Motion::new(defaults, start.machine, start.units, self.terms.rates.as_ref());
            }
            Event::ToolChange(change) => self.operation(change),
            _ if self.terms.only_order => {}
            Event::Work(work) => self.change_work(work),
            Event::SubStart(number) => {
                self.flush();
                self.motion.begin_subprogram();
                self.subs.begin(number);
            }
            Event::SubEnd => {
                self.flush();
                self.subs.end();
                self.motion.forget_place();
            }
            Event::SubCall(call) => self.call(call),
            event => self.motion.event(&event, &mut self.now),
        }
        Flow::Continue(())
    }
}
