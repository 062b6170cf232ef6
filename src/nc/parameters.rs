//! The `#` parameters of a program.

use std::collections::HashMap;

use super::fault::{Done, refuse};
use super::macros::Language;
use crate::control::Control;
use crate::diag::Code;

/// The highest number of a parameter.
const HIGHEST: usize = 9999;

/// LinuxCNC's names of the value that the last subprogram has returned, and whether it has returned one.
const RETURNED: [&str; 2] = ["_value", "_value_returned"];

/// The parameters of a program, numbered and named.
#[derive(Clone, Debug)]
pub struct Parameters {
    control: &'static Control,
    numbered: Vec<Option<f64>>,
    global: HashMap<String, f64>,
    /// Named parameters, one map for the main program and for each running subprogram.
    local: Vec<HashMap<String, f64>>,
    /// For each running subprogram, the values of `#1` to `#30` that are restored at its end.
    kept: Vec<[Option<f64>; 30]>,
    /// Position of the tool, which programs read from `#5420` and the next parameters.
    pub position: [f64; 6],
    /// The least increment of lengths.
    pub increment: f64,
}

/// The parameter to which a value is assigned.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// The parameter with this number: `#1=`.
    Number(usize),
    /// The parameter with this name: `#<name>=`.
    Name(String),
}

impl Parameters {
    /// The parameters at the beginning of a program, all without a value.
    pub fn new(control: &'static Control) -> Parameters {
        Parameters {
            control,
            numbered: vec![None; HIGHEST + 1],
            global: RETURNED.map(|name| (name.to_owned(), 0.0)).into(),
            local: vec![HashMap::new()],
            kept: Vec::new(),
            position: [0.0; 6],
            increment: 1e-3,
        }
    }

    /// The macro language of the control.
    pub fn language(&self) -> &'static Language {
        Language::of(self.control)
    }

    /// Converts a value to the number of a parameter.
    ///
    /// # Errors
    /// The value is not the number of a parameter.
    pub fn number(value: f64) -> Done<usize> {
        let number = value.round();
        if (value - number).abs() > 1e-4 || !(1.0..=HIGHEST as f64).contains(&number) {
            return refuse(Code::PN014, format!("there is no parameter #{value}"), "parameters are #1 to #9999");
        }
        Ok(number as usize)
    }

    /// The value of a numbered parameter.
    ///
    /// # Errors
    /// On a Fanuc, the program has not set the parameter, so its value is known only at the control.
    pub fn get(&self, number: usize) -> Done<f64> {
        if self.control.is_linuxcnc() && (5420..5426).contains(&number) {
            return Ok(self.position[number - 5420]);
        }
        match self.numbered.get(number).copied().flatten() {
            Some(value) => Ok(value),
            // LinuxCNC keeps the values of system parameters between runs; only the parameters of a program begin at 0
            None if self.control.is_linuxcnc() && number < 5000 => Ok(0.0),
            // these hold tool positions, alarms and offsets, which the program does not set
            None if number >= 1000 => {
                let help = "write the value as a number, or run the program without this block";
                refuse(Code::PN016, format!("#{number} is a variable of the control, known only at the machine"), help)
            }
            None => {
                let help = format!("set the variable in the program before this block: #{number}=0");
                refuse(Code::PN016, format!("#{number} is not set in the program"), help)
            }
        }
    }

    /// The value of a named parameter.
    ///
    /// # Errors
    /// The parameter has no value.
    pub fn named(&self, name: &str) -> Done<f64> {
        let found =
            if name.starts_with('_') { self.global.get(name) } else { self.local.last().and_then(|l| l.get(name)) };
        match found {
            Some(value) => Ok(*value),
            None if name.starts_with("_hal[") || name.starts_with("_ini[") => {
                let help = "write the value as a number, or run the program without this block";
                refuse(Code::PN016, format!("#<{name}> is a value of the machine"), help)
            }
            None => {
                let help = format!("set the parameter before this block: #<{name}>=0");
                // names with `_` may be system parameters of LinuxCNC, which are not simulated; LinuxCNC refuses other
                // names without a value
                let code = if name.starts_with('_') { Code::PN016 } else { Code::PN014 };
                refuse(code, format!("#<{name}> is not set in the program"), help)
            }
        }
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// The parameter belongs to the control and is not simulated.
    pub fn set(&mut self, target: Target, value: f64) -> Done {
        if !self.control.is_linuxcnc() && matches!(target, Target::Number(34..=99 | 200..=499 | 1000..)) {
            let help = "variables of a program are #1 to #33, #100 to #199 and #500 to #999";
            return refuse(Code::PN016, "a variable of the control itself is not simulated", help);
        }
        if self.control.is_linuxcnc() && matches!(target, Target::Number(5000..)) {
            let help = "set offsets with G10, G52 or G92; a program can set #1 to #4999";
            return refuse(Code::PN016, "a parameter of the control itself is not simulated", help);
        }
        match target {
            Target::Number(number) => self.numbered[number] = Some(value),
            Target::Name(name) if name.starts_with('_') => _ = self.global.insert(name, value),
            Target::Name(name) => {
                if let Some(local) = self.local.last_mut() {
                    local.insert(name, value);
                }
            }
        }
        Ok(())
    }

    /// Sets the value that a subprogram returns.
    pub fn returns(&mut self, value: Option<f64>) {
        let values = [value.unwrap_or(0.0), f64::from(u8::from(value.is_some()))];
        self.global.extend(RETURNED.iter().zip(values).map(|(name, value)| ((*name).to_owned(), value)));
    }

    /// Begins a subprogram: `#1` to `#30` get the values of the subprogram's arguments.
    pub fn enter(&mut self, arguments: &[f64]) {
        let mut kept = [None; 30];
        for (i, old) in kept.iter_mut().enumerate() {
            *old = self.numbered[i + 1];
            self.numbered[i + 1] = arguments.get(i).copied();
        }
        self.returns(None);
        self.kept.push(kept);
        self.local.push(HashMap::new());
    }

    /// Ends a subprogram: the caller gets its local parameters back.
    pub fn leave(&mut self) {
        if let Some(kept) = self.kept.pop() {
            self.numbered[1..=30].copy_from_slice(&kept);
            self.local.pop();
        }
    }
}
