//! The state of a Siemens program, in addition to the state of the machine: parameters, the modal cycle, positions of
//! program parts.

use std::collections::HashMap;

use crate::nc::call::Call;
use crate::nc::way::Spot;
use crate::toolpath::Units;

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
    /// For each `REPEAT` with a label: the line of the `REPEAT`, and the number of repeats that are left.
    pub(super) repeats: Vec<(u64, u32)>,
    /// The line of the `FOR` to which the last `ENDFOR` has jumped back.
    pub(super) next_round: Option<u64>,
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
    }
}
