//! Codes that take effect only in their block: G10 sets offsets, G52 and G92 shift frames, G28 and G30 move to reference points.

use super::action::Action;
use super::block::Block;
use super::codes::{Group, letters};
use super::fault::{Done, refuse};
use super::frames::{Frames, Shift};
use super::out::Out;
use super::state::State;
use crate::control::{self, Meaning, Rules};
use crate::diag::Code;

impl State {
    /// Runs the codes that take effect only in their block: G10, G28, G30, G52, G92.
    pub(super) fn once(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        let Some(row) = block.row(Group::Once) else { return Ok(()) };
        // index 0 is the reference point of G28, index 1 that of G30
        let point = usize::from(row.runs.point == Some(2));
        match row.meaning {
            Meaning::SetOffsets => self.set_data(row.code, block, out),
            Meaning::Reference => self.go_home(point, row.runs.ends_length, block, out),
            Meaning::SetReference => {
                self.place.homes[point] = self.place.frames.to_machine(&self.place.position);
                Ok(())
            }
            Meaning::SpeedLimit if !block.has_axes() => Ok(()),
            Meaning::Frame
            | Meaning::Preset
            | Meaning::FrameOff
            | Meaning::FrameSuspend
            | Meaning::FrameRestore
            | Meaning::SpeedLimit => self.shift_frame(row.meaning, block, out),
            _ => Ok(()),
        }
    }

    fn set_data(&mut self, code: control::Code, block: &Block, out: &mut Out<'_>) -> Done {
        let l = block.get(b'L').unwrap_or(-1.0);
        if !self.control.is_linuxcnc() && l != 2.0 && l != 20.0 {
            // G10 sets tool registers here; no position in the simulator depends on them, but the comparison of two
            // programs reads them (`Simulator::tool_data`)
            block.takes(if self.control.is_lathe() { letters("PQRXYZCUW") } else { letters("PR") });
            out.push(Action::LeftOut(code, Meaning::SetOffsets));
            return Ok(());
        }
        if self.control.is_linuxcnc() && [1.0, 10.0, 11.0].contains(&l) {
            return refuse(Code::PN016, "G10 on the tool table is not simulated", "set the tool table at the machine");
        }
        if self.control.is_linuxcnc() && block.has(letters("IJ")) {
            let help = "remove I and J: they are words of G10 L1, L10 and L11";
            return refuse(Code::PN005, format!("{code} L{l} with I or J"), help);
        }
        let grbl = self.control.rules() == Rules::Grbl;
        let written = if grbl { Some(block.get(b'P').map_or(0.0, f64::trunc)) } else { block.get(b'P') };
        let Some(p) = written.filter(|p| p.fract() == 0.0 && *p >= 0.0) else {
            return refuse(Code::PN007, "G10 without the number of its offset", "write P1 for G54");
        };
        if l != 2.0 && l != 20.0 {
            return refuse(Code::PN016, format!("G10 L{l} is not simulated"), "set offsets with G10 L2 or L20");
        }
        let active = self.place.frames.active;
        let number = match (p as usize, self.control.is_linuxcnc()) {
            (0, true) => active,
            // on a Haas or Fanuc, L20 sets an additional work offset
            (p, false) if l == 20.0 => p + 9,
            (p, _) => p,
        };
        self.compensated(number == active, "a moved frame")?;
        let place = self.place.frames.to_machine(&self.place.position);
        let words: [Option<f64>; 6] = std::array::from_fn(|axis| self.axis_word(block, axis));
        let (absolute, control) = (self.modes.absolute, self.control);
        // G10 L20 of LinuxCNC moves the offset so that the tool has this position in it
        let stands = l == 20.0 && control.is_linuxcnc();
        let to_stand = stands.then(|| self.place.frames.to_stand(number, &place, &words));
        let Some((work, rotation)) = self.place.frames.work(number) else {
            return refuse(Code::PN018, format!("there is no work offset P{p}"), "write P1 for G54");
        };
        let before = [*work, [*rotation; 6]];
        match to_stand {
            // in a rotated frame, the offset moves along X and Y
            Some(by) => work.iter_mut().zip(by).for_each(|(work, by)| *work += by),
            None => {
                for (work, value) in work.iter_mut().zip(words).filter_map(|(work, value)| Some((work, value?))) {
                    *work = if absolute || control.is_linuxcnc() { value } else { *work + value };
                }
            }
        }
        // only LinuxCNC has work offsets with a rotation
        if control.is_linuxcnc()
            && let Some(angle) = block.get(b'R')
        {
            *rotation = angle;
        }
        let changed = [*work, [*rotation; 6]] != before;
        if l == 2.0 && (absolute || control.is_linuxcnc()) {
            let named = words.iter().enumerate().filter(|(_, value)| value.is_some());
            named.for_each(|(axis, _)| self.place.frames.gives(number, axis));
        }
        self.place.position = self.place.frames.to_program(&place);
        out.push(if changed { Action::Frame } else { Action::LeftOut(code, Meaning::SetOffsets) });
        Ok(())
    }

