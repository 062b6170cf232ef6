//! The state of a control between two blocks, in parts.

use super::action::{Position, Rotation};
use super::block::Block;
use super::codes::Motion;
use super::fault::{Done, refuse};
use super::holes::Holes;
use super::lathe::Threads;
use super::place::Place;
use super::profiled::FirstBlocks;
use super::settings::RunSettings;
use crate::control::{Centres, Control, Meaning, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Side, Units};

/// A control between two blocks.
#[derive(Clone, Debug)]
pub struct State {
    pub(super) settings: RunSettings,
    pub(super) control: &'static Control,
    pub(super) modes: Modes,
    pub(super) place: Place,
    pub(super) drive: Drive,
    pub(super) tool: Tool,
    pub(super) holes: Holes,
    /// Threads of a lathe: what is kept from block to block.
    pub(super) threads: Threads,
    /// Turning cycles of a lathe: what is kept from block to block.
    pub(super) turning: FirstBlocks,
    /// Warnings of the block: what a machinist should know though the control does it.
    pub(super) warnings: Vec<(Code, &'static str)>,
}

/// Modal codes.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    /// The modal motion; `None` after G80.
    pub motion: Motion,
    pub plane: Plane,
    pub units: Units,
    /// G90: axis words are positions.
    pub absolute: bool,
    /// G90.1: I, J and K are positions.
    pub centers_absolute: bool,
    /// It is known from where I, J and K count: by the control's file, or by the program.
    pub centers_known: bool,
    pub feed_mode: FeedMode,
    /// G98: cycles return to the initial level.
    pub to_initial: bool,
    /// G7: X words are diameters.
    pub diameter: bool,
}

/// Feed and spindle.
#[derive(Clone, Debug)]
pub(super) struct Drive {
    /// Feed in the unit of the feed mode; 0 where none is known.
    pub feed: f64,
    pub spindle: Rotation,
    pub speed: f64,
}

/// The tool and its offsets.
#[derive(Clone, Debug, Default)]
pub(super) struct Tool {
    /// What T said last.
    pub number: Option<f64>,
    /// The tool in the spindle: what M6 loaded.
    pub loaded: Option<f64>,
    /// A tool length offset is on.
    pub length_on: bool,
    /// Side of the path on which the tool is; `None`: cutter compensation is off.
    pub side: Option<Side>,
    /// D, which a Fanuc keeps.
    pub diameter_register: Option<f64>,
}

impl Drive {
    /// The feed of a block that cuts.
    #[inline]
    pub fn feed_of(&self, block: &Block, mode: FeedMode) -> Done<f64> {
        if mode == FeedMode::InverseTime {
            return match block.get(b'F') {
                Some(feed) if feed > 0.0 => Ok(feed),
                _ => refuse(Code::PN008, "G93 without F in the block", "write F in every block that cuts"),
            };
        }
        if self.feed > 0.0 {
            return Ok(self.feed);
        }
        refuse(Code::PN008, "a feed move without a feed", "write F with it")
    }
}

impl State {
    /// The state of a control as switched on.
    pub fn new(settings: RunSettings) -> State {
        let control = settings.control;
        State {
            settings,
            control,
            modes: Modes {
                motion: control.first(Meaning::Rapid).filter(|_| control.rules() == Rules::Grbl),
                plane: if control.is_lathe() { Plane::Xz } else { Plane::Xy },
                units: settings.units,
                absolute: true,
                centers_absolute: settings.centers_absolute,
                centers_known: settings.centers_absolute
                    || control.traits().centres != Centres::Unknown
                    || control.first(Meaning::CentresIncremental).is_none(),
                feed_mode: FeedMode::PerMinute,
                to_initial: !control.is_linuxcnc(),
                diameter: control.is_lathe() && settings.by_diameter.unwrap_or(true),
            },
            place: Place::new(
                match settings.places_unknown {
                    true if control.is_wire() => 0b1111,
                    true => 0b111,
                    false => 0,
                },
                control.first_work(),
            ),
            drive: Drive { feed: 0.0, spindle: Rotation::Stop, speed: 0.0 },
            threads: Threads::default(),
            turning: FirstBlocks::default(),
            tool: Tool::default(),
            holes: Holes::default(),
            warnings: Vec::new(),
        }
    }

