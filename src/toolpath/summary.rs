//! Statistics of a job: its tools, moves, holes and extents.

use std::collections::HashSet;

use super::CycleKind;
use super::axes::{Axes, Units};
use super::event::Event;
use super::job_axes::JobAxes;
use super::order::{Order, impossible};
use super::start::Start;
use super::{Flow, Place, Sink, flow, key};
use crate::diag::{Code, Diag};
use crate::lang::Machine;

/// Counts the events of a job. `postform check` prints the result.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Units of the job.
    pub units: Option<Units>,
    /// Name of the job.
    pub name: Option<String>,
    /// Program number of the job.
    pub program: Option<f64>,
    /// Tool numbers in the order of their first use, each with its diameter.
    pub tools: Vec<(f64, Option<f64>)>,
    /// Number of operations.
    pub operations: u64,
    /// Number of rapid moves.
    pub rapids: u64,
    /// Number of straight feed moves.
    pub lines: u64,
    /// Number of arcs.
    pub arcs: u64,
    /// Number of holes for each kind of cycle.
    pub holes: Vec<(CycleKind, u64)>,
    /// Least and greatest position of each linear axis, over all ends of moves and bottoms of holes.
    pub extents: [Option<(f64, f64)>; 3],
    /// Number of changes of the tool axis.
    pub tilts: u64,
    /// Location of the first change of the tool axis.
    tilted: Option<Place>,
    /// Location of the first operation without content.
    idle: Option<Place>,
    /// Location of the current operation if it has no content so far.
    begun: Option<Place>,
    order: Order,
    kind: Option<(CycleKind, f64)>,
    /// Numbers of the tools in `tools`.
    seen: HashSet<u64>,
    last: [f64; 3],
    machine: Machine,
}

impl Summary {
    fn reach(&mut self, to: &Axes) {
        for axis in 0..3 {
            if let Some(value) = to.get(axis) {
                self.last[axis] = value;
                self.extend(axis, value);
            }
        }
    }

    fn extend(&mut self, axis: usize, value: f64) {
        let (least, greatest) = self.extents[axis].unwrap_or((value, value));
        self.extents[axis] = Some((least.min(value), greatest.max(value)));
    }

    /// The findings about the job that prevent every form from printing it. Rendering would report these findings too.
    pub fn unprintable(&self) -> Vec<Diag> {
        let at = |place: Place, code, message: String, help: &str| Diag::new(code, message).help(help).place(place);
        let tilted = self.tilted.map(|place| {
            let places = if self.tilts == 1 { "here".into() } else { format!("{} moves, the first one here", self.tilts) };
            let message = format!("no form can print the job, because the tool is tilted ({places})");
            let help =
                "forms can't print a tilted tool: post the operations of each tool axis separately, as setups; for a \
                 CL file `--setup N` selects one";
            at(place, Code::PR008, message, help)
        });
        let idle = self.idle.map(|place| {
            let message = "no form can print the job, because an operation has no move".to_owned();
            at(place, Code::PR012, message, "remove the operation, or give it a move")
        });
        tilted.into_iter().chain(idle).collect()
    }

    fn start(&mut self, start: &Start) {
        self.units = Some(start.units);
        self.name.clone_from(&start.name);
        self.program = start.program;
        self.machine = start.machine;
    }
}

impl Sink for Summary {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        flow(self.count(event, place))
    }
}

impl Summary {
    fn count(&mut self, event: Event<'_>, place: Place) -> Result<(), Box<Diag>> {
        self.order.follow(&event)?;
        let begun = self.begun.take();
        match event {
            Event::Start(start) => self.start(start),
            Event::ToolChange(change) => {
                self.idle = self.idle.or(begun);
                self.begun = Some(place).filter(|_| change.tool.is_some());
                self.operations += 1;
                if let Some(tool) = &change.tool
                    && self.seen.insert(key(tool.number))
                {
                    self.tools.push((tool.number, tool.diameter));
                }
            }
            Event::Rapid(to) => {
                self.rapids += 1;
                self.reach(&to);
            }
            Event::Line { to, .. } | Event::Outfeed { to, .. } => {
                self.lines += 1;
                self.reach(&to);
            }
            Event::Infeed { infeed, .. } => {
                self.lines += 1;
                self.reach(&infeed.to);
            }
            Event::Arc { arc, .. } => {
                self.arcs += 1;
                self.reach(&arc.to);
            }
            Event::Finish => self.idle = self.idle.or(begun),
            Event::Tilt(_) => {
                self.tilts += 1;
                self.tilted.get_or_insert(place);
            }
            Event::CycleBegin(spec) => {
                self.kind = Some((spec.kind, spec.deepest().unwrap_or(0.0)));
                if !self.holes.iter().any(|(kind, _)| *kind == spec.kind) {
                    self.holes.push((spec.kind, 0));
                }
            }
            Event::Hole(hole) => {
                let Some((kind, depth)) = self.kind else { return impossible("a hole outside a cycle") };
                if let Some(row) = self.holes.iter_mut().find(|(k, _)| *k == kind) {
                    row.1 += 1;
                }
                self.reach(&hole.at);
                if let Some(axis) = JobAxes::of(self.machine).depth
                    && self.extents[axis].is_some()
                {
                    self.extend(axis, self.last[axis] - hole.depth.unwrap_or(depth));
                }
            }
            _ => {}
        }
        Ok(())
    }
}
