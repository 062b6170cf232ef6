//! The codes of a block for spindle and tool: speed, tool, coolant, compensation, tool length.

use super::action::{Action, Compensation, Cutter, Rotation};
use super::arcs::axes_of;
use super::block::Block;
use super::codes::{ARCS, Group, Motion, bit, is_one_of};
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::control::{Code, Kept, Meaning, Row, Rules, ToolLength, Turns};
use crate::diag;
use crate::toolpath::{Coolant, Plane, Side};

/// The rotation of the spindle after an M code of this meaning.
pub(crate) fn rotation(meaning: Meaning) -> Option<Rotation> {
    match meaning {
        Meaning::SpindleCw | Meaning::SpindleCwCoolant => Some(Rotation::Cw),
        Meaning::SpindleCcw | Meaning::SpindleCcwCoolant => Some(Rotation::Ccw),
        Meaning::SpindleOff => Some(Rotation::Stop),
        _ => None,
    }
}

/// The kind of coolant that an M code of this meaning turns on; `OFF` if it turns off all kinds.
pub(crate) fn coolant(meaning: Meaning) -> Option<Coolant> {
    match meaning {
        Meaning::Flood | Meaning::SpindleCwCoolant | Meaning::SpindleCcwCoolant => Some(Coolant::FLOOD),
        Meaning::Mist => Some(Coolant::MIST),
        Meaning::Through => Some(Coolant::THROUGH),
        Meaning::CoolantOff => Some(Coolant::OFF),
        _ => None,
    }
}

impl State {
    /// The axis along which the length of a mill's tool counts: on a Siemens control, the axis perpendicular to the plane.
    pub fn length_axis(&self) -> usize {
        match self.control.rules() {
            Rules::Siemens => axes_of(self.modes.plane)[2],
            _ => 2,
        }
    }

    pub(super) fn spindle_and_tool(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let speed = block.get(b'S');
        if let Some(speed) = speed {
            if speed < 0.0 {
                return refuse(
                    diag::Code::PN018,
                    "a negative S",
                    "write the speed without the minus, and the direction as M3 or M4",
                );
            }
            match block.g_meaning(Group::Once) {
                Some(Meaning::SpeedLimit) => out.push(Action::SpeedLimit(speed)),
                _ => self.drive.speed = speed,
            }
        }
        match block.g_meaning(Group::SpeedMode) {
            Some(Meaning::SurfaceSpeed) if speed.is_none() && self.control.is_linuxcnc() => {
                return refuse(diag::Code::PN007, "G96 without S", "write S with the surface speed in this block");
            }
            Some(Meaning::SurfaceSpeed) => out.push(Action::SurfaceSpeed(Some(block.get(b'D').unwrap_or(0.0)))),
            Some(_) => out.push(Action::SurfaceSpeed(None)),
            None => {}
        }
        if let Some(tool) = block.get(b'T') {
            self.check_tool(tool)?;
            self.tool.number = Some(tool);
            if self.control.is_lathe() {
                self.turn_turret(tool, out);
            }
        }
        if let Some(tool) = block.m().find_map(|(_, row)| row.runs.tool) {
            self.tool.number = Some(f64::from(tool));
            self.change_tool(out)?;
        }
        if block.means(Meaning::ToolChange) {
            self.change_tool(out)?;
        }
        if let Some(next) = block.next_tool {
            self.preselect(next, block)?;
        }
        self.rotary_codes(block);
        let mut turned = false;
        for (number, row) in block.m() {
            if row.stops_spindle {
                self.turn_spindle(Rotation::Stop, out);
            }
            let rotation = rotation(row.meaning);
            if let Some(rotation) = rotation {
                turned = true;
                // on a Fanuc, a code that stops spindle or coolant takes effect after the motion of the block
                if rotation != Rotation::Stop || self.control.is_linuxcnc() {
                    self.turn_spindle(rotation, out);
                }
            }
            match row.meaning {
                Meaning::CoolantOff if !self.control.is_linuxcnc() => {}
                Meaning::Orient => {
                    let angle = self.angle(row, block)?;
                    if self.control.is_linuxcnc() && !(0.0..=360.0).contains(&angle) {
                        let message = format!("M19 to an angle of {angle}");
                        return refuse(diag::Code::PN018, message, "write an angle from 0 to 360");
                    }
                    self.drive.spindle = Rotation::Stop; // an orientation also stops the spindle
                    out.push(Action::Orient(Some(angle)));
                }
                Meaning::ToolChange | Meaning::ToolNumber | Meaning::Call | Meaning::Return | Meaning::End => {}
                meaning if meaning.is_stop() => {}
                meaning => match coolant(meaning) {
                    Some(coolant) => out.push(Action::Coolant(coolant)),
                    None if rotation.is_none() => out.push(Action::LeftOut(Code::m(number), row.meaning)),
                    None => {}
                },
            }
        }
        for group in [Group::Path, Group::Once] {
            if let Some(row) = block.row(group).filter(|row| group == Group::Path || row.meaning == Meaning::ExactStop)
            {
                out.push(Action::LeftOut(row.code, row.meaning));
            }
        }
        if let Some(row) = block.row(Group::Other) {
            out.push(Action::LeftOut(row.code, row.meaning));
        }
        let limits = block.g_meaning(Group::Once) == Some(Meaning::SpeedLimit);
        if speed.is_some() && !turned && !limits {
            out.push(Action::Spindle(self.drive.spindle, self.drive.speed));
        }
        Ok(())
    }

