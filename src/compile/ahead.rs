//! Finds the values that a form uses and that are known only at the end of a job. If a known property value excludes a
//! branch of the form, the values in this branch are left out.

use std::ops::Range;

use super::program::{Op, Program};
use super::routine::{Branch, Node, Routine};
use crate::lang::{AHEAD, Coolant, TOOLS_AHEAD, TextId, VarId, VarSet};
use crate::sema::{PropertyKind, PropertyValue, Target, Values};

/// Properties whose values no longer change, each with its row and its value.
pub type Fixed = [(u16, PropertyValue)];

/// The kinds of values that a form uses and that are known only at the end of the job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asks {
    /// Whether the form uses lists, extents or sums.
    pub all: bool,
    /// Whether the form uses tools that come later in the job.
    pub tools: bool,
}

impl Program {
    /// The kinds of values that the form uses and that are known only at the end of the job. `fixed`: properties with
    /// fixed values. Branches that these values exclude do not count.
    pub fn asks_ahead(&self, fixed: &Fixed) -> Asks {
        let lists = self.ops.iter().any(|op| matches!(op, Op::List { .. }));
        let asks = |vars: VarSet, lists: bool| Asks { all: lists || vars.meets(AHEAD), tools: vars.meets(TOOLS_AHEAD) };
        let whole = asks(self.used(), lists);
        if whole == Asks::default() || fixed.is_empty() {
            return whole;
        }
        let mut walk =
            Walk { program: self, known: Known { program: self, fixed }, vars: self.upon_vars, lists: false };
        let routines = self.routines.iter().flatten().chain(self.upons.iter().map(|upon| &upon.routine));
        routines.for_each(|routine| walk.routine(routine));
        asks(walk.vars, walk.lists)
    }
}

/// The properties whose values are known.
struct Known<'k> {
    program: &'k Program,
    fixed: &'k Fixed,
}

impl Known<'_> {
    /// The value of a property; `None` if the value is unknown or the form changes it.
    fn get(&self, row: u16) -> Option<&PropertyValue> {
        let set = self.program.sets.iter().any(|(target, _)| *target == Target::Property(row));
        // a length is unknown, because the units of the program depend on the job
        let length = self.program.settings.properties[usize::from(row)].kind == PropertyKind::Length;
        let fixed = self.fixed.iter().rev().find(|(own, _)| *own == row && !set && !length);
        fixed.map(|(_, value)| value)
    }
}

impl Values for Known<'_> {
    fn number(&self, _: VarId) -> Option<f64> {
        None
    }

    fn text(&self, _: TextId) -> &str {
        ""
    }

    fn coolant(&self) -> Coolant {
        Coolant::OFF
    }

    fn property(&self, row: u16) -> f64 {
        self.get(row).map_or(0.0, PropertyValue::number)
    }

    fn property_text(&self, row: u16) -> &str {
        self.get(row).map_or("", PropertyValue::text)
    }
}

/// Collects the values that the form uses in branches that may be taken.
struct Walk<'w> {
    program: &'w Program,
    known: Known<'w>,
    vars: VarSet,
    lists: bool,
}

impl Walk<'_> {
    fn routine(&mut self, routine: &Routine) {
        match &routine.flow {
            Some(flow) => self.part(&routine.ops, &flow.nodes),
            None => self.ops(routine.ops.clone()),
        }
    }

    /// Collects the values that a part of a sequence uses, in branches and outside branches.
    fn part(&mut self, ops: &Range<usize>, nodes: &[Node]) {
        let mut at = ops.start;
        for node in nodes {
            let Node::If(branches) = node else { continue };
            for branch in branches {
                self.ops(at..branch.ops.start);
                at = branch.ops.end;
            }
            self.branches(branches);
        }
        self.ops(at..ops.end);
    }

    fn branches(&mut self, branches: &[Branch]) {
        for branch in branches {
            let condition = branch.condition.map(|index| &self.program.formulas[index as usize]);
            let decided = match condition {
                Some(condition) => condition.decided(&self.known, &|row| self.known.get(row).is_some()),
                None => Some(true),
            };
            if decided == Some(false) {
                continue;
            }
            if let Some(condition) = condition.filter(|_| decided.is_none()) {
                self.vars = self.vars.with(condition.vars());
            }
            self.part(&branch.ops, &branch.nodes);
            if decided == Some(true) {
                return;
            }
        }
    }

    fn ops(&mut self, ops: Range<usize>) {
        for op in &self.program.ops[ops] {
            match *op {
                Op::Var { var, .. } | Op::Value { var, .. } | Op::Remark { var, .. } => self.vars.insert(var),
                Op::Formula { index, .. } | Op::ValueFormula { index, .. } | Op::RemarkFormula { index, .. } => {
                    self.asked(index);
                }
                Op::Set { index } => self.asked(self.program.sets[index as usize].1),
                Op::List { .. } => self.lists = true,
                _ => {}
            }
        }
    }

    fn asked(&mut self, formula: u32) {
        self.vars = self.vars.with(self.program.formulas[formula as usize].vars());
    }
}
