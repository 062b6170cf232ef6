//! Checks of blocks whose effect depends on settings of the machine: feeds after G70 and G71, and increments after a
//! change of frame or tool.

use super::ways::Siemens;
use crate::control::{Basic, Meaning, Row};
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::Group;
use crate::nc::fault::{Done, refuse};
use crate::nc::state::State;
use crate::toolpath::Units;

impl Siemens {
    /// Records the units that a code sets. G70 and G71 do not change the unit of feeds: feeds are in the unit of the
    /// machine. G700 and G710 change both.
    pub(super) fn units(&mut self, row: &Row) -> Done {
        let units = if row.meaning == Meaning::Inch { Units::Inch } else { Units::Mm };
        let before = self.units.replace(units);
        self.lengths_only = row.code.tenths < 7000;
        if self.lengths_only && before.is_some_and(|before| before != units) {
            let message = "G70 and G71 in one program: the unit of feeds depends on the machine";
            return refuse(Code::PN016, message, "write G700 or G710: these change the unit of feeds too");
        }
        Ok(())
    }

    /// Refuses a feed after G70 or G71, unless the basic units of the machine are known.
    pub(super) fn check_feed(&self, has_feed: bool, state: &State) -> Done {
        let basic = match state.control.traits().basic {
            Some(Basic::Inch) => Some(Units::Inch),
            Some(Basic::Mm) => Some(Units::Mm),
            None if state.settings.places_unknown => None,
            None => Some(state.settings.units),
        };
        if !self.lengths_only || !has_feed || basic == self.units {
            return Ok(());
        }
        let help = "write G700 or G710, which change the unit of feeds too; or give the basic units of the machine in a \
                    control file of your own: `[start]` and `units = \"mm\"`";
        refuse(
            Code::PN016,
            "a feed after G70 or G71 has the unit of the machine, which may differ from that of lengths",
            help,
        )
    }

    /// Refuses an increment of an axis directly after a change of its frame or of the tool length, because a setting of
    /// the machine decides whether the control traverses the change.
    pub(super) fn check_increments(&mut self, block: &Block, state: &State) -> Done {
        if let Some(register) = block.get(b'D') {
            let before = self.edge.replace(register);
            if before.is_some_and(|before| before != register) {
                self.shifted |= 1 << state.length_axis();
            }
        }
        if self.shifted == 0 || block.axes_are_taken() {
            return Ok(());
        }
        let absolute = match block.g_meaning(Group::Distance) {
            Some(meaning) => meaning == Meaning::Absolute,
            None => state.modes.absolute,
        };
        for (axis, letter) in state.control.axes().iter().enumerate() {
            let at = 1 << axis;
            if self.shifted & at == 0 || block.get(*letter).is_none() {
                continue;
            }
            if block.absolute & at == 0 && (!absolute || block.incremental & at != 0) {
                let letter = char::from(*letter);
                let message = format!("an increment of {letter} directly after a change of frame or tool length");
                let help = "move the axis to a position under G90 first: a setting of the machine (SD42440, SD42442) \
                            decides whether the control traverses the change";
                return refuse(Code::PN016, message, help);
            }
            self.shifted &= !at;
        }
        Ok(())
    }
}
