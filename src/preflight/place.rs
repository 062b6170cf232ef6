//! Machine positions, calculated from program positions with the known offsets, lengths and frames.

use std::collections::BTreeSet;

use crate::machine::Machine;
use crate::nc::{Position, Simulator, Turn, axes_of, sweep};
use crate::toolpath::Direction;

/// The values outside the program on which a machine position depends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Base {
    /// The position is unknown: the axis has not moved yet, or its frame was moved from an unknown position.
    Unknown,
    /// The position does not depend on other values: the program contains it in machine coordinates.
    Machine,
    /// The position depends on a work offset and a tool length.
    Work(Needs),
}

/// The work offset and the tool length on which a position depends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Needs {
    /// Number of the work offset.
    pub work: usize,
    /// Whether the offset is unknown, so that the position is relative to the offset.
    pub offset_unknown: bool,
    /// The length register of the tool if a tool length is active; negative if the length is subtracted.
    pub register: Option<i32>,
    /// Whether the length is unknown, so that the position does not include the length.
    pub length_unknown: bool,
}

impl Needs {
    /// Whether the position is unknown in machine coordinates.
    pub fn is_open(self) -> bool {
        self.offset_unknown || self.length_unknown
    }
}

/// The position of an axis.
#[derive(Clone, Copy, Debug)]
pub struct At {
    /// Position in millimetres or degrees. The position is in machine coordinates if the offset and the length of its
    /// base are known; otherwise it is relative to the unknown value.
    pub value: f64,
    pub base: Base,
}

/// The positions of the axes of a machine while a program runs.
#[derive(Clone, Debug)]
pub struct Places<'m> {
    machine: &'m Machine,
    /// Position of each axis.
    pub at: [At; 6],
    /// The position in machine coordinates as the simulator calculates it, in millimetres. Unknown frames count as zero.
    known: Position,
    /// The active length register; negative if the length is subtracted.
    pub register: Option<i32>,
    /// Whether the machine is a lathe. On a lathe, tool lengths are along X and Z.
    is_lathe: bool,
    /// Whether a tool length was added to an active tool length. The sum of the two lengths is not tracked.
    pub adds: bool,
    /// Whether the active length is that of another edge than the first one. The machine's table has no such lengths.
    edge: bool,
    /// The length registers that the program sets itself.
    set: BTreeSet<u32>,
    /// Whether a tool was changed and no Z position has been programmed since.
    changed: bool,
    /// Axes for which no position has been programmed since the tool length last changed, as bits.
    lengthened: u8,
    /// Axes that were in `lengthened` when their frame was moved, as bits. Positions in this frame are unknown.
    lost: u8,
    /// Axes for which a position was programmed in an unknown frame, as bits.
    pub unframed: u8,
    /// Whether an axis made an incremental move from an unknown position.
    pub astray: bool,
}

/// The axis words of a block that moves. Axes are stored as bits.
#[derive(Clone, Copy, Debug)]
pub struct Going {
    /// Axes that are at a machine position after the move.
    pub in_machine: u8,
    /// Axes whose machine position the program contains.
    pub said: u8,
    /// Axes that move to a machine position which the machine's file does not contain.
    pub hidden: u8,
    /// Axes for which the block contains a position.
    pub says: u8,
    /// Whether every axis that moves counts as programmed. True for a cycle, because the words of a cycle contain the
    /// positions.
    pub all_said: bool,
}

