//! The T word of a lathe.

use super::fault::{Done, fault};
use super::shape::Shape;
use crate::diag::Code;
use crate::lang::VarId;
use crate::toolpath::Tool;

/// `[comp]`, the T word of a lathe: two digits for the station and two for the offset register. A tool number that
/// already contains station and register is unchanged.
pub fn turret_word(tool: &Tool, shape: &Shape) -> Done<f64> {
    const STATIONS: f64 = 100.0;
    let whole = tool.number >= STATIONS;
    let register = match tool.length_offset {
        None if whole => return Ok(tool.number),
        own => own.unwrap_or(tool.number + shape.program.settings.lcomp),
    };
    let other = whole && register != tool.number % STATIONS && register != tool.number;
    if shape.program.printed.has(VarId::Comp) && (other || !whole && register >= STATIONS) {
        let message = format!(
            "tool {} with the offset register {register} can't be printed as a T word of two and two digits",
            tool.number
        );
        let help = "use a register below 100; use a tool number of 100 or more only if it includes the register";
        return fault(Code::PR039, message, help);
    }
    Ok(if whole { tool.number } else { tool.number * STATIONS + register })
}
