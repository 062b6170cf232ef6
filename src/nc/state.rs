//! The state of a control between two blocks, divided into parts.

use std::sync::Arc;

use super::action::{Position, Rotation};
use super::block::Block;
use super::codes::Motion;
use super::fault::{Done, refuse};
use super::holes::Holes;
use super::lathe::Threads;
use super::place::Place;
use super::profiled::FirstBlocks;
use super::settings::RunSettings;
use super::tool_names::ToolNames;
use crate::control::{Centres, Control, Meaning, Row, Rules};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Plane, Side, Units};

/// The state of a control between two blocks.
#[derive(Clone, Debug)]
pub struct State {
    pub(super) settings: RunSettings,
    pub(super) control: &'static Control,
    pub(super) modes: Modes,
    pub(super) place: Place,
    pub(super) drive: Drive,
    pub(super) tool: Tool,
    pub(super) tool_names: ToolNames,
    pub(super) holes: Holes,
    /// The state of threads, which a lathe keeps between blocks.
    pub(super) threads: Threads,
    /// The state of turning cycles, which a lathe keeps between blocks.
    pub(super) turning: FirstBlocks,
    /// The active codes that change the moves of rotary axes.
    pub(super) rotary: Vec<&'static Row>,
    /// Warnings of the block, each with its help: the control accepts the block, but the user should check it.
    pub(super) warnings: Vec<(Code, &'static str, &'static str)>,
}

/// The active modal codes.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    /// The modal motion; `None` after G80.
    pub motion: Motion,
    pub plane: Plane,
    pub units: Units,
    /// Whether axis words are absolute positions: G90.
    pub absolute: bool,
    /// Whether I, J and K are absolute positions: G90.1.
    pub centers_absolute: bool,
    /// Whether the control's file or the program shows if I, J and K are positions.
    pub centers_known: bool,
    pub feed_mode: FeedMode,
    /// Whether cycles return to the initial level: G98.
    pub to_initial: bool,
    /// Whether X words are diameters: G7.
    pub diameter: bool,
}

/// The feed and the state of the spindle.
#[derive(Clone, Debug)]
pub(super) struct Drive {
    /// The feed in the unit of the feed mode; 0 if it is unknown.
    pub feed: f64,
    /// The number of the last F. The number differs from the feed if the units have changed since that F.
    pub given_feed: f64,
    pub spindle: Rotation,
    pub speed: f64,
}

/// The tool and its offsets.
#[derive(Clone, Debug, Default)]
pub(super) struct Tool {
    /// The tool of the last T word.
    pub number: Option<f64>,
    /// The tool in the spindle, loaded by M6.
    pub loaded: Option<f64>,
    /// Whether a tool length offset is on.
    pub length_on: bool,
    /// The side of the programmed path on which the tool is; `None`: cutter compensation is off.
    pub side: Option<Side>,
    /// The last D number, which a Fanuc keeps.
    pub diameter_register: Option<f64>,
}

impl Drive {
    /// Sets the feed that a block gives.
    #[inline]
    pub fn set_feed(&mut self, feed: f64) {
        (self.feed, self.given_feed) = (feed, feed);
    }

    /// Converts the feed to other units.
    pub fn rescale_feed(&mut self, factor: f64) {
        let feed = self.feed * factor;
        // the units may change back
        let is_given = (feed - self.given_feed).abs() <= self.given_feed * 1e-9;
        self.feed = if is_given { self.given_feed } else { feed };
    }

    /// The feed of a block with a cut.
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
        refuse(Code::PN008, "a feed move without a feed", "write F in the block of the move")
    }
}

impl State {
    /// The state of a control at power-up.
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
            drive: Drive { feed: 0.0, given_feed: 0.0, spindle: Rotation::Stop, speed: 0.0 },
            threads: Threads::default(),
            turning: FirstBlocks::default(),
            tool: Tool::default(),
            tool_names: ToolNames::default(),
            holes: Holes::default(),
            rotary: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Sets the units that are active before the first G20 or G21.
    pub(super) fn begin_in(&mut self, units: Units) {
        self.modes.units = units;
    }

    /// The name of a tool that the program calls by its name, and whose number is unknown. `tool`: the value of
    /// [`Action::Tool`](super::action::Action::Tool). `None`: the value is a tool number.
    pub fn tool_name(&self, tool: f64) -> Option<Arc<str>> {
        self.tool_names.name(tool)
    }

