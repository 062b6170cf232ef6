//! Values of the form's properties. The first existing value applies, in this order: caller, operation, job, shop, form.

use super::fault::{Done, fault};
use crate::diag::Code;
use crate::lang::UnitChoice;
use crate::sema::{Property, PropertyKind, PropertyValue, Settings};
use crate::toolpath::Given;

/// A value of a property.
#[derive(Clone, Debug, PartialEq)]
struct Held {
    value: PropertyValue,
    /// Whether a length is in the form's units; otherwise it is in the program's units.
    in_forms_units: bool,
}

/// The values of the form's properties, by row.
#[derive(Clone, Debug, Default)]
pub struct Properties {
    now: Vec<Held>,
    /// Values for operations that set no values themselves.
    of_job: Vec<Held>,
    /// Whether the caller set the value. No other value overrides a value from the caller.
    fixed: Vec<bool>,
    /// Number of properties that are fields of tools. The fields of tools are the first properties.
    of_tool: usize,
}

impl Properties {
    /// Values from the form, the shop and the caller. Values from the caller override all other values.
    pub fn new(settings: &Settings, shop: &[(u16, PropertyValue)], caller: &[(u16, PropertyValue)]) -> Properties {
        let own =
            settings.properties.iter().map(|property| Held { value: property.default.clone(), in_forms_units: true });
        let mut now: Vec<_> = own.collect();
        let mut fixed = vec![false; now.len()];
        // the own lengths of a form for both units are inches; a value from outside is in the program's units
        let in_forms_units = settings.units != UnitChoice::Both;
        for (row, value) in shop.iter().chain(caller) {
            now[usize::from(*row)] = Held { value: value.clone(), in_forms_units };
        }
        for (row, _) in caller {
            fixed[usize::from(*row)] = true;
        }
        let of_tool = settings.properties.iter().take_while(|property| property.of_tool().is_some()).count();
        Properties { of_job: now.clone(), now, fixed, of_tool }
    }

    /// A value.
    pub fn get(&self, row: u16) -> &PropertyValue {
        &self.now[usize::from(row)].value
    }

    /// Whether the length in this row is in the form's units. Otherwise the length is in the program's units.
    pub fn is_in_forms_units(&self, row: u16) -> bool {
        self.now[usize::from(row)].in_forms_units
    }

    /// Saves the current values as the values of the job.
    pub fn keep(&mut self) {
        self.of_job.clone_from(&self.now);
    }

    /// Begins an operation: restores the values of the job.
    pub fn operation(&mut self) {
        let own = self.of_tool..;
        if self.now[own.clone()] != self.of_job[own.clone()] {
            self.now[own.clone()].clone_from_slice(&self.of_job[own]);
        }
    }

    /// Sets the fields of a tool. A field that the tool lacks is empty.
    pub fn tool(&mut self, settings: &Settings, data: &[(String, Given)]) {
        for row in (0..self.of_tool).filter(|row| !self.fixed[*row]) {
            let name = settings.properties[row].of_tool().unwrap_or_default();
            let given = data.iter().find(|(own, _)| own.eq_ignore_ascii_case(name));
            let text = given.map_or_else(String::new, |(_, given)| match given {
                Given::Number(number) => number.to_string(),
                Given::Text(text) => text.trim().to_owned(),
            });
            self.now[row] = Held { value: PropertyValue::Text(text), in_forms_units: false };
        }
    }

    /// Sets a value from the job. `scale`: factor from the job's lengths to the program's lengths.
    pub fn set(&mut self, row: usize, property: &Property, given: &Given, scale: f64) -> Done {
        let value = match given {
            Given::Number(number) => property.kind.read(&number.to_string()),
            Given::Text(text) => property.kind.read(text),
        };
        let value = value.map(|value| match (value, &property.kind) {
            (PropertyValue::Number(length), PropertyKind::Length) => PropertyValue::Number(length * scale),
            (value, _) => value,
        });
        match value {
            Ok(value) if !self.fixed[row] => self.now[row] = Held { value, in_forms_units: false },
            Ok(_) => {}
            Err(why) => {
                let message = format!("the property {}: {why}", property.name);
                return fault(Code::PR053, message, format!("it takes {}", property.kind.takes()));
            }
        }
        Ok(())
    }
}
