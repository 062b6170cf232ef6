//! Variables and properties that the job or the caller sets.

use crate::diag::Code;
use crate::lang::VarId;
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::shape::Shape;
use crate::render::want::{Want, in_program_units, settable};
use crate::toolpath::Given;

/// Sets a variable or a property by its name. Lengths are in the job's units.
pub fn set_named(name: &str, given: &Given, shape: &Shape, want: &mut Want, out: &mut Printer) -> Done {
    let settings = &shape.program.settings;
    let asked = name.trim_matches(['[', ']']);
    if let Some(row) = settings.properties.iter().position(|property| property.name.eq_ignore_ascii_case(asked)) {
        want.changed = true;
        return want.properties.set(row, &settings.properties[row], given, shape.scale);
    }
    let var = settable(name, settings)?;
    match given {
        Given::Number(value) => set_variable(var, in_program_units(var, *value, shape), want, out),
        Given::Text(text) => {
            let message = format!("[{}] takes a number, but the job gives the text `{text}`", var.name());
            return fault(
                Code::PR016,
                message,
                "write the number without quotes; only a `Property` of the form can be a text",
            );
        }
    }
    Ok(())
}

/// Sets a variable, in program units. `[block]` is stored in the printer.
pub fn set_variable(var: VarId, value: f64, want: &mut Want, out: &mut Printer) {
    match var {
        VarId::Block => out.set_number(value as i64),
        _ => want.set(var, value),
    }
    want.changed = true;
}
