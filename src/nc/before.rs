//! What is said of a program before its first block, and asked of the block that was run last.

use super::action::Position;
use super::codes::Group;
use super::parameters::Parameters;
use super::settings::RunSettings;
use super::simulator::Simulator;
use super::state::State;
use crate::control::{Control, Meaning};

impl Simulator<'_> {
    /// The program counts in these units until it says others; before the first block.
    pub fn begin_in(&mut self, units: crate::toolpath::Units) {
        self.state.begin_in(units);
    }

    /// The machine has these work offsets, by their numbers, and goes to these positions by G28 and G30: machine coordinates in
    /// millimetres and degrees; before the first block.
    pub fn begin_on(&mut self, offsets: &mut dyn Iterator<Item = (usize, Position)>, homes: [Position; 2]) {
        self.state.begin_on(offsets, homes);
    }

    /// So many programs stand before the main one, as subprograms that the control knows; before the first block.
    pub fn begin_behind(&mut self, programs: usize) {
        self.passing = if programs == 0 { 0 } else { programs + 1 };
    }

    /// The program is a lathe's, and its control is the lathe of its maker; before the first block. Whether X is a diameter is
    /// a parameter of such a machine; LinuxCNC says it by G7.
    pub fn is_of_lathe(&mut self, by_diameter: bool) {
        let units = self.state.units();
        let control = self.state.settings.control.of_lathe();
        self.state = State::new(RunSettings { control, by_diameter: Some(by_diameter), ..self.state.settings });
        self.state.begin_in(units);
        self.parameters = Parameters::new(control);
    }

    /// The program is a wire EDM machine's, and its control is that of its maker; before the first block.
    pub fn is_of_wire(&mut self) {
        let units = self.state.units();
        let control = self.state.settings.control.of_wire();
        self.state = State::new(RunSettings { control, ..self.state.settings });
        self.state.begin_in(units);
        self.parameters = Parameters::new(control);
    }

    /// To which reference point the block that was run last goes: 0 is that of G28, 1 that of G30.
    pub fn reference_point(&self) -> Option<usize> {
        let row = self.block.row(Group::Once).filter(|row| row.meaning == Meaning::Reference)?;
        Some(usize::from(row.runs.point == Some(2)))
    }

    /// How far a path may leave its corners, by P of the block that was run last.
    pub fn path_tolerance(&self) -> Option<f64> {
        self.block.get(b'P').filter(|_| self.block.row(Group::Path).is_some())
    }

    /// Does the block that was run last turn on coolant through the spindle?
    pub fn cools_through(&self) -> bool {
        self.block.means(Meaning::Through)
    }

    /// How deep the run is in subprograms and loops.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Does the block that was run last name a motion?
    pub fn names_motion(&self) -> bool {
        self.block.row(Group::Motion).is_some()
    }

    /// Does the block that was run last name a tool?
    pub fn names_tool(&self) -> bool {
        self.block.get(b'T').is_some()
    }

    /// Does it say its units, and what feeds count?
    pub fn says_modes(&self) -> [bool; 2] {
        [Group::Units, Group::FeedMode].map(|group| self.block.row(group).is_some())
    }

    /// Axes to which the block says positions, as bits.
    pub fn says_positions(&self) -> u8 {
        self.state.said_positions(&self.block)
    }

    /// Does it add another length to the tool's?
    pub fn adds_length(&self) -> bool {
        self.block.g_meaning(Group::Length) == Some(Meaning::LengthAdd)
    }

    /// Does it move a frame so that the tool is at its values?
    pub fn presets(&self) -> bool {
        match self.block.g_meaning(Group::Once) {
            Some(Meaning::Preset) => true,
            Some(Meaning::SetOffsets) => self.block.get(b'L') == Some(20.0),
            _ => false,
        }
    }

    /// Are axis words positions?
    pub fn is_absolute(&self) -> bool {
        self.state.modes.absolute
    }

    /// The line that is read next, where no subprogram or loop leads elsewhere.
    pub fn next_line(&self) -> u64 {
        self.at.line + 1
    }

    /// Does it have axis words?
    pub fn has_axes(&self) -> bool {
        self.block.has_axes()
    }

    /// The control that runs the program.
    pub fn control(&self) -> &'static Control {
        self.state.settings.control
    }

    /// Does the block that was run last say a speed, and neither start nor stop the spindle?
    pub fn only_says_speed(&self) -> bool {
        let taps = self.block.row(Group::Motion).is_some_and(|row| row.meaning == Meaning::RigidTap);
        let switches = self.block.m().any(|(_, row)| row.stops_spindle || row.meaning.turns_spindle());
        self.block.get(b'S').is_some() && !switches && !taps
    }

    /// Does the block that was run last set a work offset along X or Y, or turn it?
    pub fn sets_offset_across(&self) -> bool {
        let sets = self.block.row(Group::Once).is_some_and(|row| row.meaning == Meaning::SetOffsets);
        sets && b"XYR".iter().any(|letter| self.block.get(*letter).is_some())
    }
}
