//! Runs a program and records its motions.

use std::collections::HashMap;
use std::io::{self, Read, Seek};

use super::state::Registers;
use super::{Hole, Kind, Move, Picture, Turned};
use crate::nc::{Action, Item, Position, RunError, RunSettings, Simulator, Tally, Turn, axes_of};
use crate::toolpath::Units;

/// Maximum number of warnings that are kept.
const MOST_WARNINGS: usize = 100;
/// A position farther away than this distance is drawn at this distance.
const FARTHEST: f64 = 1e9;
/// Maximum number of moves: further moves are not drawn.
const MOST_MOVES: usize = 20_000_000;

/// Runs a program from an unknown machine position and records its motions.
///
/// # Errors
/// The input can't be read. If the control refuses a block, the result is not an error: the picture contains the
/// refusal and ends at that block.
pub fn draw(input: impl Read + Seek, settings: RunSettings) -> io::Result<Picture> {
    let simulator = Simulator::new(input, RunSettings { places_unknown: true, ..settings });
    let mut pen = Pen::new(&settings);
    let simulator = pen.run(simulator)?;
    let known = pen.picture.moves.iter().any(|found| found.to.iter().any(|value| value.is_finite()));
    if known || pen.picture.moves.is_empty() {
        return Ok(pen.picture);
    }
    // the program has only incremental moves: it is drawn with zero as its start
    let again = simulator.again_with(RunSettings { places_unknown: false, ..settings })?;
    let mut pen = Pen::new(&settings);
    pen.at = [0.0; 3];
    pen.upper = pen.upper.map(|_| [0.0; 3]);
    pen.run(again)?;
    Ok(pen.picture)
}

/// Records the moves of the machine.
struct Pen {
    picture: Picture,
    registers: Registers,
    /// Position of the tool, in the picture's units; NaN if unknown.
    at: [f64; 3],
    /// Position of the upper guide of a wire EDM machine: X, Y, and a Z that is unknown.
    upper: Option<[f64; 3]>,
    /// Positions of the rotary axes, in degrees.
    angles: [f64; 3],
    /// Letters of the axes of the machine, in the order of a position.
    letters: &'static [u8; 6],
    tool: u16,
    /// Indexes in the picture's list of tools, by the bits of the tool number.
    indexes: HashMap<u64, u16>,
    /// Factor from the program's units to the picture's units.
    factor: f64,
    units: Units,
}

impl Pen {
    fn new(settings: &RunSettings) -> Pen {
        let units = settings.units;
        let is_wire = settings.control.is_wire();
        let picture = Picture {
            units,
            moves: Vec::new(),
            arcs: Vec::new(),
            holes: Vec::new(),
            minutes: Vec::new(),
            turned: Vec::new(),
            letters: "XYZ",
            tools: vec![0.0],
            tool_names: Vec::new(),
            changes: Vec::new(),
            tally: Tally::new(units),
            blocks: 0,
            warnings: Vec::new(),
            refused: None,
        };
        Pen {
            picture: Picture { letters: if is_wire { "XY" } else { "XYZ" }, ..picture },
            registers: Registers::new(),
            at: [f64::NAN; 3],
            upper: is_wire.then_some([f64::NAN; 3]),
            angles: [0.0; 3],
            letters: settings.control.axes(),
            tool: 0,
            indexes: HashMap::from([(0f64.to_bits(), 0)]),
            factor: 1.0,
            units,
        }
    }