impl<'m> Places<'m> {
    pub fn new(machine: &'m Machine, is_lathe: bool) -> Places<'m> {
        let at = [At { value: 0.0, base: Base::Unknown }; 6];
        Places {
            machine,
            at,
            known: [0.0; 6],
            register: None,
            is_lathe,
            adds: false,
            edge: false,
            set: BTreeSet::new(),
            changed: false,
            lengthened: 0,
            lost: 0,
            unframed: 0,
            astray: false,
        }
    }

    /// Moves to a program position. If the block contains a position for an axis, the axis goes to that position in the
    /// active work offset and with the active tool length. Every other axis moves by its increment from its machine
    /// position.
    pub fn goes(&mut self, to: &Position, going: Going, run: &Simulator<'_>) {
        let known = run.state().in_machine_coordinates(to);
        let known: Position = std::array::from_fn(|axis| self.scaled(axis, known[axis], run));
        for (axis, known) in known.into_iter().enumerate() {
            let bit = 1 << axis;
            let moved = known - self.known[axis];
            self.changed &= !(axis == 2 && going.says & bit != 0);
            let says = going.says & bit != 0 || going.all_said && moved != 0.0;
            let lost = (run.state().frame_unknown() | self.lost) & bit;
            self.unframed |= if says { lost } else { 0 };
            self.at[axis] = if lost != 0 || going.hidden & bit != 0 {
                At { base: Base::Unknown, ..self.at[axis] }
            } else if going.in_machine & going.said & bit != 0 {
                At { value: known, base: Base::Machine }
            } else if going.in_machine & bit == 0 && says {
                self.lengthened &= !bit;
                self.in_work(axis, known, run)
            } else {
                let At { value, mut base } = self.at[axis];
                if axis == 2 && moved != 0.0 && self.changed {
                    base = Base::Unknown;
                }
                self.astray |= base == Base::Unknown && moved != 0.0;
                At { value: value + moved, base }
            };
        }
        self.known = known;
    }

    /// Turns a tool length on or off. Until a position is programmed, the coordinates differ from those of the simulator.
    pub fn takes_length(&mut self, register: Option<f64>) {
        self.register = register.map(|register| register as i32);
        self.edge = register.is_some_and(|register| register.fract() != 0.0);
        self.lengthened = 0b111;
    }

    /// Notes that a frame was moved so that the tool has a given position in the frame.
    pub fn reframed(&mut self) {
        self.lost |= self.lengthened;
    }

    /// Changes the tool. After a tool change, the Z position is unknown until the program contains a Z position.
    pub fn changes_tool(&mut self) {
        self.changed = !self.is_lathe;
    }

    /// Least and greatest position of X, Y and Z on an arc that ends at the current position. Call [`Places::goes`]
    /// with the end of the arc first.
    pub fn extremes(&self, from: &Position, turn: &Turn, run: &Simulator<'_>) -> [[f64; 2]; 3] {
        let end: [f64; 3] = std::array::from_fn(|axis| self.at[axis].value);
        let machine = |at: &Position| {
            let at = run.state().in_machine_coordinates(at);
            std::array::from_fn::<f64, 3, _>(|axis| self.scaled(axis, at[axis], run))
        };
        let shift: [f64; 3] = {
            let to = machine(&turn.to);
            std::array::from_fn(|axis| end[axis] - to[axis])
        };
        let start = machine(from);
        let mut ranges: [[f64; 2]; 3] = std::array::from_fn(|axis| {
            let start = start[axis] + shift[axis];
            [start.min(end[axis]), start.max(end[axis])]
        });
        let [first, second, across] = axes_of(turn.plane);
        let radius = (from[first] - turn.center[first]).hypot(from[second] - turn.center[second]);
        let begin = (from[second] - turn.center[second]).atan2(from[first] - turn.center[first]);
        let swept = sweep(from, turn);
        let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
        let mut centre = *from;
        centre[..3].copy_from_slice(&turn.center);
        let along = |axis: usize| {
            let mut at = centre;
            at[axis] += radius;
            let (at, centre) = (machine(&at), machine(&centre));
            std::array::from_fn::<f64, 3, _>(|axis| at[axis] - centre[axis])
        };
        let (middle, u, v) = (machine(&centre), along(first), along(second));
        // on a helix: the additional travel of each axis per radian
        let rise: [f64; 3] = {
            let mut raised = centre;
            raised[across] = turn.to[across];
            let mut level = centre;
            level[across] = from[across];
            let (raised, level) = (machine(&raised), machine(&level));
            std::array::from_fn(|axis| if swept > 0.0 { sign * (raised[axis] - level[axis]) / swept } else { 0.0 })
        };
        let mut level = centre;
        level[across] = from[across];
        let middle = if rise == [0.0; 3] { middle } else { machine(&level) };
        for axis in 0..3 {
            let size = u[axis].hypot(v[axis]);
            if size <= rise[axis].abs() {
                continue;
            }
            // the angles at which the sum of circle and rise has an extreme value
            let peak = v[axis].atan2(u[axis]);
            let aside = (rise[axis] / size).asin();
            for angle in [peak + aside, peak + std::f64::consts::PI - aside] {
                let first = (sign * (angle - begin)).rem_euclid(std::f64::consts::TAU);
                let turns = ((swept - first) / std::f64::consts::TAU).floor();
                // only the first and the last turn matter: the extreme values of all other turns are between those of these two
                for ahead in [first, std::f64::consts::TAU.mul_add(turns, first)] {
                    if turns >= 0.0 && ahead < swept {
                        let at = begin + sign * ahead;
                        let value = middle[axis] + u[axis] * at.cos() + v[axis] * at.sin();
                        let value = value + rise[axis] * sign * ahead + shift[axis];
                        ranges[axis] = [ranges[axis][0].min(value), ranges[axis][1].max(value)];
                    }
                }
            }
        }
        ranges
    }

    /// The current position, in the program's coordinates and units.
    pub fn program(&self, run: &Simulator<'_>) -> Position {
        let factor = 1.0 / run.state().units().in_mm();
        run.state().in_program_coordinates(&std::array::from_fn(|axis| {
            if axis < 3 { self.known[axis] * factor } else { self.known[axis] }
        }))
    }

    fn scaled(&self, axis: usize, value: f64, run: &Simulator<'_>) -> f64 {
        if axis < 3 { value * run.state().units().in_mm() } else { value }
    }

    fn in_work(&self, axis: usize, value: f64, run: &Simulator<'_>) -> At {
        let work = run.state().work_number();
        let of_file = self.machine.offset(work).and_then(|offset| offset[axis]).is_some();
        let given = run.state().offset_given() & 1 << axis != 0;
        // rotary axes without an offset are measured from machine zero
        let offset_unknown = axis < 3 && !of_file && !given;
        let takes = if self.is_lathe { axis == 0 || axis == 2 } else { axis == run.state().length_axis() };
        if (self.adds || self.edge) && takes {
            return At { value, base: Base::Unknown };
        }
        let aside = self.register.filter(|_| axis < 2).and_then(|register| self.aside(register)).unwrap_or([0.0; 2]);
        let value = value + aside.get(axis).copied().unwrap_or(0.0);
        let register = self.register.filter(|register| takes && *register != 0);
        let length = register.map_or(Some(0.0), |register| self.length(register));
        let needs = Needs { work, offset_unknown, register, length_unknown: length.is_none() };
        At { value: value + length.unwrap_or(0.0), base: Base::Work(needs) }
    }

    /// Offset of a tool in X and Y from the spindle axis, from LinuxCNC's tool table.
    fn aside(&self, register: i32) -> Option<[f64; 2]> {
        Some(self.machine.tools.as_ref().filter(|_| !self.is_lathe)?.0.get(&u32::try_from(register).ok()?)?.aside)
    }

    /// The tool length in a register, with its sign. For mills only: the machine's file does not contain the position
    /// of a lathe tool's cutting edge.
    pub fn length(&self, register: i32) -> Option<f64> {
        let known = !self.is_lathe && !self.set.contains(&register.unsigned_abs());
        self.machine.tools.as_ref().filter(|_| known)?.length(register)
    }

    /// Forgets the length in a register, because the program sets it. The program may set the length, or only its wear
    /// or a part of it.
    pub fn sets_length(&mut self, register: u32) {
        self.set.insert(register);
    }
}
