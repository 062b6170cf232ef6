//! The T word of a lathe.

use super::fault::{Done, fault};
use super::shape::Shape;
use crate::diag::Code;
use crate::lang::VarId;
use crate::toolpath::Tool;

/// `[comp]`, the T word of a lathe: station and offset register in two digits each. A job's number that holds both
/// stays as it is.
pub fn turret_word(tool: &Tool, shape: &Shape) -> Done<f64> {
    const STATIONS: f64 = 100.0;
    let whole = tool.number >= STATIONS;
    let register = match tool.length_offset {
        None if whole => return Ok(tool.number),
        own => own.unwrap_or(tool.number + shape.program.settings.lcomp),
    };
    let other = whole && register != tool.number % STATIONS && register != tool.number;
    if shape.program.printed.has(VarId::Comp) && (other || !whole && register >= STATIONS) {
        let message =
            format!("tool {} with the offset register {register} has no T word of two and two digits", tool.number);
        let help = "give it a register below 100, and a number from 100 on only if it holds the register";
        return fault(Code::PR039, message, help);
    }
    Ok(if whole { tool.number } else { tool.number * STATIONS + register })
}