    fn run<'a>(&mut self, mut simulator: Simulator<'a>) -> io::Result<Simulator<'a>> {
        self.registers.after(0, simulator.state().modal(), &mut self.picture.changes);
        let mut items = Vec::new();
        loop {
            items.clear();
            let step = simulator.step(&mut items);
            items.iter().for_each(|item| self.act(item));
            let line = simulator.line() as u32;
            self.registers.after(line, simulator.state().modal(), &mut self.picture.changes);
            let (position, machine) = (simulator.state().position(), simulator.state().at_machine());
            self.registers.axes(line, self.letters, position, machine, &mut self.picture.changes);
            self.stands(line, position, machine);
            let room = MOST_WARNINGS.saturating_sub(self.picture.warnings.len());
            self.picture.warnings.extend(simulator.take_warnings().into_iter().take(room));
            match step {
                Ok(true) if self.picture.moves.len() < MOST_MOVES => {}
                Ok(_) => break,
                Err(RunError::Refused(diag, line)) => {
                    self.picture.refused = Some((diag, line));
                    break;
                }
                Err(RunError::Io(error)) => return Err(error),
            }
        }
        self.picture.blocks = simulator.blocks();
        self.picture.tool_names = simulator.state().tool_names();
        Ok(simulator)
    }

    fn act(&mut self, item: &Item) {
        self.picture.tally.add(item);
        let line = item.line as u32;
        self.registers.act(line, &item.action, &mut self.picture.changes);
        match &item.action {
            Action::Rapid { to, machine, .. } => self.go_to(item, Kind::Rapid, to, *machine),
            Action::Feed { to, home, .. } => self.go_to(item, Kind::Feed, to, *home),
            Action::Arc(turn) => {
                let to = self.place(&turn.to, 0);
                let arc = self.picture.arcs.len() as u32;
                let [first, second, _] = axes_of(turn.plane);
                let center = turn.center.map(|value| (value * self.factor).clamp(-FARTHEST, FARTHEST));
                // an arc from an unknown position can't be drawn
                let from = self.at;
                self.turn(&turn.to);
                if from[first].is_finite() && from[second].is_finite() {
                    self.picture.arcs.push(Turn { center, ..*turn });
                    self.go(item, Kind::Arc, to, arc);
                } else {
                    self.go(item, Kind::Jump, to, u32::MAX);
                }
                self.guide_round(item, from, &Turn { center, ..*turn });
            }
            Action::Tool(number) => {
                let tools = &mut self.picture.tools;
                self.tool = *self.indexes.entry(number.to_bits()).or_insert_with(|| {
                    tools.push(*number);
                    // all tools beyond the largest index share this index
                    u16::try_from(tools.len() - 1).unwrap_or(u16::MAX)
                });
            }
            Action::Hole(hole) => {
                let [_, _, across] = axes_of(hole.plane);
                let mut top = self.place(&hole.at, 0);
                let mut bottom = top;
                top[across] = (hole.r * self.factor).clamp(-FARTHEST, FARTHEST);
                bottom[across] = (hole.bottom * self.factor).clamp(-FARTHEST, FARTHEST);
                self.picture.holes.push(Hole { line, top, bottom, tool: self.tool, turned: self.angles });
            }
            Action::Units(units) => self.count_in(*units),
            _ => {}
        }
    }

    /// Sets the current units. The picture has the units of its first move.
    fn count_in(&mut self, units: Units) {
        self.units = units;
        if self.picture.moves.is_empty() {
            self.picture.units = units;
        }
        self.factor = match (units, self.picture.units) {
            (Units::Inch, Units::Mm) => 25.4,
            (Units::Mm, Units::Inch) => 1.0 / 25.4,
            _ => 1.0,
        };
    }

    fn place(&self, to: &Position, machine: u8) -> [f64; 3] {
        let place = |axis: usize| (to[axis] * self.factor).clamp(-FARTHEST, FARTHEST);
        std::array::from_fn(|axis| match (axis, self.upper) {
            (2, Some(_)) => 0.0,
            _ if machine & 1 << axis == 0 => place(axis),
            _ => f64::NAN,
        })
    }

    /// The position of the upper guide. U and V are X and Y of this guide; the height of the guide is unknown.
    fn guide(&self, to: &Position, machine: u8) -> [f64; 3] {
        let place = |axis: usize| (to[axis] * self.factor).clamp(-FARTHEST, FARTHEST);
        let [u, v] = [2, 3].map(|axis| if machine & 1 << axis == 0 { place(axis) } else { f64::NAN });
        [u, v, f64::NAN]
    }

    /// Adds a straight move, and the move of the upper guide if there is one.
    fn go_to(&mut self, item: &Item, kind: Kind, to: &Position, machine: u8) {
        self.turn(to);
        self.go(item, kind, self.place(to, machine), u32::MAX);
        if let Some(from) = self.upper {
            let upper = self.guide(to, machine);
            self.go_above(item, kind, from, upper, u32::MAX);
        }
    }

    /// Adds the move of the upper guide during an arc. The upper guide moves along the same arc if the offset between
    /// the guides is equal at both ends; otherwise it moves straight.
    fn guide_round(&mut self, item: &Item, from: [f64; 3], turn: &Turn) {
        let Some(above) = self.upper else { return };
        let upper = self.guide(&turn.to, turn.machine);
        let off = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1]];
        let [before, after] = [off(above, from), off(upper, self.at)];
        let same = (0..2).all(|axis| (before[axis] - after[axis]).abs() < 1e-9 * (1.0 + before[axis].abs()));
        if same {
            let arc = self.picture.arcs.len() as u32;
            let [x, y, z] = turn.center;
            self.picture.arcs.push(Turn { center: [x + before[0], y + before[1], z], ..*turn });
            self.go_above(item, Kind::Arc, above, upper, arc);
        } else {
            self.go_above(item, Kind::Feed, above, upper, u32::MAX);
        }
    }

    /// Adds a move of the upper guide, between a jump from the lower guide and a jump back.
    fn go_above(&mut self, item: &Item, kind: Kind, from: [f64; 3], to: [f64; 3], arc: u32) {
        let below = self.at;
        self.upper = Some(to);
        let known = [from, to].iter().all(|at| at[..2].iter().all(|value| value.is_finite()));
        if known && from[..2] != to[..2] {
            self.go(item, Kind::Jump, from, u32::MAX);
            self.go(item, kind, to, arc);
            self.go(item, Kind::Jump, below, u32::MAX);
        }
    }

    /// Turns the rotary axes. The new angles are valid from the next move on.
    fn turn(&mut self, to: &Position) {
        let [.., a, b, c] = *to;
        if self.upper.is_none() && self.angles != [a, b, c] && [a, b, c].iter().all(|angle| angle.is_finite()) {
            self.angles = [a, b, c];
            let from = self.picture.moves.len() as u32;
            self.picture.turned.push(Turned { from, to: self.angles });
        }
    }

    fn go(&mut self, item: &Item, kind: Kind, to: [f64; 3], arc: u32) {
        self.at = to;
        let (line, by_cycle) = (item.line as u32, item.by_cycle);
        self.push(Move { to, line, arc, tool: self.tool, kind, by_cycle });
    }

    fn push(&mut self, made: Move) {
        self.picture.moves.push(made);
        self.picture.minutes.push(self.picture.tally.minutes() as f32);
    }

    /// Updates the position after a block: if the frame was moved, the tool has new coordinates without a move.
    fn stands(&mut self, line: u32, position: &Position, machine: u8) {
        if self.upper.is_some() {
            self.upper = Some(self.guide(position, machine));
        }
        let at = self.place(position, machine);
        let same = |a: f64, b: f64| a == b || a.is_nan() || b.is_nan() || (a - b).abs() < 1e-9 * (1.0 + a.abs());
        if (0..3).all(|axis| same(at[axis], self.at[axis])) {
            return;
        }
        self.at = at;
        self.push(Move { to: at, line, arc: u32::MAX, tool: self.tool, kind: Kind::Jump, by_cycle: false });
    }
}
