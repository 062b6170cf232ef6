//! The modal state after each block. Only the changes from block to block are stored.

use crate::nc::{Action, Modal, Position, Rotation};
use crate::toolpath::Coolant;

/// The values of the modal state of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
#[allow(missing_docs)]
pub enum Register {
    Motion,
    Plane,
    Distance,
    Units,
    Work,
    Back,
    Compensation,
    Length,
    FeedMode,
    Tool,
    H,
    D,
    Speed,
    Spindle,
    Coolant,
    Feed,
    Cycle,
    R,
    Depth,
    Dwell,
    Peck,
    A,
    B,
    C,
    U,
    V,
}

/// The number of registers.
const COUNT: usize = Register::V as usize + 1;

/// A register that gets a new value in a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Line of the program, from 1; 0 for values at the start.
    pub line: u32,
    /// The register.
    pub register: Register,
    /// The value of the register: the number of a code, or another number. NaN: the register has no value. For the
    /// spindle and the coolant, the value is the number of an M code.
    pub value: f64,
}

/// The values of the registers between two blocks.
#[derive(Clone, Debug)]
pub(super) struct Registers {
    held: [f64; COUNT],
    modal: Option<Modal>,
}

impl Registers {
    /// All registers are unknown.
    pub fn new() -> Registers {
        Registers { held: [f64::NAN; COUNT], modal: None }
    }

    fn hold(&mut self, line: u32, register: Register, value: f64, changes: &mut Vec<Change>) {
        let held = &mut self.held[register as usize];
        if held.to_bits() != value.to_bits() && !(held.is_nan() && value.is_nan()) {
            *held = value;
            changes.push(Change { line, register, value });
        }
    }

    /// Updates the registers for axes other than X Y Z: A B C in degrees after the first turn of the axis, U V of a
    /// wire EDM machine in the program's units. Each bit of `machine` marks an axis whose position is unknown.
    pub fn axes(&mut self, line: u32, letters: &[u8; 6], position: &Position, machine: u8, changes: &mut Vec<Change>) {
        for (axis, letter) in letters.iter().enumerate().skip(2) {
            let register = match letter {
                b'A' => Register::A,
                b'B' => Register::B,
                b'C' => Register::C,
                b'U' => Register::U,
                b'V' => Register::V,
                _ => continue,
            };
            let value = if machine & 1 << axis == 0 { position[axis] } else { f64::NAN };
            let turns = matches!(register, Register::A | Register::B | Register::C);
            if !(turns && value == 0.0 && self.held[register as usize].is_nan()) {
                self.hold(line, register, value, changes);
            }
        }
    }

    /// Updates the registers after an action.
    pub fn act(&mut self, line: u32, action: &Action, changes: &mut Vec<Change>) {
        let mut hold = |register, value| self.hold(line, register, value, changes);
        match action {
            Action::Tool(tool) => hold(Register::Tool, *tool),
            Action::Work(work) => hold(Register::Work, *work),
            Action::Length(register) => hold(Register::H, register.map_or(f64::NAN, f64::abs)),
            Action::Coolant(Coolant::OFF) => hold(Register::Coolant, 9.0),
            Action::Coolant(Coolant::MIST) => hold(Register::Coolant, 7.0),
            Action::Coolant(_) => hold(Register::Coolant, 8.0),
            Action::Hole(hole) => {
                hold(Register::R, hole.r);
                hold(Register::Depth, hole.bottom);
                hold(Register::Dwell, some(hole.dwell));
                hold(Register::Peck, some(hole.peck));
            }
            _ => {}
        }
    }

    /// Updates the registers with the modal state after a block.
    pub fn after(&mut self, line: u32, modal: Modal, changes: &mut Vec<Change>) {
        // most blocks contain only moves and don't change the modal state
        if self.modal.replace(modal) == Some(modal) {
            return;
        }
        let code = |code: u16| f64::from(code) / 10.0;
        let rows = [
            (Register::Motion, modal.motion.map_or(f64::NAN, |code| code.value())),
            (Register::Plane, code(modal.plane)),
            (Register::Distance, code(modal.distance)),
            (Register::Units, code(modal.units)),
            (Register::Back, code(modal.back)),
            (Register::Compensation, code(modal.compensation)),
            (Register::Length, if modal.length { 43.0 } else { 49.0 }),
            (Register::FeedMode, code(modal.feed_mode)),
            (Register::D, modal.diameter.unwrap_or(f64::NAN)),
            (Register::Speed, some(modal.speed)),
            (
                Register::Spindle,
                match modal.spindle {
                    Rotation::Cw => 3.0,
                    Rotation::Ccw => 4.0,
                    Rotation::Stop => 5.0,
                },
            ),
            (Register::Feed, some(modal.feed)),
            (Register::Cycle, modal.cycle.map_or(f64::NAN, |code| code.value())),
        ];
        rows.into_iter().for_each(|(register, value)| self.hold(line, register, value, changes));
        if modal.cycle.is_none() {
            let of_cycle = [Register::R, Register::Depth, Register::Dwell, Register::Peck];
            of_cycle.into_iter().for_each(|register| self.hold(line, register, f64::NAN, changes));
        }
    }
}

/// Converts a value of 0 to NaN, which means that the register has no value.
fn some(value: f64) -> f64 {
    if value == 0.0 { f64::NAN } else { value }
}