    /// The angle at which a code stops the spindle.
    fn angle(&self, row: &Row, block: &Block) -> Done<f64> {
        let mut angles =
            (b'A'..=b'Z').filter(|letter| row.runs.angle.has(*letter)).filter_map(|letter| block.get(letter));
        let angle = angles.next();
        if angles.next().is_some() || block.has(bit(b'S')) && !self.control.is_linuxcnc() {
            let message = format!("{} with more than one word that may be its angle", row.code);
            return refuse(diag::Code::PN016, message, "write the angle as R, and S in another block");
        }
        Ok(angle.unwrap_or(0.0))
    }

    pub(super) fn turn_spindle(&mut self, rotation: Rotation, out: &mut Out<'_>) {
        self.drive.spindle = rotation;
        out.push(Action::Spindle(self.drive.spindle, self.drive.speed));
    }

    /// Handles a second T word in a block. The first T word is the tool that the block loads, and the second is the
    /// next tool.
    fn preselect(&mut self, tool: f64, block: &Block) -> Done {
        if !block.changes_tool() {
            let help = "a second T is allowed only with M6, for the next tool: write M6, or keep one T";
            return refuse(diag::Code::PN002, "T is twice in a block without a tool change", help);
        }
        self.check_tool(tool)?;
        self.tool.number = Some(tool);
        Ok(())
    }

    fn check_tool(&self, word: f64) -> Done {
        if self.tool_names.is_tool(word) {
            return Ok(());
        }
        let help = "tool numbers are whole numbers below 1000000000";
        refuse(diag::Code::PN018, format!("T{word} is not a tool number"), help)
    }

    /// Runs M6. The spindle is stopped after M6. On some controls, the coolant is stopped, too.
    pub(super) fn change_tool(&mut self, out: &mut Out<'_>) -> Done {
        let Some(tool) = self.tool.number else {
            return refuse(diag::Code::PN007, "M6 without a tool", "write T and the tool's number before M6");
        };
        if self.settings.places_unknown {
            self.place.goes_to_machine(0b100);
        }
        self.drive.spindle = Rotation::Stop;
        let tool = self.tool_names.number(tool);
        self.tool.loaded = Some(tool);
        out.push(Action::Tool(tool));
        if self.control.traits().coolant_at_change == Kept::No {
            out.push(Action::Coolant(Coolant::OFF));
        }
        Ok(())
    }

    pub(super) fn compensation(&mut self, block: &Block, motion: Motion, out: &mut Out<'_>) -> Done {
        if !self.control.is_linuxcnc() {
            // in a cycle of a Haas lathe, D is a depth, not a register
            let of_cycle = block.row(Group::Once).is_some_and(|row| row.words.has(b'D'));
            self.tool.diameter_register = block.get(b'D').filter(|_| !of_cycle).or(self.tool.diameter_register);
        }
        let Some(row) = block.row(Group::Compensation) else {
            // the register changes while compensation is on
            if let (Some(side), Some(_), false) = (self.tool.side, block.get(b'D'), self.control.is_linuxcnc()) {
                let cutter = self.tool.diameter_register.map_or(Cutter::Tool, Cutter::Register);
                out.push(Action::Compensation(Some(Compensation { side, cutter })));
            }
            return Ok(());
        };
        if row.meaning == Meaning::SideOff {
            self.tool.side = None;
            out.push(Action::Compensation(None));
            return Ok(());
        }
        if self.tool.side.is_some() && self.control.is_linuxcnc() {
            return refuse(
                diag::Code::PN013,
                "cutter compensation is already on",
                "end the compensation with G40 first",
            );
        }
        if !self.control.is_linuxcnc() && is_one_of(motion, &ARCS) {
            return refuse(
                diag::Code::PN013,
                "cutter compensation begins on an arc",
                "begin the compensation on a straight move",
            );
        }
        let side = if row.meaning == Meaning::SideLeft { Side::Left } else { Side::Right };
        let cutter = match row.runs.by_diameter {
            true if row.words.has(b'D') => self.given_cutter(row, block)?,
            true => Cutter::Tool,
            false => self.cutter(block)?,
        };
        self.tool.side = Some(side);
        out.push(Action::Compensation(Some(Compensation { side, cutter })));
        Ok(())
    }

