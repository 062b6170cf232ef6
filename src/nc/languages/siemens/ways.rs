//! State of a Siemens program besides the state of the machine: parameters, the modal cycle, positions of program parts.

use std::collections::HashMap;

use crate::nc::call::Call;
use crate::nc::way::Spot;
use crate::toolpath::Units;

/// State that is kept from block to block.
#[derive(Debug, Default)]
pub struct Siemens {
    /// R parameters by their names, `R1`.
    pub(super) parameters: HashMap<String, f64>,
    /// Variables of `DEF`, one map for each running subprogram; the main program is first.
    pub(super) variables: Vec<HashMap<String, f64>>,
    /// The cycle of `MCALL`.
    pub(super) modal: Option<Call>,
    /// Tool names in order. They are numbered from 1.
    tools: Vec<Vec<u8>>,
    /// The units that the program has set last.
    pub(super) units: Option<Units>,
    /// Arguments of a call until its `PROC` line is read.
    pub(super) arguments: Option<Vec<Option<f64>>>,
    /// The programs of the input in order; `None`: the input was not searched yet.
    pub(super) sections: Option<Vec<Section>>,
    /// Parts of structured blocks by the line that opens them.
    pub(super) parts: HashMap<u64, Part>,
    /// Jump targets of the lines that end a part, by line.
    pub(super) ends: HashMap<u64, Spot>,
    /// The positions of a label, by section and name.
    pub(super) labels: HashMap<(usize, String), Vec<Spot>>,
    /// `REPEAT` of a label: its line, and the number of repeats left.
    pub(super) repeats: Vec<(u64, u32)>,
    /// The line of the `FOR` that its `ENDFOR` jumped back to.
    pub(super) next_round: Option<u64>,
}

/// A program or subprogram of the input.
#[derive(Clone, Debug)]
pub struct Section {
    pub name: String,
    /// Position before the first line.
    pub start: Spot,
}

/// A structured block.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Position after the `ELSE`.
    pub middle: Option<Spot>,
    /// Position after the line that ends it.
    pub end: Spot,
}

impl Siemens {
    /// The value of a name.
    pub(super) fn value(&self, name: &str) -> Option<f64> {
        self.variables.last().and_then(|own| own.get(name)).or_else(|| self.parameters.get(name)).copied()
    }

    /// Sets a variable or parameter. Returns `false` if there is none of this name.
    pub(super) fn set(&mut self, name: &str, value: f64) -> bool {
        if let Some(own) = self.variables.last_mut().and_then(|own| own.get_mut(name)) {
            *own = value;
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

    /// Keeps the variables of this many nested subprograms, and creates those of the running one.
    pub(super) fn at_depth(&mut self, depth: usize) {
        self.variables.truncate(depth + 1);
        self.variables.resize_with(depth + 1, HashMap::new);
    }

    /// The number of a tool: its name if that is a number, else its index among the tool names of the program.
    pub(super) fn tool(&mut self, name: &[u8]) -> f64 {
        let number = std::str::from_utf8(name).ok().and_then(|name| name.parse::<u32>().ok());
        if let Some(number) = number {
            return f64::from(number);
        }
        let at = self.tools.iter().position(|known| known.eq_ignore_ascii_case(name)).unwrap_or_else(|| {
            self.tools.push(name.to_vec());
            self.tools.len() - 1
        });
        (at + 1) as f64
    }
}