    fn shift_frame(&mut self, does: Meaning, block: &Block, out: &mut Out<'_>) -> Done {
        let place = self.place.frames.to_machine(&self.place.position);
        let (before, mut lost) = (self.place.frames.shift, false);
        match does {
            Meaning::FrameOff => {
                let Frames { shift, shift_kept, local, .. } = &mut self.place.frames;
                (*shift, *shift_kept, *local) = Default::default();
            }
            Meaning::FrameSuspend => self.place.frames.shift = Shift::default(),
            Meaning::FrameRestore => self.place.frames.shift = self.place.frames.shift_kept,
            _ => {
                self.compensated(true, "a moved frame")?;
                if !block.has_axes() {
                    return refuse(Code::PN006, "the code needs axis words and has none", "write the axes to shift");
                }
                for axis in 0..6 {
                    let (unknown, at, is_linuxcnc) =
                        (self.is_unknown(axis), self.place.position[axis], self.control.is_linuxcnc());
                    // U and W of a lathe are added to the current position
                    if let Some(by) = self.increment(block, axis) {
                        if does == Meaning::Frame || self.axis_word(block, axis).is_some() {
                            let help = "write X and Z, each once";
                            return refuse(Code::PN004, "an increment of an axis where it has no clear meaning", help);
                        }
                        self.place.frames.shift.by[axis] -= by;
                        continue;
                    }
                    let Some(value) = self.axis_word(block, axis) else { continue };
                    let Frames { shift, local, .. } = &mut self.place.frames;
                    match (does == Meaning::Frame, is_linuxcnc) {
                        (true, true) => {
                            (shift.by[axis], shift.unknown) = (value, shift.unknown & !(1 << axis));
                            continue;
                        }
                        // on a Fanuc, G52 is measured from the zero that G92 has shifted, and G92 ends G52
                        (true, false) => {
                            shift.by[axis] += value - std::mem::replace(&mut local[axis], value);
                            continue;
                        }
                        (false, _) => (shift.by[axis], local[axis]) = (shift.by[axis] + at - value, 0.0),
                    }
                    if unknown {
                        shift.unknown |= 1 << axis;
                        self.place.given(axis); // in the shifted frame, the position is known
                        lost = true;
                    }
                }
            }
        }
        if matches!(does, Meaning::Frame | Meaning::Preset) {
            self.place.frames.shift_kept = self.place.frames.shift;
        }
        self.place.position = self.place.frames.to_program(&place);
        if lost || self.place.frames.shift != before {
            out.push(Action::Frame);
        }
        Ok(())
    }

    /// Moves through an intermediate position to a reference point.
    fn go_home(&mut self, which: usize, ends_length: u8, block: &Block, out: &mut Out<'_>) -> Done {
        if self.tool.side.is_some() {
            return refuse(Code::PN013, "G28 or G30 under cutter compensation", "end the compensation with G40 first");
        }
        if let Some(point) = block.get(b'P').filter(|point| ![2.0, 3.0, 4.0].contains(point)) {
            let message = format!("P{point} is not a reference point of G30");
            return refuse(Code::PN018, message, "write P2, P3 or P4");
        }
        let is_named = |axis: usize| self.axis_word(block, axis).or(self.increment(block, axis)).is_some();
        let named: u8 = (0..6).filter(|&axis| is_named(axis)).map(|axis| 1 << axis).sum();
        if named == 0 && !self.control.is_linuxcnc() && !self.control.traits().all_go_home {
            return refuse(Code::PN006, "G28 or G30 without axes", "write the axes that go home, as G91 G28 Z0");
        }
        let axes = if named == 0 { 0x3f } else { named };
        if named != 0 || self.control.rules() != Rules::Grbl {
            let way = self.target(block)?;
            self.place.rapid_to(way, out);
        }
        let home = self.place.frames.to_program(&self.place.homes[which]);
        let mut to = self.place.position;
        for axis in (0..6).filter(|axis| axes & 1 << axis != 0) {
            to[axis] = home[axis];
        }
        // a rotary axis that was never turned may not exist, and its first reference point is taken for its 0
        let known = if which == 0 { 0 } else { named };
        self.place.goes_home(axes & (0b111 | self.place.turned | known));
        self.place.rapid_to(to, out);
        self.end_length(axes & ends_length, out);
        Ok(())
    }
}
