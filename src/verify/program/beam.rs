//! Checks that a torch or laser is on in cuts and off in rapids, and that no rapid moves across at the height of the cuts.

use super::Program;
use crate::control::Control;
use crate::diag::Code;
use crate::lang::Beam;
use crate::nc::{Position, Rotation};

/// The state of the torch or laser in a program, and the heights of cuts and rapids so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Switched {
    beam: Beam,
    /// Whether the control turns a laser off in rapids, as Grbl does in its laser mode.
    is_off_in_rapids: bool,
    /// Height of the last cut, if the height is known.
    cut: Option<f64>,
    /// Whether, since the last cut, a rapid has gone home or higher than this cut.
    is_up: bool,
    /// Whether at least one rapid across was higher than the cut before the rapid.
    lifts: bool,
    /// Line of the first rapid across that was not higher than the cut before the rapid.
    low: Option<u64>,
}

impl Switched {
    pub(super) fn new(beam: Beam, control: &Control) -> Switched {
        let is_off_in_rapids = beam == Beam::Laser && control.traits().beam_off_in_rapids;
        Switched { beam, is_off_in_rapids, cut: None, is_up: false, lifts: false, low: None }
    }
}

impl Program<'_> {
    /// Whether the torch or laser is on; `None`: the machine has no torch and no laser.
    pub(super) fn beam_is_on(&self) -> Option<bool> {
        self.beam.map(|switched| self.is_on(switched.beam))
    }

    /// Whether the torch or laser is on. A laser without power is off.
    fn is_on(&self, beam: Beam) -> bool {
        self.state.rotation != Some(Rotation::Stop) && (beam == Beam::Torch || self.state.speed != Some(0.0))
    }

    /// Checks a cut to the position `to`, which is in the program's units.
    pub(super) fn beam_cuts(&mut self, to: &Position, line: u64) {
        let Some(switched) = &mut self.beam else { return };
        let height_is_known = self.simulator.state().at_machine() & 0b100 == 0;
        (switched.cut, switched.is_up) = (height_is_known.then_some(to[2]), false);
        let beam = switched.beam;
        // M4 turns the other way, which does not light a torch
        let is_lit = beam != Beam::Torch || self.state.rotation != Some(Rotation::Ccw);
        if !self.is_on(beam) || !is_lit {
            let message = format!("the {} is off in this cut", beam.name());
            let help = "print `M3` in BeginCut, and for a laser the power with S";
            self.hazard(Code::PV026, line, &message, help);
        }
    }

    /// Checks a rapid to the position `to`, in the program's units. `across`: along X or Y. `machine`: the axes that go home.
    pub(super) fn beam_goes(&mut self, to: &Position, across: bool, machine: u8, line: u64) {
        let Some(switched) = &mut self.beam else { return };
        switched.is_up |= machine & 0b100 != 0 || switched.cut.is_some_and(|cut| to[2] > cut);
        if !across {
            return;
        }
        match switched.cut {
            Some(_) if switched.is_up => switched.lifts = true,
            Some(_) => _ = switched.low.get_or_insert(line),
            None => {}
        }
        let (beam, is_off) = (switched.beam, switched.is_off_in_rapids);
        // if the form lifts the tool in one rapid, it must lift it in all of them
        if let Some(low) = switched.low.take_if(|_| switched.lifts) {
            let message = format!(
                "the {} moves across at cutting height, although the form lifts it at other moves",
                beam.name()
            );
            self.hazard(Code::PV028, low, &message, "lift the tool in EndCut, before the rapid");
        }
        if !is_off && self.is_on(beam) {
            let message = format!("the {} is on in a rapid", beam.name());
            self.hazard(Code::PV027, line, &message, "print `M5` in EndCut, or `S0` for a laser");
        }
    }
}
