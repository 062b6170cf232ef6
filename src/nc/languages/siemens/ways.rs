//! What a program of a Siemens keeps besides the state of the machine: parameters, the modal cycle, where its parts begin.

use std::collections::HashMap;

use crate::nc::call::Call;
use crate::nc::way::Spot;
use crate::toolpath::Units;

/// What is kept from block to block.
#[derive(Debug, Default)]
pub struct Siemens {
    /// R parameters by their names, `R1`.
    pub(super) parameters: HashMap<String, f64>,
    /// Variables of `DEF`, those of the main program first, one map for each subprogram that runs.
    pub(super) variables: Vec<HashMap<String, f64>>,
    /// The cycle of `MCALL`.
    pub(super) modal: Option<Call>,
    /// Names of tools in their order; they count from 1.
    tools: Vec<Vec<u8>>,
    /// Units as the program said them last.
    pub(super) units: Option<Units>,
    /// Arguments of a call whose `PROC` comes next.
    pub(super) arguments: Option<Vec<Option<f64>>>,
    /// Where programs of the input begin, in order; `None`: not looked for yet.
    pub(super) sections: Option<Vec<Section>>,
    /// Parts of structured blocks by the line that opens them.
    pub(super) parts: HashMap<u64, Part>,
    /// Where the line goes that ends a part.
    pub(super) ends: HashMap<u64, Spot>,
    /// A label with its places, by section and name.
    pub(super) labels: HashMap<(usize, String), Vec<Spot>>,
    /// `REPEAT` of a label: its line, and how often it still goes back.
    pub(super) repeats: Vec<(u64, u32)>,
    /// The line of a `FOR` to which its `ENDFOR` went back.
    pub(super) next_round: Option<u64>,
}

/// A program or subprogram of the input.
#[derive(Clone, Debug)]
pub struct Section {
    pub name: String,
    /// Before its first line.
    pub start: Spot,
}

/// A structured block.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// After the `ELSE`.
    pub middle: Option<Spot>,
    /// After the line that ends it.
    pub end: Spot,
}

impl Siemens {
    /// What a name stands for.
    pub(super) fn value(&self, name: &str) -> Option<f64> {
        self.variables.last().and_then(|own| own.get(name)).or_else(|| self.parameters.get(name)).copied()
    }

    /// Gives a variable or parameter a value; `false`: there is none of this name.
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

    /// Variables of so many subprograms inside each other are kept, and those of the one that runs are there.
    pub(super) fn at_depth(&mut self, depth: usize) {
        self.variables.truncate(depth + 1);
        self.variables.resize_with(depth + 1, HashMap::new);
    }

    /// The number of a tool: its name as a number, else its place among the names of the program.
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
