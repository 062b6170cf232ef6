//! Reads simple blocks ahead. The proof compares the block with the job first, and then only needs its effect on the
//! control, but not its actions. [`Simulator::step`] gives the same result for these blocks; a test compares both results.
//!
//! From the third hole of a cycle on, a block that has only a position makes the same actions as the block before, at
//! another position: the first of these blocks has changed every value of the control that such a block can change. A
//! caller that has the actions of the last hole therefore needs only the new position.

use std::io::BufRead;

use super::action::Position;
use super::block::Block;
use super::codes::{AXES, letters};
use super::plain::PlainCut;
use super::simulator::Simulator;
use super::state::State;
use crate::control::Rules;
use crate::toolpath::Plane;

/// The words of a block that has only a position.
const WORDS: u32 = letters("XYN");

/// The number of holes that blocks with only a position must have made before the next hole is sure to be the same.
const SETTLED: u8 = 2;

/// The longest line that is read ahead. All controls accept lines of this length.
const LONGEST: usize = 64;

/// The cut of the next block, which is straight and follows another straight cut.
#[derive(Clone, Copy, Debug)]
pub struct NextCut {
    /// The cut.
    pub cut: PlainCut,
    /// Length of the line in bytes.
    length: usize,
}

/// The next hole of a cycle. It differs from the last hole only in its position.
#[derive(Clone, Copy, Debug)]
pub struct NextHole {
    /// The position at the return level of the cycle.
    pub at: Position,
    /// Length of the line in bytes.
    length: usize,
}

impl State {
    /// Whether the block that was just run has only a position and has made a hole.
    pub(super) fn makes_hole_by_position(&self, block: &Block) -> bool {
        block.plain
            && has_only_position(block)
            && self.modes.absolute
            && self.modes.plane == Plane::Xy
            && self.holes.work.is_none()
            && self.cycle_in_force().is_some()
    }

    /// The position of the hole that a block makes, if the hole differs from the last one only in its position.
    fn next_hole(&self, block: &Block) -> Option<Position> {
        let is_usual = has_only_position(block)
            && self.place.at_machine == 0
            // the meaning of lengths without a decimal point depends on a setting
            && (block.whole & AXES == 0 || self.control.rules().is_nist());
        let mut at = self.place.position;
        for (axis, value) in at.iter_mut().enumerate().take(2) {
            *value = self.axis_word(block, axis).unwrap_or(*value);
        }
        is_usual.then_some(at)
    }
}

fn has_only_position(block: &Block) -> bool {
    block.given & !WORDS == 0 && !block.has_g
}

