//! `#` parameters.

use std::collections::HashMap;

use super::fault::{Done, refuse};
use crate::control::Control;
use crate::diag::Code;

/// Highest number of a parameter.
const HIGHEST: usize = 9999;

/// Parameters of a program, by number and by name.
#[derive(Clone, Debug)]
pub struct Parameters {
    control: &'static Control,
    numbered: Vec<Option<f64>>,
    global: HashMap<String, f64>,
    /// Named parameters of the main program and of each subprogram that runs.
    local: Vec<HashMap<String, f64>>,
    /// Values of `#1` to `#30` that come back when a subprogram ends.
    kept: Vec<[Option<f64>; 30]>,
    /// Where the tool is, for `#5420` and on.
    pub position: [f64; 6],
}

/// What a setting sets.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// `#1=`.
    Number(usize),
    /// `#<name>=`.
    Name(String),
}

impl Parameters {
    /// Parameters of which none has a value yet.
    pub fn new(control: &'static Control) -> Parameters {
        Parameters {
            control,
            numbered: vec![None; HIGHEST + 1],
            global: HashMap::new(),
            local: vec![HashMap::new()],
            kept: Vec::new(),
            position: [0.0; 6],
        }
    }

    /// The number of a parameter from a value.
    ///
    /// # Errors
    /// It is none.
    pub fn number(value: f64) -> Done<usize> {
        let number = value.round();
        if (value - number).abs() > 1e-4 || !(1.0..=HIGHEST as f64).contains(&number) {
            return refuse(Code::PN014, format!("there is no parameter #{value}"), "parameters are #1 to #9999");
        }
        Ok(number as usize)
    }

    /// The value of a parameter by number.
    ///
    /// # Errors
    /// A Fanuc parameter that nothing has set: only the control knows its value.
    pub fn get(&self, number: usize) -> Done<f64> {
        if self.control.is_linuxcnc() && (5420..5426).contains(&number) {
            return Ok(self.position[number - 5420]);
        }
        match self.numbered.get(number).copied().flatten() {
            Some(value) => Ok(value),
            // the interpreter keeps system values from run to run: only those that it always has are known
            None if self.control.is_linuxcnc() && number < 5000 => Ok(0.0),
            // where the tool is, alarms, offsets: they are not the program's to set
            None if number >= 1000 => {
                let help = "write the number that it would have, or run the program without this block";
                refuse(Code::PN016, format!("#{number} is a variable of the control, known at the machine alone"), help)
            }
            None => {
                let help = format!("set it in the program before this block: #{number}=0");
                refuse(Code::PN016, format!("nothing in the program sets #{number}"), help)
            }
        }
    }

    /// The value of a parameter by name.
    ///
    /// # Errors
    /// Nothing has set it.
    pub fn named(&self, name: &str) -> Done<f64> {
        let found =
            if name.starts_with('_') { self.global.get(name) } else { self.local.last().and_then(|l| l.get(name)) };
        match found {
            Some(value) => Ok(*value),
            None if name.starts_with("_hal[") || name.starts_with("_ini[") => {
                let help = "write the number that it would have, or run the program without this block";
                refuse(Code::PN016, format!("#<{name}> is a value of the machine"), help)
            }
            None => {
                let help = format!("set it before this block: #<{name}>=0");
                // LinuxCNC has some of its own, and refuses any other
                let code = if name.starts_with('_') { Code::PN016 } else { Code::PN014 };
                refuse(code, format!("nothing in the program sets #<{name}>"), help)
            }
        }
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// It is one of LinuxCNC's own, which are not simulated.
    pub fn set(&mut self, target: Target, value: f64) -> Done {
        if !self.control.is_linuxcnc() && matches!(target, Target::Number(34..=99 | 200..=499 | 1000..)) {
            let help = "variables of a program are #1 to #33, #100 to #199 and #500 to #999";
            return refuse(Code::PN016, "a variable of the control itself is not simulated", help);
        }
        if self.control.is_linuxcnc() && matches!(target, Target::Number(5000..)) {
            let help = "set offsets by G10, G52 and G92; #1 to #4999 are the program's";
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

    /// A subprogram begins: `#1` to `#30` are its arguments.
    pub fn enter(&mut self, arguments: &[f64]) {
        let mut kept = [None; 30];
        for (i, old) in kept.iter_mut().enumerate() {
            *old = self.numbered[i + 1];
            self.numbered[i + 1] = arguments.get(i).copied();
        }
        self.kept.push(kept);
        self.local.push(HashMap::new());
    }

    /// A subprogram ends: the caller's local parameters come back.
    pub fn leave(&mut self) {
        if let Some(kept) = self.kept.pop() {
            self.numbered[1..=30].copy_from_slice(&kept);
            self.local.pop();
        }
    }
}
