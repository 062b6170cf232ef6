//! The values that were printed last: one register for each letter, and one for each modal group of codes.

use crate::control::{Code, GROUPS, Group};

/// Last printed value of a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
struct Register {
    units: i64,
    /// Number of decimals of `units`, plus one; 0: the value is unknown. Values in two formats of one letter (`Rename`)
    /// are therefore never equal by accident.
    scale: u8,
}

/// All registers.
#[derive(Clone, Debug)]
pub struct Registers {
    letters: [Register; 128],
    /// Last printed code of each modal group.
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

    /// Forgets the values of all letters, but keeps the known codes.
    pub fn forget_letters(&mut self) {
        self.letters = [Register::default(); 128];
    }

    /// Whether this is the last printed value of the letter.
    #[inline]
    pub fn holds(&self, letter: u8, units: i64, decimals: u8) -> bool {
        self.letters[usize::from(letter & 0x7f)] == Register { units, scale: decimals + 1 }
    }

    /// The last printed value of the letter, with its decimals.
    pub fn get(&self, letter: u8) -> Option<(i64, u8)> {
        let register = self.letters[usize::from(letter & 0x7f)];
        (register.scale != 0).then(|| (register.units, register.scale - 1))
    }

    /// Stores a printed value.
    #[inline]
    pub fn set(&mut self, letter: u8, units: i64, decimals: u8) {
        self.letters[usize::from(letter & 0x7f)] = Register { units, scale: decimals + 1 };
    }

    /// Forgets the value of a letter.
    #[inline]
    pub fn forget(&mut self, letter: u8) {
        self.letters[usize::from(letter & 0x7f)] = Register::default();
    }

    /// The last printed code of a group.
    #[inline]
    pub fn group(&self, group: Group) -> Option<Code> {
        self.groups[group as usize]
    }

    /// Whether this code is the last printed code of its group.
    #[inline]
    pub fn holds_code(&self, code: Code) -> bool {
        self.groups.contains(&Some(code))
    }

    /// Stores a printed code.
    #[inline]
    pub fn set_group(&mut self, group: Group, code: Code) {
        self.groups[group as usize] = Some(code);
    }

    /// Forgets the code of a group.
    #[inline]
    pub fn forget_group(&mut self, group: Group) {
        self.groups[group as usize] = None;
    }
}