    /// The source of the radius for G41 and G42. Without D, LinuxCNC uses the diameter of the tool in the spindle.
    fn cutter(&self, block: &Block) -> Done<Cutter> {
        let is_linuxcnc = self.control.is_linuxcnc();
        let register = if is_linuxcnc { block.get(b'D').or(self.tool.loaded) } else { self.tool.diameter_register };
        if register.is_none() && !is_linuxcnc && self.control.traits().turns == Turns::Tool {
            let help = "write D with the tool's register: G41 D1";
            return refuse(diag::Code::PN007, "cutter compensation without D", help);
        }
        Ok(register.map_or(Cutter::Tool, Cutter::Register))
    }

    /// The radius that G41.1 and G42.1 give: D is the diameter, L the orientation of a lathe tool.
    fn given_cutter(&self, row: &Row, block: &Block) -> Done<Cutter> {
        let Some(diameter) = block.get(b'D') else {
            let help = format!("write D with the diameter of the tool: {} D6", row.code);
            return refuse(diag::Code::PN007, format!("{} without D", row.code), help);
        };
        if block.get(b'L').is_some() && self.modes.plane != Plane::Xz {
            let help = "leave L out, or write G18 before: L is the orientation of a lathe tool";
            return refuse(diag::Code::PN005, format!("{} with L outside G18", row.code), help);
        }
        Ok(Cutter::Given { diameter, orientation: block.get(b'L').unwrap_or(0.0) })
    }

    /// Ends the tool length offset after a move of these axes to a machine position. The code of the offset stays
    /// active, so that a register alone turns the offset on again.
    pub(super) fn end_length(&mut self, axes: u8, out: &mut Out<'_>) {
        if axes != 0 && self.tool.length_on && !self.control.is_lathe() {
            out.push(Action::Length(None));
        }
    }

    pub(super) fn length(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let row = match block.row(Group::Length) {
            Some(row) => row,
            // on a Fanuc, H alone changes the active offset; on a FADAL, H alone turns an offset on
            None => {
                let by_register = matches!(self.control.traits().tool_length, ToolLength::Register | ToolLength::Tool);
                let counts = self.tool.length_on || by_register;
                if let Some(register) = block.get(b'H').filter(|_| counts && !self.control.is_linuxcnc()) {
                    // register 0 means no length
                    let register = self.tool_names.number(register);
                    self.tool.length_on = register != 0.0 || !by_register;
                    out.push(Action::Length(Some(register).filter(|register| *register != 0.0)));
                }
                return Ok(());
            }
        };
        let place = self.place.frames.to_machine(&self.place.position);
        self.tool.length_on = row.meaning != Meaning::LengthOff;
        match row.meaning {
            Meaning::LengthOff => {
                self.place.frames.tool = [0.0; 3];
                out.push(Action::Length(None));
            }
            Meaning::LengthData => {
                for (axis, letter) in (*b"XYZ").into_iter().enumerate() {
                    if let Some(value) = block.get(letter) {
                        self.place.frames.tool[axis] = value;
                    }
                }
                out.push(Action::Length(Some(0.0)));
            }
            _ => {
                // without H, some controls use the length of the tool in the spindle, even if a T word has named another tool since
                let by_tool = self.control.traits().tool_length == ToolLength::Code;
                let zero_is_tool = self.control.traits().zero_is_tool;
                let register = block.get(b'H').filter(|h| *h != 0.0 || !zero_is_tool).or(self.tool.loaded);
                if block.get(b'H').is_none() && !by_tool {
                    let help = "write H with the tool's register: G43 H1";
                    return refuse(diag::Code::PN007, "a tool length offset without H", help);
                }
                let adds = row.meaning == Meaning::LengthAdd;
                if adds && block.get(b'H').is_none() {
                    return refuse(
                        diag::Code::PN007,
                        format!("{} without H", row.code),
                        "write H with the tool's number",
                    );
                }
                if !adds {
                    self.place.frames.tool = [0.0; 3]; // ends the offset of G43.1
                }
                // the simulator has no tool table, so the length counts as zero; G44 subtracts it
                let register = self.tool_names.number(register.unwrap_or(0.0));
                // register 0 means no length
                let register = Some(register).filter(|register| *register != 0.0);
                let subtracts = row.meaning == Meaning::LengthMinus;
                out.push(Action::Length(register.map(|register| if subtracts { -register } else { register })));
            }
        }
        self.place.position = self.place.frames.to_program(&place);
        Ok(())
    }
}