impl Simulator<'_> {
    /// The cut that the next block makes, if the block is a simple one. The block is not run: call
    /// [`Simulator::make_cut`], or run it by [`Simulator::step`].
    #[inline]
    pub fn next_cut(&mut self) -> Option<NextCut> {
        let length = self.read_ahead()?;
        let cut = self.state.plain_cut(&self.ahead)?;
        Some(NextCut { cut, length })
    }

    /// Makes the cut that [`Simulator::next_cut`] has returned.
    #[inline]
    pub fn make_cut(&mut self, next: &NextCut) {
        self.pass_line(next.length);
        self.state.cut_to(&next.cut);
    }

    /// The hole that the next block makes, if it differs from the last hole only in its position. The block is not run:
    /// call [`Simulator::make_hole`], or run it by [`Simulator::step`].
    pub fn next_hole(&mut self) -> Option<NextHole> {
        if self.state.holes.alike < SETTLED {
            return None;
        }
        let length = self.read_ahead()?;
        let at = self.state.next_hole(&self.ahead)?;
        Some(NextHole { at, length })
    }

    /// Makes the hole that [`Simulator::next_hole`] has returned. The actions from [`Action::Hole`] on are those of the
    /// last hole, at the new position.
    ///
    /// [`Action::Hole`]: super::action::Action::Hole
    pub fn make_hole(&mut self, hole: &NextHole) {
        self.pass_line(hole.length);
        self.state.place.position = hole.at;
        self.state.holes.alike = self.state.holes.alike.saturating_add(1);
    }

    /// Reads the next line into `ahead`, and returns its length. `None`: the line is not simple or not complete in the
    /// buffer, so the general reader must read it.
    #[inline]
    fn read_ahead(&mut self) -> Option<usize> {
        let control = self.state.settings.control;
        let is_usual = self.begun
            && !(self.over || self.unfinished)
            // the actions of loops and subprograms are counted
            && self.frames.is_empty()
            && matches!(control.rules(), Rules::Linuxcnc | Rules::Emc2 | Rules::Fanuc);
        if !is_usual {
            return None;
        }
        self.ahead.has_g = false;
        self.ahead.read_plain(self.input.buffer(), control).filter(|length| *length <= LONGEST)
    }

    /// Takes a line that was read ahead out of the buffer.
    #[inline]
    fn pass_line(&mut self, length: usize) {
        self.line.clear();
        self.line.extend_from_slice(&self.input.buffer()[..length]);
        self.input.consume(length);
        self.at.byte += length as u64;
        self.at.line += 1;
        self.ran = self.at.line;
        self.blocks += 1;
        self.words = true;
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use proptest::prelude::*;

    use super::*;
    use crate::control::Control;
    use crate::nc::{Action, Drilling, Item, RunSettings};

    /// The items of a program, and the state of the control after each block. `ahead`: cuts and holes are made from the
    /// blocks read ahead where possible. Also returns the numbers of these cuts and holes.
    fn run(program: &str, name: &str, ahead: bool) -> (Vec<Vec<Item>>, Vec<String>, [usize; 2]) {
        let control = Control::named(name).unwrap();
        let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), RunSettings::new(control));
        let (mut items, mut states, mut made) = (Vec::<Vec<Item>>::new(), Vec::new(), [0; 2]);
        loop {
            let mut own = Vec::new();
            if let Some(hole) = simulator.next_hole().filter(|_| ahead) {
                simulator.make_hole(&hole);
                made[1] += 1;
                own = items.iter().rfind(|items| !items.is_empty()).unwrap().clone();
                shift(&mut own, &hole.at, simulator.line());
            } else if let Some(next) = simulator.next_cut().filter(|_| ahead) {
                simulator.make_cut(&next);
                made[0] += 1;
                let PlainCut { to, feed, .. } = next.cut;
                let machine = simulator.state.place.at_machine;
                let action = Action::Feed { to, feed, lead: None, machine, home: 0 };
                own.push(Item { line: simulator.line(), by_cycle: false, action });
            } else if !matches!(simulator.step(&mut own), Ok(true)) {
                items.push(own);
                return (items, states, made);
            }
            items.push(own);
            states.push(format!("{:?} {} {:?}", simulator.state, simulator.blocks(), simulator.text()));
        }
    }

    /// Moves the actions of a hole to another position. LinuxCNC may raise the tool over the last hole first.
    fn shift(items: &mut [Item], at: &Position, line: u64) {
        let of_hole = |item: &Item| if let Action::Hole(hole) = &item.action { Some(**hole) } else { None };
        let Drilling { at: before, shift, .. } = items.iter().find_map(of_hole).unwrap();
        let begin = items.iter().position(|item| of_hole(item).is_some()).unwrap();
        for (index, item) in items.iter_mut().enumerate() {
            item.line = line;
            let to = match &mut item.action {
                Action::Rapid { to, .. } | Action::Feed { to, .. } => to,
                Action::Hole(hole) => &mut hole.at,
                _ => continue,
            };
            for axis in 0..2 {
                // a boring cycle also moves beside the axis of the hole
                let beside = if to[axis] == before[axis] { 0.0 } else { shift[axis] };
                to[axis] = if index < begin { before[axis] } else { at[axis] + beside };
            }
        }
    }

    /// The first blocks of cycles, and blocks between holes.
    const BLOCKS: [&str; 44] = [
        "G81 X1. Y1. Z-5. R2. F200.",
        "G98 G81 X1. Y1. Z-5. R2. F200.",
        "G99 G82 X1. Y1. Z-5. R2. P1. F200.",
        "G83 X1. Y1. Z-5. R2. Q1. F200.",
        "G99 G73 X1. Z-5. R2. Q1. F90.",
        "G84 X1. Y1. Z-5. R2. F200.",
        "G85 X1. Y1. Z-5. R2. F200.",
        "G86 X1. Y1. Z-5. R2. P0. F200.",
        "G76 X1. Y1. Z-5. R2. Q1. F200.",
        "G81 G91 X1. Y1. Z-5. R-2.",
        "G0 Z9.",
        "G0 Z-9.",
        "X1. Y2. Z-3.",
        "X1. R5.",
        "G80",
        "G90",
        "G91",
        "G98",
        "G99",
        "G20",
        "G21",
        "F50.",
        "M8",
        "M3 S500",
        "M5",
        "G55",
        "G92 X1.",
        "G17",
        "G18",
        "(comment)",
        "",
        "G1 X5. F100.",
        "G1 Z-1.",
        "X2. F80.",
        "X2 F80",
        "G2 X1. Y1. R5.",
        "G93",
        "G94",
        "G7",
        "G8",
        "G41 D1",
        "G28 X0. Y0.",
        "A90.",
        "/X1.",
    ];

    fn block() -> impl Strategy<Value = String> {
        let value = "-?[0-9]{1,2}(\\.[0-9]{0,3})?";
        let position = prop_oneof![
            3 => (value, value).prop_map(|(x, y)| format!("X{x} Y{y}")),
            1 => value.prop_map(|x| format!("X{x}")),
            1 => value.prop_map(|y| format!("N7 Y{y}.")),
        ];
        let positions = prop::collection::vec(position, 1..6).prop_map(|lines| lines.join("\n"));
        prop_oneof![2 => positions, 1 => prop::sample::select(BLOCKS.to_vec()).prop_map(str::to_owned)]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn blocks_read_ahead_run_as_by_the_general_code(
            blocks in prop::collection::vec(block(), 1..12),
            first in prop::sample::select(BLOCKS[..10].to_vec()),
            name in prop::sample::select(vec!["linuxcnc", "emc2", "mach3", "fanuc", "haas", "fadal", "centroid", "fanuc-lathe", "grbl"]),
        ) {
            let program = format!("G21 G90 G94 F100.\nS1000 M3\nG0 X0. Y0. Z5.\n{first}\n{}\nM30\n", blocks.join("\n"));
            let [general, ahead] = [false, true].map(|ahead| run(&program, name, ahead));
            prop_assert_eq!(general.0, ahead.0, "{}", program);
            prop_assert_eq!(general.1, ahead.1, "{}", program);
        }
    }

    #[test]
    fn cuts_and_holes_after_the_third_are_read_ahead() {
        let made = |name: &str| {
            let points: String = (0..20).map(|x| format!("X{x}.\n")).collect();
            let cycle = BLOCKS[0];
            let program = format!("G21 G90 G94\nG0 Z5.\n{cycle}\n{points}G80\nG1 X0. F90.\n{points}M30\n");
            run(&program, name, true).2
        };
        assert_eq!(["linuxcnc", "mach3", "fanuc", "haas"].map(made), [[20, 18]; 4]);
    }
}
