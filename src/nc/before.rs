//! The settings that a simulator gets before its first block, and queries about the block that was run last.

use super::action::{Position, ROTARY};
use super::codes::Group;
use super::parameters::Parameters;
use super::settings::RunSettings;
use super::simulator::Simulator;
use super::state::State;
use crate::control::{Code, Control, Meaning, Words};
use crate::toolpath::Units;

impl Simulator<'_> {
    /// Sets the units that are active until the program sets units itself. Call this function before the first block.
    pub fn begin_in(&mut self, units: Units) {
        self.state.begin_in(units);
    }

    /// Sets the work offsets of the machine by number, and the machine's positions for G28 and G30. Offsets and
    /// positions are in machine coordinates (millimetres and degrees). Call this function before the first block.
    pub fn begin_on(&mut self, offsets: &mut dyn Iterator<Item = (usize, Position)>, homes: [Position; 2]) {
        self.state.begin_on(offsets, homes);
    }

    /// Makes the positions of the rotary axes unknown until the program gives them, as after a stop of the machine. Call
    /// this function before the first block.
    pub fn begin_turned(&mut self) {
        self.state.place.becomes_unknown(ROTARY);
        self.state.place.turned = ROTARY;
    }

    /// Sets the number of programs before the main one in the input. The programs before the main one are subprograms
    /// of the control. Call this function before the first block.
    pub fn begin_behind(&mut self, programs: usize) {
        self.passing = if programs == 0 { 0 } else { programs + 1 };
    }

    /// Sets the number of a tool that the program may call by its name. Call this function before the block that loads
    /// the tool. If a name gets two numbers, its number is unknown.
    pub fn know_tool(&mut self, name: &str, number: f64) {
        self.state.tool_names.know(name, number);
    }

    /// Shares the list of tool names with another program, so that equal names are the same tool. Call this function
    /// before the first block.
    pub fn share_tool_names(&mut self, other: &Simulator<'_>) {
        self.state.tool_names.share(&other.state.tool_names);
    }

    /// Runs the program as a lathe program, with the lathe control of the same maker. Call this function before the
    /// first block. If `by_diameter` is set, X is a diameter, as a machine parameter can define. On LinuxCNC, G7 makes
    /// X a diameter.
    pub fn is_of_lathe(&mut self, by_diameter: bool) {
        let units = self.state.units();
        let control = self.state.settings.control.of_lathe();
        self.state = State::new(RunSettings { control, by_diameter: Some(by_diameter), ..self.state.settings });
        self.state.begin_in(units);
        self.parameters = Parameters::new(control);
    }

    /// Runs the program as a wire EDM program, with the wire EDM control of the same maker. Call this function before
    /// the first block.
    pub fn is_of_wire(&mut self) {
        let units = self.state.units();
        let control = self.state.settings.control.of_wire();
        self.state = State::new(RunSettings { control, ..self.state.settings });
        self.state.begin_in(units);
        self.parameters = Parameters::new(control);
    }

    /// Whether the current block moves to a machine position by a code that ends the tool length offset.
    pub fn ends_length(&self) -> bool {
        self.block.row(Group::Once).is_some_and(|row| row.runs.ends_length != 0)
    }

    /// The reference point to which the last block moves: 0 is the point of G28, 1 is the point of G30 or of G30 P2, 2 and 3
    /// are the points of G30 P3 and G30 P4.
    pub fn reference_point(&self) -> Option<usize> {
        let row = self.block.row(Group::Once).filter(|row| row.meaning == Meaning::Reference)?;
        let said = self.block.get(b'P').filter(|_| row.words.has(b'P'));
        Some(said.map_or(usize::from(row.runs.point == Some(2)), |point| (point as usize).saturating_sub(1)))
    }

    /// Whether the machine positions of the last block are measured from a point that only the machine has.
    pub fn goes_hidden(&self) -> bool {
        self.block.hidden
    }

    /// Whether the active tool length may count in the machine positions of the last block.
    pub fn may_keep_length(&self) -> bool {
        self.block.row(Group::Once).is_some_and(|row| row.runs.may_keep_length)
    }

    /// The allowed distance of the path from its corners: P of the last block.
    pub fn path_tolerance(&self) -> Option<f64> {
        self.block.get(b'P').filter(|_| self.block.row(Group::Path).is_some())
    }

    /// The current depth of nested subprograms and loops.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Whether the last block contains a motion code.
    pub fn names_motion(&self) -> bool {
        self.block.row(Group::Motion).is_some()
    }

    /// Whether the last block contains a T word.
    pub fn names_tool(&self) -> bool {
        self.block.get(b'T').is_some()
    }

    /// Two values: whether the last block sets the units, and whether it sets the feed mode.
    pub fn says_modes(&self) -> [bool; 2] {
        [Group::Units, Group::FeedMode].map(|group| self.block.row(group).is_some())
    }

    /// Axes for which the last block contains positions, as bits.
    pub fn says_positions(&self) -> u8 {
        self.state.said_positions(&self.block)
    }

    /// Rotary axes for which the last block has words, as bits.
    pub fn named_rotary(&self) -> u8 {
        let is_named = |axis: &usize| ROTARY & 1 << axis != 0 && self.state.axis_word(&self.block, *axis).is_some();
        (0..6).filter(is_named).map(|axis| 1 << axis).sum()
    }

    /// Whether the last block adds a second length offset to the tool length.
    pub fn adds_length(&self) -> bool {
        self.block.g_meaning(Group::Length) == Some(Meaning::LengthAdd)
    }

    /// Whether the last block shifts a frame: the position in the block then is the position of the tool.
    pub fn presets(&self) -> bool {
        match self.block.g_meaning(Group::Once) {
            Some(Meaning::Preset) => true,
            Some(Meaning::SetOffsets) => self.block.get(b'L') == Some(20.0),
            _ => false,
        }
    }

    /// Whether axis words are absolute positions, not increments.
    pub fn is_absolute(&self) -> bool {
        self.state.modes.absolute
    }

    /// The number of the next line, if no subprogram or loop jumps elsewhere.
    pub fn next_line(&self) -> u64 {
        self.at.line + 1
    }

    /// Whether the last block has axis words.
    pub fn has_axes(&self) -> bool {
        self.block.has_axes()
    }

    /// The control that runs the program.
    pub fn control(&self) -> &'static Control {
        self.state.settings.control
    }

    /// Whether the last block has an S word but neither starts nor stops the spindle.
    pub fn only_says_speed(&self) -> bool {
        let taps = self.block.row(Group::Motion).is_some_and(|row| row.meaning == Meaning::RigidTap);
        let switches = self.block.m().any(|(_, row)| row.stops_spindle || row.meaning.turns_spindle());
        self.block.get(b'S').is_some() && !switches && !taps
    }

    /// The first comment of the line that was run last, without its delimiters.
    pub fn comment(&self) -> Option<&[u8]> {
        self.block.comment.and_then(|(start, end)| self.line.get(start..end))
    }

    /// Whether the last block sets tool data, and not a work offset.
    pub fn sets_tool_data(&self) -> bool {
        self.sets_offsets() && !matches!(self.block.get(b'L'), Some(2.0 | 20.0))
    }

    /// The number of the length register that the last block sets, or whose wear it sets. Without L, the block sets
    /// the only value that the register has on some controls.
    pub fn set_length(&self) -> Option<u32> {
        let sets = self.sets_tool_data() && matches!(self.block.get(b'L'), None | Some(1.0 | 10.0 | 11.0));
        self.block.get(b'P').filter(|_| sets).map(|register| register as u32)
    }

    /// The words of the last block if it sets tool data: letters and values, in the units of the program.
    pub fn tool_data(&self) -> impl Iterator<Item = (u8, f64)> + '_ {
        let letters = (b'A'..=b'Z').filter(|letter| self.sets_tool_data() && !b"GNOM".contains(letter));
        letters.filter_map(|letter| Some((letter, self.block.get(letter)?)))
    }

    /// The words of the last block that belong to one of its codes: letters and values, in the units of the program.
    pub fn words_of(&self, code: Code) -> impl Iterator<Item = (u8, f64)> + '_ {
        let words = self.block.rows().find(|row| row.code == code).map_or(Words::NONE, |row| row.words);
        let letters = (b'A'..=b'Z').filter(move |letter| words.has(*letter));
        letters.filter_map(|letter| Some((letter, self.block.get(letter)?)))
    }

    fn sets_offsets(&self) -> bool {
        self.block.row(Group::Once).is_some_and(|row| row.meaning == Meaning::SetOffsets)
    }

    /// Whether the last block sets a work offset along X or Y, or rotates it.
    pub fn sets_offset_across(&self) -> bool {
        self.sets_offsets() && b"XYR".iter().any(|letter| self.block.get(*letter).is_some())
    }
}