    /// Units before the first G20 or G21.
    pub(super) fn begin_in(&mut self, units: Units) {
        self.modes.units = units;
    }

    /// Where the tool is.
    pub fn position(&self) -> &Position {
        &self.place.position
    }

    /// What G92, or G52, adds to places of the program.
    pub fn shift(&self) -> &Position {
        &self.place.frames.shift.by
    }

    /// Axes that stand at a place in machine coordinates, as bits.
    #[inline]
    pub fn at_machine(&self) -> u8 {
        self.place.at_machine
    }

    /// Axes that stand at a place in machine coordinates which the program said, as bits.
    pub fn at_said_machine(&self) -> u8 {
        self.place.placed
    }

    /// Is the position of an axis known to the machine alone, in a run that begins so?
    pub(super) fn is_unknown(&self, axis: usize) -> bool {
        self.settings.places_unknown && self.place.at_machine & 1 << axis != 0
    }

    /// A block was refused and is passed over: what it had begun is given up.
    pub(super) fn gives_up_block(&mut self) {
        (self.holes.work, self.holes.pattern) = (None, None);
        if self.settings.places_unknown {
            self.place.becomes_unknown(0b111);
        }
    }

    /// Axes whose frame G92 moved from a place that only the machine knew, as bits.
    pub fn frame_unknown(&self) -> u8 {
        self.place.frames.shift.unknown
    }

    /// How far G92 or G52 moves the frame, in the units in force.
    pub fn frame_shift(&self) -> &Position {
        &self.place.frames.shift.by
    }

    /// A place of the program in machine coordinates, in the units in force.
    pub fn in_machine_coordinates(&self, at: &Position) -> Position {
        self.place.frames.to_machine(at)
    }

    /// The number of the work offset in force: G54 is 1, the first additional one 10; those of controls that count them are as they
    /// count them.
    pub fn work_number(&self) -> usize {
        self.place.frames.active
    }

    /// Axes of the work offset in force that the program itself has set to a machine position, as bits.
    pub fn offset_given(&self) -> u8 {
        self.place.frames.given()
    }

    /// Puts the machine's own offsets and reference points in force, in millimetres and degrees; before the first block.
    pub(super) fn begin_on(&mut self, offsets: &mut dyn Iterator<Item = (usize, Position)>, homes: [Position; 2]) {
        let factor = 1.0 / self.modes.units.in_mm();
        for (number, at) in offsets {
            if let Some((work, _)) = self.place.frames.work(number) {
                *work = scaled(&at, factor);
            }
        }
        self.place.homes = homes.map(|home| scaled(&home, factor));
        let machine = [0.0; 6];
        self.place.position = self.place.frames.to_program(&machine);
    }

    /// A position in machine coordinates as the program says it, in the units in force.
    pub fn in_program_coordinates(&self, at: &Position) -> Position {
        self.place.frames.to_program(at)
    }

    /// The units in force.
    pub fn units(&self) -> Units {
        self.modes.units
    }

    /// The canned cycle in force.
    pub fn cycle_in_force(&self) -> Motion {
        match self.control.is_linuxcnc() {
            true => self.modes.motion.filter(|row| row.meaning == Meaning::Cycle),
            false => self.holes.cycle,
        }
    }

    /// Warnings since the last call.
    pub fn take_warnings(&mut self) -> Vec<(Code, &'static str)> {
        std::mem::take(&mut self.warnings)
    }
}

/// A position whose lengths count otherwise.
fn scaled(at: &Position, factor: f64) -> Position {
    std::array::from_fn(|axis| if axis < 3 { at[axis] * factor } else { at[axis] })
}
