//! The codes that are run last in a block: stops, the end of the program, subprogram calls and returns.

use super::action::{Action, Rotation};
use super::block::Block;
use super::codes::{Group, bit};
use super::fault::{Done, refuse};
use super::out::{Next, Out};
use super::state::State;
use crate::control::Meaning;
use crate::diag::Code;
use crate::toolpath::{Coolant, StopKind};

/// Whether a code of this meaning takes effect after everything else in its block.
pub(super) fn runs_last(meaning: Meaning) -> bool {
    use Meaning as M;
    stops(meaning) || matches!(meaning, M::End | M::Call | M::Return)
}

/// Whether a code of this meaning stops the spindle, the coolant or the program.
pub(super) fn stops(meaning: Meaning) -> bool {
    meaning.is_stop() || matches!(meaning, Meaning::SpindleOff | Meaning::CoolantOff)
}

impl State {
    /// Runs stops and subprogram calls, the last codes of a block.
    pub(super) fn after(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        let mut next = Next::On;
        for (code, row) in block.m() {
            match row.meaning {
                Meaning::SpindleOff if !self.control.is_linuxcnc() => self.turn_spindle(Rotation::Stop, out),
                Meaning::CoolantOff if !self.control.is_linuxcnc() => out.push(Action::Coolant(Coolant::OFF)),
                Meaning::StopProgram => out.push(Action::Stop(StopKind::Program)),
                // the program stops, and the change of the pallet is left out
                Meaning::Pallet => {
                    out.push(Action::Stop(StopKind::Program));
                    out.push(Action::LeftOut(row.code, row.meaning));
                }
                Meaning::StopOptional => out.push(Action::Stop(StopKind::Optional)),
                Meaning::End => {
                    out.push(Action::End);
                    next = Next::End;
                }
                Meaning::Call => next = self.call(code, block)?,
                Meaning::Return if block.has(bit(b'P') | bit(b'L')) => {
                    let help = "return to the block after the call";
                    let message = match block.has(bit(b'P')) {
                        true => "M99 P, a jump, is not simulated",
                        false => "M99 L, which changes the number of calls that are left, is not simulated",
                    };
                    return refuse(Code::PN016, message, help);
                }
                Meaning::Return => next = Next::Return,
                _ => {}
            }
        }
        Ok(next)
    }

    /// Calls a subprogram: M98 P1000 L3, or M98 P31000 as on older controls.
    fn call(&self, code: u16, block: &Block) -> Done<Next> {
        let Some(p) = block.get(b'P').filter(|p| p.fract() == 0.0 && *p >= 1.0) else {
            let message = format!("M{code} without the number of its subprogram");
            return refuse(Code::PN007, message, "write P and the number");
        };
        let times = block.get(b'L').unwrap_or(1.0);
        if times.fract() != 0.0 || !(0.0..=9999.0).contains(&times) {
            return refuse(Code::PN018, format!("L{times} is not a number of calls"), "write L1 to L9999");
        }
        if block.has(bit(b'H')) && block.row(Group::Length).is_none() {
            let message = format!("M{code} with H: on some controls, H is the block at which the subprogram begins");
            return refuse(Code::PN016, message, "write a tool length offset in a block of its own");
        }
        if p > 9999.0 && block.get(b'L').is_none() {
            match self.control.traits().repeats_in_p {
                Some(true) => return Ok(Next::Call(p % 10_000.0, (p / 10_000.0) as u32)),
                Some(false) => {}
                None => {
                    let name = self.control.name();
                    let message = format!("P{p} may be a program, or a program and its number of calls, on {name}");
                    let help = "write P below 10000, and the number of calls as L";
                    return refuse(Code::PN016, message, help);
                }
            }
        }
        Ok(Next::Call(p, times as u32))
    }
}
