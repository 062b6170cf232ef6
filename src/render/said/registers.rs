//! What was last printed: a register for each letter, one for each modal group of codes.

use crate::control::{Code, GROUPS, Group};

/// What a letter last printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
struct Register {
    units: i64,
    /// Decimals of `units` plus one; 0: unknown. Two formats of one letter (`Rename`) never compare equal by chance.
    scale: u8,
}

/// All registers.
#[derive(Clone, Debug)]
pub struct Registers {
    letters: [Register; 128],
    /// The code that each modal group printed last.
    groups: [Option<Code>; GROUPS],
}

impl Default for Registers {
    fn default() -> Self {
        Registers { letters: [Register::default(); 128], groups: [None; GROUPS] }
    }
}

impl Registers {
    /// Forgets all letters.
    pub fn forget_all(&mut self) {
        *self = Registers::default();
    }

    /// No letter is known; codes stay.
    pub fn forget_letters(&mut self) {
        self.letters = [Register::default(); 128];
    }

    /// Is this what the letter last printed?
    #[inline]
    pub fn holds(&self, letter: u8, units: i64, decimals: u8) -> bool {
        self.letters[usize::from(letter & 0x7f)] == Register { units, scale: decimals + 1 }
    }

    /// What the letter last printed, with its decimals.
    pub fn get(&self, letter: u8) -> Option<(i64, u8)> {
        let register = self.letters[usize::from(letter & 0x7f)];
        (register.scale != 0).then(|| (register.units, register.scale - 1))
    }

    /// A letter printed this value.
    #[inline]
    pub fn set(&mut self, letter: u8, units: i64, decimals: u8) {
        self.letters[usize::from(letter & 0x7f)] = Register { units, scale: decimals + 1 };
    }

    /// The letter's value is unknown.
    #[inline]
    pub fn forget(&mut self, letter: u8) {
        self.letters[usize::from(letter & 0x7f)] = Register::default();
    }

    /// The code that a group last printed.
    #[inline]
    pub fn group(&self, group: Group) -> Option<Code> {
        self.groups[group as usize]
    }

    /// Is this code what its group last printed?
    #[inline]
    pub fn holds_code(&self, code: Code) -> bool {
        self.groups.contains(&Some(code))
    }

    /// A group printed this code.
    #[inline]
    pub fn set_group(&mut self, group: Group, code: Code) {
        self.groups[group as usize] = Some(code);
    }

    /// The group's code is unknown.
    #[inline]
    pub fn forget_group(&mut self, group: Group) {
        self.groups[group as usize] = None;
    }
}
