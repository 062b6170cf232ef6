//! Variables that the job or the caller sets.

use crate::lang::VarId;
use crate::render::fault::Done;
use crate::render::printer::Printer;
use crate::render::shape::Shape;
use crate::render::want::{Want, in_program_units, settable};

/// Gives a variable a value by its name, in the job's units.
pub fn set_named(name: &str, value: f64, shape: &Shape, want: &mut Want, out: &mut Printer) -> Done {
    let var = settable(name)?;
    set_variable(var, in_program_units(var, value, shape), want, out);
    Ok(())
}

/// A variable, in program units; the number of the next block is the printer's.
pub fn set_variable(var: VarId, value: f64, want: &mut Want, out: &mut Printer) {
    match var {
        VarId::Block => out.set_number(value as i64),
        _ => want.set(var, value),
    }
    want.changed = true;
}
