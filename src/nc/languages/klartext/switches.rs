//! M codes in a block.

use super::super::cursor::Cursor;
use super::block::Words;
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::fault::{Done, Fault};

impl Words<'_> {
    /// Reads an M code such as `M3`. Returns whether the M code calls the cycle.
    pub(super) fn switch(&mut self, cursor: &mut Cursor<'_>) -> Done<bool> {
        let begin = cursor.at();
        *cursor = cursor.from(begin + 1);
        let Some(code) = cursor.unsigned().filter(|code| code.fract() == 0.0) else {
            return Err(cursor.from(begin).unreadable());
        };
        match code as u16 {
            99 => {
                self.own.calls_always = false;
                return Ok(true);
            }
            89 => {
                self.own.calls_always = true;
                return Ok(true);
            }
            91 | 92 => {
                self.code(Meaning::Machine)?;
                // the machine builder defines the zero of M92
                self.block.hidden = code == 92.0;
            }
            120 => {
                self.block.m_word(code, begin, self.state.settings.control)?;
                // the number of blocks that the control looks ahead
                if cursor.takes(b"LA") || cursor.takes(b"la") {
                    self.number(cursor)?;
                }
            }
            _ => self.block.m_word(code, begin, self.state.settings.control)?,
        }
        Ok(false)
    }

    /// Runs `M140 MB MAX`, a move to the end of the travel. `MB50`, a distance along the tool, is refused.
    pub(super) fn back_along_tool(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let begin = cursor.at();
        if !cursor.takes_word("MB") || !cursor.takes_word("MAX") {
            let help = "write M140 MB MAX, or the height with L";
            return Err(Fault::at(Code::PN016, begin, "M140 is supported only with MB MAX", help));
        }
        self.code(Meaning::Machine)?;
        self.block.word(b'Z', 0.0, false, begin, self.state.settings.control)?;
        self.block.absolute |= 0b100;
        Ok(())
    }
}
