//! The state of a Siemens program, in addition to the state of the machine: parameters, the modal cycle, positions of
//! program parts.

use std::collections::HashMap;

use crate::nc::action::Position;
use crate::nc::call::Call;
use crate::nc::state::Modes;
use crate::nc::way::Spot;
use crate::toolpath::{Side, Units};

/// The state that is kept between blocks.
#[derive(Debug, Default)]
pub struct Siemens {
    /// The values of the R parameters by name, such as `R1`.
    pub(super) parameters: HashMap<String, f64>,
    /// The values of variables that `DEF` defines: one map for the main program, then one for each running subprogram.
    pub(super) variables: Vec<HashMap<String, Variable>>,
    /// The cycle that `MCALL` has made modal.
    pub(super) modal: Option<Call>,
    /// The units that the program has last set.
    pub(super) units: Option<Units>,
    /// Whether the code of these units does not change the unit of feeds: G70 and G71.
    pub(super) lengths_only: bool,
    /// As bits, the axes that have not moved to a position since their frame or the tool length changed.
    pub(super) shifted: u8,
    /// The value of D in the block of T, for the tool that the next M6 loads.
    pub(super) next_edge: Option<f64>,
    /// Whether no D word has selected an edge since the last M6.
    pub(super) no_edge: bool,
    /// The register of the last D word.
    pub(super) edge: Option<f64>,
    /// The arguments of a call. The arguments are stored until the `PROC` line of the subprogram is read.
    pub(super) arguments: Option<Vec<Option<f64>>>,
    /// The programs of the input in their order; `None`: the input has not been searched yet.
    pub(super) sections: Option<Vec<Section>>,
    /// The parts of structured blocks, by the line that opens each part.
    pub(super) parts: HashMap<u64, Part>,
    /// For each line that ends a part: the position to which the line jumps.
    pub(super) ends: HashMap<u64, Spot>,
    /// The positions of each label, by section and name.
    pub(super) labels: HashMap<(usize, String), Vec<Spot>>,
    /// The running `REPEAT` statements with a label.
    pub(super) repeats: Vec<Repeat>,
    /// The modes to which the subprograms with `SAVE` return, each with the depth of its subprogram.
    pub(super) saved: Vec<(usize, Saved)>,
    /// The line of the `FOR` to which the last `ENDFOR` has jumped back.
    pub(super) next_round: Option<u64>,
    /// The words of the current block that are not simulated.
    pub(super) left_out: Vec<Box<str>>,
}

/// A variable of a program.
#[derive(Clone, Copy, Debug)]
pub struct Variable {
    pub kind: Kind,
    pub value: f64,
}

/// The type of a variable.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Real,
    Int,
    Bool,
}

impl Kind {
    /// The type with this name.
    pub(super) fn named(name: &[u8]) -> Option<Kind> {
        let all = [("REAL", Kind::Real), ("INT", Kind::Int), ("BOOL", Kind::Bool)];
        all.iter().find(|(own, _)| name.eq_ignore_ascii_case(own.as_bytes())).map(|(_, kind)| *kind)
    }

    /// The value that a variable of this type gets. The control rounds a value for INT: from .5 on upward.
    pub(super) fn holds(self, value: f64) -> f64 {
        match self {
            Kind::Real => value,
            Kind::Int => (value + 0.5).floor(),
            Kind::Bool => f64::from(u8::from(value != 0.0)),
        }
    }
}

/// A `REPEAT` with a label whose part is being repeated.
#[derive(Clone, Debug)]
pub struct Repeat {
    pub label: String,
    /// Position after the line with `REPEAT`.
    pub after: Spot,
    /// The depth of nested subprograms at this line.
    pub depth: usize,
    /// Number of repeats that are left.
    pub left: u32,
}

/// The modes that a subprogram with `SAVE` restores at its end.
#[derive(Clone, Debug)]
pub struct Saved {
    pub modes: Modes,
    /// The shift of the frame.
    pub shift: Position,
    pub work: Option<f64>,
    pub side: Option<Side>,
}

/// A main program or subprogram of the input.
#[derive(Clone, Debug)]
pub struct Section {
    pub name: String,
    /// Position before the first line of the section.
    pub start: Spot,
}

/// A part of the program that is opened and ended by words such as `IF` and `ENDIF`.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Position after the line with `ELSE`.
    pub middle: Option<Spot>,
    /// Position after the line that ends the part.
    pub end: Spot,
}

impl Siemens {
    /// The value of a variable or parameter.
    pub(super) fn value(&self, name: &str) -> Option<f64> {
        let own = self.variables.last().and_then(|own| own.get(name)).map(|own| own.value);
        own.or_else(|| self.parameters.get(name).copied())
    }

    /// Sets a variable or parameter. Returns `false` if no variable or parameter has this name.
    pub(super) fn set(&mut self, name: &str, value: f64) -> bool {
        if let Some(own) = self.variables.last_mut().and_then(|own| own.get_mut(name)) {
            own.value = own.kind.holds(value);
            return true;
        }
        let is_parameter = name
            .strip_prefix('R')
            .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()));
        if is_parameter {
            self.parameters.insert(name.to_owned(), value);
        }
        is_parameter
    }

    /// Removes the variables of subprograms that have ended, and adds those of the subprogram that is running.
    pub(super) fn at_depth(&mut self, depth: usize) {
        self.variables.truncate(depth + 1);
        self.variables.resize_with(depth + 1, HashMap::new);
        // a subprogram ends its repeats
        while self.repeats.pop_if(|repeat| repeat.depth > depth).is_some() {}
    }

    /// Whether a subprogram is running.
    pub(super) fn is_in_subprogram(&self) -> bool {
        self.variables.len() > 1
    }

    /// Whether the program is in a part that is being repeated. `depth`: the depth of nested subprograms.
    pub(super) fn repeats_at(&self, depth: usize) -> bool {
        self.repeats.last().is_some_and(|repeat| repeat.depth == depth)
    }
}