    /// The names by which the program has called tools. The name with the index n belongs to the tool 10^9 + n.
    pub fn tool_names(&self) -> Vec<Arc<str>> {
        self.tool_names.all()
    }

    /// Position of the tool.
    pub fn position(&self) -> &Position {
        &self.place.position
    }

    /// The shift that G92 or G52 adds to positions of the program.
    pub fn shift(&self) -> &Position {
        &self.place.frames.shift.by
    }

    /// Axes whose position is in machine coordinates, as bits.
    #[inline]
    pub fn at_machine(&self) -> u8 {
        self.place.at_machine
    }

    /// As bits, the axes whose machine position the program contains.
    pub fn at_said_machine(&self) -> u8 {
        self.place.placed
    }

    /// Whether the position of an axis is known only at the machine. False if the settings assume known positions.
    pub(super) fn is_unknown(&self, axis: usize) -> bool {
        self.settings.places_unknown && self.place.at_machine & 1 << axis != 0
    }

    /// Drops the holes that a refused block has begun. The block is skipped.
    pub(super) fn gives_up_block(&mut self) {
        (self.holes.work, self.holes.pattern) = (None, None);
        if self.settings.places_unknown {
            self.place.loses_all();
        }
    }

    /// As bits, the axes whose frame G92 moved while the position of the axis was known only at the machine.
    pub fn frame_unknown(&self) -> u8 {
        self.place.frames.shift.unknown
    }

    /// The shift of the frame by G92 or G52, in the active units.
    pub fn frame_shift(&self) -> &Position {
        &self.place.frames.shift.by
    }

    /// The position of the program's zero in machine coordinates, in the active units, and the rotation of the frame in
    /// degrees. Work offsets that the program does not set are at the machine's zero.
    pub fn zero(&self) -> (Position, f64) {
        (self.place.frames.to_machine(&Position::default()), self.place.frames.angle())
    }

    /// Converts program coordinates to machine coordinates, in the active units.
    pub fn in_machine_coordinates(&self, at: &Position) -> Position {
        self.place.frames.to_machine(at)
    }

    /// Converts program coordinates to coordinates of the work offset, in the active units. A shift from an unknown
    /// position is left out: coordinates along this axis are then measured from the program's own zero.
    pub fn in_work_offset(&self, at: &Position) -> Position {
        let frames = &self.place.frames;
        let mut at = *at;
        for (axis, value) in at.iter_mut().enumerate() {
            if frames.shift.unknown & 1 << axis != 0 {
                *value -= frames.shift.by[axis];
            }
        }
        frames.to_work(&at)
    }

    /// The number of the active work offset: G54 is 1, the first additional offset is 10. On a control that only
    /// numbers its work offsets, the result is the offset's own number.
    pub fn work_number(&self) -> usize {
        self.place.frames.active
    }

    /// As bits, the axes for which the program has set the active work offset to a machine position.
    pub fn offset_given(&self) -> u8 {
        self.place.frames.given()
    }

    /// All work offsets by number: the position in the active units, the rotation in degrees, and as bits the axes that
    /// the program has set.
    pub fn offsets(&self) -> impl Iterator<Item = (Position, f64, u8)> {
        self.place.frames.offsets()
    }

    /// Sets the machine's offsets and reference points, in millimetres and degrees. Call this function before the first
    /// block.
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

    /// Converts machine coordinates to program coordinates, in the active units.
    pub fn in_program_coordinates(&self, at: &Position) -> Position {
        self.place.frames.to_program(at)
    }

    /// The least increment of lengths, in the active units.
    pub(super) fn least_increment(&self) -> f64 {
        if self.modes.units == Units::Inch { 1e-4 } else { 1e-3 }
    }

    /// The active units.
    pub fn units(&self) -> Units {
        self.modes.units
    }

    /// The active canned cycle.
    pub fn cycle_in_force(&self) -> Motion {
        match self.control.is_linuxcnc() {
            true => self.modes.motion.filter(|row| row.meaning == Meaning::Cycle),
            false => self.holes.cycle,
        }
    }
}

/// A position with all lengths multiplied by a factor. Angles do not change.
fn scaled(at: &Position, factor: f64) -> Position {
    std::array::from_fn(|axis| if axis < 3 { at[axis] * factor } else { at[axis] })
}
