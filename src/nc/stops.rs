//! What comes when all else of a block is done: stops, the end, subprograms.

use super::action::{Action, Cooling};
use super::block::Block;
use super::codes::bit;
use super::fault::{Done, refuse};
use super::out::{Next, Out};
use super::state::State;
use crate::diag::Code;
use crate::toolpath::StopKind;

impl State {
    /// Stops and subprograms come last.
    pub(super) fn after(&mut self, block: &Block, out: &mut Out<'_>) -> Done<Next> {
        let mut next = Next::On;
        for &code in block.m() {
            match code {
                5 if !self.control.is_linuxcnc() => self.turn_spindle(5, out),
                9 if !self.control.is_linuxcnc() => out.push(Action::Coolant(Cooling::Off)),
                0 | 60 => out.push(Action::Stop(StopKind::Program)),
                1 => out.push(Action::Stop(StopKind::Optional)),
                2 | 30 => {
                    out.push(Action::End);
                    next = Next::End;
                }
                97 if !self.control.is_linuxcnc() => {
                    let help = "write the subprogram with an O number, and M98";
                    return refuse(Code::PN016, "M97, a call of blocks by their number, is not simulated", help);
                }
                98 => next = self.call(block)?,
                99 if block.has(bit(b'P')) => {
                    let help = "return to the block behind the call";
                    return refuse(Code::PN016, "M99 P, a jump, is not simulated", help);
                }
                99 => next = Next::Return,
                _ => {}
            }
        }
        Ok(next)
    }

    /// M98 P1000 L3, or P31000 as older controls have it.
    fn call(&self, block: &Block) -> Done<Next> {
        let Some(p) = block.get(b'P').filter(|p| p.fract() == 0.0 && *p >= 1.0) else {
            return refuse(Code::PN007, "M98 without the number of its subprogram", "write P and the number");
        };
        let times = block.get(b'L').unwrap_or(1.0);
        if times.fract() != 0.0 || !(0.0..=9999.0).contains(&times) {
            return refuse(Code::PN018, format!("L{times} is no number of calls"), "write L1 to L9999");
        }
        if p > 9999.0 && block.get(b'L').is_none() && !self.control.is_linuxcnc() {
            return Ok(Next::Call(p % 10_000.0, (p / 10_000.0) as u32));
        }
        Ok(Next::Call(p, times as u32))
    }
}
