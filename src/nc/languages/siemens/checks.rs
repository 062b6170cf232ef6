//! Checks of blocks whose effect depends on settings of the machine: feeds after G70 and G71, and increments after a
//! change of frame or tool.

use super::ways::Siemens;
use crate::control::{Basic, Meaning, Row};
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::{Group, bit};
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

    /// Sets the registers of the active cutting edge. D selects an edge, with its length and radius, of the tool in the
    /// spindle. D in the block of T, before M6, also selects the edge of the tool that M6 loads.
    pub(super) fn select_edge(&mut self, block: &mut Block, state: &State) {
        let mut edge = block.get(b'D');
        let mut tool = state.tool.loaded;
        if block.means(Meaning::ToolChange) {
            tool = block.get(b'T').or(state.tool.number);
            edge = edge.or(self.next_edge.take().filter(|_| block.get(b'T').is_none()));
            self.no_edge = edge.is_none();
        } else if block.get(b'T').is_some() {
            self.next_edge = edge;
        }
        let Some(edge) = edge else { return };
        self.no_edge = false;
        let register = if edge == 0.0 { 0.0 } else { tool.unwrap_or(0.0) + (edge - 1.0) / 100.0 };
        block.put(b'D', register);
        block.put(b'H', register);
    }

    /// Refuses a move along the tool while machine data decides which tool length is active.
    pub(super) fn check_edge(&self, block: &Block, state: &State) -> Done {
        let letter = state.control.axes()[state.length_axis()];
        let in_machine = block.g_meaning(Group::Once) == Some(Meaning::Machine);
        if in_machine || block.axes_are_taken() || !block.has(bit(letter)) {
            return Ok(());
        }
        self.needs_edge()
    }

    /// Refuses a block that needs the tool length if no D word has selected an edge since M6.
    pub(super) fn needs_edge(&self) -> Done {
        if !self.no_edge {
            return Ok(());
        }
        let help = "write D1 after M6: without D, machine data (MD20270) decides which length is active";
        refuse(Code::PN016, "no D since the tool change: the active tool length is unknown", help)
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
